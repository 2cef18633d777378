//! How often the whole search would find as much in noise alone: simulated residuals are sent
//! through every candidate at once, names and shapes together, and the largest −ln p of each is
//! kept ([`super::trials`]). The largest of as good as N candidates that are alike exceeds s with
//!
//! ```text
//! P(max > s) = 1 − exp(−N(s) exp(−s)),   N(s) = c √s,   ĉ = n / Σ √s_k exp(−s_k)
//! ```
//!
//! (Gumbel 1958; of neighbouring settings several are candidates of their own the further out the
//! surprise lies, as √s: upcrossings, Davies 1987). ĉ is the maximum of the likelihood of n simulated
//! surprises `s_k`, known to 1/√n.
//!
//! The simulated residuals are the fit's own with their signs flipped at random, so that heavy tails stay
//! heavy (Winkler et al. 2014).

use nalgebra::DVector;

pub(crate) use crate::answers::diagnosis::FamilyP;

use super::fit::Fit;
use super::regression::Regression;
use super::score::weight_of;
use super::trials::{SIMULATED, Trials};
use crate::diagnosis::candidates::columns::CandidateSubset;

/// The smallest chance that is stated: further out the law is an extrapolation that nothing has checked.
const SMALLEST: f64 = 1.0 / 2000.0;
/// What a product in single precision, of many vectors at once, costs beside others.
const OF_NOISE: f64 = 0.15;

/// The law of the largest −ln p among all candidates, in noise alone.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LargestInNoise {
    /// `c`.
    candidates: f64,
}

impl LargestInNoise {
    /// From simulated ones.
    fn of(largest: &[f64]) -> Self {
        let expected = largest.iter().map(|s| s.max(0.0).sqrt() * (-s).exp());
        Self {
            candidates: largest.len() as f64 / expected.sum::<f64>().max(f64::MIN_POSITIVE),
        }
    }

    /// The chance of one as large.
    pub(crate) fn chance(self, minus_ln_p: f64) -> f64 {
        let s = minus_ln_p.max(0.5);
        -(-self.candidates * s.sqrt() * (-s).exp()).exp_m1()
    }

    /// The one that noise reaches with this chance.
    pub(crate) fn quantile(self, chance: f64) -> f64 {
        let expected = -(-chance).ln_1p() / self.candidates;
        // s = ln(√s / expected) contracts from s = ½ on.
        (0..60).fold(8.0, |s: f64, _| (0.5 * s.ln() - expected.ln()).max(0.5))
    }
}

impl Regression<'_> {
    /// The chance that noise alone reaches `minus_ln_p` in the search. `fit` is a model in which
    /// the candidate is already: its residual is noise if the candidate is right.
    pub(crate) fn family_p(&self, minus_ln_p: f64, fit: &Fit) -> FamilyP {
        let p = self.in_noise(fit).chance(minus_ln_p);
        FamilyP {
            p: p.clamp(SMALLEST, 1.0),
            bound: p < SMALLEST,
        }
    }

    /// The law of the largest −ln p beside a fit.
    pub(crate) fn in_noise(&self, fit: &Fit) -> LargestInNoise {
        self.largest_in_noise.of(fit, || self.simulated(fit))
    }

    /// Whether noise alone reaches it with more than this chance, on the way to what is tested at the end: there that of
    /// any model of the same size is good enough.
    pub(crate) fn reached_by_noise(&self, minus_ln_p: f64, chance: f64, fit: &Fit) -> bool {
        // One candidate alone does already; the others only add to it.
        let weights = self.table.candidates.iter().map(weight_of);
        let least = weights.fold(f64::INFINITY, f64::min);
        let size = fit.basis.rank();
        let in_noise = || self.largest_in_noise.of_size(size, || self.simulated(fit));
        (-minus_ln_p - least).exp() > chance || in_noise().chance(minus_ln_p) > chance
    }

    fn simulated(&self, fit: &Fit) -> LargestInNoise {
        // A residual is smaller than the noise where the fit follows it. A row that an observation does not have
        // stays zero when it is flipped.
        let noise = |row: usize| {
            let kept = (1.0 - fit.basis.leverage(row)).max(0.05);
            (fit.residual[row] / kept.sqrt()) as f32
        };
        let mut noise = DVector::from_fn(self.height(), |row, _| noise(row));
        if noise.iter().all(|v| *v == 0.0) {
            noise.fill(1.0);
        }
        let projected = self.projected(&fit.basis, CandidateSubset::All);
        let rows = (self.m(), self.threads);
        let trials = Trials::new(&projected, &self.table.candidates, &self.tests, rows);
        let columns = self.table.columns.count() * self.rows.samples.len();
        self.work.did(OF_NOISE * (columns * SIMULATED) as f64);
        LargestInNoise::of(&trials.largest(&noise))
    }
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;
    use statrs::function::erf::erfc;

    use super::*;
    use crate::diagnosis::Options;
    use crate::diagnosis::search::prepare::PreparedSearch;
    use crate::simulation::{parse_scenario, simulate, unwatched};

    #[test]
    fn what_one_candidate_reaches_by_chance_all_reach() {
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
        // Simulations say the same, and the opposite of what is far beyond.
        assert!(regression.family_p(5.0, &base).p > 0.007);
        assert!(!regression.reached_by_noise(16.0, 0.002, &base));
    }

    /// Of all directions in each of thirty planes, neighbours of one another: `max |uᵀz| = |z|`, so that noise
    /// reaches t in a plane with the chance `exp(−t²/2)`, where one direction alone reaches it with `erfc(t/√2)`.
    #[test]
    fn the_law_holds_far_beyond_what_was_simulated() {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let surprise = |t: f64| -erfc(t / 2.0_f64.sqrt()).ln();
        let in_a_plane = |chance: f64| surprise((-2.0 * chance.ln()).sqrt());
        let of_all = |chance: f64| in_a_plane(-((-chance).ln_1p() / 30.0).exp_m1());
        let mut largest = || of_all(1.0 - random.random::<f64>());
        let law = LargestInNoise::of(&(0..2000).map(|_| largest()).collect::<Vec<_>>());
        for chance in [0.1, 0.01, 0.002, 0.0005_f64] {
            let found = law.chance(of_all(chance));
            assert!((found / chance).ln().abs() < 0.1, "{chance}: {found}");
            assert!((law.chance(law.quantile(chance)) / chance - 1.0).abs() < 1e-9);
        }
    }
}
