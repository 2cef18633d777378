//! Small changes of a robot's geometry, and derivatives by them.
//!
//! A real robot's base, joint axes and tool stand elsewhere than the drawing says. Each carries a
//! small twist δ = (ω, v), six components in rad and mm:
//!
//! ```text
//! joint axis i:  ξi′ = Ad(exp δi) ξi      δi in the base frame, at home; joint motions are conjugated
//! tool:          M′ = M exp δ_tool        δ_tool in the tool frame
//! base:          T′ = exp δ_base · T      δ_base in the base frame; everything is carried along
//! T′(q) = exp δ_base · Π exp(Ad(exp δi) [ξi] qi) · M · exp δ_tool
//! ```
//!
//! First-order motion of the tool as a space twist, with `A_i = exp([ξ1] q1) … exp([ξi] qi)`:
//!
//! ```text
//! base:  δ_base       joint i:  (Ad(A_{i−1}) − Ad(A_i)) δi       tool:  Ad(T) δ_tool
//! ```
//!
//! The joint blocks telescope: moving every axis and the tool by one twist is moving the base. That
//! is the gauge freedom of every calibration, 6 columns; and of the six components of an axis only
//! four (revolute) or two (prismatic) move a line at all ([`essential_twists`]).
//!
//! Source: Okamura & Park, *Kinematic calibration using the product of exponentials formula*, 1996;
//! Chen et al., *Local POE model for robot kinematic calibration*, 2001.

use nalgebra::{Matrix3, Matrix3xX, Matrix6xX, Point3, Vector3};

use super::robot::{Axis, JointKind, Pose, Robot};
use super::screw::{self, Twist, adjoint};

/// A twist for the base, for each joint axis and for the tool, as the module's page says.
#[derive(Debug, Clone, PartialEq)]
pub struct GeometryDelta {
    /// Motion of the whole robot, base frame.
    pub base: Twist,
    /// Motion of each joint's axis at home, base frame.
    pub joints: Vec<Twist>,
    /// Motion of the tool, tool frame.
    pub tool: Twist,
}

impl GeometryDelta {
    /// No change, for a robot with that many joints.
    pub fn zero(joint_count: usize) -> Self {
        Self {
            base: Twist::zero(),
            joints: vec![Twist::zero(); joint_count],
            tool: Twist::zero(),
        }
    }
}

/// Column of the geometry Jacobians at which the base's six begin.
pub const BASE_COLUMN: usize = 0;

/// Column of the geometry Jacobians at which joint `joint`'s six begin, counted from 0.
pub fn joint_column(joint: usize) -> usize {
    6 + 6 * joint
}

/// Column of the geometry Jacobians at which the tool's six begin.
pub fn tool_column(joint_count: usize) -> usize {
    6 + 6 * joint_count
}

/// Column of the position's geometry Jacobian at which the target's three begin.
pub fn target_column(joint_count: usize) -> usize {
    12 + 6 * joint_count
}

/// The twists that really move an axis: for a revolute one two turns about its point and two shifts
/// across it, in that order; for a prismatic one only the turns.
pub fn essential_twists(axis: &Axis, kind: JointKind) -> Vec<Twist> {
    let direction = axis.direction.into_inner();
    // Across the axis, starting from the coordinate axis that is least along it.
    let least = direction.iamin();
    let first = Vector3::ith(least, 1.0).cross(&direction).normalize();
    let second = direction.cross(&first);
    let turn = |about: Vector3<f64>| Twist::new(about, axis.point_mm.coords.cross(&about));
    let shift = |along: Vector3<f64>| Twist::new(Vector3::zeros(), along);
    match kind {
        JointKind::Revolute => vec![turn(first), turn(second), shift(first), shift(second)],
        JointKind::Prismatic => vec![turn(first), turn(second)],
    }
}

impl Robot {
    /// The robot with its geometry changed by finite twists; link masses are carried along with the
    /// base.
    ///
    /// # Panics
    /// If `delta` does not have one twist per joint.
    #[must_use]
    pub fn with_geometry(&self, delta: &GeometryDelta) -> Self {
        assert!(
            delta.joints.len() == self.joints.len(),
            "{} twists for a robot with {} joints",
            delta.joints.len(),
            self.joints.len()
        );
        let base = screw::exp(&delta.base);
        let mut changed = self.clone();
        for (joint, twist) in changed.joints.iter_mut().zip(&delta.joints) {
            joint.axis = joint.axis.moved_by(&(base * screw::exp(twist)));
            if let Some(link) = &mut joint.link {
                link.centre_mm = base * link.centre_mm;
            }
        }
        changed.base_from_tool = base * self.base_from_tool * screw::exp(&delta.tool);
        changed
    }

    /// The Jacobian of the tool's pose, as twists in the base frame, by the twists of base, joints
    /// and tool: 6 × (12 + 6n), in the order of [`joint_column`] and [`tool_column`].
    ///
    /// # Panics
    /// If `q` does not have one value per joint.
    pub fn pose_geometry_jacobian(&self, q: &[f64]) -> Matrix6xX<f64> {
        let motions = self.motions_from_home(q);
        let count = self.joints.len();
        let mut jacobian = Matrix6xX::zeros(tool_column(count) + 6);
        jacobian
            .fixed_columns_mut::<6>(BASE_COLUMN)
            .fill_with_identity();
        for (joint, pair) in motions.windows(2).enumerate() {
            let block = adjoint(&pair[0]) - adjoint(&pair[1]);
            jacobian
                .fixed_columns_mut::<6>(joint_column(joint))
                .copy_from(&block);
        }
        let base_from_tool = motions[count] * self.base_from_tool;
        jacobian
            .fixed_columns_mut::<6>(tool_column(count))
            .copy_from(&adjoint(&base_from_tool));
        jacobian
    }

    /// The same as twists in the tool frame: Ad(T⁻¹) of [`Robot::pose_geometry_jacobian`].
    ///
    /// # Panics
    /// If `q` does not have one value per joint.
    pub fn pose_geometry_jacobian_in_tool(&self, q: &[f64]) -> Matrix6xX<f64> {
        adjoint(&self.base_from_tool(q).inverse()) * self.pose_geometry_jacobian(q)
    }

    /// The Jacobian of the position, in the base frame, of a target fixed in the tool frame, by the
    /// twists of base, joints and tool and by the target's coordinates in the tool frame:
    /// 3 × (15 + 6n), mm per rad or mm.
    ///
    /// # Panics
    /// If `q` does not have one value per joint.
    pub fn position_geometry_jacobian(
        &self,
        q: &[f64],
        point_in_tool: &Point3<f64>,
    ) -> Matrix3xX<f64> {
        let motions = self.motions_from_home(q);
        let count = self.joints.len();
        let at_home = self.base_from_tool * point_in_tool;
        let base_from_tool = motions[count] * self.base_from_tool;
        let point = motions[count] * at_home;

        let mut jacobian = Matrix3xX::zeros(target_column(count) + 3);
        let (turn, shift) = point_block(&Pose::identity(), &point);
        set_block(&mut jacobian, BASE_COLUMN, &turn, &shift);
        let mut before = (turn, shift);
        for (joint, motion) in motions.iter().skip(1).enumerate() {
            let after = point_block(motion, &point);
            let turn = before.0 - after.0;
            let shift = before.1 - after.1;
            set_block(&mut jacobian, joint_column(joint), &turn, &shift);
            before = after;
        }
        let (turn, shift) = point_block(&base_from_tool, &point);
        set_block(&mut jacobian, tool_column(count), &turn, &shift);
        // A target displaced in the tool frame is displaced by the turned vector in the base frame.
        jacobian
            .fixed_columns_mut::<3>(target_column(count))
            .copy_from(&shift);
        jacobian
    }
}

/// How a point at `point`, carried by `motion`, moves with a twist given in the frame before the
/// motion: [−[p]× I] Ad(motion) = [−R [R⁻¹(p − t)]×, R].
fn point_block(motion: &Pose, point: &Point3<f64>) -> (Matrix3<f64>, Matrix3<f64>) {
    let rotation = motion.rotation.to_rotation_matrix().into_inner();
    let seen = rotation.transpose() * (point.coords - motion.translation.vector);
    (-(rotation * seen.cross_matrix()), rotation)
}

fn set_block(
    jacobian: &mut Matrix3xX<f64>,
    column: usize,
    turn: &Matrix3<f64>,
    shift: &Matrix3<f64>,
) {
    jacobian.fixed_columns_mut::<3>(column).copy_from(turn);
    jacobian.fixed_columns_mut::<3>(column + 3).copy_from(shift);
}

#[cfg(test)]
mod tests {
    use super::super::testing::{robot_and_pose, space_twist_between, target, twist};
    use super::*;
    use nalgebra::Vector6;
    use proptest::prelude::*;

    const STEP: f64 = 1e-5;

    /// The change with `value` in one column of the Jacobian and nothing elsewhere.
    fn only(column: usize, value: f64, joint_count: usize) -> GeometryDelta {
        let mut delta = GeometryDelta::zero(joint_count);
        let mut components = Vector6::zeros();
        components[column % 6] = value;
        let twist = Twist::from_vector(&components);
        match column / 6 {
            0 => delta.base = twist,
            block if block == joint_count + 1 => delta.tool = twist,
            block => delta.joints[block - 1] = twist,
        }
        delta
    }

    proptest! {
        #[test]
        fn the_geometry_jacobians_agree_with_central_differences(
            (robot, q) in robot_and_pose(), p in target(),
        ) {
            let count = q.len();
            let of_pose = robot.pose_geometry_jacobian(&q);
            let of_point = robot.position_geometry_jacobian(&q, &p);
            for column in 0..target_column(count) {
                let changed = |by| robot.with_geometry(&only(column, by, count));
                let (ahead, behind) = (changed(STEP), changed(-STEP));
                let numerical =
                    space_twist_between(&behind.base_from_tool(&q), &ahead.base_from_tool(&q));
                let numerical = numerical.to_vector() / (2.0 * STEP);
                prop_assert!((of_pose.column(column) - numerical).norm() < 2e-5, "{column}");
                let numerical =
                    (ahead.point_in_base(&q, &p) - behind.point_in_base(&q, &p)) / (2.0 * STEP);
                prop_assert!((of_point.column(column) - numerical).norm() < 1e-5, "{column}");
            }
        }

        #[test]
        fn the_target_columns_agree_with_central_differences(
            (robot, q) in robot_and_pose(), p in target(),
        ) {
            let jacobian = robot.position_geometry_jacobian(&q, &p);
            for axis in 0..3 {
                let by = nalgebra::Vector3::ith(axis, STEP);
                let numerical =
                    (robot.point_in_base(&q, &(p + by)) - robot.point_in_base(&q, &(p - by))) / (2.0 * STEP);
                let column = jacobian.column(target_column(q.len()) + axis);
                prop_assert!((column - numerical).norm() < 1e-6);
            }
        }

        #[test]
        fn moving_every_axis_and_the_tool_is_moving_the_base(
            (robot, q) in robot_and_pose(), small in twist(1e-3, 1.0),
        ) {
            let jacobian = robot.pose_geometry_jacobian(&q);
            let base: nalgebra::Matrix6<f64> = jacobian.fixed_columns::<6>(BASE_COLUMN).into();
            let in_tool = small.transformed_by(&robot.base_from_tool.inverse()).to_vector();
            let mut moved = jacobian.fixed_columns::<6>(tool_column(q.len())) * in_tool;
            for joint in 0..q.len() {
                moved += jacobian.fixed_columns::<6>(joint_column(joint)) * small.to_vector();
            }
            prop_assert!((moved - base * small.to_vector()).norm() < 1e-8);
        }

        #[test]
        fn only_the_essential_twists_move_anything((robot, q) in robot_and_pose(), p in target()) {
            let jacobian = robot.position_geometry_jacobian(&q, &p);
            for (index, joint) in robot.joints.iter().enumerate() {
                let block: Matrix3xX<f64> = jacobian.columns(joint_column(index), 6).clone_owned();
                let essential = essential_twists(&joint.axis, joint.kind);
                // Along and about the axis nothing moves; a slide does not care where it stands.
                let direction = joint.axis.direction.into_inner();
                let shift = |along| Twist::new(Vector3::zeros(), along);
                let mut idle = vec![Twist::of_axis(&joint.axis, JointKind::Revolute)];
                match joint.kind {
                    JointKind::Revolute => idle.push(shift(direction)),
                    JointKind::Prismatic => idle.extend((0..3).map(|i| shift(Vector3::ith(i, 1.0)))),
                }
                for twist in &idle {
                    prop_assert!((&block * twist.to_vector()).norm() < 1e-9);
                }
                // Together they are all six, so nothing essential is missing.
                let all: Vec<Twist> = essential.into_iter().chain(idle).collect();
                prop_assert_eq!(all.len(), 6);
                let determinant = super::super::jacobian::columns(&all).fixed_columns::<6>(0).determinant();
                prop_assert!((determinant.abs() - 1.0).abs() < 1e-8, "{}", determinant);
            }
        }

        #[test]
        fn the_tool_frames_twists_are_the_base_frames_seen_from_the_tool(
            (robot, q) in robot_and_pose(),
        ) {
            let in_tool = robot.pose_geometry_jacobian_in_tool(&q);
            let tool = in_tool.fixed_columns::<6>(tool_column(q.len()));
            prop_assert!((tool - nalgebra::Matrix6::identity()).norm() < 1e-8);
        }
    }

    #[test]
    fn link_masses_follow_the_base() {
        let mut robot = super::super::half_angle::RotatingColumn {
            l1_mm: 250.0,
            l2_mm: 0.0,
            l3_mm: 0.0,
        }
        .robot();
        robot.joints[0].link = Some(super::super::LinkMass {
            mass_kg: 1.0,
            centre_mm: Point3::new(10.0, 0.0, 0.0),
        });
        let mut delta = GeometryDelta::zero(1);
        delta.base.linear.z = 5.0;
        let link = robot.with_geometry(&delta).joints[0].link.unwrap();
        assert_eq!(link.centre_mm, Point3::new(10.0, 0.0, 5.0));
    }
}
