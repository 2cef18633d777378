//! Backlash: `θ = q − s·b/2`, s the side from which the joint came.
//!
//! In a play of width b the output lags half of it behind the drive.

use super::about::{About, Condition, Form, Over, Quantity};
use super::block::{Block, Turned};
use super::needs::Need;
use super::units::Unit;
use super::{Effect, Placed};

pub(super) const ABOUT: About = About {
    id: "backlash",
    title: phrase!("Backlash"),
    form: Form::Plain(&[Quantity::new("width_deg", Unit::DEGREE).sliding("width_mm", Unit::MM)]),
    equation: "θ = q − s·width/2",
    source: "ISO 230-2: reversal value B; the play operator after full take-up",
    cause: phrase!("play between gear teeth, in a coupling or a key"),
    over: Over::Side,
    non_negative: true,
    implausible_above: Some(0.5),
    usual_size: phrase!("0.1′ to 3′"),
    confused_with: phrase!(
        "tracking lag at one speed, drift in a single out-and-back: shuffled approaches at standstill and at two speeds part them"
    ),
    check: phrase!("preload and wear of the reducer; rock the output by hand with the drive held"),
    needs: &[Need::BOTH_SIDES],
    distinguished_by: &[Condition::Speed],
    ..About::PLAIN
};

pub(super) static BACKLASH: Effect = Effect::new(ABOUT, act);

fn act(me: &Placed, block: &mut Block) {
    let width = me.coefficients[0];
    block.turn(me, |theta, at| {
        let lag = -0.5 * at.dir;
        Turned {
            value: theta + lag * width,
            by_input: 1.0,
            by_coefficient: [lag],
        }
    });
}
