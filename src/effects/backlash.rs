//! Backlash: `θ = q − s·b/2`, s the side from which the joint came.
//!
//! In a play of width b the output lags half of it behind the drive.

use super::about::{About, DEGREE, Form, Over, Quantity, Setting, Stage};
use super::block::{Block, Turned};
use super::{Effect, Placed, Survey};

/// See the module.
pub(super) struct Backlash;

const ABOUT: About = About {
    id: "backlash",
    title: "Backlash",
    stage: Stage::Joint,
    per_joint: true,
    form: Form::Plain(&[Quantity {
        name: "width_deg",
        inner: DEGREE,
    }]),
    setting: Setting::None,
    equation: "θ = q − s·width/2",
    source: "ISO 230-2: reversal value B; the play operator after full take-up",
    cause: "play between gear teeth, in a coupling or a key",
    over: Over::Side,
    never_negative: true,
    implausible_above: Some(0.5),
    usual_size: "0.1′ to 3′",
    confused_with: "tracking lag at one speed, drift in a single out-and-back: shuffled approaches at standstill and at two speeds part them",
    check: "preload and wear of the reducer; rock the output by hand with the drive held",
};

impl Effect for Backlash {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn obstacle(&self, survey: &Survey, joint: usize) -> Option<String> {
        both_sides_needed(survey, joint)
    }

    fn act(&self, me: &Placed, block: &mut Block) {
        let width = me.coefficients[0];
        block.turn(me, |theta, at| {
            let lag = -0.5 * at.dir;
            Turned {
                to: theta + lag * width,
                carry: 1.0,
                by: [lag],
            }
        });
    }
}

/// What stands against every effect of the side from which the joint came.
pub(super) fn both_sides_needed(survey: &Survey, joint: usize) -> Option<String> {
    match survey.joints[joint].from_sides {
        [0, 0] => {
            Some("the session does not say from which side the poses were approached".to_owned())
        }
        [0, _] | [_, 0] => Some("every pose was approached from the same side".to_owned()),
        _ => None,
    }
}
