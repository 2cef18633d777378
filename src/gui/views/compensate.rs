//! Targets and programs, in the Export step: what is corrected where the controller takes no table.

use egui::Ui;

use crate::gui::widgets;
use crate::gui::workbench::Command;

pub(super) fn show(ui: &mut Ui, commands: &mut Vec<Command>) {
    widgets::section(ui, say!("common-targets-and-programs"));
    if widgets::secondary(ui, say!("compensate-compensate")).clicked() {
        commands.push(Command::ChooseTargets);
    }
    widgets::hint(ui, say!("compensate-a-table-of-targets-csv"));
}
