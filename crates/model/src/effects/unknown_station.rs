//! A station whose position or attitude is not known: `direction = R(ω)ᵀ (p − s)`.
//!
//! No effect of the robot: see [`super::places`].

use super::about::{About, Form, Quantity};
use super::units::Unit;
use super::{Effect, place};

const ABOUT: About = About {
    id: "unknown-station",
    title: phrase!("Station"),
    form: Form::Plain(&[
        Quantity::new("about_x_mrad", Unit::MILLIRADIAN),
        Quantity::new("about_y_mrad", Unit::MILLIRADIAN),
        Quantity::new("about_z_mrad", Unit::MILLIRADIAN),
        Quantity::new("x_mm", Unit::MM),
        Quantity::new("y_mm", Unit::MM),
        Quantity::new("z_mm", Unit::MM),
    ]),
    equation: "direction = R(ω)ᵀ (p − s)",
    ..place::ABOUT
};

/// The effect `unknown-station`: position and attitude of an instrument of directions.
pub static UNKNOWN_STATION: Effect = Effect::new(ABOUT, super::place::NOTHING);
