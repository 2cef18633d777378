//! Targets and programs, in the Export step: what is corrected where the controller takes no table.

use egui::Ui;

use crate::gui::widgets;
use crate::gui::workbench::{Asked, Command};

pub(super) fn show(ui: &mut Ui, commands: &mut Vec<Command>) {
    widgets::section(ui, say!("Targets and programs"));
    if widgets::secondary(ui, say!("Compensate…")).clicked() {
        commands.push(Command::Ask(Asked::Targets));
    }
    widgets::hint(
        ui,
        say!(
            "A table of targets (CSV), RAPID, KRL, URScript or FANUC LS: its targets are corrected in place, and what changes is shown before anything is saved"
        ),
    );
}
