//! A model: how it is identified (step 3); its parameters; of one that was read from a file also where it came from,
//! and what it does on the session.

use egui::{Checkbox, Ui};

use crate::compensation::Verification;
use crate::effects::find;
use crate::explain::{self, Detail, verification};
use crate::fit::Estimate;
use crate::language::spoken;
use crate::present::numbers::trimmed;
use crate::present::units::Units;

use crate::gui::core::answer::{Answer, LoadedModelSummary};
use crate::gui::core::document::Method;
use crate::gui::style::size;
use crate::gui::view::Step;
use crate::gui::widgets::{self, Does};
use crate::gui::workbench::Workbench;

use super::{blocks, copies};

pub(super) fn state(workbench: &Workbench) -> (String, bool) {
    let document = workbench.document();
    let caption = match (document.identified, document.method) {
        _ if document.loaded_model.is_some() => say!("model from a file").to_owned(),
        (false, _) => say!("not yet").to_owned(),
        (true, Method::Regional) => say!("by region").to_owned(),
        (true, Method::Exact) => match workbench.answer() {
            Some(answer) => {
                let count = answer.identification.parameters.len();
                say!(one "full model, {count} parameter", "full model, {count} parameters", count)
            }
            None => say!("full model").to_owned(),
        },
    };
    (caption, workbench.answer().is_some())
}

pub(super) fn show(ui: &mut Ui, workbench: &Workbench) {
    let document = workbench.document();
    if let Some(given) = &document.loaded_model {
        widgets::hint(
            ui,
            say!(
                "The model in {given} takes the place of an identification",
                given = given.file_name()
            ),
        );
        if workbench.loaded_session().is_empty() {
            widgets::hint(
                ui,
                say!("To identify the robot anew, open a session that was measured on it"),
            );
            return;
        }
        widgets::secondary(ui, say!("Identify from this session"))
            .does(workbench, move |bench| bench.identify(None));
        return;
    }
    widgets::section(ui, say!("Method"));
    if workbench.loaded_session().single_revolute() {
        let methods = [
            (Method::Exact, say!("Full model")),
            (Method::Regional, say!("By region")),
        ];
        if let Some(method) = widgets::segmented(ui, &methods, document.method) {
            workbench.edits(phrase!("choose method"), move |document| {
                document.choose_method(method)
            });
        }
    }
    match document.method {
        Method::Exact => {
            widgets::hint(
                ui,
                say!(
                    "One model for the whole range, fitted in the measuring frame, with an interval for every number"
                ),
            );
            effects(ui, workbench);
        }
        Method::Regional => {
            widgets::hint(
                ui,
                say!(
                    "The source paper's method: a constant correction of angle and radius for each region. It leaves out the rotation between lamp and base, so that one constant error looks different in every region; use it to compare with earlier reports"
                ),
            );
            let n = document.regions.len();
            widgets::fact_of(ui, phrase!("regions"), n.to_string());
            ui.link(say!("Change the regions"))
                .does(workbench, move |bench| bench.view.step = Step::Regions);
        }
    }
}

fn effects(ui: &mut Ui, workbench: &Workbench) {
    let document = workbench.document();
    let loaded_session = workbench.loaded_session();
    widgets::section(ui, say!("Effects to fit"));
    ui.spacing_mut().item_spacing.y = 4.0;
    for id in &loaded_session.coverage.testable {
        let Some(about) = find(id).map(crate::effects::Effect::about) else {
            continue;
        };
        let mut on = document.effects.contains(id);
        // What a diagnosis has added is switched where it was added.
        let is_added = !on && document.in_the_model().any(|t| t.effect.about().id == *id);
        let mut shown = on || is_added;
        let response = ui.add_enabled(
            !is_added,
            Checkbox::new(&mut shown, crate::present::names::title(about.id)),
        );
        on = shown && !is_added;
        let response = response.on_disabled_hover_text(say!(
            "Added by the diagnosis, and switched off where it was added"
        ));
        let response = response.on_hover_ui(|ui| {
            ui.set_max_width(300.0);
            let title = crate::present::names::title(about.id);
            widgets::bold(ui, title);
            ui.label(spoken(about.cause));
            widgets::hint(ui, about.equation);
        });
        if response.changed() {
            workbench.edits(phrase!("choose effects"), move |document| {
                document.choose_effect(about.id, on)
            });
        }
    }
    if loaded_session.coverage.not_testable.is_empty() {
        return;
    }
    let title = say!(
        one "{count} that this session cannot show",
        "{count} that this session cannot show",
        count = loaded_session.coverage.not_testable.len()
    );
    widgets::folded(ui, &title, size::SMALL, |ui| {
        super::coverage::not_testable(ui, workbench);
    });
}

pub(super) fn next(ui: &mut Ui, workbench: &Workbench) {
    let document = workbench.document();
    if !document.identified {
        widgets::primary(ui, say!("Identify")).does(workbench, move |bench| bench.identify(None));
        return;
    }
    if document.loaded_model.is_none() {
        widgets::hint_above_the_button(ui, say!("Identified; the result follows every change"));
    }
    widgets::primary(ui, say!("Continue to diagnose"))
        .does(workbench, move |bench| bench.view.step = Step::Gap);
}

/// What there is to say about the model itself.
pub(super) fn about(
    ui: &mut Ui,
    workbench: &Workbench,
    answer: &Answer,
    loaded: &LoadedModelSummary,
) {
    let calibration = &answer.calibration;
    widgets::card(ui, |ui| {
        widgets::bold(ui, say!("Model from a file"));
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
    widgets::bold(ui, say!("How it came about"));
    for step in &answer.calibration.history {
        let gap = units.length(step.gap_mm);
        let gap = match step.held_out_mm {
            Some(held_out) => say!(
                "{gap}, held out {held_out}",
                gap,
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
            widgets::bold(ui, &section.title);
            blocks::show(ui, &section.blocks);
        });
    }
}

/// What was identified.
pub(super) fn parameters(ui: &mut Ui, workbench: &Workbench, estimates: &[Estimate]) {
    widgets::bold(ui, say!("Identified parameters"));
    let robot = &workbench.loaded_session().session.robot;
    let detail = Detail::window(workbench.units());
    blocks::show(ui, &explain::values(estimates, robot, detail));
    if robot.joints.len() < 2 {
        widgets::hint(ui, say!("± half the 95 % interval"));
    }
    copies::button(ui, say!("parameters"), || copies::parameters(estimates));
}
