//! Gram matrices of every candidate's columns, and of their projections orthogonal to a basis: with `Q` the
//! orthonormal columns of a fit and `A = QᵀW`, `PᵀP = WᵀW − AᵀA`, so that no column is written out.

use nalgebra::DMatrix;

use crate::diagnosis::candidates::columns::{CandidateSubset, Columns};
use crate::diagnosis::candidates::table::Candidate;
use crate::fit::noise::Filter;
use crate::lanes::LANES;
use crate::linear::{Basis, gram, inverse_of_lower, reject_all, small_cholesky};
use crate::rounding;

/// Gram matrices of every candidate's own columns, one after the other.
#[derive(Debug, Clone)]
pub(crate) struct Grams {
    values: Vec<f64>,
    /// Where each candidate's starts, by its first column.
    at: Vec<usize>,
}

/// The least square norm of the projection of a column with this square for a candidate to count.
fn least_seen(square: f64) -> f64 {
    (rounding::WRITTEN * square).max(1e-300)
}

impl CandidateSubset {
    /// Whether a candidate is one of them.
    pub(crate) fn has(self, candidate: &Candidate) -> bool {
        match self {
            Self::All => true,
            Self::Names => candidate.named(),
        }
    }
}

impl Grams {
    pub(crate) fn new(columns: &Columns, filter: &Filter, candidates: &[Candidate]) -> Self {
        let mut values = Vec::new();
        let mut at = vec![0; columns.count()];
        let mut order: Vec<&Candidate> = candidates.iter().collect();
        order.sort_by_key(|c| c.first);
        let mut order = order.as_slice();
        while let Some(from) = order.first().map(|c| c.first) {
            let some = order
                .partition_point(|c| c.first + c.size <= from + LANES)
                .max(1);
            let (now, rest) = order.split_at(some);
            order = rest;
            let width = now.iter().map(|c| c.size).sum();
            let white = columns.white(filter, from, width, 0);
            for candidate in now {
                let (first, k) = (candidate.first - from, candidate.size);
                at[candidate.first] = values.len();
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
        }
        Self { values, at }
    }

    pub(crate) fn of(&self, candidate: &Candidate) -> &[f64] {
        let at = self.at[candidate.first];
        &self.values[at..at + candidate.size * candidate.size]
    }

    /// The Gram matrices of the projections of some candidates orthogonal to columns whose products with them are
    /// known.
    pub(super) fn less<'c>(
        &self,
        along: &DMatrix<f64>,
        candidates: impl Iterator<Item = &'c Candidate>,
    ) -> Self {
        let mut remaining = self.clone();
        for candidate in candidates {
            let (first, k) = (candidate.first, candidate.size);
            let own = &mut remaining.values[self.at[first]..][..k * k];
            for i in 0..k {
                let a = along.column(first + i);
                for j in 0..=i {
                    own[i * k + j] -= a.dot(&along.column(first + j));
                }
            }
        }
        remaining
    }

    /// The least square norm of the projection of every column of the candidates for it to count.
    pub(super) fn least(&self, candidates: &[Candidate]) -> Vec<f64> {
        let mut least = vec![1e-300; self.at.len()];
        for candidate in candidates {
            let (k, whole) = (candidate.size, self.of(candidate));
            for i in 0..k {
                least[candidate.first + i] = least_seen(whole[i * k + i]);
            }
        }
        least
    }
}

/// Of candidates with so many columns each, orthonormal bases of their projections orthogonal to a basis; `None` where
/// some are linearly dependent on it.
pub(crate) fn projected_units(
    white: DMatrix<f64>,
    sizes: impl Iterator<Item = usize>,
    basis: &Basis,
) -> Vec<Option<DMatrix<f64>>> {
    let tolerances: Vec<f64> = white
        .column_iter()
        .map(|c| least_seen(c.norm_squared()))
        .collect();
    let mut free = white;
    reject_all(&basis.q, &mut free);
    let mut first = 0;
    let one = |k: usize| {
        let own = free.columns(first, k);
        let tolerance = &tolerances[first..first + k];
        first += k;
        orthonormal(own.into_owned(), tolerance)
    };
    sizes.map(one).collect()
}

/// The same span, orthonormal; `None` where the projection of a column orthogonal to the others is less than this.
fn orthonormal(columns: DMatrix<f64>, tolerance: &[f64]) -> Option<DMatrix<f64>> {
    let k = columns.ncols();
    let mut factor: Vec<f64> = gram(&columns).as_slice().to_vec();
    if small_cholesky(&mut factor, k, tolerance) < k {
        return None;
    }
    let lower = DMatrix::from_row_slice(k, k, &factor);
    Some(columns * inverse_of_lower(&lower).transpose())
}
