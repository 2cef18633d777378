//! The middle: workspace and charts, beside and below each other. They are split, moved by their
//! handles and pulled by the grips between them; where there is no room for all of them one is
//! shown, and a switch between them.

mod chart;
mod pane;
mod tiles;

use egui::Ui;

use crate::gui::view::Key;
use crate::gui::workbench::{Command, Workbench};

pub(crate) fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let panes = &workbench.view().panes;
    let room = ui.available_size();
    if tiles::fits(&panes.root, room) {
        tiles::show(ui, workbench, commands);
    } else if let Some(active) = panes.pane(panes.active()) {
        pane::contents(ui, workbench, active, Some(pane::switch), commands);
        settle(ui, active.key);
    }
}

/// Another plot in the place of all is laid out before anybody sees it: in one pass it finds its
/// bounds, in the next it measures its axes.
fn settle(ui: &Ui, key: Key) {
    const UNSEEN: u8 = 2;
    let id = ui.scope_id().with("alone");
    let (before, left) = ui.data(|data| data.get_temp(id)).unwrap_or((key, 0));
    let left: u8 = if before == key { left } else { UNSEEN };
    if left > 0 {
        ui.ctx().request_discard("another plot");
    }
    ui.data_mut(|data| data.insert_temp(id, (key, left.saturating_sub(1))));
}
