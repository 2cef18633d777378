//! Random robots and poses for tests.

#![allow(
    dead_code,
    reason = "the tests of other crates see this file too, and each uses some of it"
)]

use nalgebra::{Point3, Vector3};
use proptest::prelude::*;

use crate::kinematics::screw::Twist;
use crate::kinematics::{Axis, Joint, JointKind, LinkMass, Pose, Robot, quaternion};

/// The pose with one joint moved.
pub(crate) fn with_joint_moved(q: &[f64], joint: usize, by: f64) -> Vec<f64> {
    let mut q = q.to_vec();
    q[joint] += by;
    q
}

/// The upright line at x.
pub(crate) fn z_axis_at(x_mm: f64) -> Axis {
    Axis::through(Vector3::z(), Point3::new(x_mm, 0.0, 0.0)).unwrap()
}

/// A joint that turns about `axis`.
pub(crate) fn revolute(axis: Axis) -> Joint {
    Joint::new("j", JointKind::Revolute, axis)
}

/// A robot of these joints.
pub(crate) fn robot_of(joints: Vec<Joint>) -> Robot {
    Robot {
        name: "test".to_owned(),
        joints,
        base_from_tool: Pose::translation(300.0, 10.0, 5.0),
        gravity_m_s2: None,
        source: crate::kinematics::RobotSource::Axes,
    }
}

/// A column that turns, its reflector at 250 mm.
pub(crate) fn column() -> Robot {
    Robot {
        name: "column".to_owned(),
        base_from_tool: Pose::translation(250.0, 0.0, 300.0),
        ..robot_of(vec![revolute(z_axis_at(0.0))])
    }
}

/// A vector with components in ±`size`.
pub(crate) fn vector(size: f64) -> impl Strategy<Value = Vector3<f64>> {
    prop::array::uniform3(-size..size).prop_map(Vector3::from)
}

/// A target in the tool frame, mm.
pub(crate) fn target() -> impl Strategy<Value = Point3<f64>> {
    vector(150.0).prop_map(Point3::from)
}

/// A small or large twist.
pub(crate) fn twist(rad: f64, mm: f64) -> impl Strategy<Value = Twist> {
    (vector(rad), vector(mm)).prop_map(|(angular, linear)| Twist::new(angular, linear))
}

fn joint() -> impl Strategy<Value = Joint> {
    let direction = prop_oneof![
        Just(Vector3::z()),
        Just(-Vector3::y()),
        vector(1.0).prop_filter("a direction", |v| v.norm() > 0.1),
    ];
    let link = prop::option::of((0.0..30.0, vector(500.0)));
    (direction, vector(800.0), prop::bool::weighted(0.75), link).prop_map(
        |(direction, point, turns, link)| {
            let axis = Axis::through(direction, Point3::from(point)).unwrap();
            let kind = if turns {
                JointKind::Revolute
            } else {
                JointKind::Prismatic
            };
            let mut joint = Joint::new("j", kind, axis);
            joint.link = link.map(|(mass_kg, centre)| LinkMass {
                mass_kg,
                centre_mm: Point3::from(centre),
            });
            joint
        },
    )
}

/// A robot of one to seven joints under gravity, and joint values for it.
pub(crate) fn robot_and_pose() -> impl Strategy<Value = (Robot, Vec<f64>)> {
    let joints = prop::collection::vec((joint(), -3.0..3.0_f64), 1..8);
    (joints, twist(2.0, 900.0), vector(10.0)).prop_map(|(joints, tool, gravity)| {
        let q = joints
            .iter()
            .map(|(joint, value)| match joint.kind {
                JointKind::Revolute => *value,
                JointKind::Prismatic => value * 100.0,
            })
            .collect();
        let robot = Robot {
            name: "random".to_owned(),
            joints: joints.into_iter().map(|(joint, _)| joint).collect(),
            base_from_tool: Pose::from_parts(tool.linear.into(), quaternion::exp(&tool.angular)),
            gravity_m_s2: Some(gravity),
            source: crate::kinematics::RobotSource::Axes,
        };
        (robot, q)
    })
}

/// The body's small motion from `from` to `to`, as a twist in the base frame.
pub(crate) fn space_twist_between(from: &Pose, to: &Pose) -> Twist {
    let motion = to * from.inverse();
    let angular = quaternion::log(&motion.rotation);
    let p = motion.translation.vector;
    // V⁻¹ p to the first order in the angle, which is small.
    Twist::new(angular, p - 0.5 * angular.cross(&p))
}
