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
        for k in 0..count as usize {
            let order = FROM + k as f64 * step;
            let gain = sums.gain(q, order);
            if gain > peak.1 {
                peak = (order, gain);
            }
        }
        let mut by = 0.5 * step;
        for _ in 0..5 {
            for order in [peak.0 - by, peak.0 + by] {
                let gain = sums.gain(q, order);
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

    /// By how much a sine and a cosine of this order lower the sum of squares.
    fn gain(&self, q: &[f64], order: f64) -> f64 {
        let (mut a, mut b) = (0.0, 0.0);
        let (mut aa, mut ab, mut bb) = (0.0, 0.0, 0.0);
        for ((q, left), own) in q.iter().zip(&self.with_left).zip(&self.with_itself) {
            let (sin, cos) = (order * q).sin_cos();
            a += left * sin;
            b += left * cos;
            aa += own * sin * sin;
            ab += own * sin * cos;
            bb += own * cos * cos;
        }
        let determinant = aa * bb - ab * ab;
        if determinant <= 1e-6 * aa * bb {
            return 0.0;
        }
        (a * a * bb - 2.0 * a * b * ab + b * b * aa) / determinant
    }
}
