//! What was hidden in a session that was simulated here, beside what was found of it.

use egui::{RichText, Ui};

use crate::diagnosis::Diagnosis;
use crate::effects::Term;
use crate::fit::Estimate;
use crate::gui::style::tokens::{Palette, size, strong};
use crate::gui::views::names::{in_words, title};
use crate::gui::widgets;
use crate::gui::workbench::Workbench;
use crate::kinematics::JointKind;
use crate::present::names::parameter;
use crate::present::numbers::{significant, with_minus_signs};

/// A button, and behind it the truth; nothing for a session that was not simulated here.
pub(super) fn show(ui: &mut Ui, workbench: &Workbench, d: &Diagnosis) {
    let loaded_session = workbench.loaded_session();
    let Some(hidden) = loaded_session.hidden.as_deref() else {
        return;
    };
    // The truth of this opening: another simulation hides it again.
    let id = egui::Id::unique("hidden").with(loaded_session.lineage);
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
        } else {
            widgets::hint(ui, say!("hidden → found"));
        }
        for term in hidden {
            one(ui, workbench, term, d);
        }
    });
}

/// One effect that was hidden: whether the diagnosis has it, and each size beside what was found of it.
fn one(ui: &mut Ui, workbench: &Workbench, term: &Term, d: &Diagnosis) {
    let about = term.effect.about();
    let joint = about.per_joint.then_some(term.joint + 1);
    let of_this = |one: &&Estimate| one.effect == about.id && one.joint == joint;
    let found = d
        .found
        .iter()
        .find(|f| f.effect == about.id && f.joint == joint);
    let palette = Palette::of(ui);
    let (says, color) = if found.is_some() {
        (say!("found"), palette.within)
    } else if about.role.is_of_every_calibration() {
        (say!("identified"), palette.within)
    } else {
        (say!("not found"), palette.warning)
    };
    ui.horizontal_wrapped(|ui| {
        let name = in_words(about.id, joint, workbench);
        ui.label(RichText::new(name).font(strong(size::SMALL)));
        ui.label(RichText::new(says).color(color));
    });
    let estimates: Vec<&Estimate> = match found {
        Some(found) => found.parameters.iter().collect(),
        None => d.identified.iter().filter(of_this).collect(),
    };
    let units = workbench.units();
    let joints = &workbench.loaded_session().session.robot.joints;
    let kind = joints
        .get(term.joint)
        .map_or(JointKind::Revolute, |j| j.kind);
    for hidden in term.parameters_on(kind) {
        let (name, unit) = parameter(hidden.name);
        let gap = |unit: &str| if ["", "°"].contains(&unit) { "" } else { " " }.to_owned() + unit;
        let mut says = significant(hidden.value, 3) + &gap(unit);
        if let Some(one) = estimates.iter().find(|one| one.name == hidden.name) {
            let (value, half, unit) = units.estimate(one, unit);
            let half = if half.is_empty() {
                half
            } else {
                format!(" {half}")
            };
            says += &format!(" → {value}{half}{}", gap(unit));
        }
        widgets::fact(ui, &name, with_minus_signs(&says));
    }
}
