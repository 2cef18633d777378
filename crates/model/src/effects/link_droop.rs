//! Link droop: the tool sinks along gravity in proportion to the load.

use super::about::{About, Form, Over, Quantity, Stage};
use super::block::Block;
use super::needs::Need;
use super::units::Unit;
use super::{Effect, Placed, Term};
use crate::kinematics::Robot;
use crate::lanes::scaled;
use crate::text::Text;

const ABOUT: About = About {
    id: "link-droop",
    title: phrase!("Link droop"),
    stage: Stage::World,
    per_joint: false,
    form: Form::Plain(&[Quantity::new("mm_per_kg", Unit::MM_PER_KG)]),
    equation: "p = p + C·load along gravity",
    source: "the link as a linear spring under the load",
    cause: phrase!("the link or the structure bends under the load"),
    over: Over::Load,
    implausible_above: Some(0.02),
    usual_size: phrase!("0.0001 to 0.002 mm/kg"),
    confused_with: phrase!("the structure tilting as a whole: another lever arm parts them"),
    check: phrase!("the bolts between base, column and link"),
    needs: &[Need::GRAVITY, Need::LOADS],
    ..About::PLAIN
};

pub(super) static LINK_DROOP: Effect = Effect {
    remedy: Some(remedy),
    ..Effect::new(ABOUT, act)
};

fn remedy(_: &Robot, _: &Term) -> Text {
    text!("stiffen the link, or give the controller a payload model")
}

fn act(me: &Placed, block: &mut Block) {
    let down = me.down.unwrap_or([0.0; 3]);
    let mm_per_kg = me.coefficients[0];
    block.displace(me, |at| {
        let column = scaled(down, at.load_kg);
        (scaled(column, mm_per_kg), [column])
    });
}
