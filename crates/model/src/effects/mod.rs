//! The physical effects that make a real robot differ from the robot that its controller
//! believes in: one file each, each an [`Effect`], listed in [`CATALOGUE`].
//!
//! # To add an effect
//! Write one file like its neighbours and add it to the list at [`CATALOGUE`]. Simulation,
//! identification, diagnosis, design, the terminal and the window find it there, with everything
//! that they ask of it ([`About`]); none of them decides by an effect's name.
//!
//! # How effects fit together
//! A [`Block`] of samples flows through the [`Stage`]s: joint effects change the
//! joints' output angles in the order of the catalogue, then the reflector moves from the tool
//! outwards through the joints to the base, and at last from the base to the measuring frame.
//! The equations are those of the contract, exact; the derivatives are exact as well.
//!
//! Signs: a value describes the real robot. A link that is 5 mm short has −5 mm.

pub(crate) mod about;
#[doc(hidden)]
pub mod block;
#[doc(hidden)]
pub mod curve;
#[doc(hidden)]
pub mod inputs;
pub(crate) mod needs;
#[doc(hidden)]
pub mod places;
#[doc(hidden)]
pub mod survey;
#[doc(hidden)]
pub mod term;
#[doc(hidden)]
pub mod units;
#[doc(hidden)]
pub mod words;

mod axis_tilt;
mod axis_wobble;
mod backlash;
pub(crate) mod base_offset;
mod bearing_runout;
mod catalogue;
mod encoder_eccentricity;
mod encoder_two_cycle;
mod foundation_compliance;
mod frame_drift;
mod frame_shift;
mod from_parameters;
mod gear_transmission_error;
mod gravity;
mod instrument_scale;
mod joint_compliance;
mod joint_frame;
mod joint_scale;
mod joint_zero_offset;
mod link_droop;
mod link_geometry;
mod link_length;
mod lost_motion;
pub(crate) mod measuring_frame;
#[doc(hidden)]
pub mod place;
mod place_effects;
mod placed;
#[doc(hidden)]
pub mod rest;
pub(crate) mod rotation;
mod screw_pitch;
mod step;
mod thermal_growth;
mod thermal_zero_drift;
mod tool_lateral_offset;
mod tool_orientation;
mod tool_position;
mod torque;
mod tracking_lag;
mod unexplained;
mod unknown_anchor;
mod unknown_plane;
mod unknown_socket;
mod unknown_station;
#[doc(hidden)]
pub mod unnamed;
mod wrist_coupling;

pub use about::{
    About, Condition, Form, Listed, OnSlide, Over, Owner, Prior, Quantity, Role, Setting, Stage,
};
pub use block::{Block, Lane, Turned};
pub use catalogue::{
    BESIDE_THE_CATALOGUE, CATALOGUE, OF_A_FIRST_SIMULATION, OF_A_SINGLE_AXIS, called, find,
    form_in, form_with, joint_scale, joint_zero, rank, role, tool_radius,
};
pub use curve::{Curve, CurveError, Knots};
pub use from_parameters::TermError;
pub use gear_transmission_error::{stated, stated_orders};
pub use inputs::{Inputs, JointValues};
pub use joint_frame::JointFrame;
pub use link_geometry::LINK_GEOMETRY;
pub use measuring_frame::MEASURING_FRAME;
pub use needs::{AvailableColumns, Need};
pub use place::{Place, PlaceKind};
pub use placed::Placed;
pub use rest::{Along, Rest, RestError, Wave};
pub use survey::{JointSurvey, Survey};
pub use term::{Effect, Figure, FixedMask, Parameter, Term};
pub use tool_orientation::TOOL_ORIENTATION;
pub use tool_position::TOOL_POSITION;
pub use unexplained::{EACH_DIRECTION, SMOOTH, UNEXPLAINED};
pub use units::Unit;
pub use unknown_anchor::UNKNOWN_ANCHOR;
pub use unknown_plane::UNKNOWN_PLANE;
pub use unknown_socket::UNKNOWN_SOCKET;
pub use unknown_station::UNKNOWN_STATION;
pub use unnamed::{REST, UNNAMED};
