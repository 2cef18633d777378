//! The form of a simulation of a robot of the library or of one that was typed.

use egui::{DragValue, Ui};

use crate::gui::core::simulate::SimulatedRobot;
use crate::gui::core::simulate::{Form, field};
use crate::gui::widgets;
use crate::gui::workbench::Command;

use super::simulation::{effects, ends, number};

pub(super) fn show(ui: &mut Ui, robot: &SimulatedRobot, form: &Form, commands: &mut Vec<Command>) {
    ui.set_width(520.0);
    widgets::heading(ui, &robot.title);
    widgets::hint(
        ui,
        say!(
            "Poses anywhere in the ranges of the joints, three reflectors at the tool, speeds, loads and a warm-up mixed over them. What is filled in here is what the diagnosis should find"
        ),
    );
    let mut filled = form.clone();
    let wrong = form.problems();
    widgets::section(ui, say!("Instrument"));
    let poses = DragValue::new(&mut filled.poses).speed(1.0);
    number(ui, &wrong, (field::POSES, ""), poses);
    let noise = DragValue::new(&mut filled.noise_mm)
        .speed(0.002)
        .max_decimals(4);
    number(ui, &wrong, (field::NOISE, "mm"), noise.suffix(" mm"));
    let seed = DragValue::new(&mut filled.seed);
    widgets::number(ui, say!("seed"), "", seed);
    widgets::section(ui, say!("Effects"));
    effects(ui, &mut filled, &wrong);
    ends(ui, filled, form, commands);
}
