//! Instrument scale: `p (1 + s)` about the origin of the measuring frame.

use super::about::{About, Form, Owner, Quantity, Stage};
use super::block::Block;
use super::units::Unit;
use super::{Effect, Placed};
use crate::lanes::scaled;

const ABOUT: About = About {
    id: "instrument-scale",
    title: phrase!("Instrument scale"),
    stage: Stage::World,
    per_joint: false,
    form: Form::Plain(&[Quantity::new("scale_ppm", Unit::PPM)]),
    equation: "p = p (1 + s)",
    source: "ASME B89.4.19: scale error of a laser tracker",
    cause: phrase!("the instrument's distance scale, or its air temperature and pressure, is off"),
    implausible_above: Some(5000.0),
    usual_size: phrase!("10 to 500 ppm"),
    confused_with: phrase!("the link's length: a scale bar parts them"),
    check: phrase!("measure a scale bar; the instrument's weather station"),
    owner: Owner::Instrument,
    ..About::PLAIN
};

pub(super) static INSTRUMENT_SCALE: Effect = Effect::new(ABOUT, act);

fn act(me: &Placed, block: &mut Block) {
    let factor = 1.0 + me.coefficients[0];
    let jacobian = super::base_offset::AXES.map(|row| scaled(row, factor));
    block.transform(me, |x, _| (scaled(x, factor), jacobian, [x]));
}
