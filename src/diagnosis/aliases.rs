//! Rivals: other names that explain the same samples about as well. One or two terms of the model
//! are taken out and every name, and every pair of names, is tried in their place, singles against
//! pairs and pairs against pairs. What comes close is refitted before it is judged.

use nalgebra::{DMatrix, DVector};

use crate::effects::{Setting, Term};

use super::projected::Projected;
use super::regression::{Fit, PRICE_OF_A_NAME, Regression, Score};
use super::search::{by_odds, compatible};
use crate::fit::linear::{small_cholesky, small_gain};

/// Log-odds within which the samples cannot rule a rival out: about 20 : 1.
pub const UNDECIDED: f64 = 3.0;
/// Before the refit some more are kept.
const CLOSE: f64 = 6.0;
/// Rivals that are refitted.
const MOST_REFITTED: usize = 16;
/// Settings of one name that pairs are made from.
const SETTINGS: usize = 3;
/// In a larger model only single terms are taken out.
const MOST_FOR_PAIRS: usize = 5;

/// Another explanation.
#[derive(Debug, Clone)]
pub(crate) struct Rival {
    /// What it replaces.
    pub(crate) removed: Vec<Term>,
    /// By what.
    pub(crate) instead: Vec<Term>,
    /// The refitted model.
    pub(crate) fit: Fit,
}

impl Rival {
    /// Whether it differs by name, not only by setting.
    pub(crate) fn other_names(&self) -> bool {
        let names = |terms: &[Term]| {
            let mut names: Vec<(&str, usize)> = terms.iter().map(name).collect();
            names.sort_unstable();
            names.dedup();
            names
        };
        names(&self.removed) != names(&self.instead)
    }
}

fn name(term: &Term) -> (&'static str, usize) {
    (term.effect.about().id, term.joint)
}

/// Rivals without those that only add a name to another rival.
pub(crate) fn without_idle_names<'r>(rivals: &[&'r Rival]) -> Vec<&'r Rival> {
    let names = |terms: &[Term]| -> Vec<(&'static str, usize)> { terms.iter().map(name).collect() };
    let idle = |one: &Rival| {
        let own = names(&one.instead);
        rivals.iter().any(|other| {
            let fewer = names(&other.instead);
            names(&other.removed) == names(&one.removed)
                && fewer.len() < own.len()
                && fewer.iter().all(|n| own.contains(n))
        })
    };
    rivals.iter().copied().filter(|r| !idle(r)).collect()
}

/// Rivals that the samples cannot rule out, by other names than the fit's, likeliest first.
pub(crate) fn open_rivals(regression: &Regression, fit: &Fit) -> Vec<Rival> {
    let mut open = rivals(regression, fit);
    open.retain(|r| r.other_names() && r.fit.ln_evidence > fit.ln_evidence - UNDECIDED);
    let all: Vec<&Rival> = open.iter().collect();
    let kept = without_idle_names(&all);
    kept.into_iter().cloned().collect()
}

/// Ends of searches under another noise, as rivals: what each names in the place of what.
pub(crate) fn under_another_noise(regression: &Regression, fit: &Fit, ends: &[Fit]) -> Vec<Rival> {
    let only_in = |a: &Fit, b: &Fit| -> Vec<Term> {
        let there: Vec<_> = regression.added(b).into_iter().map(name).collect();
        let own = regression.added(a).into_iter();
        own.filter(|t| !there.contains(&name(t))).cloned().collect()
    };
    let rivals = ends.iter().map(|end| Rival {
        removed: only_in(fit, end),
        instead: only_in(end, fit),
        fit: end.clone(),
    });
    rivals
        .filter(|r| !r.removed.is_empty() && !r.instead.is_empty())
        .collect()
}

struct Trial {
    removed: Vec<Term>,
    rest: Fit,
    instead: Vec<usize>,
    ln_evidence: f64,
}

/// Rivals of a fit, likeliest first; those that are further off than [`CLOSE`] are left out.
pub(crate) fn rivals(regression: &Regression, fit: &Fit) -> Vec<Rival> {
    let added: Vec<Term> = regression.added(fit).into_iter().cloned().collect();
    let mut trials: Vec<Trial> = Vec::new();
    for (i, first) in added.iter().enumerate() {
        try_without(regression, fit, std::slice::from_ref(first), &mut trials);
        if added.len() > MOST_FOR_PAIRS {
            continue;
        }
        for second in &added[i + 1..] {
            try_without(
                regression,
                fit,
                &[first.clone(), second.clone()],
                &mut trials,
            );
        }
    }
    trials.sort_by(|a, b| b.ln_evidence.total_cmp(&a.ln_evidence));
    trials.truncate(MOST_REFITTED);
    let mut rivals: Vec<Rival> = Vec::new();
    for trial in trials {
        let term = |i: &usize| regression.table.candidates[*i].what.term().cloned();
        let instead: Vec<Term> = trial.instead.iter().filter_map(term).collect();
        let model = instead
            .iter()
            .fold(trial.rest.model.clone(), |m, t| m.with_term(t.clone()));
        let refitted = regression.fit(&model, trial.rest.shapes.clone());
        if refitted.ln_evidence > fit.ln_evidence - CLOSE {
            rivals.push(Rival {
                removed: trial.removed,
                instead,
                fit: refitted,
            });
        }
    }
    rivals.sort_by(|a, b| b.fit.ln_evidence.total_cmp(&a.fit.ln_evidence));
    rivals
}

fn try_without(regression: &Regression, fit: &Fit, removed: &[Term], trials: &mut Vec<Trial>) {
    let model = fit
        .model
        .without(|t| removed.iter().any(|r| r.same_column(t)));
    let rest = regression.fit(&model, fit.shapes.clone());
    let enough = fit.ln_evidence - CLOSE - rest.ln_evidence;
    let there = regression.added(&rest);
    let projected = regression.projected(&rest.basis);
    let mut scores = regression.scan_beside(&projected, &rest);
    let is_new = |s: &Score| {
        let term = regression.table.candidates[s.candidate].what.term();
        term.is_some_and(|t| compatible(&there, t) && !removed.iter().any(|r| r.same_column(t)))
    };
    scores.retain(is_new);
    let mut push = |instead: Vec<usize>, ln_odds: f64| {
        trials.push(Trial {
            removed: removed.to_vec(),
            rest: rest.clone(),
            instead,
            ln_evidence: rest.ln_evidence + ln_odds,
        });
    };
    by_odds(&mut scores);
    for score in scores.iter().filter(|s| s.ln_odds > enough).take(6) {
        push(vec![score.candidate], score.ln_odds);
    }
    let short = short_list(regression, &scores, removed);
    for (a, b, ln_odds) in best_pairs(regression, &projected, &rest, &short, enough) {
        push(vec![a, b], ln_odds);
    }
}

/// The best settings of every name that is not among the removed ones.
fn short_list(regression: &Regression, scores: &[Score], removed: &[Term]) -> Vec<usize> {
    let mut counts: Vec<((&str, usize), usize)> = Vec::new();
    let mut list = Vec::new();
    for score in scores {
        let Some(term) = regression.table.candidates[score.candidate].what.term() else {
            continue;
        };
        if removed.iter().any(|r| name(r) == name(term)) {
            continue;
        }
        let limit = match term.effect.about().setting {
            Setting::Order { to, .. } if to <= 6 => 5,
            _ => SETTINGS,
        };
        let at = counts.iter().position(|c| c.0 == name(term));
        let at = at.unwrap_or_else(|| {
            counts.push((name(term), 0));
            counts.len() - 1
        });
        if counts[at].1 < limit {
            counts[at].1 += 1;
            list.push(score.candidate);
        }
    }
    list
}

/// Pairs of candidates that together lower the sum of squares enough.
fn best_pairs(
    regression: &Regression,
    projected: &Projected,
    rest: &Fit,
    list: &[usize],
    enough: f64,
) -> Vec<(usize, usize, f64)> {
    let m = regression.m();
    // Each candidate made orthonormal by itself, and all their products at once.
    let mut units: Vec<DMatrix<f64>> = Vec::new();
    let mut pieces: Vec<(usize, usize, DVector<f64>)> = Vec::new();
    let mut width = 0;
    for index in list {
        let candidate = &regression.table.candidates[*index];
        let (factor, rank) = projected.factor(candidate);
        if rank < candidate.size {
            continue;
        }
        let k = candidate.size;
        let own = projected.columns(candidate);
        let l = DMatrix::from_fn(k, k, |i, j| if j <= i { factor[i * k + j] } else { 0.0 });
        let Some(unit) = l.solve_lower_triangular(&own.transpose()) else {
            continue;
        };
        let unit = unit.transpose();
        let h = unit.tr_mul(&rest.residual);
        pieces.push((*index, width, h));
        width += k;
        units.push(unit);
    }
    let mut all = DMatrix::zeros(regression.height(), width);
    for ((_, first, _), unit) in pieces.iter().zip(&units) {
        all.columns_mut(*first, unit.ncols()).copy_from(unit);
    }
    let products = all.transpose() * &all;
    let mut pairs = Vec::new();
    for (i, (a, at_a, h_a)) in pieces.iter().enumerate() {
        for (b, at_b, h_b) in &pieces[i + 1..] {
            let (ca, cb) = (
                &regression.table.candidates[*a],
                &regression.table.candidates[*b],
            );
            let bound = h_a.norm_squared() + h_b.norm_squared();
            let price = ca.tried.max(1.0).ln() + cb.tried.max(1.0).ln() + 2.0 * PRICE_OF_A_NAME;
            let worth = |gain: f64, rank: usize| {
                let r2 = (gain / rest.rss.max(1e-300)).clamp(0.0, 1.0 - 1e-12);
                -0.5 * m * (-r2).ln_1p() - 0.5 * rank as f64 * m.ln() - price
            };
            // Correlated candidates can do more together than the sum of both, but seldom: a
            // quick look saves the rest.
            if worth(4.0 * bound, 2) < enough {
                continue;
            }
            let terms = [ca, cb].map(|c| c.what.term());
            if let [Some(ta), Some(tb)] = terms
                && !compatible(&[ta], tb)
            {
                continue;
            }
            let cross = products
                .view((*at_a, *at_b), (ca.size, cb.size))
                .into_owned();
            let k = cb.size;
            let schur = DMatrix::identity(k, k) - cross.tr_mul(&cross);
            let mut g: Vec<f64> = (0..k * k).map(|x| schur[(x / k, x % k)]).collect();
            let tolerance = vec![1e-5; k];
            let rank = small_cholesky(&mut g, k, &tolerance);
            if rank == 0 {
                continue;
            }
            let left = h_b - cross.tr_mul(h_a);
            let mut h: Vec<f64> = left.iter().copied().collect();
            let gain = h_a.norm_squared() + small_gain(&g, k, &mut h);
            let ln_odds = worth(gain, ca.size + rank);
            if ln_odds > enough {
                pairs.push((*a, *b, ln_odds));
            }
        }
    }
    pairs.sort_by(|a, b| b.2.total_cmp(&a.2));
    pairs.truncate(8);
    pairs
}
