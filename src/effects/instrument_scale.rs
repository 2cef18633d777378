//! Instrument scale: `p (1 + s)` about the origin of the measuring frame.

use super::about::{About, Form, Over, PPM, Quantity, Setting, Stage};
use super::block::Block;
use super::{Effect, Placed, Survey};
use crate::lanes::scaled;

/// See the module.
pub(super) struct InstrumentScale;

const ABOUT: About = About {
    id: "instrument-scale",
    title: "Instrument scale",
    stage: Stage::World,
    per_joint: false,
    form: Form::Plain(&[Quantity {
        name: "scale_ppm",
        inner: PPM,
    }]),
    setting: Setting::None,
    equation: "p = p (1 + s)",
    source: "ASME B89.4.19: scale error of a laser tracker",
    cause: "the instrument's distance scale, or its air temperature and pressure, is off",
    over: Over::Angle,
    never_negative: false,
    implausible_above: Some(5000.0),
    usual_size: "10 to 500 ppm",
    confused_with: "the link's length: a scale bar parts them",
    check: "measure a scale bar; the instrument's weather station",
};

impl Effect for InstrumentScale {
    fn about(&self) -> &'static About {
        &ABOUT
    }

    fn obstacle(&self, _: &Survey, _: usize) -> Option<String> {
        None
    }

    fn act(&self, me: &Placed, block: &mut Block) {
        let factor = 1.0 + me.coefficients[0];
        let carry = super::base_offset::AXES.map(|row| scaled(row, factor));
        block.transform(me, |x, _| (scaled(x, factor), carry, [x]));
    }
}
