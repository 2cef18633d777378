//! Every candidate beside one model, and simulated residuals that are sent through all of them.

use std::rc::Rc;

use nalgebra::{DMatrix, DVector};
use rand::{Rng, SeedableRng};
use rand_chacha::ChaCha8Rng;

use super::projected::Projected;
use super::score::weight_of;
use super::significance::{Significance, Tests};
use crate::diagnosis::candidates::table::Candidate;
use crate::side_by_side::Threads;

/// One candidate beside a model.
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

/// Every candidate beside one model, for residuals to be sent through.
pub(super) struct Trials<'p> {
    projected: &'p Projected<'p>,
    all: Vec<Trial<'p>>,
    kinds: Vec<CandidateClass>,
    threads: Threads,
}

/// Columns that residuals are sent through at once.
const AT_ONCE: usize = 512;

impl<'p> Trials<'p> {
    /// Of candidates in `rows` measured rows.
    pub(crate) fn new(
        projected: &'p Projected<'p>,
        candidates: &'p [Candidate],
        tests: &Tests,
        (rows, threads): (f64, Threads),
    ) -> Self {
        let freedom = rows - projected.basis().rank() as f64;
        let mut kinds: Vec<CandidateClass> = Vec::new();
        let mut all = Vec::new();
        for candidate in candidates {
            let (factor, rank) = projected.factor(candidate);
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
                    test: tests.of(rank, freedom - rank as f64),
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
            projected,
            all,
            kinds,
            threads,
        }
    }

    /// The largest −ln p of so many residuals whose signs are flipped at random.
    pub(super) fn largest(&self, residual: &DVector<f32>, count: usize) -> Vec<f64> {
        let mut random = ChaCha8Rng::seed_from_u64(0);
        let z = DMatrix::from_fn(residual.len(), count, |row, _| {
            let sign = random.next_u32() & (1 << 31);
            f64::from(f32::from_bits(residual[row].to_bits() ^ sign))
        });
        let (noise, totals) = self.projected.of_noise(z);
        let projected = self.projected;
        let end = |t: &Trial| t.candidate.first + t.candidate.size;
        let mut together: Vec<&[Trial]> = Vec::new();
        let mut all = self.all.as_slice();
        while let Some(first) = all.first().map(|t| t.candidate.first) {
            let up_to = first + projected.together(first).min(AT_ONCE);
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
            let mut pulls = projected.pulls_of_noise(&noise, first, width);
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
        // The largest is the same in whatever order it is looked for.
        let mut most = none.clone();
        for own in self.threads.each(together.len(), |k| of_some(together[k])) {
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
}

impl Trial<'_> {
    /// By how much the candidate lowers the square of each residual, from what it pulls of them: a column of
    /// pulls for each of its columns, `‖L⁻¹ h‖²` by forward substitution.
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
