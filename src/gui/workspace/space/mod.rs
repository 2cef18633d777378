//! The workspace in three dimensions: what the plane shows, seen from wherever the camera is.
//!
//! The scene is the one of the plane, projected along the line of sight, so that vectors, colours,
//! legend and robot are the same in both; only what has a depth is added here.

mod alone;
mod ground;
mod joints;
mod looking;
mod paint;
mod pick;
mod robot;
mod sheet;
mod surface;

pub(crate) use alone::robot_alone;
pub(super) use paint::show;
pub(crate) use sheet::sheet;
