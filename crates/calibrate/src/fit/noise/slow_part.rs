//! The likeliest slow part, and its alternatives: the likelihood over time constants and variances, on a grid and
//! refined around its maximum.

use super::restricted::{NoiseShape, Restricted};
use super::{Noise, PRICE_OF_A_VARIANCE};
use crate::answers::noise::Trial;

/// Variances of the slow part that are tried first, in units of the white part's.
const RATIOS: [f64; 4] = [0.1, 0.6, 4.0, 60.0];
/// The largest: the white part is then a thousandth.
const MOST_RATIO: f64 = 1e3;
/// Factors of the search around the likeliest.
const CLOSER: [f64; 3] = [2.0, 1.4, 1.2];
/// Cells that share the probability, at least, if they are to be small enough …
/// With fewer, cells are wider than the resolution of the residuals; all others are kept, as the tail towards a large
/// slow part is what widens an interval.
const FEWEST_CELLS: f64 = 6.0;
/// … for which the largest are divided so many times at most.
const DIVISIONS: usize = 6;
/// A cell with less of the probability is not divided.
const WORTH_DIVIDING: f64 = 0.02;
/// So many alternatives represent all: more cost more than they add.
const MOST_ALTERNATIVES: usize = 12;

impl Noise {
    /// Likelihood, time constant and variance ratios of the likeliest slow part; `None` where white
    /// noise is clearly likelier.
    pub(super) fn slowest(&self, restricted: &Restricted, white: f64) -> Option<Trial> {
        let mut best: Option<Trial> = None;
        let mut tried: Vec<Trial> = Vec::new();
        let mut keep = |tau: f64, ratio: [f64; 3]| {
            // The ways closer meet again.
            if tried.iter().any(|known| (known.1, known.2) == (tau, ratio)) {
                return (false, best);
            }
            let value = self.likelihood_of(restricted, tau, ratio);
            tried.push((value, tau, ratio));
            let better = value.is_finite() && best.is_none_or(|b| value > b.0);
            if better {
                best = Some((value, tau, ratio));
            }
            (better, best)
        };
        // A first look decides whether to look closer.
        let (shortest, longest) = restricted.times();
        let (times, _) = even(shortest, longest);
        for tau in &times {
            keep(*tau, [RATIOS[1]; 3]);
        }
        let (_, first) = keep(times[0], [RATIOS[2]; 3]);
        if first.is_none_or(|b| b.0 < white - 4.0) {
            return None;
        }
        for tau in &times {
            for ratio in [RATIOS[0], RATIOS[2], RATIOS[3]] {
                keep(*tau, [ratio; 3]);
            }
        }
        let (_, mut now) = keep(times[0], [RATIOS[1]; 3]);
        // The same slow part on all axes first …
        for factor in CLOSER {
            let (_, tau, ratio) = now?;
            for by in [factor, 1.0 / factor] {
                keep((tau * by).clamp(0.5 * shortest, longest), ratio);
            }
            let (_, tau, ratio) = keep(tau, ratio).1?;
            for by in [factor * factor, 1.0 / (factor * factor)] {
                keep(tau, ratio.map(|r| (r * by).min(MOST_RATIO)));
            }
            now = keep(tau, ratio).1;
        }
        // … then axis by axis, which has to pay for the variances.
        let alike = now?;
        for factor in CLOSER {
            let (_, tau, ratio) = now?;
            for by in [factor, 1.0 / factor] {
                keep((tau * by).clamp(0.5 * shortest, longest), ratio);
            }
            let (_, tau, mut ratio) = keep(tau, ratio).1?;
            for axis in &restricted.axes {
                for by in [factor * factor, 1.0 / (factor * factor), 0.0] {
                    let mut trial = ratio;
                    trial[*axis] = (ratio[*axis] * by).clamp(0.0, MOST_RATIO);
                    if let (true, Some(b)) = keep(tau, trial) {
                        ratio = b.2;
                    }
                }
            }
            now = keep(tau, ratio).1;
        }
        let by_axis = now?;
        let price = price_of_shapes(restricted);
        Some(if by_axis.0 > alike.0 + price {
            by_axis
        } else {
            alike
        })
    }

    fn likelihood_of(&self, restricted: &Restricted, tau: f64, ratio: [f64; 3]) -> f64 {
        restricted.likelihood(NoiseShape {
            tau,
            ratio,
            sigma: self.sigma_mm,
            joints_rad: self.joints_rad,
        })
    }

    /// The posterior over cells of ln τ and ln r, even to begin with: white noise against all of them
    /// together at even odds. Where few cells share the probability, as in a long session, these are
    /// divided until enough do; what lies outside of them stays, for the tail towards a large slow
    /// part is what widens an interval.
    pub(super) fn alternatives(
        &self,
        restricted: &Restricted,
        white: f64,
        likeliest: Option<Trial>,
    ) -> Vec<Trial> {
        // All axes alike, or in the proportions of the likeliest slow part.
        let mut shapes = vec![([1.0; 3], 1.0)];
        let clear = likeliest.filter(|b| super::is_slow(b, white));
        if let Some((_, _, ratio)) = clear.filter(|b| b.2.iter().any(|r| *r != b.2[0])) {
            let sum: f64 = restricted.axes.iter().map(|a| ratio[*a]).sum();
            let mean = sum / restricted.axes.len() as f64;
            shapes.push((
                ratio.map(|r| r / mean),
                (-price_of_shapes(restricted)).exp(),
            ));
        }
        let (shortest, longest) = restricted.times();
        let (times, width) = even(shortest, longest);
        let cell = |tau: f64, ratio: f64, shape: [f64; 3], widths: [f64; 2], area: f64| {
            let ratios = shape.map(|s| (s * ratio).min(MOST_RATIO));
            let value = self.likelihood_of(restricted, tau, ratios);
            let ln_mass = if value.is_finite() {
                value + area.ln()
            } else {
                f64::NEG_INFINITY
            };
            Cell {
                tau,
                ratio,
                shape,
                widths,
                area,
                ln_mass,
            }
        };
        let widths = [width, (RATIOS[3] / RATIOS[0]).ln() / 3.0];
        let area = 1.0 / (times.len() * RATIOS.len()) as f64;
        let mut cells = Vec::new();
        for (shape, prior) in shapes {
            for tau in &times {
                cells.extend(RATIOS.map(|ratio| cell(*tau, ratio, shape, widths, prior * area)));
            }
        }
        for _ in 0..DIVISIONS {
            let shares = shares_of(cells.iter().map(|c| c.ln_mass).collect());
            if 1.0 / shares.iter().map(|s| s * s).sum::<f64>() >= FEWEST_CELLS {
                break;
            }
            let mut divided = Vec::new();
            for (whole, share) in cells.iter().zip(shares) {
                if share < WORTH_DIVIDING {
                    divided.push(*whole);
                    continue;
                }
                let half = whole.widths.map(|w| 0.5 * w);
                for (along_tau, along_ratio) in [(-0.5, -0.5), (-0.5, 0.5), (0.5, -0.5), (0.5, 0.5)]
                {
                    let tau = whole.tau * f64::exp(along_tau * half[0]);
                    let ratio = whole.ratio * f64::exp(along_ratio * half[1]);
                    divided.push(cell(
                        tau.min(longest),
                        ratio,
                        whole.shape,
                        half,
                        0.25 * whole.area,
                    ));
                }
            }
            cells = divided;
        }
        let slow = cells.iter().map(|c| {
            (
                c.ln_mass,
                c.tau,
                c.shape.map(|s| (s * c.ratio).min(MOST_RATIO)),
            )
        });
        in_equal_parts([(white, 1.0, [0.0; 3])].into_iter().chain(slow).collect())
    }
}

/// The penalty of slow parts of different sizes along the axes.
fn price_of_shapes(restricted: &Restricted) -> f64 {
    PRICE_OF_A_VARIANCE * (restricted.axes.len() as f64 - 1.0)
}

/// A part of the plane of ln τ and ln r, with what lies in it.
#[derive(Clone, Copy)]
struct Cell {
    tau: f64,
    ratio: f64,
    /// Variances of the slow part of the axes, of mean 1.
    shape: [f64; 3],
    /// In ln τ and ln r.
    widths: [f64; 2],
    /// Its prior probability.
    area: f64,
    ln_mass: f64,
}

/// Times evenly apart in their logarithm, at most by ln 4, and how far.
fn even(shortest: f64, longest: f64) -> (Vec<f64>, f64) {
    let range = (longest / shortest).ln();
    let steps = (range / 4.0_f64.ln()).ceil().max(1.0);
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a small whole number"
    )]
    let steps_whole = steps as usize;
    let times = (0..=steps_whole).map(|k| shortest * (range * k as f64 / steps).exp());
    (times.collect(), range / steps)
}

/// Shares of the whole from logarithms.
fn shares_of(mut all: Vec<f64>) -> Vec<f64> {
    let largest = all.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    for a in &mut all {
        *a = (*a - largest).exp();
    }
    let total: f64 = all.iter().sum();
    for a in &mut all {
        *a /= total;
    }
    all
}

/// Equal shares of the probability, taken in the order of the long-run variance τ·r, which is what
/// widens an interval, so that the tail is there in its proportion. An interval that allows for a slow
/// part that is not there is a little too wide, one that does not is far too narrow
/// (`hidden_effects intervals`).
fn in_equal_parts(mut all: Vec<Trial>) -> Vec<Trial> {
    let shares = shares_of(all.iter().map(|a| a.0).collect());
    for (alternative, share) in all.iter_mut().zip(shares) {
        alternative.0 = share;
    }
    let long_run = |a: &Trial| a.1 * a.2.iter().sum::<f64>();
    all.sort_by(|a, b| long_run(a).total_cmp(&long_run(b)));
    let each = 1.0 / MOST_ALTERNATIVES as f64;
    let mut taken: Vec<Trial> = Vec::new();
    let (mut passed, mut due) = (0.0, 0.5 * each);
    for (share, tau, ratio) in all {
        passed += share;
        let mut own = 0.0;
        while due < passed {
            own += each;
            due += each;
        }
        if own > 0.0 {
            taken.push((own, tau, ratio));
        }
    }
    taken
}
