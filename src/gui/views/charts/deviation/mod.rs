//! A component of the deviation over the value of a joint, time, load or temperature, before and
//! after.

mod columns;
mod layout;
mod model;
mod paint;
mod paper;

pub(crate) use paint::show;
pub(crate) use paper::{numbers, sketch};
