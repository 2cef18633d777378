//! Corrections that predict poses that no fit has seen and have no name: corrections of a joint's angle and of its
//! axis that follow the poses, with numbers that a diagnosis set and no later fit changes.
//!
//! ```text
//! p = exp([ξ] w s_t) (p + w s_r r + w s_a a),   s_d(q, conditions) a [`Rest`], w its fade
//! ```
//!
//! Of a prismatic joint p is turned first, by w s about each of the three directions, about the point of its axis that
//! the robot's description names.
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
    use super::*;
    use crate::effects::rest::{MOVES, Wave};
    use crate::kinematics::{Axis, Joint, Pose, RobotSource};
    use crate::lanes::{add_scaled, cross, minus};
    use crate::model::Model;

    /// A slide along x that carries one along y.
    fn gantry() -> Robot {
        let mut robot = crate::testing::column();
        let slide = |direction: nalgebra::UnitVector3<f64>| Joint {
            kind: JointKind::Prismatic,
            axis: Axis {
                direction,
                point_mm: nalgebra::Point3::new(20.0, 30.0, 40.0),
            },
            ..robot.joints[0].clone()
        };
        robot.joints = vec![
            slide(nalgebra::Vector3::x_axis()),
            slide(nalgebra::Vector3::y_axis()),
        ];
        robot.base_from_tool = Pose::translation(100.0, 200.0, 300.0);
        robot.source = RobotSource::default();
        robot
    }

    /// The first slide is moved and turned in every way, by a wave of its own value each.
    fn rest() -> Rest {
        let mut rest = Rest {
            ranges: vec![[0.0, 1000.0], [0.0, 500.0]],
            ..Rest::default()
        };
        let sizes = [0.1, 0.2, -0.3, 1e-4, -2e-4, 3e-4];
        for (k, (along, size)) in rest.along.iter_mut().zip(sizes).enumerate() {
            along.waves.push(Wave {
                orders: vec![0.004 * (k + 1) as f64, 0.0],
                sine: size,
                cosine: 0.5 * size,
            });
        }
        rest
    }

    #[test]
    fn a_carriage_is_turned_about_the_point_of_its_axis_and_then_moved() {
        let model = Model::nominal(gantry()).with_term(Term::unnamed(0, rest()));
        let q = vec![vec![120.0, 480.0, 910.0], vec![400.0, 10.0, 250.0]];
        let inputs = Inputs::at_poses(q, vec![[100.0, 200.0, 300.0]]);
        let predicted = model.predict(&inputs);
        let (out, origin) = (
            crate::effects::joint_frame::JointFrame::new(&gantry(), 0).plane_of_motion()[0],
            [20.0, 30.0, 40.0],
        );
        let along = [1.0, 0.0, 0.0];
        let directions = [along, out, cross(along, out)];
        for i in 0..3 {
            let [x, y] = [0, 1].map(|joint| inputs.q[joint][i]);
            let by: [f64; MOVES] = std::array::from_fn(|k| {
                let wave = &rest().along[k].waves[0];
                let phase = wave.orders[0] * x;
                wave.sine * phase.sin() + wave.cosine * phase.cos()
            });
            let sum = |by: &[f64]| {
                let each = directions.iter().zip(by);
                each.fold([0.0; 3], |sum, (d, by)| add_scaled(sum, *d, *by))
            };
            let turn = nalgebra::Rotation3::new(nalgebra::Vector3::from(sum(&by[3..])));
            let arm = minus([100.0, 200.0 + y, 300.0], origin);
            let turned: [f64; 3] = (turn * nalgebra::Vector3::from(arm)).into();
            let moved = add_scaled(add_scaled(turned, origin, 1.0), sum(&by[..3]), 1.0);
            let off = minus(predicted.get(i), add_scaled(moved, along, x));
            assert!(off.iter().all(|v| v.abs() < 1e-10), "{i}: {off:?}");
        }
    }

    #[test]
    fn the_slopes_by_commands_are_those_of_the_points() {
        let model = Model::nominal(gantry()).with_term(Term::unnamed(0, rest()));
        let at = |by: [f64; 2]| {
            let q = vec![vec![480.0 + by[0]], vec![210.0 + by[1]]];
            Inputs::at_poses(q, vec![[100.0, 200.0, 300.0]])
        };
        let mut slopes = Vec::new();
        model.visit_by_commands(&at([0.0; 2]), |_, block| slopes.clone_from(&block.columns));
        for joint in 0..2 {
            let [below, above] = [-1e-3, 1e-3].map(|by| {
                let mut moved = [0.0; 2];
                moved[joint] = by;
                model.predict(&at(moved)).get(0)
            });
            let expected = minus(above, below).map(|d| d / 2e-3);
            let off = minus([0, 1, 2].map(|axis| slopes[joint][axis][0]), expected);
            assert!(off.iter().all(|v| v.abs() < 1e-6), "{joint}: {off:?}");
        }
    }
}
