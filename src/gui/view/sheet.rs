//! What lies over the window: sheets, and what waits for their answer; messages, of which an error is
//! shown until it is dismissed and a task that is done for some seconds. And what can be exported, for which a sheet
//! asks the path.

use std::path::{Path, PathBuf};

use crate::language::known_words;

use crate::gui::core::disk::name_of;
use crate::gui::core::document::plain;
use crate::gui::core::robot_table::RobotTable;
use crate::gui::core::simulate::Form;
use crate::gui::import_draft::ImportDraft;

/// A sheet over the window.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Sheet {
    /// A path to save to, as it is typed.
    SavePath {
        path: String,
        /// Whether a file that is there may be replaced.
        replace: bool,
    },
    /// A path to export to, as it is typed.
    ExportPath {
        what: What,
        path: String,
        /// Whether a file that is there may be replaced.
        replace: bool,
    },
    /// A simulation, as it is filled in.
    Simulate(Form),
    /// A robot, as its table is typed.
    RobotTable {
        table: Box<RobotTable>,
        /// As it was opened.
        opened: Box<RobotTable>,
    },
    /// Whether what was typed on this one is discarded.
    Discard(Box<Self>),
    /// What is lost if this is done now.
    Unsaved(NextAction),
    /// This file is not what it was when it was read: whether to replace it all the same.
    Overwrite(PathBuf),
    /// A file that an instrument wrote.
    Import(Box<ImportDraft>),
    /// One that keeps nothing of its own: its file in `dialogs`.
    Named(&'static str),
}

impl Sheet {
    /// Targets that were corrected.
    pub(crate) const COMPENSATION: Self = Self::Named("compensation");
    /// What the report states besides its measurements.
    pub(crate) const DETAILS: Self = Self::Named("details");
    /// What became of the machine.
    pub(crate) const HISTORY: Self = Self::Named("history");
    /// The library of robots.
    pub(crate) const ROBOTS: Self = Self::Named("robots");
    /// What windows that are gone have left behind.
    pub(crate) const RECOVERY: Self = Self::Named("recovery");

    /// The sheet that it was opened from: what one comes back to without an answer.
    pub(crate) fn before(&self) -> Option<Self> {
        match self {
            Self::Simulate(form) => form.robot.is_some().then_some(Self::ROBOTS),
            Self::RobotTable { .. } => Some(Self::ROBOTS),
            Self::Discard(typed) => Some((**typed).clone()),
            _ => None,
        }
    }

    /// Where Escape leads: what was typed is not discarded without a question.
    pub(crate) fn escaped(&self) -> Option<Self> {
        let typed = match self {
            Self::Simulate(form) => *form != form.untouched(),
            Self::RobotTable { table, opened } => table != opened,
            _ => false,
        };
        if typed {
            Some(Self::Discard(Box::new(self.clone())))
        } else {
            self.before()
        }
    }

    /// Whether it has many fields: Escape leaves the one that is typed into, and only then the sheet.
    pub(crate) fn is_a_form(&self) -> bool {
        matches!(
            self,
            Self::Simulate(_) | Self::RobotTable { .. } | Self::Import(_) | &Self::DETAILS
        )
    }

    /// Whether it holds what was typed or chosen in it. A click beside it, which may be meant for something else, does
    /// not close it; Escape and *Cancel* do.
    pub(crate) fn holds_entries(&self) -> bool {
        match self {
            Self::SavePath { .. }
            | Self::ExportPath { .. }
            | Self::Simulate(_)
            | Self::RobotTable { .. }
            | Self::Discard(_)
            | Self::Unsaved(_)
            | Self::Overwrite(_)
            | Self::Import(_) => true,
            Self::Named(name) => ["compensation", "details", "recovery"].contains(name),
        }
    }
}

/// What is done next, when nothing is in the way any more.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum NextAction {
    Leave,
    Open(PathBuf),
    Example(usize),
    Simulate(Form),
}

/// A message to the user: an error that stays, or a notice that goes by itself.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Message {
    /// Whether something went wrong.
    pub(crate) wrong: bool,
    /// In one line.
    pub(crate) title: String,
    /// What exactly, and what to do next; one line each.
    pub(crate) details: Vec<String>,
    /// The file that was written.
    pub(crate) file: Option<PathBuf>,
}

impl Message {
    /// Something went wrong.
    pub(crate) fn wrong(title: impl Into<String>, details: Vec<String>) -> Self {
        Self {
            wrong: true,
            ..Self::done(title, details)
        }
    }

    /// Something was done.
    pub(crate) fn done(title: impl Into<String>, details: Vec<String>) -> Self {
        Self {
            wrong: false,
            title: title.into(),
            details,
            file: None,
        }
    }

    /// A file was written.
    pub(crate) fn saved(path: &Path, details: Vec<String>) -> Self {
        let whole = std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
        Self {
            file: Some(whole),
            ..Self::done(say!("Saved {name}", name = name_of(path)), details)
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum What {
    /// The table for the controller.
    Table,
    /// The model itself.
    Model,
    /// Poses to measure next.
    Poses,
    /// The calibration report.
    Report(About),
    Picture(Plot),
    /// What the chart of this name shows, as a table.
    Numbers(&'static str),
    /// A table of targets or a robot program, corrected.
    Targets,
    /// A robot of the library, by its name.
    Robot(&'static str),
    /// The robot that was typed last.
    TypedRobot,
}

/// What a report is about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum About {
    /// The session: what was measured, what was found, what stays open.
    Session,
    /// The model that is exported, by itself.
    Model,
}

/// A plot that can be saved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Plot {
    /// Where the points are, and how far off, as it is seen.
    Workspace,
    /// The chart of this name, as it is shown.
    Chart(&'static str),
}

impl Plot {
    /// Its name, as it stands within a sentence.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Workspace => "workspace",
            Self::Chart(name) => name,
        }
    }

    /// What its file ends in: a chart is drawn, the workspace is a picture of the screen.
    pub(crate) fn ending(self) -> &'static str {
        match self {
            Self::Workspace => "png",
            Self::Chart(_) => "svg",
        }
    }

    /// Its name in the language of the window.
    pub(crate) fn title(self) -> String {
        known_words("plot", self.name()).unwrap_or_else(|| self.name().to_owned())
    }

    /// What its file is called unless the user says otherwise.
    pub(crate) fn file_name(self, session: &str, ending: &str) -> String {
        let session = plain(session);
        format!("{session}-{}.{ending}", plain(self.name()))
    }
}
