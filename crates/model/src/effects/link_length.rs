//! Link length: `R += δ`, the tool's radius about a single axis.
//!
//! The tool moves by δ away from the axis, along the radius of its origin at home, and every
//! reflector moves with it. An arm has link geometry instead.

use super::about::{About, Form, Quantity, Role, Stage};
use super::block::Block;
use super::joint_frame::JointFrame;
use super::needs::Need;
use super::units::Unit;
use super::{Effect, Placed, Term};
use crate::kinematics::Robot;
use crate::lanes::scaled;
use crate::text::{Text, entered};

pub(super) const ABOUT: About = About {
    id: "link-length",
    title: phrase!("Link length"),
    stage: Stage::Tool,
    form: Form::Plain(&[Quantity::new("delta_mm", Unit::MM)]),
    equation: "R = R0 + δ",
    source: "Mooring, Roth & Driels, Fundamentals of Manipulator Calibration, 1991",
    cause: phrase!("the tool or the link is longer or shorter than the controller's data"),
    usual_size: phrase!("0.01 to 1 mm"),
    confused_with: phrase!(
        "the instrument's scale: a scale bar, or a second reflector at another radius, tells"
    ),
    check: phrase!("the tool data in the controller"),
    needs: &[Need::SINGLE_AXIS, Need::REVOLUTE, Need::RADIUS],
    role: Role::ToolRadius,
    ..About::PLAIN
};

pub(super) static LINK_LENGTH: Effect = Effect {
    remedy: Some(remedy),
    ..Effect::new(ABOUT, act)
};

fn remedy(robot: &Robot, term: &Term) -> Text {
    let radius = JointFrame::new(robot, term.joint).radius_mm;
    text!(
        "along the radius; set the tool's radius (l1) in the controller from {radius} to \
         {length}",
        radius = entered([radius]),
        length = entered([radius + term.coefficients[0]])
    )
}

fn act(me: &Placed, block: &mut Block) {
    let radial = me.frame.radial;
    let delta = scaled(radial, me.coefficients[0]);
    block.displace(me, |_| (delta, [radial]));
}
