//! The form of a simulation of a robot of the library or of one that was typed.

use egui::{DragValue, Ui};

use crate::gui::core::simulate::SimulatedRobot;
use crate::gui::core::simulate::{Form, field};
use crate::gui::widgets;
use crate::gui::workbench::Command;

use super::simulation::{effects, ends, number};

/// Wide enough for an effect with a joint and three numbers in one row, points.
const WIDTH: f32 = 640.0;

pub(super) fn show(ui: &mut Ui, robot: &SimulatedRobot, form: &Form, commands: &mut Vec<Command>) {
    ui.set_width(WIDTH);
    widgets::heading(ui, &robot.title);
    widgets::hint(
        ui,
        say!(
            "Random poses within the joint limits, three reflectors at the tool, speeds, loads and a warm-up mixed. The effects below are hidden in the robot: identification and diagnosis should find them"
        ),
    );
    let mut filled = form.clone();
    let wrong = form.problems();
    widgets::section(ui, say!("Measurement"));
    let poses = DragValue::new(&mut filled.poses).speed(1.0);
    number(ui, &wrong, (field::POSES, ""), poses);
    let noise = DragValue::new(&mut filled.noise_mm)
        .speed(0.002)
        .max_decimals(4);
    number(ui, &wrong, (field::NOISE, "mm"), noise.suffix(" mm"));
    let seed = DragValue::new(&mut filled.seed);
    widgets::number(ui, say!("random seed"), "", seed);
    widgets::section(ui, say!("Hidden effects"));
    effects(ui, &mut filled, &wrong);
    ends(ui, filled, form, commands);
}
