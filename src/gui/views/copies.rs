//! Tables as text for a spreadsheet: tabs between the columns, full digits, the decimal sign that
//! the user chose.

use std::time::Duration;

use egui::{Button, Id, Popup, PopupKind, RichText, Ui, vec2};

use crate::diagnosis::{Diagnosis, NextPose, Sight};
use crate::effects::find;
use crate::fit::{Estimate, RegionResult};
use crate::gui::style::tokens::{size, space};
use crate::gui::units::{cell, plain_number};
use crate::gui::widgets;
use crate::gui::workbench::Workbench;
use crate::kinematics::Robot;
use crate::units::deg_from_rad;

use super::names::named;

/// A button that copies a table.
pub(super) fn button(ui: &mut Ui, of: &str, text: impl FnOnce() -> String) {
    ui.add_space(space::TIGHT);
    let id = ui.scope_id().with(("copied", of));
    let copied = is_recent(ui, id);
    // Higher than the rows of a dense table: it is pressed, not read. As wide as its longest text.
    let says = if copied { "Copied" } else { "Copy table" };
    let button = Button::new(RichText::new(says).size(size::SMALL));
    let button = ui.add(button.min_size(vec2(78.0, 22.0)));
    ui.ctx().accesskit_node_builder(button.id, |node| {
        let says = if copied { "Copied" } else { "Copy" };
        node.set_label(format!("{says} table of {of}"));
    });
    if button.clicked() {
        ui.copy_text(text());
        remember(ui, id);
    }
}

/// How long a copy says that it was made, s.
const SAID: f64 = 2.0;

fn remember(ui: &Ui, id: Id) {
    let now = ui.input(|input| input.time);
    ui.data_mut(|data| data.insert_temp(id, now));
    ui.ctx().request_repaint();
}

/// Whether this was copied a moment ago.
fn is_recent(ui: &Ui, id: Id) -> bool {
    let copied: Option<f64> = ui.data(|data| data.get_temp(id));
    let now = ui.input(|input| input.time);
    let left = copied.map(|copied| copied + SAID - now);
    let Some(left) = left.filter(|left| (0.0..=SAID).contains(left)) else {
        return false;
    };
    ui.ctx()
        .request_repaint_after(Duration::from_secs_f64(left));
    true
}

/// The mark in a chart's bar that copies its numbers.
pub(super) fn chart_button(ui: &mut Ui, of: &str, text: impl FnOnce() -> String) {
    let says = format!("Copy numbers: {}", of.to_lowercase());
    let id = ui.scope_id().with(("copied", of));
    let button = widgets::copy_button(ui, &says);
    if button.clicked() {
        ui.copy_text(text());
        remember(ui, id);
    }
    if is_recent(ui, id) {
        // What lies beneath it can be clicked all the same.
        Popup::from_response(&button)
            .kind(PopupKind::Tooltip)
            .interactable(false)
            .show(|ui| ui.label("Copied"));
    }
}

/// What was found, parameter by parameter, each with the evidence of its name.
pub(super) fn found(d: &Diagnosis) -> String {
    let mut text = "effect\tjoint\tparameter\tvalue\t95 % from\t95 % to\tunit\tnoise alone, 1 of\t\
                    odds over the next candidate\tshare\tRMS error before, mm\tRMS error after, mm\t\
                    held-out gap before, mm\theld-out gap after, mm\n"
        .to_owned();
    for found in &d.found {
        let [held_before, held_after] = ends(found.held_out_mm);
        for one in &found.parameters {
            let mut cells = estimate(one).to_vec();
            cells.extend([
                plain_number((1.0 / found.p_family.p).round()),
                plain_number(found.odds_over_next),
                plain_number(found.share),
                plain_number(found.gap_mm[0]),
                plain_number(found.gap_mm[1]),
                held_before.clone(),
                held_after.clone(),
            ]);
            row(&mut text, &cells);
        }
    }
    text
}

/// How large each effect could be without having been seen; an empty size was not to be seen at all.
pub(super) fn limits(d: &Diagnosis) -> String {
    let mut text = "effect\tjoint\tparameter\tdetection limit (95 %)\tunit\n".to_owned();
    for limit in &d.not_found {
        for (name, size) in &limit.sizes {
            let (parameter, unit) = named(name);
            let size = match Sight::of(*size) {
                Sight::Above(size) => plain_number(size),
                Sight::AtAnySize => plain_number(0.0),
                Sight::AtNoSize => String::new(),
            };
            let cells = [
                title(limit.effect),
                number_of(limit.joint.map(|joint| joint + 1)),
                parameter,
                size,
                unit.to_owned(),
            ];
            row(&mut text, &cells);
        }
    }
    text
}

/// The poses to measure next, with everything that the measuring list holds.
pub(super) fn poses(poses: &[NextPose], robot: &Robot) -> String {
    let joints = || robot.joints.iter().enumerate();
    let mut heads: Vec<String> = joints()
        .map(|(j, joint)| format!("q{}, {}", j + 1, joint.kind.unit()))
        .collect();
    heads.extend(joints().map(|(j, _)| format!("from, joint {}", j + 1)));
    heads.extend(joints().map(|(j, joint)| format!("speed{}, {}/s", j + 1, joint.kind.unit())));
    heads.extend(
        [
            "load, kg",
            "temperature, °C",
            "reflector",
            "x, mm",
            "y, mm",
            "z, mm",
            "why",
        ]
        .map(str::to_owned),
    );
    let mut text = String::new();
    row(&mut text, &heads);
    let optional = |value: Option<f64>| value.map_or_else(String::new, plain_number);
    for pose in poses {
        let outer = |(j, value): (usize, &f64)| plain_number(robot.joints[j].kind.outer(*value));
        let mut cells: Vec<String> = pose.q.iter().enumerate().map(outer).collect();
        cells.extend(pose.dir.iter().map(|dir| plain_number(*dir)));
        match &pose.speed {
            Some(speed) => cells.extend(speed.iter().enumerate().map(outer)),
            None => cells.extend(joints().map(|_| String::new())),
        }
        cells.extend([optional(pose.load_kg), optional(pose.temperature_c)]);
        cells.push(pose.target.as_deref().map_or_else(String::new, cell));
        for axis in 0..3 {
            cells.push(optional(pose.target_mm.map(|at| at[axis])));
        }
        cells.push(cell(&pose.why));
        row(&mut text, &cells);
    }
    text
}

/// Sample by sample: what was commanded and measured, and how far that is from the simulation.
pub(super) fn samples(workbench: &Workbench) -> String {
    let subject = workbench.subject();
    let (session, answer) = (&subject.session, workbench.answer());
    let mut heads = vec!["sample".to_owned()];
    let joints = session.robot.joints.iter().enumerate();
    heads.extend(joints.map(|(j, joint)| format!("q{}, {}", j + 1, joint.kind.unit())));
    let others = [
        "reflector",
        "x, mm",
        "y, mm",
        "z, mm",
        "before, mm",
        "after, mm",
    ];
    heads.extend(others.map(str::to_owned));
    let mut text = String::new();
    row(&mut text, &heads);
    let samples = &session.samples;
    let known = |value: f64| {
        if value.is_finite() {
            plain_number(value)
        } else {
            String::new()
        }
    };
    for sample in 0..subject.len() {
        let mut cells = vec![(sample + 1).to_string()];
        let joints = session.robot.joints.iter().zip(&samples.q);
        cells.extend(joints.map(|(joint, q)| known(joint.kind.outer(q[sample]))));
        let target = samples
            .target
            .as_ref()
            .map(|target| target[sample] as usize);
        let target = target.and_then(|target| session.targets.get(target));
        cells.push(target.map_or_else(String::new, |target| cell(&target.name)));
        let z = samples.z_mm.as_ref().map_or(f64::NAN, |z| z[sample]);
        let before = subject.before.length_mm[sample];
        let after = answer.map_or(f64::NAN, |answer| answer.lengths_mm[sample]);
        let numbers = [samples.x_mm[sample], samples.y_mm[sample], z, before, after];
        cells.extend(numbers.map(known));
        row(&mut text, &cells);
    }
    text
}

fn title(effect: &str) -> String {
    find(effect)
        .map_or(effect, |effect| effect.about().title)
        .to_owned()
}

fn number_of(joint: Option<usize>) -> String {
    joint.map_or_else(String::new, |joint| joint.to_string())
}

/// The cells of a parameter with its interval.
fn estimate(one: &Estimate) -> [String; 7] {
    let (name, unit) = named(one.name);
    let [from, to] = ends(one.ci95);
    [
        title(one.effect),
        number_of(one.joint),
        name,
        plain_number(one.value),
        from,
        to,
        unit.to_owned(),
    ]
}

/// Every parameter with its interval.
pub(super) fn parameters(estimates: &[Estimate]) -> String {
    let mut text = "effect\tjoint\tparameter\tvalue\t95 % from\t95 % to\tunit\n".to_owned();
    for one in estimates {
        row(&mut text, &estimate(one));
    }
    text
}

/// Every region's correction with its intervals.
pub(super) fn regions(results: &[RegionResult]) -> String {
    let mut text = "region\tfrom, deg\tto, deg\tsamples\tdtheta, rad\t95 % from\t95 % to\t\
                    dl1, mm\t95 % from\t95 % to\tgap before, mm\tgap after, mm\n"
        .to_owned();
    for result in results {
        let correction = &result.correction;
        let ([theta_from, theta_to], [l1_from, l1_to]) =
            (ends(result.theta_ci95), ends(result.l1_ci95));
        row(
            &mut text,
            &[
                cell(&correction.name),
                plain_number(deg_from_rad(correction.from_rad)),
                plain_number(deg_from_rad(correction.to_rad)),
                correction.samples.to_string(),
                plain_number(correction.theta_rad),
                theta_from,
                theta_to,
                plain_number(correction.l1_mm),
                l1_from,
                l1_to,
                plain_number(result.rms_before_mm),
                plain_number(result.rms_after_mm),
            ],
        );
    }
    text
}

fn ends(interval: Option<[f64; 2]>) -> [String; 2] {
    interval.map_or_else(Default::default, |ends| ends.map(plain_number))
}

fn row(text: &mut String, cells: &[String]) {
    *text += &cells.join("\t");
    text.push('\n');
}
