//! How often noise alone would surprise the whole search as much: simulated residuals are sent
//! through every candidate at once, names and shapes together, and the largest surprise of each
//! is kept.
//!
//! The simulated residuals are the fit's own with their signs flipped at random, so that heavy
//! tails stay heavy (Winkler et al. 2014); in a long session, where tails no longer matter, they
//! are Gaussian. A surprise beyond all of them is judged by the tail: the surprise is −ln p, so
//! its tail falls like C·exp(−s), with C from the largest simulated ones.

use nalgebra::{DMatrix, DVector};
use rand::{Rng, SeedableRng};
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
    null: Vec<Null>,
}

/// What noise alone did to the search beside one model, so far.
#[derive(Debug)]
struct Null {
    rank: usize,
    groups: Vec<Group>,
    /// The fit's orthonormal columns, as rows.
    inside: DMatrix<f32>,
    noise: DVector<f32>,
    chunks: u64,
    /// Largest first.
    largest: Vec<f64>,
}

/// Simulations that are made at once; more follow while the answer is close.
const CHUNK: usize = 250;
/// Chances between these are worth more simulations.
const CLOSE: [f64; 2] = [4e-4, 0.04];

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
            return FamilyP {
                p: 1.0,
                bound: false,
            };
        }
        let at = self.null_beside(fit);
        let mut familywise = self.familywise.borrow_mut();
        let null = &mut familywise.null[at];
        loop {
            let p = null.chance(surprise);
            let close = p > CLOSE[0] && p < CLOSE[1];
            if !close || null.largest.len() >= self.simulations() {
                return FamilyP {
                    p: p.clamp(smallest, 1.0),
                    bound: p < smallest,
                };
            }
            null.simulate(self.seed);
        }
    }

    /// The surprise that noise alone reaches with this chance.
    pub(super) fn surprise_for(&self, chance: f64, fit: &Fit) -> f64 {
        let at = self.null_beside(fit);
        let null = &self.familywise.borrow().null[at];
        let (mut low, mut high) = (2.0, (self.table.candidates.len() as f64).ln() + 14.0);
        for _ in 0..40 {
            let middle = 0.5 * (low + high);
            if null.chance(middle) > chance {
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

    /// Place of the simulations beside a fit; the first are made here.
    fn null_beside(&self, fit: &Fit) -> usize {
        let rank = fit.basis.rank();
        let mut familywise = self.familywise.borrow_mut();
        if let Some(at) = familywise.null.iter().position(|n| n.rank == rank) {
            return at;
        }
        let m = self.rows.len();
        let flip = m <= ROWS_TO_FLIP;
        // A residual is smaller than the noise where the fit follows it.
        let noise = DVector::from_fn(m, |row, _| {
            let kept = (1.0 - fit.basis.leverage(row)).max(0.05);
            if flip {
                (fit.residual[row] / kept.sqrt()) as f32
            } else {
                0.0
            }
        });
        let mut null = Null {
            rank,
            groups: self.orthonormal_groups(&fit.basis),
            inside: fit.basis.q.map(|v| v as f32).transpose(),
            noise,
            chunks: 0,
            largest: Vec::new(),
        };
        null.simulate(self.seed);
        familywise.null.push(null);
        familywise.null.len() - 1
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
                let mut column: Vec<f64> = projected
                    .column(candidate.first + i)
                    .iter()
                    .copied()
                    .collect();
                for (j, before) in own.iter().enumerate() {
                    let along = factor[i * k + j];
                    if along != 0.0 {
                        column
                            .iter_mut()
                            .zip(before)
                            .for_each(|(c, b)| *c -= along * b);
                    }
                }
                let inverse = if pivot > 0.0 { 1.0 / pivot } else { 0.0 };
                for value in &mut column {
                    *value *= inverse;
                }
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

impl Null {
    /// The chance of a surprise as large: counted, and beyond the largest fiftieth by the tail
    /// chance(s) = share · exp(−(s − quantile)).
    fn chance(&self, surprise: f64) -> f64 {
        let count = self.largest.len();
        let above = self.largest.partition_point(|s| *s >= surprise);
        let rank = (count / 50).max(1);
        let counted = above as f64 / count as f64;
        if above > rank {
            return counted;
        }
        let share = rank as f64 / count as f64;
        let from_tail = share * (self.largest[rank - 1] - surprise).exp();
        from_tail.max(counted.min(3.0 * from_tail))
    }

    /// Sends one chunk more of simulated residuals through the search.
    fn simulate(&mut self, seed: u64) {
        let m = self.noise.len();
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(self.chunks);
        self.chunks += 1;
        let flip = self.noise.iter().any(|v| *v != 0.0);
        let z = DMatrix::<f32>::from_fn(m, CHUNK, |row, _| {
            if flip {
                let sign = random.next_u32() & (1 << 31);
                f32::from_bits(self.noise[row].to_bits() ^ sign)
            } else {
                StandardNormal.sample(&mut random)
            }
        });
        let inside = &self.inside * &z;
        let totals: Vec<f32> = (0..CHUNK)
            .map(|k| z.column(k).norm_squared() - inside.column(k).norm_squared())
            .collect();
        let mut surprise = vec![0.0_f64; CHUNK];
        for group in &self.groups {
            let along = &group.rows * &z;
            for (k, surprise) in surprise.iter_mut().enumerate() {
                let mut best = 0.0_f32;
                for own in along.column(k).as_slice().chunks_exact(group.rank) {
                    let gain: f32 = own.iter().map(|v| v * v).sum();
                    best = best.max(gain);
                }
                let s = group.test.of(f64::from(best / totals[k])) - group.weight;
                *surprise = surprise.max(s);
            }
        }
        self.largest.extend(surprise);
        self.largest.sort_by(|a, b| b.total_cmp(a));
    }
}

#[derive(Debug)]
struct Group {
    rank: usize,
    weight: f64,
    test: Significance,
    rows: DMatrix<f32>,
}
