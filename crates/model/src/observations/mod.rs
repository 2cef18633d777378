//! Observations: the layer between the model and the normal equations, one file for each kind of measurement.
//!
//! The model predicts where the target is and how the tool is turned, with the derivatives of every
//! coefficient. An observation turns that into residuals (measured − predicted) and their
//! derivatives, in units of their own noise. Effects do not depend on it, and observations do not depend on effects. A
//! session may mix kinds row by row: the columns that are filled determine what was measured.
//!
//! # To add a kind
//! Write one file like its neighbours in `kinds` and add one line to the register there; the columns it
//! reads are in [`crate::sessions`]. `docs/extending.md` goes through an example.
//!
//! # How it works
//! - [`kinds`](Kind): residual and derivatives of one observation.
//! - `crate::effects::places`: anchors, stations, planes and sockets that are not known are fitted with the
//!   robot, and reported like everything that is fitted.
//! - `layer`: the observations of a session, `block` by block, as rows for the normal equations;
//!   `streams`: how they flow through the model; `follows`: how rows follow its columns.
//! - `rows`: the same as rows of a regression, for the search of names.
//! - `gauge`: what no kind at hand can determine: where the base is, how large everything is.
//! - `start`: starting values of the fit.
//! - `figures`: σ of each kind, outliers, errors by kind.
//! - `constrained`: joint values that bring a target to where it is held.
//!
//! The orientation of the tool is found from four points of it that go through the same model as the target does (its
//! origin and one along each axis), so that every effect turns the tool as it moves it, with exact derivatives, and
//! none needs code for it.

pub(crate) mod block;
#[doc(hidden)]
pub mod compared;
#[doc(hidden)]
pub mod constrained;
#[doc(hidden)]
pub mod figures;
mod follows;
#[doc(hidden)]
pub mod gauge;
pub(crate) mod layer;
#[doc(hidden)]
pub mod outliers;
#[doc(hidden)]
pub mod rows;
#[doc(hidden)]
pub mod start;
#[doc(hidden)]
pub mod streams;

mod kind;
pub(crate) mod kinds;
mod residual;

pub use block::RowBlock;
pub use figures::{Deviations, Errors, KindFigures};
pub use kind::{ANGLES_AT_MM, AboutKind, Kind, Observable, Unit};
pub(crate) use kind::{named, put_name};
pub use kinds::KINDS;
pub use kinds::kind_in_words;
pub use layer::Layer;
pub use residual::{Residual, Seen};
pub use rows::ObservedRows;
pub use streams::Item;
