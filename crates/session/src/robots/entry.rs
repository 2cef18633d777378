//! A robot of the library, and where its numbers are from.

use crate::kinematics::Robot;
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
#[derive(Debug, Clone, PartialEq, Eq)]
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
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Reference {
    /// Key of the source in [`crate::robots::sources`].
    pub source: String,
    /// File, table or model in it.
    pub place: String,
}

/// A robot of the library.
#[derive(Debug, Clone, PartialEq)]
pub struct LibraryRobot {
    /// The name that commands use, such as `ur5e`.
    pub id: String,
    /// Who makes it.
    pub maker: String,
    /// The maker's designation.
    pub model: String,
    /// Other names of the same robot.
    pub also: Vec<String>,
    /// What kind of machine it is.
    pub kind: RobotKind,
    /// The nominal robot.
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
    pub gear_ratios: Vec<f64>,
    /// What the one who measures this robot has to know.
    pub note: Option<String>,
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

pub(super) struct Library {
    pub(super) sources: Vec<(String, Source)>,
    pub(super) robots: Vec<LibraryRobot>,
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
