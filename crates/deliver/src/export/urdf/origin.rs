//! How a URDF file writes where a joint is drawn.

use crate::export::euler::{rpy, three, tidy};
use crate::kinematics::Pose;

pub(super) const MM_PER_M: f64 = 1e3;

pub(super) fn origin(pose: &Pose) -> String {
    let xyz = (pose.translation.vector / MM_PER_M).map(tidy);
    let rpy = rpy(pose.rotation.to_rotation_matrix().matrix());
    format!("xyz=\"{}\" rpy=\"{}\"", three(&xyz), three(&rpy))
}
