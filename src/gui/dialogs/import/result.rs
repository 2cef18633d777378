//! What the import would bring, or why it is refused.

use egui::Ui;

use crate::diagnostic::Severity;
use crate::gui::import_draft::{ImportDraft, Trial};
use crate::gui::views::blocks;
use crate::gui::widgets;
use crate::present::units::Units;

/// Lines that are shown.
const MOST: usize = 8;

/// Shows it, once there is nothing left to ask.
pub(super) fn show(ui: &mut Ui, now: &ImportDraft, units: Units) {
    // As high as it ever was for this file: the fields above keep their place while it changes.
    let id = ui.scope_id().with(("highest result", &now.path));
    let highest: f32 = ui.data_mut(|data| data.get_temp(id)).unwrap_or_default();
    let shown = ui.scope(|ui| {
        ui.set_min_height(highest);
        contents(ui, now, units);
    });
    let height = shown.response.rect.height().max(highest);
    ui.data_mut(|data| data.insert_temp(id, height));
}

fn contents(ui: &mut Ui, now: &ImportDraft, units: Units) {
    match &now.seen.trial {
        None => {}
        Some(Ok(trial)) => {
            widgets::section(ui, &trial.brings(units).title);
            brings(ui, trial, units);
        }
        Some(Err(because)) => {
            widgets::section(ui, say!("To fix"));
            for line in because {
                super::parts::line(ui, Severity::Error, line);
            }
        }
    }
}

fn brings(ui: &mut Ui, trial: &Trial, units: Units) {
    let section = trial.brings(units);
    blocks::show(ui, &section.blocks);
    let mut notes: Vec<_> = trial.notes.iter().collect();
    notes.sort_by_key(|(severity, _)| std::cmp::Reverse(*severity == Severity::Warning));
    for (severity, note) in notes.iter().take(MOST) {
        super::parts::line(ui, *severity, note);
    }
}
