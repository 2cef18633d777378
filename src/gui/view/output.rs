//! What can be exported.

use crate::gui::core::document::plain;
use crate::language::known_words;

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
    /// Where the points are, and how far off.
    Workspace,
    /// The chart of this name, as it is shown.
    Chart(&'static str),
    /// The same in three dimensions, as it is seen.
    Space,
    /// A component of the deviation around the joint's angle.
    Polar,
}

impl Plot {
    /// Its name, as it stands within a sentence.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Workspace => "workspace",
            Self::Chart(name) => name,
            Self::Space => "3-D view",
            Self::Polar => "polar",
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
