//! The noise of the instrument.
//!
//! Noise is independent on the three axes, with the same root mean square σ on each:
//!
//! ```text
//! gauss   σ n
//! t4      σ t₄ / √2                       (Student's t with 4 degrees of freedom has variance 2)
//! ar1     eᵢ = ρ eᵢ₋₁ + σ √(1 − ρ²) n,    e₀ = σ n,   ρ = 0.7
//! ```
//!
//! n standard normal. An outlier is moved by its length in a direction that is equally likely
//! everywhere (in the plane for a planar session), besides the noise. Last, coordinates are rounded
//! to the instrument's resolution.

use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal, StudentT, UnitCircle, UnitSphere};

use super::random::{Stream, random};
use super::scenario::{Noise, NoiseKind, Scenario};
use crate::model::Positions;
use crate::rounding;

/// Correlation of neighbours in [`NoiseKind::Ar1`].
pub(crate) const CORRELATION: f64 = 0.7;

/// The points as the instrument sees them, and which of them are outliers, counted from 0.
pub(crate) fn measured(
    scenario: &Scenario,
    exact: &Positions,
    seed: u64,
) -> (Positions, Vec<usize>) {
    let mut measured = exact.clone();
    let n = measured.x_mm.len();
    if let Some(noise) = scenario.noise {
        let mut draw = Draw::new(noise, random(seed, Stream::Noise));
        for i in 0..n {
            let [x, y, z] = draw.next();
            measured.x_mm[i] += x;
            measured.y_mm[i] += y;
            measured.z_mm[i] += z;
        }
    }
    let mut which = Vec::new();
    if let Some(outliers) = scenario.outliers {
        let mut random = random(seed, Stream::Outliers);
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a share between 0 and 1 of the samples"
        )]
        let count = (outliers.share * n as f64).round() as usize;
        which = (0..n).collect();
        which.shuffle(&mut random);
        which.truncate(count);
        which.sort_unstable();
        for i in &which {
            let [x, y, z] = direction(scenario.planar, &mut random);
            measured.x_mm[*i] += outliers.mm * x;
            measured.y_mm[*i] += outliers.mm * y;
            measured.z_mm[*i] += outliers.mm * z;
        }
    }
    (measured, which)
}

fn direction(planar: bool, random: &mut ChaCha8Rng) -> [f64; 3] {
    if planar {
        let [x, y]: [f64; 2] = UnitCircle.sample(random);
        [x, y, 0.0]
    } else {
        UnitSphere.sample(random)
    }
}

/// Rounds to multiples of a resolution.
pub(crate) fn resolved(resolution_mm: Option<f64>, mut points: Positions) -> Positions {
    if let Some(resolution) = resolution_mm {
        // Division by a whole number of steps per mm keeps the decimals short: 0.1 stays 0.1.
        let per_mm = (1.0 / resolution).round();
        let whole = (per_mm * resolution - 1.0).abs() < rounding::COMPUTED && per_mm >= 1.0;
        let round = |v: &mut f64| {
            *v = if whole {
                (*v * per_mm).round() / per_mm
            } else {
                (*v / resolution).round() * resolution
            } + 0.0;
        };
        points.x_mm.iter_mut().for_each(round);
        points.y_mm.iter_mut().for_each(round);
        points.z_mm.iter_mut().for_each(round);
    }
    points
}

struct Draw {
    noise: Noise,
    random: ChaCha8Rng,
    heavy: StudentT<f64>,
    before: Option<[f64; 3]>,
}

impl Draw {
    fn new(noise: Noise, random: ChaCha8Rng) -> Self {
        Self {
            noise,
            random,
            heavy: StudentT::new(4.0).expect("four degrees of freedom are allowed"),
            before: None,
        }
    }

    fn next(&mut self) -> [f64; 3] {
        let sigma = self.noise.sigma_mm;
        let kind = self.noise.kind;
        let fresh: [f64; 3] = std::array::from_fn(|_| match kind {
            NoiseKind::T4 => self.heavy.sample(&mut self.random) / std::f64::consts::SQRT_2,
            NoiseKind::Gauss | NoiseKind::Ar1 => StandardNormal.sample(&mut self.random),
        });
        let unit = match (kind, self.before) {
            (NoiseKind::Ar1, Some(before)) => std::array::from_fn(|axis| {
                CORRELATION * before[axis] + (1.0 - CORRELATION * CORRELATION).sqrt() * fresh[axis]
            }),
            _ => fresh,
        };
        self.before = Some(unit);
        unit.map(|v| sigma * v)
    }
}
