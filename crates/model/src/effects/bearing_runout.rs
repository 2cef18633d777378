//! Bearing runout: the centre moves by `A (cos(k q + φ), sin(k q + φ))` across the axis.
//!
//! The two directions are the joint frame's `across_1` and `across_2`: x and y for an axis along
//! z. The coefficients are A cos φ and A sin φ; the order k is scanned.

use super::about::{About, Form, Quantity, Setting, Stage};
use super::block::Block;
use super::needs::Need;
use super::units::Unit;
use super::{Effect, Placed};
use crate::lanes::{add_scaled, scaled};
use crate::sincos::sin_cos_small as sin_cos;

const ABOUT: About = About {
    id: "bearing-runout",
    title: phrase!("Bearing runout"),
    stage: Stage::Bearing,
    form: Form::Harmonic(Quantity::new("amplitude_mm", Unit::MM)),
    setting: Setting::Order { from: 2, to: 6 },
    equation: "centre moves by A (cos(order·q + φ), sin(order·q + φ))",
    source: "ISO 230-7: radial error motion E_XC, E_YC",
    cause: phrase!("raceways or seats of the bearing are not round"),
    implausible_above: Some(0.5),
    usual_size: phrase!("1 to 50 µm"),
    confused_with: phrase!(
        "the form of the target or the reflector's nest: a reversal parts them; a base offset with eccentricity: a second radius parts them"
    ),
    check: phrase!("the bearing's seat and preload"),
    needs: &[
        Need::REVOLUTE,
        Need::values::<6>(phrase!("six values of the joint")),
    ],
    ..About::PLAIN
};

pub(super) static BEARING_RUNOUT: Effect = Effect::new(ABOUT, act);

fn act(me: &Placed, block: &mut Block) {
    let (a, b, order) = (me.coefficients[0], me.coefficients[1], me.setting);
    let (u, v) = (me.frame.across_1, me.frame.across_2);
    block.displace(me, |at| {
        let (s, c) = sin_cos(order * at.q);
        let by_a = add_scaled(scaled(u, c), v, s);
        let by_b = add_scaled(scaled(u, -s), v, c);
        (add_scaled(scaled(by_a, a), by_b, b), [by_a, by_b])
    });
    block.shift_by_command(me, |_, at| {
        let (s, c) = sin_cos(order * at.q);
        let along_u = -order * (a * s + b * c);
        let along_v = order * (a * c - b * s);
        add_scaled(scaled(u, along_u), v, along_v)
    });
}
