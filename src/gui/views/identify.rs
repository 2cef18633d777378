//! Step 3: how the robot is identified.

use crate::gui::language::of_core;
use egui::{Checkbox, CollapsingHeader, RichText, Ui};

use crate::effects::find;
use crate::gui::core::document::Method;
use crate::gui::core::edit::Edit;
use crate::gui::style::tokens::{Palette, size};
use crate::gui::view::Step;
use crate::gui::views::step::StepView;
use crate::gui::widgets::{self, Progress};
use crate::gui::workbench::{Command, Workbench};

pub(super) const STEP: StepView = StepView {
    step: Step::Identify,
    show,
    next,
    state,
};

fn state(workbench: &Workbench) -> (String, Progress) {
    let document = workbench.document();
    let caption = match (document.identified, document.method) {
        _ if document.given.is_some() => say!("identify-model-from-a-file").to_owned(),
        (false, _) => say!("common-not-yet").to_owned(),
        (true, Method::Regional) => say!("identify-by-region").to_owned(),
        (true, Method::Exact) => match workbench.answer() {
            Some(answer) => {
                let count = answer.identification.parameters.len();
                say!("identify-parameters", count = count)
            }
            None => say!("identify-with-the-full-model").to_owned(),
        },
    };
    (caption, Progress::of(workbench.answer().is_some()))
}

fn show(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let document = workbench.document();
    if let Some(given) = &document.given {
        widgets::hint(
            ui,
            say!("identify-the-model-in-takes", given = given.file_name()),
        );
        if workbench.subject().is_empty() {
            widgets::hint(ui, say!("identify-to-identify-the-robot-anew"));
            return;
        }
        if widgets::secondary(ui, say!("identify-identify-from-this-session")).clicked() {
            commands.push(Command::Edit(Edit::Identify));
        }
        return;
    }
    widgets::section(ui, say!("identify-method"));
    let methods = [
        (Method::Exact, say!("identify-full-model")),
        (Method::Regional, say!("identify-by-region-2")),
    ];
    let offered = if workbench.subject().single_revolute() {
        &methods[..]
    } else {
        &methods[..1]
    };
    if let Some(method) = widgets::segmented(ui, offered, document.method) {
        commands.push(Command::Edit(Edit::Method(method)));
    }
    match document.method {
        Method::Exact => {
            widgets::hint(ui, say!("identify-one-model-for-the-whole"));
            effects(ui, workbench, commands);
        }
        Method::Regional => {
            widgets::hint(ui, say!("identify-the-source-papers-method"));
            let n = document.regions.len();
            widgets::fact_of(ui, "common-regions", n.to_string());
            if ui.link(say!("identify-change-the-regions")).clicked() {
                commands.push(Command::GoTo(Step::Regions));
            }
        }
    }
}

fn effects(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let document = workbench.document();
    let subject = workbench.subject();
    widgets::section(ui, say!("identify-effects-to-fit"));
    ui.spacing_mut().item_spacing.y = 4.0;
    for id in &subject.testable {
        let Some(about) = find(id).map(crate::effects::Effect::about) else {
            continue;
        };
        let mut on = document.effects.contains(id);
        let response = ui.add(Checkbox::new(
            &mut on,
            crate::gui::language::names::title(about.id),
        ));
        let response = response.on_hover_ui(|ui| {
            ui.set_max_width(300.0);
            ui.label(RichText::new(about.id).monospace());
            ui.label(of_core(about.cause));
            widgets::hint(ui, about.equation);
        });
        if response.changed() {
            commands.push(Command::Edit(Edit::Effect(about.id, on)));
        }
    }
    if subject.not_testable.is_empty() {
        return;
    }
    let title = say!(
        "identify-that-this-session-cannot-show",
        not_testable = subject.not_testable.len()
    );
    let palette = Palette::of(ui);
    let title = RichText::new(title).size(size::SMALL).color(palette.muted);
    CollapsingHeader::new(title)
        .id_salt("not testable")
        .show(ui, |ui| {
            for one in &subject.not_testable {
                ui.label(crate::gui::language::names::title(one.effect));
                widgets::hint(ui, of_core(&one.because));
            }
        });
}

fn next(ui: &mut Ui, workbench: &Workbench, commands: &mut Vec<Command>) {
    let document = workbench.document();
    if !document.identified {
        if widgets::primary(ui, say!("common-identify-2")).clicked() {
            commands.push(Command::Edit(Edit::Identify));
        }
        return;
    }
    if document.given.is_none() {
        widgets::hint(ui, say!("identify-identified-the-result-follows-every"));
    }
    if widgets::primary(ui, say!("identify-continue-to-diagnose")).clicked() {
        commands.push(Command::GoTo(Step::Gap));
    }
}
