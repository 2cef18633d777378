//! The table's columns beside a fit, never written out: with `Q` the fit's orthonormal columns,
//!
//! ```text
//! P = W − Q A,   A = Qᵀ W,   PᵀP = WᵀW − AᵀA,   Pᵀr = Wᵀr − Aᵀ Qᵀ r
//! ```
//!
//! The Gram matrices of the candidates in `W` are known once, so that a scan costs one product of
//! matrices; only the few columns that are looked at closely are made.

use nalgebra::{DMatrix, DVector};

use crate::diagnosis::candidates::columns::{CandidateSubset, Columns};
use crate::diagnosis::candidates::table::Candidate;
use crate::fit::noise::Filter;
use crate::linear::{Basis, along, gram, reject_all, small_cholesky};
use crate::side_by_side::Threads;

/// How much of a column has to be left beside the model for a candidate to count, squared.
const SEEN: f64 = 1e-6;

pub(crate) struct Projected<'r> {
    columns: &'r Columns,
    filter: &'r Filter,
    grams: &'r Grams,
    basis: &'r Basis,
    along: DMatrix<f64>,
    among: CandidateSubset,
}

/// Gram matrices of every candidate's own columns, one after the other.
#[derive(Debug, Clone)]
pub(crate) struct Grams {
    values: Vec<f64>,
    /// Where each candidate's starts, by its first column.
    at: Vec<usize>,
}

/// What has to be left of a column with this square for a candidate to count.
pub(super) fn least_seen(square: f64) -> f64 {
    (SEEN * square).max(1e-300)
}

impl CandidateSubset {
    /// Whether a candidate is one of them.
    pub(crate) fn has(self, candidate: &Candidate) -> bool {
        match self {
            Self::All => true,
            Self::Names => candidate.named(),
            Self::Shapes => !candidate.named(),
        }
    }
}

/// Columns that are whitened at once.
const AT_ONCE: usize = 64;

impl Grams {
    pub(crate) fn new(columns: &Columns, filter: &Filter, candidates: &[Candidate]) -> Self {
        let mut values = Vec::new();
        let mut at = vec![0; columns.count()];
        let mut order: Vec<&Candidate> = candidates.iter().collect();
        order.sort_by_key(|c| c.first);
        let mut order = order.as_slice();
        while let Some(from) = order.first().map(|c| c.first) {
            let some = order
                .partition_point(|c| c.first + c.size <= from + AT_ONCE)
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
}

/// Of candidates with so many columns each, the orthonormal columns of what a basis leaves of them; `None` where
/// that is not all of them.
pub(crate) fn units_beside(
    white: DMatrix<f64>,
    sizes: impl Iterator<Item = usize>,
    basis: &Basis,
) -> Vec<Option<DMatrix<f64>>> {
    let tolerances: Vec<f64> = white
        .column_iter()
        .map(|c| (SEEN * c.norm_squared()).max(1e-300))
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

/// The same span, orthonormal; `None` where less than this is left of a column beside the others.
fn orthonormal(mut columns: DMatrix<f64>, tolerance: &[f64]) -> Option<DMatrix<f64>> {
    let k = columns.ncols();
    let mut factor: Vec<f64> = gram(&columns).as_slice().to_vec();
    if small_cholesky(&mut factor, k, tolerance) < k {
        return None;
    }
    for i in 0..k {
        for j in 0..i {
            let (before, mut own) = columns.columns_range_pair_mut(j, i);
            own.axpy(-factor[i * k + j], &before, 1.0);
        }
        columns.column_mut(i).unscale_mut(factor[i * k + i]);
    }
    Some(columns)
}

impl<'r> Projected<'r> {
    /// `along` are the products of the candidates' columns with the basis.
    pub(crate) fn new(
        (columns, filter, grams): (&'r Columns, &'r Filter, &'r Grams),
        basis: &'r Basis,
        along: DMatrix<f64>,
        among: CandidateSubset,
    ) -> Self {
        Self {
            columns,
            filter,
            grams,
            basis,
            along,
            among,
        }
    }

    /// Which candidates it knows anything of.
    pub(crate) fn among(&self) -> CandidateSubset {
        self.among
    }

    fn has(&self, candidate: &Candidate) -> bool {
        self.among.has(candidate)
    }

    pub(crate) fn basis(&self) -> &'r Basis {
        self.basis
    }

    /// Cholesky factor of a candidate's columns (lower, row by row), and their rank.
    pub(crate) fn factor(&self, candidate: &Candidate) -> (Vec<f64>, usize) {
        let k = candidate.size;
        let whole = self.grams.of(candidate);
        let mut gram = self.left_of(candidate);
        let tolerance: Vec<f64> = (0..k).map(|i| least_seen(whole[i * k + i])).collect();
        let rank = small_cholesky(&mut gram, k, &tolerance);
        (gram, rank)
    }

    /// Products of what the basis leaves of a candidate's columns (lower, row by row).
    fn left_of(&self, candidate: &Candidate) -> Vec<f64> {
        let (first, k) = (candidate.first, candidate.size);
        let mut gram = self.grams.of(candidate).to_vec();
        for i in 0..k {
            let a = self.along.column(first + i);
            for j in 0..=i {
                gram[i * k + j] -= a.dot(&self.along.column(first + j));
            }
        }
        gram
    }

    /// The same for every candidate; of those that it does not know, what they are.
    pub(crate) fn grams(&self, candidates: &[Candidate]) -> Grams {
        let mut grams = self.grams.clone();
        for candidate in candidates.iter().filter(|c| self.has(c)) {
            let at = grams.at[candidate.first];
            let left = self.left_of(candidate);
            grams.values[at..at + left.len()].copy_from_slice(&left);
        }
        grams
    }

    /// How much has to be left of every column of the candidates for it to count.
    pub(crate) fn least(&self, candidates: &[Candidate]) -> Vec<f64> {
        let mut least = vec![1e-300; self.columns.count()];
        for candidate in candidates {
            let (k, whole) = (candidate.size, self.grams.of(candidate));
            for i in 0..k {
                least[candidate.first + i] = least_seen(whole[i * k + i]);
            }
        }
        least
    }

    pub(crate) fn into_along(self) -> DMatrix<f64> {
        self.along
    }

    pub(crate) fn columns(&self, candidate: &Candidate) -> DMatrix<f64> {
        let (first, k) = (candidate.first, candidate.size);
        let height = self.basis.q.nrows();
        let more = height - self.columns.rows();
        let mut own = self.columns.white(self.filter, first, k, more);
        own.gemm(-1.0, &self.basis.q, &self.along.columns(first, k), 1.0);
        own
    }

    /// Products of all columns with a residual.
    pub(crate) fn pulls(&self, residual: &DVector<f64>) -> DVector<f64> {
        let inside = along(&self.basis.q, residual);
        let one = DMatrix::from_column_slice(residual.len(), 1, residual.as_slice());
        let products = self
            .columns
            .products(self.filter, &one, self.among, Threads::ONE);
        let mut pulls = products.row(0).transpose();
        pulls.gemv_tr(-1.0, &self.along, &inside, 1.0);
        pulls
    }

    /// Vectors without what the basis explains, as [`pulls_of_noise`](Self::pulls_of_noise) takes them, and
    /// what is left of the square of each.
    pub(crate) fn of_noise(&self, z: DMatrix<f64>) -> (Vec<DMatrix<f32>>, Vec<f32>) {
        let along = self.basis.q.transpose() * &z;
        let mut left = z;
        left.gemm(-1.0, &self.basis.q, &along, 1.0);
        let squares = left.column_iter().map(|c| c.norm_squared() as f32);
        let squares = squares.collect();
        let by_sample = self.columns.of_samples(self.filter, &left);
        let by_sample = by_sample.iter().map(|g| g.map(|v| v as f32));
        (by_sample.collect(), squares)
    }

    /// Products of some columns that are together with such vectors, a row for each vector.
    pub(crate) fn pulls_of_noise(
        &self,
        noise: &[DMatrix<f32>],
        first: usize,
        count: usize,
    ) -> DMatrix<f32> {
        self.columns.products_near(noise, first, count)
    }

    /// How many columns from this one on are together.
    pub(crate) fn together(&self, first: usize) -> usize {
        self.columns.together(first)
    }
}
