//! What would have been seen, and what could not be.

use egui::Ui;

use crate::diagnosis::Diagnosis;
use crate::gui::style::tokens::size;
use crate::gui::views::copies;
use crate::gui::widgets;
use crate::language::names::detection_limit;
use crate::language::names::title_on;
use crate::present::numbers::grouped;

pub(super) fn show(ui: &mut Ui, d: &Diagnosis) {
    if d.not_found.is_empty() {
        return;
    }
    let number = say!(one "{count} effect", "{count} effects", count = grouped(d.not_found.len()));
    let text = say!("Detection limits: {number} (95 %)", number = number);
    widgets::folded(ui, &text, size::SMALL, |ui| {
        for limit in &d.not_found {
            let joint = limit.joint.map(|j| j + 1);
            ui.label(title_on(limit.effect, joint, d.model.robot.joints.len()));
            widgets::hint(ui, detection_limit(limit));
        }
        copies::button(ui, say!("detection limits"), || copies::limits(d));
    });
}

pub(super) fn not_testable(ui: &mut Ui, d: &Diagnosis) {
    if d.not_testable.is_empty() {
        return;
    }
    let text = say!(
        "Not testable: {not_testable}",
        not_testable =
            say!(one "{count} effect", "{count} effects", count = grouped(d.not_testable.len()))
    );
    widgets::folded(ui, &text, size::SMALL, |ui| {
        for one in &d.not_testable {
            let joint = one.joint.map(|j| j + 1);
            ui.label(title_on(one.effect, joint, d.model.robot.joints.len()));
            widgets::hint(ui, &one.because);
        }
    });
}
