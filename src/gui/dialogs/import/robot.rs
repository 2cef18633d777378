//! Whose robot was measured.

use egui::{DragValue, TextEdit, Ui};

use crate::gui::core::examples::EXAMPLES;
use crate::gui::import_draft::{Companion, ImportAnswers, ImportDraft, RobotFrom, TypedAxis};
use crate::gui::widgets;
use crate::gui::workbench::{Command, Workbench};
use crate::kinematics::{JointKind, Robot};
use crate::language;
use crate::text::length;

pub(super) fn show(
    ui: &mut Ui,
    workbench: &Workbench,
    now: &ImportDraft,
    next: &mut ImportAnswers,
    commands: &mut Vec<Command>,
) {
    widgets::section(ui, say!("Robot model"));
    let here = &workbench.loaded_session().session.robot;
    let is = |robot: &RobotFrom, other: &RobotFrom| {
        std::mem::discriminant(robot) == std::mem::discriminant(other)
    };
    let open = RobotFrom::Here(Box::new(here.clone()));
    let text = say!("that of the open session, {here}", here = here.name);
    if ui.radio(is(&next.robot, &open), text).clicked() {
        next.robot = open;
    }
    for (k, example) in EXAMPLES.iter().enumerate() {
        let one = RobotFrom::Example(k);
        let text = say!("that of the example {example}", example = example.name());
        if ui.radio(next.robot == one, text).clicked() {
            next.robot = one;
        }
    }
    let file = RobotFrom::Open.of_file(String::new());
    if ui
        .radio(is(&next.robot, &file), say!("from this file"))
        .clicked()
        && !is(&next.robot, &file)
    {
        next.robot = file;
    }
    let mut path = match &next.robot {
        RobotFrom::File { path, .. } => path.clone(),
        _ => String::new(),
    };
    let field = (
        say!("File of the robot"),
        say!("a robot, a session, or a URDF file"),
    );
    if super::parts::path(ui, field, &mut path, (Companion::Robot, now), commands) {
        next.robot = next.robot.of_file(path);
    }
    if let RobotFrom::File { path, base, tip } = &mut next.robot
        && RobotFrom::is_urdf(path)
    {
        for (row, label, link) in [
            (say!("Base"), say!("Link of the base"), base),
            (say!("Tip"), say!("Link of the tool"), tip),
        ] {
            widgets::form_row(ui, row, |ui| {
                let field = ui.add(TextEdit::singleline(link).hint_text(say!("name of a link")));
                super::parts::name(ui, &field, label);
            });
        }
    }
    let typed = matches!(next.robot, RobotFrom::Typed(_));
    if ui
        .radio(typed, say!("one axis that turns, typed here"))
        .clicked()
        && !typed
    {
        next.robot = RobotFrom::Typed(TypedAxis::default());
    }
    if let RobotFrom::Typed(typed) = &mut next.robot {
        axis(ui, typed);
    }
    match &now.seen.robot {
        None => {}
        Some(Ok(robot)) => widgets::hint(ui, in_words(robot)),
        Some(Err(because)) => {
            for line in because {
                widgets::wrong(ui, line);
            }
        }
    }
}

/// One axis that turns: its name, where it stands, where the tool is, how far it goes.
fn axis(ui: &mut Ui, typed: &mut TypedAxis) {
    widgets::form_row(ui, say!("Name"), |ui| {
        let field = ui.add(TextEdit::singleline(&mut typed.name));
        super::parts::name(ui, &field, say!("Name of the robot"));
    });
    numbers(
        ui,
        say!("Axis at home"),
        (say!("Axis"), ""),
        &["x", "y", "z"],
        &mut typed.axis,
    );
    let parts = ["x", "y", "z"];
    numbers(
        ui,
        say!("Point on it, mm"),
        (say!("Point"), "mm"),
        &parts,
        &mut typed.point_mm,
    );
    numbers(
        ui,
        say!("Tool at home, mm"),
        (say!("Tool"), "mm"),
        &parts,
        &mut typed.tool_mm,
    );
    let parts = [say!("from"), say!("to")];
    numbers(
        ui,
        say!("Travel, °"),
        (say!("Travel"), "°"),
        &parts,
        &mut typed.limits_deg,
    );
    ui.checkbox(&mut typed.gravity_down, say!("gravity points along −z"));
}

fn numbers(ui: &mut Ui, row: &str, (name, unit): (&str, &str), parts: &[&str], values: &mut [f64]) {
    widgets::form_row(ui, row, |ui| {
        for (part, value) in parts.iter().zip(values) {
            let field = DragValue::new(value).speed(1.0).max_decimals(6);
            widgets::cell_number(ui, &format!("{name} {part}"), unit, 90.0, field);
        }
    });
}

fn in_words(robot: &Robot) -> String {
    let turning = |joint: &&crate::kinematics::Joint| joint.kind == JointKind::Revolute;
    let turns = robot.joints.iter().filter(turning).count();
    let count = robot.joint_count();
    let joints = match (count, turns) {
        (1, 1) => say!("one joint that turns").to_owned(),
        (1, 0) => say!("one joint that slides").to_owned(),
        (count, turns) => say!(
            "{count} joints, {turns} of which turn",
            count = count,
            turns = turns
        ),
    };
    let reach = robot.base_from_tool.translation.vector.norm();
    say!(
        "{robot}: {joints}, tool {reach} from the base",
        robot = robot.name,
        joints = joints,
        reach = language::spoken(length(reach, 0))
    )
}
