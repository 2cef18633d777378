//! Files that a controller, or a program around it, reads.
//!
//! # To add a format
//! Write one file like its neighbours (a type with the trait [`Exporter`]) and add one line to
//! [`EXPORTERS`]. The terminal, the window and the report find it there.
//!
//! # Signs
//! The trap of every compensation table is its sign. Here everything starts from the correction:
//! what to add to the command. Each format says in its sidecar what its numbers mean, with one
//! worked line. And each reads its own bytes back: [`Export::reads_as`] is what the controller will
//! make of them, [`gap_left`] the gap that it leaves.

mod c_header;
mod csv;
mod read_back;
pub(crate) mod sidecar;

pub use read_back::{ReadBack, gap_left};

use crate::compensation::{Conditions, JointTable, TableError};
use crate::model::Calibration;
use crate::sessions::Session;

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
    pub title: &'static str,
    /// The usual ending of its files.
    pub extension: &'static str,
    /// What makes it.
    pub exporter: &'static dyn Exporter,
}

/// Every format.
pub const EXPORTERS: &[Format] = &[csv::FORMAT, c_header::FORMAT];

/// The format of this name.
pub fn find(id: &str) -> Option<&'static Format> {
    EXPORTERS.iter().find(|format| format.id == id)
}

/// Step of a table where nobody gives one, degrees or mm.
pub const DEFAULT_STEP: f64 = 1.0;

/// What is to be exported.
#[derive(Debug, Clone, Copy)]
pub struct Job<'a> {
    /// The model.
    pub calibration: &'a Calibration,
    /// Joint, counted from 0.
    pub joint: usize,
    /// Step of the table, degrees or mm.
    pub step: f64,
    /// Conditions that the table is made for.
    pub conditions: Conditions,
    /// Name of the file to be written, without its folder.
    pub file_name: &'a str,
}

impl<'a> Job<'a> {
    /// The first joint in steps of [`DEFAULT_STEP`] under the reference conditions.
    pub fn new(calibration: &'a Calibration, file_name: &'a str) -> Self {
        Self {
            calibration,
            joint: 0,
            step: DEFAULT_STEP,
            conditions: Conditions::default(),
            file_name,
        }
    }

    /// The joint's table.
    ///
    /// # Errors
    /// See [`TableError`].
    pub fn table(&self) -> Result<JointTable, TableError> {
        JointTable::new(self.calibration, self.joint, self.step, self.conditions)
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

/// What an exporter has made. The first document is the one that was asked for, the others stand
/// beside it.
#[derive(Debug, Clone, PartialEq)]
pub struct Export {
    /// The documents.
    pub documents: Vec<Document>,
    /// What the first document says when it is read back; `None` for formats without a table.
    pub reads_as: Option<ReadBack>,
    /// What the user should know.
    pub notes: Vec<String>,
}

/// Why there is no export.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum ExportError {
    /// There is no table.
    #[error("{0}")]
    Table(#[from] TableError),
    /// The format cannot say it.
    #[error("{0}")]
    Refused(String),
    /// What was written does not read as what was meant: a bug, and nothing is written.
    #[error("the file does not read back as it should: {0}")]
    ReadBack(String),
}

/// The gap of a session under an export's table, if it has one: see [`gap_left`].
pub fn gap_after_export(
    calibration: &Calibration,
    session: &Session,
    export: &Export,
) -> Option<crate::identification::gap::Spread> {
    gap_left(calibration, session, export.reads_as.as_ref()?)
}

#[cfg(test)]
mod tests;
