//! What the window can do about a section of a diagnosis: add an effect to the model, show its curve.

use egui::Ui;

use crate::diagnosis::Diagnosis;
use crate::gui::core::edit::Edit;
use crate::gui::core::search::term_of;
use crate::gui::views::names::curve_link;
use crate::gui::widgets;
use crate::gui::workbench::{Command, Workbench};

/// An effect that was found: whether it is in the model, and its curve.
pub(super) fn of_effect(
    ui: &mut Ui,
    workbench: &Workbench,
    d: &Diagnosis,
    index: usize,
    commands: &mut Vec<Command>,
) {
    in_the_model(ui, workbench, d, index, commands);
    curve_link(ui, workbench, index, commands);
}

/// Adds it to the model, or switches it off there.
fn in_the_model(
    ui: &mut Ui,
    workbench: &Workbench,
    d: &Diagnosis,
    index: usize,
    commands: &mut Vec<Command>,
) {
    let Some(term) = term_of(d, &d.found[index]) else {
        return;
    };
    let mut added = workbench.document().added.iter();
    match added.position(|a| a.term.same_column(&term)) {
        None => {
            // The button that stands out is the one at the foot of the step, which adds all of them.
            if widgets::secondary(ui, say!("Add to model")).clicked() {
                commands.push(Command::Edit(Edit::Add(vec![term])));
            }
        }
        Some(index) => {
            let mut on = workbench.document().added[index].on;
            if ui.checkbox(&mut on, say!("in the model")).changed() {
                commands.push(Command::Edit(Edit::Switch(index, on)));
            }
        }
    }
}
