//! Over how many points the workspace is drawn: vectors are magnified for it.

use crate::gui::workbench::{Command, Workbench};

/// The room has to be another by this share for vectors to be drawn for it.
const ANOTHER: f64 = 0.03;

/// Says over how many points the workspace is drawn where all of it is in sight, if that is not known.
pub(super) fn tell_room(workbench: &Workbench, points_per_mm: f64, commands: &mut Vec<Command>) {
    let room = 2.0 * workbench.subject().overview.radius_mm * points_per_mm;
    let known = workbench.view().room;
    if room.is_finite() && room > 0.0 && (room / known - 1.0).abs() > ANOTHER {
        commands.push(Command::Room(room));
    }
}
