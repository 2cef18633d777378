//! Every candidate beside one model, and simulated residuals that are sent through all of them.
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

use std::ops::Range;
use std::rc::Rc;

use nalgebra::{DMatrix, DVector};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::projected::Projected;
use super::score::weight_of;
use super::significance::{Significance, Tests};
use crate::diagnosis::candidates::table::Candidate;
use crate::linear::Basis;
use crate::side_by_side::Threads;

/// Residuals of a chunk.
pub(super) const CHUNK: usize = 250;
/// The sum of all candidates' chances from which on the tail is simulated.
const TAIL: f64 = 0.03;

/// Surprises beyond `from`, largest first, each with its share of the chance.
#[derive(Debug)]
pub(super) struct Tail {
    pub(crate) from: f64,
    weighted: Vec<(f64, f64)>,
}

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
    count: usize,
}

/// Every candidate beside one model, for residuals to be sent through.
pub(super) struct Trials<'p> {
    projected: &'p Projected<'p>,
    all: Vec<Trial<'p>>,
    kinds: Vec<CandidateClass>,
    height: usize,
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
        let (height, inside) = projected.basis().q.shape();
        let freedom = rows - inside as f64;
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
                    count: 0,
                });
                kinds.len() - 1
            });
            kinds[kind].count += 1;
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
            height,
            threads,
        }
    }

    /// The largest −ln p of some residuals of one chunk: of these with their signs flipped, else Gaussian.
    pub(super) fn simulated(
        &self,
        flipped: Option<&DVector<f32>>,
        seed: u64,
        chunk: u64,
        which: Range<usize>,
    ) -> Vec<f64> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(chunk);
        let z = DMatrix::from_fn(self.height, which.end, |row, _| {
            f64::from(if let Some(flipped) = flipped {
                let sign = random.next_u32() & (1 << 31);
                f32::from_bits(flipped[row].to_bits() ^ sign)
            } else {
                StandardNormal.sample(&mut random)
            })
        });
        // Those before have to be drawn for these to come after them.
        self.reached(z.remove_columns(0, which.start), f64::INFINITY)
            .into_iter()
            .map(|r| r.0)
            .collect()
    }

    /// The largest −ln p of each residual, and how many candidates reach `from`.
    fn reached(&self, z: DMatrix<f64>, from: f64) -> Vec<(f64, usize)> {
        let count = z.ncols();
        let (noise, totals) = self.projected.of_noise(z);
        // By kind, what a gain has to be for each residual, and the largest.
        let enough: Vec<Vec<f32>> = self
            .kinds
            .iter()
            .map(|kind| {
                let share = if from.is_finite() {
                    kind.test.share_for(from + kind.weight) as f32
                } else {
                    f32::INFINITY
                };
                totals.iter().map(|total| share * total).collect()
            })
            .collect();
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
        // By kind the largest gain of each residual, and how many of these candidates reach what is enough.
        let of_some = |now: &[Trial]| {
            let mut most = vec![vec![0.0_f32; count]; enough.len()];
            let mut reaching = vec![0_usize; count];
            let mut gain = vec![0.0_f32; count];
            let first = now.first().map_or(0, |t| t.candidate.first);
            let width = now.last().map_or(0, |t| end(t) - first);
            let mut pulls = projected.pulls_of_noise(&noise, first, width);
            for trial in now {
                let at = (trial.candidate.first - first) * count;
                let own = &mut pulls.as_mut_slice()[at..at + trial.candidate.size * count];
                trial.gains(own, &mut gain);
                let (most, enough) = (&mut most[trial.kind], &enough[trial.kind]);
                for (k, gain) in gain.iter().enumerate() {
                    most[k] = most[k].max(*gain);
                    reaching[k] += usize::from(*gain >= enough[k]);
                }
            }
            (most, reaching)
        };
        // The largest of all and a sum of whole numbers are the same in whatever order they are taken.
        let mut most = vec![vec![0.0_f32; count]; enough.len()];
        let mut reaching = vec![0_usize; count];
        for (own, more) in self.threads.each(together.len(), |k| of_some(together[k])) {
            for (most, own) in most.iter_mut().flatten().zip(own.into_iter().flatten()) {
                *most = most.max(own);
            }
            for (sum, more) in reaching.iter_mut().zip(more) {
                *sum += more;
            }
        }
        let one = |(k, reaching): (usize, usize)| {
            let of_kind = self
                .kinds
                .iter()
                .zip(&most)
                .map(|(kind, most)| kind.test.of(f64::from(most[k] / totals[k])) - kind.weight);
            (of_kind.fold(0.0, f64::max), reaching)
        };
        reaching.into_iter().enumerate().map(one).collect()
    }

    /// Simulates one chunk of residuals that reach the tail; see the module.
    pub(super) fn tail(&self, seed: u64) -> Option<Tail> {
        let chance = |kind: &CandidateClass| kind.count as f64 * (-kind.weight).exp();
        let total: f64 = self.kinds.iter().map(chance).sum();
        if total <= 0.0 {
            return None;
        }
        let from = (total / TAIL).ln();
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(u64::MAX);
        let mut z = DMatrix::<f64>::zeros(self.height, CHUNK);
        for mut column in z.column_iter_mut() {
            let free = DVector::from_fn(self.height, |_, _| {
                let one: f32 = StandardNormal.sample(&mut random);
                f64::from(one)
            });
            let mut free = self.projected.basis().reject(&free);
            let mut at = random.random::<f64>() * total;
            let drawn = self.kinds.iter().position(|kind| {
                at -= chance(kind);
                at < 0.0
            });
            let kind = drawn.unwrap_or(self.kinds.len() - 1);
            let which = random.random_range(0..self.kinds[kind].count);
            let mut of_kind = self.all.iter().filter(|t| t.kind == kind);
            let trial = of_kind.nth(which)?;
            let own = Basis::new(&self.projected.columns(trial.candidate)).q;
            // The direction inside the candidate's columns stays, its share is drawn.
            let along = own.tr_mul(&free);
            free -= &own * &along;
            let chance = 1.0 - random.random::<f64>();
            let kind = &self.kinds[kind];
            let share = kind.test.share_for(from + kind.weight - chance.ln());
            let inside = own * &along * (share.sqrt() / along.norm().max(1e-30));
            let outside = free.norm().max(1e-30);
            column.copy_from(&(free * ((1.0 - share).sqrt() / outside) + inside));
        }
        let mut weighted: Vec<(f64, f64)> = self
            .reached(z, from)
            .into_iter()
            .map(|(largest, count)| {
                let weight = TAIL / (CHUNK * count.max(1)) as f64;
                (largest.max(from), weight)
            })
            .collect();
        weighted.sort_by(|a, b| b.0.total_cmp(&a.0));
        Some(Tail { from, weighted })
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

impl Tail {
    /// The chance of a −ln p as large; beyond the largest tenth it falls like exp(−s).
    pub(crate) fn chance(&self, minus_ln_p: f64) -> f64 {
        let few = self.weighted.len() / 10;
        let above = self.weighted.partition_point(|w| w.0 >= minus_ln_p);
        let sum = |count: usize| self.weighted[..count].iter().map(|w| w.1).sum::<f64>();
        if above > few {
            return sum(above);
        }
        sum(few) * (self.weighted[few.saturating_sub(1)].0 - minus_ln_p).exp()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnosis::candidates::columns::{CandidateSubset, ColumnBuilder};
    use crate::diagnosis::candidates::table::CandidateKind;
    use crate::diagnosis::evidence::projected::Grams;
    use crate::effects::{Term, joint_zero};
    use crate::fit::noise::Noise;

    const ROWS: usize = 300;

    /// Correlated candidates over so many rows, of three sizes and weights.
    fn candidates() -> (ColumnBuilder, Vec<Candidate>) {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let mut gathering = ColumnBuilder::new(ROWS, ROWS, &[]);
        let mut candidates = Vec::new();
        for (size, count, weight) in [(1, 40, 0.5), (2, 60, 2.0), (3, 20, 0.0_f64)] {
            let mut before = DMatrix::zeros(ROWS, size);
            for _ in 0..count {
                // Half of each column is its neighbour's.
                let own = DMatrix::from_fn(ROWS, size, |row, k| {
                    let one: f64 = StandardNormal.sample(&mut random);
                    one / (ROWS as f64).sqrt() + before[(row, k)]
                });
                before = Basis::new(&own).q;
                gathering.push(&before);
                let first = candidates
                    .last()
                    .map_or(0, |c: &Candidate| c.first + c.size);
                candidates.push(Candidate {
                    what: CandidateKind::Named(Term::absent(joint_zero(), 0, 0.0)),
                    first,
                    size,
                    tried: (2.0 * weight).exp(),
                });
            }
        }
        (gathering, candidates)
    }

    /// All of them beside an empty model.
    fn with_trials(look: impl Fn(&Trials)) {
        let (gathering, candidates) = candidates();
        let (columns, _) = gathering.done();
        let filter = Noise::white(1.0).filter_over(&[0.0; ROWS], &[0]);
        let grams = Grams::new(&columns, &filter, &candidates);
        let nothing = Basis::new(&DMatrix::zeros(ROWS, 0));
        let along = DMatrix::zeros(0, columns.count());
        let table = (&columns, &filter, &grams);
        let projected = Projected::new(table, &nothing, along, CandidateSubset::All);
        let trials = Trials::new(
            &projected,
            &candidates,
            &Tests::default(),
            (ROWS as f64, Threads::of(Some(2))),
        );
        look(&trials);
    }

    #[test]
    fn the_simulated_tail_agrees_with_many_plain_simulations() {
        with_trials(tail_agrees);
    }

    fn tail_agrees(trials: &Trials) {
        let mut plain: Vec<f64> = (0..80)
            .flat_map(|chunk| trials.simulated(None, 7, chunk, 0..CHUNK))
            .collect();
        plain.sort_by(|a, b| b.total_cmp(a));
        let count = plain.len() as f64;
        let tail = trials.tail(7).expect("simulated");
        for above in [300.0, 100.0, 40.0] {
            let minus_ln_p = plain[above as usize - 1];
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

    #[test]
    fn a_chunk_is_the_same_in_parts() {
        with_trials(is_the_same_in_parts);
    }

    fn is_the_same_in_parts(trials: &Trials) {
        for flipped in [None, Some(&DVector::from_element(ROWS, 1.5))] {
            let part = |which| trials.simulated(flipped, 7, 1, which);
            let parts = [part(0..50), part(50..100), part(100..CHUNK)];
            assert_eq!(parts.concat(), part(0..CHUNK));
        }
    }
}
