//! The family-wise chance: how often the whole search would find as much in noise alone. Simulated residuals are sent
//! through every candidate at once, names and shapes together, and the largest −ln p of each is kept
//! ([`super::trials`]); their distribution is [`super::largest_in_noise`].
//!
//! The simulated residuals are the fit's own with their signs flipped at random, so that heavy tails stay
//! heavy (Winkler et al. 2014); of a long session they are equally large ([`ROWS_TO_FLIP`]).

use nalgebra::DVector;

pub(crate) use crate::answers::diagnosis::FamilyP;

use super::fit::Fit;
use super::largest_in_noise::LargestInNoise;
use super::memo::Key;
use super::regression::Regression;
use super::score::weight_of;
use super::trials::Trials;
use crate::budget;
use crate::diagnosis::candidates::columns::CandidateSubset;

/// The smallest chance that is stated: further out the distribution is an extrapolation that nothing has checked.
pub(crate) const SMALLEST: f64 = 1.0 / 2000.0;
/// Rows beyond which all residuals are taken to be equally large: with so many rows each candidate's gain is a sum
/// that is Gaussian whatever they are, and effects that are still to be found make some of them larger than others.
/// (Measured: of 60 sessions of 330 and 440 samples with t noise of 4 degrees of freedom 2 are reported as more than
/// noise, either way; a UR10 of 1495 poses has 12 names and 0.161 mm on unseen ones, with its own residuals 8 and
/// 0.185.)
const ROWS_TO_FLIP: usize = 900;
/// Chances that few simulations leave undecided: within a factor of five below and twenty above that by which a step
/// is taken (0.002). The largest five of 250 are known to a factor of 1.5, and the extrapolation may be low by a
/// factor of three.
const CLOSE: std::ops::Range<f64> = 4e-4..0.04;
/// The cost of a product in single precision, of many vectors at once, relative to others.
const OF_NOISE: f64 = 0.15;

impl Regression<'_> {
    /// The chance that noise alone reaches `minus_ln_p` in the search. `fit` is a model in which
    /// the candidate is already: its residual is noise if the candidate is right.
    pub(crate) fn family_p(&self, minus_ln_p: f64, fit: &Fit) -> FamilyP {
        let p = self.chance_in_noise(minus_ln_p, fit);
        FamilyP {
            p: p.clamp(SMALLEST, 1.0),
            bound: p < SMALLEST,
        }
    }

    /// The same as a number: by a few simulations, and by more of them where these leave it undecided.
    pub(crate) fn chance_in_noise(&self, minus_ln_p: f64, fit: &Fit) -> f64 {
        let by = |count| self.in_noise(fit, count).chance(minus_ln_p);
        // Of the larger number the fiftieth that is largest, from which on the law is extrapolated, is known to 1/√20, a
        // chance to a fifth.
        let few = by(budget::DRAWS);
        if CLOSE.contains(&few) {
            by(4 * budget::DRAWS)
        } else {
            few
        }
    }

    /// The −ln p that noise alone reaches with this chance.
    pub(crate) fn minus_ln_p_for(&self, chance: f64, fit: &Fit) -> f64 {
        self.in_noise(fit, budget::DRAWS).quantile(chance)
    }

    fn in_noise(&self, fit: &Fit, count: usize) -> LargestInNoise {
        let key = Key::of(fit).with(count);
        let simulate = || self.simulated(fit, count);
        self.largest_in_noise.of_key(key, simulate)
    }

    /// Whether noise alone reaches it with more than this chance. Used on the way to the final test: there the noise
    /// of any model of the same size is good enough.
    pub(crate) fn reached_by_noise(&self, minus_ln_p: f64, chance: f64, fit: &Fit) -> bool {
        // One candidate alone exceeds it already; the others only add to it.
        let weights = self.table.candidates.iter().map(weight_of);
        let least = weights.fold(f64::INFINITY, f64::min);
        let in_noise = || {
            let key = Key::default().with(fit.basis.rank());
            let simulate = || self.simulated(fit, budget::DRAWS);
            self.largest_in_noise.of_key(key, simulate)
        };
        (-minus_ln_p - least).exp() > chance || in_noise().chance(minus_ln_p) > chance
    }

    fn simulated(&self, fit: &Fit, count: usize) -> LargestInNoise {
        // A residual is smaller than the noise where the fit follows it. A row that an observation does not have
        // stays zero when it is flipped.
        let noise = |row: usize| {
            let kept = (1.0 - fit.basis.leverage(row)).max(0.05);
            (fit.residual[row] / kept.sqrt()) as f32
        };
        let mut noise = DVector::from_fn(self.height(), |row, _| noise(row));
        let gaps = self.rows.count() < self.rows.len();
        let long = !gaps && self.height() > ROWS_TO_FLIP;
        if long || noise.iter().all(|v| *v == 0.0) {
            noise.fill(1.0);
        }
        let around = self.projections(fit, CandidateSubset::All);
        let trials = Trials::new(self, &around);
        let columns = self.table.columns.count() * self.rows.samples.len();
        self.work.did(OF_NOISE * (columns * count) as f64);
        LargestInNoise::of(trials.largest(&noise, count))
    }
}

#[cfg(test)]
mod tests {
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
        // Simulations agree, and disagree far beyond.
        assert!(regression.family_p(5.0, &base).p > 0.007);
        assert!(!regression.reached_by_noise(16.0, 0.002, &base));
    }
}
