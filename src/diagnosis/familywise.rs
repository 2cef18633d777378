//! How often the whole search would find as much in noise alone: simulated residuals are sent
//! through every candidate at once, names and shapes together, and the largest −ln p of each is
//! kept.
//!
//! The simulated residuals are the fit's own with their signs flipped at random, so that heavy
//! tails stay heavy (Winkler et al. 2014); in a long session without heavy tails they are
//! Gaussian. A −ln p beyond all of them is judged by the tail: it falls like
//! C·exp(−s), with C from the largest simulated ones.
//!
//! Of Gaussian residuals the tail itself is simulated (importance sampling of a union, Naiman &
//! Priebe 2001): a candidate i is drawn with a chance ∝ `p_i = exp(−s₀ − w_i)`, a residual is drawn
//! of which it makes at least s₀, and the N candidates that reach s₀ are counted:
//!
//! ```text
//! P(max > s) = Σ p_i · E[ 1(max > s) / N ],   s ≥ s₀
//! ```
//!
//! A few hundred such residuals say more about one session in 2000 than 2000 plain ones.

use nalgebra::{DMatrix, DVector};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

pub(crate) use crate::answers::diagnosis::FamilyP;

use super::regression::{Fit, Regression, weight_of};
use super::significance::Significance;
use crate::effects::rank as rank_in_catalogue;
use crate::linear::Basis;

/// Simulations of a short session.
const MOST: usize = 2000;
const FEWEST: usize = 300;
/// Rows beyond which fewer simulations have to do.
const ROWS: usize = 480;
/// Rows beyond which simulated residuals are Gaussian, if the fit's own look so.
const ROWS_TO_FLIP: usize = 900;
/// A larger kurtosis than this (a Gaussian has 3) means heavy tails.
const MOST_KURTOSIS: f64 = 3.6;
/// The sum of all candidates' chances from which on the tail is simulated.
const TAIL: f64 = 0.03;

/// Largest −ln p of simulated residuals, kept for each model.
#[derive(Debug, Default)]
pub(crate) struct Familywise {
    null: Vec<Null>,
}

/// Numbers of simulated searches that are kept at most; what was forgotten is made again.
const MOST_KEPT: usize = 16_000_000;

impl Familywise {
    fn forget_the_oldest(&mut self) {
        let size = |null: &Null| null.groups.iter().map(|g| g.rows.len()).sum::<usize>();
        while self.null.len() > 2 && self.null.iter().map(size).sum::<usize>() > MOST_KEPT {
            self.null.remove(0);
        }
    }
}

/// What noise alone did to the search beside one model, so far.
#[derive(Debug)]
struct Null {
    rank: usize,
    /// Of the model that it was made for.
    fingerprint: Vec<u64>,
    /// Whether it is the same whatever the seed.
    seedless: bool,
    groups: Vec<Group>,
    /// The fit's orthonormal columns, as rows.
    inside: DMatrix<f32>,
    noise: DVector<f32>,
    chunks: u64,
    /// Largest first.
    largest: Vec<f64>,
    /// The simulated tail, where there is one.
    tail: Option<Tail>,
}

/// Surprises beyond `from`, largest first, each with its share of the chance.
#[derive(Debug)]
struct Tail {
    from: f64,
    weighted: Vec<(f64, f64)>,
}

/// Simulations that are made at once; more follow while the answer is close.
const CHUNK: usize = 250;
/// Chances between these are worth more simulations.
const CLOSE: [f64; 2] = [4e-4, 0.04];

impl Regression<'_> {
    /// The chance that noise alone reaches `minus_ln_p` in the search. `fit` is a model in which
    /// the candidate is already: its residual is noise if the candidate is right.
    pub(crate) fn family_p(&self, minus_ln_p: f64, fit: &Fit) -> FamilyP {
        self.family_p_beside(minus_ln_p, fit, false)
    }

    /// The same on the way there, where the null of any model of the same size is good enough.
    pub(crate) fn rough_family_p(&self, minus_ln_p: f64, fit: &Fit) -> FamilyP {
        self.family_p_beside(minus_ln_p, fit, true)
    }

    fn family_p_beside(&self, minus_ln_p: f64, fit: &Fit, rough: bool) -> FamilyP {
        let candidates = self.table.candidates.len() as f64;
        let smallest = 1.0 / MOST as f64;
        // Beyond what all candidates together could do by chance there is nothing to simulate.
        if minus_ln_p > candidates.ln() + 14.0 {
            return FamilyP {
                p: smallest,
                bound: true,
            };
        }
        if minus_ln_p < 2.0 {
            return FamilyP {
                p: 1.0,
                bound: false,
            };
        }
        let at = self.null_beside(fit, rough);
        let mut familywise = self.familywise.borrow_mut();
        let null = &mut familywise.null[at];
        loop {
            let p = null.chance(minus_ln_p);
            let close = p > CLOSE[0] && p < CLOSE[1];
            if !close || null.tail.is_some() || null.largest.len() >= self.simulations() {
                return FamilyP {
                    p: p.clamp(smallest, 1.0),
                    bound: p < smallest,
                };
            }
            null.simulate(self.seed);
        }
    }

    /// The −ln p that noise alone reaches with this chance. Sizes and limits depend on it, and on no
    /// seed: it comes from simulations of its own.
    pub(crate) fn minus_ln_p_for(&self, chance: f64, fit: &Fit) -> f64 {
        let at = self.null_of(fit, false, true);
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
    fn null_beside(&self, fit: &Fit, rough: bool) -> usize {
        self.null_of(fit, rough, false)
    }

    fn null_of(&self, fit: &Fit, rough: bool, seedless: bool) -> usize {
        let fingerprint = fingerprint(fit);
        let mut familywise = self.familywise.borrow_mut();
        let mut known = familywise.null.iter();
        let rank = fit.basis.rank();
        let same = |n: &Null| {
            n.seedless == seedless && (n.fingerprint == fingerprint || rough && n.rank == rank)
        };
        if let Some(at) = known.position(same) {
            return at;
        }
        let m = self.height();
        // A row that an observation does not have stays zero when it is flipped.
        let gaps = self.rows.count() < self.rows.len();
        let flip = gaps || m <= ROWS_TO_FLIP || kurtosis(&fit.residual) > MOST_KURTOSIS;
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
            fingerprint,
            seedless,
            groups: self.orthonormal_groups(&fit.basis),
            inside: fit.basis.q.map(|v| v as f32).transpose(),
            noise,
            chunks: 0,
            largest: Vec::new(),
            tail: None,
        };
        let seed = if seedless { 0 } else { self.seed };
        null.simulate(seed);
        if !flip {
            null.simulate_tail(seed);
        }
        familywise.null.push(null);
        familywise.forget_the_oldest();
        familywise.null.len() - 1
    }

    /// Orthonormal columns of all candidates beside a basis, those of one rank and weight together.
    fn orthonormal_groups(&self, basis: &Basis) -> Vec<Group> {
        let projected = self.projected(basis);
        let m = self.height();
        let freedom = self.m() - basis.rank() as f64;
        let mut groups: Vec<(usize, f64, Vec<f32>)> = Vec::new();
        for candidate in &self.table.candidates {
            let k = candidate.size;
            let (factor, rank) = projected.factor(candidate);
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
            let free = projected.columns(candidate);
            for i in 0..k {
                let pivot = factor[i * k + i];
                let mut column: Vec<f64> = free.column(i).iter().copied().collect();
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

/// What tells one model's null from another's: its terms with their settings, and its shapes.
fn fingerprint(fit: &Fit) -> Vec<u64> {
    let terms = fit.model.terms().iter();
    let mut all: Vec<u64> = terms
        .flat_map(|t| {
            let place = (rank_in_catalogue(t.effect) * 64 + t.joint) as u64;
            [place, t.setting.to_bits()]
        })
        .collect();
    for shape in &fit.shapes {
        let column = shape.white.column(0);
        all.push(u64::MAX);
        all.extend([column.sum().to_bits(), column.norm().to_bits()]);
    }
    all
}

impl Null {
    /// The chance of a −ln p as large: counted, and beyond the largest fiftieth by the tail
    /// chance(s) = share · exp(−(s − quantile)).
    fn chance(&self, minus_ln_p: f64) -> f64 {
        if let Some(tail) = self.tail.as_ref().filter(|t| minus_ln_p >= t.from) {
            return tail.chance(minus_ln_p);
        }
        let count = self.largest.len();
        let above = self.largest.partition_point(|s| *s >= minus_ln_p);
        let rank = (count / 50).max(1);
        let counted = above as f64 / count as f64;
        if above > rank {
            return counted;
        }
        let share = rank as f64 / count as f64;
        let from_tail = share * (self.largest[rank - 1] - minus_ln_p).exp();
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
        let reached = self.reached(&z, f64::INFINITY);
        self.largest.extend(reached.into_iter().map(|r| r.0));
        self.largest.sort_by(|a, b| b.total_cmp(a));
    }

    /// The largest −ln p of each residual, and how many candidates reach `from`.
    fn reached(&self, z: &DMatrix<f32>, from: f64) -> Vec<(f64, usize)> {
        let inside = &self.inside * z;
        let totals: Vec<f32> = (0..z.ncols())
            .map(|k| z.column(k).norm_squared() - inside.column(k).norm_squared())
            .collect();
        let mut reached = vec![(0.0_f64, 0); z.ncols()];
        for group in &self.groups {
            let along = &group.rows * z;
            let enough = if from.is_finite() {
                group.test.share_for(from + group.weight) as f32
            } else {
                f32::INFINITY
            };
            for (k, (largest, count)) in reached.iter_mut().enumerate() {
                let mut best = 0.0_f32;
                for own in along.column(k).as_slice().chunks_exact(group.rank) {
                    let gain: f32 = own.iter().map(|v| v * v).sum();
                    best = best.max(gain);
                    *count += usize::from(gain >= enough * totals[k]);
                }
                let s = group.test.of(f64::from(best / totals[k])) - group.weight;
                *largest = largest.max(s);
            }
        }
        reached
    }

    /// Simulates one chunk of residuals that reach the tail; see the module.
    fn simulate_tail(&mut self, seed: u64) {
        let m = self.noise.len();
        let chances: Vec<f64> = self
            .groups
            .iter()
            .map(|g| (g.rows.nrows() / g.rank) as f64 * (-g.weight).exp())
            .collect();
        let total: f64 = chances.iter().sum();
        if total <= 0.0 {
            return;
        }
        let from = (total / TAIL).ln();
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(u64::MAX);
        let mut z = DMatrix::<f32>::zeros(m, CHUNK);
        for mut column in z.column_iter_mut() {
            let mut free = DVector::<f32>::from_fn(m, |_, _| StandardNormal.sample(&mut random));
            free -= self.inside.tr_mul(&(&self.inside * &free));
            let mut at = random.random::<f64>() * total;
            let drawn = chances.iter().position(|c| {
                at -= c;
                at < 0.0
            });
            let group = &self.groups[drawn.unwrap_or(self.groups.len() - 1)];
            let which = random.random_range(0..group.rows.nrows() / group.rank);
            let own = group.rows.rows(which * group.rank, group.rank);
            // The direction inside the candidate's columns stays, its share is drawn.
            let along = own * &free;
            free -= own.tr_mul(&along);
            let chance = 1.0 - random.random::<f64>();
            let share = group.test.share_for(from + group.weight - chance.ln());
            let inside = own.tr_mul(&along) * ((share.sqrt() as f32) / along.norm().max(1e-30));
            let outside = free.norm().max(1e-30);
            column.copy_from(&(free * (((1.0 - share).sqrt() as f32) / outside) + inside));
        }
        let mut weighted: Vec<(f64, f64)> = self
            .reached(&z, from)
            .into_iter()
            .map(|(largest, count)| {
                let weight = TAIL / (CHUNK * count.max(1)) as f64;
                (largest.max(from), weight)
            })
            .collect();
        weighted.sort_by(|a, b| b.0.total_cmp(&a.0));
        self.tail = Some(Tail { from, weighted });
    }
}

impl Tail {
    /// The chance of a −ln p as large; beyond the largest tenth it falls like exp(−s).
    fn chance(&self, minus_ln_p: f64) -> f64 {
        let few = self.weighted.len() / 10;
        let above = self.weighted.partition_point(|w| w.0 >= minus_ln_p);
        let sum = |count: usize| self.weighted[..count].iter().map(|w| w.1).sum::<f64>();
        if above > few {
            return sum(above);
        }
        sum(few) * (self.weighted[few.saturating_sub(1)].0 - minus_ln_p).exp()
    }
}

/// Fourth moment over the square of the second; 3 for a Gaussian.
fn kurtosis(values: &DVector<f64>) -> f64 {
    let n = values.len().max(1) as f64;
    let moment = |power: i32| values.iter().map(|v| v.powi(power)).sum::<f64>() / n;
    moment(4) / moment(2).powi(2).max(1e-300)
}

#[derive(Debug)]
struct Group {
    rank: usize,
    weight: f64,
    test: Significance,
    rows: DMatrix<f32>,
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Groups of correlated candidates: neighbouring sines over 300 rows.
    fn null(seed: u64) -> Null {
        let m = 300;
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        let noise = |random: &mut ChaCha8Rng| -> f32 { StandardNormal.sample(random) };
        let group = |rank: usize, count: usize, weight: f64, random: &mut ChaCha8Rng| {
            let mut columns: Vec<DVector<f32>> = Vec::new();
            for _ in 0..count {
                let mut own: Vec<DVector<f32>> = Vec::new();
                for k in 0..rank {
                    // Half of each column is its neighbour's.
                    let start = columns
                        .len()
                        .checked_sub(rank)
                        .map(|i| columns[i + k].clone());
                    let mut v = DVector::from_fn(m, |_, _| noise(random) / (m as f32).sqrt());
                    v += start.unwrap_or_else(|| DVector::zeros(m));
                    for before in &own {
                        let along = before.dot(&v);
                        v -= before * along;
                    }
                    own.push(v.normalize());
                }
                columns.extend(own);
            }
            Group {
                rank,
                weight,
                test: Significance::new(rank, m as f64 - rank as f64),
                rows: DMatrix::from_columns(&columns).transpose(),
            }
        };
        Null {
            rank: 0,
            fingerprint: Vec::new(),
            seedless: false,
            groups: vec![
                group(1, 40, 0.5, &mut random),
                group(2, 60, 2.0, &mut random),
                group(3, 20, 0.0, &mut random),
            ],
            inside: DMatrix::zeros(0, m),
            noise: DVector::zeros(m),
            chunks: 0,
            largest: Vec::new(),
            tail: None,
        }
    }

    #[test]
    fn the_simulated_tail_agrees_with_many_plain_simulations() {
        let mut plain = null(1);
        for _ in 0..80 {
            plain.simulate(7);
        }
        let count = plain.largest.len() as f64;
        let mut tailed = null(1);
        tailed.simulate_tail(7);
        let tail = tailed.tail.expect("simulated");
        for above in [300.0, 100.0, 40.0] {
            let minus_ln_p = plain.largest[above as usize - 1];
            let (expected, found) = (above / count, tail.chance(minus_ln_p));
            // Standard errors: 1/√above of what was counted, and a tenth of the tail's.
            let error = expected * (1.0 / above + 0.01_f64).sqrt();
            assert!(
                (found - expected).abs() < 3.0 * error,
                "{above}: {expected} {found}"
            );
        }
        // Far out no plain simulation comes, and the sum of all chances is the answer.
        let far = tail.from + 12.0;
        let bound = TAIL * (tail.from - far).exp();
        assert!(tail.chance(far) <= bound && tail.chance(far) > 0.3 * bound);
    }
}
