//! What to measure: for a session the poses that answer its open questions, that make testable what it cannot show,
//! and that reduce the other uncertainties; for a robot alone a first measurement. These are the request and the
//! answer; `making` makes it.

use super::expected_information::ExpectedInformation;
use super::needs::Untestable;
use crate::diagnosis::NextPose;
use crate::kinematics::Robot;
use crate::sessions::Target;
use crate::text::Text;

/// Noise of the instrument where none is stated, mm: a laser tracker.
pub(crate) const USUAL_SIGMA_MM: f64 = 0.03;

/// What the plan is made for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Subject {
    /// A session that was measured.
    Session,
    /// A robot that was not.
    Robot,
}

/// A plan.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// What it is made for.
    pub subject: Subject,
    /// Its name.
    pub name: String,
    /// The robot.
    pub robot: Robot,
    /// Reflectors that the poses use; a new one is listed after the session's.
    pub targets: Vec<Target>,
    /// The poses in measuring order.
    pub poses: Vec<NextPose>,
    /// Explanations that the samples cannot distinguish: the names of the model, and the possible ones.
    pub open: Vec<[Vec<String>; 2]>,
    /// The two effects that were asked for.
    pub separation: Option<Separation>,
    /// What the poses make testable.
    pub enables: Vec<Untestable>,
    /// What remains untestable; `needs` states what would help besides poses, if anything does.
    pub cannot: Vec<Untestable>,
    /// Noise that the detection limits are for, mm.
    pub sigma_mm: f64,
    /// The expected information once the poses are measured.
    pub expected: ExpectedInformation,
    /// What the poses do for the geometry of a robot with several joints.
    pub geometry: Option<Geometry>,
}

impl Plan {
    pub(crate) fn empty(subject: Subject, name: &str, robot: &Robot, targets: &[Target]) -> Self {
        Self {
            subject,
            name: name.to_owned(),
            robot: robot.clone(),
            targets: targets.to_vec(),
            poses: Vec::new(),
            open: Vec::new(),
            separation: None,
            enables: Vec::new(),
            cannot: Vec::new(),
            sigma_mm: USUAL_SIGMA_MM,
            expected: ExpectedInformation::default(),
            geometry: None,
        }
    }

    /// Adds poses, and reflectors that they use and that are not there yet.
    pub(crate) fn add(&mut self, poses: Vec<NextPose>) {
        for pose in &poses {
            if let (Some(name), Some(mm)) = (&pose.target, pose.target_mm)
                && !self.targets.iter().any(|t| t.name == *name)
            {
                self.targets.push(Target {
                    name: name.clone(),
                    position_mm: mm.into(),
                });
            }
        }
        self.poses.extend(poses);
    }
}

/// Poses that distinguish two effects.
#[derive(Debug, Clone, PartialEq)]
pub struct Separation {
    /// The two: the effect's name, and its joint counted from 0 where it has one.
    pub between: [(&'static str, Option<usize>); 2],
    /// Share of each that the other cannot imitate in the samples so far, 0 to 1 (squared).
    pub left_before: Vec<f64>,
    /// The same with the poses measured too, 0 to 1.
    pub left_after: Vec<f64>,
    /// Whether both are distinguished at the size at which they would just be detected.
    pub decided: bool,
    /// Why no pose does it; `None` where poses do.
    pub impossible: Option<Text>,
    /// The poses.
    pub poses: Vec<NextPose>,
}

/// What the poses of a plan do for the geometry.
#[derive(Debug, Clone, PartialEq)]
pub struct Geometry {
    /// Parameters that are identified.
    pub parameters: usize,
    /// With what was measured so far; of a robot that was not measured with random poses of the same
    /// number, the mean of several sets.
    pub before: Forecast,
    /// With the poses of the plan.
    pub after: Forecast,
    /// The expected error with so many poses, those that were measured not counted.
    pub curve: Vec<(usize, ExpectedError)>,
    /// The 95th percentile that was asked for, mm, and how many poses reach it.
    pub enough: Option<(f64, usize)>,
}

/// The forecast of poses.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Forecast {
    /// The error.
    pub error: ExpectedError,
    /// The observability index, mm; 0 where a parameter is not shown at all.
    pub observability: f64,
}

/// The expected error of the model over the joint ranges.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExpectedError {
    /// Root mean square, mm.
    pub rms_mm: f64,
    /// 95th percentile, mm.
    pub p95_mm: f64,
}
