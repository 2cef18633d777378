//! The probability that poses decide which of several explanations is true, all of them at once.
//!
//! Each explanation that may be true is drawn many times: its parameters from their distribution given the samples, `β
//! ~ N(β̂, C)`, and noise at every new pose. Every explanation is then refitted to the old samples and the new poses
//! together. With `z` the deviation of the new poses from the prediction of explanation j and J its columns there, its
//! sum of squares rises by
//!
//! ```text
//! Q_j = zᵀ (1 + J C Jᵀ)⁻¹ z
//! ```
//!
//! which a Kalman filter updates pose by pose, and its log-evidence over n rows falls by
//! `(m + n)/2 ln(rss_j + Q_j)`. A draw is decided where the true explanation leads every other by
//! the odds that a diagnosis asks for. This counts what a single separation Δ does not: several
//! rivals at once, rivals of rivals, rivals that are ruled out now and may come back, and sizes
//! that the samples know poorly (one radius, one speed).

use std::sync::Arc;

use nalgebra::DMatrix;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::candidate_poses::CandidatePoses;
use super::comparison::{Comparison, ModelDistance, enough_for};
use super::covariance;
use super::rows::Rows;
use crate::diagnosis::evidence::Fit;
use crate::diagnosis::search::other_settings::at_another_setting;
use crate::effects::Term;
use crate::{budget, odds};

/// Probability that the poses decide, whichever explanation is true. It is above the 95 % that are promised, as the
/// draws neglect their own error, and tests besides the odds.
pub(crate) const SURE: f64 = 0.98;
/// What the samples do not determine is drawn so small that it moves a pose by this many standard deviations of the
/// noise.
pub(super) const WIDEST: f64 = 10.0;

pub(crate) struct Explanation {
    pub(crate) fit: Fit,
    /// Whether the samples leave it possible; the others are ruled out and have to stay so.
    pub(crate) open: bool,
}

/// Whether two fits have the same names, of which one is at another setting.
fn only_settings_differ(one: &Fit, other: &Fit) -> bool {
    let (a, b) = (one.model.terms(), other.model.terms());
    let other_setting = |t: &&Term| !b.iter().any(|o| o.same_column(t));
    let moved: Vec<&Term> = a.iter().filter(other_setting).collect();
    let again = |t: &&Term| b.iter().any(|o| at_another_setting(t, o));
    a.len() == b.len() && !moved.is_empty() && moved.iter().all(again)
}

/// Draws of one explanation that is taken for the true one.
struct Truth {
    index: usize,
    /// Deviations of the parameters by draws.
    parameters: DMatrix<f64>,
}

pub(crate) struct Decision {
    /// Sum of squares and log-evidence of each explanation so far.
    so_far: Vec<(f64, f64)>,
    truths: Vec<Truth>,
    /// For each pair whether a diagnosis would have to distinguish them.
    differ: Vec<Vec<bool>>,
    random: ChaCha8Rng,
    rows: f64,
    new_rows: f64,
    /// For each pose taken, and each truth, in how many draws which rivals are ruled out.
    history: Vec<Vec<DMatrix<u8>>>,
}

impl Decision {
    /// Among explanations, at least one; and each of them as it is refitted to the predictions of every other that may
    /// be true and has to be distinguished from it. Their rows are relative to the first.
    pub(crate) fn new(
        offer: &CandidatePoses,
        explanations: &[Explanation],
    ) -> (Self, Vec<Comparison>) {
        let mut random = ChaCha8Rng::seed_from_u64(0);
        let (mut rows, mut grams, mut truths) = (Vec::new(), Vec::new(), Vec::new());
        for (index, Explanation { fit, open, .. }) in explanations.iter().enumerate() {
            let own = offer.rows(&explanations[0].fit.model, &fit.model);
            let gram = offer.gram(&fit.model);
            if *open {
                truths.push(Truth {
                    index,
                    parameters: drawn(&gram, &own, &mut random),
                });
            }
            rows.push(Arc::new(own));
            grams.push(gram);
        }
        let differ = to_distinguish(offer, explanations);
        let comparison = |(other, gram): (usize, &DMatrix<f64>)| {
            let own = &rows[other];
            let against = truths.iter().map(|truth| truth.index);
            let distance = |truth: usize| {
                let ln_evidence = |k: usize| explanations[k].fit.ln_evidence;
                let enough = enough_for(odds::OPEN.nats(), ln_evidence(truth) - ln_evidence(other));
                ModelDistance::new(&own.difference - &rows[truth].difference, enough)
            };
            let distances = against.filter(|truth| differ[*truth][other]).map(distance);
            let covariance = covariance::given_samples(gram, own);
            let draws = truths.len() * budget::DRAWS;
            Comparison::new(Arc::clone(own), covariance, distances.collect(), draws)
        };
        let comparisons = grams.iter().enumerate().map(comparison).collect();
        let so_far = explanations.iter().map(|e| (e.fit.rss, e.fit.ln_evidence));
        let decision = Self {
            so_far: so_far.collect(),
            differ,
            truths,
            random,
            rows: offer.regression.m(),
            new_rows: 0.0,
            history: Vec::new(),
        };
        (decision, comparisons)
    }

    /// Measures a pose in every draw.
    pub(crate) fn take(&mut self, comparisons: &mut [Comparison], candidate: usize) {
        let (first, size) = comparisons[0].rows().place(candidate);
        // Measured values are relative to the first explanation.
        let mut measured = DMatrix::zeros(size, self.truths.len() * budget::DRAWS);
        for (k, truth) in self.truths.iter().enumerate() {
            let rows = comparisons[truth.index].rows();
            let mut block = rows.of(candidate).tr_mul(&truth.parameters);
            let difference = rows.difference.rows(first, size);
            block
                .column_iter_mut()
                .for_each(|mut own| own -= difference);
            measured
                .columns_mut(k * budget::DRAWS, budget::DRAWS)
                .copy_from(&block);
        }
        let random = &mut self.random;
        measured.apply(|v| {
            let noise: f64 = StandardNormal.sample(random);
            *v += noise;
        });
        for comparison in comparisons.iter_mut() {
            comparison.take(candidate, Some(&measured));
        }
        self.new_rows += size as f64;
        let now = self.ruled_out(comparisons);
        self.history.push(now);
    }

    /// For each truth which rivals are ruled out in which draws.
    fn ruled_out(&self, comparisons: &[Comparison]) -> Vec<DMatrix<u8>> {
        let rows = self.rows + self.new_rows;
        let evidence = |index: usize, draw: usize| {
            let (rss, ln_evidence) = self.so_far[index];
            let before = ln_evidence + 0.5 * self.rows * rss.max(1e-300).ln();
            let risen = comparisons[index].risen[draw];
            before - 0.5 * rows * (rss + risen).max(1e-300).ln()
        };
        let of = |(t, truth): (usize, &Truth)| {
            DMatrix::from_fn(comparisons.len(), budget::DRAWS, |other, k| {
                let draw = t * budget::DRAWS + k;
                let lead = evidence(truth.index, draw) - evidence(other, draw);
                u8::from(!self.differ[truth.index][other] || lead >= odds::OPEN.nats())
            })
        };
        self.truths.iter().enumerate().map(of).collect()
    }

    /// The probability that the poses so far decide, whichever explanation is true.
    pub(crate) fn probability(&self) -> f64 {
        self.history
            .last()
            .map_or(0.0, |now| least(now, |_, _| true))
    }

    /// How many of the poses are needed for `wanted`, or for hardly less than all of them bring
    /// where that is less; how many pairs none of the poses part, and the probability that so many poses
    /// decide all others, whichever explanation is true.
    pub(crate) fn needed(&self, wanted: f64) -> (usize, usize, f64) {
        let Some(last) = self.history.last() else {
            return (0, self.pairs(), 0.0);
        };
        let parted = |out: &DMatrix<u8>| -> Vec<bool> {
            let rows = out.row_iter();
            rows.map(|row| share(row.iter()) > odds::OPEN.chance())
                .collect()
        };
        let parted: Vec<Vec<bool>> = last.iter().map(parted).collect();
        let unparted = parted.iter().flatten().filter(|parted| !**parted).count();
        let counts = |truth: usize, other: usize| parted[truth][other];
        let target = wanted.min(least(last, counts) - 0.01);
        let mut reached = self.history.iter().map(|now| least(now, counts));
        // Where nothing is parted, every bit helps.
        let at = reached.position(|share| share >= target && unparted < self.pairs());
        let poses = at.map_or(self.history.len(), |at| at + 1);
        let probability = least(&self.history[poses - 1], counts);
        (poses, unparted, probability)
    }

    /// Pairs that a diagnosis has to distinguish.
    fn pairs(&self) -> usize {
        let of = |truth: &Truth| self.differ[truth.index].iter().filter(|d| **d).count();
        self.truths.iter().map(of).sum()
    }
}

fn share<'v>(values: impl Iterator<Item = &'v u8>) -> f64 {
    values.map(|v| f64::from(*v)).sum::<f64>() / budget::DRAWS as f64
}

/// The smallest share of draws, over the truths, in which every rival that counts is ruled out.
fn least(now: &[DMatrix<u8>], counts: impl Fn(usize, usize) -> bool) -> f64 {
    let of = |(truth, out): (usize, &DMatrix<u8>)| {
        let decided = |draw: &usize| {
            (0..out.nrows()).all(|other| !counts(truth, other) || out[(other, *draw)] == 1)
        };
        (0..budget::DRAWS).filter(decided).count() as f64 / budget::DRAWS as f64
    };
    now.iter().enumerate().map(of).fold(1.0, f64::min)
}

/// For each pair of explanations whether a diagnosis has to distinguish them: neither has all names of the other, or
/// one of them differs from the first by the settings of its names alone, and the other from it.
fn to_distinguish(offer: &CandidatePoses, explanations: &[Explanation]) -> Vec<Vec<bool>> {
    let names = |e: &Explanation| -> Vec<(&'static str, usize)> {
        let added = offer.regression.added(&e.fit).into_iter();
        added.map(|t| (t.effect.about().id, t.joint)).collect()
    };
    let names: Vec<_> = explanations.iter().map(names).collect();
    let within = |a: &[_], b: &[_]| a.iter().all(|n| b.contains(n));
    let by_setting =
        |a: usize, b: usize| only_settings_differ(&explanations[a].fit, &explanations[b].fit);
    let differ = |a: usize, b: usize| {
        let setting = (by_setting(0, a) || by_setting(0, b)) && by_setting(a, b);
        setting || !within(&names[a], &names[b]) && !within(&names[b], &names[a])
    };
    let all = 0..names.len();
    let row = |a| all.clone().map(|b| differ(a, b)).collect();
    all.clone().map(row).collect()
}

/// Random deviations of a model's parameters within their uncertainty given the samples.
fn drawn(gram: &DMatrix<f64>, rows: &Rows, random: &mut ChaCha8Rng) -> DMatrix<f64> {
    let mut known = gram.clone();
    for (k, squares) in rows.squares().into_iter().enumerate() {
        known[(k, k)] += squares / rows.len().max(1) as f64 / (WIDEST * WIDEST);
    }
    let white = DMatrix::from_fn(gram.nrows(), budget::DRAWS, |_, _| {
        StandardNormal.sample(random)
    });
    covariance::drawn(&known, &white)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_share_counts_only_what_is_asked_for() {
        let mut out = DMatrix::from_element(2, budget::DRAWS, 1_u8);
        out.row_mut(1).fill(0);
        let now = [out];
        assert!(least(&now, |_, _| true) <= 0.0);
        assert!(least(&now, |_, other| other == 0) >= 1.0);
    }
}
