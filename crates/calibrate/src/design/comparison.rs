//! A comparison: one model predicts what will be measured, another is refitted to it; how far apart the two stay is
//! the value of the poses (T-optimality, Atkinson & Fedorov 1975).
//!
//! ```text
//! Δ = min_β ‖d − J β‖² + βᵀ G β,   d the difference at the new poses, J the rival's columns there,
//!                                  G its Gram matrix over the samples
//! ```
//!
//! Δ is updated pose by pose, as a Kalman filter does: with `r = d − J β` at one more pose,
//!
//! ```text
//! Δ += rᵀ S⁻¹ r,   β += C Jᵀ S⁻¹ r,   C −= C Jᵀ S⁻¹ J C,   S = 1 + J C Jᵀ
//! ```
//!
//! Of the models that a rival is compared with, r in the rows of all candidates is updated instead of β, which is the
//! same; of the many draws of what is measured ([`super::decision`]), β.
//!
//! The log-odds after measuring are L + Δ/2 ± √Δ, L the odds so far. That is for one pair whose
//! sizes are known; [`super::decision`] counts all pairs and all sizes that are possible.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use super::candidate_poses::CandidatePoses;
use super::covariance;
use super::information::Information;
use super::rows::Rows;
use crate::diagnosis::evidence::Regression;
use crate::lanes::LANES;
use crate::model::Model;

/// A model that is refitted to the predictions of each of some others at the candidates that are taken. Its own
/// information is the same for all of them.
#[derive(Clone)]
pub(crate) struct Comparison {
    information: Information,
    pub(crate) distances: Vec<ModelDistance>,
    /// Its parameters, refitted to each draw of what is measured.
    draws: DMatrix<f64>,
    /// By how much the sum of squares has risen, in each draw.
    pub(crate) risen: DVector<f64>,
}

/// How far one of the others is from what is refitted.
#[derive(Debug, Clone)]
pub(crate) struct ModelDistance {
    /// The present residual of the refit, in the rows of all candidates.
    residual: DVector<f64>,
    pub(crate) delta: f64,
    /// How far apart the models have to be.
    pub(crate) enough: f64,
}

impl ModelDistance {
    /// Of what another model shows as compared with the one that is refitted.
    pub(crate) fn new(residual: DVector<f64>, enough: f64) -> Self {
        Self {
            residual,
            delta: 0.0,
            enough,
        }
    }

    /// Whether the odds will do.
    pub(crate) fn decided(&self) -> bool {
        self.delta >= self.enough
    }

    /// The share of what is needed.
    pub(crate) fn share(&self) -> f64 {
        (self.delta / self.enough).min(1.0)
    }
}

impl Comparison {
    /// Against some other models, and with so many draws of what is measured; `covariance` is that of the
    /// refitted model over what was measured already.
    pub(crate) fn new(
        rows: impl Into<Arc<Rows>>,
        covariance: DMatrix<f64>,
        distances: Vec<ModelDistance>,
        draws: usize,
    ) -> Self {
        Self {
            draws: DMatrix::zeros(covariance.nrows(), draws),
            risen: DVector::zeros(draws),
            information: Information::new(rows, covariance),
            distances,
        }
    }

    /// `truth` against `other` where it was present already while the samples were measured, and `other` was fitted to
    /// them; the samples count so much.
    pub(crate) fn from_the_start(
        offer: &CandidatePoses,
        [truth, other]: [&Model; 2],
        enough: f64,
        weight: f64,
    ) -> Self {
        let Regression { rows, noise, .. } = offer.regression;
        let (without, columns) = rows.extract(other);
        let difference = noise.whitened_vector(rows, &(without - rows.residual(truth)));
        let white = noise.whitened(rows, &columns);
        let gram = white.tr_mul(&white) * weight;
        let pull = white.tr_mul(&difference) * weight;
        // Of many parameters these columns and those of all candidates need not have room at once.
        drop((white, columns));
        let mut seen = offer.rows(truth, other);
        let mut covariance = covariance::given_samples(&gram, &seen);
        let mut at_first = &covariance * &pull;
        let explained = at_first.dot(&pull);
        // The frames of setups that are over are of use for the other parameters only.
        let squares = seen.squares();
        let shown: Vec<usize> = (0..pull.len()).filter(|k| squares[*k] > 0.0).collect();
        if pull.len() - shown.len() >= LANES {
            seen = seen.only(&shown);
            covariance = covariance.select_rows(&shown).select_columns(&shown);
            at_first = at_first.select_rows(&shown);
        }
        let residual = &seen.difference - seen.columns.tr_mul(&at_first);
        let mut distance = ModelDistance::new(residual, enough);
        distance.delta = (difference.norm_squared() * weight - explained).max(0.0);
        Self::new(seen, covariance, vec![distance], 0)
    }

    pub(crate) fn rows(&self) -> &Rows {
        &self.information.rows
    }

    /// Sum over the other models of what one pose more is worth; `worth` is given by how much it would part each.
    pub(crate) fn worth(
        &self,
        candidate: usize,
        worth: impl Fn(&ModelDistance, f64) -> f64,
    ) -> f64 {
        let Some(root) = self.information.innovation(candidate, 1.0) else {
            return 0.0;
        };
        let (first, size) = self.rows().place(candidate);
        let mut white = vec![0.0; size];
        let of = |one: &ModelDistance| {
            let residual = &one.residual.as_slice()[first..first + size];
            worth(one, whitened_square(&root, residual, &mut white))
        };
        self.distances.iter().map(of).sum()
    }

    /// Measures a candidate; `measured` is what comes to the difference in each draw.
    pub(crate) fn take(&mut self, candidate: usize, measured: Option<&DMatrix<f64>>) {
        let rows = &self.information.rows;
        let (first, size) = rows.place(candidate);
        let of_draws = measured.map(|measured| {
            let mut new = measured - rows.of(candidate).tr_mul(&self.draws);
            let difference = rows.difference.rows(first, size);
            new.column_iter_mut().for_each(|mut own| own += difference);
            new
        });
        let Some(update) = self.information.update(candidate, 1.0) else {
            return;
        };
        for one in &mut self.distances {
            let residual = one.residual.rows(first, size);
            let Some(white) = update.root.solve_lower_triangular(&residual) else {
                continue;
            };
            one.delta += white.norm_squared();
            one.residual.gemv(-1.0, &update.moved, &white, 1.0);
        }
        let white = of_draws.and_then(|new| update.root.solve_lower_triangular(&new));
        if let Some(white) = white {
            for (risen, own) in self.risen.iter_mut().zip(white.column_iter()) {
                *risen += own.norm_squared();
            }
            self.draws.gemm_tr(1.0, &update.gain, &white, 1.0);
        }
    }

    /// Whether the odds will do.
    pub(crate) fn decided(&self) -> bool {
        self.distances.iter().all(ModelDistance::decided)
    }
}

/// `‖L⁻¹ r‖²`: the residual of a candidate in independent units of its standard deviations. `white` becomes `L⁻¹ r`.
fn whitened_square(root: &DMatrix<f64>, residual: &[f64], white: &mut [f64]) -> f64 {
    let mut square = 0.0;
    for (i, new) in residual.iter().enumerate() {
        let known: f64 = (0..i).map(|j| root[(i, j)] * white[j]).sum();
        white[i] = (new - known) / root[(i, i)];
        square += white[i] * white[i];
    }
    square
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

#[cfg(test)]
mod tests {
    use super::super::exchange::choose;
    use super::super::model_separation::ModelSeparation;
    use super::*;

    /// Against one other model, of one number at every choice, that differs and is a column; `known` is the
    /// information so far.
    fn of(rows: &[(f64, f64)], known: f64, draws: usize) -> Comparison {
        let mut all = Rows::zeros(1, rows.iter().map(|_| 1));
        for (k, (d, j)) in rows.iter().enumerate() {
            (all.difference[k], all.columns[(0, k)]) = (*d, *j);
        }
        let covariance = covariance::given_samples(&DMatrix::from_element(1, 1, known), &all);
        let distance = ModelDistance::new(all.difference.clone(), 10.0);
        Comparison::new(all, covariance, vec![distance], draws)
    }

    #[test]
    fn delta_is_what_a_least_squares_refit_leaves() {
        let rows = [(3.0, 1.0), (1.0, 1.0), (2.0, -1.0)];
        let mut comparison = of(&rows, 4.0, 2);
        for k in 0..3 {
            let gain = comparison.worth(k, |_, gain| gain);
            let before = comparison.distances[0].delta;
            // In the second draw twice the difference is measured.
            let measured = DMatrix::from_row_slice(1, 2, &[0.0, rows[k].0]);
            comparison.take(k, Some(&measured));
            assert!((comparison.distances[0].delta - before - gain).abs() < 1e-9);
        }
        // min over β of Σ (d − jβ)² + 4 β²: Σ d² − (Σ jd)² / (4 + Σ j²).
        let expected = 14.0 - 4.0 / 7.0;
        let [once, twice] = [comparison.risen[0], comparison.risen[1]];
        assert!((comparison.distances[0].delta - expected).abs() < 1e-6);
        assert!((once - expected).abs() < 1e-6, "{once}");
        assert!((twice - 4.0 * expected).abs() < 1e-6, "{twice}");
    }

    #[test]
    fn a_difference_that_the_rival_can_imitate_is_worth_nothing() {
        let rows = [(3.0, 1.0), (6.0, 2.0)];
        let mut parting = ModelSeparation::new(vec![of(&rows, 0.0, 0)], 2, 2);
        let order = choose(&mut parting, 5);
        let delta = parting.comparisons[0].distances[0].delta;
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
