//! The numbers of what predicts without a name: gravity, conditions and waves, in three directions and about them.
//!
//! ```text
//! s(q) = Σ_k (u_k a_k + v_k b_k)·τ̂ + c_L τ_L + c_m τ_m + c_s dir + c_ω ω + c_T (T − 20 °C)
//!        + Σ_w S_w sin(Σ_j o_wj q_j) + C_w cos(Σ_j o_wj q_j)
//! ```
//!
//! The first sum is the sag of the joint under parts that turn with it and with the joints behind it, by
//! moments along the directions across their axes (see `joint-compliance`), per unit of gravity.

use super::curve::{DIRECTIONS, MOST_KNOTS};
use crate::effects::joint_frame::JointFrame;
use crate::kinematics::{JointKind, Robot};
use crate::lanes::{add_scaled, cross, dot, turned};

/// Outside the measured range a correction has faded after so much of the range.
const FADE: f64 = 0.25;
/// Joints whose parts sag: the joint and two behind it; two moments each.
pub const UNIT_SAGS: usize = 6;

/// How a link is moved, in order: along the joint's motion, along its radius, along its axis (the directions of a curve);
/// turned, before that, about its motion's direction, its radius and what is perpendicular to both (what a guide that is
/// not straight does to its carriage, ISO 230-1: roll, pitch, yaw).
pub const MOVES: usize = 2 * DIRECTIONS;

/// The variables of a correction in addition to the joints' values, see [`Along::conditions`].
pub const CONDITIONS: usize = 5;

/// A sine and a cosine of a sum of joint values.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Wave {
    /// rad per unit (rad or mm) of every joint; of a turning joint cycles per turn.
    pub orders: Vec<f64>,
    /// Factor of the sine, rad or mm.
    pub sine: f64,
    /// Factor of the cosine, rad or mm.
    pub cosine: f64,
}

/// A correction in one direction.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Along {
    /// Moments of gravity, two for each part, rad or mm; empty: none.
    pub moments: Vec<f64>,
    /// By the load's torque about the joint, the measured torque (per N·m), the side, the speed (per
    /// rad/s or mm/s), the temperature above 20 °C (per K).
    pub conditions: [f64; CONDITIONS],
    /// Waves.
    pub waves: Vec<Wave>,
}

/// Coefficients of what predicts without a name.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Rest {
    /// Measured range of every joint, rad or mm.
    pub ranges: Vec<[f64; 2]>,
    /// Measured range of each of the conditions; outside it the value at its end counts. Empty: not known.
    pub condition_ranges: Vec<[f64; 2]>,
    /// The correction by each of the [`MOVES`].
    pub along: [Along; MOVES],
    /// Coefficients of everything else in the model, inner units, in a model without what has no name: for what cannot
    /// hold such a correction. Empty: not known.
    pub geometry_alone: Vec<f64>,
}

/// Why there is no such correction.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum RestError {
    /// A range for each joint is needed.
    #[error(
        "ranges of {0} joints; expected one for each joint, from the smaller to the larger value"
    )]
    Ranges(usize),
    /// A range for each condition, or none.
    #[error(
        "ranges of {0} conditions; expected none or five, from the smaller to the larger value"
    )]
    ConditionRanges(usize),
    /// Moments come in pairs, one for each part.
    #[error("{0} moments; expected none or {UNIT_SAGS}")]
    Moments(usize),
    /// Lists that do not belong together.
    #[error("a wave needs an order for each joint, a sine and a cosine, all of them numbers")]
    Waves,
}

/// Where a joint's correction is asked for.
#[derive(Debug, Clone)]
pub struct RestPoint<'a> {
    pub(crate) robot: &'a Robot,
    pub(crate) joint: usize,
    /// Commands of all joints, rad or mm.
    pub q: Vec<f64>,
    pub(crate) load_nm: f64,
    pub(crate) torque_nm: f64,
    pub(crate) side: f64,
    pub(crate) speed: f64,
    pub(crate) above_20_c: f64,
}

impl RestPoint<'_> {
    /// What the conditions are multiplied with, in the order of [`Along::conditions`].
    pub fn conditions(&self) -> [f64; CONDITIONS] {
        [
            self.load_nm,
            self.torque_nm,
            self.side,
            self.speed,
            self.above_20_c,
        ]
    }
}

impl Rest {
    /// Whether it is valid for a robot with so many joints.
    ///
    /// # Errors
    /// See [`RestError`].
    pub fn check(&self, joints: usize) -> Result<(), RestError> {
        let good = |r: &[f64; 2]| r[0].is_finite() && r[1].is_finite() && r[0] <= r[1];
        if !self.geometry_alone.iter().all(|v| v.is_finite()) {
            return Err(RestError::Waves);
        }
        if self.ranges.len() != joints || !self.ranges.iter().all(good) {
            return Err(RestError::Ranges(self.ranges.len()));
        }
        let own = &self.condition_ranges;
        if !matches!(own.len(), 0 | CONDITIONS) || !own.iter().all(good) {
            return Err(RestError::ConditionRanges(own.len()));
        }
        for along in &self.along {
            let moments = &along.moments;
            if !moments.is_empty() && moments.len() != UNIT_SAGS {
                return Err(RestError::Moments(moments.len()));
            }
            let is_good = |wave: &Wave| {
                let numbers = wave.orders.iter().chain([&wave.sine, &wave.cosine]);
                wave.orders.len() == joints && numbers.into_iter().all(|v| v.is_finite())
            };
            let finite = moments
                .iter()
                .chain(&along.conditions)
                .all(|v| v.is_finite());
            if !finite || along.waves.len() > MOST_KNOTS || !along.waves.iter().all(is_good) {
                return Err(RestError::Waves);
            }
        }
        Ok(())
    }

    /// Whether it changes with the command of a joint, where it belongs to joint `own`.
    pub(crate) fn follows(&self, own: usize, joint: usize) -> bool {
        self.along.iter().any(|a| {
            let order = |w: &Wave| w.orders.get(joint).is_some_and(|o| *o != 0.0);
            // The load and what turns gravity may hang on any joint.
            let sags = !a.moments.is_empty() && joint < own + UNIT_SAGS / 2;
            sags || a.conditions[0] != 0.0 || a.waves.iter().any(order)
        })
    }

    /// The correction by each of the [`MOVES`], rad or mm.
    pub fn at(&self, at: &RestPoint) -> [f64; MOVES] {
        // No separate memory for each sample of a usual robot.
        const USUAL: usize = 16;
        let count = at.q.len().min(self.ranges.len());
        let (mut usual, mut more) = ([0.0; USUAL], Vec::new());
        let q = if count <= USUAL {
            &mut usual[..count]
        } else {
            more.resize(count, 0.0);
            &mut more[..]
        };
        let mut weight = 1.0;
        for (joint, (value, range)) in at.q.iter().zip(&self.ranges).enumerate() {
            q[joint] = value.clamp(range[0], range[1]);
            if self.follows(at.joint, joint) {
                weight *= fade(*value, *range);
            }
        }
        let (q, mut conditions) = (&*q, at.conditions());
        for (value, range) in conditions.iter_mut().zip(&self.condition_ranges) {
            *value = value.clamp(range[0], range[1]);
        }
        self.along.each_ref().map(|along| {
            let mut sum = 0.0;
            if !along.moments.is_empty() {
                sum += sag(at.robot, at.joint, q, &along.moments);
            }
            for (by, value) in along.conditions.iter().zip(conditions) {
                sum += by * value;
            }
            for wave in &along.waves {
                let phase: f64 = wave.orders.iter().zip(q).map(|(o, q)| o * q).sum();
                let (sin, cos) = phase.sin_cos();
                sum += wave.sine * sin + wave.cosine * cos;
            }
            weight * sum
        })
    }
}

/// 1 within a range, smoothly to 0 outside it.
pub(crate) fn fade(value: f64, [from, to]: [f64; 2]) -> f64 {
    let beyond = (from - value).max(value - to).max(0.0);
    if beyond == 0.0 {
        return 1.0;
    }
    let width = FADE * (to - from);
    if beyond >= width {
        return 0.0;
    }
    let left = 1.0 - beyond / width;
    left * left * (3.0 - 2.0 * left)
}

/// By how much a joint sags under such moments, rad per unit of them.
fn sag(robot: &Robot, joint: usize, q: &[f64], moments: &[f64]) -> f64 {
    let Some(down) = seen_by(robot, joint, q) else {
        return 0.0;
    };
    let mut moment = [0.0; 3];
    for part in (0..UNIT_SAGS / 2).rev() {
        let k = joint + part;
        if k >= robot.joints.len() || robot.joints[k].kind != JointKind::Revolute {
            continue;
        }
        let frame = JointFrame::new(robot, k);
        moment = add_scaled(moment, frame.across_1, moments[2 * part]);
        moment = add_scaled(moment, frame.across_2, moments[2 * part + 1]);
        let (sin, cos) = q[k].sin_cos();
        moment = turned(moment, frame.along, sin, cos);
    }
    let axis: [f64; 3] = robot.joints[joint].axis.direction.into_inner().into();
    dot(axis, cross(moment, down))
}

/// The sag under one unit of each moment.
pub fn unit_sag(robot: &Robot, joint: usize, q: &[f64]) -> [f64; UNIT_SAGS] {
    std::array::from_fn(|k| {
        let mut moments = [0.0; UNIT_SAGS];
        moments[k] = 1.0;
        sag(robot, joint, q, &moments)
    })
}

/// Direction of gravity as a joint sees it, turned back by the joints before it; `None` where it is not
/// known.
fn seen_by(robot: &Robot, joint: usize, q: &[f64]) -> Option<[f64; 3]> {
    let gravity = robot.gravity_m_s2?;
    let norm = gravity.norm();
    let mut down: [f64; 3] = (norm > 0.0).then(|| (gravity / norm).into())?;
    for (before, value) in robot.joints.iter().zip(q).take(joint) {
        if before.kind == JointKind::Revolute {
            let (sin, cos) = value.sin_cos();
            down = turned(down, before.axis.direction.into_inner().into(), -sin, cos);
        }
    }
    Some(down)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinematics::{Pose, Robot, RobotSource};

    #[test]
    fn beyond_the_measured_range_a_condition_counts_as_its_end() {
        let robot = Robot {
            name: "none".to_owned(),
            joints: Vec::new(),
            base_from_tool: Pose::identity(),
            gravity_m_s2: None,
            source: RobotSource::default(),
        };
        let mut rest = Rest {
            condition_ranges: vec![[0.0, 0.0], [0.0, 0.0], [-1.0, 1.0], [0.0, 0.0], [2.0, 4.0]],
            ..Rest::default()
        };
        rest.along[0].conditions[4] = 0.5;
        let at = |above_20_c: f64| {
            let point = RestPoint {
                robot: &robot,
                joint: 0,
                q: Vec::new(),
                load_nm: 0.0,
                torque_nm: 0.0,
                side: 0.0,
                speed: 0.0,
                above_20_c,
            };
            rest.at(&point)[0]
        };
        assert_eq!([0.0, 3.0, 9.0].map(at), [1.0, 1.5, 2.0]);
        rest.condition_ranges.pop();
        assert!(matches!(rest.check(0), Err(RestError::ConditionRanges(4))));
    }
}
