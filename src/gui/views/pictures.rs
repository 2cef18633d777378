//! Plots as SVG files: the drawings of the report, of the samples as they are shown now, and the
//! charts as they are on the screen.

use std::sync::Arc;

use crate::gui::cache::identified::Outcome;
use crate::gui::core::document::Document;
use crate::gui::core::loaded_session::Component;
use crate::gui::plots::chart_spec::Sketch;
use crate::gui::view::{Chart, Plot};
use crate::gui::workbench::{Draw, Workbench};
use crate::gui::workspace::polar_sheet;
use crate::pipeline::verify;
use crate::report::drawing::{Drawing, Label, MUTED};
use crate::report::plots::{waterfall, workspace};
use crate::report::{as_measured, stages};

use super::charts;

/// A picture to be drawn.
struct Wanted {
    plot: Plot,
    document: Document,
    /// What was identified, if anything was.
    outcome: Option<Arc<Outcome>>,
    /// The component of the deviation that is looked at, and whether what is left alone.
    component: (Component, bool),
    /// The noise floor, where a search found it, mm.
    floor_mm: Option<f64>,
    /// The chart as it is shown, where it is one that is.
    sketch: Option<Sketch>,
}

/// A plot as it is now, to be drawn in the background.
pub(crate) fn drawing(workbench: &Workbench, plot: Plot) -> Draw {
    let shown = workbench.answer().is_some();
    let view = workbench.view();
    let wanted = Wanted {
        plot,
        document: workbench.document().clone(),
        outcome: workbench.last_outcome().filter(|_| shown).cloned(),
        component: (view.component, view.only_after),
        floor_mm: workbench.diagnosis().map(|d| d.floor.mm),
        sketch: charts::sketch(workbench, plot),
    };
    Box::new(move || draw(&wanted))
}

/// Room for a line below a drawing, points.
const CAPTION: f64 = 14.0;

/// The drawing, and what it shows.
fn draw(wanted: &Wanted) -> Result<(Drawing, String), String> {
    let session = wanted.document.session_to_save();
    let of = |what: &str| format!("{}: {what}", crate::report::document::clean(&session.name));
    if let Some(sketch) = &wanted.sketch {
        let title = of(&sketch.title);
        let session = crate::report::document::clean(&session.name);
        return Ok((sketch.on_paper(&session), title));
    }
    match wanted.plot {
        Plot::Workspace | Plot::Polar | Plot::Chart(Chart::Angle | Chart::Gap) => {}
        Plot::Chart(_) => return Err("this chart has nothing to show yet".to_owned()),
    }
    let answer = match &wanted.outcome {
        Some(outcome) => Some(outcome.answer.as_ref().map_err(Clone::clone)?),
        None => None,
    };
    if wanted.plot == Plot::Chart(Chart::Gap) {
        let answer = answer.ok_or("nothing is identified yet")?;
        let steps = &answer.calibration.history;
        let drawing = waterfall(steps, wanted.floor_mm, session.tolerance_mm);
        return Ok((drawing, of("the gap step by step")));
    }
    if session.samples.is_empty() || wanted.plot == Plot::Chart(Chart::Angle) {
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
