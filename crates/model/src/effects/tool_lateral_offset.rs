//! Tool lateral offset: the tool is displaced across the radius, in the joint's positive sense.

use super::about::{About, Form, Quantity, Stage};
use super::block::Block;
use super::needs::Need;
use super::units::Unit;
use super::{Effect, Placed, Term};
use crate::kinematics::Robot;
use crate::lanes::scaled;
use crate::text::Text;

const ABOUT: About = About {
    id: "tool-lateral-offset",
    title: phrase!("Tool lateral offset"),
    stage: Stage::Tool,
    form: Form::Plain(&[Quantity::new("delta_mm", Unit::MM)]),
    equation: "the tool at home moves by δ across the radius",
    source: "Mooring, Roth & Driels, Fundamentals of Manipulator Calibration, 1991",
    cause: phrase!("the tool is mounted beside the radius that the controller assumes"),
    implausible_above: Some(10.0),
    usual_size: phrase!("0.01 to 1 mm"),
    confused_with: phrase!(
        "the joint's zero offset: only a second reflector at another radius tells"
    ),
    check: phrase!("the tool flange and the tool data in the controller"),
    needs: &[Need::SINGLE_AXIS, Need::REVOLUTE, Need::RADIUS, TWO_TARGETS],
    ..About::PLAIN
};

/// A second reflector.
const TWO_TARGETS: Need = Need::of_samples(phrase!("two reflectors"), |survey, _| {
    (survey.targets < 2)
        .then(|| text!("with one reflector it cannot be told from the joint's zero offset"))
});

pub(super) static TOOL_LATERAL_OFFSET: Effect = Effect {
    remedy: Some(remedy),
    ..Effect::new(ABOUT, act)
};

fn remedy(_: &Robot, term: &Term) -> Text {
    text!(
        "move the tool in the controller's tool data by {shift} mm across the radius",
        shift = format!("{:+.4}", term.coefficients[0])
    )
}

fn act(me: &Placed, block: &mut Block) {
    let tangential = me.frame.tangential;
    let delta = scaled(tangential, me.coefficients[0]);
    block.displace(me, |_| (delta, [tangential]));
}
