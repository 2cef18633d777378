//! The set of names that a search ends with, tested once more: each name against the rest, with the
//! null of this very fit. A name that entered early may be worth nothing beside what came later.

use crate::effects::Term;

use super::aliases;
use super::prepare::Prepared;
use super::regression::Fit;
use super::search::{CHANCE, Found, needed};
use super::significance::Significance;
use super::steps::{Next, Step, steps};
use super::{Cancelled, Progress, Watch};

/// What one term is worth beside the others.
#[derive(Debug, Clone)]
pub(crate) struct Worth {
    /// The fit without it.
    pub(crate) rest: Fit,
    /// −ln p on the scale of the family-wise test.
    pub(crate) minus_ln_p: f64,
    /// Logarithm of how much likelier the fit is with it.
    pub(crate) ln_odds: f64,
}

/// Takes out, worst first, every name that does not carry itself.
pub(crate) fn test(prepared: &Prepared, found: &mut Found, watch: Watch) -> Result<(), Cancelled> {
    let regression = &prepared.regression;
    loop {
        if !watch(&Progress::Comparing) {
            return Err(Cancelled);
        }
        let fit = &found.fit;
        let unseen = prepared.folds.rms(regression, fit);
        let mut worst: Option<(f64, Fit)> = None;
        for term in regression.added(fit) {
            let worth = worth(prepared, fit, term);
            let improbable = regression.family_p(worth.minus_ln_p, fit).p > CHANCE;
            let unlikely = worth.ln_odds < needed(fit, term).max(0.0);
            let useless = || prepared.folds.rms(regression, &worth.rest) <= unseen;
            if improbable || unlikely || useless() {
                let lowest = worst.as_ref().is_none_or(|w| worth.ln_odds < w.0);
                if lowest {
                    worst = Some((worth.ln_odds, worth.rest));
                }
            }
        }
        let Some((_, rest)) = worst else {
            return Ok(());
        };
        found.fit = rest;
    }
}

/// Exchanges names for likelier ones, which a noise that changed since the search or a name that was
/// taken out may have made of them; whether it did.
pub(crate) fn exchanged(prepared: &Prepared, found: &mut Found) -> bool {
    let regression = &prepared.regression;
    let mut changed = false;
    for _ in 0..3 {
        let mut rivals = aliases::rivals(regression, &found.fit).into_iter();
        let fits = |r: &aliases::Rival| regression.added(&r.fit).len() <= prepared.cap();
        let Some(rival) = rivals.find(fits) else {
            break;
        };
        if rival.fit.ln_evidence <= found.fit.ln_evidence + 1e-3 {
            break;
        }
        found.fit = rival.fit;
        changed = true;
    }
    changed
}

/// Holds the set against what will be said of it: a name in whose place another alone is likelier gives way
/// to it, and one with which the error on unseen samples does not fall is taken out.
pub(crate) fn as_said(
    prepared: &Prepared,
    found: &mut Found,
    watch: Watch,
) -> Result<(), Cancelled> {
    let regression = &prepared.regression;
    let base = regression.fit(&regression.base, Vec::new());
    loop {
        if !watch(&Progress::Comparing) {
            return Err(Cancelled);
        }
        if let Some(likelier) = one_exchanged(prepared, &found.fit) {
            found.fit = likelier;
            test(prepared, found, watch)?;
            continue;
        }
        // Of several kinds of measurement that in mm is not all that they show; [`test`] weighs them all.
        if regression.rows.observed().is_some() {
            return Ok(());
        }
        // As the model keeps them: names alone.
        let alone = if found.fit.shapes.is_empty() {
            found.fit.clone()
        } else {
            regression.fit(&found.fit.model, Vec::new())
        };
        let idle = |step: &Step| step.held_out_mm.is_some_and(|h| h[1] >= h[0]);
        let steps = steps(prepared, &base, &alone);
        let Some(step) = steps.into_iter().rev().find(idle) else {
            return Ok(());
        };
        found.fit = regression.without_term(&found.fit, &step.term);
    }
}

/// The fit with the likeliest other name in the place of one, where that is likelier.
fn one_exchanged(prepared: &Prepared, fit: &Fit) -> Option<Fit> {
    let regression = &prepared.regression;
    let likelier = regression.added(fit).into_iter().filter_map(|term| {
        let worth = worth(prepared, fit, term);
        Next::than(prepared, term, &worth)?.fit
    });
    let best = likelier.max_by(|a, b| a.ln_evidence.total_cmp(&b.ln_evidence))?;
    (best.ln_evidence > fit.ln_evidence + 1e-3).then_some(best)
}

/// What a term is worth beside the others of a fit.
pub(crate) fn worth(prepared: &Prepared, fit: &Fit, term: &Term) -> Worth {
    let regression = &prepared.regression;
    let rest = regression.without_term(fit, term);
    let rank = fit.basis.rank().saturating_sub(rest.basis.rank()).max(1);
    let freedom = (regression.m() - fit.basis.rank() as f64).max(2.0);
    let share = ((rest.rss - fit.rss) / rest.rss.max(1e-300)).clamp(0.0, 1.0 - 1e-15);
    let tried = regression.price_of_term(term);
    Worth {
        minus_ln_p: Significance::new(rank, freedom).of(share) - 0.5 * tried,
        ln_odds: fit.ln_evidence - rest.ln_evidence,
        rest,
    }
}
