//! What the window can do about a section of a diagnosis: add an effect to the model, show its curve, correct the data.

use egui::Ui;

use crate::diagnosis::{Diagnosis, SessionCorrection};
use crate::gui::core::edit::Edit;
use crate::gui::core::search::term_of;
use crate::gui::views::names::curve_link;
use crate::gui::widgets;
use crate::gui::workbench::{Command, ViewChange, Workbench};
use crate::language::spoken;
use crate::set_up_errors::DataProblem;

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

/// A problem of the data: the samples that it is about, and its correction.
pub(super) fn of_problem(ui: &mut Ui, problem: &DataProblem, commands: &mut Vec<Command>) {
    if !problem.samples.is_empty() && ui.link(say!("Show these samples")).clicked() {
        commands.push(Command::View(ViewChange::Mark(problem.samples.clone())));
    }
    let Some(mend) = &problem.mend else {
        return;
    };
    if widgets::secondary(ui, &spoken(mend.describe())).clicked() {
        commands.push(Command::Edit(Edit::Correct(vec![mend.clone()])));
    }
}

/// All of them at once, where there are several.
pub(super) fn mend_all(ui: &mut Ui, d: &Diagnosis, commands: &mut Vec<Command>) {
    let problems = d.data_problems.iter();
    let mends: Vec<_> = problems.filter_map(|p| p.mend.clone()).collect();
    if mends.len() > 1 {
        let text = say!("Correct all {mends}", mends = mends.len());
        if widgets::secondary(ui, &text).clicked() {
            commands.push(Command::Edit(Edit::Correct(in_order(mends))));
        }
    }
}

/// Samples are removed last, all at once: until then they have their numbers.
fn in_order(mends: Vec<SessionCorrection>) -> Vec<SessionCorrection> {
    let mut rows = Vec::new();
    let mut ordered = Vec::new();
    for mend in mends {
        match mend {
            SessionCorrection::Remove(some) => rows.extend(some),
            other => ordered.push(other),
        }
    }
    rows.sort_unstable();
    rows.dedup();
    if !rows.is_empty() {
        ordered.push(SessionCorrection::Remove(rows));
    }
    ordered
}
