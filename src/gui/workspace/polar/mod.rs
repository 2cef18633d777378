//! A component of the deviation around the angle of the joint, as circles of a ballbar test are
//! shown: the nominal circle, and the deviation magnified along its radius.

pub(crate) mod model;
mod scene;
mod show;

pub(super) use model::{Polar, scale};
pub(super) use scene::legend;
pub(crate) use show::{sheet, show};
