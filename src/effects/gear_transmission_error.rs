//! Gear transmission error: `θ = q + A sin(k q + φ)`, k cycles per turn: a whole number where the
//! error comes round with the joint, a gear's ratio where it does not.
//!
//! The coefficients are A cos φ and A sin φ; the order k is scanned.

use super::about::{About, Form, Quantity, Setting};
use super::block::{Block, Turned};
use super::needs::Need;
use super::units::Unit;
use super::{Effect, Placed};
use crate::sincos::sin_cos_small as sin_cos;

const ABOUT: About = About {
    id: "gear-transmission-error",
    title: phrase!("Gear transmission error"),
    form: Form::Harmonic(Quantity::new("amplitude_deg", Unit::DEGREE)),
    setting: Setting::Order { from: 3, to: 360 },
    equation: "θ = q + A sin(order·q + φ)",
    source: "kinematic error of gears and strain-wave reducers, one harmonic",
    cause: phrase!("tooth or wave-generator errors in the reducer; the order tells which wheel"),
    implausible_above: Some(0.33),
    usual_size: phrase!("0.5′ to 2′"),
    confused_with: phrase!(
        "the order M − k where the poses are M equal steps of a turn: unequal steps part them"
    ),
    check: phrase!(
        "compare the order with the reducer's tooth counts, then its preload and lubrication"
    ),
    needs: &[
        Need::REVOLUTE,
        Need::values::<6>(phrase!("six values of the joint")),
    ],
    ..About::PLAIN
};

pub(super) static GEAR_TRANSMISSION_ERROR: Effect = Effect::new(ABOUT, act);

fn act(me: &Placed, block: &mut Block) {
    add_sine_of_the_command(me, block, me.setting);
}

/// `θ += A sin(k q + φ)`: A cos φ multiplies sin(k q), A sin φ multiplies cos(k q).
#[inline]
pub(super) fn add_sine_of_the_command(me: &Placed, block: &mut Block, order: f64) {
    let (a, b) = (me.coefficients[0], me.coefficients[1]);
    block.turn(me, |theta, at| {
        let (s, c) = sin_cos(order * at.q);
        Turned {
            value: theta + a * s + b * c,
            by_input: 1.0,
            by_coefficient: [s, c],
        }
    });
    block.turn_by_command(me, me.joint, |at| {
        let (s, c) = sin_cos(order * at.q);
        order * (a * c - b * s)
    });
}
