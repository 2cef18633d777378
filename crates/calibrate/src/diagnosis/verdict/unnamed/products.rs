//! Products of whitened columns, fold by fold: of the geometry, of the families and of the residual.

use nalgebra::{Cholesky, DMatrix, DVector};

use crate::linear::{cross, gram, solve_lower};

/// What is added to a geometry's own products, in units of a column: directions that the rows do not
/// show stay as they are.
const RIDGE: f64 = 1e-9;

/// Products over some rows; the geometry's columns first, then the families', the residual last.
#[derive(Debug, Clone)]
pub(super) struct Products {
    gram: DMatrix<f64>,
    /// Columns of the geometry.
    geometry: usize,
    pub(super) rows: f64,
}

impl Products {
    /// Of these rows.
    pub(super) fn of(all: &DMatrix<f64>, geometry: usize, rows: &[usize]) -> Self {
        let own = all.select_rows(rows);
        Self {
            gram: gram(&own),
            geometry,
            rows: rows.len() as f64,
        }
    }

    /// The same with so many families' columns more, the last ones but the residual.
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
            geometry: self.geometry,
            rows: self.rows,
        }
    }

    /// These and others together (`sign` 1), or without them (−1).
    pub(super) fn and(&self, other: &Self, sign: f64) -> Self {
        Self {
            gram: &self.gram + &other.gram * sign,
            geometry: self.geometry,
            rows: self.rows + sign * other.rows,
        }
    }

    /// Only some of the families' columns.
    pub(super) fn only(&self, columns: &[usize]) -> Self {
        let families = columns.iter().map(|k| self.geometry + k);
        let kept: Vec<usize> = (0..self.geometry)
            .chain(families)
            .chain([self.gram.nrows() - 1])
            .collect();
        Self {
            gram: self.gram.select_rows(&kept).select_columns(&kept),
            ..*self
        }
    }

    /// Directions of the geometry.
    pub(super) fn rank(&self) -> usize {
        (0..self.geometry)
            .filter(|k| self.gram[(*k, *k)] > 0.0)
            .count()
    }

    fn factor(&self) -> Option<Cholesky<f64, nalgebra::Dyn>> {
        let mut own = self
            .gram
            .view((0, 0), (self.geometry, self.geometry))
            .into_owned();
        for k in 0..self.geometry {
            own[(k, k)] += RIDGE;
        }
        own.cholesky()
    }

    /// The families' products, those with the residual, and its square, with the geometry taken out.
    pub(super) fn without_geometry(&self) -> Option<(DMatrix<f64>, DVector<f64>, f64)> {
        let (n, p) = (self.geometry, self.gram.nrows() - self.geometry - 1);
        let cross = self.gram.view((0, n), (n, p + 1)).into_owned();
        let inner = self.gram.view((n, n), (p + 1, p + 1));
        let left = if n == 0 {
            inner.into_owned()
        } else {
            // L⁻¹ of the cross products, once: what the geometry takes is its square.
            let taken = solve_lower(self.factor()?.l_dirty(), cross);
            inner - gram(&taken)
        };
        Some((
            left.view((0, 0), (p, p)).into_owned(),
            left.view((0, p), (p, 1)).column(0).into_owned(),
            left[(p, p)],
        ))
    }

    /// The step of the geometry beside given coefficients of the families.
    pub(super) fn geometry(&self, coefficients: &DVector<f64>) -> Option<DVector<f64>> {
        let (n, p) = (self.geometry, coefficients.len());
        if n == 0 {
            return Some(DVector::zeros(0));
        }
        let last = self.gram.nrows() - 1;
        let y = self.gram.view((0, last), (n, 1)).column(0).into_owned();
        let taken = self.gram.view((0, n), (n, p)) * coefficients;
        Some(self.factor()?.solve(&(y - taken)))
    }
}
