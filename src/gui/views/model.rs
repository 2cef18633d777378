//! A model: its parameters; of one that was read from a file also where it came from, and what it does on
//! the session.

use egui::{RichText, Ui};

use crate::compensation::Verification;
use crate::explain::{self, Detail, verification};
use crate::fit::Estimate;
use crate::gui::core::answer::{Answer, LoadedModelSummary};
use crate::gui::style::tokens::{Palette, size, space, strong};
use crate::gui::widgets::{self, dense};
use crate::gui::workbench::Workbench;
use crate::present::names::{parameter, title_on};
use crate::present::numbers::trimmed;
use crate::present::units::Units;

use super::cards::{implausible, title};
use super::{blocks, copies};

/// What there is to say about the model itself.
pub(super) fn about(
    ui: &mut Ui,
    workbench: &Workbench,
    answer: &Answer,
    loaded: &LoadedModelSummary,
) {
    let calibration = &answer.calibration;
    widgets::card(ui, |ui| {
        title(ui, say!("Model from a file"));
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
    title(ui, say!("How it came about"));
    for step in &answer.calibration.history {
        let gap = units.length(step.gap_mm);
        let gap = match step.held_out_mm {
            Some(held_out) => say!(
                "{gap}, held out {held_out}",
                gap = gap,
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
            title(ui, &section.title);
            blocks::show(ui, &section.blocks);
        });
    }
}

/// What was identified.
pub(super) fn parameters(ui: &mut Ui, workbench: &Workbench, estimates: &[Estimate]) {
    title(ui, say!("Identified parameters"));
    match workbench.loaded_session().session.robot.joints.len() {
        joints @ ..=1 => listed(ui, estimates, joints, workbench.units()),
        _ => geometry(ui, workbench, estimates),
    }
    copies::button(ui, say!("parameters"), || copies::parameters(estimates));
}

/// The parameters of an arm: a row for each joint, the frames, the others.
fn geometry(ui: &mut Ui, workbench: &Workbench, estimates: &[Estimate]) {
    let robot = &workbench.loaded_session().session.robot;
    let detail = Detail::window(workbench.units());
    blocks::show(ui, &explain::values(estimates, robot, detail));
}

/// The parameters of a single joint, one below the other.
fn listed(ui: &mut Ui, estimates: &[Estimate], joints: usize, units: Units) {
    let palette = Palette::of(ui);
    dense(ui);
    let mut last = None;
    for one in estimates {
        let of = whose(one);
        if last != Some((one.effect, one.joint, of)) {
            last = Some((one.effect, one.joint, of));
            let name = title_on(one.effect, one.joint, joints);
            let name = of.map_or(name.clone(), |of| format!("{name}, {of}"));
            ui.add_space(space::TIGHT);
            let name = RichText::new(name).color(palette.muted).size(size::SMALL);
            let name = ui.add(egui::Label::new(name).wrap());
            widgets::explained_effect(name, one.effect);
        }
        let (name, unit) = parameter(one.name);
        let (value, half, unit) = units.estimate(one, unit);
        estimate(ui, &name, &value, format!("{half} {unit}").trim_end());
    }
    implausible(ui, estimates);
    widgets::hint(ui, say!("± half the 95 % interval"));
}

/// The target, place or setup that a parameter belongs to: where there are several, each has its own.
fn whose(one: &Estimate) -> Option<&str> {
    let of = [&one.target, &one.place, &one.setup];
    of.into_iter()
        .flatten()
        .map(String::as_str)
        .find(|name| !name.is_empty())
}

/// A parameter: its name, its value and how sure that is, each in a column of one width throughout,
/// so that a long name does not push the numbers out; the last below the others where all three
/// have no room.
fn estimate(ui: &mut Ui, name: &str, value: &str, half: &str) {
    const NAME: f32 = 80.0;
    const VALUE: f32 = 72.0;
    const HALF: f32 = 110.0;
    let middle = egui::Align::Center;
    let to_the_left = egui::Layout::left_to_right(middle);
    let to_the_right = egui::Layout::right_to_left(middle);
    let muted = Palette::of(ui).muted;
    let half = RichText::new(half).size(size::SMALL).color(muted);
    let value = RichText::new(value).font(strong(size::BODY));
    let cell = |ui: &mut Ui, width: f32, layout: egui::Layout, text: RichText| {
        let room = egui::vec2(width, ui.spacing().interact_size.y);
        ui.allocate_ui_with_layout(room, layout, |ui| {
            ui.set_min_width(width);
            ui.label(text);
        });
    };
    let all = ui.available_width();
    let roomy = all >= NAME + VALUE + HALF + 2.0 * space::ROW;
    ui.horizontal(|ui| {
        ui.spacing_mut().item_spacing.x = space::ROW;
        if roomy {
            cell(ui, NAME, to_the_left, RichText::new(name));
            cell(ui, VALUE, to_the_right, value);
            ui.label(half.clone());
        } else {
            let left = all - HALF - space::ROW;
            cell(ui, left, to_the_left, RichText::new(name));
            cell(ui, HALF, to_the_right, value);
        }
    });
    if !roomy {
        ui.with_layout(egui::Layout::top_down(egui::Align::Max), |ui| {
            ui.label(half)
        });
    }
}
