//! Products of whitened columns, fold by fold: of the base, of columns without a name and of the residual.

use nalgebra::{Cholesky, DMatrix, DVector};

use crate::fit::spectrum::Spectrum;
use crate::linear::{cross, gram, solve_lower};
use crate::rounding;

/// Products over some rows; the base's columns first, then those without a name, the residual last.
#[derive(Debug, Clone)]
pub(super) struct Products {
    gram: DMatrix<f64>,
    /// Columns of the base.
    base: usize,
    pub(super) rows: f64,
}

impl Products {
    /// Of these rows; `floor` is the square of the rounding in one of them.
    pub(super) fn of(all: &DMatrix<f64>, base: usize, rows: &[usize], floor: f64) -> Self {
        let mut gram = gram(&all.select_rows(rows));
        let last = gram.nrows() - 1;
        gram[(last, last)] += floor * rows.len() as f64;
        Self {
            gram,
            base,
            rows: rows.len() as f64,
        }
    }

    /// The same with so many columns without a name more, the last ones but the residual.
    pub(super) fn with(&self, all: &DMatrix<f64>, more: usize, rows: &[usize]) -> Self {
        let own = all.select_rows(rows);
        let first = own.ncols() - 1 - more;
        let new = cross(&own, &own.columns(first, more).into_owned());
        let gram = self.gram.clone().insert_columns(first, more, 0.0);
        let mut gram = gram.insert_rows(first, more, 0.0);
        gram.columns_mut(first, more).copy_from(&new);
        gram.rows_mut(first, more).copy_from(&new.transpose());
        Self {
            gram,
            base: self.base,
            rows: self.rows,
        }
    }

    /// These and others together (`sign` 1), or without them (−1).
    pub(super) fn and(&self, other: &Self, sign: f64) -> Self {
        Self {
            gram: &self.gram + &other.gram * sign,
            base: self.base,
            rows: self.rows + sign * other.rows,
        }
    }

    /// Only some of the columns without a name.
    pub(super) fn only(&self, columns: &[usize]) -> Self {
        let families = columns.iter().map(|k| self.base + k);
        let kept: Vec<usize> = (0..self.base)
            .chain(families)
            .chain([self.gram.nrows() - 1])
            .collect();
        Self {
            gram: self.gram.select_rows(&kept).select_columns(&kept),
            ..*self
        }
    }

    fn of_base(&self) -> DMatrix<f64> {
        let own = (self.base, self.base);
        self.gram.view((0, 0), own).into_owned()
    }

    /// Directions of the base.
    pub(super) fn rank(&self) -> usize {
        Spectrum::new(&self.of_base()).rank()
    }

    /// The projections of the columns without a name on those of the base, to which they are not orthogonal.
    pub(super) fn common(&self) -> DMatrix<f64> {
        let (n, p) = (self.base, self.gram.nrows() - self.base - 1);
        let size = |k: usize| self.gram[(k, k)].max(0.0).sqrt();
        let largest = (n..n + p).map(size).fold(0.0, f64::max);
        let all = self.gram.view((n, 0), (p, n));
        let is_common = |k: &usize| all.column(*k).norm() > rounding::COMPUTED * size(*k) * largest;
        let kept: Vec<usize> = (0..n).filter(is_common).collect();
        let mut common = all.select_columns(&kept);
        for mut own in common.column_iter_mut() {
            let norm = own.norm();
            own.unscale_mut(norm);
        }
        common
    }

    fn factor(&self) -> Option<Cholesky<f64, nalgebra::Dyn>> {
        let mut own = self.of_base();
        for k in 0..self.base {
            own[(k, k)] += rounding::COMPUTED;
        }
        own.cholesky()
    }

    /// The products of the columns without a name, those with the residual, and its square, projected orthogonal to
    /// the base.
    pub(super) fn without_base(&self) -> Option<(DMatrix<f64>, DVector<f64>, f64)> {
        let (n, p) = (self.base, self.gram.nrows() - self.base - 1);
        let cross = self.gram.view((0, n), (n, p + 1)).into_owned();
        let inner = self.gram.view((n, n), (p + 1, p + 1));
        let projected = if n == 0 {
            inner.into_owned()
        } else {
            // L⁻¹ of the cross products, once: its square is the part in the span of the base.
            let taken = solve_lower(self.factor()?.l_dirty(), cross);
            inner - gram(&taken)
        };
        Some((
            projected.view((0, 0), (p, p)).into_owned(),
            projected.view((0, p), (p, 1)).column(0).into_owned(),
            projected[(p, p)],
        ))
    }

    /// The step of the base given coefficients of the columns without a name, in front of these.
    pub(super) fn with_base(&self, coefficients: &DVector<f64>) -> Option<DVector<f64>> {
        let (n, p) = (self.base, coefficients.len());
        let last = self.gram.nrows() - 1;
        let y = self.gram.view((0, last), (n, 1)).column(0).into_owned();
        let taken = self.gram.view((0, n), (n, p)) * coefficients;
        let base = self.factor()?.solve(&(y - taken));
        let both = base.iter().chain(coefficients.iter()).copied();
        Some(DVector::from_iterator(n + p, both))
    }
}
