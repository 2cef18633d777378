//! What to measure: for a session the poses that decide what it leaves open, that make testable
//! what it cannot show, and that sharpen the rest; for a robot alone a first measurement. This is what
//! is asked and what is answered; `making` makes it.

use super::expected_information::ExpectedInformation;
use super::geometry::Geometry;
use super::needs::Untestable;
use super::pair_separation::Separation;
use crate::diagnosis::NextPose;
use crate::effects::{Form, find};
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
    /// Explanations that the samples cannot tell apart: the names that stand, and those that could.
    pub open: Vec<[Vec<String>; 2]>,
    /// The two effects that were asked for.
    pub separation: Option<Separation>,
    /// What the poses make testable.
    pub enables: Vec<Untestable>,
    /// What stays untestable; `needs` says what would help beside poses, if anything does.
    pub cannot: Vec<Untestable>,
    /// Noise that the detection limits are for, mm.
    pub sigma_mm: f64,
    /// What can be told once the poses are measured.
    pub expected: ExpectedInformation,
    /// What the poses do for the geometry of a robot with several joints.
    pub geometry: Option<Geometry>,
}

/// A detection limit as the user reads it.
#[derive(Debug, Clone, PartialEq)]
pub struct SeenAbove {
    /// The effect's name.
    pub effect: &'static str,
    /// Joint, counted from 1; `None` where it belongs to none.
    pub joint: Option<usize>,
    /// For each parameter its name with its unit and the size above which it will be seen.
    pub sizes: Vec<(&'static str, f64)>,
}

impl Plan {
    pub(crate) fn empty(
        subject: Subject,
        name: String,
        robot: &Robot,
        targets: &[Target],
        sigma_mm: f64,
    ) -> Self {
        Self {
            subject,
            name,
            robot: robot.clone(),
            targets: targets.to_vec(),
            poses: Vec::new(),
            open: Vec::new(),
            separation: None,
            enables: Vec::new(),
            cannot: Vec::new(),
            sigma_mm,
            expected: ExpectedInformation::default(),
            geometry: None,
        }
    }

    /// Detection limits once the poses are measured; what is called degrees is millimetres where
    /// a joint slides.
    pub fn seen_above(&self) -> Vec<SeenAbove> {
        let one = |limit: &crate::diagnosis::verdict::limits::Limit| {
            let kind = self.robot.joints[limit.joint.unwrap_or(0)].kind;
            let quantities = find(limit.effect).map(|e| e.about().form);
            let size = |(name, size): &(&'static str, f64)| {
                let quantity = match quantities {
                    Some(Form::Plain(all)) => all.iter().find(|q| q.name == *name).copied(),
                    Some(Form::Harmonic(quantity) | Form::Fading(quantity)) => Some(quantity),
                    None => None,
                };
                quantity.map_or((*name, *size), |quantity| {
                    let on = quantity.on(kind);
                    (on.name, size * quantity.unit.scale / on.unit.scale)
                })
            };
            SeenAbove {
                effect: limit.effect,
                joint: limit.joint.map(|j| j + 1),
                sizes: limit.sizes.iter().map(size).collect(),
            }
        };
        self.expected.limits.iter().map(one).collect()
    }
}
