//! Frames and tools as a program names them: which are declared, and which a pose refers to.

use crate::kinematics::Pose;
use crate::kinematics::inverse::Goal;
use crate::text::Text;
use nalgebra::UnitQuaternion;
use std::cmp::Ordering;
use std::collections::BTreeMap;
use std::ops::Deref;
use std::sync::Arc;

/// What a motion, or a position, says of its frame or tool.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Default)]
pub(super) enum Referred {
    /// Nothing.
    #[default]
    Unsaid,
    /// The one of this name.
    Named(Name),
    /// One that is chosen at run time, in words.
    Unknown(Text),
}

/// A name, looked up and compared in small letters, and shown as it was written.
#[derive(Debug, Clone)]
pub(super) struct Name {
    small: Arc<str>,
    written: Arc<str>,
}

impl Deref for Name {
    type Target = str;

    fn deref(&self) -> &str {
        &self.small
    }
}

impl std::fmt::Display for Name {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.written)
    }
}

impl PartialEq for Name {
    fn eq(&self, other: &Self) -> bool {
        self.small == other.small
    }
}

impl Eq for Name {}

impl PartialOrd for Name {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

impl Ord for Name {
    fn cmp(&self, other: &Self) -> Ordering {
        self.small.cmp(&other.small)
    }
}

impl Referred {
    pub(super) fn named(spelled: impl AsRef<str>) -> Self {
        let written = spelled.as_ref();
        Self::Named(Name {
            small: written.to_lowercase().into(),
            written: written.into(),
        })
    }

    /// Whether it has this name, whatever its capitals.
    pub(super) fn is(&self, name: &str) -> bool {
        *self == Self::named(name)
    }
}

impl std::fmt::Display for Referred {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Self::Unsaid => f.write_str("none"),
            Self::Named(name) => name.fmt(f),
            Self::Unknown(says) => std::fmt::Display::fmt(says, f),
        }
    }
}

/// The parts of a way: base (work object, frame), tool, and what else keeps poses from being where they are written.
pub(super) const BASE: usize = 0;
pub(super) const TOOL: usize = 1;
pub(super) const MODE: usize = 2;

/// A part of the way of motions, and what it is.
pub(super) type Set = (usize, Referred);

/// What holds at a motion, by these parts.
pub(super) type Way = [Referred; 3];

/// Every way that motions of a program have, each once.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Ways {
    all: Vec<Way>,
    index: BTreeMap<Way, u32>,
}

impl Ways {
    /// The number of a way.
    pub(super) fn of(&mut self, way: Way) -> u32 {
        *self.index.entry(way).or_insert_with_key(|way| {
            self.all.push(way.clone());
            u32::try_from(self.all.len() - 1).unwrap_or(u32::MAX)
        })
    }

    pub(super) fn get(&self, index: u32) -> &Way {
        &self.all[index as usize]
    }
}

/// In which ways motions go to a target: the first two that differ tell whether it is one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub(super) struct UsedPairs(pub(super) [Option<u32>; 2]);

impl UsedPairs {
    pub(super) fn add(&mut self, way: u32) {
        match self.0 {
            [None, _] => self.0[0] = Some(way),
            [Some(first), None] if first != way => self.0[1] = Some(way),
            _ => {}
        }
    }

    pub(super) fn join(&mut self, other: Self) {
        for way in other.0.into_iter().flatten() {
            self.add(way);
        }
    }

    pub(super) fn iter(self) -> impl Iterator<Item = u32> {
        self.0.into_iter().flatten()
    }
}

/// A frame or a tool that the file declares: where, and its pose (in the base, on the flange) or why that
/// is not known.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Declared {
    pub(super) at: usize,
    pub(super) pose: Result<Pose, Text>,
    /// Mass of a tool that is declared with one, kg.
    pub(super) mass_kg: Option<f64>,
    /// Whether it is the language's own name for "none": it says nothing.
    pub(super) is_none: bool,
    /// Whether the tool stands and the robot holds the part.
    pub(super) stands: bool,
}

/// Frames or tools by their names in small letters.
pub(super) type Names = BTreeMap<String, Declared>;

impl Declared {
    pub(super) fn new(at: usize, pose: Result<Pose, Text>) -> Self {
        Self {
            at,
            pose,
            mass_kg: None,
            is_none: false,
            stands: false,
        }
    }
}

/// How the pose of a target is to be read.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Placement {
    pub(super) base_from_frame: Pose,
    pub(super) tool_from_model: Pose,
}

/// The same, shared by the targets that are read alike; `None`: in the base, of the model's tool.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Placed(Option<Arc<Placement>>);

impl Placed {
    pub(super) fn new(placement: Placement) -> Self {
        Self((placement != Placement::default()).then(|| Arc::new(placement)))
    }

    pub(super) fn get(&self) -> Placement {
        self.0.as_deref().copied().unwrap_or_default()
    }

    /// Where a pose of the file puts the model's tool, in the robot's base.
    pub(super) fn goal(&self, written: &Goal) -> Goal {
        let rotation = written.rotation.unwrap_or_else(UnitQuaternion::identity);
        let pose = Pose::from_parts(written.position_mm.coords.into(), rotation);
        let placement = self.get();
        let pose = placement.base_from_frame * pose * placement.tool_from_model;
        Goal {
            position_mm: pose.translation.vector.into(),
            rotation: written.rotation.map(|_| pose.rotation),
        }
    }

    /// What the file writes for a pose of the model's tool in the robot's base.
    pub(super) fn written(&self, pose: &Pose) -> Pose {
        let placement = self.get();
        placement.base_from_frame.inverse() * pose * placement.tool_from_model.inverse()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_is_shown_as_it_is_written_and_found_whatever_its_capitals() {
        let tool = Referred::named("tGrip");
        assert_eq!(tool.to_string(), "tGrip");
        assert!(tool.is("TGRIP"));
    }
}
