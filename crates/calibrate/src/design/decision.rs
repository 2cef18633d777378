//! The probability that poses decide which of several explanations is true, all of them at once.
//!
//! Each explanation that may be true is drawn many times: its parameters from what the samples say
//! of them, `β ~ N(β̂, C)`, and noise at every new pose. Every explanation is then refitted to the
//! old samples and the new poses together. With `z` the deviation of the new poses from what
//! explanation j predicts and J its columns there, its sum of squares rises by
//!
//! ```text
//! Q_j = zᵀ (1 + J C Jᵀ)⁻¹ z
//! ```
//!
//! which a Kalman filter carries on pose by pose, and its log-evidence over n rows falls by
//! `(m + n)/2 ln(rss_j + Q_j)`. A draw is decided where the true explanation leads every other by
//! the odds that a diagnosis asks for. This counts what a single separation Δ does not: several
//! rivals at once, rivals of rivals, rivals that are ruled out now and may come back, and sizes
//! that the samples know poorly (one radius, one speed).

use nalgebra::DMatrix;
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::comparison::{Comparison, Field, Refit};
use crate::diagnosis::evidence::Fit;
use crate::diagnosis::search::other_settings::at_another_setting;
use crate::effects::Term;

/// Probability that the poses decide, whichever explanation is true. It is above the 95 % that are
/// promised by what the draws do not know: their own error, and tests beside the odds.
pub(crate) const SURE: f64 = 0.98;
/// Draws of each explanation: the probability is known to about one in a hundred.
const DRAWS: usize = 250;
/// What the samples say nothing of is drawn so small that it moves a pose by this many standard
/// deviations of the noise.
const WIDEST: f64 = 10.0;
/// A pair that stays open in nearly every draw is not parted by any pose.
const HOPELESS: f64 = 0.05;

pub(crate) struct Explanation {
    pub(crate) fit: Fit,
    /// Whether the samples leave it open; the others are ruled out and have to stay so.
    pub(crate) open: bool,
    /// Whether it differs from the first by the settings of its names alone, and is to be told from it.
    pub(crate) setting: bool,
}

/// Whether two fits have the same names, of which one is at another setting.
pub(crate) fn only_settings_differ(one: &Fit, other: &Fit) -> bool {
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
    first: usize,
}

pub(crate) struct Decision {
    /// Each explanation as it is refitted in every draw, relative to the first.
    refits: Vec<Refit>,
    /// Sum of squares and log-evidence of each so far.
    so_far: Vec<(f64, f64)>,
    truths: Vec<Truth>,
    /// For each pair whether a diagnosis would have to tell them apart.
    differ: Vec<Vec<bool>>,
    random: ChaCha8Rng,
    rows: f64,
    new_rows: f64,
    wanted: f64,
    /// For each pose taken, and each truth, in how many draws which rivals are ruled out.
    history: Vec<Vec<DMatrix<u8>>>,
}

impl Decision {
    /// Among explanations, at least one; `wanted` are the odds (a logarithm) that decide.
    pub(crate) fn new(field: &Field, explanations: &[Explanation], wanted: f64) -> Self {
        let regression = field.regression;
        let mut random = ChaCha8Rng::seed_from_u64(0);
        let draws = DRAWS * explanations.iter().filter(|e| e.open).count();
        let (mut refits, mut truths) = (Vec::new(), Vec::new());
        for (index, Explanation { fit, open, .. }) in explanations.iter().enumerate() {
            let predictions = field.predictions(&explanations[0].fit.model, &fit.model);
            let information = field.gram(&fit.model);
            let refit = Refit::new(predictions, &information, draws);
            if *open {
                truths.push(Truth {
                    index,
                    parameters: drawn(&information, &refit, &mut random),
                    first: truths.len() * DRAWS,
                });
            }
            refits.push(refit);
        }
        let names = |e: &Explanation| -> Vec<(&'static str, usize)> {
            let added = regression.added(&e.fit).into_iter();
            added.map(|t| (t.effect.about().id, t.joint)).collect()
        };
        let names: Vec<_> = explanations.iter().map(names).collect();
        let within = |a: &[_], b: &[_]| a.iter().all(|n| b.contains(n));
        let setting = |a: usize, b: usize| {
            (explanations[a].setting || explanations[b].setting)
                && only_settings_differ(&explanations[a].fit, &explanations[b].fit)
        };
        let differ = |a: usize| -> Vec<bool> {
            let of = |b: usize| {
                let (own, other) = (&names[a], &names[b]);
                setting(a, b) || !within(own, other) && !within(other, own)
            };
            (0..names.len()).map(of).collect()
        };
        Self {
            so_far: explanations
                .iter()
                .map(|e| (e.fit.rss, e.fit.ln_evidence))
                .collect(),
            differ: (0..names.len()).map(differ).collect(),
            refits,
            truths,
            random,
            rows: regression.m(),
            new_rows: 0.0,
            wanted,
            history: Vec::new(),
        }
    }

    /// Every explanation, refitted to what each shows that may be true and is to be told from it;
    /// `enough` is how far apart the true one and the other have to be.
    pub(crate) fn comparisons(&self, enough: impl Fn(usize, usize) -> f64) -> Vec<Comparison> {
        let of = |other: usize| {
            let truths = self.truths.iter().map(|truth| truth.index);
            let truths = truths.filter(|truth| self.differ[*truth][other]);
            let pair = |truth: usize| (&self.refits[truth], enough(truth, other));
            self.refits[other].comparison(truths.map(pair))
        };
        let mut all: Vec<Comparison> = (0..self.refits.len()).map(of).collect();
        all.retain(|comparison| !comparison.distances.is_empty());
        all
    }

    /// Measures a pose in every draw.
    pub(crate) fn take(&mut self, candidate: usize) {
        let draws = self.truths.len() * DRAWS;
        let axes = self.refits[0].at(candidate).0.len();
        // Measured values are relative to the first explanation.
        let mut measured = DMatrix::zeros(axes, draws);
        for truth in &self.truths {
            let (difference, columns) = self.refits[truth.index].at(candidate);
            let mut block = columns * &truth.parameters;
            for mut column in block.column_iter_mut() {
                column -= &difference;
            }
            measured.columns_mut(truth.first, DRAWS).copy_from(&block);
        }
        let random = &mut self.random;
        measured.apply(|v| {
            let noise: f64 = StandardNormal.sample(random);
            *v += noise;
        });
        for refit in &mut self.refits {
            refit.take(candidate, Some(&measured));
        }
        self.new_rows += axes as f64;
        let now = self.ruled_out();
        self.history.push(now);
    }

    /// For each truth which rivals are ruled out in which draws.
    fn ruled_out(&self) -> Vec<DMatrix<u8>> {
        let rows = self.rows + self.new_rows;
        let evidence = |index: usize, draw: usize| {
            let (rss, ln_evidence) = self.so_far[index];
            let before = ln_evidence + 0.5 * self.rows * rss.max(1e-300).ln();
            let risen = self.refits[index].risen[draw];
            before - 0.5 * rows * (rss + risen).max(1e-300).ln()
        };
        let of = |truth: &Truth| {
            DMatrix::from_fn(self.refits.len(), DRAWS, |other, k| {
                let draw = truth.first + k;
                let lead = evidence(truth.index, draw) - evidence(other, draw);
                u8::from(!self.differ[truth.index][other] || lead >= self.wanted)
            })
        };
        self.truths.iter().map(of).collect()
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
            rows.map(|row| share(row.iter()) > HOPELESS).collect()
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

    /// Pairs that a diagnosis has to tell apart.
    fn pairs(&self) -> usize {
        let of = |truth: &Truth| self.differ[truth.index].iter().filter(|d| **d).count();
        self.truths.iter().map(of).sum()
    }
}

fn share<'v>(values: impl Iterator<Item = &'v u8>) -> f64 {
    values.map(|v| f64::from(*v)).sum::<f64>() / DRAWS as f64
}

/// The smallest share of draws, over the truths, in which every rival that counts is ruled out.
fn least(now: &[DMatrix<u8>], counts: impl Fn(usize, usize) -> bool) -> f64 {
    let of = |(truth, out): (usize, &DMatrix<u8>)| {
        let decided = |draw: &usize| {
            (0..out.nrows()).all(|other| !counts(truth, other) || out[(other, *draw)] == 1)
        };
        (0..DRAWS).filter(decided).count() as f64 / DRAWS as f64
    };
    now.iter().enumerate().map(of).fold(1.0, f64::min)
}

/// Deviations of a model's parameters as the samples leave them possible.
fn drawn(information: &DMatrix<f64>, refit: &Refit, random: &mut ChaCha8Rng) -> DMatrix<f64> {
    let p = information.nrows();
    let mut known = information.clone();
    for (k, squares) in refit.squares().into_iter().enumerate() {
        let mean = squares / refit.len().max(1) as f64;
        known[(k, k)] += mean / (WIDEST * WIDEST);
    }
    let scale = |k: usize| {
        if known[(k, k)] > 1e-200 {
            1.0 / known[(k, k)].sqrt()
        } else {
            0.0
        }
    };
    let scaled = DMatrix::from_fn(p, p, |i, j| {
        known[(i, j)] * scale(i) * scale(j) + if i == j { 1e-12 } else { 0.0 }
    });
    let white = DMatrix::from_fn(p, DRAWS, |_, _| StandardNormal.sample(random));
    let factor = scaled.cholesky();
    let Some(mut all) = factor.and_then(|c| c.l().transpose().solve_upper_triangular(&white))
    else {
        return DMatrix::zeros(p, DRAWS);
    };
    for (k, mut row) in all.row_iter_mut().enumerate() {
        row *= scale(k);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_least_share_counts_only_what_is_asked_for() {
        let mut out = DMatrix::from_element(2, DRAWS, 1_u8);
        out.row_mut(1).fill(0);
        let now = [out];
        assert!(least(&now, |_, _| true) <= 0.0);
        assert!(least(&now, |_, other| other == 0) >= 1.0);
    }
}
