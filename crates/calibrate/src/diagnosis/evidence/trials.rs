//! Simulated residuals sent through every candidate given one model.

use std::rc::Rc;

use nalgebra::{DMatrix, DVector};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::projections::Projections;
use super::regression::Regression;
use super::score::weight_of;
use super::significance::Significance;
use crate::budget;
use crate::diagnosis::candidates::table::Candidate;

/// One candidate given a model.
struct Trial<'c> {
    candidate: &'c Candidate,
    /// Cholesky factor of its columns, row by row.
    factor: Vec<f32>,
    /// Which kind it is of.
    kind: usize,
}

/// Candidates of one rank and weight.
struct CandidateClass {
    rank: usize,
    weight: f64,
    test: Rc<Significance>,
}

/// Every candidate given one model, for residuals to be sent through.
pub(super) struct Trials<'p, 'a> {
    regression: &'p Regression<'a>,
    around: &'p Projections,
    all: Vec<Trial<'p>>,
    kinds: Vec<CandidateClass>,
}

impl<'p, 'a> Trials<'p, 'a> {
    pub(crate) fn new(regression: &'p Regression<'a>, around: &'p Projections) -> Self {
        let freedom = regression.m() - around.basis.rank() as f64;
        let mut kinds: Vec<CandidateClass> = Vec::new();
        let mut all = Vec::new();
        for candidate in &regression.table.candidates {
            let (factor, rank) = around.factor(candidate);
            if rank == 0 || freedom - (rank as f64) < 2.0 {
                continue;
            }
            let weight = weight_of(candidate);
            let known = kinds
                .iter()
                .position(|k| k.rank == rank && k.weight == weight);
            let kind = known.unwrap_or_else(|| {
                kinds.push(CandidateClass {
                    rank,
                    weight,
                    test: regression.tests.of(rank, freedom - rank as f64),
                });
                kinds.len() - 1
            });
            all.push(Trial {
                candidate,
                factor: factor.iter().map(|l| *l as f32).collect(),
                kind,
            });
        }
        // In the order of their columns: neighbours go through together.
        all.sort_by_key(|trial| trial.candidate.first);
        Self {
            regression,
            around,
            all,
            kinds,
        }
    }

    /// The largest −ln p of so many residuals whose signs are flipped at random.
    pub(super) fn largest(&self, residual: &DVector<f32>, count: usize) -> Vec<f64> {
        let mut random = ChaCha8Rng::seed_from_u64(0);
        let z = DMatrix::from_fn(residual.len(), count, |row, _| {
            let sign = random.next_u32() & (1 << 31);
            f64::from(f32::from_bits(residual[row].to_bits() ^ sign))
        });
        let (noise, totals) = self.projected(z);
        let columns = &self.regression.table.columns;
        let end = |t: &Trial| t.candidate.first + t.candidate.size;
        let mut together: Vec<&[Trial]> = Vec::new();
        let mut all = self.all.as_slice();
        while let Some(first) = all.first().map(|t| t.candidate.first) {
            let up_to = first + columns.together(first).min(budget::AT_ONCE);
            let some = all.partition_point(|t| end(t) <= up_to).max(1);
            let (now, rest) = all.split_at(some);
            all = rest;
            together.push(now);
        }
        // By kind the largest gain of each residual.
        let none = vec![vec![0.0_f32; count]; self.kinds.len()];
        let of_some = |now: &[Trial]| {
            let mut most = none.clone();
            let mut gain = vec![0.0_f32; count];
            let first = now.first().map_or(0, |t| t.candidate.first);
            let width = now.last().map_or(0, |t| end(t) - first);
            let mut pulls = columns.products_near(&noise, first, width);
            for trial in now {
                let at = (trial.candidate.first - first) * count;
                let own = &mut pulls.as_mut_slice()[at..at + trial.candidate.size * count];
                trial.gains(own, &mut gain);
                for (most, gain) in most[trial.kind].iter_mut().zip(&gain) {
                    *most = most.max(*gain);
                }
            }
            most
        };
        // The largest does not depend on the order of the search.
        let mut most = none.clone();
        for own in self
            .regression
            .threads
            .each(together.len(), |k| of_some(together[k]))
        {
            for (most, own) in most.iter_mut().flatten().zip(own.into_iter().flatten()) {
                *most = most.max(own);
            }
        }
        let one = |k: usize| {
            let kinds = self.kinds.iter().zip(&most);
            kinds
                .map(|(kind, most)| kind.test.of(f64::from(most[k] / totals[k])) - kind.weight)
                .fold(0.0, f64::max)
        };
        (0..count).map(one).collect()
    }

    /// Vectors projected orthogonal to the model, in the form that products with the columns need, and the square norm
    /// of each.
    fn projected(&self, mut z: DMatrix<f64>) -> (Vec<DMatrix<f32>>, Vec<f32>) {
        let q = &self.around.basis.q;
        let along = q.transpose() * &z;
        z.gemm(-1.0, q, &along, 1.0);
        let squares = z.column_iter().map(|c| c.norm_squared() as f32).collect();
        let table = &self.regression.table;
        let by_sample = table.columns.of_samples(&self.regression.filter, &z);
        let by_sample = by_sample.iter().map(|g| g.map(|v| v as f32));
        (by_sample.collect(), squares)
    }
}

impl Trial<'_> {
    /// By how much the candidate lowers the square of each residual, from its products with them: a column of products
    /// for each of its columns, `‖L⁻¹ h‖²` by forward substitution.
    fn gains(&self, pulls: &mut [f32], gain: &mut [f32]) {
        let (k, count) = (self.candidate.size, gain.len());
        gain.fill(0.0);
        for i in 0..k {
            let pivot = self.factor[i * k + i];
            if pivot <= 0.0 {
                continue;
            }
            let (before, own) = pulls.split_at_mut(i * count);
            let own = &mut own[..count];
            for (j, before) in before.chunks_exact(count).enumerate() {
                let along = self.factor[i * k + j];
                if along != 0.0 {
                    for (own, before) in own.iter_mut().zip(before) {
                        *own -= along * before;
                    }
                }
            }
            let inverse = 1.0 / pivot;
            for (own, gain) in own.iter_mut().zip(gain.iter_mut()) {
                *own *= inverse;
                *gain += *own * *own;
            }
        }
    }
}
