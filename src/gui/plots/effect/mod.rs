//! What a found effect does: the residual of the model without it, and its own curve through it.

mod model;
mod paint;

pub(crate) use model::{Asked, EffectCurve, strongest};
pub(crate) use paint::{numbers, show, sketch};
