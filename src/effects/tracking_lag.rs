//! Tracking lag: `θ = q − ω·δ`, ω the signed speed at the moment of measuring.
//!
//! The joint, or the clock of the measurement, is late by δ.

use super::about::{About, Form, Over, Quantity, Setting, Stage};
use super::block::{Block, Turned};
use super::{Effect, Placed, Survey};

/// See the module.
pub(super) struct TrackingLag;

const ABOUT: About = About {
    id: "tracking-lag",
    title: "Tracking lag",
    stage: Stage::Joint,
    per_joint: true,
    form: Form::Plain(&[Quantity {
        name: "delay_s",
        inner: 1.0,
    }]),
    setting: Setting::None,
    equation: "θ = q − ω·delay",
    source: "following error of a position loop, ω/K_v, or a late clock",
    cause: "the position loop follows late, or the instrument's clock and the controller's differ",
    over: Over::Speed,
    never_negative: false,
    implausible_above: Some(1.0),
    usual_size: "1 to 100 ms",
    confused_with: "backlash where every move has the same speed: two speeds or a standstill part them",
    check: "synchronise the clocks, then the loop's velocity gain and feed-forward",
};

impl Effect for TrackingLag {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn obstacle(&self, survey: &Survey, joint: usize) -> Option<String> {
        let joint = &survey.joints[joint];
        if joint.speeds == 0 {
            Some(
                "the session does not say how fast the joint moved while it was measured"
                    .to_owned(),
            )
        } else if joint.largest_speed == 0.0 {
            Some("every pose was measured at standstill".to_owned())
        } else if joint.speeds < 2 {
            Some("every pose was measured at the same signed speed".to_owned())
        } else {
            None
        }
    }

    fn act(&self, me: &Placed, block: &mut Block) {
        let delay_s = me.coefficients[0];
        block.turn(me, |theta, at| Turned {
            to: theta - at.speed * delay_s,
            carry: 1.0,
            by: [-at.speed],
        });
    }
}
