//! How to mend what is wrong with the data itself.

use egui::Ui;

use crate::diagnosis::{Diagnosis, Mend};
use crate::gui::core::edit::Edit;
use crate::gui::widgets;
use crate::gui::workbench::Command;
use crate::language::of_core;
use crate::set_up_errors::DataProblem;

/// The samples that it is about, and its mend.
pub(super) fn actions(ui: &mut Ui, problem: &DataProblem, commands: &mut Vec<Command>) {
    if !problem.samples.is_empty() && ui.link(say!("Show these samples")).clicked() {
        commands.push(Command::Mark(problem.samples.clone()));
    }
    let Some(mend) = &problem.mend else {
        return;
    };
    if widgets::secondary(ui, &of_core(&mend.says())).clicked() {
        commands.push(Command::Edit(Edit::Mend(vec![mend.clone()])));
    }
}

/// All of them at once, where there are several.
pub(super) fn mend_all(ui: &mut Ui, d: &Diagnosis, commands: &mut Vec<Command>) {
    let problems = d.data_problems.iter();
    let mends: Vec<_> = problems.filter_map(|p| p.mend.clone()).collect();
    if mends.len() > 1 {
        let text = say!("Mend all {mends}", mends = mends.len());
        if widgets::secondary(ui, &text).clicked() {
            commands.push(Command::Edit(Edit::Mend(in_order(mends))));
        }
    }
}

/// Samples are removed last, all at once: until then they have their numbers.
fn in_order(mends: Vec<Mend>) -> Vec<Mend> {
    let mut rows = Vec::new();
    let mut ordered = Vec::new();
    for mend in mends {
        match mend {
            Mend::Remove(some) => rows.extend(some),
            other => ordered.push(other),
        }
    }
    rows.sort_unstable();
    rows.dedup();
    if !rows.is_empty() {
        ordered.push(Mend::Remove(rows));
    }
    ordered
}
