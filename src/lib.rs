//! truepose calibrates robots at commissioning.
//!
//! A controller believes in a robot that nobody has built: every joint at its zero, every link as
//! long as drawn, no play, no sag. A technician commands poses, an instrument says where the tool
//! really went, and this library finds the robot that would have gone there:
//!
//! 1. [`sessions`] reads what was measured, and names every problem with its place.
//! 2. [`effects`] holds the physics: one file for each way in which a real robot differs from its
//!    drawing. [`model`] strings them along the robot's [`kinematics`], with exact derivatives.
//! 3. [`fit`] finds how large the effects are, and how sure that is.
//! 4. [`set_up_errors`] notices mistakes of setting up, and [`diagnosis`] finds what is missing beyond them, names it, and says what it cannot decide.
//! 5. [`compensation`] turns the model round: what to add to a command so that the tool arrives
//!    where it was meant to, and what joint commands cannot correct.
//! 6. [`standards`] states a robot's accuracy as ISO 230-2 and ISO 9283 define it, and [`report`]
//!    puts all of it on paper.
//! 7. [`export`] writes the table that the controller reads, and reads it back to see what it does.
//!
//! A tour on the bundled session of one axis; [`pipeline`] is the only door that is needed:
//!
//! ```
//! use truepose::diagnosis::Options;
//! use truepose::effects::JointValues;
//! use truepose::export::Job;
//! use truepose::pipeline::{Method, diagnose, export, identify, load, verify};
//!
//! // A session says what the robot is meant to be, and where it was measured instead.
//! let session = load("sessions/paper-30.json")?.session;
//! assert_eq!(session.robot.joints.len(), 1);
//!
//! // The exact fit: every parameter with its unit and its 95 % interval.
//! let (found, calibration) = identify(&session, &Method::default(), JointValues::Commanded)?;
//! let offset = &found.parameters[0];
//! println!("{} {} = {} {:?}", offset.effect, offset.name, offset.value, offset.ci95);
//! assert!(found.gap.after.rms_mm < 1e-9 && found.gap.before.rms_mm > 13.0);
//!
//! // What is missing beyond it: nothing here. The closure is told how far the search is and may stop it.
//! let answer = diagnose(&session, &Options::default(), &|_progress| true)?;
//! assert_eq!(answer.verdict.name(), "noise");
//!
//! // What the calibration brings, and the table that a controller loads.
//! assert!(verify(&calibration, &session)?.model.rms_mm < 1e-9);
//! let table = export("linuxcnc", &Job::new(&calibration, "pan.comp"))?;
//! assert!(!table.documents[0].bytes.is_empty());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Errors name the file, the line, the column and what was expected
//! ([`Rejected`](diagnostic::Rejected)). `examples/calibrate_an_arm.rs` does the same for an arm. With
//! `default-features = false` nothing of the window is built.
//!
//! [`programs`] corrects the targets of tables and robot programs in place.
//! [`importers`] makes sessions of what instruments write. [`simulation`] makes sessions of robots whose
//! errors are known. [`pipeline`] does the whole job; whoever uses the library begins there.
//!
//! Inside, lengths are in mm, angles in rad, times in s, masses in kg, temperatures in °C. A
//! deviation is measured − simulated; a correction is what to add, the deviation's negative.

pub(crate) mod atomic;
pub mod diagnostic;
pub(crate) mod document;
pub mod fonts;
pub(crate) mod lanes;
pub(crate) mod linear;
pub mod progress;
pub mod recorder;
pub(crate) mod sincos;
pub mod units;
pub(crate) mod wide;

pub mod kinematics;
pub mod sessions;

pub mod effects;

pub mod model;

pub mod observations;

pub(crate) mod answers;
pub mod fit;
pub mod simulation;

pub mod set_up_errors;

pub mod diagnosis;

pub mod design;

pub(crate) mod paper;
pub mod present;

pub mod compensation;

pub mod export;
pub mod history;
pub mod importers;
pub mod pipeline;
pub mod programs;

pub mod standards;

pub mod report;

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

#[doc(hidden)]
pub mod cli;
#[cfg(feature = "gui")]
#[doc(hidden)]
pub mod gui;
