//! Tool orientation: `M → M · R(ω)`: the tool, and with it all its targets, is turned about its
//! origin. ω is a rotation vector in the tool frame, rad.
//!
//! Belongs to the calibration of a robot with several joints where orientation is measured, or where
//! several targets of known arrangement show it; never a candidate.

use super::about::{About, Form, Prior, Quantity, Role, Stage};
use super::base_offset::AXES;
use super::block::Block;
use super::needs::Need;
use super::rotation::{left_jacobian, rotation};
use super::units::Unit;
use super::{Effect, Placed};
use crate::fewest;
use crate::lanes::{add_scaled, cross, minus, times};

const ABOUT: About = About {
    id: "tool-orientation",
    title: phrase!("Tool orientation"),
    stage: Stage::Tool,
    per_joint: false,
    form: Form::Plain(&[
        Quantity::new("about_x_mrad", Unit::MILLIRADIAN),
        Quantity::new("about_y_mrad", Unit::MILLIRADIAN),
        Quantity::new("about_z_mrad", Unit::MILLIRADIAN),
    ]),
    equation: "M = M R(ω)",
    source: "Mooring, Roth & Driels, Fundamentals of Manipulator Calibration, 1991",
    cause: phrase!("the tool is mounted turned, or its data in the controller are"),
    usual_size: phrase!("0.1 to 50 mrad"),
    confused_with: phrase!("the zero of the last joint, which turns the tool as well"),
    check: phrase!("the tool data in the controller"),
    needs: &[SEVERAL_JOINTS, THREE_TARGETS],
    role: Role::ToolTurn,
    priors: &[Prior::of(0.1); 3],
    ..About::PLAIN
};

const SEVERAL_JOINTS: Need = Need::of_samples(Need::SEVERAL_JOINTS, |survey, _| {
    (survey.joints.len() == 1)
        .then(|| text!("the robot has a single axis: its zero offset takes its place"))
});

/// Enough targets to determine the orientation of the tool.
const THREE_TARGETS: Need =
    Need::of_samples(phrase!("three targets, or orientation"), |survey, _| {
        (survey.targets < fewest::OF_A_BODY).then(|| {
            text!(
                "orientation is not measured, and {targets} of three targets on the tool",
                targets = survey.targets
            )
        })
    });

/// The effect `tool-orientation`: three turns of the tool about its own axes.
pub static TOOL_ORIENTATION: Effect = Effect::new(ABOUT, act);

fn act(me: &Placed, block: &mut Block) {
    let tool = block.robot.base_from_tool;
    let to_base = |v: [f64; 3]| -> [f64; 3] { (tool.rotation * nalgebra::Vector3::from(v)).into() };
    let origin: [f64; 3] = tool.translation.vector.into();
    // The same turn, seen from the base.
    let omega = to_base([me.coefficients[0], me.coefficients[1], me.coefficients[2]]);
    let turn = rotation(omega);
    let left = left_jacobian(omega);
    let spins = AXES.map(|axis| times(left, to_base(axis)));
    block.transform(me, |p, _| {
        let arm = times(turn, minus(p, origin));
        let columns = spins.map(|spin| cross(spin, arm));
        (add_scaled(arm, origin, 1.0), turn, columns)
    });
}
