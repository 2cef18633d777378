//! The forward map of a serial chain: the product of exponentials.
//!
//! ```text
//! T(q) = exp([ξ1] q1) · … · exp([ξn] qn) · M
//! ```
//!
//! Each exponential is the motion of one joint about its axis at home, in the base frame, so the
//! product is read from the base outwards and worked from the tool inwards when only a point is
//! wanted: a point costs one rotation by Rodrigues' formula per joint, a pose a product of motions.
//!
//! Source: Lynch & Park, *Modern Robotics*, 2017, eq. 4.14.
//!
//! Poses are checked where they enter the program. In one that was not, a value that is missing is no
//! number, and neither is what comes of it; values beyond the last joint are of no joint.

use nalgebra::Point3;

use super::joint_kind::JointKind;
use super::pose::Pose;
use super::robot::{Axis, Robot, value_of};
use super::screw::joint_motion;

impl Robot {
    /// The tool's pose in the base frame at joint values `q`, rad and mm.
    pub fn base_from_tool(&self, q: &[f64]) -> Pose {
        let motion = self
            .joints
            .iter()
            .enumerate()
            .map(|(index, joint)| joint_motion(&joint.axis, joint.kind, value_of(q, index)))
            .fold(Pose::identity(), |before, next| before * next);
        motion * self.base_from_tool
    }

    /// The place of a point that is fixed in the tool frame, in the base frame at `q`, mm.
    ///
    /// Only the point is moved.
    pub fn point_in_base(&self, q: &[f64], point_in_tool: &Point3<f64>) -> Point3<f64> {
        let at_home = self.base_from_tool * point_in_tool;
        self.joints
            .iter()
            .enumerate()
            .rev()
            .fold(at_home, |point, (index, joint)| {
                point_moved(&joint.axis, joint.kind, value_of(q, index), &point)
            })
    }

    /// The motion from home of the parts before and behind each joint: n + 1 motions, the first that of the base
    /// (none), the last that of the tool.
    pub fn motions_from_home(&self, q: &[f64]) -> Vec<Pose> {
        let mut motions = Vec::with_capacity(self.joints.len() + 1);
        let mut motion = Pose::identity();
        motions.push(motion);
        for (index, joint) in self.joints.iter().enumerate() {
            motion *= joint_motion(&joint.axis, joint.kind, value_of(q, index));
            motions.push(motion);
        }
        motions
    }
}

/// A point after one joint moved, by Rodrigues' formula about a line.
fn point_moved(axis: &Axis, kind: JointKind, value: f64, point: &Point3<f64>) -> Point3<f64> {
    let direction = axis.direction.into_inner();
    match kind {
        JointKind::Revolute => {
            let (sine, cosine) = value.sin_cos();
            let lever = point - axis.point_mm;
            let along = direction * (direction.dot(&lever) * (1.0 - cosine));
            axis.point_mm + lever * cosine + direction.cross(&lever) * sine + along
        }
        JointKind::Prismatic => point + direction * value,
    }
}

#[cfg(test)]
mod tests {
    use super::super::testing::{robot_and_pose, target};
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn the_point_alone_goes_where_the_pose_takes_it((robot, q) in robot_and_pose(), p in target()) {
            let by_pose = robot.base_from_tool(&q) * p;
            let alone = robot.point_in_base(&q, &p);
            prop_assert!((by_pose - alone).norm() < 1e-10, "{by_pose} {alone}");
        }

        #[test]
        fn a_robot_with_another_home_counts_from_there((robot, q) in robot_and_pose()) {
            let half: Vec<f64> = q.iter().map(|value| 0.4 * value).collect();
            let rest: Vec<f64> = q.iter().zip(&half).map(|(q, half)| q - half).collect();
            let there = robot.rehomed(&half).base_from_tool(&rest);
            let off = there.to_homogeneous() - robot.base_from_tool(&q).to_homogeneous();
            prop_assert!(off.norm() < 1e-9, "{off}");
        }

        #[test]
        fn at_home_the_tool_is_at_home((robot, q) in robot_and_pose()) {
            let home = vec![0.0; q.len()];
            prop_assert_eq!(robot.base_from_tool(&home).translation, robot.base_from_tool.translation);
        }

        #[test]
        fn a_chain_cut_in_two_composes((robot, q) in robot_and_pose(), cut in 0usize..8) {
            let cut = cut.min(q.len());
            let part = |joints: &[super::super::Joint], tool: Pose| Robot {
                joints: joints.to_vec(),
                base_from_tool: tool,
                ..robot.clone()
            };
            let inner = part(&robot.joints[..cut], Pose::identity());
            let outer = part(&robot.joints[cut..], robot.base_from_tool);
            let composed = inner.base_from_tool(&q[..cut]) * outer.base_from_tool(&q[cut..]);
            let whole = robot.base_from_tool(&q);
            prop_assert!((composed.to_homogeneous() - whole.to_homogeneous()).norm() < 1e-10);
        }

        #[test]
        fn the_last_motion_from_home_is_the_tools((robot, q) in robot_and_pose()) {
            let motions = robot.motions_from_home(&q);
            prop_assert_eq!(motions.len(), q.len() + 1);
            let tool = motions[q.len()] * robot.base_from_tool;
            let difference = tool.to_homogeneous() - robot.base_from_tool(&q).to_homogeneous();
            prop_assert!(difference.norm() < 1e-12);
        }
    }

    #[test]
    fn a_pose_without_a_value_for_each_joint_is_nowhere() {
        let mut robot = super::super::testing::column();
        robot.joints.push(robot.joints[0].clone());
        let tool = robot.base_from_tool(&[0.0]).translation.vector;
        assert!(tool.x.is_nan() && tool.y.is_nan());
        let point = robot.point_in_base(&[], &Point3::new(1.0, 2.0, 3.0));
        assert!(point.x.is_nan());
        let more = robot.base_from_tool(&[0.1, 0.2, 0.3]);
        assert_eq!(more, robot.base_from_tool(&[0.1, 0.2]));
        assert_eq!(robot.motions_from_home(&[]).len(), 3);
        assert_eq!(robot.gravity_torque_nm(&[], 1.0, 7), None);
    }

    /// The source paper's half-angle form of a column that turns about z, its equations (1) to (3):
    /// with λ0 = cos(θ/2), λ3 = sin(θ/2) the lamp is at ((2λ0² − 1) l1, 2λ0λ3 l1, l2 + l3).
    #[test]
    fn the_papers_half_angle_form_is_the_product_of_exponentials_over_the_whole_circle() {
        let column = super::super::testing::column();
        for tenth_deg in -7200..=7200 {
            let theta = f64::from(tenth_deg).to_radians() / 10.0;
            let (lambda3, lambda0) = (0.5 * theta).sin_cos();
            let (cosine, sine) = (2.0 * lambda0 * lambda0 - 1.0, 2.0 * lambda0 * lambda3);
            let lamp = Point3::new(cosine * 250.0, sine * 250.0, 300.0);
            let by_exponentials = column.point_in_base(&[theta], &Point3::origin());
            assert!((lamp - by_exponentials).norm() < 5e-13, "{tenth_deg}");
            let turn = column
                .base_from_tool(&[theta])
                .rotation
                .to_rotation_matrix();
            assert!((turn[(0, 0)] - cosine).abs() < 1e-15 && (turn[(1, 0)] - sine).abs() < 1e-15);
        }
    }
}
