//! Settles a fit after a step: terms are exchanged for better ones, what is not needed is dropped, one or two are
//! replaced by one or two others, until nothing changes.

use std::rc::Rc;

use super::forward::{Additions, Search};
use super::{aliases, orders};
use crate::diagnosis::Cancelled;
use crate::diagnosis::candidates::Placed;
use crate::diagnosis::candidates::table::Candidate;
use crate::diagnosis::evidence::Fit;
use crate::diagnosis::evidence::{Projections, ReducedFit};
use crate::diagnosis::evidence::{Score, by_odds};
use crate::effects::{Over, Term};
use crate::model::shapes::Variable;
use crate::odds;

/// So far off may log-odds be that are known to first order …
const FIRST_ORDER: f64 = 2.0;
/// … and the sum of squares falls by at least this share of the first-order gain.
const SURELY: f64 = 0.8;
/// Log-odds by which a term has to be needed given the others.
/// Calibrated, as the two below (`hidden_effects unknown`, `strange`).
pub(crate) const NEEDED: f64 = 1.0;
/// With a shape a name has to be needed clearly, or it only corrects the shape's edges …
const NEEDED_WITH_A_SHAPE: f64 = 5.0;
/// … and more so where both follow the value of the same joint: what is unknown there may have any
/// form, and most of it looks like some name.
const MIN_LOG_ODDS_SAME_VARIABLE: f64 = 15.0;

/// Log-odds by which a name has to be needed in a fit.
pub(crate) fn needed(fit: &Fit, term: &Term) -> f64 {
    let about = term.effect.about();
    let alike = |s: &Placed| {
        about.over == Over::Angle
            && matches!(s.shape.variable, Variable::Joint(j) if j == term.joint || !about.per_joint)
    };
    if fit.shapes.iter().any(alike) {
        MIN_LOG_ODDS_SAME_VARIABLE
    } else if fit.shapes.is_empty() {
        NEEDED
    } else {
        NEEDED_WITH_A_SHAPE
    }
}

impl Search<'_, '_> {
    /// Swaps and drops until nothing changes.
    pub(super) fn settle(&self, fit: Fit, allow: Additions) -> Fit {
        let mut fit = fit;
        for _ in 0..3 {
            let before = fit.ln_evidence;
            fit = orders::together(self.regression, fit);
            fit = self.swap(fit, allow);
            fit = self.drop(fit);
            if fit.ln_evidence <= before + 1e-6 {
                break;
            }
        }
        fit
    }

    /// Exchanges each term or shape for the best candidate in its place. Candidates that could not come close by the
    /// first-order table of the whole fit are not tried.
    fn swap(&self, fit: Fit, allow: Additions) -> Fit {
        let mut fit = fit;
        if self.count(&fit) < 2 && fit.shapes.is_empty() {
            return fit;
        }
        let terms: Vec<Term> = self.regression.added(&fit).into_iter().cloned().collect();
        let mut around = None;
        for term in terms {
            if self.regression.work.is_spent() {
                return fit;
            }
            let without = self.regression.without(&fit, &term);
            let is_own = |c: &Candidate| c.what.term().is_some_and(|t| t.same_column(&term));
            let scores = self.near(&fit, without, &mut around, allow, is_own);
            if scores.is_empty() {
                continue;
            }
            let reduced = self.regression.without_term(&fit, &term);
            if let Some(better) = self.best_addition(&reduced, scores, allow, fit.ln_evidence) {
                (fit, around) = (better, None);
            }
        }
        for index in (0..fit.shapes.len()).rev() {
            let without = self.regression.without_placed(&fit, index);
            let scores = self.near(&fit, without, &mut around, allow, |_| false);
            if scores.is_empty() {
                continue;
            }
            let reduced = self.regression.without_shape(&fit, index);
            if let Some(better) = self.best_addition(&reduced, scores, allow, fit.ln_evidence) {
                (fit, around) = (better, None);
            }
        }
        fit
    }

    /// Candidates but this one that may be likelier in the place of what is taken out.
    fn near(
        &self,
        fit: &Fit,
        without: Option<ReducedFit>,
        around: &mut Option<Rc<Projections>>,
        allow: Additions,
        is_own: impl Fn(&Candidate) -> bool,
    ) -> Vec<Score> {
        let regression = self.regression;
        let Some(without) = without else {
            return Vec::new();
        };
        let around = around.get_or_insert_with(|| regression.projections(fit, allow.among()));
        let scores = regression.scan_without(around, &without);
        let enough = fit.ln_evidence - odds::OPEN.nats() - FIRST_ORDER - without.ln_evidence;
        let candidates = &regression.table.candidates;
        let other = |s: &Score| s.ln_odds > enough && !is_own(&candidates[s.candidate]);
        scores.into_iter().filter(other).collect()
    }

    fn best_addition(
        &self,
        reduced: &Fit,
        mut scores: Vec<Score>,
        allow: Additions,
        than: f64,
    ) -> Option<Fit> {
        scores.retain(|s| reduced.ln_evidence + s.ln_odds > than - odds::OPEN.nats() - FIRST_ORDER);
        self.retain_compatible(reduced, allow, &mut scores);
        by_odds(&mut scores);
        let mut best: Option<Fit> = None;
        for (_, next) in self.possible(reduced, scores.iter()).take(3) {
            let so_far = best.as_ref().map_or(than, |b| b.ln_evidence);
            if next.ln_evidence > so_far + 1e-3 {
                best = Some(next);
            }
        }
        best
    }

    /// Drops what is no longer needed given the others.
    fn drop(&self, fit: Fit) -> Fit {
        let mut fit = fit;
        loop {
            let mut best: Option<Fit> = None;
            let mut consider = |reduced: Fit, needed: f64| {
                let lost = fit.ln_evidence - reduced.ln_evidence;
                let gain = reduced.rss - fit.rss;
                if lost < needed || !self.matters(gain, &fit) {
                    let so_far = best.as_ref().map_or(f64::NEG_INFINITY, |b| b.ln_evidence);
                    if reduced.ln_evidence > so_far {
                        best = Some(reduced);
                    }
                }
            };
            let clear = |without: Option<ReducedFit>, needed: f64| {
                without.is_some_and(|reduced| {
                    fit.ln_evidence - reduced.ln_evidence > needed + FIRST_ORDER
                        && self.matters(SURELY * (reduced.rss - fit.rss), &fit)
                })
            };
            for term in self.regression.added(&fit) {
                let needed = needed(&fit, term);
                if !clear(self.regression.without(&fit, term), needed) {
                    consider(self.regression.without_term(&fit, term), needed);
                }
            }
            for index in 0..fit.shapes.len() {
                if !clear(self.regression.without_placed(&fit, index), NEEDED) {
                    consider(self.regression.without_shape(&fit, index), NEEDED);
                }
            }
            match best {
                Some(reduced) => fit = reduced,
                None => return fit,
            }
        }
    }

    /// Exchanges one or two terms for one or two others while that is likelier.
    pub(super) fn pairs(&self, fit: Fit) -> Result<Fit, Cancelled> {
        let mut fit = fit;
        for _ in 0..3 {
            self.report_found(&fit)?;
            if self.regression.work.is_over() {
                break;
            }
            let mut rivals = aliases::rivals(self.regression, &fit);
            rivals.retain(|r| self.count(&r.fit) <= self.most);
            let Some(best) = rivals.into_iter().next() else {
                break;
            };
            if best.fit.ln_evidence <= fit.ln_evidence + 1e-3 {
                break;
            }
            fit = self.drop(best.fit);
        }
        Ok(fit)
    }
}
