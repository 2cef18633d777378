//! The noise of a measurement in three layers: white along each axis (the instrument), repeatability, which all rows
//! of a pose share (`joints`), and a part that varies slowly in time (a tripod that settles, air, a tracker that warms
//! up).
//!
//! ```text
//! y_a(t_k) = model + w_a(t_k) + ε_k,   ε ~ N(0, σ_a²),   E w_a(t) w_a(u) = s_a² exp(−|t − u|/τ)
//! ```
//!
//! The slow part is an Ornstein–Uhlenbeck process (a Matérn process of order ½), whose
//! state-space form makes a Kalman filter whiten any column at a cost linear in the number of
//! samples (Hartikainen & Särkkä 2010):
//!
//! ```text
//! a = exp(−Δt/τ),   P⁻ = a² P + s² (1 − a²),   S = P⁻ + σ²,   K = P⁻/S,
//! v = y − a m,      m ← a m + K v,             P = (1 − K) P⁻,  whitened = v/√S
//! ```
//!
//! A pause counts as long as it took, and where the clock jumps back (a restart) the process begins again. Without a
//! clock samples are taken as one unit of time apart.
//!
//! σ, s and τ are those of the largest restricted likelihood given the columns of a fit (Patterson & Thompson 1971):
//! restricted, so that the degrees of freedom of the fit do not count for the noise.

use nalgebra::{DMatrix, DVector};

use crate::sessions::Sigma;
use crate::{fewest, odds, rounding};

use super::regression::Rows;
use filter::{Axis, steps};
use restricted::{NoiseShape, Restricted};

mod filter;
pub(crate) mod joints;
mod restricted;
mod slow_part;

pub use crate::answers::noise::Noise;
use crate::answers::noise::Trial;
pub(crate) use crate::answers::noise::{Slow, StatedNoise};
pub(crate) use filter::{Filter, Step};
use joints::JointFilter;
pub(crate) use joints::decayed;

/// Twice the logarithm of a likelihood ratio (two degrees of freedom) from which on the axes
/// differ: p < 0.0004.
/// Weights are then not by chance.
const UNEQUAL_EVIDENCE: f64 = 16.0;
/// Twice the logarithm of the likelihood ratio from which on a slow part is there. A time constant
/// and a size for each axis on the boundary of their range: white noise exceeds it in about one
/// session of a hundred (`hidden_effects noise`).
/// 0 of 40 sessions of white noise of `hidden_effects slow` exceed it.
const SLOW_EVIDENCE: f64 = 12.0;

/// Estimates from a few hundred samples differ by this: of the slow part and of repeatability …
const ALIKE: f64 = 0.1;
/// … of time constants, as logarithms …
const ALIKE_TIMES: f64 = 0.5;
/// … and of the sizes of the axes, which all samples determine.
const ALIKE_SIZES: f64 = 0.05;
/// Ratios of axes beyond this are something that the model lacks, not noise.
const MOST_UNEQUAL: f64 = 10.0;
/// Variances of what the joints do not repeat that are tried, in units of the white part's.
const SHARES: [f64; 6] = [0.1, 1.0, 10.0, 100.0, 1e3, 1e4];
/// Factors of the search around the likeliest: each about the square root of the one before it.
const CLOSER_SHARES: [f64; 4] = [3.2, 1.8, 1.3, 1.15];
/// The penalty of a slow part for each of its parameters (a time constant and a size for each axis), as a logarithm:
/// each is known to about a factor of two within a range of some hundred to one:
/// ln(4.6/(0.7 √(2π))) ≈ 1. (Laplace's ½ ln m is that of a mean over all rows, which a variance of a
/// few slow swings is not.)
/// Without it sizes by axis follow chance, and intervals in sweeps held in 89 instead of 92 %.
pub(crate) const PRICE_OF_A_VARIANCE: f64 = 1.0;

/// The least of the white part together with repeatability, mm. Where every row has a pose of its own the joints could
/// explain all of it: then it is at least what is stated of the instrument.
fn least_white_mm(stated: Option<Sigma>, rows: &Rows) -> f64 {
    match stated {
        Some(sigma) if rows.inputs.pose.is_none() => {
            let mut noise = Noise::white(0.0);
            noise.sigma_mm = match sigma {
                Sigma::Overall(sigma) => [sigma; 3],
                Sigma::PerAxis(each) => each,
            };
            noise.total_mm(&rows.axes)
        }
        _ => 0.0,
    }
}

/// Whether a slow part is there.
fn is_slow(trial: &Trial, white: f64) -> bool {
    2.0 * (trial.0 - white) > SLOW_EVIDENCE
}

impl Noise {
    /// From raw residuals and the columns of the fit that they belong to.
    pub fn estimate(
        stated: Option<Sigma>,
        rows: &Rows,
        residual: &DVector<f64>,
        columns: &DMatrix<f64>,
    ) -> Self {
        Self::likeliest(stated, rows, (residual, columns), false, true)
    }

    /// The same with its alternatives, for intervals: a search does without.
    pub fn estimate_with_alternatives(
        stated: Option<Sigma>,
        rows: &Rows,
        residual: &DVector<f64>,
        columns: &DMatrix<f64>,
    ) -> Self {
        Self::likeliest(stated, rows, (residual, columns), true, true)
    }

    fn likeliest(
        stated: Option<Sigma>,
        rows: &Rows,
        (residual, columns): (&DVector<f64>, &DMatrix<f64>),
        with_alternatives: bool,
        may_not_repeat: bool,
    ) -> Self {
        let mut noise = Self::white(1.0);
        if let Some(Sigma::PerAxis(sigma)) = stated {
            noise.sigma_mm = sigma;
            noise.unequal = true;
        }
        if rows.is_empty() {
            return noise;
        }
        let restricted = Restricted::new(rows, residual, columns);
        let least_mm = least_white_mm(stated, rows);
        let mut slow = NoiseShape::white(noise.sigma_mm);
        let enough = rows.samples.len() >= fewest::TO_SEARCH;
        if enough {
            let mut alike = noise.clone();
            noise.balance_axes(&restricted, slow);
            let white = restricted.likelihood(NoiseShape::white(noise.sigma_mm));
            if may_not_repeat
                && let Some((joints_rad, _)) = alike.unrepeated(&restricted, slow, white, least_mm)
            {
                // An error of the joints makes the axes look unequal as well.
                (alike.joints_rad, slow.joints_rad) = (joints_rad, joints_rad);
                noise = alike.clone();
                noise.balance_axes(&restricted, slow);
            }
            let white = restricted.likelihood(NoiseShape {
                sigma: noise.sigma_mm,
                ..slow
            });
            let mut best = noise.slowest(&restricted, white);
            // What wanders along some axes only makes them look unequal as well.
            if noise.unequal && !alike.unequal {
                let other = alike.slowest(&restricted, white);
                let better = |trial: &Trial| best.is_none_or(|b| trial.0 > b.0);
                if let Some(other) = other.filter(|t| is_slow(t, white) && better(t)) {
                    (noise, best) = (alike, Some(other));
                }
            }
            let wanders = best.is_some_and(|b| is_slow(&b, white));
            if noise.joints_rad > 0.0
                && wanders
                && let Some((_, tau, ratio)) = best
            {
                // What wanders is the same in the rows of a pose as well.
                let sigma = noise.sigma_mm;
                let shape = NoiseShape {
                    tau,
                    ratio,
                    sigma,
                    joints_rad: 0.0,
                };
                let alone = restricted.likelihood(shape);
                let Some((joints_rad, likelihood)) =
                    noise.unrepeated(&restricted, shape, alone, least_mm)
                else {
                    return Self::likeliest(
                        stated,
                        rows,
                        (residual, columns),
                        with_alternatives,
                        false,
                    );
                };
                noise.joints_rad = joints_rad;
                slow.joints_rad = joints_rad;
                best = Some((likelihood, tau, ratio));
            }
            if with_alternatives {
                noise.alternatives = noise.alternatives(&restricted, white, best);
            }
            if let Some((likelihood, tau, ratio)) = best {
                noise.slow_evidence = 2.0 * (likelihood - white);
                if noise.slow_evidence > SLOW_EVIDENCE {
                    slow = NoiseShape {
                        tau,
                        ratio,
                        sigma: noise.sigma_mm,
                        joints_rad: noise.joints_rad,
                    };
                    noise.balance_axes(&restricted, slow);
                    let rms = |a: usize| ratio[a].sqrt() * noise.sigma_mm[a];
                    noise.slow = Some(Slow {
                        rms_mm: [rms(0), rms(1), rms(2)],
                        time_constant_s: tau,
                    });
                }
            }
        }
        let sigma = noise.sigma_mm;
        let scale = restricted
            .scale(NoiseShape { sigma, ..slow })
            .max(rounding::WRITTEN);
        // What was rounded away is noise, whatever the residuals of few digits look like.
        noise.scaled(scale).at_least(rows.digits_mm)
    }

    /// Repeatability given a noise of so much likelihood, and the likelihood with it; `None` where the rows show none
    /// of it. The white part stays as large as `least_mm`.
    fn unrepeated(
        &self,
        restricted: &Restricted,
        shape: NoiseShape,
        without: f64,
        least_mm: f64,
    ) -> Option<(f64, f64)> {
        let unit = self.total_mm(&restricted.axes) / restricted.lever_mm()?;
        let at = |ratio: f64| {
            let joints_rad = unit * ratio.sqrt();
            let shape = NoiseShape {
                joints_rad,
                ..shape
            };
            let (likelihood, scale) = restricted.likelihood_and_scale(shape);
            let possible = scale * self.total_mm(&restricted.axes) >= least_mm;
            (
                ratio,
                if possible {
                    likelihood
                } else {
                    f64::NEG_INFINITY
                },
            )
        };
        let better = |a: (f64, f64), b: (f64, f64)| if b.1 > a.1 { b } else { a };
        let mut best = better(at(SHARES[0]), at(SHARES[1]));
        if best.1 <= without {
            return None;
        }
        for share in &SHARES[2..] {
            best = better(best, at(*share));
        }
        for factor in CLOSER_SHARES {
            best = better(better(best, at(best.0 * factor)), at(best.0 / factor));
        }
        (2.0 * (best.1 - without) > odds::LIKELY.chi_square())
            .then(|| (unit * best.0.sqrt(), best.1))
    }

    /// Sizes of the axes relative to each other, where they clearly differ given a slow part.
    fn balance_axes(&mut self, restricted: &Restricted, slow: NoiseShape) {
        let mut stated = self.unequal;
        for _ in 0..2 {
            let sigma = self.sigma_mm;
            let spread = restricted.spread(NoiseShape { sigma, ..slow });
            let freedom: f64 = spread.iter().map(|s| s.1).sum();
            let pooled = spread.iter().map(|s| s.0 * s.1).sum::<f64>() / freedom.max(1.0);
            if pooled.sqrt() < rounding::WRITTEN {
                return;
            }
            let ratio = |s: f64| (s / pooled).max(rounding::WRITTEN);
            let evidence: f64 = spread.iter().map(|s| -s.1 * ratio(s.0).ln()).sum();
            if stated || !self.unequal && evidence < UNEQUAL_EVIDENCE {
                return;
            }
            stated = false;
            self.unequal = true;
            for (axis, s) in restricted.axes.iter().zip(&spread) {
                self.sigma_mm[*axis] *= ratio(s.0).sqrt();
            }
            let largest = self.sigma_mm.iter().copied().fold(0.0, f64::max);
            self.sigma_mm = self.sigma_mm.map(|s| s.max(largest / MOST_UNEQUAL));
        }
    }

    /// The alternative noises that the residuals allow, with their weights; intervals are averaged over them. The
    /// first is this one where it is the only one.
    pub(crate) fn possible(&self) -> Vec<(f64, Self)> {
        let one = |(share, tau, ratio): &(f64, f64, [f64; 3])| {
            let rms = |axis: usize| ratio[axis].sqrt() * self.sigma_mm[axis];
            let slow = (ratio.iter().any(|r| *r > 0.0)).then(|| Slow {
                rms_mm: [rms(0), rms(1), rms(2)],
                time_constant_s: *tau,
            });
            let noise = Self {
                slow,
                alternatives: Vec::new(),
                ..self.clone()
            };
            (*share, noise)
        };
        self.alternatives.iter().map(one).collect()
    }

    /// The filter that whitens rows.
    pub fn filter(&self, rows: &Rows) -> Filter {
        let moves = rows.moves().filter(|_| self.joints_rad > 0.0);
        Filter {
            joints: moves.map(|moves| JointFilter::new(self, &rows.times, &rows.axes, moves)),
            ..self.filter_over(&rows.times, &rows.axes)
        }
    }

    /// The filter for samples at these times.
    pub fn filter_over(&self, times: &[f64], axes: &[usize]) -> Filter {
        let one = |axis: &usize| match self.slow {
            Some(slow) if slow.rms_mm[*axis] > 0.0 => {
                let sigma = self.sigma_mm[*axis];
                Axis::Slow(steps(
                    times,
                    slow.time_constant_s,
                    sigma,
                    slow.rms_mm[*axis],
                ))
            }
            _ => Axis::White(1.0 / self.sigma_mm[*axis]),
        };
        Filter {
            axes: axes.iter().map(one).collect(),
            samples: times.len(),
            joints: None,
        }
    }

    /// Whitened columns.
    pub fn whitened(&self, rows: &Rows, raw: &DMatrix<f64>) -> DMatrix<f64> {
        let mut white = raw.clone();
        self.filter(rows).whiten(white.as_mut_slice());
        white
    }

    /// A whitened vector.
    pub fn whitened_vector(&self, rows: &Rows, raw: &DVector<f64>) -> DVector<f64> {
        let mut white = raw.clone();
        self.filter(rows).whiten(white.as_mut_slice());
        white
    }

    /// Whether two estimates whiten alike, within what estimates from a few hundred samples differ.
    pub fn whitens_like(&self, other: &Self) -> bool {
        let share = |n: &Self| n.correlation(0.0);
        let time = |n: &Self| n.slow.map_or(0.0, |s| s.time_constant_s.ln());
        let size = |n: &Self, axis: usize| {
            let total = n.total_mm(&[0, 1, 2]).max(rounding::WRITTEN);
            (n.sigma_mm[axis] / total).max(rounding::WRITTEN).ln()
        };
        let joints = |n: &Self| n.joints_rad.max(f64::MIN_POSITIVE).ln();
        self.slow.is_some() == other.slow.is_some()
            && (joints(self) - joints(other)).abs() < ALIKE
            && (share(self) - share(other)).abs() < ALIKE
            && (time(self) - time(other)).abs() < ALIKE_TIMES
            && (0..3).all(|axis| (size(self, axis) - size(other, axis)).abs() < ALIKE_SIZES)
    }
}
