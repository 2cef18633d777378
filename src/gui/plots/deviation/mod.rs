//! A component of the deviation over the value of a joint, time, load or temperature, before and
//! after.

mod columns;
mod envelope;
mod layout;
mod model;
mod paint;

pub(crate) use envelope::Envelope;
pub(crate) use paint::{numbers, show, sketch};
