//! Step 3: how the robot is identified.

use crate::language::spoken;
use egui::{Checkbox, CollapsingHeader, RichText, Ui};

use super::{Progress, StepView};
use crate::effects::find;
use crate::gui::core::document::Method;
use crate::gui::core::edit::Edit;
use crate::gui::style::tokens::{Palette, size, strong};
use crate::gui::view::Step;
use crate::gui::widgets;
use crate::gui::workbench::{Command, ViewChange, Workbench};

pub(super) const STEP: StepView = StepView {
    step: Step::Identify,
    show,
    next,
    state,
};

fn state(workbench: &Workbench) -> (String, Progress) {
    let document = workbench.document();
    let caption = match (document.identified, document.method) {
        _ if document.loaded_model.is_some() => say!("model from a file").to_owned(),
        (false, _) => say!("not yet").to_owned(),
        (true, Method::Regional) => say!("by region").to_owned(),
        (true, Method::Exact) => match workbench.answer() {
            Some(answer) => {
                let count = answer.identification.parameters.len();
                say!(one "full model, {count} parameter", "full model, {count} parameters", count = count)
            }
            None => say!("full model").to_owned(),
        },
    };
    (caption, Progress::of(workbench.answer().is_some()))
}

fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
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
        if widgets::secondary(ui, say!("Identify from this session")).clicked() {
            commands.push(Command::Edit(Edit::Identify));
        }
        return;
    }
    widgets::section(ui, say!("Method"));
    if workbench.loaded_session().single_revolute() {
        let methods = [
            (Method::Exact, say!("Full model")),
            (Method::Regional, say!("By region")),
        ];
        if let Some(method) = widgets::segmented(ui, &methods, document.method) {
            commands.push(Command::Edit(Edit::Method(method)));
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
            effects(ui, workbench, commands);
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
            if ui.link(say!("Change the regions")).clicked() {
                commands.push(Command::View(ViewChange::GoTo(Step::Regions)));
            }
        }
    }
}

fn effects(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
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
            ui.label(RichText::new(title).font(strong(size::BODY)));
            ui.label(spoken(about.cause));
            widgets::hint(ui, about.equation);
        });
        if response.changed() {
            commands.push(Command::Edit(Edit::Effect(about.id, on)));
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
    let palette = Palette::of(ui);
    let title = RichText::new(title).size(size::SMALL).color(palette.muted);
    CollapsingHeader::new(title)
        .id_salt("not testable")
        .show(ui, |ui| {
            for one in &loaded_session.coverage.not_testable {
                ui.label(crate::present::names::title(one.effect));
                widgets::hint(ui, spoken(&one.because));
            }
        });
}

fn next(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let document = workbench.document();
    if !document.identified {
        if widgets::primary(ui, say!("Identify")).clicked() {
            commands.push(Command::Edit(Edit::Identify));
        }
        return;
    }
    if document.loaded_model.is_none() {
        widgets::hint(ui, say!("Identified; the result follows every change"));
    }
    if widgets::primary(ui, say!("Continue to diagnose")).clicked() {
        commands.push(Command::View(ViewChange::GoTo(Step::Gap)));
    }
}
