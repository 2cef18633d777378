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

use std::rc::Rc;

use nalgebra::{DMatrix, DVector};
use rand::{Rng, RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

pub(crate) use crate::answers::diagnosis::FamilyP;

use super::candidates::Candidate;
use super::columns::Among;
use super::projected::Projected;
use super::regression::{Fit, Regression};
use super::scores::weight_of;
use super::significance::{Significance, Tests};
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

/// What noise alone did to the search beside one model, so far.
#[derive(Debug)]
struct Null {
    rank: usize,
    /// Of the model that it was made for.
    fingerprint: Vec<u64>,
    /// Whether it is the same whatever the seed.
    seedless: bool,
    basis: Basis,
    /// What the signs of are flipped; zero where the residuals are Gaussian.
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
/// Chances between these are worth more simulations …
const CLOSE: [f64; 2] = [4e-4, 0.04];
/// … and on the way to what is tested at the end these.
const CLOSE_ON_THE_WAY: [f64; 2] = [1e-3, 0.01];

impl Regression<'_> {
    /// The chance that noise alone reaches `minus_ln_p` in the search. `fit` is a model in which
    /// the candidate is already: its residual is noise if the candidate is right.
    pub(crate) fn family_p(&self, minus_ln_p: f64, fit: &Fit) -> FamilyP {
        self.family_p_beside(minus_ln_p, fit, false)
    }

    /// Whether noise alone reaches it with more than this chance, on the way there, where the null of any
    /// model of the same size is good enough.
    pub(crate) fn reached_by_noise(&self, minus_ln_p: f64, chance: f64, fit: &Fit) -> bool {
        // One candidate alone does already; the others only add to it.
        let weights = self.table.candidates.iter().map(weight_of);
        let least = weights.fold(f64::INFINITY, f64::min);
        (-minus_ln_p - least).exp() > chance
            || self.family_p_beside(minus_ln_p, fit, true).p > chance
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
        let at = self.null_of(fit, rough, false);
        let null = &mut self.familywise.borrow_mut().null[at];
        let [from, to] = if rough { CLOSE_ON_THE_WAY } else { CLOSE };
        let is_close = |p: f64| p > from && p < to;
        let mut p = null.chance(minus_ln_p);
        if is_close(p) && null.tail.is_none() {
            let basis = null.basis.clone();
            let projected = self.projected(&basis, Among::All);
            let trials = Trials::new(&projected, &self.table.candidates, &self.tests, self.m());
            while is_close(p) && null.largest.len() < self.simulations() {
                null.take(trials.simulated(&null.noise, self.seed, null.chunks));
                p = null.chance(minus_ln_p);
            }
        }
        FamilyP {
            p: p.clamp(smallest, 1.0),
            bound: p < smallest,
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
        let seed = if seedless { 0 } else { self.seed };
        let projected = self.projected(&fit.basis, Among::All);
        let trials = Trials::new(&projected, &self.table.candidates, &self.tests, self.m());
        let largest = trials.simulated(&noise, seed, 0);
        let tail = if flip { None } else { trials.tail(seed) };
        let mut null = Null {
            rank,
            fingerprint,
            seedless,
            basis: fit.basis.clone(),
            noise,
            chunks: 0,
            largest: Vec::new(),
            tail,
        };
        null.take(largest);
        familywise.null.push(null);
        familywise.null.len() - 1
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

    /// Takes what one more chunk of simulated residuals reached.
    fn take(&mut self, largest: Vec<f64>) {
        self.chunks += 1;
        self.largest.extend(largest);
        self.largest.sort_by(|a, b| b.total_cmp(a));
    }
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
struct Kind {
    rank: usize,
    weight: f64,
    test: Rc<Significance>,
    count: usize,
}

/// Every candidate beside one model, for residuals to be sent through.
struct Trials<'p> {
    projected: &'p Projected<'p>,
    all: Vec<Trial<'p>>,
    kinds: Vec<Kind>,
    height: usize,
}

/// Columns that residuals are sent through at once.
const AT_ONCE: usize = 512;

impl<'p> Trials<'p> {
    /// Of candidates in `rows` measured rows.
    fn new(
        projected: &'p Projected<'p>,
        candidates: &'p [Candidate],
        tests: &Tests,
        rows: f64,
    ) -> Self {
        let (height, inside) = projected.basis().q.shape();
        let freedom = rows - inside as f64;
        let mut kinds: Vec<Kind> = Vec::new();
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
                kinds.push(Kind {
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
        }
    }

    /// The largest −ln p of one chunk of residuals.
    fn simulated(&self, noise: &DVector<f32>, seed: u64, chunk: u64) -> Vec<f64> {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        random.set_stream(chunk);
        let flip = noise.iter().any(|v| *v != 0.0);
        let z = DMatrix::from_fn(self.height, CHUNK, |row, _| {
            f64::from(if flip {
                let sign = random.next_u32() & (1 << 31);
                f32::from_bits(noise[row].to_bits() ^ sign)
            } else {
                StandardNormal.sample(&mut random)
            })
        });
        self.reached(z, f64::INFINITY)
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
        let mut most = vec![vec![0.0_f32; count]; self.kinds.len()];
        let mut reaching = vec![0_usize; count];
        let mut gain = vec![0.0_f32; count];
        let mut all = self.all.as_slice();
        while let Some(first) = all.first().map(|t| t.candidate.first) {
            let up_to = first + self.projected.together(first).min(AT_ONCE);
            let end = |t: &Trial| t.candidate.first + t.candidate.size;
            let some = all.partition_point(|t| end(t) <= up_to).max(1);
            let (now, rest) = all.split_at(some);
            all = rest;
            let width = now.last().map_or(0, |t| end(t) - first);
            let mut pulls = self.projected.pulls_of_noise(&noise, first, width);
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
    fn tail(&self, seed: u64) -> Option<Tail> {
        let chance = |kind: &Kind| kind.count as f64 * (-kind.weight).exp();
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnosis::Options;
    use crate::diagnosis::candidates::What;
    use crate::diagnosis::columns::Gathering;
    use crate::diagnosis::prepare::Prepared;
    use crate::diagnosis::projected::Grams;
    use crate::effects::{Term, joint_zero};
    use crate::fit::noise::Noise;
    use crate::simulation::{parse_scenario, simulate, unwatched};

    const ROWS: usize = 300;

    /// Correlated candidates over so many rows, of three sizes and weights.
    fn candidates() -> (Gathering, Vec<Candidate>) {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let mut gathering = Gathering::new(ROWS, ROWS, &[]);
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
                    what: What::Named(Term::absent(joint_zero(), 0, 0.0)),
                    first,
                    size,
                    tried: (2.0 * weight).exp(),
                });
            }
        }
        (gathering, candidates)
    }

    #[test]
    fn the_simulated_tail_agrees_with_many_plain_simulations() {
        let (gathering, candidates) = candidates();
        let (columns, _) = gathering.done();
        let filter = Noise::white(1.0).filter_over(&[0.0; ROWS], &[0]);
        let grams = Grams::new(&columns, &filter, &candidates);
        let nothing = Basis::new(&DMatrix::zeros(ROWS, 0));
        let along = DMatrix::zeros(0, columns.count());
        let table = (&columns, &filter, &grams);
        let projected = Projected::new(table, &nothing, along, Among::All);
        let trials = Trials::new(&projected, &candidates, &Tests::default(), ROWS as f64);
        let noise = DVector::zeros(ROWS);
        let mut plain: Vec<f64> = (0..80)
            .flat_map(|chunk| trials.simulated(&noise, 7, chunk))
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
    fn what_one_candidate_reaches_by_chance_needs_no_simulation() {
        let stops: Vec<String> = (0..40)
            .map(|k| format!(r#"{{"q_deg":[{}]}}"#, 7 * k - 140))
            .collect();
        let scenario = format!(
            r#"{{"format":"truepose-scenario/1","name":"noise","robot":{{"name":"r","joints":[
            {{"name":"pan","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0],"limits":[-170,170]}}],
            "tool":{{"position_mm":[400,0,300],"quaternion_wxyz":[1,0,0,0]}}}},"targets":{{"T1":[0,0,0]}},
            "instrument":{{"name":"tracker","sigma_mm":0.03}},"poses":{{"list":[{}]}},"effects":[],
            "noise":{{"sigma_mm":0.03,"kind":"gauss"}},"seed":4}}"#,
            stops.join(",")
        );
        let scenario = parse_scenario(scenario.as_bytes()).unwrap().scenario;
        let session = simulate(&scenario, 1, unwatched).unwrap().0;
        let prepared = Prepared::new(&session, &Options::default()).unwrap();
        let regression = &prepared.regression;
        let base = regression.fit(&regression.base, Vec::new());
        // e⁻⁵ alone is 0.007.
        assert!(regression.reached_by_noise(5.0, 0.002, &base));
        assert!(regression.familywise.borrow().null.is_empty());
        // Simulations say the same, and the opposite of what is far beyond.
        assert!(regression.family_p(5.0, &base).p > 0.007);
        assert!(!regression.reached_by_noise(16.0, 0.002, &base));
        assert!(!regression.familywise.borrow().null.is_empty());
    }
}
