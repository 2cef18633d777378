//! The conditions of a session: which vary, and how far. Effects use it to check whether they can be tested at all.

use nalgebra::Vector3;

use crate::kinematics::{JointKind, Robot};
use crate::numeric::extent;
use crate::sessions::{Instrument, Session, Sigma};
use crate::text::Text;
use crate::{budget, rounding};

use super::inputs::Inputs;
use super::joint_frame::JointFrame;

/// What is known of one joint.
#[derive(Debug, Clone)]
pub struct JointSurvey {
    /// Revolute or prismatic.
    pub kind: JointKind,
    /// Its frame.
    pub frame: JointFrame,
    /// Number of commanded values that the instrument can distinguish, counted up to `ENOUGH`: a joint that a
    /// controller holds still is read back with jitter.
    pub values: usize,
    /// From the smallest to the largest commanded value, rad or mm.
    pub span: f64,
    /// Number of samples that came from the negative and from the positive side.
    pub from_sides: [usize; 2],
    /// Number of different speeds, counted up to `ENOUGH`.
    pub speeds: usize,
    /// Largest speed, rad/s or mm/s.
    pub largest_speed: f64,
    /// Whether gravity is known and has a lever about the joint in some measured pose.
    pub gravity_lever: bool,
    /// Range of the joint's own temperature, K; `None` where it was not measured.
    pub warming_c: Option<f64>,
    /// Range of the joint's measured torque, N·m; `None` where it was not measured.
    pub torque_range_nm: Option<f64>,
}

/// Which conditions vary in a session, and how far.
#[derive(Debug, Clone)]
pub struct Survey {
    /// One for each joint.
    pub joints: Vec<JointSurvey>,
    /// Number of different loads, counted up to `ENOUGH`; 0 without a load column.
    pub loads: usize,
    /// Largest load, kg.
    pub largest_load_kg: f64,
    /// Temperature range, K; `None` without a temperature column.
    pub warming_c: Option<f64>,
    /// Time range, s; `None` without a time column.
    pub duration_s: Option<f64>,
    /// Whether z was measured.
    pub spatial: bool,
    /// Whether gravity is known (and not zero).
    pub gravity: bool,
    /// Whether some link mass is given.
    pub link_masses: bool,
    /// Number of reflectors that samples use.
    pub targets: usize,
}

/// Different values are counted only so far.
pub const ENOUGH: usize = 16;

impl Survey {
    /// Looks through a session.
    pub fn new(session: &Session, inputs: &Inputs) -> Self {
        let joints = 0..session.robot.joints.len();
        let (coldest, warmest) = extremes(inputs.above_20_c.as_deref().unwrap_or(&[]));
        let (first, last) = extremes(inputs.time_s.as_deref().unwrap_or(&[]));
        let loads = inputs.load_kg.as_deref().unwrap_or(&[]);
        let gravity = session.robot.gravity_m_s2;
        let mut used: Vec<u32> = inputs.target.as_deref().unwrap_or(&[0]).to_vec();
        used.sort_unstable();
        used.dedup();
        let resolved_mm = resolved_mm(&session.instrument);
        Self {
            joints: joints
                .map(|j| survey_joint(&session.robot, inputs, j, resolved_mm))
                .collect(),
            loads: distinct(loads, 0.0),
            largest_load_kg: extremes(loads).1.max(0.0),
            warming_c: inputs.above_20_c.as_ref().map(|_| warmest - coldest),
            duration_s: inputs.time_s.as_ref().map(|_| last - first),
            spatial: session.samples.z_mm.is_some(),
            gravity: gravity.is_some_and(|g| g.norm() > 0.0),
            link_masses: session.robot.joints.iter().any(|j| j.link.is_some()),
            targets: used.len(),
        }
    }

    /// Range of the temperature that counts for a joint, K; `None`: not measured.
    pub fn warming_of(&self, joint: usize) -> Option<f64> {
        let own = self.joints.get(joint).and_then(|joint| joint.warming_c);
        own.or(self.warming_c)
    }

    /// The obstacle to every effect that needs an angle of rotation.
    pub fn not_revolute(&self, joint: usize) -> Option<Text> {
        let Some(own) = self.joints.get(joint) else {
            return Some(no_joint(joint));
        };
        (own.kind == JointKind::Prismatic)
            .then(|| text!("the joint slides, the effect needs one that turns"))
    }

    /// The obstacle to every effect of the joint angle in a session at one angle.
    pub fn too_few_angles(&self, joint: usize, needed: usize) -> Option<Text> {
        let Some(own) = self.joints.get(joint) else {
            return Some(no_joint(joint));
        };
        let values = own.values;
        (values < needed).then(|| {
            text!(
                one "the joint was measured at {count} value, at least {needed} are needed", "the joint was measured at {count} different values, at least {needed} are needed",
                count = values,
                needed
            )
        })
    }
}

/// That a robot has fewer joints.
pub(super) fn no_joint(joint: usize) -> Text {
    text!(
        "the robot has no joint {joint}",
        joint = joint.saturating_add(1)
    )
}

/// What the instrument resolves of a point, mm: its smallest σ; nothing is known of one without.
fn resolved_mm(instrument: &Instrument) -> f64 {
    match (instrument.tracker, instrument.sigma_mm) {
        (Some(tracker), _) => tracker.sigma_range_mm,
        (None, Some(Sigma::Overall(sigma))) => sigma,
        (None, Some(Sigma::PerAxis(sigma))) => extent(sigma)[0],
        (None, None) => 0.0,
    }
}

fn survey_joint(robot: &Robot, inputs: &Inputs, joint: usize, resolved_mm: f64) -> JointSurvey {
    let q: &[f64] = inputs.q.get(joint).map_or(&[], AsRef::as_ref);
    let (low, high) = extremes(q);
    let dir = inputs.dir.get(joint).and_then(Option::as_deref);
    let dir = dir.unwrap_or(&[]);
    let speeds = inputs.speed.get(joint).and_then(Option::as_deref);
    let speeds = speeds.unwrap_or(&[]);
    let (slowest, fastest) = extremes(speeds);
    let frame = JointFrame::new(robot, joint);
    // No target is farther from the axis than the robot reaches.
    let apart = match robot.joints[joint].kind {
        JointKind::Revolute => resolved_mm / robot.reach_mm().max(resolved_mm),
        JointKind::Prismatic => resolved_mm,
    };
    let lever = robot
        .gravity_m_s2
        .is_some_and(|g| has_lever(robot, inputs, joint, g));
    JointSurvey {
        kind: robot.joints[joint].kind,
        frame,
        values: distinct(q, apart),
        span: high - low,
        from_sides: [
            dir.iter().filter(|d| **d < 0.0).count(),
            dir.iter().filter(|d| **d > 0.0).count(),
        ],
        speeds: distinct(speeds, 0.0),
        largest_speed: slowest.abs().max(fastest.abs()),
        gravity_lever: lever,
        warming_c: range(
            inputs
                .joint_above_20_c
                .get(joint)
                .and_then(Option::as_deref),
        ),
        torque_range_nm: range(inputs.torque_nm.get(joint).and_then(Option::as_deref)),
    }
}

/// Whether gravity has a lever about a joint in some measured pose: an upright arm has none at home
/// about many of them.
fn has_lever(robot: &Robot, inputs: &Inputs, joint: usize, gravity: Vector3<f64>) -> bool {
    let own = &robot.joints[joint];
    let along = own.axis.direction.into_inner();
    let across = |g: Vector3<f64>| match own.kind {
        JointKind::Revolute => (g - along * along.dot(&g)).norm(),
        JointKind::Prismatic => along.dot(&g).abs(),
    };
    // Turned back by the joints before it.
    let as_seen = |sample: usize| {
        let before = robot.joints[..joint].iter().zip(&inputs.q);
        before.fold(gravity, |g, (before, q)| match before.kind {
            JointKind::Revolute => {
                let axis = before.axis.direction;
                let q = q.get(sample).copied().unwrap_or(0.0);
                nalgebra::Rotation3::from_axis_angle(&axis, -q) * g
            }
            JointKind::Prismatic => g,
        })
    };
    let least = rounding::COMPUTED * gravity.norm();
    if joint == 0 || inputs.is_empty() {
        return across(gravity) > least;
    }
    let stride = (inputs.len() / budget::OF_A_TRIAL).max(1);
    let mut poses = (0..inputs.len()).step_by(stride);
    poses.any(|sample| across(as_seen(sample)) > least)
}

fn extremes(values: &[f64]) -> (f64, f64) {
    if values.is_empty() {
        return (0.0, 0.0);
    }
    extent(values).into()
}

/// From the smallest to the largest value.
fn range(values: Option<&[f64]>) -> Option<f64> {
    values.map(|values| {
        let (low, high) = extremes(values);
        high - low
    })
}

/// Number of values that are farther than so much from each other, counted up to [`ENOUGH`].
fn distinct(values: &[f64], apart: f64) -> usize {
    let mut seen: Vec<f64> = Vec::new();
    for value in values {
        if seen.iter().all(|s| (s - value).abs() > apart) {
            seen.push(*value);
            if seen.len() == ENOUGH {
                break;
            }
        }
    }
    seen.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A joint that a controller holds is read back a hair off: for a tracker it stands still.
    #[test]
    fn values_that_the_instrument_cannot_tell_apart_are_one() {
        let reach_mm = 500.0;
        let jitter: Vec<f64> = (0..40).map(|k| 1e-6 * f64::from(k % 7)).collect();
        let steps: Vec<f64> = (0..40).map(|k| 0.1 * f64::from(k)).collect();
        assert_eq!(distinct(&jitter, 0.02 / reach_mm), 1);
        assert_eq!(distinct(&steps, 0.02 / reach_mm), ENOUGH);
        // Of an instrument of which nothing is known every value counts.
        assert_eq!(distinct(&jitter, resolved_mm(&Instrument::default())), 7);
    }
}
