//! Orders of gears in what is left: a periodogram over each joint along its motion. Strain-wave gears
//! have orders of hundreds of cycles per turn.

use std::borrow::Cow;

use nalgebra::{DMatrix, DVector};

use crate::kinematics::{JointKind, Robot};

/// Orders that are looked at, cycles per turn.
const FROM: f64 = 7.0;
const TO: f64 = 420.0;
/// Steps within the resolution of the range.
const STEPS: f64 = 4.0;
/// With fewer different values of a joint one order looks like another.
const FEWEST_VALUES: usize = 60;
/// ln of the odds beyond the number of orders that are looked at.
const LIKELIER: f64 = 7.0;

/// What is left, whitened, and what a turn of each joint does to it.
pub(super) struct Residual<'r> {
    pub(super) robot: &'r Robot,
    pub(super) q: &'r [Cow<'static, [f64]>],
    /// A column for each joint.
    pub(super) units: &'r DMatrix<f64>,
    pub(super) left: &'r DVector<f64>,
    /// Of a row.
    pub(super) variance: f64,
}

/// The joint and the order that explain most, where that is beyond noise.
pub(super) fn strongest(residual: &Residual) -> Option<(usize, f64)> {
    let mut best: Option<(usize, f64, f64)> = None;
    let mut tried = 0.0;
    for (joint, own) in residual.robot.joints.iter().enumerate() {
        let q = &residual.q[joint];
        if own.kind != JointKind::Revolute || different(q) < FEWEST_VALUES {
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
    (0.5 * gain / residual.variance > f64::ln(tried.max(1.0)) + LIKELIER).then_some((joint, order))
}

fn different(q: &[f64]) -> usize {
    let mut sorted = q.to_vec();
    sorted.sort_by(f64::total_cmp);
    sorted.dedup_by(|a, b| (*a - *b).abs() < 1e-6);
    sorted.len()
}

/// Of each sample: a turn's product with what is left, and with itself.
struct Sums {
    with_left: Vec<f64>,
    with_itself: Vec<f64>,
}

impl Sums {
    fn of(residual: &Residual, joint: usize) -> Self {
        let n = residual.q[joint].len();
        let (mut with_left, mut with_itself) = (vec![0.0; n], vec![0.0; n]);
        for (row, unit) in residual.units.column(joint).iter().enumerate() {
            with_left[row % n] += unit * residual.left[row];
            with_itself[row % n] += unit * unit;
        }
        Self {
            with_left,
            with_itself,
        }
    }

    /// By how much these sines and cosines lower the sum of squares.
    fn gain(&self, sin: &[f64], cos: &[f64]) -> f64 {
        let mut sums = [[0.0; LANES]; 5];
        let pad = |all: &[f64]| -> [f64; LANES] {
            std::array::from_fn(|k| all.get(k).copied().unwrap_or(0.0))
        };
        let chunks = (self.with_left.chunks(LANES)).zip(self.with_itself.chunks(LANES));
        let waves = sin.chunks(LANES).zip(cos.chunks(LANES));
        for ((left, own), (sin, cos)) in chunks.zip(waves) {
            let (left, own, sin, cos) = (pad(left), pad(own), pad(sin), pad(cos));
            for k in 0..LANES {
                let (s, c) = (sin[k], cos[k]);
                sums[0][k] += left[k] * s;
                sums[1][k] += left[k] * c;
                sums[2][k] += own[k] * s * s;
                sums[3][k] += own[k] * s * c;
                sums[4][k] += own[k] * c * c;
            }
        }
        let [a, b, aa, ab, bb] = sums.map(|lanes| lanes.iter().sum::<f64>());
        let determinant = aa * bb - ab * ab;
        if determinant <= 1e-6 * aa * bb {
            return 0.0;
        }
        (a * a * bb - 2.0 * a * b * ab + b * b * aa) / determinant
    }
}

/// Sums that run side by side.
const LANES: usize = 8;

/// Sines and cosines of one order after the other, each from the last by a turn.
struct Waves {
    sin: Vec<f64>,
    cos: Vec<f64>,
    turn: Vec<(f64, f64)>,
}

impl Waves {
    fn new(q: &[f64], order: f64, step: f64) -> Self {
        let at = |q: &f64| (order * q).sin_cos();
        let (sin, cos) = q.iter().map(at).unzip();
        let turn = q.iter().map(|q| (step * q).sin_cos()).collect();
        Self { sin, cos, turn }
    }

    fn next(&mut self) {
        let waves = self.sin.iter_mut().zip(&mut self.cos);
        for ((sin, cos), (by_sin, by_cos)) in waves.zip(&self.turn) {
            let (s, c) = (*sin, *cos);
            *sin = s * by_cos + c * by_sin;
            *cos = c * by_cos - s * by_sin;
        }
    }
}
