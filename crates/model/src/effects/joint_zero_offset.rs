//! Joint zero offset: `θ = q + θ0`.
//!
//! The joint's true zero is not where the controller believes it to be. Every calibration
//! identifies it.

use super::about::{About, Form, Prior, Quantity, Role};
use super::block::{Block, Turned};
use super::units::Unit;
use super::{Effect, Placed, Term};
use crate::kinematics::{JointKind, Robot};
use crate::text::Text;

pub(super) const ABOUT: About = About {
    id: "joint-zero-offset",
    title: phrase!("Joint zero offset"),
    form: Form::Plain(&[Quantity::new("offset_deg", Unit::DEGREE).sliding("offset_mm", Unit::MM)]),
    equation: "θ = q + θ0",
    source: "Mooring, Roth & Driels, Fundamentals of Manipulator Calibration, 1991",
    cause: phrase!(
        "the reference mark or the homing position is not where the controller assumes it"
    ),
    usual_size: phrase!("0.01° to 0.5°"),
    confused_with: phrase!(
        "a turned measuring frame or a lateral tool offset: a datum target or a second reflector at another radius tells"
    ),
    check: phrase!("home the joint again and repeat three poses"),
    role: Role::JointZero,
    priors: &[Prior {
        sigma: 0.05,
        sigma_on_slide: 20.0,
        if_aligned: false,
    }],
    ..About::PLAIN
};

pub(super) static JOINT_ZERO_OFFSET: Effect = Effect {
    remedy: Some(remedy),
    ..Effect::new(ABOUT, act)
};

fn remedy(robot: &Robot, term: &Term) -> Text {
    let kind = robot.joints[term.joint].kind;
    let beyond = kind.to_display(term.coefficients[0]);
    let unit = match kind {
        JointKind::Revolute => "°",
        JointKind::Prismatic => " mm",
    };
    text!(
        "the joint stands {beyond}{unit} beyond its command: correct its zero in the controller, or home it again",
        beyond = format!("{:+.4}", beyond),
        unit
    )
}

fn act(me: &Placed, block: &mut Block) {
    let offset = me.coefficients[0];
    block.turn(me, |theta, _| Turned {
        value: theta + offset,
        by_input: 1.0,
        by_coefficient: [1.0],
    });
}
