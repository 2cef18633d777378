//! Link length: `R += δ`, the tool's radius about a single axis.
//!
//! The tool moves by δ away from the axis, along the radius of its origin at home, and every
//! reflector moves with it. An arm has link geometry instead.

use super::about::{About, Form, Over, Quantity, Setting, Stage};
use super::block::Block;
use super::{Effect, Placed, Survey};
use crate::lanes::scaled;

/// See the module.
pub(super) struct LinkLength;

const ABOUT: About = About {
    id: "link-length",
    title: "Link length",
    stage: Stage::Tool,
    per_joint: true,
    form: Form::Plain(&[Quantity {
        name: "delta_mm",
        inner: 1.0,
    }]),
    setting: Setting::None,
    equation: "R = R0 + δ",
    source: "Mooring, Roth & Driels, Fundamentals of Manipulator Calibration, 1991",
    cause: "the tool or the link is longer or shorter than the controller's data",
    over: Over::Angle,
    never_negative: false,
    implausible_above: None,
    usual_size: "0.01 to 1 mm",
    confused_with: "the instrument's scale: a scale bar, or a second reflector at another radius, tells",
    check: "the tool data in the controller",
};

impl Effect for LinkLength {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn obstacle(&self, survey: &Survey, joint: usize) -> Option<String> {
        single_axis_with_radius(survey, joint)
    }

    fn act(&self, me: &Placed, block: &mut Block) {
        let radial = me.frame.radial;
        let delta = scaled(radial, me.coefficients[0]);
        block.displace(me, |_| (delta, [radial]));
    }
}

/// What stands against every effect of the tool's place about a single axis.
pub(super) fn single_axis_with_radius(survey: &Survey, joint: usize) -> Option<String> {
    if survey.joints.len() > 1 {
        return Some("the robot has several joints: link geometry takes its place".to_owned());
    }
    survey.not_revolute(joint).or_else(|| {
        (survey.joints[joint].frame.radius_mm == 0.0)
            .then(|| "the tool lies on the axis and has no radius".to_owned())
    })
}
