//! What no name explains: how much and where, and its smooth correction, added and taken back.

use egui::{RichText, Ui};

use crate::diagnosis::{Correction, Diagnosis};
use crate::effects::Term;
use crate::gui::core::edit::Edit;
use crate::gui::style::tokens::{size, strong};
use crate::gui::widgets;
use crate::gui::workbench::{Command, Workbench};
use crate::kinematics::JointKind;
use crate::model::Model;
use crate::present::numbers::{significant, trimmed};
use crate::units::deg_from_rad;

use super::names::curve_link;

/// What the window can do about what a search could not name.
pub(super) fn actions(
    ui: &mut Ui,
    workbench: &Workbench,
    d: &Diagnosis,
    commands: &mut Vec<Command>,
) {
    if let Some(found) = d.unexplained.corrected() {
        correction(ui, workbench, found, commands);
        curve_link(ui, workbench, d.found.len(), commands);
    }
}

/// Where a smooth correction is measured, and the button that adds it.
fn correction(ui: &mut Ui, workbench: &Workbench, found: &Correction, commands: &mut Vec<Command>) {
    range(
        ui,
        workbench.loaded_session().session.robot.joints[found.term.joint].kind,
        &found.term,
    );
    let mut added = workbench.document().added.iter();
    match added.position(|a| a.term.same_column(&found.term)) {
        None => {
            if widgets::secondary(ui, say!("Add smooth correction")).clicked() {
                // It is what the names leave: without them it would correct something else.
                let mut terms = workbench.not_added();
                terms.push(found.term.clone());
                commands.push(Command::Edit(Edit::Add(terms)));
            }
        }
        Some(index) => {
            let mut on = workbench.document().added[index].on;
            let checkbox = ui.checkbox(&mut on, say!("smooth correction in the model"));
            if checkbox.changed() {
                commands.push(Command::Edit(Edit::Switch(index, on)));
            }
        }
    }
}

/// Where the curve of a term is measured; outside nothing is known.
fn range(ui: &mut Ui, kind: JointKind, term: &Term) {
    let Some(curve) = term.curve() else { return };
    let (unit, outer): (&str, fn(f64) -> f64) = match kind {
        JointKind::Revolute => ("°", deg_from_rad),
        JointKind::Prismatic => (" mm", |v| v),
    };
    let knots = curve.knots();
    let between = [knots.from, knots.to].map(|v| format!("{}{unit}", trimmed(outer(v), 2)));
    widgets::fact_of(ui, phrase!("measured"), between.join(" … "));
    let most = |size: f64, unit: &str| format!("{}{unit}", significant(size, 2));
    let [motion, radial, axial] = curve.largest();
    let parts = [
        (say!("largest along the motion"), outer(motion), unit),
        (say!("largest along the radius"), radial, " mm"),
        (say!("largest along the axis"), axial, " mm"),
    ];
    for (name, size, unit) in parts {
        if size > 0.0 {
            widgets::fact(ui, name, most(size, unit));
        }
    }
    widgets::hint(
        ui,
        say!(
            "A smooth curve without a name. Outside the measured range its end values are held, and nothing is known"
        ),
    );
}

/// The smooth corrections of a model, beside its parameters.
pub(super) fn in_the_model(ui: &mut Ui, model: &Model) {
    for term in model.terms().iter().filter(|t| t.curve.is_some()) {
        widgets::card(ui, |ui| {
            let text = RichText::new(say!("Unexplained")).font(strong(size::BODY));
            ui.label(text);
            range(ui, model.robot.joints[term.joint].kind, term);
        });
    }
}
