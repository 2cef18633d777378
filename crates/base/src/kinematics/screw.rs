//! Twists, and the screw motion of a joint.
//!
//! A twist is written angular part first. In the base frame its linear part is the velocity of the
//! body's point that passes the base origin: a revolute axis along n through a has v = a × n.
//!
//! Source: Lynch & Park, *Modern Robotics*, 2017, sections 3.3.2 and 3.3.3.

use nalgebra::{Point3, Translation3, Vector3, Vector6};

use super::joint_kind::JointKind;
use super::pose::Pose;
use super::quaternion;
use super::robot::Axis;

/// A small or finite motion of a body, or its rate: (ω, v) in rad and mm, per unit of what causes it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Twist {
    /// Rotation, rad.
    pub angular: Vector3<f64>,
    /// Translation of the body's point at the origin of the frame, mm.
    pub linear: Vector3<f64>,
}

impl Twist {
    /// A twist from its two parts.
    pub fn new(angular: Vector3<f64>, linear: Vector3<f64>) -> Self {
        Self { angular, linear }
    }

    /// The six components (ω, v).
    pub(crate) fn to_vector(self) -> Vector6<f64> {
        let (w, v) = (self.angular, self.linear);
        Vector6::new(w.x, w.y, w.z, v.x, v.y, v.z)
    }

    /// The twist of a joint per unit of its value.
    pub(crate) fn of_axis(axis: &Axis, kind: JointKind) -> Self {
        let direction = axis.direction.into_inner();
        match kind {
            JointKind::Revolute => Self::new(direction, axis.point_mm.coords.cross(&direction)),
            JointKind::Prismatic => Self::new(Vector3::zeros(), direction),
        }
    }

    /// The velocity of the body's point that is now at `point_mm`.
    pub fn velocity_at(&self, point_mm: &Point3<f64>) -> Vector3<f64> {
        self.linear + self.angular.cross(&point_mm.coords)
    }
}

/// The motion of a joint from home to `value` (rad or mm): `exp([ξ] value)`, without the detour over ξ.
pub(crate) fn joint_motion(axis: &Axis, kind: JointKind, value: f64) -> Pose {
    match kind {
        JointKind::Revolute => {
            let rotation = quaternion::exp(&(axis.direction.into_inner() * value));
            let point = axis.point_mm.coords;
            Pose::from_parts(Translation3::from(point - rotation * point), rotation)
        }
        JointKind::Prismatic => Pose::from(axis.direction.into_inner() * value),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vector(size: f64) -> impl Strategy<Value = Vector3<f64>> {
        prop::array::uniform3(-size..size).prop_map(Vector3::from)
    }

    proptest! {
        #[test]
        fn a_joint_moves_as_the_exponential_of_its_screw(
            direction in vector(1.0).prop_filter("a direction", |v| v.norm() > 0.1),
            point in vector(1000.0), value in -7.0..7.0_f64,
        ) {
            let axis = Axis::through(direction, Point3::from(point)).unwrap();
            for kind in [JointKind::Revolute, JointKind::Prismatic] {
                let twist = Twist::of_axis(&axis, kind);
                let mut generator = twist.angular.cross_matrix().to_homogeneous();
                generator.fixed_view_mut::<3, 1>(0, 3).copy_from(&twist.linear);
                generator[(3, 3)] = 0.0;
                let motion = joint_motion(&axis, kind, value).to_homogeneous();
                prop_assert!(((generator * value).exp() - motion).norm() < 1e-10);
            }
        }
    }

    #[test]
    fn a_point_on_a_revolute_axis_stands_still() {
        let point = Point3::new(120.0, -40.0, 9.0);
        let axis = Axis::through(Vector3::new(1.0, 2.0, -2.0), point).unwrap();
        let twist = Twist::of_axis(&axis, JointKind::Revolute);
        assert!(twist.velocity_at(&point).norm() < 1e-13);
        assert!((joint_motion(&axis, JointKind::Revolute, 2.0) * point - point).norm() < 1e-12);
    }
}
