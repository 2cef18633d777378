//! What makes a file for a controller, and what it has made.

use crate::kinematics::Robot;
use crate::text::{Template, Text};

use super::job::{ExportError, Job};
use super::options::Asked;
use super::read_back::ReadBack;
use super::residual_error::ResidualError;
use super::rules::Rules;

/// A format that models are exported to.
pub trait Exporter: Sync {
    /// Makes the documents.
    ///
    /// # Errors
    /// What the format cannot say is refused, never cut off.
    fn export(&self, job: &Job) -> Result<Export, ExportError>;

    /// What it can be told beside the model, for a robot.
    fn asks(&self, _robot: &Robot) -> Asked {
        Asked::default()
    }
}

/// An entry of the list of formats.
#[derive(Clone, Copy)]
pub struct Format {
    /// Name for `--to`.
    pub id: &'static str,
    /// Name in words.
    pub title: Template,
    /// The usual ending of its files.
    pub extension: &'static str,
    /// What it is, where it is a table.
    pub rules: Option<&'static Rules>,
    /// Whether it is for robots like this one. (Others are refused, or have something simpler.)
    pub suits: fn(&Robot) -> bool,
    /// What makes it.
    pub exporter: &'static dyn Exporter,
}

impl Format {
    /// What it can be told beside the model, for a robot.
    pub fn asks(&self, robot: &Robot) -> Asked {
        self.exporter.asks(robot)
    }
}

pub(super) fn any_robot(_: &Robot) -> bool {
    true
}

pub(super) fn several_joints(robot: &Robot) -> bool {
    robot.joints.len() > 1
}

/// A file to be written.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Document {
    /// Its name, without a folder.
    pub name: String,
    /// Its content.
    pub bytes: Vec<u8>,
}

impl Document {
    /// A file under the name that was asked for, and beside it what its numbers mean.
    pub(super) fn with_sidecar(name: &str, bytes: Vec<u8>, sidecar: Vec<u8>) -> Vec<Self> {
        let document = |name: String, bytes| Self { name, bytes };
        vec![
            document(name.to_owned(), bytes),
            document(format!("{name}.meta.json"), sidecar),
        ]
    }
}

/// What an exporter has made. The first document is the one that was asked for, the others stand
/// beside it.
#[derive(Debug, Clone, PartialEq)]
pub struct Export {
    /// The documents.
    pub documents: Vec<Document>,
    /// What the first document says when it is read back; `None` for formats without a table.
    pub reads_as: Option<ReadBack>,
    /// The robot that the first document describes, where it describes one.
    pub robot: Option<Robot>,
    /// What the controller leaves over the measured range; `None` for formats without a table.
    pub left: Option<ResidualError>,
    /// What the numbers of the first document mean: their sign, an example, what to enter.
    pub meaning: Vec<Text>,
    /// What the user should know.
    pub notes: Vec<Text>,
    /// Those of the notes that are about what is not correctable by joint commands over the measured range; where the
    /// same is stated of a session they are left out.
    pub stays: Vec<Text>,
}
