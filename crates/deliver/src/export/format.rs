//! The formats that there are.

use crate::kinematics::Robot;
use crate::text::Template;

use super::job::{ExportError, Job};
use super::made::Export;
use super::options::{Asked, Zeros};
use super::rules::Rules;
use super::table_file::TableFile;

/// A format that models are exported to.
#[derive(Clone, Copy)]
pub struct Format {
    /// Name for `--to`.
    pub id: &'static str,
    /// Name in words.
    pub title: Template,
    /// The usual ending of its files.
    pub extension: &'static str,
    /// Whether it is for robots like this one. (Others are refused, or have something simpler.)
    pub suits: fn(&Robot) -> bool,
    /// What it can be told beside the model, for a robot.
    pub asks: fn(&Robot) -> Asked,
    pub(super) makes: Makes,
}

/// What makes the documents.
#[derive(Clone, Copy)]
pub(super) enum Makes {
    Table(&'static TableFile),
    Description(fn(&Job) -> Result<Export, ExportError>),
}

impl Format {
    /// A table, whose rules hold its name.
    pub(super) const fn table(
        title: Template,
        extension: &'static str,
        table: &'static TableFile,
    ) -> Self {
        Self {
            id: table.rules.format,
            title,
            extension,
            suits: any_robot,
            asks: |_| Asked::default(),
            makes: Makes::Table(table),
        }
    }

    /// What it is, where it is a table.
    pub fn rules(&self) -> Option<&'static Rules> {
        match self.makes {
            Makes::Table(table) => Some(table.rules),
            Makes::Description(_) => None,
        }
    }

    /// Makes the documents.
    ///
    /// # Errors
    /// What the format cannot say is refused, never cut off.
    pub fn export(&self, job: &Job) -> Result<Export, ExportError> {
        match self.makes {
            Makes::Table(table) => table.export(job),
            Makes::Description(export) => export(job),
        }
    }
}

/// What is asked where the zero offsets have a place in the file.
pub(super) fn zeros(_: &Robot) -> Asked {
    Asked {
        zeros: Some(Zeros::default()),
        ..Asked::default()
    }
}

pub(super) fn any_robot(_: &Robot) -> bool {
    true
}

pub(super) fn several_joints(robot: &Robot) -> bool {
    robot.joints.len() > 1
}
