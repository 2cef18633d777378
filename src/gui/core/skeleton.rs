//! The robot at one pose, as strokes from base to tool.

use nalgebra::Point3;

use crate::kinematics::{Axis, Robot};

/// Axes that enclose less than this (its sine) have no common perpendicular worth drawing.
const PARALLEL: f64 = 0.02;

/// The robot at one pose as strokes from base to tool, mm of the base frame.
///
/// A chain of axes has no links of its own, so that they are drawn where the axes put them: along
/// an axis, and from one to the next on their common perpendicular,
///
/// ```text
/// base → a₁ … b₁ → a₂ … b₂ → … → tool,   aᵢ, bᵢ on axis i,
/// ```
///
/// aᵢ nearest to what comes before, bᵢ nearest to what comes after; both are moved from home by
/// the product of exponentials ([`Robot::motions_from_home`]). For a column that is its mast and
/// its arm.
///
/// The corners from base to tool: base, two on each axis, tool.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Skeleton<'a> {
    robot: &'a Robot,
    /// Corners of the chain at home, and how many joints move each.
    nodes: Vec<(Point3<f64>, usize)>,
}

impl<'a> Skeleton<'a> {
    /// The chain of a robot up to a point of its tool, mm of the tool frame.
    pub(crate) fn new(robot: &'a Robot, target_mm: &Point3<f64>) -> Self {
        let tool = robot.base_from_tool * target_mm;
        let base = Point3::origin();
        let axes: Vec<&Axis> = robot.joints.iter().map(|joint| &joint.axis).collect();
        let mut nodes = vec![(base, 0)];
        let mut last = base;
        let mut enters = axes.first().map(|axis| on_axis(axis, &base));
        for (k, axis) in axes.iter().enumerate() {
            let enter = enters.unwrap_or_else(|| on_axis(axis, &last));
            let (leave, next) = match axes.get(k + 1) {
                None => (on_axis(axis, &tool), None),
                Some(next) => match nearest(axis, next) {
                    Some((here, there)) => (here, Some(there)),
                    None => (enter, Some(on_axis(next, &enter))),
                },
            };
            nodes.extend([(enter, k), (leave, k + 1)]);
            (last, enters) = (leave, next);
        }
        nodes.push((tool, axes.len()));
        Self { robot, nodes }
    }

    /// Where the corners are at a pose, mm of the base frame; `None` where the pose is not one.
    pub(crate) fn at(&self, q: &[f64]) -> Option<Vec<Point3<f64>>> {
        if q.len() != self.robot.joints.len() || !q.iter().all(|v| v.is_finite()) {
            return None;
        }
        let motions = self.robot.motions_from_home(q);
        let nodes = self.nodes.iter();
        let moved = nodes.map(|(at_home, joints)| motions[*joints] * at_home);
        Some(moved.collect())
    }
}

/// The point of an axis that is nearest to a point.
fn on_axis(axis: &Axis, to: &Point3<f64>) -> Point3<f64> {
    let along = axis.direction.into_inner();
    axis.point_mm + along * along.dot(&(to - axis.point_mm))
}

/// The points of two axes that are nearest to each other; `None` where they are parallel.
fn nearest(a: &Axis, b: &Axis) -> Option<(Point3<f64>, Point3<f64>)> {
    let (u, v) = (a.direction.into_inner(), b.direction.into_inner());
    let cosine = u.dot(&v);
    let squared_sine = 1.0 - cosine * cosine;
    if squared_sine < PARALLEL * PARALLEL {
        return None;
    }
    let between = b.point_mm - a.point_mm;
    let (p, r) = (u.dot(&between), v.dot(&between));
    let s = (p - cosine * r) / squared_sine;
    let t = (cosine * p - r) / squared_sine;
    Some((a.point_mm + u * s, b.point_mm + v * t))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::gui::testing::workbench;
    use crate::kinematics::{Joint, JointKind, Pose};
    use nalgebra::Vector3;

    /// An arm with six joints: base, shoulder, elbow and a wrist whose axes meet.
    fn arm() -> Robot {
        let joint = |name: &str, along: [f64; 3], at: [f64; 3]| {
            let axis = Axis::through(Vector3::from(along), Point3::from(at)).expect("an axis");
            Joint::new(name, JointKind::Revolute, axis)
        };
        Robot {
            name: "arm".to_owned(),
            joints: vec![
                joint("base", [0.0, 0.0, 1.0], [0.0, 0.0, 0.0]),
                joint("shoulder", [0.0, 1.0, 0.0], [150.0, 0.0, 450.0]),
                joint("elbow", [0.0, 1.0, 0.0], [150.0, 0.0, 1050.0]),
                joint("roll", [1.0, 0.0, 0.0], [150.0, 0.0, 1150.0]),
                joint("pitch", [0.0, 1.0, 0.0], [800.0, 0.0, 1150.0]),
                joint("flange", [1.0, 0.0, 0.0], [800.0, 0.0, 1150.0]),
            ],
            base_from_tool: Pose::translation(900.0, 0.0, 1150.0),
            gravity_m_s2: None,
            source: crate::kinematics::RobotSource::Axes,
        }
    }

    #[test]
    fn a_column_is_a_mast_and_an_arm() {
        let workbench = workbench();
        let robot = &workbench.loaded_session().session.robot;
        let corners = Skeleton::new(robot, &Point3::origin()).at(&[0.0]);
        let expected = [
            [0.0, 0.0, 0.0],
            [0.0, 0.0, 0.0],
            [0.0, 0.0, 300.0],
            [250.0, 0.0, 300.0],
        ];
        let corners = corners.expect("a pose");
        for (corner, expected) in corners.iter().zip(expected) {
            assert!(
                (corner - Point3::from(expected)).norm() < 1e-9,
                "{corners:?}"
            );
        }
    }

    #[test]
    fn the_chain_of_an_arm_ends_where_its_kinematics_say_and_links_keep_their_lengths() {
        let robot = arm();
        let target = Point3::new(10.0, 20.0, 30.0);
        let skeleton = Skeleton::new(&robot, &target);
        let lengths = |corners: &[Point3<f64>]| -> Vec<f64> {
            corners.windows(2).map(|p| (p[1] - p[0]).norm()).collect()
        };
        let home = lengths(&skeleton.at(&[0.0; 6]).expect("a pose"));
        assert!(home.iter().sum::<f64>() < 3_000.0, "{home:?}");
        for q in [
            [0.3, -0.4, 0.5, -0.6, 0.7, -0.8],
            [2.0, 0.1, -1.2, 3.0, 1.0, 0.2],
        ] {
            let corners = skeleton.at(&q).expect("a pose");
            assert_eq!(corners.len(), 2 * 6 + 2);
            let tool = robot.point_in_base(&q, &target);
            assert!((corners[13] - tool).norm() < 1e-9);
            for (here, at_home) in lengths(&corners).iter().zip(&home) {
                assert!((here - at_home).abs() < 1e-9, "a rigid link");
            }
        }
    }

    #[test]
    fn a_joint_that_slides_draws_its_way() {
        let axis = Axis::through(Vector3::x(), Point3::origin()).expect("an axis");
        let robot = Robot {
            joints: vec![Joint::new("rail", JointKind::Prismatic, axis)],
            ..arm()
        };
        let corners = Skeleton::new(&robot, &Point3::origin()).at(&[500.0]);
        let corners = corners.expect("a pose");
        let tool = corners.last().expect("a tool");
        assert!((tool - Point3::new(1400.0, 0.0, 1150.0)).norm() < 1e-9);
    }

    #[test]
    fn what_is_no_pose_draws_no_robot() {
        let robot = arm();
        let skeleton = Skeleton::new(&robot, &Point3::origin());
        assert_eq!(skeleton.at(&[0.0; 5]), None);
        assert_eq!(skeleton.at(&[0.0, 0.0, f64::NAN, 0.0, 0.0, 0.0]), None);
    }
}
