//! Thermal zero drift: `θ = q + κ (T − 20 °C)`.

use super::about::{About, Condition, Form, Over, Quantity};
use super::block::{Block, Turned};
use super::needs::Need;
use super::units::Unit;
use super::{Effect, Placed};

const ABOUT: About = About {
    id: "thermal-zero-drift",
    title: phrase!("Thermal zero drift"),
    form: Form::Plain(&[Quantity::new("deg_per_degc", Unit::DEGREE_PER_KELVIN)
        .sliding("mm_per_degc", Unit::MM_PER_KELVIN)]),
    equation: "θ = q + κ (T − 20 °C)",
    source: "ISO 230-3: thermally caused drift of an axis",
    cause: phrase!("the encoder's mounting or the reducer turns a little as it warms up"),
    over: Over::Temperature,
    implausible_above: Some(0.1),
    usual_size: phrase!("0.0005 to 0.01 °/K"),
    confused_with: phrase!(
        "a drift in time while the machine warms up: a cool-down run parts them"
    ),
    check: phrase!(
        "let the machine warm up before homing; look for a heat source beside the encoder"
    ),
    needs: &[Need::TEMPERATURE],
    distinguished_by: &[Condition::Temperature],
    ..About::PLAIN
};

pub(super) static THERMAL_ZERO_DRIFT: Effect = Effect::new(ABOUT, act);

fn act(me: &Placed, block: &mut Block) {
    let kappa = me.coefficients[0];
    block.turn(me, |theta, at| Turned {
        value: theta + kappa * at.above_20_c,
        by_input: 1.0,
        by_coefficient: [at.above_20_c],
    });
}
