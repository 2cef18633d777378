//! A robot of the library, and where its numbers are from.

use std::collections::BTreeMap;

use serde::de::Error;
use serde::{Deserialize, Deserializer};
use serde_json::Value;

use crate::kinematics::Robot;
use crate::sessions::parse_robot;
use crate::text::Text;

named! {
    /// What kind of machine a robot is.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub enum RobotKind {
        /// Six joints, the axes of the last three in one point.
        SixJoints = "six joints",
        /// Six joints, no common point of the last three axes.
        OffsetWrist = "six joints, offset wrist",
        /// Seven joints.
        SevenJoints = "seven joints",
        /// Two parallel vertical axes, a quill that slides and turns.
        Scara = "SCARA",
        /// Two axes that carry a workpiece.
        Positioner = "positioner",
        /// One axis.
        RotaryAxis = "rotary axis",
    }
    /// Its name in files and lists.
    pub fn name;
    /// Every one.
    pub const ALL;
}

/// Where numbers come from: a document or a repository.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Source {
    /// What it is.
    pub what: String,
    /// Its address; empty for a designation.
    pub at: String,
    /// The state that was read, of a repository.
    pub commit: Option<String>,
    /// Under which terms it is published.
    pub licence: String,
}

/// A source and the place in it.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
pub struct Reference {
    /// Key of the source in [`crate::robots::sources`].
    pub source: String,
    /// File, table or model in it.
    pub place: String,
}

/// Where the numbers of a robot are from.
#[derive(Debug, Clone, PartialEq, Eq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Sources {
    /// Source of joints, tool and ranges.
    pub geometry: Reference,
    /// Source of reach, load, mass and repeatability.
    pub figures: Option<Reference>,
    /// Source of the gear ratios.
    pub gears: Option<Reference>,
    /// The second source whose forward positions agree.
    pub checked_positions: Option<Reference>,
    /// The published reach that agrees.
    pub checked_reach: Option<Reference>,
}

/// A robot of the library.
#[derive(Debug, Clone, PartialEq, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct LibraryRobot {
    /// The name that commands use, such as `ur5e`.
    pub id: String,
    /// Who makes it.
    pub maker: String,
    /// The maker's designation.
    pub model: String,
    /// Other names of the same robot.
    #[serde(default)]
    pub also: Vec<String>,
    /// What kind of machine it is.
    #[serde(deserialize_with = "kind")]
    pub kind: RobotKind,
    /// The nominal robot.
    #[serde(deserialize_with = "robot")]
    pub robot: Robot,
    /// Greatest reach as published, mm; to which point differs from maker to maker.
    pub reach_mm: Option<f64>,
    /// Rated load, kg.
    pub payload_kg: Option<f64>,
    /// Mass of the arm, kg.
    pub mass_kg: Option<f64>,
    /// Position repeatability (ISO 9283) as published, mm.
    pub repeatability_mm: Option<f64>,
    /// Turns of the motor for one of each joint, where they are public; empty otherwise.
    #[serde(default)]
    pub gear_ratios: Vec<f64>,
    /// What the one who measures this robot has to know.
    pub note: Option<String>,
    /// Where its numbers are from.
    pub sources: Sources,
    /// What could not be checked against a second source.
    pub not_checked: Vec<String>,
}

impl LibraryRobot {
    /// Maker and model.
    pub fn title(&self) -> String {
        format!("{} {}", self.maker, self.model)
    }

    /// What could not be checked against a second source, in words.
    pub fn not_checked(&self) -> Text {
        Text::listed(self.not_checked.iter().map(|part| unchecked(part)), "; ")
    }
}

/// `assets/robots.json`, `truepose-robots/1`: sources by key, and the robots.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct Library {
    pub(super) format: String,
    pub(super) sources: BTreeMap<String, Source>,
    pub(super) robots: Vec<LibraryRobot>,
}

fn kind<'de, D: Deserializer<'de>>(from: D) -> Result<RobotKind, D::Error> {
    let name = String::deserialize(from)?;
    let kind = RobotKind::ALL.into_iter().find(|kind| kind.name() == name);
    kind.ok_or_else(|| D::Error::custom(name))
}

/// As a session has it.
fn robot<'de, D: Deserializer<'de>>(from: D) -> Result<Robot, D::Error> {
    let text = Value::deserialize(from)?.to_string();
    let loaded = parse_robot(text.as_bytes()).map_err(D::Error::custom)?;
    Ok(loaded.robot)
}

/// A part of the numbers as the file names it, which is the English of its sentence.
fn unchecked(part: &str) -> Text {
    let of_joints = part.strip_prefix("joint ranges of ");
    let of_joints = of_joints.and_then(|rest| rest.strip_suffix(" (the second source has others)"));
    match (of_joints, part) {
        (Some(joints), _) => text!(
            "joint ranges of {joints} (the second source has others)",
            joints
        ),
        (_, "joint ranges") => text!("joint ranges"),
        (_, "height of the flange") => text!("height of the flange"),
        (_, "link lengths") => text!("link lengths"),
        (_, "link lengths beyond what the reach tells (flange, heights, offsets)") => {
            text!("link lengths beyond what the reach tells (flange, heights, offsets)")
        }
        (_, other) => Text::verbatim(other),
    }
}
