//! A pose: where a frame is, and how it is turned.

use nalgebra::Isometry3;

/// The pose of one frame in another: `base_from_tool` maps tool coordinates to base coordinates.
pub type Pose = Isometry3<f64>;
