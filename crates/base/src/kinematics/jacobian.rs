//! Derivatives of the tool's pose and of points by the joint values.
//!
//! ```text
//! J_s = [Ad(A_0) ξ1 … Ad(A_{n−1}) ξn],   A_i = exp([ξ1] q1) … exp([ξi] qi)
//! ∂p/∂q_i = ω_i × p + v_i,   (ω_i, v_i) column i of J_s
//! ```
//!
//! Rows of a twist are (ω, v), rad and mm; a column is per rad (revolute) or per mm (prismatic).
//! The linear part is the velocity of the body's point at the base origin.
//!
//! Source: Lynch & Park, *Modern Robotics*, 2017, section 5.1.

use nalgebra::Matrix6xX;

use crate::decompose;
use crate::numeric::GOLDEN_ANGLE;

use super::pose::Pose;
use super::robot::{Robot, value_of};
use super::screw::{Twist, joint_motion};

impl Robot {
    /// The twist of each joint at `q`, in the base frame, per unit of its value.
    #[doc(hidden)]
    pub fn joint_twists(&self, q: &[f64]) -> Vec<Twist> {
        let mut before = Pose::identity();
        let mut twists = Vec::with_capacity(self.joints.len());
        for (index, joint) in self.joints.iter().enumerate() {
            let value = value_of(q, index);
            twists.push(Twist::of_axis(&joint.axis.moved_by(&before), joint.kind));
            before *= joint_motion(&joint.axis, joint.kind, value);
        }
        twists
    }

    /// The Jacobian of the tool's pose as twists in the base frame, 6 × n.
    pub fn space_jacobian(&self, q: &[f64]) -> Matrix6xX<f64> {
        columns(&self.joint_twists(q))
    }

    /// The mobility of the tool in a generic pose: the rank of the Jacobian, at most 6.
    ///
    /// Fewer than there are joints means that some joints are redundant everywhere.
    pub fn mobility(&self) -> usize {
        let reach_mm = self
            .joints
            .iter()
            .map(|joint| joint.axis.point_mm.coords.norm())
            .fold(self.base_from_tool.translation.vector.norm(), f64::max)
            .max(1.0);
        let rank_at = |seed: usize| {
            let q: Vec<f64> = (0..self.joints.len())
                .map(|joint| (GOLDEN_ANGLE * (joint + seed) as f64) % 2.0 - 1.0)
                .collect();
            let mut jacobian = self.space_jacobian(&q);
            // mm against rad: lengths in units of the reach make the singular values comparable.
            jacobian.rows_mut(3, 3).unscale_mut(reach_mm);
            // A unit column per joint, so that a slide of 1 mm is not small compared with a turn of 1 rad.
            for mut column in jacobian.column_iter_mut() {
                let norm = column.norm();
                if norm > 0.0 {
                    column.unscale_mut(norm);
                }
            }
            decompose::svd(jacobian).map_or(0, |svd| svd.rank(1e-9))
        };
        (1..=3).map(rank_at).max().unwrap_or(0)
    }
}

fn columns(twists: &[Twist]) -> Matrix6xX<f64> {
    let numbers = twists.iter().flat_map(|twist| twist.to_vector().data.0[0]);
    Matrix6xX::from_iterator(twists.len(), numbers)
}

#[cfg(test)]
mod tests {
    use super::super::testing::{robot_and_pose, space_twist_between, with_joint_moved};
    use proptest::prelude::*;

    /// Central differences lose about h² and ε/h; this step balances the two at 1 m of reach.
    const STEP: f64 = 1e-5;

    proptest! {
        #[test]
        fn the_jacobian_agrees_with_central_differences((robot, q) in robot_and_pose()) {
            let space = robot.space_jacobian(&q);
            for joint in 0..q.len() {
                let ahead = robot.base_from_tool(&with_joint_moved(&q, joint, STEP));
                let behind = robot.base_from_tool(&with_joint_moved(&q, joint, -STEP));
                let numerical = space_twist_between(&behind, &ahead).to_vector() / (2.0 * STEP);
                prop_assert!((space.column(joint) - numerical).norm() < 5e-6);
            }
        }
    }
}
