//! The distribution of the largest of many −ln p in noise alone, from n simulated ones: counted, and beyond the
//! fiftieth largest u extrapolated as
//!
//! ```text
//! P(max > s) = 1/50 exp(−(s − u))
//! ```
//!
//! the tail of the largest of similar candidates (Gumbel 1958). With heavy-tailed residuals the tail falls more
//! slowly: there the counted share is taken, up to three times the extrapolated one.

use std::rc::Rc;

use super::bisection::bisected;

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
        bisected([0.0, 1e3], |minus_ln_p| self.chance(minus_ln_p) > chance)
    }
}

#[cfg(test)]
mod tests {
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;
    use statrs::function::erf::erfc;

    use super::*;

    /// The mean over many draws of a thousand of the estimated chance, relative to the true one.
    fn estimated(mut surprise: impl FnMut() -> f64, at: f64, chance: f64) -> f64 {
        let laws = (0..200).map(|_| LargestInNoise::of((0..1000).map(|_| surprise()).collect()));
        laws.map(|law| law.chance(at)).sum::<f64>() / 200.0 / chance
    }

    /// Of all directions in each of thirty planes, neighbours of one another: `max |uᵀz| = |z|`, so that noise reaches
    /// t in a plane with the chance `exp(−t²/2)`, where one direction alone reaches it with `erfc(t/√2)`. Further out
    /// neighbours are more candidates, as √s: by so much the extrapolation is too small.
    #[test]
    fn the_law_holds_beyond_what_was_simulated() {
        let surprise = |t: f64| -erfc(t / 2.0_f64.sqrt()).ln();
        let in_a_plane = |chance: f64| surprise((-2.0 * chance.ln()).sqrt());
        let of_all = |chance: f64| in_a_plane(-((-chance).ln_1p() / 30.0).exp_m1());
        for (chance, within) in [(0.1, 1.1), (0.01, 1.15), (0.002, 1.3), (1e-5_f64, 1.6)] {
            let mut random = ChaCha8Rng::seed_from_u64(1);
            let drawn = || of_all(1.0 - random.random::<f64>());
            let estimated = estimated(drawn, of_all(chance), chance);
            assert!(
                estimated > 1.0 / within && estimated < within,
                "{chance}: {estimated}"
            );
        }
        let law = LargestInNoise::of(
            (0..1000)
                .map(|k| of_all((f64::from(k) + 0.5) / 1000.0))
                .collect(),
        );
        assert!((law.chance(law.quantile(0.002)) / 0.002 - 1.0).abs() < 1e-6);
    }

    /// A tail that falls as exp(−0.6 s), as where some residuals are larger than others: the extrapolation would give
    /// a fifth.
    #[test]
    fn of_heavier_tails_what_was_counted_counts() {
        let mut random = ChaCha8Rng::seed_from_u64(2);
        let at = |chance: f64| 6.0 - chance.ln() / 0.6;
        let estimated = estimated(|| at(1.0 - random.random::<f64>()), at(0.002), 0.002);
        assert!(estimated > 0.4 && estimated < 1.1, "{estimated}");
    }
}
