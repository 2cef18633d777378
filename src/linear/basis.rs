//! An orthonormal basis by Gram–Schmidt, done twice ("twice is
//! enough", Giraud, Langou & Rozložník 2005), which drops columns that the ones before them already
//! explain.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use super::products::{along, products, subtract};

/// A column of which less than this share is left after projection is a copy of the others.
const DEPENDENT: f64 = 1e-6;

/// `A = Q R` on the columns that are independent.
#[derive(Debug, Clone)]
pub(crate) struct Basis {
    /// Orthonormal columns.
    pub(crate) q: DMatrix<f64>,
    /// Upper triangular, one column for each kept column of `A`.
    r: DMatrix<f64>,
    /// Which columns of `A` were kept, in order.
    pub(crate) kept: Vec<usize>,
    columns: usize,
    /// The basis that its first columns are.
    pub(crate) extends: Option<Arc<Self>>,
}

impl Basis {
    /// Takes a matrix apart.
    pub(crate) fn new(a: &DMatrix<f64>) -> Self {
        let (m, p) = a.shape();
        let mut basis = Self {
            q: DMatrix::zeros(m, p),
            r: DMatrix::zeros(p, p),
            kept: Vec::new(),
            columns: p,
            extends: None,
        };
        for column in 0..p {
            basis.orthogonalize(column, a.column(column).into_owned());
        }
        basis.end()
    }

    /// Takes a matrix apart of which some columns, those of another basis in their order, are known.
    pub(crate) fn extending(known: &Arc<Self>, own: &[usize], a: &DMatrix<f64>) -> Self {
        let (m, p) = a.shape();
        let rank = known.rank();
        let mut basis = Self {
            q: DMatrix::zeros(m, p),
            r: DMatrix::zeros(p, p),
            kept: known.kept.iter().map(|k| own[*k]).collect(),
            columns: p,
            extends: Some(Arc::clone(known)),
        };
        basis.q.columns_mut(0, rank).copy_from(&known.q);
        basis.r.view_mut((0, 0), (rank, rank)).copy_from(&known.r);
        for column in (0..p).filter(|k| !own.contains(k)) {
            basis.orthogonalize(column, a.column(column).into_owned());
        }
        basis.end()
    }

    /// Takes one column more.
    fn orthogonalize(&mut self, column: usize, mut v: DVector<f64>) {
        let m = self.q.nrows();
        let rank = self.kept.len();
        if rank >= m {
            return;
        }
        let before = v.norm();
        let own = &self.q.as_slice()[..rank * m];
        let mut parts = vec![0.0; rank];
        let mut r = vec![0.0; rank];
        for _ in 0..2 {
            products(v.as_slice(), own, &mut parts);
            subtract(own, &parts, v.as_mut_slice());
            for (r, part) in r.iter_mut().zip(&parts) {
                *r += part;
            }
        }
        let norm = v.norm();
        if norm > DEPENDENT * before && norm > 0.0 {
            self.r.view_mut((0, rank), (rank, 1)).copy_from_slice(&r);
            self.r[(rank, rank)] = norm;
            self.q.set_column(rank, &(v / norm));
            self.kept.push(column);
        }
    }

    fn end(mut self) -> Self {
        let rank = self.kept.len();
        self.q = self.q.resize_horizontally(rank, 0.0);
        self.r = self.r.view((0, 0), (rank, rank)).into_owned();
        self
    }

    /// Number of independent columns.
    pub(crate) fn rank(&self) -> usize {
        self.kept.len()
    }

    /// The coefficients that bring `A x` closest to `y`; zero for columns that were dropped.
    pub(crate) fn solve(&self, y: &DVector<f64>) -> DVector<f64> {
        self.coefficients(along(&self.q, y))
    }

    /// The coefficients of the columns from those of the orthonormal ones; zero for columns that were
    /// dropped.
    pub(crate) fn coefficients(&self, mut along: DVector<f64>) -> DVector<f64> {
        self.back_substitute(&mut along);
        self.spread(&along)
    }

    /// `y` without its part in the span.
    pub(crate) fn reject(&self, y: &DVector<f64>) -> DVector<f64> {
        let along = along(&self.q, y);
        y - &self.q * along
    }

    /// `(Aᵀ A)⁻¹` on the kept columns; zero elsewhere.
    pub(crate) fn inverse_gram(&self) -> DMatrix<f64> {
        let rank = self.rank();
        let mut inverse_r = DMatrix::identity(rank, rank);
        for k in 0..rank {
            let mut column = inverse_r.column(k).into_owned();
            self.back_substitute(&mut column);
            inverse_r.set_column(k, &column);
        }
        let own = &inverse_r * inverse_r.transpose();
        let mut all = DMatrix::zeros(self.columns, self.columns);
        for (i, a) in self.kept.iter().enumerate() {
            for (j, b) in self.kept.iter().enumerate() {
                all[(*a, *b)] = own[(i, j)];
            }
        }
        all
    }

    /// What some columns of `A` alone span: `c`, with `Q c` orthonormal and orthogonal to all other columns, and
    /// `(Q c)ᵀ A` of those columns. `None` where the others span all of it.
    ///
    /// The columns of `R⁻ᵀ` are dual to those of `A`.
    pub(crate) fn only_of(&self, own: &[usize]) -> Option<(DMatrix<f64>, DMatrix<f64>)> {
        let rank = self.rank();
        let at: Vec<usize> = (0..rank).filter(|k| own.contains(&self.kept[*k])).collect();
        if at.is_empty() {
            return None;
        }
        let mut directions = DMatrix::zeros(rank, at.len());
        for (place, unit) in at.iter().enumerate() {
            let mut dual = vec![0.0; rank];
            for row in *unit..rank {
                let one = if row == *unit { 1.0 } else { 0.0 };
                let column = self.r.column(row);
                let known: f64 = (*unit..row).map(|j| column[j] * dual[j]).sum();
                dual[row] = (one - known) / column[row];
            }
            let mut dual = DVector::from_vec(dual);
            for _ in 0..2 {
                for before in 0..place {
                    let along = directions.column(before).dot(&dual);
                    dual.axpy(-along, &directions.column(before), 1.0);
                }
            }
            let norm = dual.norm();
            directions.set_column(place, &(dual / norm.max(1e-300)));
        }
        let mut parts = DMatrix::zeros(at.len(), own.len());
        for unit in &at {
            let along = directions.tr_mul(&self.r.column(*unit));
            let place = own.iter().position(|k| *k == self.kept[*unit]);
            let Some(place) = place else { continue };
            parts.set_column(place, &along);
        }
        Some((directions, parts))
    }

    /// Share of row `i` that the fit explains by itself.
    pub(crate) fn leverage(&self, row: usize) -> f64 {
        self.q.row(row).norm_squared()
    }

    fn back_substitute(&self, x: &mut DVector<f64>) {
        for k in (0..self.rank()).rev() {
            let known: f64 = (k + 1..self.rank()).map(|j| self.r[(k, j)] * x[j]).sum();
            x[k] = (x[k] - known) / self.r[(k, k)];
        }
    }

    fn spread(&self, x: &DVector<f64>) -> DVector<f64> {
        let mut all = DVector::zeros(self.columns);
        for (value, column) in x.iter().zip(&self.kept) {
            all[*column] = *value;
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_basis_that_extends_another_is_as_good() {
        let a = DMatrix::from_fn(50, 6, |i, j| ((i * i * 7 + i * j * 13) as f64 * 0.37).sin());
        let own = [1, 2, 5];
        let known = Arc::new(Basis::new(&a.select_columns(&own)));
        let (whole, extended) = (Basis::new(&a), Basis::extending(&known, &own, &a));
        let y = DVector::from_fn(50, |i, _| (i as f64).cos());
        assert!((whole.solve(&y) - extended.solve(&y)).norm() < 1e-9);
        assert!((whole.reject(&y) - extended.reject(&y)).norm() < 1e-9);
        assert!((whole.inverse_gram() - extended.inverse_gram()).norm() < 1e-9);
        assert_eq!(extended.q.columns(0, 3), known.q.columns(0, 3));
        // A copy of what is known is dropped.
        let mut twice = a.clone();
        twice.set_column(0, &a.column(5));
        assert_eq!(Basis::extending(&known, &own, &twice).kept, [1, 2, 5, 3, 4]);
    }

    #[test]
    fn a_repeated_column_is_dropped_and_the_rest_still_solves() {
        let a = DMatrix::from_row_slice(4, 3, &[1., 2., 0., 1., 2., 1., 1., 2., 2., 1., 2., 3.]);
        let basis = Basis::new(&a);
        assert_eq!(basis.kept, [0, 2]);
        let y = DVector::from_row_slice(&[1.0, 3.0, 5.0, 7.0]);
        let x = basis.solve(&y);
        assert!((x - DVector::from_row_slice(&[1.0, 0.0, 2.0])).norm() < 1e-12);
        assert!(basis.reject(&y).norm() < 1e-12);
    }
}
