//! Plots as SVG files: the drawings of the report, of the samples as they are shown now, and the
//! charts as they are on the screen.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::compensation::verify;
use crate::report::drawing::{Drawing, Label, MUTED};
use crate::report::plots::{waterfall, workspace};
use crate::report::svg::svg_file;
use crate::report::{as_measured, stages};

use super::document::Document;
use super::files;
use super::outcome::Outcome;
use super::plots::sketch::Sketch;
use super::plots::workspace::polar_sheet;
use super::subject::Component;
use super::tasks::{Report, Watch};
use super::view::{Chart, Message};

/// A plot that can be saved.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Plot {
    /// Where the points are, and how far off.
    Workspace,
    /// The deviation over the joint's value.
    Deviation,
    /// The gap, step by step.
    Waterfall,
    /// Another chart, as it is shown.
    Chart(Chart),
    /// A component of the deviation around the joint's angle.
    Polar,
}

impl Plot {
    /// All of them.
    pub(crate) const ALL: [Self; 11] = [
        Self::Workspace,
        Self::Deviation,
        Self::Waterfall,
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
            Self::Deviation | Self::Chart(Chart::Angle) => "deviation",
            Self::Waterfall | Self::Chart(Chart::Gap) => "gap by step",
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
        let session = super::document::plain(session);
        format!("{session}-{}.svg", super::document::plain(self.name()))
    }
}

/// A picture to be written.
#[derive(Debug, Clone)]
pub(crate) struct Wanted {
    /// Of which plot.
    pub(crate) plot: Plot,
    /// The session.
    pub(crate) document: Arc<Document>,
    /// What was identified, if anything was.
    pub(crate) outcome: Option<Arc<Outcome>>,
    /// The component of the deviation that is looked at, and whether what is left alone.
    pub(crate) component: (Component, bool),
    /// The noise floor, where a search found it, mm.
    pub(crate) floor_mm: Option<f64>,
    /// The chart as it is shown, where it is one that is.
    pub(crate) sketch: Option<Sketch>,
    /// Files that it may not replace.
    pub(crate) inputs: Vec<PathBuf>,
}

/// Room for a line below a drawing, points.
const CAPTION: f64 = 14.0;

/// Writes it, whole or not at all.
pub(crate) fn write(wanted: &Wanted, path: &Path, replace: bool, watch: &Watch) -> Report {
    let written = make(wanted, path, replace).and_then(|svg| {
        let bytes = svg.as_bytes();
        files::write_one(path, replace, bytes, watch)
    });
    Report::Written(match written {
        Ok(()) => Message {
            wrong: false,
            title: format!("Saved {}", path.display()),
            details: Vec::new(),
        },
        Err(problem) => files::not_written(path, problem),
    })
}

fn make(wanted: &Wanted, path: &Path, replace: bool) -> Result<String, String> {
    if files::ending(path).as_deref() != Some("svg") {
        return Err("expected a file name that ends in .svg".to_owned());
    }
    files::can_be_written(path, replace, &wanted.inputs)?;
    let (drawing, title) = draw(wanted)?;
    Ok(svg_file(&drawing, &title))
}

/// The drawing, and what it shows.
fn draw(wanted: &Wanted) -> Result<(Drawing, String), String> {
    let session = wanted.document.session_to_save();
    let of = |what: &str| format!("{}: {what}", crate::report::document::clean(&session.name));
    if let Some(sketch) = &wanted.sketch {
        let title = of(&sketch.title);
        let session = crate::report::document::clean(&session.name);
        return Ok((sketch.on_paper(&session), title));
    }
    if let Plot::Chart(_) = wanted.plot {
        return Err("this chart has nothing to show yet".to_owned());
    }
    let answer = match &wanted.outcome {
        Some(outcome) => Some(outcome.answer.as_ref().map_err(Clone::clone)?),
        None => None,
    };
    if wanted.plot == Plot::Waterfall {
        let answer = answer.ok_or("nothing is identified yet")?;
        let steps = &answer.calibration.history;
        let drawing = waterfall(steps, wanted.floor_mm, session.tolerance_mm);
        return Ok((drawing, of("the gap step by step")));
    }
    if session.samples.is_empty() || wanted.plot == Plot::Deviation {
        return Err("there are no samples to draw".to_owned());
    }
    if wanted.plot == Plot::Polar {
        let (subject, tolerance) = (&wanted.document.subject, wanted.document.tolerance_mm);
        let (component, only_after) = wanted.component;
        let drawing = polar_sheet(subject, answer, component, only_after, tolerance)?;
        return Ok((drawing, of("the deviation around the angle")));
    }
    let stages = match answer {
        None => as_measured(&session, wanted.floor_mm),
        Some(answer) => {
            let calibration = &answer.calibration;
            let verification = verify(calibration, &session).map_err(|e| e.to_string())?;
            stages(&session, calibration, &verification, wanted.floor_mm)
                .map_err(|e| e.to_string())?
        }
    };
    let (mut drawing, magnification) = workspace(&stages);
    let says = of(&format!(
        "measured points, deviations magnified {magnification} times"
    ));
    drawing.height += CAPTION;
    drawing.text(Label::new(
        [0.0, drawing.height - 4.0],
        says.clone(),
        7.0,
        MUTED,
    ));
    Ok((drawing, says))
}
