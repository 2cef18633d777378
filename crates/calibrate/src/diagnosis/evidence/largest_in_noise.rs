//! The law of the largest of many −ln p in noise alone. Of as good as N candidates that are alike
//!
//! ```text
//! P(max > s) = 1 − exp(−N(s) exp(−s)),   N(s) = c √s,   ĉ = n / Σ √s_k exp(−s_k)
//! ```
//!
//! (Gumbel 1958; of neighbouring settings several are candidates of their own the further out the
//! surprise lies, as √s: upcrossings, Davies 1987). ĉ is the maximum of the likelihood of n simulated
//! surprises `s_k`, known to 1/√n.

/// The law of the largest −ln p among all candidates, in noise alone.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LargestInNoise {
    /// `c`.
    candidates: f64,
}

impl LargestInNoise {
    /// From simulated ones.
    pub(super) fn of(largest: &[f64]) -> Self {
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
        let law = LargestInNoise::of(&(0..2000).map(|_| largest()).collect::<Vec<_>>());
        for chance in [0.1, 0.01, 0.002, 0.0005_f64] {
            let found = law.chance(of_all(chance));
            assert!((found / chance).ln().abs() < 0.1, "{chance}: {found}");
            assert!((law.chance(law.quantile(chance)) / chance - 1.0).abs() < 1e-9);
        }
    }
}
