//! How large the deviation is at each whole number of cycles per turn of a joint.

mod paint;

pub(crate) use paint::{numbers, show, sketch};
