//! How many samples deviate by how much.

mod model;
mod paint;

pub(crate) use model::Histogram;
pub(crate) use paint::{numbers, show, sketch};
