//! Frame shift: a step of the measuring frame at a time t*, `p += (dx, dy, dz)` from then on.
//!
//! The time is scanned; a sample at t* itself belongs to what comes after.

use super::about::{About, Form, Over, Owner, Quantity, Setting, Stage};
use super::base_offset::AXES;
use super::block::Block;
use super::needs::Need;
use super::{Effect, Placed};
use crate::lanes::scaled;

const ABOUT: About = About {
    id: "frame-shift",
    title: phrase!("Frame shift"),
    stage: Stage::World,
    per_joint: false,
    form: Form::Plain(&Quantity::XYZ_MM),
    setting: Setting::Time,
    equation: "p = p + (x, y, z) from t* on",
    source: "a change point of the measuring frame",
    cause: phrase!("the tripod was touched, or the base slipped"),
    over: Over::Time,
    usual_size: phrase!("any"),
    confused_with: phrase!("two sessions that were joined: the notes of the day tell"),
    check: phrase!("return to the datum points after the step; clamps and tripod"),
    needs: &[Need::TIME],
    owner: Owner::Session,
    ..About::PLAIN
};

pub(super) static FRAME_SHIFT: Effect = Effect::new(ABOUT, act);

fn act(me: &Placed, block: &mut Block) {
    let by = [me.coefficients[0], me.coefficients[1], me.coefficients[2]];
    let step_s = me.setting;
    block.displace(me, |at| {
        let after = f64::from(u8::from(at.time_s >= step_s));
        (scaled(by, after), AXES.map(|axis| scaled(axis, after)))
    });
}
