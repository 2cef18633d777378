//! An anchor whose position or offset is not known: `distance = |p − a| + offset`.
//!
//! No effect of the robot: see [`super::places`].

use super::about::{About, Form, Quantity};
use super::units::Unit;
use super::{Effect, place};

const ABOUT: About = About {
    id: "unknown-anchor",
    title: phrase!("Anchor"),
    form: Form::Plain(&[
        Quantity::new("x_mm", Unit::MM),
        Quantity::new("y_mm", Unit::MM),
        Quantity::new("z_mm", Unit::MM),
        Quantity::new("offset_mm", Unit::MM),
    ]),
    equation: "distance = |p − a| + offset",
    ..place::ABOUT
};

/// The effect `unknown-anchor`: position and offset of a distance's anchor.
pub static UNKNOWN_ANCHOR: Effect = Effect::new(ABOUT, super::place::NOTHING);
