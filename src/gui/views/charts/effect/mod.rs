//! What a found effect does: the residual of the model without it, and its own curve through it.

mod paint;

pub(crate) use paint::{numbers, show, sketch};
