//! The information on the parameters of a model, and what candidates would add to it (D-optimality):
//!
//! ```text
//! gain = ln det(1 + J C Jᵀ),   C ← C − C Jᵀ (1 + J C Jᵀ)⁻¹ J C
//! ```
//!
//! with J the rows of a candidate in units of the noise and C the covariance so far. Taking a candidate in or out
//! changes C and all J C Jᵀ by an update of as many ranks as it has rows, without a new inversion.

use std::sync::Arc;

use nalgebra::{Cholesky, DMatrix};

use super::rows::Rows;
use crate::budget;
use crate::linear::cross;

/// The covariance of parameters, and what each candidate would add to the information. A candidate is taken once.
#[derive(Clone)]
pub(crate) struct Information {
    pub(crate) rows: Arc<Rows>,
    pub(crate) covariance: DMatrix<f64>,
    /// J C Jᵀ of every candidate: its rows are where the candidate's are.
    spread: DMatrix<f64>,
    pub(super) taken: Vec<bool>,
}

/// What changes with a candidate whose innovation `1 ± J C Jᵀ` is `L Lᵀ`.
pub(crate) struct Update {
    /// L.
    pub(crate) root: DMatrix<f64>,
    /// `L⁻¹ J C`: the change of the parameters by the innovation of each row.
    pub(crate) gain: DMatrix<f64>,
    /// The same in the rows of all candidates, in rows.
    pub(crate) moved: DMatrix<f64>,
}

impl Information {
    /// Candidates given what is known.
    pub(crate) fn new(rows: impl Into<Arc<Rows>>, covariance: DMatrix<f64>) -> Self {
        let rows = rows.into();
        let most = (0..rows.len()).map(|k| rows.place(k).1).max().unwrap_or(0);
        let mut new = Self {
            spread: DMatrix::zeros(rows.columns.ncols(), most),
            taken: vec![false; rows.len()],
            rows,
            covariance,
        };
        new.refresh();
        new
    }

    /// Every J C Jᵀ from the covariance as it is now.
    pub(crate) fn refresh(&mut self) {
        let Rows { columns, first, .. } = &*self.rows;
        // So many rows at a time that what the covariance makes of them needs little room.
        let mut from = 0;
        while from + 1 < first.len() {
            let more = first[from..].partition_point(|f| f - first[from] <= budget::AT_ONCE);
            let to = (from + more - 1).max(from + 1);
            let start = first[from];
            let products = &self.covariance * columns.columns(start, first[to] - start);
            for pair in first[from..=to].windows(2) {
                let size = pair[1] - pair[0];
                let own = products.columns(pair[0] - start, size);
                let mut to = self.spread.view_mut((pair[0], 0), (size, size));
                to.copy_from(&own.tr_mul(&columns.columns(pair[0], size)));
            }
            from = to;
        }
    }

    /// Lower triangular root of 1 ± J C Jᵀ of a candidate.
    pub(crate) fn innovation(&self, candidate: usize, sign: f64) -> Option<DMatrix<f64>> {
        let (first, size) = self.rows.place(candidate);
        let innovation = DMatrix::from_fn(size, size, |i, j| {
            f64::from(u8::from(i == j)) + sign * self.spread[(first + i, j)]
        });
        innovation.cholesky().map(Cholesky::unpack)
    }

    /// What a candidate would add, whether it is taken or not.
    pub(crate) fn gain(&self, candidate: usize) -> f64 {
        let root = self.innovation(candidate, 1.0);
        root.map_or(0.0, |root| {
            2.0 * root.diagonal().iter().map(|d| d.ln()).sum::<f64>()
        })
    }

    /// Takes the rows of a candidate in (`sign` 1) or out (−1).
    pub(crate) fn update(&mut self, candidate: usize, sign: f64) -> Option<Update> {
        let own = self.rows.of(candidate);
        let size = own.ncols();
        let root = self.innovation(candidate, sign)?;
        let gain = root.solve_lower_triangular(&own.tr_mul(&self.covariance))?;
        self.taken[candidate] = sign > 0.0;
        self.covariance.gemm_tr(-sign, &gain, &gain, 1.0);
        let moved = cross(&self.rows.columns, &gain.transpose());
        for pair in self.rows.first.windows(2) {
            for i in pair[0]..pair[1] {
                for j in pair[0]..pair[1] {
                    let change: f64 = (0..size).map(|k| moved[(i, k)] * moved[(j, k)]).sum();
                    self.spread[(i, j - pair[0])] -= sign * change;
                }
            }
        }
        Some(Update { root, gain, moved })
    }
}
