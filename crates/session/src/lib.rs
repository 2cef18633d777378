//! What was measured: documents, tables, sessions, robots of the library, and the files of instruments.
//!
//! A part of `truepose`, which shows what of it is public; the rest changes with any version.

#[macro_use]
extern crate truepose_base;

use truepose_base::{
    atomic, decompose, diagnostic, guard, kinematics, lanes, numeric, progress, text, units,
};

#[doc(hidden)]
pub mod document;
pub mod importers;
pub mod recorder;
pub mod refusal;
pub mod robots;
pub mod sessions;
#[doc(hidden)]
pub mod tables;

#[cfg(test)]
#[path = "../../base/src/kinematics/testing.rs"]
mod testing;
#[cfg(test)]
#[path = "../../base/src/progress/testing.rs"]
mod watching;
