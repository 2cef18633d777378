//! Frame shift: a step of the measuring frame at a time t*, `p += (dx, dy, dz)` from then on.
//!
//! The time is scanned; a sample at t* itself belongs to what comes after.

use super::about::{About, Form, Over, Quantity, Setting, Stage};
use super::base_offset::AXES;
use super::block::Block;
use super::{Effect, Placed, Survey};
use crate::lanes::scaled;

/// See the module.
pub(super) struct FrameShift;

const ABOUT: About = About {
    id: "frame-shift",
    title: "Frame shift",
    stage: Stage::World,
    per_joint: false,
    form: Form::Plain(&[
        Quantity {
            name: "x_mm",
            inner: 1.0,
        },
        Quantity {
            name: "y_mm",
            inner: 1.0,
        },
        Quantity {
            name: "z_mm",
            inner: 1.0,
        },
    ]),
    setting: Setting::Time,
    equation: "p = p + (x, y, z) from t* on",
    source: "a change point of the measuring frame",
    cause: "somebody touched the tripod, or the base slipped",
    over: Over::Time,
    never_negative: false,
    implausible_above: None,
    usual_size: "any",
    confused_with: "two sessions that were joined: the notes of the day tell",
    check: "return to the datum points after the step; clamps and tripod",
};

impl Effect for FrameShift {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn obstacle(&self, survey: &Survey, _: usize) -> Option<String> {
        time_needed(survey)
    }

    fn act(&self, me: &Placed, block: &mut Block) {
        let by = [me.coefficients[0], me.coefficients[1], me.coefficients[2]];
        let step_s = me.setting;
        block.displace(me, |at| {
            let after = f64::from(u8::from(at.time_s >= step_s));
            (scaled(by, after), AXES.map(|axis| scaled(axis, after)))
        });
    }
}

/// What stands against every effect of time.
pub(super) fn time_needed(survey: &Survey) -> Option<String> {
    match survey.duration_s {
        None => Some("the session has no time".to_owned()),
        Some(duration) if duration <= 0.0 => Some("every sample has the same time".to_owned()),
        Some(_) => None,
    }
}
