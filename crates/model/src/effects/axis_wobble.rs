//! Axis wobble: the reflector moves by `R·w·cos(k q + φ)` along the axis, R its distance from it.
//!
//! The coefficients are w cos φ and w sin φ; the order k is scanned.

use super::about::{About, Form, Quantity, Setting, Stage};
use super::block::Block;
use super::needs::Need;
use super::units::Unit;
use super::{Effect, Placed};
use crate::lanes::{add_scaled, dot, minus, scaled};
use crate::sincos::sin_cos_small as sin_cos;

const ABOUT: About = About {
    id: "axis-wobble",
    title: phrase!("Axis wobble"),
    stage: Stage::Bearing,
    form: Form::Harmonic(Quantity::new("amplitude_mrad", Unit::MILLIRADIAN)),
    setting: Setting::Order { from: 2, to: 6 },
    equation: "axial displacement R·w·cos(order·q + φ)",
    source: "ISO 230-7: tilt error motion E_AC, E_BC at the radius R",
    cause: phrase!("the bearing's raceways are wavy, so that the axis tilts as it turns"),
    implausible_above: Some(2.0),
    usual_size: phrase!("0.004 to 0.2 mrad"),
    confused_with: phrase!("the form of a measured surface: a second radius parts them"),
    check: phrase!("the bearing's axial seat and preload"),
    needs: &[
        Need::REVOLUTE,
        Need::values::<6>(phrase!("six values of the joint")),
        Need::AXIAL,
    ],
    ..About::PLAIN
};

pub(super) static AXIS_WOBBLE: Effect = Effect::new(ABOUT, act);

fn act(me: &Placed, block: &mut Block) {
    let (a, b, order) = (me.coefficients[0], me.coefficients[1], me.setting);
    let (origin, along) = (me.frame.origin_mm, me.frame.along);
    block.transform(me, |x, at| {
        let (s, c) = sin_cos(order * at.q);
        let arm = minus(x, origin);
        let across = add_scaled(arm, along, -dot(arm, along));
        let radius = dot(across, across).sqrt();
        let wave = a * c - b * s;
        // On the axis the radius has no direction and the effect no lever.
        let outward = scaled(across, 1.0 / radius.max(1e-300));
        let jacobian: [[f64; 3]; 3] = std::array::from_fn(|row| {
            std::array::from_fn(|column| {
                f64::from(u8::from(row == column)) + wave * along[row] * outward[column]
            })
        });
        let columns = [scaled(along, radius * c), scaled(along, -radius * s)];
        (add_scaled(x, along, radius * wave), jacobian, columns)
    });
    block.shift_by_command(me, |x, at| {
        let (s, c) = sin_cos(order * at.q);
        let arm = minus(x, origin);
        let across = add_scaled(arm, along, -dot(arm, along));
        let radius = dot(across, across).sqrt();
        scaled(along, -order * radius * (a * s + b * c))
    });
}
