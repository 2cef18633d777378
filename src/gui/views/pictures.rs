//! Plots as pictures: the workspace from its scene, and the charts, as they are on the screen.

use crate::gui::charts::{self, HoverTarget, find};
use crate::gui::view::Plot;
use crate::gui::workbench::{Draw, Workbench};
use crate::gui::workspace::{plane_sheet, polar_sheet, space_sheet};
use crate::present::chart::{Chart, FULL_WIDTH};

/// A plot as it is now; of many samples few enough are seen to be drawn at once.
pub(crate) fn drawing(workbench: &Workbench, plot: Plot) -> Draw {
    let sheet = match plot {
        Plot::Workspace => plane_sheet(workbench),
        Plot::Space => space_sheet(workbench),
        Plot::Polar => polar_sheet(workbench),
        Plot::Chart(name) => chart(workbench, name).map(|chart| {
            let session = crate::report::document::clean(&workbench.loaded_session().session.name);
            let says = format!("{session}: {}", chart.title);
            (chart.on_paper(&session), says)
        }),
    };
    Box::new(move || sheet)
}

/// A chart as it is shown, of many samples with what is seen of them on paper.
fn chart(workbench: &Workbench, name: &str) -> Result<Chart, String> {
    let kind = find(name).ok_or(say!("there is no such chart"))?;
    let scene = workbench.scene_of(kind);
    let shown = charts::shown(kind, &scene).map_err(|missing| missing.title)?;
    let mut chart = shown.chart;
    if let HoverTarget::Samples(samples) = &shown.pointed {
        let [[from, _], [to, _]] = chart.bounds;
        chart.items.extend(samples.in_sight([from, to], FULL_WIDTH));
    }
    Ok(chart)
}
