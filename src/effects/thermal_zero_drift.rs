//! Thermal zero drift: `θ = q + κ (T − 20 °C)`.

use super::about::{About, DEGREE, Form, Over, Quantity, Setting, Stage};
use super::block::{Block, Turned};
use super::{Effect, Placed, Survey};

/// See the module.
pub(super) struct ThermalZeroDrift;

const ABOUT: About = About {
    id: "thermal-zero-drift",
    title: "Thermal zero drift",
    stage: Stage::Joint,
    per_joint: true,
    form: Form::Plain(&[Quantity {
        name: "deg_per_degc",
        inner: DEGREE,
    }]),
    setting: Setting::None,
    equation: "θ = q + κ (T − 20 °C)",
    source: "ISO 230-3: thermally caused drift of an axis",
    cause: "the encoder's mounting or the reducer turns a little as it warms up",
    over: Over::Temperature,
    never_negative: false,
    implausible_above: Some(0.1),
    usual_size: "0.0005 to 0.01 °/K",
    confused_with: "a drift in time while the machine warms up: a cool-down run parts them",
    check: "let the machine warm up before homing; look for a heat source beside the encoder",
};

impl Effect for ThermalZeroDrift {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn obstacle(&self, survey: &Survey, _: usize) -> Option<String> {
        temperature_needed(survey)
    }

    fn act(&self, me: &Placed, block: &mut Block) {
        let kappa = me.coefficients[0];
        block.turn(me, |theta, at| Turned {
            to: theta + kappa * at.warmth_c,
            carry: 1.0,
            by: [at.warmth_c],
        });
    }
}

/// What stands against every effect of the temperature.
pub(super) fn temperature_needed(survey: &Survey) -> Option<String> {
    match survey.warming_c {
        None => Some("the session has no temperature".to_owned()),
        Some(range) if range <= 0.0 => Some("the temperature never changed".to_owned()),
        Some(_) => None,
    }
}
