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

use nalgebra::{DMatrix, DVector};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::comparison::{Axes, Prediction, covariance_of, predictions};
use super::next_poses::gram;
use crate::diagnosis::regression::{Fit, Regression};
use crate::effects::Inputs;

/// Draws of each explanation: the probability is known to about one in a hundred.
const DRAWS: usize = 250;
/// What the samples say nothing of is drawn so small that it moves a pose by this many standard
/// deviations of the noise.
const WIDEST: f64 = 10.0;
/// A pair that stays open in nearly every draw is not parted by any pose.
const HOPELESS: f64 = 0.05;

/// One explanation.
#[derive(Clone, Copy)]
pub(crate) struct Explanation<'f> {
    pub(crate) fit: &'f Fit,
    /// Whether the samples leave it open; the others are ruled out and have to stay so.
    pub(crate) open: bool,
}

/// One explanation as it is refitted in every draw.
struct Refit {
    /// Reference prediction less its own, and its columns, at every choice.
    predictions: Vec<Prediction>,
    covariance: DMatrix<f64>,
    /// Parameters by draws.
    refits: DMatrix<f64>,
    /// By how much the sum of squares has risen, in each draw.
    risen: DVector<f64>,
    rss: f64,
    ln_evidence: f64,
}

/// Draws of one explanation that is taken for the true one.
struct Truth {
    index: usize,
    /// Deviations of the parameters by draws.
    parameters: DMatrix<f64>,
    first: usize,
}

/// See the module.
pub(crate) struct Decision {
    refits: Vec<Refit>,
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
    pub(crate) fn new(
        regression: &Regression,
        explanations: &[Explanation],
        inputs: &Inputs,
        axes: &Axes,
        wanted: f64,
    ) -> Self {
        let mut random = ChaCha8Rng::seed_from_u64(regression.seed);
        let open = explanations.iter().filter(|e| e.open).count();
        let draws = open * DRAWS;
        let Some(reference) = explanations.first() else {
            return Self::empty(random, wanted);
        };
        let mut refits = Vec::new();
        let mut truths = Vec::new();
        for (index, explanation) in explanations.iter().enumerate() {
            let model = &explanation.fit.model;
            let predictions = predictions(&reference.fit.model, model, inputs, axes);
            let information = gram(regression, model);
            if explanation.open {
                truths.push(Truth {
                    index,
                    parameters: drawn(&information, &predictions, &mut random),
                    first: truths.len() * DRAWS,
                });
            }
            refits.push(Refit {
                covariance: covariance_of(&information, &predictions),
                refits: DMatrix::zeros(information.nrows(), draws),
                risen: DVector::zeros(draws),
                predictions,
                rss: explanation.fit.rss,
                ln_evidence: explanation.fit.ln_evidence,
            });
        }
        let names: Vec<_> = explanations
            .iter()
            .map(|e| names(regression, e.fit))
            .collect();
        let within = |a: &[Name], b: &[Name]| a.iter().all(|n| b.contains(n));
        let differ = names
            .iter()
            .map(|a| {
                let others = names.iter();
                others.map(|b| !within(a, b) && !within(b, a)).collect()
            })
            .collect();
        Self {
            refits,
            truths,
            differ,
            random,
            rows: regression.m(),
            new_rows: 0.0,
            wanted,
            history: Vec::new(),
        }
    }

    fn empty(random: ChaCha8Rng, wanted: f64) -> Self {
        Self {
            refits: Vec::new(),
            truths: Vec::new(),
            differ: Vec::new(),
            random,
            rows: 0.0,
            new_rows: 0.0,
            wanted,
            history: Vec::new(),
        }
    }

    /// Whether a diagnosis has to tell one explanation from another.
    pub(crate) fn differ(&self, one: usize, other: usize) -> bool {
        self.differ[one][other]
    }

    /// Measures a pose in every draw.
    pub(crate) fn take(&mut self, choice: usize) {
        let Some(first) = self.refits.first() else {
            return;
        };
        let axes = first.predictions[choice].difference.len();
        let draws = first.risen.len();
        let mut measured = DMatrix::zeros(axes, draws);
        for truth in &self.truths {
            let own = &self.refits[truth.index].predictions[choice];
            let mut block = &own.columns * &truth.parameters;
            for mut column in block.column_iter_mut() {
                column -= &own.difference;
            }
            measured.columns_mut(truth.first, DRAWS).copy_from(&block);
        }
        let random = &mut self.random;
        measured.apply(|v| {
            let noise: f64 = StandardNormal.sample(random);
            *v += noise;
        });
        for refit in &mut self.refits {
            refit.take(choice, &measured);
        }
        self.new_rows += axes as f64;
        let now = self.ruled_out();
        self.history.push(now);
    }

    /// For each truth which rivals are ruled out in which draws.
    fn ruled_out(&self) -> Vec<DMatrix<u8>> {
        let rows = self.rows + self.new_rows;
        let evidence = |refit: &Refit, draw: usize| {
            let before = refit.ln_evidence + 0.5 * self.rows * refit.rss.max(1e-300).ln();
            before - 0.5 * rows * (refit.rss + refit.risen[draw]).max(1e-300).ln()
        };
        let of = |truth: &Truth| {
            DMatrix::from_fn(self.refits.len(), DRAWS, |other, k| {
                let draw = truth.first + k;
                let lead =
                    evidence(&self.refits[truth.index], draw) - evidence(&self.refits[other], draw);
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
    /// where that is less. Pairs that all of them cannot part do not count here.
    pub(crate) fn needed(&self, wanted: f64) -> Needed {
        let Some(last) = self.history.last() else {
            return Needed {
                poses: 0,
                probability: 0.0,
                unparted: self.pairs(),
            };
        };
        let parted: Vec<Vec<bool>> = last
            .iter()
            .map(|out| {
                let rows = out.row_iter();
                rows.map(|row| share(row.iter()) > HOPELESS).collect()
            })
            .collect();
        let unparted = parted.iter().flatten().filter(|parted| !**parted).count();
        let counts = |truth: usize, other: usize| parted[truth][other];
        let target = wanted.min(least(last, counts) - 0.01);
        let reached = |now: &Vec<DMatrix<u8>>| least(now, counts) >= target;
        let at = self.history.iter().position(reached);
        // Where nothing is parted, every bit helps.
        let at = at.filter(|_| unparted < self.pairs());
        let poses = at.map_or(self.history.len(), |at| at + 1);
        Needed {
            poses,
            probability: least(&self.history[poses - 1], counts),
            unparted,
        }
    }

    /// Pairs that a diagnosis has to tell apart.
    fn pairs(&self) -> usize {
        let of = |truth: &Truth| self.differ[truth.index].iter().filter(|d| **d).count();
        self.truths.iter().map(of).sum()
    }
}

/// What the poses of a [`Decision`] are worth.
pub(crate) struct Needed {
    pub(crate) poses: usize,
    /// That so many poses decide every pair that poses can part, whichever explanation is true.
    pub(crate) probability: f64,
    /// Pairs that none of the poses part.
    pub(crate) unparted: usize,
}

impl Refit {
    fn take(&mut self, choice: usize, measured: &DMatrix<f64>) {
        let Prediction {
            difference,
            columns,
        } = &self.predictions[choice];
        let carried = &self.covariance * columns.transpose();
        let mut spread = columns * &carried;
        for k in 0..spread.nrows() {
            spread[(k, k)] += 1.0;
        }
        let Some(factor) = spread.cholesky() else {
            return;
        };
        // Measured values are relative to the reference.
        let mut left = measured - columns * &self.refits;
        for mut column in left.column_iter_mut() {
            column += difference;
        }
        let solved = factor.solve(&left);
        for (draw, risen) in self.risen.iter_mut().enumerate() {
            *risen += solved.column(draw).dot(&left.column(draw));
        }
        self.refits += &carried * solved;
        self.covariance -= &carried * factor.solve(&carried.transpose());
    }
}

type Name = (&'static str, usize);

fn names(regression: &Regression, fit: &Fit) -> Vec<Name> {
    let added = regression.added(fit).into_iter();
    added.map(|t| (t.effect.about().id, t.joint)).collect()
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
fn drawn(
    information: &DMatrix<f64>,
    predictions: &[Prediction],
    random: &mut ChaCha8Rng,
) -> DMatrix<f64> {
    let p = information.nrows();
    let mut known = information.clone();
    for k in 0..p {
        let squares = predictions
            .iter()
            .map(|x| x.columns.column(k).norm_squared());
        let mean = squares.sum::<f64>() / predictions.len().max(1) as f64;
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
    fn the_sum_of_squares_rises_as_a_joint_refit_says() {
        let rows = [(3.0, 1.0), (1.0, 1.0), (2.0, -1.0)];
        let one = |(d, j): &(f64, f64)| Prediction {
            difference: DVector::from_element(1, *d),
            columns: DMatrix::from_element(1, 1, *j),
        };
        let mut refit = Refit {
            predictions: rows.iter().map(one).collect(),
            covariance: DMatrix::from_element(1, 1, 0.25),
            refits: DMatrix::zeros(1, 1),
            risen: DVector::zeros(1),
            rss: 1.0,
            ln_evidence: 0.0,
        };
        for k in 0..3 {
            refit.take(k, &DMatrix::zeros(1, 1));
        }
        // min over β of Σ (d − jβ)² + 4 β²: Σ d² − (Σ jd)² / (4 + Σ j²).
        let expected = 14.0 - 4.0 / 7.0;
        assert!((refit.risen[0] - expected).abs() < 1e-9, "{}", refit.risen);
    }

    #[test]
    fn the_least_share_counts_only_what_is_asked_for() {
        let mut out = DMatrix::from_element(2, DRAWS, 1_u8);
        out.row_mut(1).fill(0);
        let now = [out];
        assert!(least(&now, |_, _| true) <= 0.0);
        assert!(least(&now, |_, other| other == 0) >= 1.0);
    }
}
