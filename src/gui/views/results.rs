//! The right-hand side: what the identification says, and how sure it is.

use egui::text::{LayoutJob, TextFormat};
use egui::{Checkbox, ProgressBar, RichText, Ui};

use crate::compensation::Verification;
use crate::compensation::decision::Outcome as Conformity;
use crate::effects::find;
use crate::explain::{self, Detail, Topic, remarks_on_fit, verification};
use crate::fit::{Estimate, Gap, RegionResult};
use crate::gui::core::answer::{self, Answer, LoadedModelSummary};
use crate::gui::core::document::Method;
use crate::gui::style::{Palette, size, space, strong};
use crate::gui::view::{Side, Step};
use crate::gui::views::blocks::{self, Title};
use crate::gui::views::samples;
use crate::gui::widgets::{self, Does};
use crate::gui::workbench::Workbench;
use crate::language::spoken;
use crate::present::decision;
use crate::present::numbers::{grouped, trimmed, with_minus_signs};
use crate::present::units::Units;

pub(crate) fn show(ui: &mut Ui, workbench: &Workbench) {
    let side = workbench.view.side;
    if workbench.view.step == Step::Export {
        widgets::heading(ui, say!("Export"));
        ui.add_space(space::TIGHT);
        widgets::scroll(ui, "export", |ui| super::export::preview(ui, workbench));
        return;
    }
    if workbench.view.step == Step::Gap && side == Side::Results {
        return super::gap::findings(ui, workbench);
    }
    let sides = [
        (Side::Results, say!("Summary")),
        (Side::Samples, say!("Samples")),
    ];
    widgets::row(ui, |ui| {
        // Where there is no room for both, what is chosen says where one is.
        let title = say!("Results");
        let of_title = widgets::width_of(ui, title, strong(size::HEADING)) + space::ROW;
        if of_title + widgets::width_of_segments(ui, &sides) <= ui.available_width() {
            widgets::heading(ui, title);
        }
        ui.with_layout(egui::Layout::right_to_left(egui::Align::Center), |ui| {
            if let Some(side) = widgets::segmented(ui, &sides, side) {
                workbench.then(move |bench| bench.view.side = side);
            }
        });
    });
    ui.add_space(space::TIGHT);
    match side {
        Side::Samples => samples::show(ui, workbench),
        Side::Results => {
            widgets::scroll(ui, "results", |ui| summary(ui, workbench));
        }
    }
}

fn summary(ui: &mut Ui, workbench: &Workbench) {
    ui.spacing_mut().item_spacing.y = space::ROW;
    match workbench.identified().map(|o| &o.answer) {
        None => super::coverage::show(ui, workbench),
        Some(Err(because)) => widgets::card(ui, |ui| {
            let color = Palette::of(ui).outside;
            let title = RichText::new(say!("This could not be identified"));
            ui.label(title.font(strong(size::BODY)).color(color));
            ui.label(because);
        }),
        Some(Ok(answer)) => {
            let detail = Detail::window(workbench.units());
            blocks::problems(ui, &answer.data_problems, detail, workbench);
            identified(ui, workbench, answer);
        }
    }
}

fn identified(ui: &mut Ui, workbench: &Workbench, answer: &Answer) {
    if let Some(loaded) = &answer.loaded {
        about(ui, workbench, answer, loaded);
    }
    if !workbench.loaded_session().is_empty() {
        gap_card(ui, workbench, answer);
    }
    if let Some(verification) = answer.loaded.as_ref().and_then(|l| l.verification.as_ref()) {
        verified(ui, workbench.units(), verification);
    }
    let found = &answer.identification;
    if !found.parameters.is_empty() {
        widgets::card(ui, |ui| parameters(ui, workbench, &found.parameters));
    }
    blocks::smooth_corrections(ui, &answer.calibration.model);
    if !found.regions.is_empty() {
        widgets::card(ui, |ui| regions(ui, workbench, &found.regions));
    }
    remarks(ui, workbench, answer);
}

/// How many samples are within the tolerance, of how many; before the answer, or after it.
fn within(workbench: &Workbench, after: bool) -> Option<(usize, usize)> {
    let tolerance_mm = workbench.document().tolerance_mm?;
    let lengths = if after {
        &workbench.after()?.lengths
    } else {
        &workbench.loaded_session().overview.lengths
    };
    Some(lengths.within(tolerance_mm))
}

fn gap_card(ui: &mut Ui, workbench: &Workbench, answer: &Answer) {
    let palette = Palette::of(ui);
    let units = workbench.units();
    let found = &answer.identification;
    let number = |mm: f64| units.length_number(mm);
    widgets::card(ui, |ui| {
        let method = match found.method {
            "regional" => say!("RMS error in the plane of motion, by region"),
            answer::METHOD => say!("RMS error, model from a file"),
            _ => say!("RMS error, full model"),
        };
        ui.label(RichText::new(method).color(palette.muted));
        let [before, after] = [found.gap.before.rms_mm, found.gap.after.rms_mm].map(number);
        let unit = units.length_name();
        // Inches have more digits than a narrow panel has room.
        let line = format!("{before} → {after} {unit}");
        let font = strong(size::DISPLAY);
        let font = if widgets::width_of(ui, &line, font.clone()) > ui.available_width() {
            strong(size::HEADING)
        } else {
            font
        };
        let mut text = LayoutJob::default();
        for (part, color) in [
            (&*before, palette.before),
            (" → ", palette.muted),
            (&after, palette.after),
            (" ", palette.muted),
            (unit, palette.muted),
        ] {
            text.append(part, 0.0, TextFormat::simple(font.clone(), color));
        }
        ui.label(text);
        let from_to = |gap: &Gap, pick: fn(&Gap) -> [f64; 2]| {
            let [before, after] = pick(gap);
            format!(
                "{} → {} {}",
                number(before),
                number(after),
                units.length_name()
            )
        };
        let largest = |g: &Gap| [g.before.max_mm, g.after.max_mm];
        widgets::fact_of(ui, phrase!("largest"), from_to(&found.gap, largest));
        if let Some(held_out) = &found.held_out {
            let rms = |g: &Gap| [g.before.rms_mm, g.after.rms_mm];
            widgets::fact_of(ui, phrase!("held out"), from_to(held_out, rms));
        }
        if let (Some((before, _)), Some((after, all))) =
            (within(workbench, false), within(workbench, true))
        {
            // What the marks show, and what the robot will do, where that is known: it may be less.
            let with_model = (phrase!("within tolerance, with the model"), after);
            let corrected = workbench.corrected_within();
            let corrected = corrected.map(|n| (phrase!("within tolerance, commands corrected"), n));
            for (label, after) in std::iter::once(with_model).chain(corrected) {
                widgets::fact_of(
                    ui,
                    label,
                    say!(
                        "{before} → {after} of {all}",
                        before = grouped(before),
                        after = grouped(after),
                        all = grouped(all)
                    ),
                );
            }
            let after = corrected.map_or(after, |(_, n)| n);
            let share = after as f32 / all.max(1) as f32;
            let bar = ProgressBar::new(share).desired_height(6.0);
            ui.add(bar.fill(palette.within));
        }
        decision(ui, workbench);
    });
}

/// Whether the robot is within its tolerance, where a rule decides it.
pub(crate) fn decision(ui: &mut Ui, workbench: &Workbench) {
    let palette = Palette::of(ui);
    match workbench.decision() {
        None => {}
        Some(Err(because)) => {
            widgets::hint(ui, decision::none(&because));
        }
        Some(Ok((outcome, says))) => {
            let color = match outcome {
                Conformity::Pass => palette.within,
                Conformity::Fail => palette.outside,
                Conformity::Undecided => palette.warning,
            };
            let title = RichText::new(spoken(decision::title(outcome))).font(strong(size::BODY));
            ui.label(title.color(color));
            widgets::hint(ui, with_minus_signs(&says));
        }
    }
}

fn regions(ui: &mut Ui, workbench: &Workbench, results: &[RegionResult]) {
    // A model keeps no interval of a region.
    let intervals = workbench.document().loaded_model.is_none();
    widgets::bold(ui, say!("Correction of each region"));
    let table = explain::corrections(results, intervals, workbench.units());
    blocks::show(ui, &[table]);
    widgets::hint(
        ui,
        if intervals {
            say!("What to add, ± half the 95 % interval")
        } else {
            say!("What to add")
        },
    );
    blocks::button(ui, say!("regions"), || blocks::regions(results));
}

fn remarks(ui: &mut Ui, workbench: &Workbench, answer: &Answer) {
    let detail = Detail::window(workbench.units());
    let session = &workbench.loaded_session().session;
    for section in remarks_on_fit(&answer.identification, session, detail) {
        if section.topic == Topic::NotIdentifiable {
            // Of an arm there may be dozens.
            widgets::folded(ui, &section.title, size::SMALL, |ui| {
                blocks::show(ui, &section.blocks);
            });
            continue;
        }
        widgets::card(ui, |ui| {
            blocks::title(ui, &section, Title::Plain);
            blocks::show(ui, &section.blocks);
        });
    }
}

// A model: how it is identified (step 3); its parameters; of one that was read from a file also where it came from,
// and what it does on the session.

pub(super) fn controls(ui: &mut Ui, workbench: &Workbench) {
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
    blocks::button(ui, say!("parameters"), || blocks::parameters(estimates));
}
