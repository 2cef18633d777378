//! Tool lateral offset: the tool is displaced across the radius, in the joint's positive sense.

use super::about::{About, Form, Over, Quantity, Setting, Stage};
use super::block::Block;
use super::link_length::single_axis_with_radius;
use super::{Effect, Placed, Survey};
use crate::lanes::scaled;

/// See the module.
pub(super) struct ToolLateralOffset;

const ABOUT: About = About {
    id: "tool-lateral-offset",
    title: "Tool lateral offset",
    stage: Stage::Tool,
    per_joint: true,
    form: Form::Plain(&[Quantity {
        name: "delta_mm",
        inner: 1.0,
    }]),
    setting: Setting::None,
    equation: "the tool at home moves by δ across the radius",
    source: "Mooring, Roth & Driels, Fundamentals of Manipulator Calibration, 1991",
    cause: "the tool is mounted beside the radius that the controller assumes",
    over: Over::Angle,
    never_negative: false,
    implausible_above: Some(10.0),
    usual_size: "0.01 to 1 mm",
    confused_with: "the joint's zero offset: only a second reflector at another radius tells",
    check: "the tool flange and the tool data in the controller",
};

impl Effect for ToolLateralOffset {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn obstacle(&self, survey: &Survey, joint: usize) -> Option<String> {
        single_axis_with_radius(survey, joint).or_else(|| {
            (survey.targets < 2).then(|| {
                "with one reflector it cannot be told from the joint's zero offset".to_owned()
            })
        })
    }

    fn act(&self, me: &Placed, block: &mut Block) {
        let tangential = me.frame.tangential;
        let delta = scaled(tangential, me.coefficients[0]);
        block.displace(me, |_| (delta, [tangential]));
    }
}
