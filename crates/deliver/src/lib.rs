//! What leaves truepose: tables and programs for controllers, accuracy by standards, explanations, charts and the
//! report.
//!
//! A part of `truepose`, which shows what of it is public; the rest changes with any version.

#[macro_use]
extern crate truepose_base;

use truepose_base::{diagnostic, guard, kinematics, lanes, numeric, progress, text, units};
use truepose_session::{document, importers, robots, sessions, tables};
use truepose_model::{effects, model, observations, simulation};
use truepose_calibrate::{answers, compensation, design, diagnosis, fit, paper, set_up_errors};

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
