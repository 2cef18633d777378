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
//! [`Comparison`] carries `r` and `J C Jᵀ` of all candidates on instead of β, which is the same: both
//! change by as many ranks as a pose has rows ([`super::exchange`]).
//!
//! The log-odds after measuring are L + Δ/2 ± √Δ, L the odds so far. That is for one pair whose
//! sizes are known; [`super::decision`] counts all pairs and all sizes that are possible.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use crate::diagnosis::evidence::Regression;
use crate::diagnosis::search::prepare::PreparedSearch;
use crate::effects::Inputs;
use crate::model::Model;
use crate::observations::Layer;
use crate::sessions::Session;

use super::candidates::CandidatePoses;
use super::exchange::{CandidateRows, Information};
use super::inverse::{LEAST_INFORMATION, inverse};
use super::untouched::ReducedInformation;

/// Axes that are measured and their noise, mm.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Axes {
    pub(crate) axes: Vec<usize>,
    pub(crate) sigma_mm: [f64; 3],
}

/// One candidate in a comparison, in units of the noise.
#[derive(Debug, Clone)]
pub(crate) struct Prediction {
    /// Difference of the predictions.
    pub(crate) difference: DVector<f64>,
    /// Columns of the model that is refitted.
    pub(crate) columns: DMatrix<f64>,
}

/// What each input shows of `truth` where `other` is refitted.
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

/// The same where points are not all that is measured: the rows of every observation, in units of the
/// noise that the session was found to have. `taken` are the candidates as samples.
fn observed_predictions(
    truth: &Model,
    other: &Model,
    inputs: &Inputs,
    taken: &Session,
    regression: &Regression,
) -> Vec<Prediction> {
    let mut layer = Layer::at(taken, inputs);
    if let Some(so_far) = regression.rows.observed() {
        layer.sigma.clone_from(&so_far.layer().sigma);
        layer.unit_mm = so_far.layer().unit_mm;
    }
    let p = other.coefficient_count();
    let width = layer.items.iter().map(|item| item.rows).max().unwrap_or(0);
    let rows_of = |model: &Model, differentiate: bool| {
        let mut left = DMatrix::zeros(width, layer.items.len());
        let mut columns =
            vec![DMatrix::zeros(width, if differentiate { p } else { 0 }); layer.items.len()];
        layer.visit(model, differentiate, |block| {
            for (lane, item) in block.items.iter().enumerate() {
                let Some(item) = *item else { continue };
                for row in (0..width).filter(|row| block.rows[*row][lane]) {
                    let unit = 1.0 / regression.noise.sigma_mm[row];
                    left[(row, item)] = block.left[row][lane] * unit;
                    for (k, column) in block.columns.iter().enumerate() {
                        columns[item][(row, k)] = column[row][lane] * unit;
                    }
                }
            }
        });
        (left, columns)
    };
    let (by_truth, _) = rows_of(truth, false);
    let (by_other, columns) = rows_of(other, true);
    let mut own: Vec<Vec<(usize, usize)>> = vec![Vec::new(); inputs.len()];
    for (index, item) in layer.items.iter().enumerate() {
        own[item.sample].extend((0..item.rows).map(|row| (index, row)));
    }
    let one = |rows: Vec<(usize, usize)>| Prediction {
        difference: DVector::from_iterator(
            rows.len(),
            rows.iter()
                .map(|(item, row)| by_other[(*row, *item)] - by_truth[(*row, *item)]),
        ),
        columns: DMatrix::from_fn(rows.len(), p, |k, column| {
            let (item, row) = rows[k];
            columns[item][(row, column)]
        }),
    };
    own.into_iter().map(one).collect()
}

/// Where models are compared: on the samples so far and on candidates.
pub(crate) struct Field<'p> {
    pub(crate) regression: &'p Regression<'p>,
    pub(crate) inputs: Inputs<'static>,
    axes: Axes,
    /// The candidates as samples, where points are not all that is measured.
    taken: Option<Session>,
}

impl<'p> Field<'p> {
    pub(crate) fn new(prepared: &'p PreparedSearch, offer: &CandidatePoses) -> Self {
        let regression = &prepared.regression;
        Self {
            regression,
            inputs: offer.inputs(prepared),
            taken: offer.session(prepared),
            axes: Axes {
                axes: regression.rows.axes.clone(),
                sigma_mm: regression.noise.sigma_mm,
            },
        }
    }

    /// What each candidate shows of `truth` where `other` is refitted.
    pub(crate) fn predictions(&self, truth: &Model, other: &Model) -> Vec<Prediction> {
        let (inputs, regression) = (&self.inputs, self.regression);
        match &self.taken {
            None => predictions(truth, other, inputs, &self.axes),
            Some(taken) => observed_predictions(truth, other, inputs, taken, regression),
        }
    }

    /// Gram matrix of a model's columns over the samples.
    pub(crate) fn gram(&self, model: &Model) -> DMatrix<f64> {
        let rows = &self.regression.rows;
        let (_, columns) = rows.extract(model);
        let white = self.regression.noise.whitened(rows, &columns);
        white.tr_mul(&white)
    }

    /// `truth` against `other` where it was there already while the samples were measured, and `other` was
    /// fitted to what it made of them; the samples count so much.
    pub(crate) fn comparison_from_the_start(
        &self,
        truth: &Model,
        other: &Model,
        enough: f64,
        weight: f64,
    ) -> Comparison {
        let Regression { rows, noise, .. } = self.regression;
        let (without, columns) = rows.extract(other);
        let (with, _) = rows.extract(truth);
        let difference = noise.whitened_vector(rows, &(without - with));
        let white = noise.whitened(rows, &columns);
        let products = white.tr_mul(&white) * weight;
        let pull = white.tr_mul(&difference) * weight;
        // Of many parameters these columns and those of all candidates need not have room at once.
        drop(white);
        let mut seen = self.predictions(truth, other);
        let columns = seen.iter_mut().map(|one| &mut one.columns).collect();
        let known = ReducedInformation::without_untouched(products, pull, columns);
        let mut comparison = Comparison::new(seen, &known.gram, enough);
        let at_first = &comparison.information.covariance * &known.pull;
        let explained = at_first.dot(&known.pull) + known.explained;
        let shown = comparison.information.shown(&at_first);
        let apart = &mut comparison.distances[0];
        apart.delta = (difference.norm_squared() * weight - explained).max(0.0);
        apart.left -= shown;
        comparison
    }
}

/// A model that is refitted to what candidates show, in many draws of what is measured.
#[derive(Debug, Clone)]
pub(crate) struct Refit {
    candidates: Arc<CandidateRows>,
    /// Differences of the predictions in the rows of all candidates.
    pub(crate) differences: DVector<f64>,
    pub(crate) covariance: DMatrix<f64>,
    /// Draws by parameters: products with the few columns of a candidate run along the draws.
    refits: DMatrix<f64>,
    /// By how much the sum of squares has risen, in each draw.
    pub(crate) risen: DVector<f64>,
}

impl Refit {
    /// `gram` is that of the model's columns over what was measured already.
    pub(crate) fn new(predictions: Vec<Prediction>, gram: &DMatrix<f64>, draws: usize) -> Self {
        let differences = differences(&predictions);
        let candidates = together(predictions, gram.nrows());
        Self {
            covariance: covariance_of(gram, &candidates),
            refits: DMatrix::zeros(draws, gram.nrows()),
            risen: DVector::zeros(draws),
            candidates,
            differences,
        }
    }

    /// Squared length of each of the model's columns over all candidates.
    pub(crate) fn squares(&self) -> Vec<f64> {
        self.candidates.squares()
    }

    /// How many candidates there are.
    pub(crate) fn len(&self) -> usize {
        self.candidates.len()
    }

    /// Difference of the predictions at a candidate, and the columns of the model there.
    pub(crate) fn at(&self, candidate: usize) -> (DVector<f64>, DMatrix<f64>) {
        let (first, size) = self.candidates.place(candidate);
        let difference = self.differences.rows(first, size).into_owned();
        (difference, self.candidates.of(candidate).transpose())
    }

    /// Refitted to what others show, each with how far apart the two have to be. The differences of all are
    /// from the same model.
    pub(crate) fn comparison<'r>(
        &'r self,
        others: impl Iterator<Item = (&'r Self, f64)>,
    ) -> Comparison {
        let apart = others.map(|(other, enough)| {
            ModelDistance::new(&self.differences - &other.differences, enough)
        });
        let candidates = Arc::clone(&self.candidates);
        Comparison::of(candidates, self.covariance.clone(), apart.collect())
    }

    /// What a candidate leaves in every draw, and its covariance.
    fn innovation(
        &self,
        difference: &DVector<f64>,
        columns: &DMatrix<f64>,
    ) -> (DMatrix<f64>, DMatrix<f64>) {
        let mut left = (&self.refits * columns.transpose()).transpose();
        for mut column in left.column_iter_mut() {
            column.zip_apply(difference, |own, d| *own = d - *own);
        }
        let mut spread = columns * &self.covariance * columns.transpose();
        for k in 0..spread.nrows() {
            spread[(k, k)] += 1.0;
        }
        (left, spread)
    }

    /// Measures a candidate: `measured` is what comes to the difference in each draw.
    pub(crate) fn take(&mut self, candidate: usize, measured: Option<&DMatrix<f64>>) {
        let (difference, columns) = self.at(candidate);
        let (mut left, spread) = self.innovation(&difference, &columns);
        if let Some(measured) = measured {
            left += measured;
        }
        let Some(factor) = spread.cholesky() else {
            return;
        };
        let carried = &self.covariance * columns.transpose();
        let solved = factor.solve(&left);
        for (draw, risen) in self.risen.iter_mut().enumerate() {
            *risen += solved.column(draw).dot(&left.column(draw)).max(0.0);
        }
        self.refits
            .gemm(1.0, &solved.transpose(), &carried.transpose(), 1.0);
        self.covariance -= &carried * factor.solve(&carried.transpose());
    }
}

/// A model that is refitted to what each of some others shows at the candidates that are taken. What it
/// knows of itself is the same beside all of them.
#[derive(Clone)]
pub(crate) struct Comparison {
    /// What is known of the one that is refitted.
    information: Information,
    pub(crate) distances: Vec<ModelDistance>,
    /// Poses that were measured since it was decided; that they make it no less so is all that is known.
    since: Vec<usize>,
}

/// How far one of the others is from what is refitted.
#[derive(Clone)]
pub(crate) struct ModelDistance {
    /// What the refit leaves as it is now, in the rows of all candidates.
    left: DVector<f64>,
    pub(crate) delta: f64,
    /// How far apart the models have to be.
    pub(crate) enough: f64,
}

impl ModelDistance {
    /// Of what another model shows as compared with the one that is refitted.
    fn new(left: DVector<f64>, enough: f64) -> Self {
        Self {
            left,
            delta: 0.0,
            enough,
        }
    }

    /// Whether the odds will do.
    pub(crate) fn decided(&self) -> bool {
        self.delta >= self.enough
    }

    /// How much of what is needed there is.
    pub(crate) fn share(&self) -> f64 {
        (self.delta / self.enough).min(1.0)
    }
}

impl Comparison {
    /// Against one other model; `gram` is that of the refitted model's columns over what was measured
    /// already.
    pub(crate) fn new(predictions: Vec<Prediction>, gram: &DMatrix<f64>, enough: f64) -> Self {
        let apart = vec![ModelDistance::new(differences(&predictions), enough)];
        let candidates = together(predictions, gram.nrows());
        let covariance = covariance_of(gram, &candidates);
        Self::of(candidates, covariance, apart)
    }

    fn of(
        candidates: Arc<CandidateRows>,
        covariance: DMatrix<f64>,
        distances: Vec<ModelDistance>,
    ) -> Self {
        Self {
            information: Information::over(candidates, covariance),
            distances,
            since: Vec::new(),
        }
    }

    /// Sum over the other models that count of what one pose more is worth; `worth` is told by how much it
    /// would part each.
    pub(crate) fn worth(
        &self,
        candidate: usize,
        counts: impl Fn(&ModelDistance) -> bool,
        worth: impl Fn(&ModelDistance, f64) -> f64,
    ) -> f64 {
        let Some(root) = self.information.innovation(candidate, 1.0) else {
            return 0.0;
        };
        let (first, size) = self.information.place(candidate);
        let mut white = vec![0.0; size];
        let mut of = |one: &ModelDistance| {
            let left = &one.left.as_slice()[first..first + size];
            worth(one, whitened_square(&root, left, &mut white))
        };
        let others = self.distances.iter().filter(|one| counts(one));
        others.map(&mut of).sum()
    }

    /// Measures a pose; what is decided stays so, and is worked out once more is asked of it.
    pub(crate) fn take(&mut self, candidate: usize) {
        if self.decided() {
            self.since.push(candidate);
        } else {
            self.measure(candidate);
        }
    }

    /// Asks that all models are further apart.
    pub(crate) fn ask_for_more(&mut self, factor: f64) {
        for apart in &mut self.distances {
            apart.enough = factor * apart.enough.max(1.0);
        }
        if !self.decided() {
            for candidate in std::mem::take(&mut self.since) {
                self.measure(candidate);
            }
        }
    }

    fn measure(&mut self, candidate: usize) {
        let (first, size) = self.information.place(candidate);
        let update = self.information.update(candidate, 1.0);
        let Some((root, moved)) = update else { return };
        for one in &mut self.distances {
            let white = root.solve_lower_triangular(&one.left.rows(first, size));
            let Some(white) = white else { continue };
            one.delta += white.norm_squared();
            one.left.gemv(-1.0, &moved, &white, 1.0);
        }
    }

    /// Whether the odds will do.
    pub(crate) fn decided(&self) -> bool {
        self.distances.iter().all(ModelDistance::decided)
    }
}

/// `‖L⁻¹ r‖²`: what a candidate leaves, in independent units of what it is known to. `white` becomes `L⁻¹ r`.
fn whitened_square(root: &DMatrix<f64>, left: &[f64], white: &mut [f64]) -> f64 {
    let mut square = 0.0;
    for (i, left) in left.iter().enumerate() {
        let known: f64 = (0..i).map(|j| root[(i, j)] * white[j]).sum();
        white[i] = (left - known) / root[(i, i)];
        square += white[i] * white[i];
    }
    square
}

/// Differences of the predictions in the rows of all candidates.
fn differences(predictions: &[Prediction]) -> DVector<f64> {
    let all = predictions.iter().flat_map(|one| one.difference.iter());
    all.copied().collect::<Vec<f64>>().into()
}

/// Columns of the model that is refitted, `p` of them, in the rows of all candidates.
fn together(predictions: Vec<Prediction>, p: usize) -> Arc<CandidateRows> {
    let mut first = vec![0];
    first.extend(predictions.iter().scan(0, |end, one| {
        *end += one.columns.nrows();
        Some(*end)
    }));
    let mut rows = DMatrix::zeros(p, first[predictions.len()]);
    // Each goes as soon as it is copied.
    for (one, from) in predictions.into_iter().zip(&first) {
        rows.columns_mut(*from, one.columns.nrows())
            .tr_copy_from(&one.columns);
    }
    Arc::new(CandidateRows::new(rows, first))
}

/// Covariance of a model's parameters over what was measured already.
fn covariance_of(gram: &DMatrix<f64>, candidates: &CandidateRows) -> DMatrix<f64> {
    let mut information = gram.clone();
    for (k, reach) in candidates.squares().into_iter().enumerate() {
        information[(k, k)] += LEAST_INFORMATION * (gram[(k, k)] + reach).max(1e-300);
    }
    inverse(&information)
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
        let known = DMatrix::from_element(1, 1, 4.0);
        let mut comparison = Comparison::new(predictions_of(&rows), &known, 100.0);
        let mut refit = Refit::new(predictions_of(&rows), &known, 2);
        for k in 0..3 {
            let gain = comparison.worth(k, |_| true, |_, gain| gain);
            let before = comparison.distances[0].delta;
            comparison.take(k);
            assert!((comparison.distances[0].delta - before - gain).abs() < 1e-9);
            // In the second draw twice the difference is measured.
            let measured = DMatrix::from_row_slice(1, 2, &[0.0, rows[k].0]);
            refit.take(k, Some(&measured));
        }
        // min over β of Σ (d − jβ)² + 4 β²: Σ d² − (Σ jd)² / (4 + Σ j²).
        let expected = 14.0 - 4.0 / 7.0;
        let [once, twice] = [refit.risen[0], refit.risen[1]];
        assert!((comparison.distances[0].delta - expected).abs() < 1e-6);
        assert!((once - expected).abs() < 1e-6, "{once}");
        assert!((twice - 4.0 * expected).abs() < 1e-6, "{twice}");
    }

    #[test]
    fn what_was_measured_since_it_was_decided_counts_where_more_is_asked_for() {
        let rows = [(3.0, 1.0), (1.0, 1.0), (2.0, -1.0)];
        let known = DMatrix::from_element(1, 1, 4.0);
        let of = |enough| {
            let mut comparison = Comparison::new(predictions_of(&rows), &known, enough);
            (0..3).for_each(|k| comparison.take(k));
            comparison
        };
        let (mut quick, whole) = (of(5.0), of(100.0));
        assert!(quick.decided() && !whole.decided());
        quick.ask_for_more(20.0);
        let [quick, whole] = [quick, whole].map(|c| c.distances[0].clone());
        assert!((quick.delta - whole.delta).abs() < 1e-12);
        assert!((quick.left - whole.left).norm() < 1e-12);
    }

    #[test]
    fn a_difference_that_the_rival_can_imitate_is_worth_nothing() {
        let rows = [(3.0, 1.0), (6.0, 2.0)];
        let comparison = Comparison::new(predictions_of(&rows), &DMatrix::zeros(1, 1), 10.0);
        let mut parting = ModelSeparation::new(vec![comparison], 2, 2);
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
