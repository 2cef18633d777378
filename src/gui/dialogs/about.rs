//! What this program is.

use egui::Ui;

use crate::gui::widgets;
use crate::gui::workbench::{Command, Workbench};

use super::ends::done;

pub(super) fn show(ui: &mut Ui, _: &Workbench, commands: &mut Vec<Command>) {
    ui.set_width(400.0);
    widgets::heading(ui, "truepose");
    widgets::hint(
        ui,
        say!("about-version", version = env!("CARGO_PKG_VERSION")),
    );
    ui.label(say!("about-calibrates-a-robot-at-commissioning"));
    widgets::hint(ui, say!("about-everything-in-this-window-can"));
    widgets::hint(ui, say!("about-type-inter-by-the-inter"));
    done(ui, commands);
}
