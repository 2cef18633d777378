//! A component of the deviation around the angle of the joint, as circles of a ballbar test are
//! shown: the nominal circle, and the deviation magnified along its radius.

mod layout;
mod marks;
pub(crate) mod model;
mod paint;
pub(crate) mod sheet;

pub(super) use model::{Polar, scale};
pub(super) use paint::show;
