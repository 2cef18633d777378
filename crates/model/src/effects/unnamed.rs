//! Corrections that predict poses that no fit has seen and have no name: corrections of a joint's angle and of its
//! axis that follow the poses, with numbers that a diagnosis set and no later fit changes.
//!
//! ```text
//! p = exp([ξ] w s_t) (p + w s_r r + w s_a a),   s_d(q, conditions) a [`Rest`], w its fade
//! ```
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

use super::rest::{Rest, RestPoint};

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
    let values: [[f64; 3]; LANES] = std::array::from_fn(|lane| rest.at(&poses[lane]));
    let mut slopes = Vec::new();
    if block.by_command() {
        for joint in (0..joints).filter(|j| rest.follows(me.joint, *j)) {
            let step = match robot.joints[joint].kind {
                JointKind::Revolute => STEP[0],
                JointKind::Prismatic => STEP[1],
            };
            let mut slope = [[0.0; 3]; LANES];
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
