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
//! a revolute joint value is an angle, a prismatic one a length. Joints are counted from 0 here and
//! from 1 in everything that people read.
//!
//! A tour, from the ground up:
//!
//! - `robot`: what a robot is; [`Robot::problems`]: everything that can be wrong with one.
//! - `quaternion`: rotation vectors to unit quaternions and back, near 0, near π, on both covers.
//! - `screw`: twists, the motion of one joint.
//! - `chain`: the forward map of a pose ([`Robot::base_from_tool`]) and of a point alone
//!   ([`Robot::point_in_base`]).
//! - `jacobian`: derivatives by joint values.
//! - `inverse`: joint values that reach a pose, all of them; `configuration`: which of them a program
//!   means.
//! - `gravity`: gravity's torque about a joint and its gradient.
//! - `dh`, `urdf` and `mjcf`: robots from Denavit–Hartenberg rows, from URDF and from MJCF
//!   files ([`robot_from_file`]).
//!
//! ```
//! # use truepose_base as truepose;
//! use nalgebra::{Point3, Vector3};
//! use truepose::kinematics::{Axis, Joint, JointKind, Pose, Robot, RobotSource};
//!
//! let axis = Axis::through(Vector3::new(0.0, 0.0, 2.0), Point3::origin())?;
//! let robot = Robot {
//!     name: "pan".to_owned(),
//!     joints: vec![Joint::new("pan", JointKind::Revolute, axis)],
//!     base_from_tool: Pose::translation(250.0, 0.0, 300.0),
//!     gravity_m_s2: None,
//!     source: RobotSource::Axes,
//! };
//! let quarter_turn = [std::f64::consts::FRAC_PI_2];
//! let tool_mm = robot.point_in_base(&quarter_turn, &Point3::origin());
//! assert!((tool_mm - Point3::new(0.0, 250.0, 300.0)).norm() < 1e-12);
//! # Ok::<(), truepose::kinematics::KinematicsError>(())
//! ```

pub(crate) mod chain;
mod closed_form;
#[doc(hidden)]
pub mod configuration;
pub(crate) mod description;
pub(crate) mod dh;
mod dh_row;
pub(crate) mod gravity;
#[doc(hidden)]
pub mod inverse;
pub(crate) mod jacobian;
mod joint_kind;
pub(crate) mod mjcf;
mod pose;
mod problems;
#[doc(hidden)]
pub mod quaternion;
#[doc(hidden)]
pub mod rigid_motion;
pub(crate) mod robot;
#[doc(hidden)]
pub mod screw;
mod tree;
pub(crate) mod urdf;
mod urdf_edit;
mod xml;
mod xml_budget;
mod xml_source;

#[cfg(test)]
pub(crate) mod testing;

pub use configuration::Statement;
pub use description::{DescribedRobot, DescriptionFormat, robot_from_file};
pub use dh::robot_from_dh;
pub use dh_row::{DhConvention, DhRow};
pub use inverse::{Goal, Inverse, REACHED_MM, REACHED_RAD};
pub use joint_kind::JointKind;
pub use mjcf::robot_from_mjcf;
pub use pose::Pose;
pub use robot::MOST_JOINTS;
pub use robot::{
    Axis, Follows, Joint, KinematicsError, LinkMass, Range, Robot, RobotSource, pose_from_parts,
};
pub use urdf::robot_from_urdf;
pub use urdf_edit::{UrdfChain, UrdfJoint, urdf_chain_of, urdf_with};
