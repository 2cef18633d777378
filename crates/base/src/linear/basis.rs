//! An orthonormal basis by Cholesky factors of products, done twice (`CholeskyQR2`, Yamamoto et al. 2015), which drops
//! columns that the ones before them already explain:
//!
//! ```text
//! AᵀA = L Lᵀ,   Q = A L⁻ᵀ,   QᵀQ = M Mᵀ,   Q ← Q M⁻ᵀ,   R = (L M)ᵀ
//! ```

use nalgebra::{DMatrix, DVector};

use super::products::gram;
use super::triangle::{inverse_of_lower, small_cholesky};

/// A column whose projection orthogonal to the others is less than this share of it is a copy of them.
pub const DEPENDENT: f64 = 1e-6;

/// `C = Q R`, and which columns are linearly independent of those before them.
fn orthonormal(columns: &DMatrix<f64>) -> (DMatrix<f64>, DMatrix<f64>, Vec<bool>) {
    let p = columns.ncols();
    let mut q = columns.clone();
    let mut r = DMatrix::identity(p, p);
    let mut is_copy = vec![false; p];
    for _ in 0..2 {
        let mut factor = gram(&q).as_slice().to_vec();
        small_cholesky(&mut factor, p, &vec![0.0; p]);
        let mut factor = DMatrix::from_row_slice(p, p, &factor).lower_triangle();
        for k in 0..p {
            if factor[(k, k)] == 0.0 {
                (factor[(k, k)], is_copy[k]) = (1.0, true);
            }
        }
        q *= inverse_of_lower(&factor).transpose();
        r = factor.transpose() * r;
    }
    let is_independent = |k: usize| !is_copy[k] && r[(k, k)] > DEPENDENT * columns.column(k).norm();
    let is_independent = (0..p).map(is_independent).collect();
    (q, r, is_independent)
}

/// `A = Q R` on the columns that are independent.
#[derive(Debug, Clone)]
pub struct Basis {
    /// Orthonormal columns.
    pub q: DMatrix<f64>,
    /// Upper triangular, one column for each kept column of `A`.
    r: DMatrix<f64>,
    /// Which columns of `A` were kept, in order.
    pub kept: Vec<usize>,
    columns: usize,
}

impl Basis {
    /// Takes a matrix apart.
    pub fn new(a: &DMatrix<f64>) -> Self {
        let mut kept: Vec<usize> = (0..a.ncols()).collect();
        loop {
            let (q, r, is_independent) = orthonormal(&a.select_columns(&kept));
            // Behind a dependent column the others are noise.
            let independent = kept.iter().zip(is_independent).filter(|own| own.1);
            let independent: Vec<usize> = independent.map(|own| *own.0).take(a.nrows()).collect();
            if independent.len() == kept.len() {
                let columns = a.ncols();
                return Self {
                    q,
                    r,
                    kept,
                    columns,
                };
            }
            kept = independent;
        }
    }

    /// Number of independent columns.
    pub fn rank(&self) -> usize {
        self.kept.len()
    }

    /// The norm of the projection of each kept column orthogonal to those that were kept before it.
    pub fn remaining_norms(&self) -> impl Iterator<Item = f64> {
        (0..self.rank()).map(|k| self.r[(k, k)])
    }

    /// The coefficients that bring `A x` closest to `y`; zero for columns that were dropped.
    pub fn solve(&self, y: &DVector<f64>) -> DVector<f64> {
        self.coefficients(self.q.tr_mul(y))
    }

    /// The coefficients of the columns from those of the orthonormal ones; zero for columns that were
    /// dropped.
    pub fn coefficients(&self, mut along: DVector<f64>) -> DVector<f64> {
        self.back_substitute(&mut along);
        self.spread(&along)
    }

    /// `y` without its part in the span.
    pub fn reject(&self, y: &DVector<f64>) -> DVector<f64> {
        let along = self.q.tr_mul(y);
        y - &self.q * along
    }

    /// `(Aᵀ A)⁻¹` on the kept columns; zero elsewhere.
    pub fn inverse_gram(&self) -> DMatrix<f64> {
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
    pub fn only_of(&self, own: &[usize]) -> Option<(DMatrix<f64>, DMatrix<f64>)> {
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

    /// The leverage of row `i`: the share of it that it determines itself.
    pub fn leverage(&self, row: usize) -> f64 {
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

    fn wild(rows: usize, columns: usize) -> DMatrix<f64> {
        DMatrix::from_fn(rows, columns, |i, j| {
            ((i * i * 7 + i * j * 13) as f64 * 0.37).sin()
        })
    }

    /// Also for columns that are nearly dependent on those before them, and few rows.
    #[test]
    fn columns_are_orthonormal_and_give_the_matrix_again() {
        for (m, p) in [(203, 9), (32, 5), (70, 70), (5, 9), (0, 3)] {
            let mut a = wild(m, p);
            if m > 40 {
                let copy = a.column(1) * 2.0;
                a.set_column(3, &copy);
                let near = a.column(2) + 1e-5 * a.column(4);
                a.set_column(5, &near);
                let too_near = a.column(0) + 1e-9 * a.column(7);
                a.set_column(6, &too_near);
            }
            let basis = Basis::new(&a);
            assert_eq!(basis.kept.contains(&3), m <= 40 && m > 0);
            assert!(!basis.kept.contains(&6));
            let one = DMatrix::identity(basis.rank(), basis.rank());
            assert!((basis.q.tr_mul(&basis.q) - one).norm() < 1e-12);
            let again = &basis.q * &basis.r;
            assert!((again - a.select_columns(&basis.kept)).norm() < 1e-11 * a.norm().max(1.0));
        }
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
