//! Checks of a robot: numbers that are not finite, joints that cannot be distinguished.

use super::joint_kind::JointKind;
use super::pose::Pose;
use super::robot::{Axis, Joint, MOST_JOINTS, Robot};
use crate::diagnostic::{Diagnostic, Place};
use crate::rounding;
use crate::units::{LARGEST_LENGTH_MM, LARGEST_NUMBER};

impl Robot {
    /// Everything that makes the robot unusable (errors) or suspicious (warnings), each at `place`
    /// with the path of the field.
    ///
    /// Two neighbouring joints on one line are an error: they move the tool alike in every pose, so that no
    /// measurement can distinguish their zero offsets.
    pub fn problems(&self, place: &Place) -> Vec<Diagnostic> {
        let mut problems = Vec::new();
        if self.joints.is_empty() {
            problems.push(Diagnostic::error(
                place.clone().in_field("robot.joints"),
                text!("no joints"),
                text!("at least one joint"),
            ));
            return problems;
        }
        problems.extend(self.out_of_range(place));
        if self.joints.len() > MOST_JOINTS {
            return problems;
        }
        for (index, pair) in self.joints.windows(2).enumerate() {
            if move_alike(&pair[0], &pair[1]) {
                let at = place
                    .clone()
                    .in_field(format!("robot.joints[{}]", index + 1));
                problems.push(Diagnostic::error(
                    at,
                    text!(
                        "joints {index} and {next} move along the same line",
                        index = index + 1,
                        next = index + 2
                    ),
                    text!(
                        "neighbouring joints with different axes; these two cannot be told apart"
                    ),
                ));
            }
        }
        if problems.is_empty() && self.joints.len() <= 6 {
            let mobility = self.mobility();
            if mobility < self.joints.len() {
                problems.push(Diagnostic::warning(
                    place.clone().in_field("robot.joints"),
                    text!(
                        "{joints} joints that move the tool in only {mobility} independent ways",
                        joints = self.joints.len(),
                        mobility
                    ),
                    text!("as many ways as joints; some joints are redundant"),
                ));
            }
        }
        problems
    }
}

impl Robot {
    /// Numbers that are not finite or beyond any robot's range, and more joints than a fit ends
    /// with: what every source of a robot is held to, after its own checks.
    #[doc(hidden)]
    pub fn out_of_range(&self, place: &Place) -> Vec<Diagnostic> {
        let mut problems = Vec::new();
        if self.joints.len() > MOST_JOINTS {
            problems.push(Diagnostic::error(
                place.clone().in_field("robot.joints"),
                text!("{joints} joints", joints = self.joints.len()),
                text!("at most {most} joints", most = MOST_JOINTS),
            ));
            return problems;
        }
        if !is_within_reach(&self.base_from_tool) {
            problems.push(Diagnostic::error(
                place.clone().in_field("robot.tool"),
                text!("a number that is not finite or too large"),
                text!("a finite position of at most 10 000 000 mm, and an orientation"),
            ));
        }
        if self
            .gravity_m_s2
            .is_some_and(|g| !g.iter().all(|x| x.abs() <= LARGEST_NUMBER))
        {
            problems.push(Diagnostic::error(
                place.clone().in_field("robot.gravity_m_s2"),
                text!("a number that is not finite or too large"),
                text!("three finite numbers in m/s²"),
            ));
        }
        for (index, joint) in self.joints.iter().enumerate() {
            let at = place.clone().in_field(format!("robot.joints[{index}]"));
            problems.extend(joint_problems(joint, &at));
        }
        problems.extend(self.wrongly_led(place));
        problems
    }

    /// Joints that follow none, or one that follows itself.
    fn wrongly_led(&self, place: &Place) -> Vec<Diagnostic> {
        let mut problems = Vec::new();
        for (index, joint) in self.joints.iter().enumerate() {
            let Some(follows) = joint.follows else {
                continue;
            };
            let leads = self
                .joints
                .get(follows.of)
                .is_some_and(|leading| leading.follows.is_none());
            let finite = follows.ratio.is_finite() && follows.offset.is_finite();
            if !leads || follows.of == index || !finite {
                problems.push(Diagnostic::error(
                    place
                        .clone()
                        .in_field(format!("robot.joints[{index}].follows")),
                    text!("a joint that follows joint {of}", of = follows.of.saturating_add(1)),
                    text!("the number of another joint that follows none, and a finite ratio and offset"),
                ));
            }
        }
        problems
    }
}

/// A chain of joints adds their lengths up: together they may be longer than each alone.
const LARGEST_SUM_MM: f64 = LARGEST_LENGTH_MM * MOST_JOINTS as f64;

/// Written so that a NaN is refused too.
fn is_within_reach(pose: &Pose) -> bool {
    pose.translation
        .vector
        .iter()
        .all(|x| x.abs() <= LARGEST_SUM_MM)
        && pose.rotation.coords.iter().all(|x| x.is_finite())
}

fn joint_problems(joint: &Joint, place: &Place) -> Vec<Diagnostic> {
    let mut problems = Vec::new();
    let axis = &joint.axis;
    if !axis.direction.iter().all(|x| x.is_finite())
        || !axis.point_mm.iter().all(|x| x.abs() <= LARGEST_SUM_MM)
        || (axis.direction.norm() - 1.0).abs() > rounding::COMPUTED
    {
        problems.push(Diagnostic::error(
            place.clone(),
            text!("an axis that is not a line"),
            text!("a finite point and a direction of non-zero length"),
        ));
    }
    if let Some(limits) = joint.limits
        // Written so that a NaN is refused too.
        && !(limits.from < limits.to
            && limits.from.abs() <= LARGEST_NUMBER
            && limits.to.abs() <= LARGEST_NUMBER)
    {
        problems.push(Diagnostic::error(
            place.clone(),
            text!(
                "limits from {from} to {to}",
                from = limits.from,
                to = limits.to
            ),
            text!("limits of at most 1 000 000, the smaller value first"),
        ));
    }
    if let Some(link) = joint.link {
        if !(0.0..=LARGEST_NUMBER).contains(&link.mass_kg) {
            problems.push(Diagnostic::error(
                place.clone(),
                text!("a link of {mass_kg} kg", mass_kg = link.mass_kg),
                text!("a finite mass of at least 0 kg"),
            ));
        }
        if !link.centre_mm.iter().all(|x| x.abs() <= LARGEST_SUM_MM) {
            problems.push(Diagnostic::error(
                place.clone(),
                text!("a centre of mass that is not finite"),
                text!("three finite numbers in mm"),
            ));
        }
    }
    problems
}

fn move_alike(one: &Joint, other: &Joint) -> bool {
    match (one.kind, other.kind) {
        (JointKind::Revolute, JointKind::Revolute) => are_one_line(&one.axis, &other.axis),
        (JointKind::Prismatic, JointKind::Prismatic) => are_parallel(&one.axis, &other.axis),
        _ => false,
    }
}

/// Whether both are the same line in space, whichever way each points.
fn are_one_line(one: &Axis, other: &Axis) -> bool {
    let between_mm = other.point_mm - one.point_mm;
    let off_line_mm = one.direction.cross(&between_mm).norm();
    are_parallel(one, other) && off_line_mm < rounding::COMPUTED * (1.0 + between_mm.norm())
}

fn are_parallel(one: &Axis, other: &Axis) -> bool {
    one.direction.cross(&other.direction).norm() < rounding::COMPUTED
}

#[cfg(test)]
mod tests {
    use super::super::robot::{LinkMass, Range};
    use super::super::testing::{revolute, robot_of, z_axis_at};
    use super::*;
    use crate::diagnostic::Severity;
    use nalgebra::{Point3, Vector3};

    #[test]
    fn two_neighbouring_joints_on_one_line_are_an_error() {
        let mut second = z_axis_at(0.0);
        second.point_mm.z = 120.0;
        second.direction = -second.direction;
        let twin = robot_of(vec![revolute(z_axis_at(0.0)), revolute(second)]);
        let problems = twin.problems(&Place::default());
        assert_eq!(problems[0].severity, Severity::Error);
        assert!(problems[0].found.to_string().contains("joints 1 and 2"));
        let apart = robot_of(vec![revolute(z_axis_at(0.0)), revolute(z_axis_at(1.0))]);
        assert_eq!(apart.problems(&Place::default()), vec![]);
    }

    #[test]
    fn four_parallel_axes_are_worth_a_warning() {
        let planar = robot_of(
            [0.0, 100.0, 210.0, 290.0]
                .map(|x| revolute(z_axis_at(x)))
                .to_vec(),
        );
        let problems = planar.problems(&Place::default());
        assert_eq!(problems.len(), 1);
        assert_eq!(problems[0].severity, Severity::Warning);
        assert!(
            problems[0]
                .found
                .to_string()
                .contains("only 3 independent ways")
        );
    }

    #[test]
    fn every_broken_number_is_reported_and_not_only_the_first() {
        let mut joint = revolute(z_axis_at(0.0));
        joint.limits = Some(Range { from: 1.0, to: 1.0 });
        joint.link = Some(LinkMass {
            mass_kg: -2.0,
            centre_mm: Point3::new(f64::NAN, 0.0, 0.0),
        });
        let mut robot = robot_of(vec![joint]);
        robot.gravity_m_s2 = Some(Vector3::new(0.0, f64::INFINITY, 0.0));
        robot.base_from_tool.translation.vector.x = f64::NAN;
        assert_eq!(robot.problems(&Place::default()).len(), 5);
    }
}
