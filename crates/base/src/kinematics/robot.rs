//! The robot as a list of joint axes and a tool.
//!
//! Everything is at the home pose (every joint value zero) and in the base frame. Lengths in mm, angles in rad, masses
//! in kg, gravity in m/s².

use nalgebra::{Point3, Quaternion, Translation3, Unit, UnitQuaternion, Vector3};

use crate::rounding;

use super::dh_row::{DhRow, link_frames};
use super::joint_kind::JointKind;
use super::pose::Pose;

/// A chain with more joints is a mistake, and its fit would not end.
#[doc(hidden)]
pub const MOST_JOINTS: usize = 100;

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
    /// More joints than a fit ends with.
    #[error("{found} joints are more than {MOST_JOINTS}")]
    TooManyJoints {
        /// How many there are.
        found: usize,
    },
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
        if largest < rounding::COMPUTED {
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
    if largest < rounding::COMPUTED {
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
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Range {
    /// Lower end, rad or mm.
    pub from: f64,
    /// Upper end, rad or mm.
    pub to: f64,
}

/// A joint without its own drive: a linkage turns it with another one, as a parallelogram does.
///
/// ```text
/// q = ratio · q(of) + offset
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Follows {
    /// The joint that leads, counted from 0; it follows none itself.
    pub of: usize,
    /// Its own travel for each unit of the leading one's: rad or mm for each rad or mm.
    pub ratio: f64,
    /// Its value where the leading one is at zero, rad or mm.
    pub offset: f64,
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
    /// The joint that it follows, where it has no drive.
    pub follows: Option<Follows>,
    /// Turns of the motor for one of the joint, where they are stated.
    pub gear_ratio: Option<f64>,
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
            follows: None,
            gear_ratio: None,
        }
    }
}

/// The format in which a robot was described, as far as the axes alone do not show it: exports use the same terms.
/// Nothing is computed with it.
#[derive(Debug, Clone, PartialEq, Default)]
pub enum RobotSource {
    /// As joint axes.
    #[default]
    Axes,
    /// As Denavit–Hartenberg rows, one for each joint, behind a first frame.
    Dh {
        /// The frame before the first row, in the base frame.
        base_from_first: Pose,
        /// The rows.
        rows: Vec<DhRow>,
    },
    /// As links of a URDF or MJCF file: the frame behind each joint at home, in the base frame, its
    /// origin on the joint's axis.
    Links(Vec<Pose>),
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
    /// How it was described.
    pub source: RobotSource,
}

impl Robot {
    /// How far the tool is from the farthest axis at home: what a turn of 1 rad may do, mm.
    pub fn longest_lever_mm(&self) -> f64 {
        let tool = self.base_from_tool.translation.vector;
        let axes = self.joints.iter();
        let far = axes.map(|joint| (tool - joint.axis.point_mm.coords).norm());
        far.fold(100.0, f64::max)
    }

    /// How many joints the robot has, and so how many values a pose has.
    pub fn joint_count(&self) -> usize {
        self.joints.len()
    }

    /// Values of joints in degrees or mm, in rad or mm. Too many or too few are left for others to tell.
    pub fn in_base_units(&self, values: &[f64]) -> Vec<f64> {
        let kinds = self.joints.iter().map(|joint| Some(joint.kind));
        let kinds = kinds.chain(std::iter::repeat(None));
        let value = |(value, kind): (&f64, Option<JointKind>)| {
            kind.map_or(*value, |kind| kind.to_base_units(*value))
        };
        values.iter().zip(kinds).map(value).collect()
    }

    /// Which of these joints have a drive of their own.
    pub fn leading(&self, joints: &[usize]) -> Vec<usize> {
        let leads = |joint: &usize| {
            let joint = self.joints.get(*joint);
            joint.is_some_and(|joint| joint.follows.is_none())
        };
        joints.iter().copied().filter(leads).collect()
    }

    /// The joints that follow one, and their ratio to it; none of most robots.
    pub fn followers(&self, of: usize) -> impl Iterator<Item = (usize, f64)> {
        let joints = self.joints.iter().enumerate();
        joints.filter_map(move |(joint, own)| {
            let follows = own.follows.filter(|follows| follows.of == of)?;
            Some((joint, follows.ratio))
        })
    }

    /// Puts the joints that follow others where those have them.
    pub fn follow(&self, q: &mut [f64]) {
        for (joint, own) in self.joints.iter().enumerate() {
            if let Some(follows) = own.follows
                && joint < q.len()
            {
                q[joint] = follows.ratio * value_of(q, follows.of) + follows.offset;
            }
        }
    }

    /// The frame behind each joint at home, in the base frame, its origin on the joint's axis: as the
    /// description has it, else turned like the base.
    pub fn link_frames(&self) -> Vec<Pose> {
        let described = match &self.source {
            RobotSource::Axes => Vec::new(),
            RobotSource::Dh {
                base_from_first,
                rows,
            } => {
                let frames = link_frames(rows).into_iter();
                frames.map(|frame| base_from_first * frame).collect()
            }
            RobotSource::Links(frames) => frames.clone(),
        };
        // A robot that was changed since is described by its axes alone.
        let on_axis = |(frame, joint): (&Pose, &Joint)| {
            let off = frame.translation.vector - joint.axis.point_mm.coords;
            let reach = 1.0 + off.norm() + joint.axis.point_mm.coords.norm();
            off.cross(&joint.axis.direction).norm() < rounding::COMPUTED * reach
        };
        let same = described.len() == self.joints.len();
        if same && described.iter().zip(&self.joints).all(on_axis) {
            return described;
        }
        let points = self.joints.iter().map(|joint| joint.axis.point_mm.coords);
        points.map(Pose::from).collect()
    }

    /// The same robot with its home at `at`: its values are counted from there.
    #[must_use]
    pub fn rehomed(&self, at: &[f64]) -> Self {
        let motions = self.motions_from_home(at);
        let mut robot = self.clone();
        for (index, joint) in robot.joints.iter_mut().enumerate() {
            joint.axis = joint.axis.moved_by(&motions[index]);
            if let Some(link) = &mut joint.link {
                link.centre_mm = motions[index + 1] * link.centre_mm;
            }
            if let Some(limits) = &mut joint.limits {
                limits.from -= value_of(at, index);
                limits.to -= value_of(at, index);
            }
            if let Some(follows) = &mut joint.follows {
                follows.offset += follows.ratio * value_of(at, follows.of) - value_of(at, index);
            }
        }
        robot.base_from_tool = self.base_from_tool(at);
        robot.source = RobotSource::Axes;
        robot
    }
}

/// The value of a joint in a pose; NaN where the pose has none.
pub(super) fn value_of(q: &[f64], joint: usize) -> f64 {
    q.get(joint).copied().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_axis_is_normalised_whatever_its_length() {
        for length in [rounding::COMPUTED, 1.0, 1e300] {
            let axis = Axis::through(Vector3::new(0.0, 3.0, 4.0) * length, Point3::origin());
            let direction = axis.unwrap().direction;
            assert!((direction.into_inner() - Vector3::new(0.0, 0.6, 0.8)).norm() < 1e-15);
        }
    }

    #[test]
    fn at_another_home_the_same_values_stand_for_the_same_poses() {
        let axis = |v, p| Axis::through(Vector3::from(v), Point3::from(p)).unwrap();
        let mut turning = Joint::new(
            "a",
            JointKind::Revolute,
            axis([0.0, 0.6, 0.8], [10.0, 0.0, 5.0]),
        );
        turning.limits = Some(Range {
            from: -1.0,
            to: 2.0,
        });
        let mut slide = Joint::new("b", JointKind::Prismatic, axis([1.0, 0.0, 0.2], [0.0; 3]));
        slide.limits = Some(Range {
            from: 0.0,
            to: 80.0,
        });
        let robot = Robot {
            name: "r".to_owned(),
            joints: vec![turning, slide],
            base_from_tool: Pose::translation(100.0, 20.0, 3.0),
            gravity_m_s2: None,
            source: RobotSource::Axes,
        };
        let at = [0.4, 30.0];
        let other = robot.rehomed(&at);
        let limits = other.joints.iter().map(|j| j.limits.unwrap());
        let limits: Vec<[f64; 2]> = limits.map(|l| [l.from, l.to]).collect();
        assert_eq!(limits, [[-1.4, 1.6], [-30.0, 50.0]]);
        for q in [[0.4, 30.0], [-0.7, 12.0], [1.9, 0.0]] {
            let (one, same) = (
                robot.base_from_tool(&q),
                other.base_from_tool(&[q[0] - at[0], q[1] - at[1]]),
            );
            let apart = (one.to_homogeneous() - same.to_homogeneous()).norm();
            assert!(apart < 1e-12, "{q:?}: {apart}");
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
}
