//! How many samples deviate by how much.

mod paint;

pub(crate) use paint::{numbers, show, sketch};
