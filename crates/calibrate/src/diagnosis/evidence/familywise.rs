//! How often the whole search would find as much in noise alone: simulated residuals are sent
//! through every candidate at once, names and shapes together, and the largest −ln p of each is
//! kept.
//!
//! The simulated residuals are the fit's own with their signs flipped at random, so that heavy
//! tails stay heavy (Winkler et al. 2014); in a long session without heavy tails they are
//! Gaussian. A −ln p beyond all of them is judged by the tail: it falls like
//! C·exp(−s), with C from the largest simulated ones ([`super::trials`]).
//!
//! Mostly it is only asked whether noise reaches as much at all: where it does, a few simulations say so.

use std::sync::Arc;

use nalgebra::DVector;

pub(crate) use crate::answers::diagnosis::FamilyP;

use super::fit::Fit;
use super::noise_alone::Null;
use super::regression::Regression;
use super::score::weight_of;
use super::trials::{CHUNK, Trials};
use crate::diagnosis::candidates::columns::CandidateSubset;
use crate::effects::rank as rank_in_catalogue;

/// Simulations of a short session.
const MOST: usize = 2000;
const SMALLEST: f64 = 1.0 / MOST as f64;
const FEWEST: usize = 300;
/// Rows beyond which fewer simulations have to do.
const ROWS: usize = 480;
/// Rows beyond which simulated residuals are Gaussian, if the fit's own look so.
const ROWS_TO_FLIP: usize = 900;
/// A larger kurtosis than this (a Gaussian has 3) means heavy tails.
const MOST_KURTOSIS: f64 = 3.6;

/// What a product in single precision, of many vectors at once, costs beside others.
const OF_NOISE: f64 = 0.15;
/// Whether noise reaches something may be answered after so many residuals of the first chunk …
const FEW: [usize; 2] = [50, 100];

impl Regression<'_> {
    /// The chance that noise alone reaches `minus_ln_p` in the search. `fit` is a model in which
    /// the candidate is already: its residual is noise if the candidate is right.
    pub(crate) fn family_p(&self, minus_ln_p: f64, fit: &Fit) -> FamilyP {
        if let Some(known) = self.without_simulation(minus_ln_p) {
            return known;
        }
        let at = self.null_of(fit, false, false);
        let most = self.simulations();
        self.simulate(at, &[], |null| null.has_p(minus_ln_p, most));
        let p = self.familywise.borrow().null[at].chance(minus_ln_p);
        FamilyP {
            p: p.clamp(SMALLEST, 1.0),
            bound: p < SMALLEST,
        }
    }

    /// Whether noise alone reaches it with more than this chance: as [`family_p`](Self::family_p) has it, which
    /// need not be known closer.
    pub(crate) fn is_improbable(&self, minus_ln_p: f64, chance: f64, fit: &Fit) -> bool {
        self.exceeds_chance(minus_ln_p, chance, fit, false)
    }

    /// The same on the way there, where the null of any model of the same size is good enough.
    pub(crate) fn reached_by_noise(&self, minus_ln_p: f64, chance: f64, fit: &Fit) -> bool {
        // One candidate alone does already; the others only add to it.
        let weights = self.table.candidates.iter().map(weight_of);
        let least = weights.fold(f64::INFINITY, f64::min);
        (-minus_ln_p - least).exp() > chance || self.exceeds_chance(minus_ln_p, chance, fit, true)
    }

    fn exceeds_chance(&self, minus_ln_p: f64, chance: f64, fit: &Fit, rough: bool) -> bool {
        if let Some(known) = self.without_simulation(minus_ln_p) {
            return known.p > chance;
        }
        let at = self.null_of(fit, rough, false);
        let most = self.simulations();
        self.simulate(at, &FEW, |null| {
            null.surely_reaches(minus_ln_p, chance)
                || rough && null.is_apart(minus_ln_p, chance)
                || null.has_p(minus_ln_p, most)
        });
        let null = &self.familywise.borrow().null[at];
        null.surely_reaches(minus_ln_p, chance) || null.chance(minus_ln_p) > chance
    }

    /// Beyond what all candidates together could do by chance there is nothing to simulate, nor where
    /// every noise reaches it.
    fn without_simulation(&self, minus_ln_p: f64) -> Option<FamilyP> {
        let (p, bound) = if minus_ln_p > self.beyond_all() {
            (SMALLEST, true)
        } else if minus_ln_p < 2.0 {
            (1.0, false)
        } else {
            return None;
        };
        Some(FamilyP { p, bound })
    }

    fn beyond_all(&self) -> f64 {
        (self.table.candidates.len() as f64).ln() + 14.0
    }

    /// The −ln p that noise alone reaches with this chance. Sizes and limits depend on it, and on no
    /// seed: it comes from simulations of its own.
    pub(crate) fn minus_ln_p_for(&self, chance: f64, fit: &Fit) -> f64 {
        let at = self.null_of(fit, false, true);
        self.simulate(at, &[], Null::has_a_chunk);
        let null = &self.familywise.borrow().null[at];
        let (mut low, mut high) = (2.0, self.beyond_all());
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

    /// Place of what noise does beside a fit; nothing is simulated yet where it is new.
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
        let flipped = |row: usize| {
            let kept = (1.0 - fit.basis.leverage(row)).max(0.05);
            (fit.residual[row] / kept.sqrt()) as f32
        };
        familywise.null.push(Null {
            rank,
            fingerprint,
            seedless,
            basis: Arc::clone(&fit.basis),
            flipped: flip
                .then(|| DVector::from_fn(m, |row, _| flipped(row)))
                .filter(|noise| noise.iter().any(|v| *v != 0.0)),
            largest: Vec::new(),
            tail: None,
        });
        familywise.null.len() - 1
    }

    /// Simulates until an answer is there; the first chunk may stop after each of `parts`.
    fn simulate(&self, at: usize, parts: &[usize], answered: impl Fn(&Null) -> bool) {
        let null = &mut self.familywise.borrow_mut().null[at];
        if answered(null) {
            return;
        }
        let basis = Arc::clone(&null.basis);
        let projected = self.projected(&basis, CandidateSubset::All);
        let trials = Trials::new(
            &projected,
            &self.table.candidates,
            &self.tests,
            (self.m(), self.threads),
        );
        let seed = if null.seedless { 0 } else { self.seed };
        while !answered(null) {
            let there = null.largest.len();
            let within = there % CHUNK;
            let next = parts.iter().filter(|_| there < CHUNK);
            let end = next.copied().find(|end| *end > within).unwrap_or(CHUNK);
            let chunk = (there / CHUNK) as u64;
            let columns = self.table.columns.count() * self.rows.samples.len();
            self.work.did(OF_NOISE * (columns * (end - within)) as f64);
            let noise = null.flipped.as_ref();
            null.add_simulated(trials.simulated(noise, seed, chunk, within..end));
            if null.largest.len() == CHUNK && null.flipped.is_none() {
                null.tail = trials.tail(seed);
            }
        }
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

/// Fourth moment over the square of the second; 3 for a Gaussian.
fn kurtosis(values: &DVector<f64>) -> f64 {
    let n = values.len().max(1) as f64;
    let moment = |power: i32| values.iter().map(|v| v.powi(power)).sum::<f64>() / n;
    moment(4) / moment(2).powi(2).max(1e-300)
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;

    use super::*;
    use crate::diagnosis::Options;
    use crate::diagnosis::search::prepare::PreparedSearch;
    use crate::linear::Basis;
    use crate::simulation::{parse_scenario, simulate, unwatched};

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
        let prepared = PreparedSearch::new(&session, &Options::default()).unwrap();
        let regression = &prepared.regression;
        let base = regression.fit(&regression.base, &[]);
        // e⁻⁵ alone is 0.007.
        assert!(regression.reached_by_noise(5.0, 0.002, &base));
        assert!(regression.familywise.borrow().null.is_empty());
        // Simulations say the same, and the opposite of what is far beyond.
        assert!(regression.family_p(5.0, &base).p > 0.007);
        assert!(!regression.reached_by_noise(16.0, 0.002, &base));
        assert!(!regression.familywise.borrow().null.is_empty());
    }

    /// What every tenth residual of noise reaches is said after a few of them; what few reach, after all.
    #[test]
    fn on_the_way_a_few_simulations_say_what_noise_reaches() {
        let null = |largest: Vec<f64>| {
            let mut null = Null {
                rank: 0,
                fingerprint: Vec::new(),
                seedless: false,
                basis: Arc::new(Basis::new(&DMatrix::zeros(1, 0))),
                flipped: None,
                largest: Vec::new(),
                tail: None,
            };
            null.add_simulated(largest);
            null
        };
        let of = |reach: usize, count: usize| {
            let reached = (0..count).map(|k| if k < reach { 9.0 } else { 4.0 });
            null(reached.collect())
        };
        for (reach, count, surely) in [
            (5, 50, true),
            (2, 50, false),
            (4, 100, true),
            (0, 100, false),
        ] {
            let few = of(reach, count);
            assert_eq!(few.surely_reaches(8.0, 0.002), surely, "{reach} of {count}");
            assert!(!few.has_p(8.0, MOST) && !few.is_apart(8.0, 0.002));
        }
        // Binomial: 4 or more of 100 at 0.002 come once in 18 000.
        assert!(!of(3, 100).surely_reaches(8.0, 0.002));
        assert!(of(100, CHUNK).has_p(8.0, MOST));
        // One in a hundred is five times as much as is asked for; one in 250 may be chance.
        let apart = |null: &Null| null.is_apart(8.0, 0.002);
        assert!(apart(&of(10, 2 * CHUNK)) && !apart(&of(3, 2 * CHUNK)));
    }
}
