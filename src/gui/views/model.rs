//! A model that was read from a file: where it came from, and what it does on the session.

use egui::Ui;

use super::cards::title;
use crate::compensation::Verification;
use crate::explain::{Detail, verification};
use crate::gui::core::answer::{Answer, LoadedModelSummary};
use crate::gui::views::blocks;
use crate::gui::widgets;
use crate::gui::workbench::Workbench;
use crate::present::numbers::trimmed;
use crate::present::units::Units;

/// What there is to say about the model itself.
pub(super) fn about(
    ui: &mut Ui,
    workbench: &Workbench,
    answer: &Answer,
    loaded: &LoadedModelSummary,
) {
    let calibration = &answer.calibration;
    widgets::card(ui, |ui| {
        title(ui, say!("Model from a file"));
        widgets::fact_of(ui, phrase!("file"), &loaded.file);
        widgets::fact_of(ui, phrase!("robot"), &calibration.model.robot.name);
        widgets::fact_of(ui, phrase!("identified from"), &calibration.session);
        let joints = &calibration.model.robot.joints;
        for (joint, range) in joints.iter().zip(&calibration.measured) {
            let says = |q| {
                format!(
                    "{}{}",
                    trimmed(joint.kind.to_display(q), 2),
                    joint.kind.sign()
                )
            };
            let measured = format!("{} … {}", says(range.from), says(range.to));
            let name = match joints.len() {
                1 => say!("measured").to_owned(),
                _ => say!("measured, {joint}", joint = joint.name),
            };
            widgets::fact(ui, &name, measured);
        }
        if workbench.loaded_session().is_empty() {
            widgets::hint(
                ui,
                say!(
                    "Nothing was measured yet. Open a session that was measured on this robot, and what the model does there will be shown here"
                ),
            );
        }
    });
    if !calibration.history.is_empty() {
        widgets::card(ui, |ui| history(ui, workbench.units(), answer));
    }
}

/// How the gap shrank while the model was made.
fn history(ui: &mut Ui, units: Units, answer: &Answer) {
    title(ui, say!("How it came about"));
    for step in &answer.calibration.history {
        let gap = units.length(step.gap_mm);
        let gap = match step.held_out_mm {
            Some(held_out) => say!(
                "{gap}, held out {held_out}",
                gap = gap,
                held_out = units.length(held_out)
            ),
            None => gap,
        };
        widgets::fact(ui, &step.what, gap);
    }
}

/// What the model does on the session that is open.
pub(super) fn verified(ui: &mut Ui, units: Units, verified: &Verification) {
    for section in verification(verified, Detail::window(units)) {
        widgets::card(ui, |ui| {
            title(ui, &section.title);
            blocks::show(ui, &section.blocks);
        });
    }
}
