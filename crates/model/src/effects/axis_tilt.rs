//! Axis tilt: the whole moving body is turned by `R_y(β) R_x(α)` about the point on the axis at
//! the height of the tool's origin.
//!
//! x and y are the joint frame's `across_1` and `across_2`, the base's own x and y for an axis
//! along z.

use super::about::{About, Form, Quantity, Stage};
use super::block::Block;
use super::needs::Need;
use super::units::{MILLIRADIAN, Unit};
use super::{Effect, Placed, Term};
use crate::kinematics::Robot;
use crate::lanes::{add_scaled, cross, minus, turned};
use crate::sincos::sin_cos_small as sin_cos;
use crate::text::Text;

const ABOUT: About = About {
    id: "axis-tilt",
    title: phrase!("Axis tilt"),
    stage: Stage::World,
    form: Form::Plain(&[
        Quantity::new("about_x_mrad", Unit::MILLIRADIAN),
        Quantity::new("about_y_mrad", Unit::MILLIRADIAN),
    ]),
    equation: "p = f + R_y(β) R_x(α) (p − f), f on the axis at the tool's height",
    source: "ISO 230-7: axis of rotation errors E_A0C, E_B0C",
    cause: phrase!("the column does not stand upright on the base"),
    implausible_above: Some(20.0),
    usual_size: phrase!("0.05 to 2 mrad"),
    confused_with: phrase!("axial runout of first order at one radius: a second radius parts them"),
    check: phrase!("shim the column's foot; level it along x and y"),
    needs: &[
        Need::SINGLE_AXIS,
        Need::REVOLUTE,
        Need::values::<3>(phrase!("three values of the joint")),
        Need::AXIAL,
    ],
    ..About::PLAIN
};

pub(super) static AXIS_TILT: Effect = Effect {
    remedy: Some(remedy),
    ..Effect::new(ABOUT, act)
};

fn remedy(_: &Robot, term: &Term) -> Text {
    let by_mrad = |k: usize| term.coefficients[k] / MILLIRADIAN;
    text!(
        "turn the base in the controller by {about_x} mrad about x and {about_y} mrad about y, or \
         shim the column's foot",
        about_x = format!("{:+.4}", by_mrad(0)),
        about_y = format!("{:+.4}", by_mrad(1))
    )
}

fn act(me: &Placed, block: &mut Block) {
    let (u, v, foot) = (me.frame.across_1, me.frame.across_2, me.frame.foot_mm);
    let (sin_a, cos_a) = sin_cos(me.coefficients[0]);
    let (sin_b, cos_b) = sin_cos(me.coefficients[1]);
    let rotated = |x| turned(turned(x, u, sin_a, cos_a), v, sin_b, cos_b);
    let unit = |k: usize| std::array::from_fn(|row| f64::from(u8::from(row == k)));
    let images: [[f64; 3]; 3] = std::array::from_fn(|k| rotated(unit(k)));
    let jacobian = std::array::from_fn(|row| std::array::from_fn(|column| images[column][row]));
    block.transform(me, |x, _| {
        let about_u = turned(minus(x, foot), u, sin_a, cos_a);
        let to = turned(about_u, v, sin_b, cos_b);
        let by_alpha = turned(cross(u, about_u), v, sin_b, cos_b);
        let by_beta = cross(v, to);
        (add_scaled(to, foot, 1.0), jacobian, [by_alpha, by_beta])
    });
}
