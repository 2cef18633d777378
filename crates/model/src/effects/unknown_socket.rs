//! A socket whose position is not known: `p = s`.
//!
//! No effect of the robot: see [`super::places`].

use super::about::{About, Form, Quantity};
use super::{Effect, place};

const ABOUT: About = About {
    id: "unknown-socket",
    title: phrase!("Socket"),
    form: Form::Plain(&Quantity::XYZ_MM),
    equation: "p = s",
    ..place::ABOUT
};

/// The effect `unknown-socket`: position of a socket in the base frame.
pub static UNKNOWN_SOCKET: Effect = Effect::new(ABOUT, super::place::NOTHING);
