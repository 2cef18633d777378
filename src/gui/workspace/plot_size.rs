//! Over how many points the workspace is drawn: vectors are magnified for it.

use crate::gui::workbench::{Command, ViewChange, Workbench};

/// The points has to be another by this share for vectors to be drawn for it.
const ANOTHER: f64 = 0.03;

/// Says over how many points the workspace is drawn where all of it is in sight, where that has changed.
pub(super) fn tell_plot_size(
    workbench: &Workbench,
    points_per_mm: f64,
    commands: &mut Vec<Command>,
) {
    let points = 2.0 * workbench.loaded_session().overview.radius_mm * points_per_mm;
    let known = workbench.view().plot_size;
    if points.is_finite() && points > 0.0 && (points / known - 1.0).abs() > ANOTHER {
        commands.push(Command::View(ViewChange::PlotSize(points)));
    }
}
