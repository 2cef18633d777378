//! What to measure: for a session the poses that answer its open questions, that make testable what it cannot show,
//! and that reduce the other uncertainties; for a robot alone a first measurement. These are the request and the
//! answer; `making` makes it.

use super::expected_information::ExpectedInformation;
use super::geometry::Geometry;
use super::needs::Untestable;
use super::pair_separation::Separation;
use crate::diagnosis::NextPose;
use crate::kinematics::Robot;
use crate::sessions::Target;

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
