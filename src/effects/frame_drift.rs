//! Frame drift: the measuring frame moves at a constant rate, from the first sample on.

use super::about::{About, Form, Over, Quantity, Setting, Stage};
use super::base_offset::AXES;
use super::block::Block;
use super::frame_shift::time_needed;
use super::{Effect, Placed, Survey};
use crate::lanes::scaled;

/// See the module.
pub(super) struct FrameDrift;

/// One millimetre an hour in mm/s.
const MM_PER_H: f64 = 1.0 / 3600.0;

const ABOUT: About = About {
    id: "frame-drift",
    title: "Frame drift",
    stage: Stage::World,
    per_joint: false,
    form: Form::Plain(&[
        Quantity {
            name: "x_mm_per_h",
            inner: MM_PER_H,
        },
        Quantity {
            name: "y_mm_per_h",
            inner: MM_PER_H,
        },
        Quantity {
            name: "z_mm_per_h",
            inner: MM_PER_H,
        },
    ]),
    setting: Setting::None,
    equation: "p = p + v (t − t0)",
    source: "ISO 9283, 7.6: drift of the pose in time",
    cause: "the tripod settles, or the base creeps",
    over: Over::Time,
    never_negative: false,
    implausible_above: None,
    usual_size: "any",
    confused_with: "thermal growth while the machine warms up: a temperature channel and a cool-down run part them",
    check: "tripod, clamps and the sun on the tripod's legs",
};

impl Effect for FrameDrift {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn obstacle(&self, survey: &Survey, _: usize) -> Option<String> {
        time_needed(survey)
    }

    fn act(&self, me: &Placed, block: &mut Block) {
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
}
