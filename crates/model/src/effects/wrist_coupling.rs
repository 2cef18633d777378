//! Coupling: `θ_j = q_j + κ q_i`, j the joint and i another one, in a wrist the one before it.
//!
//! In a wrist that is driven through hollow shafts a joint's drive also turns the joints behind it, and in an arm with
//! a parallelogram joint 2 turns joint 3; the controller compensates it with a ratio, and an error of that ratio
//! remains. The search finds which joint it is: it tries every other one that turns.

use super::about::{About, Form, Listed, Quantity, Setting};
use super::block::{Block, Turned};
use super::needs::Need;
use super::units::Unit;
use super::{Effect, Placed, Survey};
use crate::kinematics::JointKind;
use crate::lanes::LANES;

const ABOUT: About = About {
    id: "wrist-coupling",
    title: phrase!("Wrist coupling"),
    form: Form::Plain(&[Quantity::new("ratio", Unit::ONE)]),
    setting: Setting::Listed(&FROM_JOINT),
    equation: "θ_j = q_j + κ q_i, i = from_joint",
    source: "coupled wrists: Siciliano et al., Robotics, ch. 5; Nof, Handbook of Industrial Robotics, ch. 5",
    cause: phrase!(
        "the drive of one joint turns another as well, and the controller's ratio for it is not exact"
    ),
    implausible_above: Some(0.02),
    usual_size: phrase!("0.0001 to 0.01"),
    confused_with: phrase!(
        "the joint's scale where both always move together: poses that move one alone part them"
    ),
    check: phrase!("the coupling ratio in the controller's data"),
    needs: &[Need::REVOLUTE, ANOTHER],
    of_other_joints: true,
    ..About::PLAIN
};

/// The joint that turns this one as well, counted from 1.
const FROM_JOINT: Listed = Listed {
    quantity: Quantity::new("from_joint", Unit::ONE),
    tried: |survey, joint| {
        others(survey, joint)
            .map(|from| (from + 1) as f64)
            .collect()
    },
    expected: phrase!("the number of another joint"),
    takes: |from, joint, joints| {
        from.fract() == 0.0 && from >= 1.0 && from <= joints as f64 && from != (joint + 1) as f64
    },
    usual: |joint| (joint > 0).then_some(joint as f64),
};

/// Another joint that turned while the poses were measured.
const ANOTHER: Need = Need::of_samples(phrase!("another joint that turns"), |survey, joint| {
    others(survey, joint)
        .next()
        .is_none()
        .then(|| text!("no other joint that turns was measured at three different values or more"))
});

/// The joints that may turn this one as well, the one before it first.
fn others(survey: &Survey, joint: usize) -> impl Iterator<Item = usize> {
    let moved = move |other: &usize| {
        survey.not_revolute(*other).is_none() && survey.too_few_angles(*other, 3).is_none()
    };
    let behind = joint + 1..survey.joints.len();
    (0..joint).rev().chain(behind).filter(moved)
}

pub(super) static WRIST_COUPLING: Effect = Effect {
    exists_on,
    ..Effect::new(ABOUT, act)
};

fn exists_on(joint: usize, kind: JointKind) -> bool {
    joint > 0 && kind == JointKind::Revolute
}

fn act(me: &Placed, block: &mut Block) {
    let ratio = me.coefficients[0];
    let joints = block.robot.joints.len();
    let from = (1..=joints).position(|number| number as f64 == me.setting);
    let commands: [f64; LANES] =
        std::array::from_fn(|lane| from.map_or(0.0, |from| block.command(from, lane)));
    block.turn(me, |theta, at| Turned {
        value: theta + ratio * commands[at.lane],
        by_input: 1.0,
        by_coefficient: [commands[at.lane]],
    });
    if let Some(from) = from {
        block.turn_by_command(me, from, |_| ratio);
    }
}
