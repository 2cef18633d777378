//! The model of the real robot: physical effects, the exact forward map with its derivatives, what instruments measure
//! of it, and simulated sessions.
//!
//! A part of `truepose`, which shows what of it is public; the rest changes with any version.

#[macro_use]
extern crate truepose_base;

use truepose_base::{
    budget, decompose, diagnostic, distributions, fewest, kinematics, lanes, numeric, progress,
    rounding, sincos, text, units, wide,
};
use truepose_session::{document, sessions};

pub mod effects;
pub mod model;
pub mod observations;
pub mod simulation;

#[doc(hidden)]
pub use model::format_v1::read::write_model;

#[cfg(test)]
#[path = "../../base/src/kinematics/testing.rs"]
mod testing;
