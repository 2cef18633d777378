//! The table's columns beside a fit, never written out: with `Q` the fit's orthonormal columns,
//!
//! ```text
//! P = W − Q A,   A = Qᵀ W,   PᵀP = WᵀW − AᵀA,   Pᵀr = Wᵀr − Aᵀ Qᵀ r
//! ```
//!
//! The Gram matrices of the candidates in `W` are known once, so that a scan costs one product of
//! matrices; only the few columns that are looked at closely are made.

use nalgebra::{DMatrix, DVector};

use super::candidates::Candidate;
use super::regression::Regression;
use crate::linear::{Basis, products, small_cholesky, subtract};

/// How much of a column has to be left beside the model for a candidate to count, squared.
const SEEN: f64 = 1e-6;

pub(crate) struct Projected<'r> {
    white: &'r DMatrix<f64>,
    grams: &'r Grams,
    basis: &'r Basis,
    along: DMatrix<f64>,
}

/// Gram matrices of every candidate's own columns, one after the other.
#[derive(Debug)]
pub(crate) struct Grams {
    values: Vec<f64>,
    /// Where each candidate's starts, by its first column.
    at: Vec<usize>,
}

impl Grams {
    pub(crate) fn new(white: &DMatrix<f64>, candidates: &[Candidate]) -> Self {
        let mut values = Vec::new();
        let mut at = vec![0; white.ncols()];
        for candidate in candidates {
            let (first, k) = (candidate.first, candidate.size);
            at[first] = values.len();
            for i in 0..k {
                let a = white.column(first + i);
                for j in 0..k {
                    values.push(if j <= i {
                        a.dot(&white.column(first + j))
                    } else {
                        0.0
                    });
                }
            }
        }
        Self { values, at }
    }

    fn of(&self, candidate: &Candidate) -> &[f64] {
        let at = self.at[candidate.first];
        &self.values[at..at + candidate.size * candidate.size]
    }
}

impl<'r> Projected<'r> {
    pub(crate) fn new(regression: &'r Regression, basis: &'r Basis) -> Self {
        Self {
            along: basis.q.transpose() * &regression.white,
            white: &regression.white,
            grams: &regression.grams,
            basis,
        }
    }

    /// Cholesky factor of a candidate's columns (lower, row by row), and their rank.
    pub(crate) fn factor(&self, candidate: &Candidate) -> (Vec<f64>, usize) {
        let (first, k) = (candidate.first, candidate.size);
        let whole = self.grams.of(candidate);
        let mut gram = whole.to_vec();
        for i in 0..k {
            let a = self.along.column(first + i);
            for j in 0..=i {
                gram[i * k + j] -= a.dot(&self.along.column(first + j));
            }
        }
        let tolerance: Vec<f64> = (0..k)
            .map(|i| (SEEN * whole[i * k + i]).max(1e-300))
            .collect();
        let rank = small_cholesky(&mut gram, k, &tolerance);
        (gram, rank)
    }

    pub(crate) fn columns(&self, candidate: &Candidate) -> DMatrix<f64> {
        let (first, k) = (candidate.first, candidate.size);
        let mut own = self.white.columns(first, k).into_owned();
        let (height, rank) = (own.nrows().max(1), self.along.nrows());
        let along = &self.along.as_slice()[first * rank..];
        for (i, column) in own.as_mut_slice().chunks_exact_mut(height).enumerate() {
            subtract(
                self.basis.q.as_slice(),
                &along[i * rank..(i + 1) * rank],
                column,
            );
        }
        own
    }

    /// Products of all columns with a residual.
    pub(crate) fn pulls(&self, residual: &DVector<f64>) -> DVector<f64> {
        let inside = self.basis.q.tr_mul(residual);
        let mut pulls = DVector::zeros(self.white.ncols());
        products(
            residual.as_slice(),
            self.white.as_slice(),
            pulls.as_mut_slice(),
        );
        pulls.gemv_tr(-1.0, &self.along, &inside, 1.0);
        pulls
    }
}
