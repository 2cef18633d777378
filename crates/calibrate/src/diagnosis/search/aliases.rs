//! Rivals: other names that explain the same samples about as well. One or two terms of the model
//! are taken out and every name, and every pair of names, is tried in their place, singles against
//! pairs and pairs against pairs. What comes close is refitted before it is judged.

use super::prepare::MANY_NAMES;
use crate::diagnosis::evidence::{
    EFFECT_PRIOR_PENALTY, Fit, MOST_SETTINGS, Regression, Score, by_odds, projected_units,
};
use crate::lanes::LANES;
use crate::{budget, odds};
use std::collections::BTreeMap;
use std::rc::Rc;

use nalgebra::{DMatrix, DVector};

use crate::effects::{Setting, Term};

use crate::diagnosis::candidates::columns::CandidateSubset;
use crate::diagnosis::candidates::compatible;
use crate::diagnosis::candidates::table::Candidate;
use crate::diagnosis::evidence::rival::{Rival, name};
use crate::linear::{small_cholesky, small_gain};
/// Single names that are tried.
const ALONE: usize = 8;
/// A gain that is known to first order may be so many times as much.
const MORE: f64 = 1.2;

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
    open.retain(|r| r.other_names() && r.fit.ln_evidence > fit.ln_evidence - odds::OPEN.nats());
    let all: Vec<&Rival> = open.iter().collect();
    let kept = without_idle_names(&all);
    kept.into_iter().cloned().collect()
}

/// Ends of searches under another noise, as rivals: what each names in the place of what. Where one only names more,
/// as where a drift may be a name as well, all its names replace all of the fit's.
pub(crate) fn under_another_noise(regression: &Regression, fit: &Fit, ends: &[Fit]) -> Vec<Rival> {
    let all = |of: &Fit| -> Vec<Term> { regression.added(of).into_iter().cloned().collect() };
    let only_in = |a: &Fit, b: &Fit| -> Vec<Term> {
        let there: Vec<_> = regression.added(b).into_iter().map(name).collect();
        let mut own = all(a);
        own.retain(|t| !there.contains(&name(t)));
        own
    };
    let rivals = ends.iter().map(|end| {
        let (removed, instead) = (only_in(fit, end), only_in(end, fit));
        let more = removed.is_empty() && !instead.is_empty();
        Rival {
            removed: if more { all(fit) } else { removed },
            instead: if more { all(end) } else { instead },
            fit: end.clone(),
        }
    });
    rivals
        .filter(|r| !r.removed.is_empty() && !r.instead.is_empty())
        .collect()
}

struct RivalTrial {
    removed: Vec<Term>,
    reduced: Rc<Fit>,
    instead: Vec<usize>,
    ln_evidence: f64,
}

/// Rivals of a fit, likeliest first; those that are further off than [`odds::TAKEN`] are left out.
pub(crate) fn rivals(regression: &Regression, fit: &Fit) -> Vec<Rival> {
    regression.rivals.of(fit, || tried(regression, fit))
}

fn tried(regression: &Regression, fit: &Fit) -> Vec<Rival> {
    let added: Vec<Term> = regression.added(fit).into_iter().cloned().collect();
    let mut trials: Vec<RivalTrial> = Vec::new();
    for (i, first) in added.iter().enumerate() {
        try_without(regression, fit, std::slice::from_ref(first), &mut trials);
        if added.len() > MANY_NAMES {
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
    let refitted = trials.into_iter().map(|trial| {
        let term = |i: &usize| regression.table.candidates[*i].what.term().cloned();
        let instead: Vec<Term> = trial.instead.iter().filter_map(term).collect();
        let model = instead
            .iter()
            .fold(trial.reduced.model.clone(), |m, t| m.with_term(t.clone()));
        Rival {
            removed: trial.removed,
            instead,
            fit: regression.fit(&model, &trial.reduced.shapes),
        }
    });
    // Candidates that their own values rule out do not count among those that are refitted.
    let possible = refitted.filter(|r| r.fit.ln_evidence.is_finite());
    let mut rivals: Vec<Rival> = possible.take(MOST_SETTINGS).collect();
    rivals.retain(|r| r.fit.ln_evidence > fit.ln_evidence - odds::TAKEN.nats());
    rivals.sort_by(|a, b| b.fit.ln_evidence.total_cmp(&a.fit.ln_evidence));
    rivals
}

fn try_without(regression: &Regression, fit: &Fit, removed: &[Term], trials: &mut Vec<RivalTrial>) {
    let model = fit
        .model
        .without(|t| removed.iter().any(|r| r.same_column(t)));
    let reduced = Rc::new(regression.fit(&model, &fit.shapes));
    let enough = fit.ln_evidence - odds::TAKEN.nats() - reduced.ln_evidence;
    let there = regression.added(&reduced);
    // By the first-order table of the whole fit; what comes close is refitted.
    let mut scores = match regression.without_all(fit, removed) {
        Some(without) => {
            let around = regression.projections(fit, CandidateSubset::Names);
            regression.scan_without(&around, &without)
        }
        None => regression.scan(&reduced, CandidateSubset::Names),
    };
    let is_new = |s: &Score| {
        let term = regression.table.candidates[s.candidate].what.term();
        term.is_some_and(|t| compatible(&there, t) && !removed.iter().any(|r| r.same_column(t)))
    };
    scores.retain(is_new);
    let mut push = |instead: Vec<usize>, ln_odds: f64| {
        trials.push(RivalTrial {
            removed: removed.to_vec(),
            reduced: Rc::clone(&reduced),
            instead,
            ln_evidence: reduced.ln_evidence + ln_odds,
        });
    };
    by_odds(&mut scores);
    let close = scores.iter().filter(|s| s.ln_odds > enough);
    let alone = best_of_each(regression, close, |_| budget::LIKELIEST);
    for score in alone.into_iter().take(ALONE) {
        push(vec![score.candidate], score.ln_odds);
    }
    let others = scores.iter().filter(|s| {
        let term = regression.table.candidates[s.candidate].what.term();
        term.is_some_and(|t| !removed.iter().any(|r| name(r) == name(t)))
    });
    let short = short_list(regression, others);
    for (a, b, ln_odds) in best_pairs(regression, &reduced, &short, enough) {
        push(vec![a, b], ln_odds);
    }
}

/// A fit with two names more, for each pair whose gain is at least this, as a logarithm; the likeliest by the scan
/// first. Two that nearly cancel each other, such as a base that is too high and a link that droops, gain little one
/// by one.
pub(crate) fn with_pairs<'f>(
    regression: &'f Regression,
    fit: &'f Fit,
    enough: f64,
) -> impl Iterator<Item = Fit> + use<'f> {
    let there = regression.added(fit);
    let mut scores = regression.scan(fit, CandidateSubset::Names);
    scores.retain(|s| {
        let term = regression.table.candidates[s.candidate].what.term();
        term.is_some_and(|t| compatible(&there, t))
    });
    by_odds(&mut scores);
    let short = short_list(regression, scores.iter());
    let pairs = best_pairs(regression, fit, &short, enough);
    pairs.into_iter().map(|(a, b, _)| {
        let terms = [a, b].map(|c| regression.table.candidates[c].what.term().cloned());
        let terms = terms.into_iter().flatten();
        let model = terms.fold(fit.model.clone(), |m, t| m.with_term(t));
        regression.fit(&model, &fit.shapes)
    })
}

/// The candidates that pairs are made from.
fn short_list<'s>(
    regression: &Regression,
    scores: impl Iterator<Item = &'s Score>,
) -> Vec<&'s Score> {
    best_of_each(regression, scores, |term| {
        match term.effect.about().setting {
            setting @ Setting::Order { .. } if !setting.takes_fractions() => 5,
            _ => budget::LIKELIEST,
        }
    })
}

/// Of scores in order, at most so many settings of every name.
fn best_of_each<'s>(
    regression: &Regression,
    scores: impl Iterator<Item = &'s Score>,
    most: impl Fn(&Term) -> usize,
) -> Vec<&'s Score> {
    let mut counts: BTreeMap<(&str, usize), usize> = BTreeMap::new();
    let mut kept = Vec::new();
    for score in scores {
        let Some(term) = regression.table.candidates[score.candidate].what.term() else {
            continue;
        };
        let count = counts.entry(name(term)).or_default();
        if *count < most(term) {
            *count += 1;
            kept.push(score);
        }
    }
    kept
}

/// A candidate with orthonormal columns.
struct Piece {
    candidate: usize,
    /// Its first column among those of all.
    first: usize,
    /// Its first row among those that may be the better one of a pair.
    row: Option<usize>,
    /// Its products with the residual.
    h: DVector<f64>,
}

/// Pairs of candidates that together lower the sum of squares enough.
fn best_pairs(
    regression: &Regression,
    reduced: &Fit,
    scores: &[&Score],
    enough: f64,
) -> Vec<(usize, usize, f64)> {
    let m = regression.m();
    let worth = |gain: f64, rank: usize, price: f64| {
        let r2 = (gain / reduced.rss.max(1e-300)).clamp(0.0, 1.0 - 1e-12);
        -0.5 * m * (-r2).ln_1p() - 0.5 * rank as f64 * m.ln() - price
    };
    // Correlated candidates can gain more together than the sum of both, but seldom: a quick bound saves the
    // computation.
    let hopeless = |bound: f64, price: f64| worth(4.0 * bound, 2, price) < enough;
    // Nothing is computed of candidates that can never be the better one of a pair.
    let best = scores.iter().map(|s| s.gain).fold(0.0, f64::max);
    if hopeless(2.0 * MORE * best, 2.0 * EFFECT_PRIOR_PENALTY) {
        return Vec::new();
    }
    let list: Vec<usize> = scores.iter().map(|s| s.candidate).collect();
    // Each candidate made orthonormal alone. The better one of a pair gains half of it at least: products with those
    // that may be the better one are all that is needed.
    let mut pieces: Vec<Piece> = Vec::new();
    let mut all: Vec<f64> = Vec::new();
    let mut better: Vec<f64> = Vec::new();
    let (mut first, mut width) = (0, 0);
    for some in list.chunks(LANES) {
        let candidate = |index: &usize| &regression.table.candidates[*index];
        let own: Vec<&Candidate> = some.iter().map(candidate).collect();
        let sizes = own.iter().map(|c| c.size);
        let units = projected_units(regression.white_columns(&own), sizes, &reduced.basis);
        for (index, unit) in some.iter().zip(units) {
            let Some(unit) = unit else {
                continue;
            };
            let k = unit.ncols();
            let h = unit.tr_mul(&reduced.residual);
            let may_be_better = !hopeless(2.0 * h.norm_squared(), 2.0 * EFFECT_PRIOR_PENALTY);
            all.extend(unit.as_slice());
            if may_be_better {
                better.extend(unit.as_slice());
            }
            pieces.push(Piece {
                candidate: *index,
                first,
                row: may_be_better.then_some(width),
                h,
            });
            first += k;
            width += if may_be_better { k } else { 0 };
        }
    }
    let height = regression.height();
    let better = DMatrix::from_vec(height, width, better).transpose();
    let products = better * DMatrix::from_vec(height, first, all);
    let mut pairs = Vec::new();
    for (i, a) in pieces.iter().enumerate() {
        for b in &pieces[i + 1..] {
            if a.row.is_none() && b.row.is_none() {
                continue;
            }
            let (ca, cb) = (
                &regression.table.candidates[a.candidate],
                &regression.table.candidates[b.candidate],
            );
            let price =
                ca.tried.max(1.0).ln() + cb.tried.max(1.0).ln() + 2.0 * EFFECT_PRIOR_PENALTY;
            if hopeless(a.h.norm_squared() + b.h.norm_squared(), price) {
                continue;
            }
            let terms = [ca, cb].map(|c| c.what.term());
            if let [Some(ta), Some(tb)] = terms
                && !compatible(&[ta], tb)
            {
                continue;
            }
            let cross = match (a.row, b.row) {
                (Some(row), _) => products
                    .view((row, b.first), (ca.size, cb.size))
                    .into_owned(),
                (None, row) => products
                    .view((row.unwrap_or(0), a.first), (cb.size, ca.size))
                    .transpose(),
            };
            let k = cb.size;
            let schur = DMatrix::identity(k, k) - cross.tr_mul(&cross);
            let mut g: Vec<f64> = (0..k * k).map(|x| schur[(x / k, x % k)]).collect();
            let tolerance = vec![1e-5; k];
            let rank = small_cholesky(&mut g, k, &tolerance);
            if rank == 0 {
                continue;
            }
            let projected = &b.h - cross.tr_mul(&a.h);
            let mut h: Vec<f64> = projected.iter().copied().collect();
            let gain = a.h.norm_squared() + small_gain(&g, k, &mut h);
            let ln_odds = worth(gain, ca.size + rank, price);
            if ln_odds > enough {
                pairs.push((a.candidate, b.candidate, ln_odds));
            }
        }
    }
    pairs.sort_by(|a, b| b.2.total_cmp(&a.2));
    pairs.truncate(8);
    pairs
}
