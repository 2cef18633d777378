//! Joint zero offset: `θ = q + θ0`.
//!
//! The joint's true zero is not where the controller believes it to be. Every calibration
//! identifies it.

use super::about::{About, DEGREE, Form, Over, Quantity, Setting, Stage};
use super::block::{Block, Turned};
use super::{Effect, Placed, Survey};

/// See the module.
pub(super) struct JointZeroOffset;

const ABOUT: About = About {
    id: "joint-zero-offset",
    title: "Joint zero offset",
    stage: Stage::Joint,
    per_joint: true,
    form: Form::Plain(&[Quantity {
        name: "offset_deg",
        inner: DEGREE,
    }]),
    setting: Setting::None,
    equation: "θ = q + θ0",
    source: "Mooring, Roth & Driels, Fundamentals of Manipulator Calibration, 1991",
    cause: "the reference mark or the homing position is not where the controller assumes it",
    over: Over::Angle,
    never_negative: false,
    implausible_above: None,
    usual_size: "0.01° to 0.5°",
    confused_with: "a turned measuring frame or a lateral tool offset: a datum target or a second reflector at another radius tells",
    check: "home the joint again and repeat three poses",
};

impl Effect for JointZeroOffset {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn obstacle(&self, _: &Survey, _: usize) -> Option<String> {
        None
    }

    fn act(&self, me: &Placed, block: &mut Block) {
        let offset = me.coefficients[0];
        block.turn(me, |theta, _| Turned {
            to: theta + offset,
            carry: 1.0,
            by: [1.0],
        });
    }
}
