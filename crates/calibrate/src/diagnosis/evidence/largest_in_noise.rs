//! The law of the largest of many −ln p in noise alone, from n simulated ones: counted, and from the fiftieth u that is
//! largest on
//!
//! ```text
//! P(max > s) = 1/50 exp(−(s − u))
//! ```
//!
//! as of the largest of candidates that are alike (Gumbel 1958). Of residuals with heavy tails surprises fall more slowly:
//! there what was counted is the answer, up to three times the law.

use std::rc::Rc;

/// The law of the largest −ln p among all candidates, in noise alone.
#[derive(Debug, Clone)]
pub(crate) struct LargestInNoise {
    /// Simulated ones, largest first.
    largest: Rc<[f64]>,
}

/// Beyond what one of so many simulations reaches the law is extrapolated.
const TAIL_SHARE: usize = 50;

impl LargestInNoise {
    /// From simulated ones, at least two.
    pub(super) fn of(mut largest: Vec<f64>) -> Self {
        largest.sort_by(|a, b| b.total_cmp(a));
        Self {
            largest: largest.into(),
        }
    }

    /// The chance of one as large.
    pub(crate) fn chance(&self, minus_ln_p: f64) -> f64 {
        let count = self.largest.len();
        let above = self.largest.partition_point(|s| *s >= minus_ln_p);
        let rank = (count / TAIL_SHARE).max(1);
        let counted = above as f64 / count as f64;
        if above > rank {
            return counted;
        }
        let share = rank as f64 / count as f64;
        let by_law = share * (self.largest[rank - 1] - minus_ln_p).exp();
        by_law.max(counted.min(3.0 * by_law))
    }

    /// The one that noise reaches with this chance.
    pub(crate) fn quantile(&self, chance: f64) -> f64 {
        let (mut low, mut high) = (0.0, 1e3);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if self.chance(middle) > chance {
                low = middle;
            } else {
                high = middle;
            }
        }
        high
    }
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;
    use statrs::function::erf::erfc;

    use super::*;

    /// Of all directions in each of thirty planes, neighbours of one another: `max |uᵀz| = |z|`, so that noise
    /// reaches t in a plane with the chance `exp(−t²/2)`, where one direction alone reaches it with `erfc(t/√2)`.
    #[test]
    fn the_law_holds_far_beyond_what_was_simulated() {
        let mut random = ChaCha8Rng::seed_from_u64(1);
        let surprise = |t: f64| -erfc(t / 2.0_f64.sqrt()).ln();
        let in_a_plane = |chance: f64| surprise((-2.0 * chance.ln()).sqrt());
        let of_all = |chance: f64| in_a_plane(-((-chance).ln_1p() / 30.0).exp_m1());
        let mut largest = || of_all(1.0 - random.random::<f64>());
        let simulated: Vec<f64> = (0..1_000_000).map(|_| largest()).collect();
        let law = LargestInNoise::of(simulated);
        for chance in [0.1, 0.01, 0.002, 0.0005_f64] {
            let found = law.chance(of_all(chance));
            assert!((found / chance).ln().abs() < 0.2, "{chance}: {found}");
            assert!(law.chance(law.quantile(chance)) <= chance);
        }
    }
}
