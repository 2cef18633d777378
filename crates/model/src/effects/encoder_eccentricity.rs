//! Encoder eccentricity: the encoder's ring is not centred on the axis.
//!
//! The encoder reads `q = atan2(sin θ + ε sin φ, cos θ + ε cos φ)` where the joint is at θ.
//! The cross product of (cos q, sin q) with that vector is zero, hence
//! `sin(θ − q) = ε sin(q − φ)`, which gives θ without iteration: `θ = q + asin(ε sin(q − φ))`.
//! The coefficients are a = ε cos φ and b = ε sin φ, so ε sin(q − φ) = a sin q − b cos q.

use super::about::{About, Form, Quantity};
use super::block::{Block, Turned};
use super::needs::Need;
use super::units::Unit;
use super::{Effect, Placed};
use crate::sincos::sin_cos_small as sin_cos;

const ABOUT: About = About {
    id: "encoder-eccentricity",
    title: phrase!("Encoder eccentricity"),
    form: Form::Harmonic(Quantity::new("amplitude_deg", Unit::DEGREE)),
    equation: "q = atan2(sin θ + ε sin φ, cos θ + ε cos φ)",
    source: "geometry of an off-centre graduation; e = ρ ε for a ring of radius ρ",
    cause: phrase!("the encoder's ring or the gear that drives it is mounted off centre"),
    cycles_per_turn: Some(1),
    implausible_above: Some(0.5),
    usual_size: phrase!("10 µm of eccentricity on a ring of 50 mm radius is 0.011°"),
    confused_with: phrase!(
        "a base offset together with second-order bearing runout: a second reflector at another radius parts them; gravity wind-up: another load parts them"
    ),
    check: phrase!("centre the encoder ring, or average a second reading head at 180°"),
    needs: &[
        Need::REVOLUTE,
        Need::values::<4>(phrase!("four values of the joint")),
    ],
    ..About::PLAIN
};

pub(super) static ENCODER_ECCENTRICITY: Effect = Effect::new(ABOUT, act);

/// Beyond |ε| = 1 the ring would not enclose the axis; short of it a wild trial step of the solver stays finite.
const MOST_SINE: f64 = 0.999;

fn act(me: &Placed, block: &mut Block) {
    let (a, b) = (me.coefficients[0], me.coefficients[1]);
    block.turn(me, |theta, at| {
        let (s, c) = sin_cos(at.q);
        let sine = (a * s - b * c).clamp(-MOST_SINE, MOST_SINE);
        let slope = 1.0 / (1.0 - sine * sine).sqrt();
        Turned {
            value: theta + sine.asin(),
            by_input: 1.0,
            by_coefficient: [s * slope, -c * slope],
        }
    });
    block.turn_by_command(me, me.joint, |at| {
        let (s, c) = sin_cos(at.q);
        let sine = a * s - b * c;
        // Where the sine is clamped it does not change.
        if sine.abs() < MOST_SINE {
            (a * c + b * s) / (1.0 - sine * sine).sqrt()
        } else {
            0.0
        }
    });
}
