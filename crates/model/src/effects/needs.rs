//! The needs of an effect: what a session must have for it to be testable, as data: the words, the check of a session,
//! the check of a scenario.
//!
//! An effect lists its needs in its [`About`](super::About); the first that a session does not meet is the reason that
//! a person reads. Needs that several effects share are here, one of a single effect is in its file.
//! effect has is in its file.

use crate::kinematics::JointKind;
use crate::text::{Template, Text};

use super::survey::{Survey, no_joint};

/// Something that a session must have.
#[derive(Debug, Clone, Copy)]
pub struct Need {
    /// What it is: "approaches from both sides".
    pub what: Template,
    /// Why a session does not have it for a joint (counted from 0); `None` where it has.
    pub unmet: fn(&Survey, usize) -> Option<Text>,
    /// Why a scenario does not offer it; `None` where it does, or where only samples can show it.
    pub idle: fn(&AvailableColumns) -> Option<Template>,
}

/// What the conditions of a scenario offer.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(
    clippy::struct_excessive_bools,
    reason = "each is one column that samples would have or not"
)]
pub struct AvailableColumns {
    /// Samples have a time.
    pub time: bool,
    /// Samples have a temperature, of the room or of joints.
    pub temperature: bool,
    /// Samples have a load.
    pub load: bool,
    /// Some link has a mass.
    pub link_masses: bool,
    /// The direction of gravity is known.
    pub gravity: bool,
    /// Some pose is measured while the joints move.
    pub speed: bool,
    /// Whether poses state from which side they are reached.
    pub sides: bool,
}

impl Need {
    /// A need that only samples can show.
    pub const fn of_samples(what: Template, unmet: fn(&Survey, usize) -> Option<Text>) -> Self {
        Self {
            what,
            unmet,
            idle: |_| None,
        }
    }

    /// Whether it can be met by a robot with joints of these kinds at all, for a joint counted from 0:
    /// what cannot is no lack of the session, but an effect of other robots.
    pub fn suits(&self, kinds: &[JointKind], joint: Option<usize>) -> bool {
        let is = |kind| {
            joint
                .and_then(|joint| kinds.get(joint))
                .is_none_or(|own| *own == kind)
        };
        match self.what {
            what if what == Self::SINGLE_AXIS.what => kinds.len() == 1,
            what if what == Self::SEVERAL_JOINTS => kinds.len() > 1,
            what if what == Self::REVOLUTE.what => is(JointKind::Revolute),
            what if what == Self::PRISMATIC.what => is(JointKind::Prismatic),
            _ => true,
        }
    }

    /// What a robot with several joints is called as a need.
    pub const SEVERAL_JOINTS: Template = phrase!("several joints");

    /// So many different values of the joint; `what` states it in words.
    pub const fn values<const N: usize>(what: Template) -> Self {
        Self::of_samples(what, |survey, joint| survey.too_few_angles(joint, N))
    }

    /// A joint that turns.
    pub const REVOLUTE: Self =
        Self::of_samples(phrase!("a joint that turns"), Survey::not_revolute);

    /// A joint that slides.
    pub const PRISMATIC: Self =
        Self::of_samples(phrase!("a joint that slides"), |survey, joint| {
            let Some(own) = survey.joints.get(joint) else {
                return Some(no_joint(joint));
            };
            (own.kind == JointKind::Revolute)
                .then(|| text!("the joint turns, the effect needs one that slides"))
        });

    /// Poses from either side.
    pub const BOTH_SIDES: Self = Self {
        what: phrase!("approaches from both sides"),
        unmet: |survey, joint| match survey.joints.get(joint).map(|own| own.from_sides) {
            None => Some(no_joint(joint)),
            Some([0, 0]) => Some(text!(
                "the session does not say from which side the poses were approached"
            )),
            Some([0, _] | [_, 0]) => Some(text!("every pose was approached from the same side")),
            Some(_) => None,
        },
        idle: |offered| {
            (!offered.sides).then_some(phrase!(
                "the list does not say from which side the poses are reached"
            ))
        },
    };

    /// Different signed speeds.
    pub const SPEEDS: Self = Self {
        what: phrase!("measurements at different speeds"),
        unmet: |survey, joint| {
            let Some(joint) = survey.joints.get(joint) else {
                return Some(no_joint(joint));
            };
            let reason = match (joint.speeds, joint.largest_speed) {
                (0, _) => {
                    text!("the session does not say how fast the joint moved while it was measured")
                }
                (_, 0.0) => text!("every pose was measured at standstill"),
                (1, _) => text!("every pose was measured at the same signed speed"),
                _ => return None,
            };
            Some(reason)
        },
        idle: |offered| (!offered.speed).then_some(phrase!("every pose is measured at standstill")),
    };

    /// A temperature that changes, of the joint or of the room.
    pub const TEMPERATURE: Self = Self {
        what: phrase!("a temperature that changes"),
        unmet: |survey, joint| match survey.warming_of(joint) {
            None => Some(text!("the session has no temperature")),
            Some(range) if range <= 0.0 => Some(text!("the temperature never changed")),
            Some(_) => None,
        },
        idle: |offered| {
            (!offered.temperature).then_some(phrase!("the scenario has no temperature"))
        },
    };

    /// Times that differ.
    pub const TIME: Self = Self {
        what: phrase!("the time of each sample"),
        unmet: |survey, _| match survey.duration_s {
            None => Some(text!("the session has no time")),
            Some(duration) if duration <= 0.0 => Some(text!("every sample has the same time")),
            Some(_) => None,
        },
        idle: |offered| (!offered.time).then_some(phrase!("the scenario has no seconds_per_pose")),
    };

    /// The direction of gravity.
    pub const GRAVITY: Self = Self {
        what: phrase!("the direction of gravity"),
        unmet: |survey, _| {
            (!survey.gravity).then(|| text!("the direction of gravity is not given"))
        },
        idle: |offered| {
            (!offered.gravity)
                .then_some(phrase!("the scenario has no load, or the robot no gravity"))
        },
    };

    /// Loads that differ.
    pub const LOADS: Self = Self {
        what: phrase!("different loads"),
        unmet: |survey, _| match survey.loads {
            0 => Some(text!("the session has no load")),
            1 => Some(text!("the load never changed")),
            _ => None,
        },
        idle: |offered| {
            (!offered.load).then_some(phrase!("the scenario has no load, or the robot no gravity"))
        },
    };

    /// A robot with a single axis.
    pub const SINGLE_AXIS: Self =
        Self::of_samples(phrase!("a robot with a single axis"), |survey, _| {
            (survey.joints.len() > 1)
                .then(|| text!("the robot has several joints: link geometry takes its place"))
        });

    /// A tool off the axis.
    pub const RADIUS: Self =
        Self::of_samples(phrase!("a tool that is off the axis"), |survey, joint| {
            (survey.joints[joint].frame.radius_mm == 0.0)
                .then(|| text!("the tool lies on the axis and has no radius"))
        });

    /// The coordinate along the axis.
    pub const AXIAL: Self =
        Self::of_samples(phrase!("the coordinate along the axis"), |survey, joint| {
            let along_z = survey.joints[joint].frame.along[2].abs() > 1.0 - 1e-6;
            (!survey.spatial && survey.joints.len() == 1 && along_z)
                .then(|| text!("z was not measured, and the effect is along the axis"))
        });
}
