//! The law of the largest of many −ln p in noise alone. Beyond the fifth of simulated ones that are largest, from u on,
//!
//! ```text
//! P(max > s) = 1/5 √(s/u) exp(−θ (s − u))
//! ```
//!
//! The largest of N candidates alike has N exp(−s) (Gumbel 1958); of neighbouring settings several are candidates of
//! their own the further out the surprise lies, as √s (upcrossings, Davies 1987). θ = 1 holds for Gaussian noise; of
//! residuals with heavy tails, or of which some are larger than others, the surprises fall more slowly, as their mean
//! excess over u says (Pickands 1975): θ is one over it, beside 1/2u for the root, and never above 1.

/// The law of the largest −ln p among all candidates, in noise alone.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LargestInNoise {
    /// `u`.
    from: f64,
    /// `θ`.
    rate: f64,
}

impl LargestInNoise {
    /// From simulated ones, at least five.
    pub(super) fn of(largest: &[f64]) -> Self {
        let mut sorted = largest.to_vec();
        sorted.sort_by(|a, b| b.total_cmp(a));
        let known = sorted.len() / 5;
        let from = sorted[known].max(1.0);
        let excess = sorted[..known].iter().map(|s| (s - from).max(0.0));
        let mean = excess.sum::<f64>() / known.max(1) as f64;
        Self {
            from,
            rate: (1.0 / mean.max(f64::MIN_POSITIVE) + 0.5 / from).min(1.0),
        }
    }

    /// The chance of one as large.
    pub(crate) fn chance(self, minus_ln_p: f64) -> f64 {
        let s = minus_ln_p.max(1.0);
        let fall = (-self.rate * (s - self.from)).exp();
        (0.2 * (s / self.from).sqrt() * fall).min(1.0)
    }

    /// The one that noise reaches with this chance.
    pub(crate) fn quantile(self, chance: f64) -> f64 {
        let (mut low, mut high) = (1.0, 1e3);
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
        let simulated: Vec<f64> = (0..100_000).map(|_| largest()).collect();
        let law = LargestInNoise::of(&simulated);
        for chance in [0.1, 0.01, 0.002, 0.0005_f64] {
            let found = law.chance(of_all(chance));
            assert!((found / chance).ln().abs() < 0.2, "{chance}: {found}");
            assert!((law.chance(law.quantile(chance)) / chance - 1.0).abs() < 1e-9);
        }
    }

    /// What falls more slowly, as a sum of squares of heavy-tailed numbers does.
    #[test]
    fn tails_that_are_heavy_stay_heavy() {
        let mut random = ChaCha8Rng::seed_from_u64(2);
        let mut largest = || 6.0 - (1.0 - random.random::<f64>()).ln() / 0.6;
        let law = LargestInNoise::of(&(0..100_000).map(|_| largest()).collect::<Vec<_>>());
        for chance in [0.1, 0.01, 0.002, 0.0005_f64] {
            let found = law.chance(6.0 - chance.ln() / 0.6);
            assert!((found / chance).ln().abs() < 0.2, "{chance}: {found}");
        }
    }
}
