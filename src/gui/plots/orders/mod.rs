//! How large the deviation is at each whole number of cycles per turn of a joint.

mod model;
mod paint;
mod sums;

pub(crate) use model::Spectrum;
pub(crate) use paint::{numbers, show, sketch};
