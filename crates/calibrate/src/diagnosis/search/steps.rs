//! The gain of each effect, in the order in which they are added, with its evidence in numbers and words.

use nalgebra::DMatrix;

use crate::effects::Term;
use crate::{budget, odds};

use super::prepare::PreparedSearch;
use super::worth::Worth;
use crate::diagnosis::candidates::columns::CandidateSubset;
use crate::diagnosis::candidates::compatible;
use crate::diagnosis::evidence::Fit;
use crate::diagnosis::evidence::Regression;
use crate::linear::{Basis, reject_all};

/// One effect more, in the order of their gains.
pub(crate) struct Step {
    pub(crate) term: Term,
    pub(crate) gap_mm: [f64; 2],
    pub(crate) held_out_mm: Option<[f64; 2]>,
    /// The same over everything that was measured, each kind in units of its noise.
    pub(crate) held_out: Option<[f64; 2]>,
}

pub(crate) fn steps(prepared: &PreparedSearch, base: &Fit, fit: &Fit) -> Vec<Step> {
    let regression = &prepared.regression;
    let mut remaining: Vec<Term> = regression.added(fit).into_iter().cloned().collect();
    let mut now = regression.fit(&base.model, &fit.shapes);
    let unseen_of = |fit: &Fit| {
        let unseen = prepared.folds.unseen(regression, fit);
        (unseen.rms_mm, unseen.rms)
    };
    let mut unseen = unseen_of(&now);
    let gap = |fit: &Fit| {
        let (raw, _) = regression.rows.extract(&fit.model);
        let mut e = raw;
        for shape in &fit.shapes {
            e -= &*shape.raw * &shape.coefficients;
        }
        regression.rows.rms_mm(&e)
    };
    let mut steps = Vec::new();
    let (raw, columns) = regression.raw(&fit.model);
    let (_, white) = regression.whitened(&fit.model, &raw, columns);
    while !remaining.is_empty() {
        let with = |index: usize| {
            let term = &remaining[index];
            let absent = Term::absent(term.effect, term.joint, term.setting);
            regression.fit(&now.model.with_term(absent), &now.shapes)
        };
        let fits = likeliest(regression, (fit, &white), &now, &remaining);
        let fits = fits.into_iter().map(|index| (index, with(index)));
        let best = fits.max_by(|a, b| a.1.ln_evidence.total_cmp(&b.1.ln_evidence));
        let Some((index, next)) = best else { break };
        let seen = unseen_of(&next);
        let enough = prepared.folds.predict_poses;
        steps.push(Step {
            term: remaining.remove(index),
            gap_mm: [gap(&now), gap(&next)],
            held_out_mm: enough.then_some([unseen.0, seen.0]),
            held_out: enough.then_some([unseen.1, seen.1]),
        });
        (now, unseen) = (next, seen);
    }
    steps
}

/// Indices of the terms that may be the likeliest to add to the reduced fit, by their columns in the full fit.
fn likeliest(
    regression: &Regression,
    (all, white): (&Fit, &DMatrix<f64>),
    now: &Fit,
    remaining: &[Term],
) -> Vec<usize> {
    let mut places: Vec<usize> = (0..remaining.len()).collect();
    if remaining.len() <= budget::LIKELIEST {
        return places;
    }
    let worth = |term: &Term| {
        let mut first = 0;
        for own in all.model.terms() {
            let size = own.coefficients.len();
            if own.same_column(term) {
                let mut free = white.columns(first, size).into_owned();
                reject_all(&now.basis.q, &mut free);
                let basis = Basis::new(&free);
                let gain = basis.q.tr_mul(&now.residual).norm_squared();
                let share = (gain / now.rss.max(1e-300)).min(1.0 - 1e-12);
                // Components of a vector that are zero have no penalty.
                let rank = basis.rank().min(2) as f64;
                return -0.5 * regression.m() * (-share).ln_1p()
                    - 0.5 * rank * regression.m().ln()
                    - regression.price_of_term(term);
            }
            first += size;
        }
        f64::NEG_INFINITY
    };
    let worths: Vec<f64> = remaining.iter().map(worth).collect();
    places.sort_by(|a, b| worths[*b].total_cmp(&worths[*a]).then(a.cmp(b)));
    places.truncate(budget::LIKELIEST);
    places.sort_unstable();
    places
}

/// The likeliest other name in the place of one.
pub(crate) struct Next {
    pub(crate) term: Term,
    /// Logarithm of how much likelier the reduced fit is with it.
    pub(crate) ln_odds: f64,
    /// The reduced fit with it, where it is close.
    pub(crate) fit: Option<Fit>,
}

impl Next {
    /// The likeliest that is compatible with the other terms.
    pub(crate) fn than(
        prepared: &PreparedSearch,
        fit: &Fit,
        term: &Term,
        worth: &Worth,
    ) -> Option<Self> {
        let regression = &prepared.regression;
        let about = term.effect.about();
        let there = regression.added(&worth.reduced);
        // By the first-order table of the whole fit; what comes close is refitted.
        let scores = match regression.without(fit, term) {
            Some(reduced) => {
                let around = regression.projections(fit, CandidateSubset::Names);
                regression.scan_without(&around, &reduced)
            }
            None => regression.scan(&worth.reduced, CandidateSubset::Names),
        };
        let others = scores.iter().filter_map(|score| {
            let other = regression.table.candidates[score.candidate].what.term()?;
            let same_name = other.effect.about().id == about.id
                && (!about.per_joint || other.joint == term.joint);
            (!same_name && compatible(&there, other)).then_some((score.ln_odds, other))
        });
        let (ln_odds, other) = others.max_by(|a, b| a.0.total_cmp(&b.0))?;
        // Where it is close it is refitted, as the name itself was.
        let fit = (worth.ln_odds - ln_odds < odds::TAKEN.nats()).then(|| {
            let model = worth.reduced.model.with_term(other.clone());
            regression.fit(&model, &worth.reduced.shapes)
        });
        Some(Self {
            term: other.clone(),
            ln_odds: fit
                .as_ref()
                .map_or(ln_odds, |f| f.ln_evidence - worth.reduced.ln_evidence),
            fit,
        })
    }
}
