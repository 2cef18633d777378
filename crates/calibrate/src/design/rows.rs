//! The rows of candidates for a model, in units of the noise:
//!
//! ```text
//! J = ∂y/∂β / σ,   d = (y′ − y) / σ
//! ```
//!
//! with y what the model predicts of a row, and y′ what another model does. The rows of all candidates lie in
//! one matrix, which is most of what a planner holds; all criteria that look at one model share it.

use nalgebra::{DMatrix, DMatrixView, DVector};

use crate::effects::{Inputs, Term};
use crate::model::Model;
use crate::observations::Layer;

/// The coefficients that are not held: the column of each, its term, and which it is there.
pub(crate) fn free(model: &Model) -> impl Iterator<Item = (usize, &Term, usize)> {
    let all = model.columns().enumerate();
    all.filter(|(_, (term, k))| !term.held.contains(*k))
        .map(|(column, (term, k))| (column, term, k))
}

/// Columns and differences of a model in the rows of all candidates.
#[derive(Debug, Clone)]
pub(crate) struct Rows {
    /// Coefficients by rows: each row of the model is a column.
    pub(crate) columns: DMatrix<f64>,
    pub(crate) difference: DVector<f64>,
    /// First row of each candidate, and the end.
    pub(crate) first: Vec<usize>,
}

impl Rows {
    /// Zeros; `sizes` are the numbers of rows of the candidates.
    pub(crate) fn zeros(coefficients: usize, sizes: impl Iterator<Item = usize>) -> Self {
        let mut first = vec![0];
        first.extend(sizes.scan(0, |end, size| {
            *end += size;
            Some(*end)
        }));
        let all = first.last().copied().unwrap_or(0);
        Self {
            columns: DMatrix::zeros(coefficients, all),
            difference: DVector::zeros(all),
            first,
        }
    }

    /// Coordinates of points along these axes, whose noise is σ: what `other` has for coefficients, and how
    /// far `truth` is from it.
    pub(crate) fn of_points(
        [truth, other]: [&Model; 2],
        inputs: &Inputs,
        axes: &[usize],
        sigma_mm: [f64; 3],
    ) -> Self {
        let size = std::iter::repeat_n(axes.len(), inputs.len());
        let mut all = Self::zeros(other.coefficient_count(), size);
        let predicted = truth.predict(inputs);
        other.visit(inputs, true, |start, block| {
            for lane in 0..block.len {
                let at = predicted.get(start + lane);
                for (row, axis) in axes.iter().enumerate() {
                    let to = (start + lane) * axes.len() + row;
                    let sigma = sigma_mm[*axis];
                    all.difference[to] = (at[*axis] - block.point[*axis][lane]) / sigma;
                    for (k, column) in block.columns.iter().enumerate() {
                        all.columns[(k, to)] = column[*axis][lane] / sigma;
                    }
                }
            }
        });
        all
    }

    /// The residuals of every sample of a layer that is fitted, as the difference, in these units of the layer's rows;
    /// and the information of the priors: distances between sockets.
    pub(crate) fn of_layer(layer: &Layer, model: &Model, unit: [f64; 3]) -> (Self, DMatrix<f64>) {
        let mut sizes = vec![0; layer.session.samples.len()];
        let mut before = vec![0; layer.items.len()];
        for (index, item) in layer.items.iter().enumerate().filter(|i| layer.fit[i.0]) {
            before[index] = sizes[item.sample];
            sizes[item.sample] += item.rows;
        }
        let p = model.coefficient_count();
        let mut all = Self::zeros(p, sizes.into_iter());
        let mut prior = DMatrix::zeros(p, p);
        layer.visit(model, true, |block| {
            for (lane, item) in block.items.iter().enumerate() {
                for row in (0..3).filter(|row| block.rows[*row][lane]) {
                    let of = |k: usize| block.columns[k][row][lane] / unit[row];
                    match *item {
                        None => {
                            let own = DVector::from_fn(p, |k, _| of(k));
                            prior.ger(1.0, &own, &own, 1.0);
                        }
                        Some(item) if layer.fit[item] => {
                            let to = all.first[layer.items[item].sample] + before[item] + row;
                            all.difference[to] = block.left[row][lane] / unit[row];
                            (0..p).for_each(|k| all.columns[(k, to)] = of(k));
                        }
                        Some(_) => {}
                    }
                }
            }
        });
        (all, prior)
    }

    /// Some of the coefficients alone.
    pub(crate) fn only(&self, coefficients: &[usize]) -> Self {
        Self {
            columns: self.columns.select_rows(coefficients),
            difference: self.difference.clone(),
            first: self.first.clone(),
        }
    }

    /// Candidates from this one on.
    pub(crate) fn from(&self, candidate: usize) -> Self {
        let from = self.first[candidate];
        let more = self.difference.len() - from;
        Self {
            columns: self.columns.columns(from, more).into_owned(),
            difference: self.difference.rows(from, more).into_owned(),
            first: self.first[candidate..].iter().map(|f| f - from).collect(),
        }
    }

    /// How many candidates there are.
    pub(crate) fn len(&self) -> usize {
        self.first.len().saturating_sub(1)
    }

    /// First row of a candidate and how many it has.
    pub(crate) fn place(&self, candidate: usize) -> (usize, usize) {
        let first = self.first[candidate];
        (first, self.first[candidate + 1] - first)
    }

    /// The rows of a candidate, each in a column.
    pub(crate) fn of(&self, candidate: usize) -> DMatrixView<'_, f64> {
        let (first, size) = self.place(candidate);
        self.columns.columns(first, size)
    }

    /// Squared length of each coefficient's column over all candidates.
    pub(crate) fn squares(&self) -> Vec<f64> {
        let of = |k: usize| (0..self.len()).map(move |c| self.of(c).row(k).norm_squared());
        (0..self.columns.nrows()).map(|k| of(k).sum()).collect()
    }

    /// The information of all candidates together.
    pub(crate) fn information(&self) -> DMatrix<f64> {
        let mut all = DMatrix::zeros(self.columns.nrows(), self.columns.nrows());
        self.add_to(&mut all, 0..self.len());
        all
    }

    /// Adds the information of some candidates, `JᵀJ`.
    pub(crate) fn add_to(
        &self,
        information: &mut DMatrix<f64>,
        candidates: impl IntoIterator<Item = usize>,
    ) {
        for candidate in candidates {
            let own = self.of(candidate);
            information.gemm(1.0, &own, &own.transpose(), 1.0);
        }
    }
}
