//! Base offset: the axis is elsewhere in the measuring frame, `p += (dx, dy, dz)`.

use super::about::{About, Form, Quantity, Stage};
use super::block::Block;
use super::needs::Need;
use super::{Effect, Placed, Term};
use crate::kinematics::Robot;
use crate::text::{Text, entered};

const ABOUT: About = About {
    id: "base-offset",
    title: phrase!("Base offset"),
    stage: Stage::World,
    per_joint: false,
    form: Form::Plain(&Quantity::XYZ_MM),
    equation: "p = p + (x, y, z)",
    source: "ISO 9283, 5.6: the base frame as measured",
    cause: phrase!("the measuring frame was surveyed to a point beside the axis"),
    implausible_above: Some(50.0),
    usual_size: phrase!("0.1 to 5 mm"),
    confused_with: phrase!(
        "encoder eccentricity where only the angle is seen: the radius, or a second radius, parts them"
    ),
    check: phrase!("survey the base again"),
    needs: &[MOVED],
    ..About::PLAIN
};

/// A robot that moved.
const MOVED: Need = Need::of_samples(phrase!("a joint that moved"), |survey, _| {
    let at_rest = survey.joints.iter().all(|j| j.values < 2);
    at_rest.then(|| text!("the robot never moved: the offset cannot be told from the tool"))
});

pub(super) static BASE_OFFSET: Effect = Effect {
    remedy: Some(remedy),
    ..Effect::new(ABOUT, act)
};

fn remedy(_: &Robot, term: &Term) -> Text {
    let by = &term.coefficients;
    text!(
        "move the base in the controller by {shift}, or survey it again",
        shift = entered([by[0], by[1], by[2]])
    )
}

fn act(me: &Placed, block: &mut Block) {
    let by = [me.coefficients[0], me.coefficients[1], me.coefficients[2]];
    block.displace(me, |_| (by, AXES));
}

/// The derivatives of a point with respect to its own coordinates.
pub(crate) const AXES: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
