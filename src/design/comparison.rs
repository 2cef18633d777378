//! A comparison: one model predicts what will be measured, another is refitted to it; how far apart
//! the two stay is what the poses are worth (T-optimality, Atkinson & Fedorov 1975).
//!
//! ```text
//! Δ = min_β ‖d − J β‖² + βᵀ G β,   d the difference at the new poses, J the rival's columns there,
//!                                  G its Gram matrix over the samples
//! ```
//!
//! Δ is carried on pose by pose, as a Kalman filter does: with `r = d − J β` at one more pose,
//!
//! ```text
//! Δ += rᵀ S⁻¹ r,   β += C Jᵀ S⁻¹ r,   C −= C Jᵀ S⁻¹ J C,   S = 1 + J C Jᵀ
//! ```
//!
//! The log-odds after measuring are L + Δ/2 ± √Δ, L the odds so far. That is for one pair whose
//! sizes are known; [`super::decision`] counts all pairs and all sizes that are possible.

use nalgebra::{DMatrix, DVector};

use super::exchange::Criterion;
use crate::effects::Inputs;
use crate::model::Model;

/// Information that every direction has at least, as a share of what the columns could bring.
const LEAST_INFORMATION: f64 = 1e-9;

/// Axes that are measured and their noise, mm.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Axes {
    pub(crate) axes: Vec<usize>,
    pub(crate) sigma_mm: [f64; 3],
}

/// One choice in a comparison, in units of the noise.
#[derive(Debug, Clone)]
pub(crate) struct Prediction {
    /// Difference of the predictions.
    pub(crate) difference: DVector<f64>,
    /// Columns of the model that is refitted.
    pub(crate) columns: DMatrix<f64>,
}

/// See the module.
#[derive(Debug, Clone)]
pub(crate) struct Comparison {
    predictions: Vec<Prediction>,
    covariance: DMatrix<f64>,
    refit: DVector<f64>,
    /// How far apart the models are so far.
    pub(crate) delta: f64,
    /// How far apart they have to be.
    pub(crate) enough: f64,
}

impl Comparison {
    /// `gram` is that of the refitted model's columns over what was measured already.
    pub(crate) fn new(predictions: Vec<Prediction>, gram: &DMatrix<f64>, enough: f64) -> Self {
        Self {
            covariance: covariance_of(gram, &predictions),
            refit: DVector::zeros(gram.nrows()),
            predictions,
            delta: 0.0,
            enough,
        }
    }

    /// Where the samples so far already part the models: the refit to them, and what it leaves.
    #[must_use]
    pub(crate) fn starting(mut self, pull: &DVector<f64>, square: f64) -> Self {
        self.refit = &self.covariance * pull;
        self.delta = (square - self.refit.dot(pull)).max(0.0);
        self
    }

    /// By how much one pose more would part the models.
    pub(crate) fn gain(&self, choice: usize) -> f64 {
        let (left, spread) = self.innovation(choice);
        let solved = spread.cholesky().map(|c| c.solve(&left));
        solved.map_or(0.0, |s| s.dot(&left).max(0.0))
    }

    /// Measures a pose.
    pub(crate) fn take(&mut self, choice: usize) {
        let (left, spread) = self.innovation(choice);
        let Some(factor) = spread.cholesky() else {
            return;
        };
        let columns = &self.predictions[choice].columns;
        let carried = &self.covariance * columns.transpose();
        let solved = factor.solve(&left);
        self.delta += solved.dot(&left).max(0.0);
        self.refit += &carried * solved;
        self.covariance -= &carried * factor.solve(&carried.transpose());
    }

    /// Whether the odds will do.
    pub(crate) fn decided(&self) -> bool {
        self.delta >= self.enough
    }

    fn innovation(&self, choice: usize) -> (DVector<f64>, DMatrix<f64>) {
        let Prediction {
            difference,
            columns,
        } = &self.predictions[choice];
        let left = difference - columns * &self.refit;
        let mut spread = columns * &self.covariance * columns.transpose();
        for k in 0..left.len() {
            spread[(k, k)] += 1.0;
        }
        (left, spread)
    }
}

/// Covariance of a model's parameters over what was measured already.
pub(crate) fn covariance_of(gram: &DMatrix<f64>, predictions: &[Prediction]) -> DMatrix<f64> {
    let mut information = gram.clone();
    for k in 0..gram.nrows() {
        let reach: f64 = predictions
            .iter()
            .map(|x| x.columns.column(k).norm_squared())
            .sum();
        information[(k, k)] += LEAST_INFORMATION * (gram[(k, k)] + reach).max(1e-300);
    }
    inverse(&information)
}

/// Inverse of an information matrix, well scaled or not.
pub(crate) fn inverse(information: &DMatrix<f64>) -> DMatrix<f64> {
    let p = information.nrows();
    // What nothing depends on, such as where an absent effect fades, is left alone.
    let scale_of = |own: f64| if own > 1e-200 { 1.0 / own.sqrt() } else { 0.0 };
    let scale: Vec<f64> = (0..p).map(|k| scale_of(information[(k, k)])).collect();
    let scaled = DMatrix::from_fn(p, p, |i, j| information[(i, j)] * scale[i] * scale[j]);
    // Rounding may leave a direction a hair below zero.
    let lifted = scaled + DMatrix::identity(p, p) * 1e-12;
    let inverse = lifted
        .clone()
        .cholesky()
        .map(|c| c.inverse())
        .or_else(|| lifted.try_inverse())
        .unwrap_or_else(|| DMatrix::identity(p, p));
    DMatrix::from_fn(p, p, |i, j| inverse[(i, j)] * scale[i] * scale[j])
}

/// What each choice shows of `truth` where `other` is refitted.
pub(crate) fn predictions(
    truth: &Model,
    other: &Model,
    inputs: &Inputs,
    axes: &Axes,
) -> Vec<Prediction> {
    let predicted = truth.predict(inputs);
    let mut all = Vec::with_capacity(inputs.len());
    other.visit(inputs, true, |start, block| {
        for i in 0..block.len {
            let at = predicted.get(start + i);
            let own = axes.axes.iter();
            let difference = own.map(|a| (at[*a] - block.point[*a][i]) / axes.sigma_mm[*a]);
            all.push(Prediction {
                difference: DVector::from_iterator(axes.axes.len(), difference),
                columns: DMatrix::from_fn(axes.axes.len(), block.columns.len(), |row, k| {
                    let axis = axes.axes[row];
                    block.columns[k][axis][i] / axes.sigma_mm[axis]
                }),
            });
        }
    });
    all
}

/// Standard deviations of the log-odds that are allowed for: 97.7 of 100 sessions.
const SURE: f64 = 2.0;

/// The Δ that brings the odds beyond `wanted` (a logarithm) where the true model leads by `lead`:
/// `lead + Δ/2 − SURE √Δ = wanted`. For 20 : 1 from even odds it is 27; a lead that no noise of
/// the new poses takes back needs none.
pub(crate) fn enough_for(wanted: f64, lead: f64) -> f64 {
    let square = SURE * SURE + 2.0 * (wanted - lead);
    if square <= 0.0 {
        return 0.0;
    }
    let root = SURE + square.sqrt();
    root * root
}

/// Models that are to be parted, a criterion of poses: none is taken more than `repeats` times.
pub(crate) struct Parting {
    pub(crate) comparisons: Vec<Comparison>,
    taken: Vec<u8>,
    repeats: u8,
}

impl Parting {
    pub(crate) fn new(comparisons: Vec<Comparison>, candidates: usize, repeats: u8) -> Self {
        Self {
            comparisons,
            taken: vec![0; candidates],
            repeats,
        }
    }
}

impl Criterion for Parting {
    fn worths(&self) -> Vec<f64> {
        let open: Vec<&Comparison> = self.comparisons.iter().filter(|c| !c.decided()).collect();
        // The gain of each comparison counts up to where it is decided.
        let worth = |k: usize| -> f64 {
            let each = open.iter();
            each.map(|c| c.gain(k).min(c.enough - c.delta) / (1.0 + c.delta))
                .sum()
        };
        let free = |k: usize| self.taken[k] < self.repeats;
        let all = 0..self.taken.len();
        all.map(|k| if free(k) { worth(k) } else { 0.0 }).collect()
    }

    fn take(&mut self, candidate: usize) {
        self.taken[candidate] += 1;
        for comparison in &mut self.comparisons {
            comparison.take(candidate);
        }
    }

    fn satisfied(&mut self) -> bool {
        self.comparisons.iter().all(Comparison::decided)
    }
}

#[cfg(test)]
mod tests {
    use super::super::exchange::choose;
    use super::*;

    /// Difference and column of one number at every choice.
    fn predictions_of(rows: &[(f64, f64)]) -> Vec<Prediction> {
        let one = |(d, j): &(f64, f64)| Prediction {
            difference: DVector::from_element(1, *d),
            columns: DMatrix::from_element(1, 1, *j),
        };
        rows.iter().map(one).collect()
    }

    #[test]
    fn delta_is_what_a_least_squares_refit_leaves() {
        let rows = [(3.0, 1.0), (1.0, 1.0), (2.0, -1.0)];
        let mut comparison = Comparison::new(
            predictions_of(&rows),
            &DMatrix::from_element(1, 1, 4.0),
            1.0,
        );
        for k in 0..3 {
            let gain = comparison.gain(k);
            let before = comparison.delta;
            comparison.take(k);
            assert!((comparison.delta - before - gain).abs() < 1e-9);
        }
        // min over β of Σ (d − jβ)² + 4 β²: Σ d² − (Σ jd)² / (4 + Σ j²).
        let expected = 14.0 - 4.0 / 7.0;
        assert!(
            (comparison.delta - expected).abs() < 1e-6,
            "{}",
            comparison.delta
        );
    }

    #[test]
    fn a_difference_that_the_rival_can_imitate_is_worth_nothing() {
        let rows = [(3.0, 1.0), (6.0, 2.0)];
        let comparison = Comparison::new(predictions_of(&rows), &DMatrix::zeros(1, 1), 10.0);
        let mut parting = Parting::new(vec![comparison], 2, 2);
        let order = choose(&mut parting, 5);
        let delta = parting.comparisons[0].delta;
        assert!(delta < 1e-6, "{order:?}: {delta}");
    }

    #[test]
    fn the_odds_that_are_wanted_are_reached_in_nearly_all_sessions() {
        let delta = enough_for(3.0, 0.0);
        assert!((delta / 2.0 - SURE * delta.sqrt() - 3.0).abs() < 1e-9);
        assert!((delta - 26.6).abs() < 0.1, "{delta}");
        assert!(enough_for(3.0, -2.0) > delta && enough_for(3.0, 2.0) < delta);
        assert!(enough_for(3.0, 5.5) <= 0.0);
    }
}
