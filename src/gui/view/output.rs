//! What can be exported.

use crate::gui::core::document::plain;

use super::Chart;

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
    /// A chart, as it is shown.
    Chart(Chart),
    /// A component of the deviation around the joint's angle.
    Polar,
}

impl Plot {
    pub(crate) const ALL: [Self; 11] = [
        Self::Workspace,
        Self::Chart(Chart::Angle),
        Self::Chart(Chart::Gap),
        Self::Chart(Chart::Time),
        Self::Chart(Chart::Load),
        Self::Chart(Chart::Temperature),
        Self::Chart(Chart::Orders),
        Self::Chart(Chart::Histogram),
        Self::Chart(Chart::Effect),
        Self::Chart(Chart::Table),
        Self::Polar,
    ];

    /// Its name, as it stands within a sentence.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Workspace => "workspace",
            Self::Chart(Chart::Angle) => "deviation",
            Self::Chart(Chart::Gap) => "gap by step",
            Self::Chart(Chart::Time) => "deviation over time",
            Self::Chart(Chart::Load) => "deviation over load",
            Self::Chart(Chart::Temperature) => "deviation over temperature",
            Self::Chart(Chart::Orders) => "order spectrum",
            Self::Chart(Chart::Histogram) => "histogram",
            Self::Chart(Chart::Effect) => "effect's curve",
            Self::Chart(Chart::Table) => "correction table",
            Self::Polar => "polar",
        }
    }

    /// What its file is called unless the user says otherwise.
    pub(crate) fn file_name(self, session: &str) -> String {
        let session = plain(session);
        format!("{session}-{}.svg", plain(self.name()))
    }
}
