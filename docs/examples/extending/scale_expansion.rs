//! Expansion of a linear scale: `q' = q (1 + α (T − 20 °C))`.
//!
//! The scale by which a slide is positioned grows with its temperature, about the joint's zero. The
//! coefficient is α.

use super::about::{About, Condition, Form, Over, Quantity};
use super::block::{Block, Turned};
use super::needs::Need;
use super::units::Unit;
use super::{Effect, Placed};
use crate::kinematics::JointKind;

const ABOUT: About = About {
    id: "scale-expansion",
    title: phrase!("Expansion of the scale"),
    form: Form::Plain(&[Quantity::new("ppm_per_degc", Unit::PPM_PER_KELVIN)]),
    equation: "q' = q (1 + α (T − 20 °C))",
    source: "ISO 230-3: thermally caused errors of a linear axis",
    cause: phrase!("the scale by which the slide is positioned grows with its temperature"),
    over: Over::Temperature,
    implausible_above: Some(100.0),
    usual_size: phrase!("0 to 24 ppm/K"),
    confused_with: phrase!("a scale error: another temperature separates them"),
    check: phrase!("the material of the scale, and the controller's temperature compensation"),
    needs: &[Need::PRISMATIC, Need::TEMPERATURE],
    distinguished_by: &[Condition::Temperature],
    ..About::PLAIN
};

pub(super) static SCALE_EXPANSION: Effect = Effect {
    exists_on,
    ..Effect::new(ABOUT, act)
};

fn exists_on(_: usize, kind: JointKind) -> bool {
    kind == JointKind::Prismatic
}

fn act(me: &Placed, block: &mut Block) {
    let alpha = me.coefficients[0];
    block.turn(me, |q, at| {
        let stretch = 1.0 + alpha * at.above_20_c;
        Turned {
            value: stretch * q,
            by_input: stretch,
            by_coefficient: [at.above_20_c * q],
        }
    });
}
