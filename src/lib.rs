//! truepose calibrates robots from measurements.
//!
//! A controller moves a nominal robot: every joint at its zero, every link of its nominal length, no backlash, no
//! compliance. A session holds commanded poses and where an instrument measured the tool. This library
//! identifies the real robot from it, with a confidence interval for every parameter, diagnoses which physical
//! effects the model lacks, and writes the table or program that corrects the controller.
//!
//! # Five calls
//!
//! [`pipeline`] is the only module that is needed; the terminal and the window use nothing else.
//!
//! ```
//! use truepose::diagnosis::Options;
//! use truepose::effects::JointValues;
//! use truepose::export::Job;
//! use truepose::pipeline::{Method, diagnose, export, hand_out, identify, load, verify};
//!
//! // 1. A session holds the nominal robot, the commands and the measured points.
//! let session = load("sessions/paper-30.json")?.session;
//! assert_eq!(session.robot.joints.len(), 1);
//!
//! // 2. The exact fit: every parameter with its unit and its 95 % interval.
//! let (found, calibration) = identify(&session, &Method::default(), JointValues::Commanded)?;
//! let offset = &found.parameters[0];
//! println!("{} {} = {} {:?}", offset.effect, offset.name, offset.value, offset.ci95);
//! assert!(found.gap.after.rms_mm < 1e-9 && found.gap.before.rms_mm > 13.0);
//!
//! // 3. Effects that are missing in the model: none here. The closure is told the progress and may
//! //    stop the search.
//! let answer = diagnose(&session, &Options::default(), &|_progress| true)?;
//! assert_eq!(answer.verdict.name(), "noise");
//!
//! // 4. The calibration checked on a session: better on another one than its own.
//! assert!(verify(&calibration, &session)?.model.rms_mm < 1e-9);
//!
//! // 5. The table that a controller loads, in memory: the caller decides where it is written.
//! //    Files are made of a calibration that does on its own session what was said of it.
//! let verified = hand_out(&calibration, &session)?;
//! let table = export("linuxcnc", &Job::new(&verified, "pan.comp"))?;
//! assert!(!table.documents[0].bytes.is_empty());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`pipeline::report`] writes the calibration report, [`pipeline::compensate`] corrects the targets of a
//! robot program in place, [`pipeline::plan_session`] says what to measure next, and
//! [`pipeline::import`] makes a session of what an instrument wrote. `examples/calibrate_an_arm.rs`
//! does the whole job for an arm.
//!
//! # Where to look
//!
//! | for | look into |
//! | --- | --- |
//! | what was measured, and every problem of a file with its place | [`sessions`], [`importers`] |
//! | robots to begin with: nominal geometry of common ones, with the source of every number | [`robots`] |
//! | robots: poses, joint values that reach a pose, URDF, MJCF, Denavit–Hartenberg rows | [`kinematics`] |
//! | the physics: one file for each way in which a robot differs from its nominal model | [`effects`] |
//! | the calibrated robot: effects along the kinematic chain, and its file | [`model`] |
//! | what an instrument can measure besides points | [`observations`] |
//! | sizes of the effects and their uncertainty | [`fit`] |
//! | set-up errors; missing effects, and what the samples cannot decide | [`set_up_errors`], [`diagnosis`] |
//! | which poses to measure | [`design`] |
//! | what to add to a command, and what no command can correct | [`compensation`], [`programs`] |
//! | tables and robot descriptions for controllers, read back to see what they do | [`export`] |
//! | accuracy as ISO 230-2 and ISO 9283 define it | [`standards`] |
//! | sessions of robots whose errors are known | [`simulation`] |
//! | the report, and the JSON documents that the commands print | [`report`], [`present`] |
//! | sessions of one robot over time; a stream of lines that grows | [`history`], [`recorder`] |
//!
//! # Units, frames, signs
//!
//! Inside, lengths are in mm, angles in rad, times in s, masses in kg, temperatures in °C; names in
//! files carry their unit (`offset_deg`, `x_mm`), and [`units`] converts at the edge. Joint values
//! and axes are those of the robot at home in its base frame; measured points are in the measuring
//! frame of the session, which `effects` may move against the base. Joints count from 0 here and
//! from 1 in files and texts. A deviation is measured − simulated; a correction is what to add to a
//! command, the deviation's negative.
//!
//! ```
//! use nalgebra::Point3;
//! use truepose::pipeline::load;
//! use truepose::units::rad_from_deg;
//!
//! let robot = load("sessions/paper-30.json")?.session.robot;
//! let tool_mm = robot.point_in_base(&[rad_from_deg(90.0)], &Point3::origin());
//! let home_mm = robot.point_in_base(&[0.0], &Point3::origin());
//! // A quarter turn about z.
//! assert!((tool_mm.y - home_mm.x).abs() < 1e-9 && (tool_mm.z - home_mm.z).abs() < 1e-9);
//! # Ok::<(), truepose::diagnostic::Rejected>(())
//! ```
//!
//! # Errors
//!
//! What is wrong with a file is a [`Rejected`](diagnostic::Rejected): every problem at once, with file, line, column
//! and what was expected.
//!
//! ```
//! let error = truepose::pipeline::parse(br#"{"format": "truepose-session/1"}"#).unwrap_err();
//! assert!(error.to_string().contains("expected"), "{error}");
//! ```
//!
//! What a program passes is held to the same. [`Session::new`](sessions::Session::new) and its builder refuse what a
//! file would be refused for, and so does every function that takes a session, a robot or a calibration whose fields
//! were filled in by hand; one that cannot refuse answers with nothing: no finding, no sample, NaN. Nothing public
//! panics on what it is given.
//!
//! # Versions
//!
//! What these pages show is the library's promise and follows semantic versioning; so do the formats
//! of its files, whose number stands in their `format`. With `default-features = false` nothing of
//! the window and of the terminal is built, and nothing that only they need.

#![cfg_attr(
    not(feature = "gui"),
    allow(
        unused_imports,
        reason = "some of it only the window uses; the build with it finds what nothing uses"
    )
)]

#[macro_use]
extern crate truepose_base;

#[doc(inline)]
pub use truepose_base::text::{self};
#[doc(inline)]
pub use truepose_base::{diagnostic, kinematics, progress, units};
#[doc(inline)]
pub use truepose_calibrate::{compensation, design, diagnosis, fit, row_checks, set_up_errors};
#[doc(inline)]
pub use truepose_deliver::{explain, export, fonts, history, present, programs, report, standards};
#[doc(inline)]
pub use truepose_model::{effects, model, observations, simulation};
#[doc(inline)]
pub use truepose_session::{importers, recorder, robots, sessions};

use truepose_base::{atomic, lanes, numeric, sincos, unfinished};
use truepose_calibrate::{answers, paper};
use truepose_deliver::language;
use truepose_session::document;

pub mod pipeline;
#[cfg(all(test, debug_assertions, feature = "gui"))]
mod sentences;
#[cfg(all(test, feature = "gui"))]
#[path = "../crates/base/src/progress/testing.rs"]
mod watching;

/// Steps inside the library that the benches time and the tests of `tests` look at; they change
/// with any version.
#[doc(hidden)]
pub mod inside {
    pub use crate::compensation::interpolation::{SortedTable, UniformTable};
    pub use crate::effects::inputs::reflectors_at_home;
    pub use crate::export::lerobot_calibration;
    pub use crate::fit::base_model::{fit as fit_base_model, start as start_of_base_model};
    pub use crate::fit::plane::sum_by_region;
    pub use crate::fit::problem::Problem;
    pub use crate::fit::solver::solve;
    pub use crate::sessions::regions::Assignment;
    pub use crate::sessions::write_csv;
    pub use crate::sincos::{sin_cos, sin_cos_all};
}

#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod cli;
#[cfg(feature = "gui")]
#[doc(hidden)]
pub mod gui;
