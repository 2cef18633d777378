//! Axis tilt: the whole moving body is turned by `R_y(β) R_x(α)` about the point on the axis at
//! the height of the tool's origin.
//!
//! x and y are the joint frame's `across_1` and `across_2`, the base's own x and y for an axis
//! along z.

use super::about::{About, Form, MILLIRADIAN, Over, Quantity, Setting, Stage};
use super::axis_wobble::axial_measurement_needed;
use super::block::Block;
use super::{Effect, Placed, Survey};
use crate::lanes::{add_scaled, cross, minus, turned};
use crate::sincos::sin_cos_small as sin_cos;

/// See the module.
pub(super) struct AxisTilt;

const ABOUT: About = About {
    id: "axis-tilt",
    title: "Axis tilt",
    stage: Stage::World,
    per_joint: true,
    form: Form::Plain(&[
        Quantity {
            name: "about_x_mrad",
            inner: MILLIRADIAN,
        },
        Quantity {
            name: "about_y_mrad",
            inner: MILLIRADIAN,
        },
    ]),
    setting: Setting::None,
    equation: "p = f + R_y(β) R_x(α) (p − f), f on the axis at the tool's height",
    source: "ISO 230-7: axis of rotation errors E_A0C, E_B0C",
    cause: "the column does not stand upright on the base",
    over: Over::Angle,
    never_negative: false,
    implausible_above: Some(20.0),
    usual_size: "0.05 to 2 mrad",
    confused_with: "axial runout of first order at one radius: a second radius parts them",
    check: "shim the column's foot; level it along x and y",
};

impl Effect for AxisTilt {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn obstacle(&self, survey: &Survey, joint: usize) -> Option<String> {
        if joint > 0 || survey.joints.len() > 1 {
            return Some("the robot has several joints: link geometry takes its place".to_owned());
        }
        survey
            .not_revolute(joint)
            .or_else(|| survey.too_few_angles(joint, 3))
            .or_else(|| axial_measurement_needed(survey, joint))
    }

    fn act(&self, me: &Placed, block: &mut Block) {
        let (u, v, foot) = (me.frame.across_1, me.frame.across_2, me.frame.foot_mm);
        let (sin_a, cos_a) = sin_cos(me.coefficients[0]);
        let (sin_b, cos_b) = sin_cos(me.coefficients[1]);
        let rotated = |x| turned(turned(x, u, sin_a, cos_a), v, sin_b, cos_b);
        let unit = |k: usize| std::array::from_fn(|row| f64::from(u8::from(row == k)));
        let images: [[f64; 3]; 3] = std::array::from_fn(|k| rotated(unit(k)));
        let carry = std::array::from_fn(|row| std::array::from_fn(|column| images[column][row]));
        block.transform(me, |x, _| {
            let about_u = turned(minus(x, foot), u, sin_a, cos_a);
            let to = turned(about_u, v, sin_b, cos_b);
            let by_alpha = turned(cross(u, about_u), v, sin_b, cos_b);
            let by_beta = cross(v, to);
            (add_scaled(to, foot, 1.0), carry, [by_alpha, by_beta])
        });
    }
}
