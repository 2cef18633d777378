//! Distances of points from the nominal robot, wherever the instrument is.
//!
//! The rigid motion is the least-squares one of those three quarters of a setup's points that it brings nearest, and
//! the residuals have heavy tails (Student's t, ν = 4): outliers neither turn it nor count for much.

use nalgebra::{Isometry3, Point3, Vector3};

use crate::effects::{Inputs, JointValues};
use crate::kinematics::rigid_motion::rigid_motion;
use crate::model::Model;
use crate::numeric::whole;
use crate::sessions::{Group, Session};

/// Degrees of freedom of the heavy-tailed noise.
const TAILS: f64 = 4.0;
/// Coordinates of a point.
const AXES: f64 = 3.0;
/// How often the motion is sought of the nearest points.
const ROUNDS: usize = 4;
/// Below this a deviation is rounding, mm.
pub(super) const LEAST_SIGMA_MM: f64 = 1e-4;
/// The share of the samples, farthest off, that may be wrong in themselves.
const MOST_WRONG: f64 = 0.1;

/// Where the robot is, and what was measured, mm.
pub(super) type Pair = (Vector3<f64>, Vector3<f64>);

/// The nominal robot and the samples of a session.
pub(super) struct Nominal<'a> {
    session: &'a Session,
    robot: Model,
    pub(super) inputs: Inputs<'a>,
}

impl<'a> Nominal<'a> {
    pub(super) fn of(session: &'a Session, values: JointValues) -> Self {
        Self {
            session,
            robot: Model::nominal(session.robot.clone()),
            inputs: Inputs::new(session, values),
        }
    }

    /// Where the robot is with these inputs, and what was measured; in a plane without heights.
    pub(super) fn pairs(&self, inputs: &Inputs) -> Vec<Pair> {
        let predicted = self.robot.predict(inputs);
        let samples = &self.session.samples;
        let pair = |k: usize| {
            let (mut at, mut to) = (
                Vector3::from(predicted.get(k)),
                samples.coordinates(k).into(),
            );
            if samples.z_mm.is_none() {
                (at.z, to) = (0.0, Vector3::new(samples.x_mm[k], samples.y_mm[k], 0.0));
            }
            (at, to)
        };
        (0..samples.len()).map(pair).collect()
    }

    /// How far each point is from the robot, mm; `moved`: from where the best motion of its setup brings it.
    pub(super) fn lengths_mm(&self, moved: bool) -> Vec<f64> {
        let pairs = self.pairs(&self.inputs);
        // In a plane no motion is looked for.
        if !moved || self.session.samples.z_mm.is_none() {
            return pairs.iter().map(|(at, to)| (at - to).norm()).collect();
        }
        let of_setups = self.by_setup(&pairs).into_iter();
        let lengths = of_setups.filter_map(|own| {
            let motion = motion(&own)?;
            Some(
                own.iter()
                    .map(|pair| distance(&motion, pair))
                    .collect::<Vec<_>>(),
            )
        });
        lengths.flatten().collect()
    }

    /// The pairs that are known, by setup.
    fn by_setup(&self, pairs: &[Pair]) -> Vec<Vec<Pair>> {
        let mut all = vec![Vec::new(); Group::Setup.count(self.session).max(1)];
        for (k, pair) in pairs.iter().enumerate() {
            if (pair.0 + pair.1).iter().all(|v| v.is_finite()) {
                all[Group::Setup.of(self.session, k).unwrap_or(0)].push(*pair);
            }
        }
        all
    }

    /// RMS residual of predictions with these inputs, mm, without the samples that are farthest off; `mirrored`: of
    /// the points in a mirror. Undefined for points in a plane.
    pub(super) fn residual_mm(&self, inputs: &Inputs, mirrored: bool) -> f64 {
        let mut pairs = self.pairs(inputs);
        if mirrored {
            for (_, measured) in &mut pairs {
                measured.swap_rows(0, 1);
            }
        }
        let of_setup = |own: &Vec<Pair>| {
            let motion = rigid_motion(own)?;
            Some(
                own.iter()
                    .map(|pair| distance(&motion, pair).powi(2))
                    .collect::<Vec<_>>(),
            )
        };
        let mut squares: Vec<f64> = self
            .by_setup(&pairs)
            .iter()
            .filter_map(of_setup)
            .flatten()
            .collect();
        squares.sort_by(f64::total_cmp);
        squares.truncate(squares.len() - whole(MOST_WRONG * squares.len() as f64));
        if squares.is_empty() || self.session.samples.z_mm.is_none() {
            return f64::INFINITY;
        }
        (squares.iter().sum::<f64>() / squares.len() as f64).sqrt()
    }
}

/// What a deviation costs, as a logarithm.
pub(super) fn cost_of(length_mm: f64, sigma_mm: f64) -> f64 {
    // Of a sum, as nothing depends on the digits that are lost next to 1: this is most of the work.
    0.5 * (TAILS + AXES) * (1.0 + length_mm * length_mm / (TAILS * sigma_mm * sigma_mm)).ln()
}

/// The likeliest scale of deviations, mm, and their cost given it.
pub(super) fn cost(lengths_mm: &[f64]) -> (f64, f64) {
    let n = lengths_mm.len().max(1) as f64;
    let mean = lengths_mm.iter().sum::<f64>() / n;
    let mut sigma = mean.max(LEAST_SIGMA_MM);
    for _ in 0..30 {
        let weighed = lengths_mm.iter().map(|r| {
            let square = r * r;
            (TAILS + AXES) * square / (TAILS + square / (sigma * sigma))
        });
        let next = (weighed.sum::<f64>() / (AXES * n))
            .sqrt()
            .max(LEAST_SIGMA_MM);
        let settled = (next / sigma).ln().abs() < 1e-3;
        sigma = next;
        if settled {
            break;
        }
    }
    let costs = lengths_mm.iter().map(|r| cost_of(*r, sigma));
    (sigma, costs.sum::<f64>() + AXES * n * sigma.ln())
}

/// The motion of the nearest points, of pairs (predicted, measured); `None` where there are too few.
pub(super) fn motion(pairs: &[(Vector3<f64>, Vector3<f64>)]) -> Option<Isometry3<f64>> {
    let mut motion = rigid_motion(pairs)?;
    let kept = (pairs.len() * 3 / 4).max(4);
    let mut near = pairs.to_vec();
    for _ in 0..ROUNDS {
        if kept >= pairs.len() {
            break;
        }
        near.sort_by(|a, b| distance(&motion, a).total_cmp(&distance(&motion, b)));
        motion = rigid_motion(&near[..kept])?;
    }
    Some(motion)
}

/// How far a pair is apart, mm.
pub(super) fn distance(motion: &Isometry3<f64>, pair: &(Vector3<f64>, Vector3<f64>)) -> f64 {
    (moved(motion, &pair.0) - pair.1).norm()
}

pub(super) fn moved(motion: &Isometry3<f64>, point: &Vector3<f64>) -> Vector3<f64> {
    (motion * Point3::from(*point)).coords
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_that_are_wrong_in_themselves_do_not_turn_the_motion() {
        let at =
            |k: u32| Vector3::new((7 * k % 11).into(), (5 * k % 13).into(), (3 * k % 7).into());
        let true_motion =
            Isometry3::new(Vector3::new(3.0, -2.0, 1.0), Vector3::new(0.1, 0.2, -0.3));
        let pairs: Vec<_> = (0..40)
            .map(|k| {
                let wrong = if k % 5 == 0 { 50.0 } else { 0.0 };
                (
                    at(k),
                    moved(&true_motion, &at(k)) + Vector3::new(wrong, 0.0, 0.0),
                )
            })
            .collect();
        let found = motion(&pairs).expect("there are enough");
        assert!((found.translation.vector - true_motion.translation.vector).norm() < 1e-9);
        assert!(found.rotation.angle_to(&true_motion.rotation) < 1e-9);
    }

    #[test]
    fn a_few_deviations_that_are_far_off_hardly_widen_the_scale() {
        let mut lengths = vec![3.0_f64.sqrt(); 95];
        let (alone, _) = cost(&lengths);
        lengths.extend([1e4; 5]);
        let (with_outliers, _) = cost(&lengths);
        assert!(with_outliers < 1.6 * alone, "{alone} {with_outliers}");
    }
}
