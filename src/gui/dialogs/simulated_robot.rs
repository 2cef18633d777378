//! The form of a simulation of a robot of the library.

use egui::{DragValue, Ui};

use crate::gui::core::simulate::{Form, field};
use crate::gui::view::Sheet;
use crate::gui::widgets;
use crate::gui::workbench::Command;
use crate::robots::LibraryRobot;

use super::simulation::{effects, number};

pub(super) fn show(ui: &mut Ui, robot: &LibraryRobot, form: &Form, commands: &mut Vec<Command>) {
    ui.set_width(520.0);
    widgets::heading(ui, &robot.title());
    widgets::hint(ui, say!("simulation-a-robot-of-the-library"));
    let mut filled = form.clone();
    let wrong = form.problems();
    widgets::section(ui, say!("common-instrument"));
    let poses = DragValue::new(&mut filled.poses).speed(1.0);
    number(ui, &wrong, (field::POSES, ""), poses);
    let noise = DragValue::new(&mut filled.noise_mm)
        .speed(0.002)
        .max_decimals(4);
    number(ui, &wrong, (field::NOISE, "mm"), noise.suffix(" mm"));
    let seed = DragValue::new(&mut filled.seed);
    widgets::number(ui, say!("simulation-seed"), "", seed);
    effects(ui, &mut filled, &wrong);
    if !wrong.is_empty() {
        widgets::hint(ui, say!("simulation-what-stands-in-colour-above"));
    }
    let ready = filled.problem().is_none();
    if super::ends::buttons_without_enter(ui, say!("simulation-simulate"), ready, commands) {
        commands.push(Command::Simulate(filled));
    } else if filled != *form {
        commands.push(Command::Sheet(Some(Sheet::Simulate(filled))));
    }
}
