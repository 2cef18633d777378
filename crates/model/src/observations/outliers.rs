//! Outliers: samples whose weighted deviation is too long to be noise.
//!
//! ```text
//! d² = Σ_a (e_a/σ_a)²,   p(d) = (1 − π) f_ν(d/s)/s + π g(d)
//! ```
//!
//! `f_ν` is the length of a k-dimensional deviation of Student's t with ν degrees of freedom (ν = ∞:
//! Gaussian, the length is that of χ), g is flat in ln d from `FROM` to `TO` scales. π, s and ν
//! are the likeliest ones (expectation–maximisation; a contaminated population as in Tukey 1960, with tails that may
//! themselves be heavy, Lange, Little & Taylor 1989). A sample is suspected where it is four times likelier to be an
//! outlier than noise: clean samples of any tail pass, and outliers do not.
//!
//! The sizes `σ_a` of the axes are trimmed variances: what is suspected does not count (redescending,
//! Hampel 1974).

use statrs::function::gamma::ln_gamma;

use crate::distributions::CHI_MEDIANS;
use crate::{budget, fewest, rounding};

/// Outliers lie beyond so many scales (derived: where the bulk of a Gaussian ends, one of 150
/// samples on three axes) …
const FROM: f64 = 3.5;
/// … and as a rule below so many.
/// The density between the two is flat in ln d.
const TO: f64 = 100.0;
/// Odds from which on a sample is suspected.
/// Calibrated (`hidden_effects outliers`): of outliers of 7 to 20 σ at least 95 % are caught,
/// of good samples at most 0.5 % accused.
const ODDS: f64 = 4.0;
/// Degrees of freedom that are tried; the last is as good as Gaussian.
/// Below 3 a t distribution has no variance that could be a noise (Lange, Little & Taylor
/// 1989).
const TAILS: [f64; 6] = [3.0, 4.0, 6.0, 10.0, 25.0, 1e6];
/// The bulk of a long session is known from so many samples.
pub const MOST_IN_THE_BULK: usize = 20_000;
/// The share of outliers that is assumed where none is seen.
const LEAST_SHARE: f64 = 0.002;
/// No fit is taken to have taken up more of the noise than this.
const MOST_SPENT: f64 = 0.9;
/// More than this is no contamination any more: the model lacks something, and nothing is suspected.
pub const MOST_SHARE: f64 = 0.35;

/// Marks outliers in deviations along some axes, mm, one value for each sample; `counts` marks those that make the
/// bulk. `sigma` is the sizes of the axes, up to a common factor; where `balance` is true they are estimated.
pub fn suspected(axes: &[&[f64]], counts: &[bool], sigma: &[f64], balance: bool) -> Vec<bool> {
    let n = counts.len();
    let in_bulk = |i: &usize| counts[*i] && axes.iter().all(|e| e[*i].is_finite());
    let count = (0..n).filter(in_bulk).count();
    let stride = count.div_ceil(MOST_IN_THE_BULK).max(1);
    let bulk: Vec<usize> = (0..n).filter(in_bulk).step_by(stride).collect();
    if bulk.len() < fewest::TO_JUDGE || axes.is_empty() {
        return vec![false; n];
    }
    let mut sigma = sigma.to_vec();
    let mut limit = f64::INFINITY;
    let lengths = |sigma: &[f64], i: usize| {
        let squares = axes.iter().zip(sigma).map(|(e, s)| (e[i] / s).powi(2));
        squares.sum::<f64>().sqrt()
    };
    for round in 0..4 {
        if balance {
            let inside = |i: &&usize| round == 0 || lengths(&sigma, **i) <= limit;
            let kept: Vec<usize> = bulk.iter().filter(inside).copied().collect();
            if kept.len() < fewest::TO_JUDGE {
                break;
            }
            sigma = axes.iter().map(|e| size(e, &kept, round == 0)).collect();
        }
        let d: Vec<f64> = bulk.iter().map(|i| lengths(&sigma, *i)).collect();
        limit = limit_of(&d, axes.len());
        if !balance {
            break;
        }
    }
    let apart = |i: usize| {
        let rounding = axes.iter().all(|e| e[i].abs() < rounding::WRITTEN);
        !rounding && lengths(&sigma, i) > limit
    };
    // A fit that has come down to few samples goes through these and has large residuals at all others.
    let of_the_bulk = bulk.iter().filter(|i| apart(**i)).count();
    if are_the_rule(of_the_bulk, bulk.len()) {
        return vec![false; n];
    }
    let mut marked: Vec<bool> = (0..n).map(apart).collect();
    // Of those that are held out most may be far from a model that fails there: none of them is suspected then.
    let held_out = |i: &usize| !counts[*i] && axes.iter().all(|e| e[*i].is_finite());
    let unseen: Vec<usize> = (0..n).filter(held_out).collect();
    if are_the_rule(unseen.iter().filter(|i| marked[**i]).count(), unseen.len()) {
        for i in unseen {
            marked[i] = false;
        }
    }
    marked
}

/// Whether so many of all are no contamination any more: most samples that no fit has seen are far off where the model
/// fails, which is what they were held out to show.
pub fn are_the_rule(apart: usize, all: usize) -> bool {
    apart as f64 > MOST_SHARE * all as f64
}

/// The deviation of a sample that a fit has not seen, as if it had been fitted, for each unit:
///
/// ```text
/// e_seen ≈ σ √(1 − p/m),   e_unseen ≈ σ √(1 + h),   h = tr(J C Jᵀ)/rows
/// ```
///
/// with p coefficients of m rows, C the covariance of the coefficients and J the columns of the sample, both in units
/// of the noise (Cook & Weisberg 1982, 2.1). Without it a sample that was left out of a short session stays out for
/// being left out, and takes others along.
pub fn as_if_seen(rank: usize, rows: usize, leverage: f64) -> f64 {
    (kept(rank as f64, rows) / (1.0 + leverage)).sqrt()
}

/// The share of the noise in the residuals of the fitted rows, at least a tenth.
pub(super) fn kept(rank: f64, rows: usize) -> f64 {
    1.0 - (rank / rows.max(1) as f64).min(MOST_SPENT)
}

/// Size of one axis: first from the median, then from what is not suspected.
fn size(e: &[f64], kept: &[usize], robust: bool) -> f64 {
    let of = if robust {
        let mut all: Vec<f64> = kept.iter().map(|i| e[*i].abs()).collect();
        let middle = all.len() / 2;
        let (_, median, _) = all.select_nth_unstable_by(middle, f64::total_cmp);
        *median / CHI_MEDIANS[0]
    } else {
        (kept.iter().map(|i| e[*i] * e[*i]).sum::<f64>() / kept.len() as f64).sqrt()
    };
    of.max(rounding::WRITTEN)
}

/// Length beyond which a sample is suspected.
fn limit_of(lengths: &[f64], k: usize) -> f64 {
    let mut sorted = lengths.to_vec();
    sorted.sort_by(f64::total_cmp);
    let count = sorted.len();
    let thinned: Vec<f64> = if count > budget::SAMPLES {
        (0..budget::SAMPLES)
            .map(|j| sorted[(2 * j + 1) * count / (2 * budget::SAMPLES)])
            .collect()
    } else {
        sorted.clone()
    };
    let median = sorted[count / 2].max(f64::EPSILON);
    let best = TAILS
        .iter()
        .map(|nu| Mixture::fitted(&thinned, k, *nu, median))
        .max_by(|a, b| a.ln_likelihood.total_cmp(&b.ln_likelihood));
    best.map_or(f64::INFINITY, |mixture| mixture.limit())
}

/// The bulk and the outliers.
#[derive(Debug, Clone, Copy)]
struct Mixture {
    k: f64,
    nu: f64,
    scale: f64,
    share: f64,
    ln_likelihood: f64,
    /// Logarithms of the gamma function at k/2, ν/2 and (ν + k)/2.
    ln_gammas: [f64; 3],
    ln_nu: f64,
}

impl Mixture {
    /// The likeliest share and scale for one tail.
    fn fitted(lengths: &[f64], k: usize, nu: f64, median: f64) -> Self {
        let middle = CHI_MEDIANS[k.clamp(1, 3) - 1];
        let k = k as f64;
        let mut mixture = Self {
            k,
            nu,
            scale: median / middle,
            share: 0.05,
            ln_likelihood: f64::NEG_INFINITY,
            ln_gammas: [0.5 * k, 0.5 * nu, 0.5 * (nu + k)].map(ln_gamma),
            ln_nu: nu.ln(),
        };
        for _ in 0..40 {
            let (mut apart, mut weight, mut square, mut ln) = (0.0, 0.0, 0.0, 0.0);
            for d in lengths {
                let (bulk, outlier) = mixture.densities(*d);
                let own = outlier / (bulk + outlier).max(f64::MIN_POSITIVE);
                apart += own;
                let z = (d / mixture.scale).powi(2);
                // The t distribution as a mixture of Gaussians: each sample's own weight.
                let w = (1.0 - own) * (nu + k) / (nu + z);
                weight += 1.0 - own;
                square += w * d * d;
                ln += (bulk + outlier).max(f64::MIN_POSITIVE).ln();
            }
            let n = lengths.len() as f64;
            let before = mixture.ln_likelihood;
            mixture.share = (apart / n).clamp(LEAST_SHARE, MOST_SHARE);
            mixture.scale = (square / (k * weight.max(1.0))).sqrt().max(f64::EPSILON);
            mixture.ln_likelihood = ln;
            if (ln - before).abs() < rounding::WRITTEN * n {
                break;
            }
        }
        mixture
    }

    /// Both parts of the density of a length.
    fn densities(&self, d: f64) -> (f64, f64) {
        let (k, nu) = (self.k, self.nu);
        let [of_k, of_nu, of_both] = self.ln_gammas;
        let z = (d / self.scale).max(f64::EPSILON);
        let ln = if nu >= TAILS[TAILS.len() - 1] {
            (k - 1.0) * z.ln() - 0.5 * z * z - (0.5 * k - 1.0) * std::f64::consts::LN_2 - of_k
        } else {
            std::f64::consts::LN_2 + (k - 1.0) * z.ln() + of_both
                - of_k
                - of_nu
                - 0.5 * k * self.ln_nu
                - 0.5 * (nu + k) * (z * z / nu).ln_1p()
        };
        let bulk = (1.0 - self.share) * ln.exp() / self.scale;
        let outlier = if z > FROM {
            self.share / (d * (TO / FROM).ln())
        } else {
            0.0
        };
        (bulk, outlier)
    }

    /// The length from which on the odds are [`ODDS`].
    fn limit(&self) -> f64 {
        let odds = |z: f64| {
            let (bulk, outlier) = self.densities(z * self.scale);
            outlier > ODDS * bulk
        };
        let (mut low, mut high) = (FROM, 1e3);
        if !odds(high) {
            return high * self.scale;
        }
        for _ in 0..50 {
            let middle = (low * high).sqrt();
            if odds(middle) {
                high = middle;
            } else {
                low = middle;
            }
        }
        high * self.scale
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::SeedableRng;
    use rand_chacha::ChaCha8Rng;
    use rand_distr::{Distribution, StandardNormal, StudentT};

    /// Three axes of unequal noise, a share of outliers of 7 to 20 σ in a random direction.
    fn sample(
        random: &mut ChaCha8Rng,
        n: usize,
        share: f64,
        tails: bool,
    ) -> (Vec<Vec<f64>>, Vec<bool>) {
        let mut e = vec![vec![0.0; n]; 3];
        let mut bad = vec![false; n];
        let t = StudentT::new(4.0).unwrap();
        for i in 0..n {
            let mut draw = || -> f64 { StandardNormal.sample(random) };
            let direction = [draw(), draw(), draw()];
            let norm = direction.iter().map(|v| v * v).sum::<f64>().sqrt();
            bad[i] = (i as f64 + 0.5) % (1.0 / share) < 1.0;
            let far = 7.0 + 13.0 * (i as f64 * 0.618).fract();
            for a in 0..3 {
                let s = [0.5, 1.0, 1.33][a];
                let own: f64 = if tails {
                    t.sample(random) / 2.0_f64.sqrt()
                } else {
                    StandardNormal.sample(random)
                };
                e[a][i] = s * own
                    + if bad[i] {
                        s * far * direction[a] / norm
                    } else {
                        0.0
                    };
            }
        }
        (e, bad)
    }

    /// A fit that goes through some of the samples has large residuals at all others: these are no outliers of it.
    #[test]
    fn more_than_a_third_of_a_session_is_not_suspected_and_a_quarter_is() {
        for (apart, is_suspected) in [(12, false), (7, true)] {
            let far = |i: usize| i % 28 < apart;
            let own = |i: usize, step: f64| {
                ((i as f64 * step).fract() - 0.5) * if far(i) { 0.3 } else { 0.002 }
            };
            let e: Vec<Vec<f64>> = [0.618, 0.755, 0.57]
                .map(|step| (0..28).map(|i| own(i, step)).collect())
                .to_vec();
            let axes: Vec<&[f64]> = e.iter().map(Vec::as_slice).collect();
            let marked = suspected(&axes, &[true; 28], &[1.0; 3], false);
            let marked = marked.iter().filter(|marked| **marked).count();
            assert_eq!(marked > 0, is_suspected, "{marked} of 28");
        }
    }

    #[test]
    fn gross_outliers_are_caught_and_good_samples_are_not_accused() {
        for (tails, least, most) in [(false, 0.97, 0.004), (true, 0.0, 0.008)] {
            let mut random = ChaCha8Rng::seed_from_u64(5);
            let (mut caught, mut of, mut accused, mut good) = (0, 0, 0, 0);
            for k in 0..60 {
                let share = [0.02, 0.05, 0.15][k % 3];
                let (e, bad) = sample(&mut random, 120, share, tails);
                let axes: Vec<&[f64]> = e.iter().map(|a| &a[..]).collect();
                let marked = suspected(&axes, &[true; 120], &[1.0; 3], true);
                for (marked, bad) in marked.iter().zip(&bad) {
                    of += usize::from(*bad);
                    good += usize::from(!*bad);
                    caught += usize::from(*bad && *marked);
                    accused += usize::from(!*bad && *marked);
                }
            }
            let caught = caught as f64 / of as f64;
            let accused = accused as f64 / good as f64;
            assert!(
                caught >= least && accused <= most,
                "{tails}: {caught} {accused}"
            );
        }
    }
}
