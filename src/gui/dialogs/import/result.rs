//! What the import would bring, or why it is refused.

use egui::Ui;

use crate::diagnostic::Severity;
use crate::gui::import_draft::{Foreign, Trial};
use crate::gui::widgets;
use crate::present::numbers::grouped;

/// Lines that are shown.
const MOST: usize = 8;

/// Shows it, once there is nothing left to ask.
pub(super) fn show(ui: &mut Ui, now: &Foreign) {
    // As high as it ever was for this file: the fields above keep their place while it changes.
    let id = ui.scope_id().with(("highest result", &now.path));
    let highest: f32 = ui.data_mut(|data| data.get_temp(id)).unwrap_or_default();
    let shown = ui.scope(|ui| {
        ui.set_min_height(highest);
        contents(ui, now);
    });
    let height = shown.response.rect.height().max(highest);
    ui.data_mut(|data| data.insert_temp(id, height));
}

fn contents(ui: &mut Ui, now: &Foreign) {
    match &now.seen.trial {
        None => {}
        Some(Ok(trial)) => {
            widgets::section(ui, say!("What the import brings"));
            brings(ui, trial);
        }
        Some(Err(because)) => {
            widgets::section(ui, say!("To fix"));
            for line in because {
                super::parts::line(ui, Severity::Error, line);
            }
        }
    }
}

fn brings(ui: &mut Ui, trial: &Trial) {
    let subject = &trial.subject;
    let mut says = say!(one "{count} sample", "{count} samples", count = grouped(subject.len()));
    if let Some(gap) = &subject.gap_before {
        says += &say!(
            ", {rms} mm from the nominal robot",
            rms = format!("{:.4}", gap.rms_mm)
        );
    }
    if let Some(matched) = &trial.matched {
        says += &say!(
            "; matched by {id}; unmatched: {lonely_measurements} measured, {lonely_commands} commanded",
            id = matched.by.id(),
            lonely_measurements = matched.lonely_measurements.len(),
            lonely_commands = matched.lonely_commands.len()
        );
    }
    ui.label(says);
    let mut notes: Vec<_> = trial.notes.iter().collect();
    notes.sort_by_key(|(severity, _)| std::cmp::Reverse(*severity == Severity::Warning));
    for (severity, note) in notes.iter().take(MOST) {
        super::parts::line(ui, *severity, note);
    }
}
