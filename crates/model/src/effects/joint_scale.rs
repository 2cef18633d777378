//! Joint scale: `θ = (1 + k) q`.
//!
//! The controller's counts per turn or the gear ratio are a little off, so the error grows in
//! proportion to the angle.

use super::about::{About, Form, Quantity};
use super::block::{Block, Turned};
use super::needs::Need;
use super::units::Unit;
use super::{Effect, Placed};

const ABOUT: About = About {
    id: "joint-scale",
    title: phrase!("Joint scale"),
    form: Form::Plain(&[Quantity::new("scale_ppm", Unit::PPM)]),
    equation: "θ = (1 + k) q",
    source: "ISO 230-2: the slope of the positioning deviation",
    cause: phrase!("the gear ratio or the encoder's counts per turn are entered slightly wrong"),
    implausible_above: Some(5000.0),
    usual_size: phrase!("10 to 500 ppm"),
    confused_with: phrase!(
        "encoder eccentricity over less than a full turn: over a full turn they part"
    ),
    check: phrase!(
        "compare the gear ratio and the counts per turn in the controller with the data sheets"
    ),
    needs: &[Need::values::<2>(phrase!("two values of the joint"))],
    ..About::PLAIN
};

pub(super) static JOINT_SCALE: Effect = Effect::new(ABOUT, act);

fn act(me: &Placed, block: &mut Block) {
    let k = me.coefficients[0];
    block.turn(me, |theta, _| Turned {
        value: (1.0 + k) * theta,
        by_input: 1.0 + k,
        by_coefficient: [theta],
    });
}
