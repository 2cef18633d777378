//! Tracking lag: `θ = q − ω·δ`, ω the signed speed at the moment of measuring.
//!
//! The joint, or the clock of the measurement, is late by δ.

use super::about::{About, Condition, Form, Over, Quantity};
use super::block::{Block, Turned};
use super::needs::Need;
use super::units::Unit;
use super::{Effect, Placed};

const ABOUT: About = About {
    id: "tracking-lag",
    title: phrase!("Tracking lag"),
    form: Form::Plain(&[Quantity::new("delay_s", Unit::SECOND)]),
    equation: "θ = q − ω·delay",
    source: "following error of a position loop, ω/K_v, or a late clock",
    cause: phrase!(
        "the position loop follows late, or the instrument's clock and the controller's differ"
    ),
    over: Over::Speed,
    implausible_above: Some(1.0),
    usual_size: phrase!("1 to 100 ms"),
    confused_with: phrase!(
        "backlash where every move has the same speed: two speeds or a standstill part them"
    ),
    check: phrase!("synchronise the clocks, then the loop's velocity gain and feed-forward"),
    needs: &[Need::SPEEDS],
    distinguished_by: &[Condition::Speed],
    ..About::PLAIN
};

pub(super) static TRACKING_LAG: Effect = Effect::new(ABOUT, act);

fn act(me: &Placed, block: &mut Block) {
    let delay_s = me.coefficients[0];
    block.turn(me, |theta, at| Turned {
        value: theta - at.speed * delay_s,
        by_input: 1.0,
        by_coefficient: [-at.speed],
    });
}
