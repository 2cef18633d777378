//! Encoder two-cycle error: `θ = q + A sin(2q + φ)`.
//!
//! The coefficients are A cos φ and A sin φ.

use super::about::{About, Form, Quantity};
use super::block::Block;
use super::needs::Need;
use super::units::Unit;
use super::{Effect, Placed};

const ABOUT: About = About {
    id: "encoder-two-cycle",
    title: phrase!("Encoder two-cycle error"),
    form: Form::Harmonic(Quantity::new("amplitude_deg", Unit::DEGREE)),
    equation: "θ = q + A sin(2q + φ)",
    source: "second harmonic of a tilted or oval graduation",
    cause: phrase!(
        "the encoder ring is tilted or oval, or a coupling between encoder and shaft is bent"
    ),
    cycles_per_turn: Some(2),
    implausible_above: Some(0.056),
    usual_size: phrase!("1″ to 20″"),
    confused_with: phrase!("a coupling error of the same order: only the part can tell"),
    check: phrase!("check the ring's mounting face for tilt and the ring for roundness"),
    needs: &[
        Need::REVOLUTE,
        Need::values::<6>(phrase!("six values of the joint")),
    ],
    ..About::PLAIN
};

pub(super) static ENCODER_TWO_CYCLE: Effect = Effect::new(ABOUT, act);

fn act(me: &Placed, block: &mut Block) {
    super::gear_transmission_error::add_sine_of_the_command(me, block, 2.0);
}
