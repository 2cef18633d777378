//! Orders of gears in the residuals: a periodogram over each joint along its motion. Strain-wave gears have orders of
//! hundreds of cycles per turn.

use std::borrow::Cow;

use nalgebra::{DMatrix, DVector};

use crate::kinematics::{JointKind, Robot};
use crate::lanes::TOGETHER;
use crate::wide::{Loop, wide};
use crate::{fewest, odds, rounding};

/// Orders that are searched, cycles per turn.
const FROM: f64 = 7.0;
const TO: f64 = 420.0;
/// Steps within the resolution of the range.
const STEPS: f64 = 4.0;

/// The residuals, whitened, and the derivative of the rows with respect to each joint.
pub(super) struct Residual<'r> {
    pub(super) robot: &'r Robot,
    pub(super) q: &'r [Cow<'static, [f64]>],
    /// A column for each joint.
    pub(super) units: &'r DMatrix<f64>,
    pub(super) values: &'r DVector<f64>,
    /// Of a row.
    pub(super) variance: f64,
}

/// The joint and the order that explain most, where that exceeds noise.
pub(super) fn strongest(residual: &Residual) -> Option<(usize, f64)> {
    let mut best: Option<(usize, f64, f64)> = None;
    let mut tried = 0.0;
    for (joint, own) in residual.robot.joints.iter().enumerate() {
        let q = &residual.q[joint];
        if own.kind != JointKind::Revolute || different(q) < fewest::TO_SCAN {
            continue;
        }
        let sums = Sums::of(residual, joint);
        let low = q.iter().copied().fold(f64::INFINITY, f64::min);
        let high = q.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let step = std::f64::consts::TAU / (high - low) / STEPS;
        let count = ((TO - FROM) / step).ceil().clamp(1.0, 4000.0);
        tried += count / STEPS;
        let mut peak = (0.0, 0.0);
        let mut waves = Waves::new(q, FROM, step);
        for k in 0..count as usize {
            let gain = sums.gain(&waves.sin, &waves.cos);
            if gain > peak.1 {
                peak = (FROM + k as f64 * step, gain);
            }
            waves.next();
        }
        let mut by = 0.5 * step;
        for _ in 0..5 {
            for order in [peak.0 - by, peak.0 + by] {
                let waves = Waves::new(q, order, 0.0);
                let gain = sums.gain(&waves.sin, &waves.cos);
                if gain > peak.1 {
                    peak = (order, gain);
                }
            }
            by *= 0.5;
        }
        if best.is_none_or(|b| peak.1 > b.2) {
            best = Some((joint, peak.0, peak.1));
        }
    }
    let (joint, order, gain) = best?;
    (0.5 * gain / residual.variance > f64::ln(tried.max(1.0)) + odds::CLEAR.nats())
        .then_some((joint, order))
}

fn different(q: &[f64]) -> usize {
    let mut sorted = q.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.dedup_by(|a, b| (*a - *b).abs() < rounding::WRITTEN);
    sorted.len()
}

/// Of each sample: the product of a joint's column with the residuals, and with itself.
struct Sums {
    with_residual: Vec<f64>,
    with_itself: Vec<f64>,
}

impl Sums {
    fn of(residual: &Residual, joint: usize) -> Self {
        let n = residual.q[joint].len();
        let (mut with_residual, mut with_itself) = (vec![0.0; n], vec![0.0; n]);
        for (row, unit) in residual.units.column(joint).iter().enumerate() {
            with_residual[row % n] += unit * residual.values[row];
            with_itself[row % n] += unit * unit;
        }
        Self {
            with_residual,
            with_itself,
        }
    }

    /// By how much these sines and cosines lower the sum of squares.
    fn gain(&self, sin: &[f64], cos: &[f64]) -> f64 {
        let sums = wide(Summing {
            sums: self,
            sin,
            cos,
        });
        let [a, b, aa, ab, bb] = sums.map(|lanes| lanes.iter().sum::<f64>());
        let determinant = aa * bb - ab * ab;
        if determinant <= rounding::WRITTEN * aa * bb {
            return 0.0;
        }
        (a * a * bb - 2.0 * a * b * ab + b * b * aa) / determinant
    }
}

/// The products of a wave with the residuals and with itself.
struct Summing<'s> {
    sums: &'s Sums,
    sin: &'s [f64],
    cos: &'s [f64],
}

impl Loop for Summing<'_> {
    type Output = [[f64; TOGETHER]; 5];

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "see Loop")]
    fn run(self) -> [[f64; TOGETHER]; 5] {
        let (values, own) = (&self.sums.with_residual, &self.sums.with_itself);
        let n = values.len().min(self.sin.len());
        let mut sums = [[0.0; TOGETHER]; 5];
        let mut at = 0;
        while at + TOGETHER <= n {
            let some = at..at + TOGETHER;
            let waves = [&self.sin[some.clone()], &self.cos[some.clone()]];
            sums = with_waves(sums, [&values[some.clone()], &own[some]], waves);
            at += TOGETHER;
        }
        if at < n {
            let pad = |all: &[f64]| -> [f64; TOGETHER] {
                std::array::from_fn(|k| all.get(at + k).copied().unwrap_or(0.0))
            };
            let waves = [&pad(self.sin)[..], &pad(self.cos)];
            sums = with_waves(sums, [&pad(values), &pad(own)], waves);
        }
        sums
    }
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "see Loop")]
fn with_waves(
    [a, b, aa, ab, bb]: [[f64; TOGETHER]; 5],
    [values, own]: [&[f64]; 2],
    [s, c]: [&[f64]; 2],
) -> [[f64; TOGETHER]; 5] {
    [
        std::array::from_fn(|k| a[k] + values[k] * s[k]),
        std::array::from_fn(|k| b[k] + values[k] * c[k]),
        std::array::from_fn(|k| aa[k] + own[k] * s[k] * s[k]),
        std::array::from_fn(|k| ab[k] + own[k] * s[k] * c[k]),
        std::array::from_fn(|k| bb[k] + own[k] * c[k] * c[k]),
    ]
}

/// Sines and cosines of one order after the other, each from the last by a turn.
struct Waves {
    sin: Vec<f64>,
    cos: Vec<f64>,
    by_sin: Vec<f64>,
    by_cos: Vec<f64>,
}

impl Waves {
    fn new(q: &[f64], order: f64, step: f64) -> Self {
        let of = |order: f64| q.iter().map(|q| (order * q).sin_cos()).unzip();
        let (sin, cos) = of(order);
        let (by_sin, by_cos) = of(step);
        Self {
            sin,
            cos,
            by_sin,
            by_cos,
        }
    }

    fn next(&mut self) {
        wide(Turning { waves: self });
    }
}

struct Turning<'w> {
    waves: &'w mut Waves,
}

impl Loop for Turning<'_> {
    type Output = ();

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "see Loop")]
    fn run(self) {
        let Waves {
            sin,
            cos,
            by_sin,
            by_cos,
        } = self.waves;
        let waves = sin.iter_mut().zip(cos);
        for ((sin, cos), (by_sin, by_cos)) in waves.zip(by_sin.iter().zip(by_cos.iter())) {
            let (s, c) = (*sin, *cos);
            *sin = s * by_cos + c * by_sin;
            *cos = c * by_cos - s * by_sin;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn waves_and_their_sums_have_the_same_bits_in_wide_vectors() {
        for n in [3, 8, 61] {
            let wild = |k: usize| (0..n).map(move |i| ((i * 7 + k * 13) as f64 * 0.37).sin());
            let q: Vec<f64> = wild(0).collect();
            let sums = &Sums {
                with_residual: wild(1).collect(),
                with_itself: wild(2).map(f64::abs).collect(),
            };
            let mut waves = Waves::new(&q, 7.0, 0.3);
            let mut narrow = Waves::new(&q, 7.0, 0.3);
            waves.next();
            Turning { waves: &mut narrow }.run();
            assert_eq!((&waves.sin, &waves.cos), (&narrow.sin, &narrow.cos));
            let apart = waves.sin.iter().zip(&q);
            let apart = apart.map(|(sin, q)| (sin - (7.3 * q).sin()).abs());
            assert!(apart.fold(0.0, f64::max) < 1e-12);
            let (sin, cos) = (&waves.sin[..], &waves.cos[..]);
            let all = wide(Summing { sums, sin, cos });
            assert_eq!(all, Summing { sums, sin, cos }.run());
            let one: f64 = (0..n).map(|k| sums.with_residual[k] * sin[k]).sum();
            assert!((all[0].iter().sum::<f64>() - one).abs() < 1e-12);
        }
    }
}
