//! The configuration of a pose in a robot program, and whether joint values agree with it.
//!
//! Quadrants, signs and turns are those of a joint's value and apply to any robot. Which side of the first axis the
//! wrist is on, and which side of the lower arm, is determined from the wrist's centre (where the last three axes
//! meet) against where it is at home, as far as it is off the axis there. A robot without such a wrist has no such
//! sides, and what a program states about them is ignored.

use super::inverse::REACHED_RAD;
use crate::rounding;
use std::f64::consts::{FRAC_PI_2, TAU};

use nalgebra::{Point3, Vector3};

use super::joint_kind::JointKind;
use super::robot::Robot;

/// One statement about a configuration, which a long program makes hundreds of thousands of times. Joints are counted
/// from 0; a robot has at most 100.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Statement {
    /// The joint's value in quarter turns, rounded down.
    Quadrant {
        /// The joint.
        joint: u8,
        /// 0 from 0° to 90°, −1 from −90° to 0°, and so on.
        quadrant: i16,
    },
    /// The sign of the joint's value.
    Negative {
        /// The joint.
        joint: u8,
        /// Whether it is below zero.
        negative: bool,
    },
    /// The same of the wrist's middle joint, which makers do not all count the same way round.
    WristNegative {
        /// The joint.
        joint: u8,
        /// Whether it is below zero.
        negative: bool,
    },
    /// Whole turns, rounded to the nearest: 0 from −180° to 180°.
    Turns {
        /// The joint.
        joint: u8,
        /// How many.
        turns: i16,
    },
    /// Whether the wrist's centre is on the other side of the first axis than at home.
    Behind(bool),
    /// Whether the wrist's centre is on the other side of the line from the second axis to the third
    /// than at home.
    ElbowTurned(bool),
}

impl Statement {
    /// Whether its meaning is certain: every maker counts a joint's value alike, a side is defined by each for its own
    /// arms.
    pub fn is_certain(&self) -> bool {
        let of_a_joint = [
            matches!(self, Self::Quadrant { .. }),
            matches!(self, Self::Negative { .. }),
            matches!(self, Self::Turns { .. }),
        ];
        of_a_joint.contains(&true)
    }

    /// Whether joint values (rad or mm) agree; `None` where the robot has nothing to compare.
    pub fn agrees(&self, robot: &Robot, q: &[f64]) -> Option<bool> {
        let angle = |joint: u8| {
            let joint = usize::from(joint);
            let turning = robot.joints.get(joint)?.kind == JointKind::Revolute;
            turning.then(|| q[joint])
        };
        let around = |value: f64| [value - REACHED_RAD, value + REACHED_RAD];
        match self {
            Self::Quadrant { joint, quadrant } => {
                let near = around(angle(*joint)?);
                Some(near.iter().any(|v| quadrant_of(*v) == i64::from(*quadrant)))
            }
            Self::Turns { joint, turns } => {
                let near = around(angle(*joint)?);
                Some(near.iter().any(|v| turns_of(*v) == i64::from(*turns)))
            }
            Self::Negative { joint, negative } | Self::WristNegative { joint, negative } => {
                let near = around(angle(*joint)?);
                Some(near.iter().any(|v| (*v < 0.0) == *negative))
            }
            Self::Behind(behind) => Some(Sides::of(robot)?.is_behind(robot, q)? == *behind),
            Self::ElbowTurned(turned) => {
                Some(Sides::of(robot)?.is_elbow_turned(robot, q)? == *turned)
            }
        }
    }
}

/// Quarter turns of an angle (rad), rounded down.
#[allow(clippy::cast_possible_truncation, reason = "an angle of a few turns")]
pub fn quadrant_of(angle: f64) -> i64 {
    (angle / FRAC_PI_2).floor() as i64
}

/// Whole turns of an angle (rad), to the nearest.
#[allow(clippy::cast_possible_truncation, reason = "an angle of a few turns")]
pub fn turns_of(angle: f64) -> i64 {
    (angle / TAU).round() as i64
}

/// The references for the sides of a robot with six revolute joints and a spherical wrist.
struct Sides {
    /// Where the last three axes meet, at home, base frame, mm.
    wrist_mm: Point3<f64>,
    reach_mm: f64,
}

impl Sides {
    fn of(robot: &Robot) -> Option<Self> {
        let turning = robot.joints.iter().all(|j| j.kind == JointKind::Revolute);
        if robot.joints.len() != 6 || !turning {
            return None;
        }
        let reach_mm = robot.reach_mm();
        let [fourth, fifth, sixth] = [3, 4, 5].map(|j: usize| &robot.joints[j].axis);
        // The point of the fifth axis that is nearest to the fourth, which all three have to share.
        let (u, v) = (fourth.direction.into_inner(), fifth.direction.into_inner());
        let square = 1.0 - u.dot(&v).powi(2);
        if square < rounding::WRITTEN {
            return None;
        }
        let between = fourth.point_mm - fifth.point_mm;
        let along = (v.dot(&between) - u.dot(&v) * u.dot(&between)) / square;
        let wrist_mm = fifth.point_mm + v * along;
        let off = |axis: &super::Axis| {
            let arm = wrist_mm - axis.point_mm;
            axis.direction.cross(&arm).norm()
        };
        let meet = off(fourth).max(off(sixth)) <= rounding::WRITTEN.sqrt() * reach_mm;
        meet.then_some(Self { wrist_mm, reach_mm })
    }

    /// The wrist's centre carried by the second and third joint alone: as the first axis sees it.
    fn seen_by_the_first(&self, robot: &Robot, q: &[f64]) -> Vector3<f64> {
        let mut still = q.to_vec();
        still[0] = 0.0;
        let motion = robot.motions_from_home(&still)[3];
        (motion * self.wrist_mm) - robot.joints[0].axis.point_mm
    }

    fn is_behind(&self, robot: &Robot, q: &[f64]) -> Option<bool> {
        let axis = robot.joints[0].axis.direction.into_inner();
        let across = |v: Vector3<f64>| v - axis * axis.dot(&v);
        let home = across(self.wrist_mm - robot.joints[0].axis.point_mm);
        let clear = home.norm() > rounding::WRITTEN * self.reach_mm;
        let here = across(self.seen_by_the_first(robot, q));
        clear.then(|| home.dot(&here) < 0.0)
    }

    fn is_elbow_turned(&self, robot: &Robot, q: &[f64]) -> Option<bool> {
        let (second, third) = (&robot.joints[1].axis, &robot.joints[2].axis);
        let along = second.direction.into_inner();
        let mut still = q.to_vec();
        still[0] = 0.0;
        let side = |q: &[f64]| {
            let motions = robot.motions_from_home(q);
            let elbow = motions[2] * third.point_mm - second.point_mm;
            let wrist = motions[3] * self.wrist_mm - second.point_mm;
            along.dot(&elbow.cross(&wrist))
        };
        let home = side(&vec![0.0; q.len()]);
        let clear = home.abs() > rounding::WRITTEN * self.reach_mm * self.reach_mm;
        clear.then(|| home * side(&still) < 0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kinematics::{Axis, Joint, Pose};

    fn arm() -> Robot {
        let rows: [([f64; 3], [f64; 3]); 6] = [
            ([0.0, 0.0, 1.0], [0.0, 0.0, 0.0]),
            ([0.0, 1.0, 0.0], [0.0, 0.0, 290.0]),
            ([0.0, 1.0, 0.0], [0.0, 0.0, 560.0]),
            ([1.0, 0.0, 0.0], [0.0, 0.0, 630.0]),
            ([0.0, 1.0, 0.0], [302.0, 0.0, 630.0]),
            ([1.0, 0.0, 0.0], [302.0, 0.0, 630.0]),
        ];
        let joint = |(direction, point): ([f64; 3], [f64; 3])| {
            let axis = Axis::through(direction.into(), point.into()).unwrap();
            Joint::new("j", JointKind::Revolute, axis)
        };
        Robot {
            name: "arm".to_owned(),
            joints: rows.into_iter().map(joint).collect(),
            base_from_tool: Pose::translation(374.0, 0.0, 630.0),
            gravity_m_s2: None,
            source: crate::kinematics::RobotSource::Axes,
        }
    }

    #[test]
    fn the_wrist_is_found_from_any_points_of_its_axes_at_any_angle() {
        let wrist = Point3::new(302.0, 0.0, 630.0);
        // The fifth axis at a right angle to the fourth, and at 60°.
        for fifth in [[0.0, 1.0, 0.0], [0.5, 0.75_f64.sqrt(), 0.0]] {
            let mut robot = arm();
            for (joint, direction, off) in [
                (3, [1.0, 0.0, 0.0], 40.0),
                (4, fifth, -70.0),
                (5, [1.0, 0.0, 0.0], 25.0),
            ] {
                let direction = Vector3::from(direction);
                let point = wrist + direction * off;
                robot.joints[joint].axis = Axis::through(direction, point).unwrap();
            }
            let sides = Sides::of(&robot).unwrap();
            assert!((sides.wrist_mm - wrist).norm() < 1e-9, "{}", sides.wrist_mm);
            // An axis that misses the others by a hundredth of the reach makes no such wrist.
            robot.joints[5].axis.point_mm.z += 0.01 * sides.reach_mm;
            assert!(Sides::of(&robot).is_none());
        }
    }

    #[test]
    fn no_side_is_said_of_what_stands_on_the_first_axis() {
        let mut robot = arm();
        let behind = |robot: &Robot, q2: f64| {
            let sides = Sides::of(robot).unwrap();
            sides.is_behind(robot, &[0.0, q2, 0.0, 0.0, 0.0, 0.0])
        };
        assert_eq!(behind(&robot, 0.0), Some(false));
        assert_eq!(behind(&robot, -2.0), Some(true));
        // The arm's first axis through its wrist.
        robot.joints[0].axis.point_mm.x = 302.0;
        assert_eq!(behind(&robot, 0.0), None);
    }

    #[test]
    fn quadrants_and_signs_forgive_rounding_at_their_borders() {
        let robot = arm();
        let at = |q4: f64| [0.0, 0.0, 0.0, q4, 0.0, 0.0];
        let says = |quadrant, q4| {
            Statement::Quadrant { joint: 3, quadrant }
                .agrees(&robot, &at(q4))
                .unwrap()
        };
        assert!(says(0, 0.5) && !says(-1, 0.5) && says(-1, -0.5));
        assert!(says(0, 1e-6) && says(-1, 1e-6));
        assert!(says(2, 3.3) && says(-3, -3.3));
        let negative = Statement::Negative {
            joint: 3,
            negative: true,
        };
        assert_eq!(negative.agrees(&robot, &at(-0.1)), Some(true));
        assert_eq!(negative.agrees(&robot, &at(0.1)), Some(false));
        let turns = Statement::Turns { joint: 3, turns: 1 };
        assert_eq!(turns.agrees(&robot, &at(3.5)), Some(true));
    }

    #[test]
    fn shoulder_and_elbow_are_told_from_home() {
        let robot = arm();
        let agrees = |s: Statement, q: [f64; 6]| s.agrees(&robot, &q).unwrap();
        let home = [0.0; 6];
        let over = [0.7, -1.9, 0.3, 0.0, 0.0, 0.0];
        assert!(agrees(Statement::Behind(false), home));
        assert!(agrees(Statement::Behind(true), over));
        assert!(agrees(Statement::ElbowTurned(false), home));
        let bent_back = [0.0, 0.5, -2.6, 0.0, 0.0, 0.0];
        assert!(agrees(Statement::ElbowTurned(true), bent_back));
    }

    #[test]
    fn a_robot_without_a_spherical_wrist_has_no_sides() {
        let mut robot = arm();
        robot.joints[5].axis.point_mm.z += 40.0;
        assert_eq!(Statement::Behind(false).agrees(&robot, &[0.0; 6]), None);
    }
}
