//! The candidates of the search: every testable effect on each joint with each setting, and anonymous shapes, each
//! with its columns of the Jacobian. Nothing here depends on what was measured.
//!
//! - `table`: all of them; `columns`: their columns, in the few numbers that they are made of.
//! - `shapes`, `shape_space`, `placed`: bumps, plateaus, waves and steps over every variable, and one of them in a fit.
//! - `open_frame`: points on a line, seen from an instrument whose turn about it is open.
//! - `incomplete`: samples that lack a condition which the others have.
//! - `compatible`: which names may be in one model; `setting`: the setting of a term, in words;

pub(crate) mod columns;
mod compatible;
pub(crate) mod incomplete;
mod open_frame;
mod placed;
mod setting;
mod shape_space;
mod shapes;
pub(crate) mod table;

pub(crate) use compatible::compatible;
pub(crate) use placed::Placed;
pub(crate) use setting::{setting, shown, value};
