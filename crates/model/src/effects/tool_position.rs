//! Tool position: `M → M + R (x, y, z)`, R the tool frame's rotation at home: the targets are elsewhere behind the
//! last joint, all of them by the same shift, or one of them by its own.
//!
//! Belongs to the calibration of every robot with several joints and is never a candidate. The term's setting is 0 for
//! the shift that all targets share, else the target, counted from 1. Coefficients are in the tool frame, mm.

use super::about::{About, Form, Prior, Quantity, Role, Setting, Stage};
use super::base_offset::AXES;
use super::block::Block;
use super::needs::Need;
use super::{Effect, Placed, Term};
use crate::kinematics::Robot;
use crate::lanes::{scaled, times};
use crate::text::{Text, entered};

const ABOUT: About = About {
    id: "tool-position",
    title: phrase!("Tool position"),
    stage: Stage::Tool,
    per_joint: false,
    form: Form::Plain(&Quantity::XYZ_MM),
    setting: Setting::Target,
    equation: "target = target + (x, y, z) in the tool frame",
    source: "Mooring, Roth & Driels, Fundamentals of Manipulator Calibration, 1991",
    cause: phrase!("the tool data in the controller, or the place of the target on the tool"),
    usual_size: phrase!("0.1 to 50 mm"),
    confused_with: phrase!(
        "the zero of the last joint, where all targets sit at one distance from its axis"
    ),
    check: phrase!("measure the targets on the tool"),
    needs: &[SEVERAL_JOINTS],
    role: Role::ToolPlace,
    priors: &[Prior::of(50.0); 3],
    ..About::PLAIN
};

const SEVERAL_JOINTS: Need = Need::of_samples(Need::SEVERAL_JOINTS, |survey, _| {
    (survey.joints.len() == 1)
        .then(|| text!("the robot has a single axis: link length takes its place"))
});

/// The effect `tool-position`: three shifts of the targets in the tool's frame.
pub static TOOL_POSITION: Effect = Effect {
    remedy: Some(remedy),
    ..Effect::new(ABOUT, act)
};

fn remedy(_: &Robot, term: &Term) -> Text {
    if term.setting > 0.0 {
        return text!(
            "comes from the reflector's position, not from the robot: measure the targets on the tool"
        );
    }
    let by = &term.coefficients;
    text!(
        "move the tool's point in the controller by {shift} in the tool frame",
        shift = entered([by[0], by[1], by[2]])
    )
}

fn act(me: &Placed, block: &mut Block) {
    let turn = block.robot.base_from_tool.rotation.to_rotation_matrix();
    let turn = turn.matrix();
    let columns: [[f64; 3]; 3] =
        std::array::from_fn(|k| [turn[(0, k)], turn[(1, k)], turn[(2, k)]]);
    let rows: [[f64; 3]; 3] = std::array::from_fn(|k| [turn[(k, 0)], turn[(k, 1)], turn[(k, 2)]]);
    let own = [me.coefficients[0], me.coefficients[1], me.coefficients[2]];
    let shift = times(rows, own);
    let setting = me.setting;
    block.displace(me, |at| {
        let mine = setting == 0.0 || at.target + 1.0 == setting;
        if mine {
            (shift, columns)
        } else {
            (scaled(shift, 0.0), [scaled(AXES[0], 0.0); 3])
        }
    });
}
