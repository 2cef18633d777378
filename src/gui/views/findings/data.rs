//! What is wrong with the data itself, and how to mend it.

use crate::language::of_core;
use egui::{RichText, Ui};

use crate::diagnosis::{Diagnosis, Mend};
use crate::gui::core::edit::Edit;
use crate::gui::style::tokens::{Palette, size, strong};
use crate::gui::widgets::{self};
use crate::gui::workbench::Command;

pub(super) fn show(ui: &mut Ui, d: &Diagnosis, commands: &mut Vec<Command>) {
    let palette = Palette::of(ui);
    let mends: Vec<_> = d
        .data_problems
        .iter()
        .filter_map(|p| p.mend.clone())
        .collect();
    for problem in &d.data_problems {
        widgets::card(ui, |ui| {
            let text = RichText::new(of_core(&problem.what)).font(strong(size::BODY));
            ui.label(text.color(palette.outside));
            widgets::hint(ui, of_core(&problem.evidence));
            ui.label(of_core(&problem.proposal));
            if !problem.samples.is_empty() && ui.link(say!("Show these samples")).clicked() {
                commands.push(Command::Mark(problem.samples.clone()));
            }
            let Some(mend) = &problem.mend else {
                return;
            };
            if widgets::secondary(ui, &of_core(&mend.says())).clicked() {
                commands.push(Command::Edit(Edit::Mend(vec![mend.clone()])));
            }
        });
    }
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
