//! What several panels show: names of effects and parameters, problems of the data with what mends them,
//! and what no name explains.

use egui::{RichText, Ui};

use crate::diagnosis::{Correction, Diagnosis};
use crate::effects::Term;
use crate::explain::{Detail, problems_of_data};
use crate::fit::Estimate;
use crate::gui::charts::effect;
use crate::gui::core::edit::Edit;
use crate::gui::style::tokens::{Palette, size, strong};
use crate::gui::widgets;
use crate::gui::workbench::{Command, ViewChange, Workbench};
use crate::kinematics::JointKind;
use crate::language::spoken;
use crate::model::Model;
use crate::present::names::{parameter, title_on, usual_size};
use crate::present::numbers::{significant, trimmed};
use crate::sessions::SessionCorrection;
use crate::set_up_errors::DataProblem;
use crate::units::deg_from_rad;

use super::blocks::{self, Title};

pub(super) fn title(ui: &mut Ui, text: &str) {
    ui.label(RichText::new(text).font(strong(size::BODY)));
}

/// The title of an effect, with its joint where the robot has several.
pub(super) fn in_words(id: &str, joint: Option<usize>, workbench: &Workbench) -> String {
    title_on(
        id,
        joint,
        workbench.loaded_session().session.robot.joints.len(),
    )
}

/// Says which sizes no machine has.
pub(super) fn implausible(ui: &mut Ui, estimates: &[Estimate]) {
    let warning = Palette::of(ui).warning;
    for one in estimates {
        let Some(says) = one.implausible() else {
            continue;
        };
        let text = format!(
            "{}: {} ({})",
            parameter(one.name).0,
            spoken(&says),
            usual_size(one)
        );
        ui.label(RichText::new(text).color(warning));
    }
}

/// Shows what an effect does, in the chart.
pub(super) fn curve_link(
    ui: &mut Ui,
    workbench: &Workbench,
    index: usize,
    commands: &mut Vec<Command>,
) {
    let view = workbench.view();
    let shown = workbench.shows(effect::ID) && view.effect == index;
    let button = ui.add_enabled_ui(!shown, |ui| widgets::secondary(ui, say!("Show its curve")));
    if button.inner.clicked() {
        commands.push(Command::View(ViewChange::ShowEffect(index)));
    }
}

/// A card for each problem of the data; what is mechanical was corrected before the fit that is shown below.
pub(super) fn problems(
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

/// What the window can do about what a search could not name.
pub(super) fn unexplained(
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
pub(super) fn smooth_corrections(ui: &mut Ui, model: &Model) {
    for term in model.terms().iter().filter(|t| t.curve.is_some()) {
        widgets::card(ui, |ui| {
            let text = RichText::new(say!("Unexplained")).font(strong(size::BODY));
            ui.label(text);
            range(ui, model.robot.joints[term.joint].kind, term);
        });
    }
}
