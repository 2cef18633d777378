//! What the identification says, and how sure it is; before anything is identified what the samples cover, what can be
//! seen in them and what comes next, so that it helps from the first minute on.

use egui::{Checkbox, ProgressBar, RichText, Ui};

use crate::compensation::decision::Outcome as Conformity;
use crate::explain::{self, Detail, Topic, remarks_on_fit};
use crate::fit::{Estimate, RegionResult};
use crate::gui::core::answer::{self, Answer, LoadedModel};
use crate::gui::core::document::Method;
use crate::gui::style::{Palette, size, space, strong};
use crate::gui::view::Step;
use crate::gui::views::{blocks, copies};
use crate::gui::widgets::{self, Buttons, Does, Words};
use crate::gui::workbench::Workbench;
use crate::gui::{actions, help};
use crate::language::spoken;
use crate::present::decision;
use crate::present::names::title;
use crate::present::numbers::{grouped, trimmed, with_minus_signs};
use crate::text::capital;

pub(super) fn summary(ui: &mut Ui, workbench: &Workbench) {
    ui.spacing_mut().item_spacing.y = space::ROW;
    match workbench.identified().map(|o| &o.answer) {
        None => beforehand(ui, workbench),
        Some(Err(because)) => widgets::card(ui, |ui| {
            let title = say!("This could not be identified");
            blocks::bold_in(ui, title, Palette::of(ui).outside);
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
    if let Some(given) = &workbench.document().loaded_model {
        about(ui, workbench, given);
    }
    if !workbench.loaded_session().is_empty() {
        gap_card(ui, workbench, answer);
    }
    if let Some(verification) = &answer.verification {
        for section in explain::verification(verification, Detail::window(workbench.units())) {
            blocks::card(ui, &section);
        }
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
        &workbench.answer()?.lengths
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
        ui.weak(method);
        let [before, after] = [found.gap.before.rms_mm, found.gap.after.rms_mm].map(number);
        let unit = units.length_name();
        // Long numbers have less room than short ones.
        let wide = before.len() + after.len() + unit.len() > 11;
        let font = strong(if wide { size::HEADING } else { size::DISPLAY });
        ui.horizontal_wrapped(|ui| {
            ui.spacing_mut().item_spacing.x = 0.0;
            for (part, color) in [
                (&*before, palette.before),
                (" → ", palette.muted),
                (&after, palette.after),
                (&format!(" {unit}"), palette.muted),
            ] {
                ui.label(RichText::new(part).font(font.clone()).color(color));
            }
        });
        let from_to = |ends: [f64; 2]| {
            let [before, after] = ends.map(number);
            format!("{before} → {after} {unit}")
        };
        let largest = [found.gap.before.max_mm, found.gap.after.max_mm];
        ui.fact(say!("largest"), from_to(largest));
        if let Some(held_out) = &found.held_out {
            let rms = [held_out.before.rms_mm, held_out.after.rms_mm];
            ui.fact(say!("held out"), from_to(rms));
        }
        if let (Some((before, _)), Some((after, all))) =
            (within(workbench, false), within(workbench, true))
        {
            // What the marks show, and what the robot will do, where that is known: it may be less.
            let with_model = (say!("within tolerance, with the model"), after);
            let corrected = workbench.corrected_within();
            let corrected = corrected.map(|n| (say!("within tolerance, commands corrected"), n));
            for (label, after) in std::iter::once(with_model).chain(corrected) {
                let (before, after, all) = (grouped(before), grouped(after), grouped(all));
                ui.fact(
                    label,
                    say!("{before} → {after} of {all}", before, after, all),
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
        Some(Err(because)) => ui.hint(decision::none(&because)),
        Some(Ok((outcome, says))) => {
            let color = match outcome {
                Conformity::Pass => palette.within,
                Conformity::Fail => palette.outside,
                Conformity::Undecided => palette.warning,
            };
            blocks::bold_in(ui, &spoken(decision::title(outcome)), color);
            ui.hint(with_minus_signs(&says));
        }
    }
}

fn regions(ui: &mut Ui, workbench: &Workbench, results: &[RegionResult]) {
    // A model keeps no interval of a region.
    let intervals = workbench.document().loaded_model.is_none();
    ui.bold(say!("Correction of each region"));
    let table = explain::corrections(results, intervals, workbench.units());
    blocks::show(ui, &[table]);
    ui.hint(say!("What to add"));
    if intervals {
        ui.hint(say!("± half the 95 % interval"));
    }
    copies::button(ui, workbench, say!("regions"), || copies::regions(results));
}

fn remarks(ui: &mut Ui, workbench: &Workbench, answer: &Answer) {
    let detail = Detail::window(workbench.units());
    let session = &workbench.loaded_session().session;
    for section in remarks_on_fit(&answer.identification, session, detail) {
        if section.topic == Topic::NotIdentifiable {
            // Of an arm there may be dozens.
            ui.folded(&section.title, |ui| blocks::show(ui, &section.blocks));
        } else {
            blocks::card(ui, &section);
        }
    }
}

// A model: how it is identified (step 3); its parameters; of one that was read from a file also where it came from,
// and what it does on the session.

pub(super) fn controls(ui: &mut Ui, workbench: &Workbench) {
    let document = workbench.document();
    if let Some(given) = &document.loaded_model {
        ui.hint(say!(
            "The model in {given} takes the place of an identification",
            given = given.file_name()
        ));
        if workbench.loaded_session().is_empty() {
            ui.hint(say!("Open a session that was measured on this robot"));
            return;
        }
        let anew = ui.secondary(say!("Identify from this session"));
        return anew.does(workbench, |bench| bench.identify(None));
    }
    if workbench.loaded_session().single_revolute() {
        ui.section(say!("Method"));
        let methods = [
            (Method::Exact, &*capital(say!("full model"))),
            (Method::Regional, &*capital(say!("by region"))),
        ];
        if let Some(method) = ui.segmented(&methods, document.method) {
            workbench.edits(move |document| document.choose_method(method));
        }
    }
    match document.method {
        Method::Exact => {
            effects(ui, workbench);
        }
        Method::Regional => {
            ui.hint(say!(
                "The source paper's method: a constant correction of angle and radius for each region, to compare with earlier reports"
            ));
            let n = document.regions.len();
            ui.fact(say!("regions"), n.to_string());
            ui.link(say!("Change the regions"))
                .does(workbench, move |bench| bench.view.step = Step::Regions);
        }
    }
}

fn effects(ui: &mut Ui, workbench: &Workbench) {
    let document = workbench.document();
    let loaded_session = workbench.loaded_session();
    ui.section(say!("Effects to fit"));
    ui.spacing_mut().item_spacing.y = 4.0;
    for id in &loaded_session.coverage.testable {
        let id = *id;
        let on = document.effects.contains(&id);
        // What a diagnosis has added is switched where it was added.
        let is_added = !on && document.in_the_model().any(|t| t.effect.about().id == id);
        let mut shown = on || is_added;
        let switch = Checkbox::new(&mut shown, title(id));
        let switch = ui.add_enabled(!is_added, switch);
        if widgets::explained_effect(switch, id).changed() {
            workbench.edits(move |document| document.choose_effect(id, shown));
        }
    }
    not_testable(ui, workbench);
}

pub(super) fn next(ui: &mut Ui, workbench: &Workbench) {
    let document = workbench.document();
    if !document.identified {
        return actions::IDENTIFY.next(ui, workbench);
    }
    actions::go_on(ui, workbench, Step::Gap);
}

/// What there is to say about a model that was read from a file.
fn about(ui: &mut Ui, workbench: &Workbench, given: &LoadedModel) {
    let calibration = &*given.calibration;
    widgets::card(ui, |ui| {
        ui.bold(say!("Model from a file"));
        ui.fact(say!("file"), given.file_name());
        ui.fact(say!("robot"), &calibration.model.robot.name);
        ui.fact(say!("identified from"), &calibration.session);
        let joints = &calibration.model.robot.joints;
        for (joint, range) in joints.iter().zip(&calibration.measured) {
            let ends = [range.from, range.to].map(|q| trimmed(joint.kind.to_display(q), 2));
            let [from, to] = ends.map(|value| value + joint.kind.sign());
            let name = match joints.len() {
                1 => say!("measured").to_owned(),
                _ => say!("measured, {joint}", joint = joint.name),
            };
            ui.fact(&name, format!("{from} … {to}"));
        }
        if workbench.loaded_session().is_empty() {
            ui.hint(say!("Open a session that was measured on this robot"));
        }
    });
}

/// What was identified.
fn parameters(ui: &mut Ui, workbench: &Workbench, estimates: &[Estimate]) {
    ui.bold(say!("Identified parameters"));
    let robot = &workbench.loaded_session().session.robot;
    let detail = Detail::window(workbench.units());
    blocks::show(ui, &explain::values(estimates, robot, detail));
    if robot.joints.len() < 2 {
        ui.hint(say!("± half the 95 % interval"));
    }
    copies::button(ui, workbench, say!("parameters"), || {
        copies::parameters(estimates)
    });
}

// What is known before anything is identified.

/// Shows it, what belongs to the step first.
pub(super) fn beforehand(ui: &mut Ui, workbench: &Workbench) {
    if workbench.loaded_session().is_empty() {
        return;
    }
    match workbench.view.step {
        Step::Session | Step::Regions => {
            nominal(ui, workbench);
            testable(ui, workbench);
        }
        Step::Gap => testable(ui, workbench),
        // The effects that can be tested are those to choose from.
        Step::Identify | Step::Export => nominal(ui, workbench),
    }
}

/// How far off the nominal robot is.
fn nominal(ui: &mut Ui, workbench: &Workbench) {
    let units = workbench.units();
    let loaded_session = workbench.loaded_session();
    widgets::card(ui, |ui| {
        let name = ui.weak(say!("RMS error, nominal robot"));
        widgets::explained(name, help::GAP);
        let rms = loaded_session.gap_before;
        let rms = rms.map_or_else(|| "–".to_owned(), |g| units.length(g.rms_mm));
        let rms = RichText::new(rms).font(strong(size::DISPLAY));
        ui.label(rms.color(Palette::of(ui).before));
        if let Some(gap) = loaded_session.gap_before {
            ui.fact(say!("largest deviation"), units.length(gap.max_mm));
        }
        if let Some((inside, all)) = within(workbench, false) {
            let (inside, all) = (grouped(inside), grouped(all));
            let within = say!("{inside} of {all}", inside, all);
            ui.fact(say!("within tolerance"), within);
        }
        if let Some(floor_mm) = loaded_session.coverage.floor_mm {
            let floor = say!("{floor}, instrument", floor = units.length(floor_mm));
            ui.fact(say!("noise floor"), floor);
        }
    });
}

/// Which effects can be seen in such samples, and which cannot.
fn testable(ui: &mut Ui, workbench: &Workbench) {
    let loaded_session = workbench.loaded_session();
    widgets::card(ui, |ui| {
        let known = &loaded_session.coverage;
        let can = say!("{yes} effects can be tested", yes = known.testable.len());
        ui.folded(&can, |ui| {
            let names = known.testable.iter();
            let names: Vec<&str> = names.map(|id| title(id)).collect();
            ui.hint(names.join(", ").to_lowercase());
        });
        not_testable(ui, workbench);
    });
}

/// The effects that cannot be seen, each with the reason.
fn not_testable(ui: &mut Ui, workbench: &Workbench) {
    let all = &workbench.loaded_session().coverage.not_testable;
    if all.is_empty() {
        return;
    }
    let cannot = say!("{no} not testable, and why", no = all.len());
    ui.folded(&cannot, |ui| {
        for (effect, because) in all {
            ui.label(title(effect));
            ui.hint(spoken(because));
        }
    });
}
