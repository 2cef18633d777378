//! Files that a controller, or a program around it, reads.
//!
//! # To add a format
//! Write one file like its neighbours and add one line to the register; the terminal, the window
//! and the report find it there. `docs/extending.md` goes through an example. A table says what it is in a [`Rules`] (sign, digits, grid, limits,
//! directions, ends, turns) and brings a function that writes and one that reads; choosing the
//! entries, checking, and saying what the controller leaves is the same for all. A description of
//! the corrected robot writes a `chain` and reads it back (`description`), as the URDF does.
//!
//! # Signs
//! The trap of every compensation table is its sign. Here everything starts from the correction:
//! what to add to the command. [`Rules::says`] turns it into the file's numbers and back, and
//! nothing else does. Each format says in its sidecar what its numbers mean, with one worked line.
//! And each reads its own bytes back: [`Export::reads_as`] is what the controller will make of them,
//! [`gap_left`] the RMS error that it leaves on a session, [`Left`] what it leaves over the measured range.

mod chain;
mod corrected;
mod description;
mod dh_rows;
mod euler;
mod grid;
mod knots;
mod left;
mod names;
mod options;
mod read_back;
mod rules;
mod sheet;
pub(crate) mod sidecar;
mod steps;
mod table_file;

#[cfg(feature = "gui")]
pub(crate) use dh_rows::nominal_rows;
pub use left::{Allowance, Left};
pub use lerobot::lerobot_calibration;
pub use options::{Motors, Options, Reference, Zeros};
pub use read_back::{ReadBack, gap_left, gap_to, gap_without};
pub use rules::{Directions, Rules, Says, Spacing};
pub use sheet::Sheet;

use crate::compensation::{Conditions, JointTable, TableError, VerifiedCalibration};
use crate::fit::gap::Spread;
use crate::kinematics::Robot;
use crate::model::Calibration;
use crate::sessions::Session;
use crate::text::{Template, Text};

/// A format that models are exported to.
pub trait Exporter: Sync {
    /// Makes the documents.
    ///
    /// # Errors
    /// What the format cannot say is refused, never cut off.
    fn export(&self, job: &Job) -> Result<Export, ExportError>;
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

/// Makes the modules and the list of the names given, so that a format is registered in one line.
macro_rules! register {
    ($($name:ident),* $(,)?) => {
        $(mod $name;)*
        /// Every format, in the order in which lists show them.
        pub const EXPORTERS: &[Format] = &[$($name::FORMAT),*];
    };
}

// rustfmt does not see through the macro: scripts/check names the files to it.
register! {
    csv,
    c_header,
    linuxcnc,
    twincat_nc,
    twincat_cnc,
    sinumerik,
    urdf,
    mjcf,
    dh,
    ur_kinematics,
    frames,
    lerobot,
    tpoint,
}

fn any_robot(_: &Robot) -> bool {
    true
}

fn several_joints(robot: &Robot) -> bool {
    robot.joints.len() > 1
}

/// The format of this name.
pub fn find(id: &str) -> Option<&'static Format> {
    EXPORTERS.iter().find(|format| format.id == id)
}

/// The format that is offered first: a table over the joint of a robot with one, and of several what
/// every controller takes, as a table over one of their joints leaves most of their geometry.
pub fn usual(robot: &Robot) -> &'static Format {
    let of_several = several_joints(robot).then(|| find(frames::FORMAT.id));
    of_several.flatten().unwrap_or(&EXPORTERS[0])
}

/// What is to be exported.
#[derive(Debug, Clone, Copy)]
pub struct Job<'a> {
    /// The model.
    pub calibration: &'a VerifiedCalibration,
    /// Joint, counted from 0.
    pub joint: usize,
    /// Step of the table, degrees or mm; `None`: what the format needs.
    pub step: Option<f64>,
    /// Conditions that the table is made for.
    pub conditions: Conditions,
    /// Name of the file to be written, without its folder.
    pub file_name: &'a str,
    /// What a description of the robot is asked for besides.
    pub options: Options<'a>,
}

impl<'a> Job<'a> {
    /// The first joint under the reference conditions, in the steps that it needs.
    pub fn new(calibration: &'a VerifiedCalibration, file_name: &'a str) -> Self {
        Self {
            calibration,
            joint: 0,
            step: None,
            conditions: Conditions::default(),
            file_name,
            options: Options::default(),
        }
    }

    /// The joint's exact correction in this step, degrees or mm.
    ///
    /// # Errors
    /// See [`TableError`].
    pub fn table(&self, step: f64) -> Result<JointTable, TableError> {
        JointTable::new(self.calibration, self.joint, step, self.conditions)
    }
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
    fn with_sidecar(name: &str, bytes: Vec<u8>, sidecar: Vec<u8>) -> Vec<Self> {
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
    pub left: Option<Left>,
    /// What the numbers of the first document mean: their sign, an example, what to enter.
    pub meaning: Vec<Text>,
    /// What the user should know.
    pub notes: Vec<Text>,
}

/// The RMS errors of a session as it stands and under an export, mm, where both can be said.
pub fn gaps_of_export(
    calibration: &Calibration,
    session: &Session,
    export: &Export,
) -> Option<[Spread; 2]> {
    let after = gap_after_export(calibration, session, export)?;
    let before = match (&export.reads_as, &export.robot) {
        (None, Some(_)) => gap_to(calibration, session, &calibration.model.robot),
        _ => gap_without(calibration, session),
    };
    Some([before?, after])
}

/// Why there is no export.
#[derive(Debug, Clone, PartialEq)]
pub enum ExportError {
    /// There is no table.
    Table(TableError),
    /// The format cannot say it.
    Refused(Text),
    /// The session is better without it.
    MakesWorse {
        /// Name of the session.
        session: String,
        /// Table, or description of the robot.
        what: Template,
        /// As it stands, mm.
        before_mm: f64,
        /// With the export, mm.
        after_mm: f64,
    },
    /// What was written does not read as what was meant: a bug, and nothing is written.
    ReadBack(String),
}

impl ExportError {
    /// In words.
    pub fn says(&self) -> Text {
        match self {
            Self::Table(given) => given.says(),
            Self::Refused(says) => says.clone(),
            Self::MakesWorse {
                session,
                what,
                before_mm,
                after_mm,
            } => text!(
                "with this {what} the RMS error of '{session}' would rise from {before_mm} to {after_mm} mm: nothing is written",
                what = what,
                session = session,
                before_mm = format!("{:.6}", before_mm),
                after_mm = format!("{:.6}", after_mm)
            ),
            Self::ReadBack(what) => text!(
                "the file does not read back as it should: {what}",
                what = what
            ),
        }
    }
}

displays_what_it_says!(ExportError);

impl std::error::Error for ExportError {}

impl From<TableError> for ExportError {
    fn from(error: TableError) -> Self {
        Self::Table(error)
    }
}

/// The gap of a session under an export: with its table (see [`gap_left`]), or to its robot.
pub fn gap_after_export(
    calibration: &Calibration,
    session: &Session,
    export: &Export,
) -> Option<Spread> {
    match (&export.reads_as, &export.robot) {
        (Some(table), _) => gap_left(calibration, session, table),
        (None, Some(robot)) => gap_to(calibration, session, robot),
        (None, None) => None,
    }
}

#[cfg(test)]
mod tests;
