//! A fit without some of its rows, from the fit of all of them.
//!
//! With `Q` the orthonormal columns over all rows, `Q_B` the rows that are left out and `A_B` those of
//! any other columns, everything over the rows that stay is a sum over all less one over those (Woodbury
//! 1950):
//!
//! ```text
//! S = 1 − Q_Bᵀ Q_B = L Lᵀ,   W = L⁻¹ (Qᵀ A − Q_Bᵀ A_B),
//! what the others leave of A:  Aᵀ A − A_Bᵀ A_B − Wᵀ W
//! ```

use nalgebra::{DMatrix, DVector};

use crate::linear::{Basis, along, cholesky, gram, inverse_of_lower};

/// A direction of which less than this share (of its square) is seen in the rows that stay is not told by them.
/// A fit without some rows is taken from that of all while those that stay see each direction
/// with a hundred-thousandth of its length; else it is made anew.
const LEAST_SEEN: f64 = 1e-10;

/// A basis of which some rows are left out.
pub(super) struct ReducedBasis<'b> {
    basis: &'b Basis,
    rows: &'b [usize],
    /// `Q_Bᵀ`.
    own: DMatrix<f64>,
    /// `L⁻¹`.
    inverse_root: DMatrix<f64>,
}

impl<'b> ReducedBasis<'b> {
    /// `None` where the rows that stay do not tell all columns.
    pub(crate) fn new(basis: &'b Basis, rows: &'b [usize]) -> Option<Self> {
        let rank = basis.rank();
        let own = basis.q.select_rows(rows);
        let seen = DMatrix::identity(rank, rank) - gram(&own);
        let root = cholesky(seen)?.unpack_dirty();
        if root.diagonal().iter().any(|l| l * l < LEAST_SEEN) {
            return None;
        }
        Some(Self {
            basis,
            rows,
            own: own.transpose(),
            inverse_root: inverse_of_lower(&root),
        })
    }

    /// The rows that are left out.
    pub(crate) fn rows(&self) -> &'b [usize] {
        self.rows
    }

    /// `W` of some columns: `along` is `Qᵀ A`, `without` is `A_B`.
    pub(crate) fn along(&self, along: &DMatrix<f64>, without: &DMatrix<f64>) -> DMatrix<f64> {
        let mut seen = along.clone();
        seen.gemm(-1.0, &self.own, without, 1.0);
        &self.inverse_root * seen
    }

    /// The same of combinations of the basis: `L⁻¹ c`.
    pub(crate) fn within(&self, combinations: &DMatrix<f64>) -> DMatrix<f64> {
        &self.inverse_root * combinations
    }

    /// The coefficients of the basis's columns whose `W` is this.
    pub(crate) fn coefficients(&self, along: &DVector<f64>) -> DVector<f64> {
        self.basis.coefficients(self.inverse_root.tr_mul(along))
    }

    fn along_one(&self, y: &DVector<f64>) -> DVector<f64> {
        let seen = along(&self.basis.q, y) - &self.own * y.select_rows(self.rows);
        &self.inverse_root * seen
    }

    /// The coefficients that bring the columns closest to `y` in the rows that stay.
    pub(crate) fn solve(&self, y: &DVector<f64>) -> DVector<f64> {
        self.coefficients(&self.along_one(y))
    }

    /// What a fit without the rows leaves of them, from what the fit with them leaves:
    /// `(1 − Q_B Q_Bᵀ)⁻¹ r_B`.
    pub(crate) fn unseen(&self, left: &DMatrix<f64>) -> DMatrix<f64> {
        let seen = &self.inverse_root * (&self.own * left);
        let back = self.inverse_root.tr_mul(&seen);
        left + self.own.tr_mul(&back)
    }

    /// The same of a fit without some combinations of the basis, of which the whole fit has so much: with `u` what
    /// they are in the rows, `(1 − Q_B Q_Bᵀ + u uᵀ)⁻¹ (r_B + u β)`, by Woodbury. `None` where the rows that stay do
    /// not tell it.
    pub(super) fn unseen_without(
        &self,
        left: &DMatrix<f64>,
        directions: &DMatrix<f64>,
        explained: &DMatrix<f64>,
    ) -> Option<DMatrix<f64>> {
        let u = self.own.tr_mul(directions);
        let y = left + &u * explained;
        let (of_y, of_u) = (self.unseen(&y), self.unseen(&u));
        let k = u.ncols();
        let inner = (DMatrix::identity(k, k) + u.tr_mul(&of_u)).cholesky()?;
        Some(of_y - &of_u * inner.solve(&of_u.tr_mul(&y)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wild(rows: usize, columns: usize, seed: f64) -> DMatrix<f64> {
        DMatrix::from_fn(rows, columns, |i, j| {
            ((i * i * 7 + i * j * 13 + j) as f64 * 0.37 + seed).sin()
        })
    }

    #[test]
    fn what_is_left_out_might_as_well_never_have_been_there() {
        for every in [4, usize::MAX] {
            left_out_is_gone(every);
        }
    }

    /// Leaves out one row of so many.
    fn left_out_is_gone(every: usize) {
        let (a, more) = (wild(60, 5, 0.0), wild(60, 6, 1.0));
        let y = wild(60, 1, 2.0).column(0).into_owned();
        let out: Vec<usize> = (0..60).filter(|i| (i + 3) % every == 0).collect();
        let stay: Vec<usize> = (0..60).filter(|i| (i + 3) % every != 0).collect();
        let basis = Basis::new(&a);
        let left_out = ReducedBasis::new(&basis, &out).expect("told");

        let anew = Basis::new(&a.select_rows(&stay));
        let seen = y.select_rows(&stay);
        assert!((left_out.solve(&y) - anew.solve(&seen)).amax() < 1e-9);

        // What the rows that stay say of those that do not, with all columns and without one.
        let unseen = |basis: &Basis, a: &DMatrix<f64>| {
            let x = basis.solve(&seen);
            y.select_rows(&out) - a.select_rows(&out) * x
        };
        let of_out = |y: &DVector<f64>| {
            let rows = basis.reject(y).select_rows(&out);
            DMatrix::from_column_slice(rows.len(), 1, rows.as_slice())
        };
        let left = of_out(&y);
        let apart = left_out.unseen(&left).column(0) - unseen(&anew, &a);
        assert!(apart.norm() < 1e-9);
        let (directions, parts) = basis.only_of(&[4]).expect("independent");
        let explained = parts * basis.solve(&y)[4];
        let fewer = a.columns(0, 4).into_owned();
        let expected = unseen(&Basis::new(&fewer.select_rows(&stay)), &fewer);
        let without = left_out.unseen_without(&left, &directions, &explained);
        assert!((without.expect("told").column(0) - expected).norm() < 1e-9);

        // What the others leave of columns that are none of theirs.
        let without = more.select_rows(&out);
        let along = left_out.along(&basis.q.tr_mul(&more), &without);
        let seen = more.select_rows(&stay);
        let left = seen.tr_mul(&seen) - along.tr_mul(&along);
        let free = seen.clone() - &anew.q * anew.q.tr_mul(&seen);
        assert!((left - free.tr_mul(&free)).amax() < 1e-9);
    }

    #[test]
    fn columns_that_only_the_missing_rows_tell_are_refused() {
        let mut a = wild(20, 3, 0.0);
        for i in 5..20 {
            a[(i, 2)] = 0.0;
        }
        let basis = Basis::new(&a);
        assert!(ReducedBasis::new(&basis, &[0, 1, 2, 3, 4]).is_none());
        assert!(ReducedBasis::new(&basis, &[0, 1]).is_some());
    }
}
