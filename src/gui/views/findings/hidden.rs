//! What was hidden in a session that was simulated here, beside what was found of it.

use egui::{RichText, Ui};

use crate::diagnosis::{Diagnosis, FoundEffect};
use crate::effects::Term;
use crate::gui::style::tokens::Palette;
use crate::gui::views::names::{in_words, title};
use crate::gui::widgets;
use crate::gui::workbench::Workbench;
use crate::present::names::parameter;
use crate::present::numbers::significant;

/// A button, and behind it the truth; nothing for a session that was not simulated here.
pub(super) fn show(ui: &mut Ui, workbench: &Workbench, d: &Diagnosis) {
    let subject = workbench.loaded_session();
    let Some(hidden) = subject.hidden.as_deref() else {
        return;
    };
    // The truth of this opening: another simulation hides it again.
    let id = egui::Id::unique("hidden").with(subject.lineage);
    let shown: bool = ui.data(|data| data.get_temp(id)).unwrap_or(false);
    let says = if shown {
        say!("Do not show what was hidden")
    } else {
        say!("Show what was hidden")
    };
    if widgets::secondary(ui, says).clicked() {
        ui.data_mut(|data| data.insert_temp(id, !shown));
    }
    if !shown {
        return;
    }
    widgets::card(ui, |ui| {
        title(ui, say!("Hidden in this simulation"));
        if hidden.is_empty() {
            widgets::hint(ui, say!("Nothing"));
        }
        for term in hidden {
            one(ui, workbench, term, d);
        }
    });
}

/// One effect that was hidden: its size, and whether the diagnosis has it.
fn one(ui: &mut Ui, workbench: &Workbench, term: &Term, d: &Diagnosis) {
    let about = term.effect.about();
    let joint = about.per_joint.then_some(term.joint + 1);
    let parameters = term.parameters();
    let sizes = parameters.iter().map(|p| {
        let (name, unit) = parameter(p.name);
        format!("{name} {} {unit}", significant(p.value, 3)).replace(" °", "°")
    });
    let sizes: Vec<String> = sizes.collect();
    let is_found = |found: &&FoundEffect| found.effect == about.id && found.joint == joint;
    let palette = Palette::of(ui);
    let (says, color) = if d.found.iter().any(|found| is_found(&found)) {
        (say!("found"), palette.within)
    } else if about.role.is_of_every_calibration() {
        (say!("identified"), palette.within)
    } else {
        (say!("not found"), palette.warning)
    };
    ui.horizontal_wrapped(|ui| {
        ui.label(in_words(about.id, joint, workbench));
        ui.label(RichText::new(sizes.join(", ")).color(palette.muted));
        ui.label(RichText::new(says).color(color));
    });
}
