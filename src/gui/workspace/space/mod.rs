//! The workspace in three dimensions: what the plane shows, seen from wherever the camera is.
//!
//! The scene is the one of the plane, projected along the line of sight, so that vectors, colours,
//! legend and robot are the same in both; only what has a depth is added here.

mod alone;
mod joints;
mod looking;
mod pick;
mod scene;
mod show;

pub(crate) use alone::robot_alone;
pub(crate) use show::sheet;
pub(super) use show::show;
