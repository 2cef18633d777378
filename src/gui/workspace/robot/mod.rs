//! The robot at one pose: the nominal one, and the real one beside it.

mod body;
mod card;
mod model;

pub(super) use body::{body, surface};
pub(super) use card::values;
pub(super) use model::Drawn;
