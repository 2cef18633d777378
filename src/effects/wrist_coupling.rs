//! Wrist coupling: `θ_j = q_j + κ q_{j−1}`, j the joint and j − 1 the one before it.
//!
//! In a wrist that is driven through hollow shafts a joint's drive also turns the joints behind
//! it; the controller undoes it with a ratio, and an error of that ratio is left.

use super::about::{About, Form, Over, Quantity, Setting, Stage};
use super::block::{Block, Turned};
use super::{Effect, Placed, Survey};
use crate::lanes::LANES;

/// See the module.
pub(super) struct WristCoupling;

const ABOUT: About = About {
    id: "wrist-coupling",
    title: "Wrist coupling",
    stage: Stage::Joint,
    per_joint: true,
    form: Form::Plain(&[Quantity {
        name: "ratio",
        inner: 1.0,
    }]),
    setting: Setting::None,
    equation: "θ_j = q_j + κ q_(j−1)",
    source: "coupled wrists: Siciliano et al., Robotics, ch. 5; Nof, Handbook of Industrial Robotics, ch. 5",
    cause: "the drive of one joint turns the next as well, and the controller's ratio for it is not exact",
    over: Over::Angle,
    never_negative: false,
    implausible_above: Some(0.02),
    usual_size: "0.0001 to 0.01",
    confused_with: "the next joint's scale where both always move together: poses that move one alone part them",
    check: "the coupling ratio in the controller's data",
};

impl Effect for WristCoupling {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn exists_on(&self, joint: usize) -> bool {
        joint > 0
    }

    fn obstacle(&self, survey: &Survey, joint: usize) -> Option<String> {
        let Some(before) = joint.checked_sub(1) else {
            return Some("no joint comes before it".to_owned());
        };
        survey
            .not_revolute(joint)
            .or_else(|| {
                let slides = survey.not_revolute(before).is_some();
                slides.then(|| "the joint before it slides".to_owned())
            })
            .or_else(|| survey.too_few_angles(before, 3))
    }

    fn act(&self, me: &Placed, block: &mut Block) {
        let ratio = me.coefficients[0];
        let commands: [f64; LANES] = std::array::from_fn(|lane| {
            let before = me.joint.checked_sub(1);
            before.map_or(0.0, |joint| block.command(joint, lane))
        });
        block.turn_by_index(me, |theta, lane| Turned {
            to: theta + ratio * commands[lane],
            carry: 1.0,
            by: [commands[lane]],
        });
        if let Some(before) = me.joint.checked_sub(1) {
            block.turn_by_command(me, before, |_| ratio);
        }
    }
}
