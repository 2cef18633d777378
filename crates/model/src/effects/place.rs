//! A place that measurements refer to, and what is the same of every one.

use super::Placed;
use super::about::{About, Owner, Role, Setting, Stage};
use super::block::Block;

/// What kind of place.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum PlaceKind {
    /// A fixed point from which distances are measured, and what the instrument adds.
    Anchor,
    /// The place of an instrument of directions, and its orientation.
    Station,
    /// A flat.
    Plane,
    /// A point in which a target sits.
    Socket,
}

/// One place of a session.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Place {
    /// What kind of place.
    pub kind: PlaceKind,
    /// Its index among those of its kind.
    pub index: usize,
}

/// Most coefficients that a place has.
pub const MOST: usize = 6;

/// What is the same for every place; its file has the rest.
pub(super) const ABOUT: About = About {
    stage: Stage::World,
    setting: Setting::Place,
    source: "what the measurements refer to",
    cause: phrase!("the session does not say where it is"),
    usual_size: phrase!("any"),
    confused_with: phrase!("the base of the robot, where nothing else says where that stands"),
    check: phrase!("measure it with another instrument"),
    role: Role::Place,
    owner: Owner::Session,
    per_joint: false,
    ..About::PLAIN
};

/// The robot does not depend on where it is measured from.
pub(super) const NOTHING: fn(&Placed, &mut Block) = |_, _| {};
