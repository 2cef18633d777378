//! The robot as a list of joint axes and a tool, and what can be wrong with one.
//!
//! Everything stands at the home pose (every joint value zero) and in the base frame. Lengths in
//! mm, angles in rad, masses in kg, gravity in m/s².

use nalgebra::{Isometry3, Point3, Quaternion, Translation3, Unit, UnitQuaternion, Vector3};

use crate::diagnostic::{Diagnostic, Place};

/// The pose of one frame in another: `base_from_tool` maps tool coordinates to base coordinates.
pub type Pose = Isometry3<f64>;

/// Below this length a direction is taken to be zero: what is left of it is rounding.
const SHORTEST_DIRECTION: f64 = 1e-12;

/// Why a robot or a pose cannot be built, or cannot be asked.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum KinematicsError {
    /// A direction of zero length.
    #[error("an axis of zero length has no direction")]
    ZeroAxis,
    /// A quaternion of zero length.
    #[error("a quaternion of zero length is no orientation")]
    ZeroQuaternion,
    /// A number that is infinite or not a number.
    #[error("{what} is not a finite number")]
    NotFinite {
        /// Which quantity it is.
        what: String,
    },
    /// A robot without joints.
    #[error("a robot needs at least one joint")]
    NoJoints,
    /// The pose does not have one value per joint.
    #[error("{found} joint values for a robot with {expected} joints")]
    WrongJointCount {
        /// How many joints the robot has.
        expected: usize,
        /// How many values came.
        found: usize,
    },
}

/// What a joint does with its value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointKind {
    /// Turns about its axis; the value is an angle in rad.
    Revolute,
    /// Slides along its axis; the value is a length in mm.
    Prismatic,
}

/// The line in space about or along which a joint moves, at home, in the base frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axis {
    /// Direction of the axis.
    pub direction: Unit<Vector3<f64>>,
    /// A point on the axis, mm.
    pub point_mm: Point3<f64>,
}

impl Axis {
    /// An axis along `direction`, which need not be of unit length, through `point_mm`.
    ///
    /// # Errors
    /// A direction of zero length, or a number that is not finite.
    pub fn through(
        direction: Vector3<f64>,
        point_mm: Point3<f64>,
    ) -> Result<Self, KinematicsError> {
        let finite = |v: &Vector3<f64>| v.iter().all(|x| x.is_finite());
        if !finite(&direction) {
            return Err(KinematicsError::NotFinite {
                what: "the direction of the axis".to_owned(),
            });
        }
        if !finite(&point_mm.coords) {
            return Err(KinematicsError::NotFinite {
                what: "the point on the axis".to_owned(),
            });
        }
        // Scaling by the largest component first keeps huge and tiny directions from overflowing.
        let largest = direction.amax();
        if largest < SHORTEST_DIRECTION {
            return Err(KinematicsError::ZeroAxis);
        }
        Ok(Self {
            direction: Unit::new_normalize(direction / largest),
            point_mm,
        })
    }

    /// The axis after a rigid motion.
    #[must_use]
    pub fn moved_by(&self, motion: &Pose) -> Self {
        Self {
            direction: motion.rotation * self.direction,
            point_mm: motion * self.point_mm,
        }
    }

    /// Whether both are the same line in space, whichever way each points.
    fn is_same_line_as(&self, other: &Self) -> bool {
        let between_mm = other.point_mm - self.point_mm;
        let off_line_mm = self.direction.cross(&between_mm).norm();
        self.is_parallel_to(other) && off_line_mm < 1e-9 * (1.0 + between_mm.norm())
    }

    fn is_parallel_to(&self, other: &Self) -> bool {
        self.direction.cross(&other.direction).norm() < 1e-9
    }
}

/// A pose from a position in mm and a quaternion (w, x, y, z), which need not be of unit length.
///
/// # Errors
/// A quaternion of zero length, or a number that is not finite.
pub fn pose_from_parts(
    position_mm: [f64; 3],
    quaternion_wxyz: [f64; 4],
) -> Result<Pose, KinematicsError> {
    if !position_mm.iter().all(|x| x.is_finite()) {
        return Err(KinematicsError::NotFinite {
            what: "the position".to_owned(),
        });
    }
    if !quaternion_wxyz.iter().all(|x| x.is_finite()) {
        return Err(KinematicsError::NotFinite {
            what: "the quaternion".to_owned(),
        });
    }
    let largest = quaternion_wxyz.iter().fold(0.0_f64, |m, x| m.max(x.abs()));
    if largest < SHORTEST_DIRECTION {
        return Err(KinematicsError::ZeroQuaternion);
    }
    let [w, x, y, z] = quaternion_wxyz.map(|part| part / largest);
    let [px, py, pz] = position_mm;
    Ok(Pose::from_parts(
        Translation3::new(px, py, pz),
        UnitQuaternion::new_normalize(Quaternion::new(w, x, y, z)),
    ))
}

/// Mass of the link behind a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinkMass {
    /// Mass of the link, kg.
    pub mass_kg: f64,
    /// Its centre of mass at home, base frame, mm.
    pub centre_mm: Point3<f64>,
}

/// A closed range of joint values, `from < to`, in rad or mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Range {
    /// Lower end.
    pub from: f64,
    /// Upper end.
    pub to: f64,
}

/// One joint of a robot.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// What the controller calls it.
    pub name: String,
    /// Revolute or prismatic.
    pub kind: JointKind,
    /// Its axis at home.
    pub axis: Axis,
    /// Travel, where it is known.
    pub limits: Option<Range>,
    /// The link behind the joint, where its mass is known.
    pub link: Option<LinkMass>,
}

impl Joint {
    /// A joint without limits and without a link mass.
    pub fn new(name: impl Into<String>, kind: JointKind, axis: Axis) -> Self {
        Self {
            name: name.into(),
            kind,
            axis,
            limits: None,
            link: None,
        }
    }

    fn moves_like(&self, other: &Self) -> bool {
        match (self.kind, other.kind) {
            (JointKind::Revolute, JointKind::Revolute) => self.axis.is_same_line_as(&other.axis),
            (JointKind::Prismatic, JointKind::Prismatic) => self.axis.is_parallel_to(&other.axis),
            _ => false,
        }
    }
}

/// A serial chain from base to tool, at home.
#[derive(Debug, Clone, PartialEq)]
pub struct Robot {
    /// What the technician calls it.
    pub name: String,
    /// Joints from base to tool; at least one.
    pub joints: Vec<Joint>,
    /// Pose of the tool frame at home.
    pub base_from_tool: Pose,
    /// Gravity in the base frame, m/s²; `None`: unknown, effects of gravity cannot be tested.
    pub gravity_m_s2: Option<Vector3<f64>>,
}

impl Robot {
    /// How many joints the robot has, and so how many values a pose has.
    pub fn joint_count(&self) -> usize {
        self.joints.len()
    }

    /// Whether `q` has one finite value per joint.
    ///
    /// # Errors
    /// Another number of values, or one that is not finite.
    pub fn check_joint_values(&self, q: &[f64]) -> Result<(), KinematicsError> {
        if q.len() != self.joints.len() {
            return Err(KinematicsError::WrongJointCount {
                expected: self.joints.len(),
                found: q.len(),
            });
        }
        match q.iter().position(|value| !value.is_finite()) {
            None => Ok(()),
            Some(index) => Err(KinematicsError::NotFinite {
                what: format!("the value of joint {}", index + 1),
            }),
        }
    }

    /// Everything that makes the robot unusable (errors) or suspicious (warnings), each at `place`
    /// with the path of the field.
    ///
    /// Two neighbouring joints on one line are an error: they move the tool alike in every pose,
    /// so no measurement can tell their zero offsets apart.
    pub fn problems(&self, place: &Place) -> Vec<Diagnostic> {
        let mut problems = Vec::new();
        if self.joints.is_empty() {
            problems.push(Diagnostic::error(
                place.clone().in_field("robot.joints"),
                "no joints",
                "at least one joint",
            ));
            return problems;
        }
        if !is_finite_pose(&self.base_from_tool) {
            problems.push(Diagnostic::error(
                place.clone().in_field("robot.tool"),
                "a number that is not finite",
                "a finite position and orientation",
            ));
        }
        if self
            .gravity_m_s2
            .is_some_and(|g| !g.iter().all(|x| x.is_finite()))
        {
            problems.push(Diagnostic::error(
                place.clone().in_field("robot.gravity_m_s2"),
                "a number that is not finite",
                "three finite numbers in m/s²",
            ));
        }
        for (index, joint) in self.joints.iter().enumerate() {
            let at = place.clone().in_field(format!("robot.joints[{index}]"));
            problems.extend(joint_problems(joint, &at));
        }
        for (index, pair) in self.joints.windows(2).enumerate() {
            if pair[0].moves_like(&pair[1]) {
                let at = place
                    .clone()
                    .in_field(format!("robot.joints[{}]", index + 1));
                problems.push(Diagnostic::error(
                    at,
                    format!(
                        "joints {} and {} move along the same line",
                        index + 1,
                        index + 2
                    ),
                    "neighbouring joints with different axes; these two cannot be told apart",
                ));
            }
        }
        if problems.is_empty() && self.joints.len() <= 6 {
            let mobility = self.mobility();
            if mobility < self.joints.len() {
                problems.push(Diagnostic::warning(
                    place.clone().in_field("robot.joints"),
                    format!(
                        "{} joints that move the tool in only {mobility} independent ways",
                        self.joints.len()
                    ),
                    "as many ways as joints; some joints stand in for each other",
                ));
            }
        }
        problems
    }
}

fn is_finite_pose(pose: &Pose) -> bool {
    pose.translation.vector.iter().all(|x| x.is_finite())
        && pose.rotation.coords.iter().all(|x| x.is_finite())
}

fn joint_problems(joint: &Joint, place: &Place) -> Vec<Diagnostic> {
    let mut problems = Vec::new();
    let axis = &joint.axis;
    if !axis.direction.iter().all(|x| x.is_finite())
        || !axis.point_mm.iter().all(|x| x.is_finite())
        || (axis.direction.norm() - 1.0).abs() > 1e-9
    {
        problems.push(Diagnostic::error(
            place.clone(),
            "an axis that is not a line",
            "a finite point and a direction of non-zero length",
        ));
    }
    if let Some(limits) = joint.limits
        // Written so that a NaN is refused too.
        && !(limits.from < limits.to && limits.from.is_finite() && limits.to.is_finite())
    {
        problems.push(Diagnostic::error(
            place.clone(),
            format!("limits from {} to {}", limits.from, limits.to),
            "finite limits, the smaller value first",
        ));
    }
    if let Some(link) = joint.link {
        if !(link.mass_kg.is_finite() && link.mass_kg >= 0.0) {
            problems.push(Diagnostic::error(
                place.clone(),
                format!("a link of {} kg", link.mass_kg),
                "a finite mass of at least 0 kg",
            ));
        }
        if !link.centre_mm.iter().all(|x| x.is_finite()) {
            problems.push(Diagnostic::error(
                place.clone(),
                "a centre of mass that is not finite",
                "three finite numbers in mm",
            ));
        }
    }
    problems
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::Severity;

    fn z_axis_at(x_mm: f64) -> Axis {
        Axis::through(Vector3::z(), Point3::new(x_mm, 0.0, 0.0)).unwrap()
    }

    fn robot(joints: Vec<Joint>) -> Robot {
        Robot {
            name: "test".to_owned(),
            joints,
            base_from_tool: Pose::translation(300.0, 10.0, 5.0),
            gravity_m_s2: None,
        }
    }

    fn revolute(axis: Axis) -> Joint {
        Joint::new("j", JointKind::Revolute, axis)
    }

    #[test]
    fn an_axis_is_normalised_whatever_its_length() {
        for length in [1e-9, 1.0, 1e300] {
            let axis = Axis::through(Vector3::new(0.0, 3.0, 4.0) * length, Point3::origin());
            let direction = axis.unwrap().direction;
            assert!((direction.into_inner() - Vector3::new(0.0, 0.6, 0.8)).norm() < 1e-15);
        }
    }

    #[test]
    fn an_axis_without_length_or_with_a_nan_is_refused() {
        let refused = |v| Axis::through(v, Point3::origin()).unwrap_err();
        assert_eq!(refused(Vector3::zeros()), KinematicsError::ZeroAxis);
        assert!(matches!(
            refused(Vector3::new(f64::NAN, 0.0, 1.0)),
            KinematicsError::NotFinite { .. }
        ));
        assert!(pose_from_parts([0.0; 3], [0.0; 4]).is_err());
        assert!(pose_from_parts([0.0, f64::INFINITY, 0.0], [1.0, 0.0, 0.0, 0.0]).is_err());
    }

    #[test]
    fn a_pose_with_another_number_of_values_is_named_as_such() {
        let robot = robot(vec![revolute(z_axis_at(0.0))]);
        let wrong = robot.check_joint_values(&[0.0, 1.0]).unwrap_err();
        assert_eq!(
            wrong.to_string(),
            "2 joint values for a robot with 1 joints"
        );
        assert!(robot.check_joint_values(&[f64::NAN]).is_err());
        assert!(robot.check_joint_values(&[0.5]).is_ok());
    }

    #[test]
    fn two_neighbouring_joints_on_one_line_are_an_error() {
        let mut second = z_axis_at(0.0);
        second.point_mm.z = 120.0;
        second.direction = -second.direction;
        let twin = robot(vec![revolute(z_axis_at(0.0)), revolute(second)]);
        let problems = twin.problems(&Place::default());
        assert_eq!(problems[0].severity, Severity::Error);
        assert!(problems[0].found.contains("joints 1 and 2"));
        let apart = robot(vec![revolute(z_axis_at(0.0)), revolute(z_axis_at(1.0))]);
        assert_eq!(apart.problems(&Place::default()), vec![]);
    }

    #[test]
    fn four_parallel_axes_are_worth_a_warning() {
        let planar = robot(
            [0.0, 100.0, 210.0, 290.0]
                .map(|x| revolute(z_axis_at(x)))
                .to_vec(),
        );
        let problems = planar.problems(&Place::default());
        assert_eq!(problems.len(), 1);
        assert_eq!(problems[0].severity, Severity::Warning);
        assert!(problems[0].found.contains("only 3 independent ways"));
    }

    #[test]
    fn every_broken_number_is_reported_and_not_only_the_first() {
        let mut joint = revolute(z_axis_at(0.0));
        joint.limits = Some(Range { from: 1.0, to: 1.0 });
        joint.link = Some(LinkMass {
            mass_kg: -2.0,
            centre_mm: Point3::new(f64::NAN, 0.0, 0.0),
        });
        let mut robot = robot(vec![joint]);
        robot.gravity_m_s2 = Some(Vector3::new(0.0, f64::INFINITY, 0.0));
        robot.base_from_tool.translation.vector.x = f64::NAN;
        assert_eq!(robot.problems(&Place::default()).len(), 5);
    }
}
