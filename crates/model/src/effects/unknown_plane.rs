//! A plane that is not known: `n·p = d`, n along `(normal_x, normal_y, normal_z)`.
//!
//! No effect of the robot: see [`super::places`].

use super::about::{About, Form, Quantity};
use super::units::Unit;
use super::{Effect, place};

const ABOUT: About = About {
    id: "unknown-plane",
    title: phrase!("Plane"),
    form: Form::Plain(&[
        Quantity::new("normal_x", Unit::DIRECTION),
        Quantity::new("normal_y", Unit::DIRECTION),
        Quantity::new("normal_z", Unit::DIRECTION),
        Quantity::new("distance_mm", Unit::MM),
    ]),
    equation: "n·p = d",
    ..place::ABOUT
};

/// The effect `unknown-plane`: normal and distance of a touched plane.
pub static UNKNOWN_PLANE: Effect = Effect::new(ABOUT, super::place::NOTHING);
