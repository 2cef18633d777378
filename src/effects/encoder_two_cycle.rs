//! Encoder two-cycle error: `θ = q + A sin(2q + φ)`.
//!
//! The coefficients are A cos φ and A sin φ.

use super::about::{About, DEGREE, Form, Over, Quantity, Setting, Stage};
use super::block::Block;
use super::{Effect, Placed, Survey};

/// See the module.
pub(super) struct EncoderTwoCycle;

const ABOUT: About = About {
    id: "encoder-two-cycle",
    title: "Encoder two-cycle error",
    stage: Stage::Joint,
    per_joint: true,
    form: Form::Harmonic(Quantity {
        name: "amplitude_deg",
        inner: DEGREE,
    }),
    setting: Setting::None,
    equation: "θ = q + A sin(2q + φ)",
    source: "second harmonic of a tilted or oval graduation",
    cause: "the encoder ring is tilted or oval, or a coupling between encoder and shaft is bent",
    over: Over::Angle,
    never_negative: false,
    implausible_above: Some(0.056),
    usual_size: "1″ to 20″",
    confused_with: "a coupling error of the same order: only the part can tell",
    check: "check the ring's mounting face for tilt and the ring for roundness",
};

impl Effect for EncoderTwoCycle {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn obstacle(&self, survey: &Survey, joint: usize) -> Option<String> {
        survey
            .not_revolute(joint)
            .or_else(|| survey.too_few_angles(joint, 6))
    }

    fn act(&self, me: &Placed, block: &mut Block) {
        super::gear_transmission_error::add_sine_of_the_command(me, block, 2.0);
    }
}
