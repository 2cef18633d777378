//! Orders of gears in what is left: a periodogram over each joint along its motion. Strain-wave gears
//! have orders of hundreds of cycles per turn.

use std::borrow::Cow;
use std::f64::consts::TAU;

use nalgebra::{DMatrix, DVector};

use crate::kinematics::{JointKind, Robot};
use crate::numeric::extent;

use super::different;

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
        if own.kind != JointKind::Revolute || different(q).len() < FEWEST_VALUES {
            continue;
        }
        let sums = Sums::of(residual, joint);
        let [low, high] = extent(q.iter());
        let step = TAU / (high - low) / STEPS;
        let count = ((TO - FROM) / step).ceil().clamp(1.0, 4000.0);
        tried += count / STEPS;
        let mut peak = (0.0, 0.0);
        let mut take = |order: f64, gain: f64| {
            if gain > peak.1 {
                peak = (order, gain);
            }
            peak.0
        };
        // Each wave from the last by a turn.
        let mut waves = waves(q, FROM);
        let turns: Vec<[f64; 2]> = self::waves(q, step);
        for k in 0..count as usize {
            take(FROM + k as f64 * step, sums.gain(&waves));
            for ([sin, cos], [by_sin, by_cos]) in waves.iter_mut().zip(&turns) {
                let (s, c) = (*sin, *cos);
                *sin = s * by_cos + c * by_sin;
                *cos = c * by_cos - s * by_sin;
            }
        }
        let mut by = 0.5 * step;
        for _ in 0..5 {
            let here = take(0.0, 0.0);
            for order in [here - by, here + by] {
                take(order, sums.gain(&self::waves(q, order)));
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

/// Sine and cosine of an order at each sample.
fn waves(q: &[f64], order: f64) -> Vec<[f64; 2]> {
    q.iter().map(|q| (order * q).sin_cos().into()).collect()
}

/// Of each sample: a turn's product with what is left, and with itself.
struct Sums(Vec<[f64; 2]>);

impl Sums {
    fn of(residual: &Residual, joint: usize) -> Self {
        let n = residual.q[joint].len();
        let mut sums = vec![[0.0; 2]; n];
        for (row, unit) in residual.units.column(joint).iter().enumerate() {
            sums[row % n][0] += unit * residual.left[row];
            sums[row % n][1] += unit * unit;
        }
        Self(sums)
    }

    /// By how much these sines and cosines lower the sum of squares.
    fn gain(&self, waves: &[[f64; 2]]) -> f64 {
        let mut sums = [0.0; 5];
        for ([left, own], [s, c]) in self.0.iter().zip(waves) {
            let products = [left * s, left * c, own * s * s, own * s * c, own * c * c];
            for (sum, product) in sums.iter_mut().zip(products) {
                *sum += product;
            }
        }
        let [a, b, aa, ab, bb] = sums;
        let determinant = aa * bb - ab * ab;
        if determinant <= 1e-6 * aa * bb {
            return 0.0;
        }
        (a * a * bb - 2.0 * a * b * ab + b * b * aa) / determinant
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fit::example::unrepeated;

    #[test]
    fn an_order_between_whole_numbers_is_found_and_noise_has_none() {
        let robot = unrepeated(0.0, 1).robot;
        let wild = |k: usize, by: f64| (k as f64 * by).fract() * 4.0 - 2.0;
        let steps = [
            0.754_877_666,
            0.569_840_291,
            0.438_579_1,
            0.342_1,
            0.271_3,
            0.219_7,
        ];
        let q: Vec<Cow<[f64]>> = steps[..robot.joints.len()]
            .iter()
            .map(|by| Cow::Owned((0..200).map(|k| wild(k, *by)).collect()))
            .collect();
        let units = DMatrix::from_element(200, robot.joints.len(), 1.0);
        let found = |amplitude: f64| {
            let left = DVector::from_fn(200, |k, _| {
                let noise = (((k + 3) * (k + 7)) as f64 * 0.37).sin();
                amplitude * (80.5 * q[1][k] + 0.3).sin() + noise
            });
            strongest(&Residual {
                robot: &robot,
                q: &q,
                units: &units,
                left: &left,
                variance: 0.5,
            })
        };
        let (joint, order) = found(1.0).unwrap();
        assert_eq!(joint, 1);
        assert!((order - 80.5).abs() < 0.1, "{order}");
        assert_eq!(found(0.0), None);
    }
}
