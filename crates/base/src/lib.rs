//! The base of all of truepose, without any measurement: sentences, diagnostics, units, files, small numerics, and the
//! geometry of robots.
//!
//! A part of `truepose`, which shows what of it is public; the rest changes with any version.

#[macro_use]
mod named;
#[macro_use]
pub mod text;
#[doc(hidden)]
pub mod atomic;
#[doc(hidden)]
pub mod budget;
#[doc(hidden)]
pub mod decompose;
pub mod diagnostic;
#[doc(hidden)]
pub mod distributions;
#[doc(hidden)]
pub mod fewest;
#[doc(hidden)]
pub mod guard;
pub mod kinematics;
#[doc(hidden)]
pub mod lanes;
#[doc(hidden)]
pub mod linear;
#[doc(hidden)]
pub mod numeric;
#[doc(hidden)]
pub mod odds;
pub mod progress;
#[doc(hidden)]
pub mod rounding;
#[doc(hidden)]
pub mod side_by_side;
#[doc(hidden)]
pub mod sincos;
#[doc(hidden)]
pub mod steps;
#[doc(hidden)]
pub mod unfinished;
pub mod units;
#[doc(hidden)]
pub mod wide;

#[doc(hidden)]
pub use linkme;
