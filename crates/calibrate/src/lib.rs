//! Calibration: from samples to a model whose errors are known. Checks of rows and of the set-up, the fit, the
//! diagnosis, compensation, and poses to measure next.
//!
//! A part of `truepose`, which shows what of it is public; the rest changes with any version.

#[macro_use]
extern crate truepose_base;

use truepose_base::{
    budget, decompose, diagnostic, distributions, fewest, kinematics, lanes, linear, numeric, odds,
    rounding, side_by_side, sincos, steps, text, units, wide,
};
#[cfg(test)]
use truepose_model::simulation;
use truepose_model::{effects, model, observations};
use truepose_session::{document, sessions};

#[doc(hidden)]
pub mod answers;
pub mod compensation;
pub mod design;
pub mod diagnosis;
pub mod fit;
#[doc(hidden)]
pub mod paper;
pub mod row_checks;
pub mod set_up_errors;
mod thresholds;

#[cfg(test)]
#[path = "../../base/src/kinematics/testing.rs"]
mod testing;
