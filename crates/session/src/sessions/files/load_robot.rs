//! From a file, or from memory, to a robot and what is worth knowing about it.

use std::path::Path;

use crate::diagnostic::{Diagnostic, Place, Rejected};
use crate::document::{Fields, Path as JsonPath};
use crate::kinematics::Robot;
use crate::sessions::files::format_v1::robot::ROBOT;
use crate::sessions::files::load::accept;
use crate::sessions::files::open;
use crate::sessions::validation;

/// A robot and the notes and warnings that came up on the way.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadedRobot {
    /// What the file says.
    pub robot: Robot,
    /// Notes and warnings, in the order of the input; no errors.
    pub findings: Vec<Diagnostic>,
}

/// Reads a robot: the `robot` object of a session, in a file of its own.
///
/// # Errors
/// As [`load`](crate::sessions::load()).
pub fn load_robot(path: impl AsRef<Path>) -> Result<LoadedRobot, Rejected> {
    let path = path.as_ref();
    let bytes = open::read_document(path)?;
    read_robot(Some(path), &bytes)
}

/// Reads a robot that needs no other file.
///
/// # Errors
/// As [`load`](crate::sessions::load()).
pub fn parse_robot(document: &[u8]) -> Result<LoadedRobot, Rejected> {
    read_robot(None, document)
}

fn read_robot(path: Option<&Path>, bytes: &[u8]) -> Result<LoadedRobot, Rejected> {
    let place = path.map(Place::file).unwrap_or_default();
    let text = open::as_text(bytes, &place)?;
    let (mut fields, root) = Fields::open(place, text)?;
    let robot = ROBOT.read(&mut fields, &root, &JsonPath::Root);
    if let Some(robot) = &robot {
        validation::robot(
            robot,
            &fields.place(root.at, &JsonPath::Root),
            &mut fields.findings,
        );
    }
    let findings = accept(fields.findings)?;
    match robot {
        Some(robot) => Ok(LoadedRobot { robot, findings }),
        None => Err(Rejected::of(findings)),
    }
}
