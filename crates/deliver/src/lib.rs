//! What leaves truepose: tables and programs for controllers, accuracy by standards, explanations, charts and the
//! report.
//!
//! A part of `truepose`, which shows what of it is public; the rest changes with any version.

#[macro_use]
extern crate truepose_base;

use truepose_base::{diagnostic, guard, kinematics, lanes, numeric, progress, text, units};
use truepose_calibrate::{answers, compensation, design, diagnosis, fit, paper, set_up_errors};
#[cfg(test)]
use truepose_model::simulation;
use truepose_model::{effects, model, observations};
use truepose_session::{document, importers, refusal, robots, sessions, tables};

pub mod explain;
pub mod export;
pub mod fonts;
pub mod history;
#[doc(hidden)]
pub mod language;
pub mod present;
pub mod programs;
pub mod report;
pub mod standards;

#[cfg(test)]
#[path = "../../base/src/kinematics/testing.rs"]
mod testing;
