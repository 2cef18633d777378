//! The kinds of measurement, one file each.

pub(crate) mod bearing;
pub(crate) mod distance;
pub(crate) mod orientation;
pub(crate) mod point;
pub(crate) mod pointing;
pub(crate) mod socket;
pub(crate) mod touch;

mod angles;
