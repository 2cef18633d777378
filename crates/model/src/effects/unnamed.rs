//! Corrections that predict poses that no fit has seen and have no name: corrections of a joint's angle and of its
//! axis that follow the poses, with numbers that a diagnosis set and no later fit changes.
//!
//! ```text
//! p = exp([ξ] w s_t) (p + w s_r r + w s_a a),   s_d(q, conditions) a [`Rest`], w its fade
//! ```
//!
//! p is turned first, by w s about each of three directions through the point of the axis that the robot's description
//! names.
//!
//! Not an effect of the catalogue: nothing is claimed of its cause. It has no coefficients. Outside the
//! measured range of the joints that it follows it fades to nothing.

use std::sync::Arc;

use super::about::{About, Form, Role, Stage};
use super::block::Block;
use super::needs::Need;
use super::torque::torque_nm;
use super::unexplained::displaced;
use super::{Effect, Inputs, Placed, Term};
use crate::kinematics::{JointKind, Robot};
use crate::lanes::LANES;

use super::rest::{MOVES, Rest, RestPoint};

/// The name under which it is written in models.
pub const UNNAMED: &str = "unnamed";

const ABOUT: About = About {
    id: UNNAMED,
    title: phrase!("Unnamed part of the model"),
    stage: Stage::Link,
    form: Form::Plain(&[]),
    equation: "p = exp([ξ] w s_t) (p + w s_r r + w s_a a)",
    source: "restricted likelihood: Harville 1977; Wood, Generalized Additive Models, 2017",
    cause: phrase!("unknown: it predicts, and no name is proven for it"),
    usual_size: phrase!("any"),
    confused_with: phrase!("whatever was not measured: it holds for the measured range"),
    check: phrase!("gravity, gears and bearings of the joint"),
    needs: &[NO_NAME],
    role: Role::Unexplained,
    ..About::PLAIN
};

/// It has no name by which it could be fitted.
const NO_NAME: Need = Need::of_samples(phrase!("a diagnosis"), |_, _| {
    Some(text!(
        "it is not an effect that can be fitted by its name: `truepose diagnose` adds it where it \
         predicts unseen poses"
    ))
});

/// The effect `unnamed`: what predicts unseen poses and has no proven name.
pub static REST: Effect = Effect::new(ABOUT, act);

/// By how much a command is moved to find how the correction follows it, rad or mm.
const STEP: [f64; 2] = [2e-6, 1e-4];

fn act(me: &Placed, block: &mut Block) {
    let Some(rest) = me.rest.clone() else { return };
    let robot = block.robot;
    let joints = robot.joints.len();
    let mut poses: Vec<RestPoint> = (0..LANES)
        .map(|lane| at(robot, block, me.joint, lane))
        .collect();
    let values: [[f64; MOVES]; LANES] = std::array::from_fn(|lane| rest.at(&poses[lane]));
    let mut slopes = Vec::new();
    if block.by_command() {
        for joint in (0..joints).filter(|j| rest.follows(me.joint, *j)) {
            let step = match robot.joints[joint].kind {
                JointKind::Revolute => STEP[0],
                JointKind::Prismatic => STEP[1],
            };
            let mut slope = [[0.0; MOVES]; LANES];
            for (pose, slope) in poses.iter_mut().zip(&mut slope) {
                let here = pose.q[joint];
                pose.q[joint] = here + step;
                let above = rest.at(pose);
                pose.q[joint] = here - step;
                let below = rest.at(pose);
                pose.q[joint] = here;
                *slope = std::array::from_fn(|d| (above[d] - below[d]) / (2.0 * step));
            }
            slopes.push((joint, slope));
        }
    }
    displaced(me, block, &values, &slopes);
}

impl Term {
    /// What predicts at a joint (counted from 0) without a name.
    pub fn unnamed(joint: usize, rest: Rest) -> Self {
        Self {
            rest: Some(Arc::new(rest)),
            ..Self::absent(&REST, joint, 0.0)
        }
    }

    /// The same with the coefficients of the rest of the model without it.
    #[doc(hidden)]
    #[must_use]
    pub fn with_geometry_alone_as(&self, alone: &[f64]) -> Self {
        let rest = self.rest.as_deref().map(|rest| {
            Arc::new(Rest {
                geometry_alone: alone.to_vec(),
                ..rest.clone()
            })
        });
        Self {
            rest,
            ..self.clone()
        }
    }

    /// What predicts without a name, of such a term.
    pub fn rest(&self) -> Option<&Rest> {
        self.rest.as_deref()
    }
}

/// Where the samples ask for the correction of a joint, sample by sample.
pub fn asked_at<'r>(robot: &'r Robot, inputs: &Inputs, joint: usize) -> Vec<RestPoint<'r>> {
    let mut block = Block::new(robot, 0, false);
    let mut all = Vec::with_capacity(inputs.len());
    for start in (0..inputs.len()).step_by(LANES) {
        block.load(inputs, start);
        all.extend((0..block.len).map(|lane| at(robot, &block, joint, lane)));
    }
    all
}

fn at<'r>(robot: &'r Robot, block: &Block, joint: usize, lane: usize) -> RestPoint<'r> {
    RestPoint {
        robot,
        joint,
        q: (0..robot.joints.len())
            .map(|j| block.command(j, lane))
            .collect(),
        load_nm: torque_nm(block, joint, lane),
        torque_nm: block.torque_nm(joint, lane).unwrap_or(0.0),
        side: block.side(joint, lane),
        speed: block.speed(joint, lane),
        above_20_c: block.above_20_c(joint, lane),
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::{Point3, Rotation3, UnitVector3, Vector3};

    use super::*;
    use crate::effects::joint_frame::JointFrame;
    use crate::effects::rest::Wave;
    use crate::kinematics::{Axis, Joint, Pose, RobotSource};
    use crate::model::Model;

    const KINDS: [JointKind; 2] = [JointKind::Prismatic, JointKind::Revolute];
    const ORIGIN_MM: [f64; 3] = [20.0, 30.0, 40.0];
    const TOOL_MM: [f64; 3] = [100.0, 200.0, 300.0];

    /// A joint along x, and a slide along y that it carries.
    fn robot(kind: JointKind) -> Robot {
        let mut robot = crate::testing::column();
        let joint = |kind, direction: UnitVector3<f64>| Joint {
            kind,
            axis: Axis {
                direction,
                point_mm: Point3::from(ORIGIN_MM),
            },
            ..robot.joints[0].clone()
        };
        robot.joints = vec![
            joint(kind, Vector3::x_axis()),
            joint(JointKind::Prismatic, Vector3::y_axis()),
        ];
        let [x, y, z] = TOOL_MM;
        robot.base_from_tool = Pose::translation(x, y, z);
        robot.source = RobotSource::default();
        robot
    }

    /// Sizes of the moves of the first joint, and how each follows the first command, rad or mm.
    fn size(kind: JointKind, k: usize) -> [f64; 2] {
        let [motion, step] = match kind {
            JointKind::Prismatic => [0.1, 0.004],
            JointKind::Revolute => [3e-4, 1.0],
        };
        let sizes = [motion, 0.2, -0.3, 1e-4, -2e-4, 3e-4];
        [sizes[k], step * (k + 1) as f64]
    }

    fn model(kind: JointKind) -> Model {
        let mut rest = Rest {
            ranges: vec![[0.0, 1000.0], [0.0, 500.0]],
            ..Rest::default()
        };
        for (k, along) in rest.along.iter_mut().enumerate() {
            let [sine, order] = size(kind, k);
            along.waves.push(Wave {
                orders: vec![order, 0.0],
                sine,
                cosine: 0.0,
            });
        }
        Model::nominal(robot(kind)).with_term(Term::unnamed(0, rest))
    }

    fn at(kind: JointKind, [q, y]: [f64; 2]) -> Inputs<'static> {
        let unit = match kind {
            JointKind::Prismatic => 400.0,
            JointKind::Revolute => 1.0,
        };
        Inputs::at_poses(vec![vec![unit * q], vec![y]], vec![TOOL_MM])
    }

    #[test]
    fn a_link_is_turned_about_the_point_of_its_axis_then_shifted_then_moved() {
        for kind in KINDS {
            for q in [0.3, 1.2, 2.4] {
                let inputs = at(kind, [q, 250.0]);
                let command = inputs.q[0][0];
                let by: [f64; MOVES] = std::array::from_fn(|k| {
                    let [sine, order] = size(kind, k);
                    sine * (order * command).sin()
                });
                let out = Vector3::from(JointFrame::new(&robot(kind), 0).plane_of_motion()[0]);
                let along = Vector3::x();
                let aside = along.cross(&out);
                let third = match kind {
                    JointKind::Prismatic => aside,
                    JointKind::Revolute => along,
                };
                let origin = Vector3::from(ORIGIN_MM);
                let arm = Vector3::from(TOOL_MM) + Vector3::y() * 250.0 - origin;
                let turn = Rotation3::new(along * by[3] + out * by[4] + aside * by[5]);
                let shifted = turn * arm + out * by[1] + third * by[2];
                let expected = match kind {
                    JointKind::Prismatic => origin + shifted + along * (by[0] + command),
                    JointKind::Revolute => {
                        origin + Rotation3::new(along * (by[0] + command)) * shifted
                    }
                };
                let predicted = Vector3::from(model(kind).predict(&inputs).get(0));
                let off = (predicted - expected).norm();
                assert!(off < 1e-10, "{kind:?} {q}: {off}");
            }
        }
    }

    #[test]
    fn the_slopes_by_commands_are_those_of_the_points() {
        for kind in KINDS {
            let (model, pose) = (model(kind), at(kind, [1.2, 210.0]));
            let mut slopes = Vec::new();
            model.visit_by_commands(&pose, |_, block| slopes.clone_from(&block.columns));
            for joint in 0..2 {
                let step = match model.robot.joints[joint].kind {
                    JointKind::Prismatic => 1e-3,
                    JointKind::Revolute => 1e-5,
                };
                let [below, above] = [-step, step].map(|by| {
                    let mut q = [pose.q[0].to_vec(), pose.q[1].to_vec()];
                    q[joint][0] += by;
                    let inputs = Inputs::at_poses(q.to_vec(), vec![TOOL_MM]);
                    Vector3::from(model.predict(&inputs).get(0))
                });
                let slope = Vector3::from([0, 1, 2].map(|axis| slopes[joint][axis][0]));
                let off = (slope - (above - below) / (2.0 * step)).norm();
                // Half of a turn, its slope and 300 mm are left out: 4e-7 of a slide's; a wrong sign is 1e-3.
                assert!(off < 5e-7 * slope.norm(), "{kind:?} {joint}: {off}");
            }
        }
    }
}
