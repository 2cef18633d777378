//! Plots as SVG files: the drawings of the report, of the samples as they are shown now, and the
//! charts as they are on the screen.

use crate::language::spoken;
use std::sync::Arc;

use crate::gui::cache::identified::Outcome;
use crate::gui::charts::{self, Pointed, find};
use crate::gui::core::document::Document;
use crate::gui::core::loaded_session::Component;
use crate::gui::view::Plot;
use crate::gui::workbench::{Draw, Workbench};
use crate::gui::workspace::{polar_sheet, space_sheet};
use crate::pipeline::verify;
use crate::present::chart::{Chart, FULL_WIDTH};
use crate::present::drawing::{Drawing, Label, MUTED};
use crate::report::plots::workspace;
use crate::report::{as_measured, stages};

/// A picture to be drawn.
struct PlotRequest {
    plot: Plot,
    document: Document,
    /// What was identified, if anything was.
    outcome: Option<Arc<Outcome>>,
    /// The component of the deviation that is looked at, and whether what is left alone.
    component: (Component, bool),
    /// The noise floor, where a search found it, mm.
    floor_mm: Option<f64>,
    /// The chart as it is shown, or why there is none, where it is one.
    chart: Option<Result<Chart, String>>,
}

/// A plot as it is now, to be drawn in the background.
pub(crate) fn drawing(workbench: &Workbench, plot: Plot) -> Draw {
    if plot == Plot::Space {
        // As it is seen now: few enough to be drawn at once.
        let sheet = space_sheet(workbench);
        return Box::new(move || sheet);
    }
    let shown = workbench.answer().is_some();
    let view = workbench.view();
    let wanted = PlotRequest {
        plot,
        document: workbench.document().clone(),
        outcome: workbench.last_outcome().filter(|_| shown).cloned(),
        component: (view.component, view.only_after),
        floor_mm: workbench.diagnosis().map(|d| d.floor.mm),
        chart: match plot {
            Plot::Chart(name) => Some(chart(workbench, name)),
            Plot::Workspace | Plot::Space | Plot::Polar => None,
        },
    };
    Box::new(move || draw(&wanted))
}

/// A chart as it is shown, of many samples with what is seen of them on paper.
fn chart(workbench: &Workbench, name: &str) -> Result<Chart, String> {
    let kind = find(name).ok_or(say!("there is no such chart"))?;
    let scene = workbench.scene_of(kind);
    let shown = charts::shown(kind, &scene).map_err(|missing| missing.title)?;
    let mut chart = shown.chart;
    if let Pointed::Samples(samples) = &shown.pointed {
        let [[from, _], [to, _]] = chart.bounds;
        chart.items.extend(samples.in_sight([from, to], FULL_WIDTH));
    }
    Ok(chart)
}

/// Room for a line below a drawing, points.
const CAPTION: f64 = 14.0;

/// The drawing, and what it shows.
fn draw(wanted: &PlotRequest) -> Result<(Drawing, String), String> {
    let session = wanted.document.session_to_save();
    let of = |what: &str| format!("{}: {what}", crate::report::document::clean(&session.name));
    if let Some(chart) = &wanted.chart {
        let chart = chart.as_ref().map_err(Clone::clone)?;
        let session = crate::report::document::clean(&session.name);
        return Ok((chart.on_paper(&session), of(&chart.title)));
    }
    let answer = match &wanted.outcome {
        Some(outcome) => Some(outcome.answer.as_ref().map_err(Clone::clone)?),
        None => None,
    };
    if session.samples.is_empty() {
        return Err(say!("there are no samples to draw").to_owned());
    }
    if wanted.plot == Plot::Polar {
        let (subject, tolerance) = (&wanted.document.subject, wanted.document.tolerance_mm);
        let (component, only_after) = wanted.component;
        let drawing = polar_sheet(subject, answer, component, only_after, tolerance)?;
        return Ok((drawing, of(say!("the deviation around the angle"))));
    }
    let stages = match answer {
        None => as_measured(&session, wanted.floor_mm),
        Some(answer) => {
            let calibration = &answer.calibration;
            let verification = verify(calibration, &session).map_err(|e| spoken(e.says()))?;
            stages(&session, calibration, &verification, wanted.floor_mm)
                .map_err(|e| e.to_string())?
        }
    };
    let (mut drawing, magnification) = workspace(&stages);
    let says = of(&say!(
        "measured points, deviations magnified {magnification} times",
        magnification = magnification
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
