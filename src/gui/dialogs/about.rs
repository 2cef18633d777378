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
        say!("version {version}", version = env!("CARGO_PKG_VERSION")),
    );
    ui.label(say!("Calibrates a robot at commissioning: finds where measurement and simulation disagree, and writes what the controller needs"));
    widgets::hint(
        ui,
        say!("Everything in this window can be done in the terminal too: truepose --help"),
    );
    widgets::hint(
        ui,
        say!("Type: Inter, by the Inter project authors, SIL Open Font License 1.1"),
    );
    done(ui, commands);
}
