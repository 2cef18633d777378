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
//! [`programs`] corrects the targets of tables and robot programs in place.
//! [`importers`] makes sessions of what instruments write. [`simulation`] makes sessions of robots whose
//! errors are known. [`pipeline`] does the whole job; whoever uses the library begins there.
//!
//! Inside, lengths are in mm, angles in rad, times in s, masses in kg, temperatures in °C. A
//! deviation is measured − simulated; a correction is what to add, the deviation's negative.

pub mod atomic;
pub mod diagnostic;
pub(crate) mod document;
pub mod fonts;
pub mod lanes;
pub(crate) mod linear;
pub mod progress;
pub mod recorder;
pub mod sincos;
pub mod units;
pub mod wide;

pub mod kinematics;
pub mod sessions;

pub mod effects;

pub mod model;

pub mod observations;

pub mod answers;
pub mod fit;
pub mod simulation;

pub mod set_up_errors;

pub mod diagnosis;

pub mod design;

pub mod paper;
pub mod present;

pub mod compensation;

pub mod export;
pub mod history;
pub mod importers;
pub mod pipeline;
pub mod programs;

pub mod standards;

pub mod report;

#[cfg(feature = "gui")]
pub mod gui;
