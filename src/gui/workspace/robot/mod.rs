//! The robot at one pose: the nominal one in outline, the real one beside it.

mod model;
mod paint;

pub(super) use model::{Drawn, Sign, home};
pub(super) use paint::{FAINT, beneath, real_beneath, values};
