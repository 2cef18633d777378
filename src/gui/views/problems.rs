//! Problems of the data, with the buttons that show their samples and correct them.

use egui::Ui;

use crate::explain::{Detail, problems_of_data};
use crate::gui::core::edit::Edit;
use crate::gui::style::tokens::Palette;
use crate::gui::widgets;
use crate::gui::workbench::{Command, ViewChange};
use crate::language::spoken;
use crate::sessions::SessionCorrection;
use crate::set_up_errors::DataProblem;

use super::blocks::{self, Title};

/// A card for each; what is mechanical was corrected before the fit that is shown below.
pub(super) fn show(
    ui: &mut Ui,
    problems: &[DataProblem],
    detail: Detail,
    commands: &mut Vec<Command>,
) {
    // Before the cards: of many the last is out of sight.
    mend_all(ui, problems, commands);
    let sections = problems_of_data(problems, detail);
    for (section, problem) in sections.iter().zip(problems) {
        widgets::card(ui, |ui| {
            blocks::title(ui, section, Title::Large(Palette::of(ui).outside));
            blocks::show(ui, &section.blocks);
            of_problem(ui, problem, commands);
        });
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
pub(super) fn mend_all(ui: &mut Ui, problems: &[DataProblem], commands: &mut Vec<Command>) {
    let mends: Vec<_> = problems.iter().filter_map(|p| p.mend.clone()).collect();
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
