//! What an exporter is given, and why it makes nothing.

use crate::compensation::{Conditions, JointTable, TableError, VerifiedCalibration};
use crate::text::Text;
use crate::text::length;

use super::options::Options;

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
        is_table: bool,
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
    pub fn describe(&self) -> Text {
        match self {
            Self::Table(given) => given.describe(),
            Self::Refused(says) => says.clone(),
            Self::MakesWorse {
                session,
                before_mm,
                after_mm,
                ..
            } => text!(
                "with this the RMS error of '{session}' would rise from {before_mm} to {after_mm}: nothing is written",
                session,
                before_mm = length(before_mm, 6),
                after_mm = length(after_mm, 6)
            ),
            Self::ReadBack(what) => text!("what was written reads back differently: {what}", what),
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
