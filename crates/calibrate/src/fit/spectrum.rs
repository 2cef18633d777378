//! The eigenvalues of the scaled Gram matrix of a fit: what the samples determine, and the step from it.

use std::borrow::Cow;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use crate::linear::inverse_of_lower;
use crate::model::Model;
use crate::rounding;

/// A direction in the space of coefficients along which the samples have no information.
#[derive(Debug, Clone, PartialEq)]
pub struct NullDirection {
    /// One component for each coefficient, inner units, of arbitrary size.
    pub components: DVector<f64>,
}

/// The scaled Gram matrix taken apart.
#[derive(Debug, Clone)]
pub struct Spectrum {
    scale: DVector<f64>,
    values: DVector<f64>,
    vectors: DMatrix<f64>,
    /// Which eigenvectors the samples determine.
    determined: Vec<bool>,
    /// The plausible range of each.
    furthest: Vec<f64>,
    /// Number of coefficients that are held where they are.
    held: usize,
}

/// Eigenvalues of the scaled Gram matrix below this are rounding: its entries are sums of products
/// with a relative error of some 1e-14, and its diagonal is 1.
const RANK_TOLERANCE: f64 = 1e-11;
/// A shift of at most this share of a standard deviation widens it by a twentieth.
const NEGLIGIBLE: f64 = 0.3;

impl Spectrum {
    /// Takes a Gram matrix apart.
    pub fn new(gram: &DMatrix<f64>) -> Self {
        let (scale, scaled) = scaled(gram);
        if gram.is_empty() {
            // Nothing to take apart; the decomposition takes no empty matrix.
            return Self {
                held: 0,
                scale,
                values: DVector::zeros(0),
                vectors: DMatrix::zeros(0, 0),
                determined: Vec::new(),
                furthest: Vec::new(),
            };
        }
        let eigen = crate::decompose::eigen(scaled);
        let values = eigen.eigenvalues;
        Self {
            scale,
            determined: values.iter().map(|v| *v > RANK_TOLERANCE).collect(),
            furthest: vec![f64::INFINITY; values.len()],
            values,
            vectors: eigen.eigenvectors,
            held: 0,
        }
    }

    /// The same, where a direction counts as determined only if going along it as far as is plausible (`reaches`, one
    /// for each coefficient) would raise the cost by at least `least`. A column of rounding counts as zero, and no
    /// step is taken along what the samples leave undetermined over its whole range.
    #[must_use]
    pub fn within(mut self, reaches: &[f64], least: f64) -> Self {
        for k in 0..self.values.len() {
            let along = (0..reaches.len()).map(|i| {
                let moved = self.vectors[(i, k)].abs() * self.unscale(i);
                if moved > 0.0 {
                    reaches[i] / moved
                } else {
                    f64::INFINITY
                }
            });
            let furthest = along.fold(f64::INFINITY, f64::min);
            let open = furthest.is_finite() && self.values[k] * furthest * furthest < least;
            self.determined[k] &= !open;
            self.furthest[k] = furthest;
        }
        self
    }

    fn unscale(&self, k: usize) -> f64 {
        if self.scale[k] > 0.0 {
            1.0 / self.scale[k]
        } else {
            0.0
        }
    }

    /// Takes the Gram matrix of a model's coefficients apart, apart from those that it holds.
    pub(super) fn of_model(gram: &DMatrix<f64>, model: &Model) -> Self {
        let (apart, held) = without_held(gram, model);
        let mut spectrum = Self::new(&apart);
        for k in &held {
            spectrum.scale[*k] = 0.0;
        }
        spectrum.held = held.len();
        spectrum
    }

    /// The same where every weight is so many times as large.
    pub(super) fn rescale(&mut self, factor: f64) {
        self.scale *= factor.sqrt();
    }

    fn determined(&self, index: usize) -> bool {
        self.determined[index]
    }

    /// Number of independent combinations of coefficients that the samples determine.
    pub fn rank(&self) -> usize {
        let determined = (0..self.values.len()).filter(|k| self.determined(*k));
        // With columns that are not finite even what is held is not determined.
        determined.count().saturating_sub(self.held)
    }

    /// Ratio of the largest to the smallest determined eigenvalue of the scaled Gram matrix; its
    /// root is the condition number of the scaled Jacobian.
    pub fn condition(&self) -> f64 {
        let determined = (0..self.values.len()).filter(|k| self.determined(*k));
        let (low, high) = determined.fold((f64::INFINITY, 0.0_f64), |(low, high), k| {
            (low.min(self.values[k]), high.max(self.values[k]))
        });
        if high > 0.0 { (high / low).sqrt() } else { 1.0 }
    }

    /// The damped step for a gradient.
    pub fn step(&self, gradient: &DVector<f64>, damping: f64) -> DVector<f64> {
        let unscale = |k: usize| self.unscale(k);
        let scaled = DVector::from_fn(gradient.len(), |k, _| gradient[k] * unscale(k));
        let mut along = self.vectors.tr_mul(&scaled);
        for k in 0..along.len() {
            along[k] = if self.determined(k) {
                along[k] / (self.values[k] + damping)
            } else {
                0.0
            };
        }
        let step = &self.vectors * along;
        DVector::from_fn(step.len(), |k, _| step[k] * unscale(k))
    }

    /// Inverse of the Gram matrix on the determined directions.
    pub fn inverse(&self) -> DMatrix<f64> {
        let p = self.values.len();
        let unscale = |k: usize| self.unscale(k);
        DMatrix::from_fn(p, p, |i, j| {
            let along = (0..p).filter(|k| self.determined(*k));
            let sum: f64 = along
                .map(|k| self.vectors[(i, k)] * self.vectors[(j, k)] / self.values[k])
                .sum();
            sum * unscale(i) * unscale(j)
        })
    }

    /// The directions that the samples do not determine.
    pub fn null_directions(&self) -> Vec<NullDirection> {
        let p = self.values.len();
        let undetermined = (0..p).filter(|k| !self.determined(*k));
        let directions = undetermined.map(|k| {
            let components = DVector::from_fn(p, |i, _| {
                let seen = self.scale[i] > 0.0;
                self.vectors[(i, k)] / if seen { self.scale[i] } else { 1.0 }
            });
            NullDirection { components }
        });
        directions.collect()
    }

    /// How far one coefficient of a direction moves the samples, relative to the others.
    pub fn scaled_component(&self, components: &DVector<f64>, coefficient: usize) -> f64 {
        let scale = self.scale[coefficient];
        components[coefficient].abs() * if scale > 0.0 { scale } else { 1.0 }
    }

    /// Whether a coefficient with this standard deviation is in fact undetermined: a part of it lies in undetermined
    /// directions, and going along those as far as is plausible moves it by more than its deviation allows for.
    pub fn is_open(&self, coefficient: usize, deviation: f64) -> bool {
        let undetermined = || (0..self.values.len()).filter(|k| !self.determined(*k));
        let part = |k: usize| self.vectors[(coefficient, k)];
        let share: f64 = undetermined().map(|k| part(k).powi(2)).sum();
        if share <= rounding::WRITTEN {
            return false;
        }
        let unscale = self.unscale(coefficient);
        let moved = undetermined().map(|k| (part(k) * unscale * self.furthest[k]).powi(2));
        let moved = moved.sum::<f64>().sqrt();
        moved.is_nan() || moved > NEGLIGIBLE * deviation
    }
}

/// The factorisation for steps: the eigenvectors, or for many coefficients, all clearly determined, a Cholesky factor,
/// which is many times faster.
pub(super) enum StepSolver {
    Spectrum(Spectrum),
    Factored(Factored),
}

/// Scales of the coefficients and the scaled Gram matrix with its factor.
pub(super) struct Factored {
    inverse_scale: DVector<f64>,
    scaled: DMatrix<f64>,
    factor: Cholesky<f64, Dyn>,
}

/// Of fewer coefficients the eigenvectors take no time.
const MANY_COEFFICIENTS: usize = 128;

impl StepSolver {
    /// Of the Gram matrix of a model's columns and extra columns, with what counts as determined
    /// ([`Spectrum::within`]).
    pub(super) fn of(gram: &DMatrix<f64>, model: &Model, reaches: &[f64], least: f64) -> Self {
        let factored = (gram.nrows() >= MANY_COEFFICIENTS)
            .then(|| Factored::of(gram, model, reaches, least))
            .flatten();
        let apart = || Self::Spectrum(Spectrum::of_model(gram, model).within(reaches, least));
        factored.map_or_else(apart, Self::Factored)
    }

    pub(super) fn step(&self, gradient: &DVector<f64>, damping: f64) -> DVector<f64> {
        match self {
            Self::Spectrum(spectrum) => spectrum.step(gradient, damping),
            Self::Factored(factored) => factored.step(gradient, damping),
        }
    }

    /// The spectrum, which is asked for where it is not known.
    pub(super) fn into_spectrum(self, spectrum: impl FnOnce() -> Spectrum) -> Spectrum {
        match self {
            Self::Spectrum(spectrum) => spectrum,
            Self::Factored(_) => spectrum(),
        }
    }
}

impl Factored {
    /// `None` where a direction may be undetermined by [`Spectrum::within`].
    fn of(gram: &DMatrix<f64>, model: &Model, reaches: &[f64], least: f64) -> Option<Self> {
        let (gram, held) = without_held(gram, model);
        let (scale, scaled) = scaled(&gram);
        let factor = scaled.clone().cholesky()?;
        // λ ≥ 1/‖L⁻¹‖², and a direction has no component above 1.
        let smallest = 1.0 / inverse_of_lower(&factor.l()).norm_squared();
        let reach = |k: usize| reaches[k] * scale[k];
        let shortest = (0..reaches.len())
            .filter(|k| !held.contains(k))
            .map(reach)
            .fold(f64::INFINITY, f64::min);
        let all = smallest > RANK_TOLERANCE && smallest * shortest * shortest >= least;
        let mut inverse_scale = scale.map(|s| if s > 0.0 { 1.0 / s } else { 0.0 });
        for k in held {
            inverse_scale[k] = 0.0;
        }
        all.then_some(Self {
            inverse_scale,
            scaled,
            factor,
        })
    }

    fn step(&self, gradient: &DVector<f64>, damping: f64) -> DVector<f64> {
        let scaled = gradient.component_mul(&self.inverse_scale);
        let damped = (damping > 0.0).then(|| {
            let mut damped = self.scaled.clone();
            for k in 0..damped.nrows() {
                damped[(k, k)] += damping;
            }
            damped.cholesky()
        });
        let factor = damped.flatten();
        let step = factor.as_ref().unwrap_or(&self.factor).solve(&scaled);
        step.component_mul(&self.inverse_scale)
    }
}

/// The roots of a Gram matrix's diagonal, and the matrix in units of them.
fn scaled(gram: &DMatrix<f64>) -> (DVector<f64>, DMatrix<f64>) {
    let root = |d: f64| if d > 0.0 { d.sqrt() } else { 0.0 };
    let scale = gram.diagonal().map(root);
    let inverse = scale.map(|s| if s > 0.0 { 1.0 / s } else { 0.0 });
    let scaled = DMatrix::from_fn(gram.nrows(), gram.ncols(), |i, j| {
        gram[(i, j)] * inverse[i] * inverse[j]
    });
    (scale, scaled)
}

/// A Gram matrix in which each coefficient that a model holds is a separate direction, which takes no step as its
/// gradient is zero; and which these are.
fn without_held<'g>(gram: &'g DMatrix<f64>, model: &Model) -> (Cow<'g, DMatrix<f64>>, Vec<usize>) {
    let columns = model.columns().enumerate();
    let held: Vec<usize> = columns
        .filter(|(_, (term, k))| term.held.contains(*k))
        .map(|(column, _)| column)
        .collect();
    let mut apart = Cow::Borrowed(gram);
    for k in &held {
        apart.to_mut()[(*k, *k)] = 1.0;
    }
    (apart, held)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::example::sweep;

    /// The second column adds little to the first: how far the second may go is undetermined, and moves the first by a
    /// thousandth.
    #[test]
    fn what_an_open_coefficient_may_do_to_another_decides_whether_that_is_known() {
        let columns = DMatrix::from_row_slice(2, 2, &[1.0, 1e-3, 0.0, 1e-4]);
        let spectrum = Spectrum::new(&columns.tr_mul(&columns)).within(&[1.0, 1.0], 1e-6);
        assert_eq!(spectrum.rank(), 1);
        assert!(!spectrum.is_open(0, 0.1) && spectrum.is_open(0, 1e-4));
        assert!(spectrum.is_open(1, 0.1));
    }

    /// Products of wild columns, one of them a hundredth of the others, one scaled by a thousand.
    fn gram_of(columns: usize) -> DMatrix<f64> {
        let wild = |i: usize, j: usize| (((i + 3) * (2 * j + 5)) as f64 * 0.37).sin();
        let mut all = DMatrix::from_fn(3 * columns, columns, wild);
        let near = all.column(0) + all.column(1) * 0.01;
        all.set_column(1, &near);
        all.column_mut(2).scale_mut(1000.0);
        all.tr_mul(&all)
    }

    #[test]
    fn many_coefficients_step_as_their_eigenvectors_do() {
        let model = Model::new(sweep([0.0, 0.0, 1.0]).robot, Vec::new());
        let gram = gram_of(MANY_COEFFICIENTS);
        let reaches = vec![f64::INFINITY; MANY_COEFFICIENTS];
        let quick = StepSolver::of(&gram, &model, &reaches, 4.0);
        assert!(matches!(quick, StepSolver::Factored(_)));
        let apart = Spectrum::new(&gram).within(&reaches, 4.0);
        let gradient = DVector::from_fn(MANY_COEFFICIENTS, |k, _| (k as f64).cos());
        for damping in [0.0, 1e-6, 0.1] {
            let (a, b) = (
                quick.step(&gradient, damping),
                apart.step(&gradient, damping),
            );
            assert!((&a - &b).norm() < 1e-8 * b.norm(), "{damping}");
        }
    }

    #[test]
    fn what_may_be_undetermined_is_taken_apart() {
        let model = Model::new(sweep([0.0, 0.0, 1.0]).robot, Vec::new());
        let gram = gram_of(MANY_COEFFICIENTS);
        let mut reaches = vec![f64::INFINITY; MANY_COEFFICIENTS];
        // Over all of its range the first column may show nothing.
        reaches[0] = 1e-6;
        let short = StepSolver::of(&gram, &model, &reaches, 4.0);
        assert!(matches!(short, StepSolver::Spectrum(_)));
        let mut twice = gram.clone();
        let copy = gram.column(0).into_owned();
        twice.set_column(1, &copy);
        twice.set_row(1, &copy.transpose());
        twice[(1, 1)] = gram[(0, 0)];
        let reaches = vec![f64::INFINITY; MANY_COEFFICIENTS];
        let copies = StepSolver::of(&twice, &model, &reaches, 0.0);
        assert!(matches!(copies, StepSolver::Spectrum(_)));
    }
}
