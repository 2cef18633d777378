//! Axis wobble: the reflector moves by `R·w·cos(k q + φ)` along the axis, R its distance from it.
//!
//! The coefficients are w cos φ and w sin φ; the order k is scanned.

use super::about::{About, Form, MILLIRADIAN, Over, Quantity, Setting, Stage};
use super::block::Block;
use super::{Effect, Placed, Survey};
use crate::lanes::{add_scaled, dot, minus, scaled};
use crate::sincos::sin_cos_small as sin_cos;

/// See the module.
pub(super) struct AxisWobble;

const ABOUT: About = About {
    id: "axis-wobble",
    title: "Axis wobble",
    stage: Stage::Bearing,
    per_joint: true,
    form: Form::Harmonic(Quantity {
        name: "amplitude_mrad",
        inner: MILLIRADIAN,
    }),
    setting: Setting::Order { from: 2, to: 6 },
    equation: "axial displacement R·w·cos(order·q + φ)",
    source: "ISO 230-7: tilt error motion E_AC, E_BC at the radius R",
    cause: "the bearing's raceways are wavy, so that the axis tilts as it turns",
    over: Over::Angle,
    never_negative: false,
    implausible_above: Some(2.0),
    usual_size: "0.004 to 0.2 mrad",
    confused_with: "the form of a measured surface: a second radius parts them",
    check: "the bearing's axial seat and preload",
};

impl Effect for AxisWobble {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn obstacle(&self, survey: &Survey, joint: usize) -> Option<String> {
        survey
            .not_revolute(joint)
            .or_else(|| survey.too_few_angles(joint, 6))
            .or_else(|| axial_measurement_needed(survey, joint))
    }

    fn act(&self, me: &Placed, block: &mut Block) {
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
            let carry: [[f64; 3]; 3] = std::array::from_fn(|row| {
                std::array::from_fn(|column| {
                    f64::from(u8::from(row == column)) + wave * along[row] * outward[column]
                })
            });
            let columns = [scaled(along, radius * c), scaled(along, -radius * s)];
            (add_scaled(x, along, radius * wave), carry, columns)
        });
        block.shift_by_command(me, |x, at| {
            let (s, c) = sin_cos(order * at.q);
            let arm = minus(x, origin);
            let across = add_scaled(arm, along, -dot(arm, along));
            let radius = dot(across, across).sqrt();
            scaled(along, -order * radius * (a * s + b * c))
        });
    }
}

/// What stands against every effect along the axis where only two coordinates were measured.
pub(super) fn axial_measurement_needed(survey: &Survey, joint: usize) -> Option<String> {
    let along_z = survey.joints[joint].frame.along[2].abs() > 1.0 - 1e-6;
    (!survey.spatial && survey.joints.len() == 1 && along_z)
        .then(|| "z was not measured, and the effect is along the axis".to_owned())
}
