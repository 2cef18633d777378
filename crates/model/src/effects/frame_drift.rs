//! Frame drift: the measuring frame moves at a constant rate, from the first sample on.

use super::about::{About, Condition, Form, Over, Owner, Quantity, Stage};
use super::base_offset::AXES;
use super::block::Block;
use super::needs::Need;
use super::units::Unit;
use super::{Effect, Placed};
use crate::lanes::scaled;

const ABOUT: About = About {
    id: "frame-drift",
    title: phrase!("Frame drift"),
    stage: Stage::World,
    per_joint: false,
    form: Form::Plain(&[
        Quantity::new("x_mm_per_h", Unit::MM_PER_HOUR),
        Quantity::new("y_mm_per_h", Unit::MM_PER_HOUR),
        Quantity::new("z_mm_per_h", Unit::MM_PER_HOUR),
    ]),
    equation: "p = p + v (t − t0)",
    source: "ISO 9283, 7.6: drift of the pose in time",
    cause: phrase!("the tripod settles, or the base creeps"),
    over: Over::Time,
    usual_size: phrase!("any"),
    confused_with: phrase!(
        "thermal growth while the machine warms up: a temperature channel and a cool-down run part them"
    ),
    check: phrase!("tripod, clamps and the sun on the tripod's legs"),
    needs: &[Need::TIME],
    owner: Owner::Session,
    distinguished_by: &[Condition::Temperature],
    ..About::PLAIN
};

pub(super) static FRAME_DRIFT: Effect = Effect::new(ABOUT, act);

fn act(me: &Placed, block: &mut Block) {
    let rate = [me.coefficients[0], me.coefficients[1], me.coefficients[2]];
    let start_s = me.start_s;
    block.displace(me, |at| {
        let elapsed_s = at.time_s - start_s;
        (
            scaled(rate, elapsed_s),
            AXES.map(|axis| scaled(axis, elapsed_s)),
        )
    });
}
