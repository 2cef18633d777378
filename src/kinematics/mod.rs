//! Rigid motions and serial chains: unit quaternions, screws, the product of exponentials.
//!
//! A robot is a list of joint screws at its home pose, in the base frame, from base to tool, and
//! the pose of the tool at home. Its forward map is the product of exponentials
//!
//! ```text
//! T(θ) = exp([ξ1] θ1) · … · exp([ξn] θn) · M
//! ```
//!
//! (Brockett 1984; Lynch & Park, *Modern Robotics*, 2017, eq. 4.14). Lengths in mm, angles in rad;
//! a revolute joint value is an angle, a prismatic one a length.

use nalgebra::{Isometry3, Point3, Unit, Vector3};

/// The pose of one frame in another: `base_from_tool` maps tool coordinates to base coordinates.
pub type Pose = Isometry3<f64>;

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
