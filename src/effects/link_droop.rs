//! Link droop: the tool sinks along gravity in proportion to the load.

use super::about::{About, Form, Over, Quantity, Setting, Stage};
use super::block::Block;
use super::{Effect, Placed, Survey};
use crate::lanes::scaled;

/// See the module.
pub(super) struct LinkDroop;

const ABOUT: About = About {
    id: "link-droop",
    title: "Link droop",
    stage: Stage::World,
    per_joint: false,
    form: Form::Plain(&[Quantity {
        name: "mm_per_kg",
        inner: 1.0,
    }]),
    setting: Setting::None,
    equation: "p = p + C·load along gravity",
    source: "the link as a linear spring under the load",
    cause: "the link or the structure bends under the load",
    over: Over::Load,
    never_negative: false,
    implausible_above: Some(0.02),
    usual_size: "0.0001 to 0.002 mm/kg",
    confused_with: "the structure tilting as a whole: another lever arm parts them",
    check: "the bolts between base, column and link",
};

impl Effect for LinkDroop {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn obstacle(&self, survey: &Survey, _: usize) -> Option<String> {
        if !survey.gravity {
            Some("the direction of gravity is not given".to_owned())
        } else if survey.loads == 0 {
            Some("the session has no load".to_owned())
        } else if survey.loads < 2 {
            Some("the load never changed".to_owned())
        } else {
            None
        }
    }

    fn act(&self, me: &Placed, block: &mut Block) {
        let down = me.down.unwrap_or([0.0; 3]);
        let mm_per_kg = me.coefficients[0];
        block.displace(me, |at| {
            let column = scaled(down, at.load_kg);
            (scaled(column, mm_per_kg), [column])
        });
    }
}
