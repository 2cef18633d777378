//! How often noise alone would surprise the whole search as much: simulated residuals are sent
//! through every candidate at once, names and shapes together, and the largest surprise of each
//! is kept.
//!
//! The simulated residuals are the fit's own with their signs flipped at random, so that heavy
//! tails stay heavy (Winkler et al. 2014); in a long session, where tails no longer matter, they
//! are Gaussian. A surprise beyond all of them is judged by the tail: the surprise is −ln p, so
//! its tail falls like C·exp(−s), with C from the largest simulated ones.

use nalgebra::{DMatrix, DVector};
use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::arena::{Arena, Fit, weight_of};
use super::linear::Basis;
use super::significance::Significance;

/// Simulations of a short session.
const MOST: usize = 2000;
const FEWEST: usize = 300;
/// Rows beyond which fewer simulations have to do.
const ROWS: usize = 480;
/// Rows beyond which simulated residuals are Gaussian.
const ROWS_TO_FLIP: usize = 2400;

/// Largest surprises of simulated residuals, kept for each size of model.
#[derive(Debug, Default)]
pub(super) struct Familywise {
    null: Vec<(usize, Vec<f64>)>,
}

/// The chance that noise alone surprises the search as much.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FamilyP {
    /// The chance; never below one over the number of simulations.
    pub p: f64,
    /// Whether it is a bound: "fewer than".
    pub bound: bool,
}

impl Arena<'_> {
    /// The chance that noise alone surprises the search by `surprise`. `fit` is a model in which
    /// the candidate is already: its residual is noise if the candidate is right.
    pub(super) fn family_p(&self, surprise: f64, fit: &Fit) -> FamilyP {
        let candidates = self.table.candidates.len() as f64;
        let smallest = 1.0 / self.simulations() as f64;
        // Beyond what all candidates together could do by chance there is nothing to simulate.
        if surprise > candidates.ln() + 14.0 {
            return FamilyP {
                p: smallest,
                bound: true,
            };
        }
        if surprise < 2.0 {
            return FamilyP { p: 1.0, bound: false };
        }
        let key = fit.basis.rank();
        let known = self
            .familywise
            .borrow()
            .null
            .iter()
            .position(|n| n.0 == key);
        let at = known.unwrap_or_else(|| {
            let null = self.simulate(fit);
            let mut familywise = self.familywise.borrow_mut();
            familywise.null.push((key, null));
            familywise.null.len() - 1
        });
        let familywise = self.familywise.borrow();
        let null = &familywise.null[at].1;
        let above = null.iter().filter(|s| **s >= surprise).count();
        // The tail from the largest fiftieth: chance(s) = share · exp(−(s − quantile)).
        let rank = (null.len() / 50).max(1);
        let from_tail = rank as f64 / null.len() as f64 * (null[rank - 1] - surprise).exp();
        let counted = above as f64 / null.len() as f64;
        let p = if above > rank { counted } else { from_tail.max(counted.min(from_tail * 3.0)) };
        FamilyP {
            p: p.clamp(smallest, 1.0),
            bound: p < smallest,
        }
    }

    /// The surprise that noise alone reaches with this chance.
    pub(super) fn surprise_for(&self, chance: f64, fit: &Fit) -> f64 {
        let (mut low, mut high) = (2.0, (self.table.candidates.len() as f64).ln() + 14.0);
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if self.family_p(middle, fit).p > chance {
                low = middle;
            } else {
                high = middle;
            }
        }
        high
    }

    fn simulations(&self) -> usize {
        (MOST * ROWS / self.rows.len().max(1)).clamp(FEWEST, MOST)
    }

    /// Largest surprises of simulated residuals, largest first.
    fn simulate(&self, fit: &Fit) -> Vec<f64> {
        let m = self.rows.len();
        let count = self.simulations();
        let groups = self.orthonormal_groups(&fit.basis);
        let q = fit.basis.q.map(|v| v as f32).transpose();
        let flip = m <= ROWS_TO_FLIP;
        // A residual is smaller than the noise where the fit follows it.
        let noise: DVector<f32> = DVector::from_fn(m, |row, _| {
            let kept = (1.0 - fit.basis.leverage(row)).max(0.05);
            (fit.residual[row] / kept.sqrt()) as f32
        });
        let mut random = ChaCha8Rng::seed_from_u64(self.seed ^ 0x5eed_0f_7e57);
        let mut largest = Vec::with_capacity(count);
        let chunk = 250;
        for start in (0..count).step_by(chunk) {
            let width = chunk.min(count - start);
            let z = DMatrix::<f32>::from_fn(m, width, |row, _| {
                let normal: f32 = StandardNormal.sample(&mut random);
                if flip { noise[row] * normal.signum() } else { normal }
            });
            let inside = &q * &z;
            let totals: Vec<f32> = (0..width)
                .map(|k| z.column(k).norm_squared() - inside.column(k).norm_squared())
                .collect();
            let mut surprise = vec![0.0_f64; width];
            for group in &groups {
                let along = &group.rows * &z;
                for k in 0..width {
                    let column = along.column(k);
                    let mut best = 0.0_f32;
                    let values = column.as_slice();
                    for own in values.chunks_exact(group.rank) {
                        let gain: f32 = own.iter().map(|v| v * v).sum();
                        best = best.max(gain);
                    }
                    let s = group.test.of(f64::from(best / totals[k])) - group.weight;
                    surprise[k] = surprise[k].max(s);
                }
            }
            largest.extend(surprise);
        }
        largest.sort_by(|a, b| b.total_cmp(a));
        largest
    }

    /// Orthonormal columns of all candidates beside a basis, those of one rank and weight together.
    fn orthonormal_groups(&self, basis: &Basis) -> Vec<Group> {
        let projected = self.projected(basis);
        let m = self.rows.len();
        let freedom = self.m() - basis.rank() as f64;
        let mut groups: Vec<(usize, f64, Vec<f32>)> = Vec::new();
        for candidate in &self.table.candidates {
            let k = candidate.size;
            let (factor, rank) = self.factor(&projected, candidate);
            if rank == 0 || freedom - (rank as f64) < 2.0 {
                continue;
            }
            let weight = weight_of(candidate);
            let same = groups.iter().position(|g| g.0 == rank && g.1 == weight);
            let at = same.unwrap_or_else(|| {
                groups.push((rank, weight, Vec::new()));
                groups.len() - 1
            });
            // Forward substitution, row of the factor by row: U = P L⁻ᵀ.
            let mut own: Vec<Vec<f64>> = Vec::with_capacity(k);
            for i in 0..k {
                let pivot = factor[i * k + i];
                let mut column: Vec<f64> =
                    projected.column(candidate.first + i).iter().copied().collect();
                for (j, before) in own.iter().enumerate() {
                    let along = factor[i * k + j];
                    if along != 0.0 {
                        column.iter_mut().zip(before).for_each(|(c, b)| *c -= along * b);
                    }
                }
                let inverse = if pivot > 0.0 { 1.0 / pivot } else { 0.0 };
                column.iter_mut().for_each(|c| *c *= inverse);
                if pivot > 0.0 {
                    groups[at].2.extend(column.iter().map(|c| *c as f32));
                }
                own.push(column);
            }
        }
        groups
            .into_iter()
            .map(|(rank, weight, values)| Group {
                rank,
                weight,
                test: Significance::new(rank, freedom - rank as f64),
                // A product of matrices is quick, one of a transposed is not.
                rows: DMatrix::from_vec(m, values.len() / m.max(1), values).transpose(),
            })
            .collect()
    }
}

struct Group {
    rank: usize,
    weight: f64,
    test: Significance,
    rows: DMatrix<f32>,
}
