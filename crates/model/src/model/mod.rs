//! The model of a real robot: its nominal kinematics and the effects that it has beyond them.
//!
//! ```text
//! p(q, conditions) = World ∘ Bearing ∘ exp([ξ1] θ1) ∘ Link ∘ … ∘ exp([ξn] θn) ∘ Tool (target),
//! θ = Joint(q, conditions)
//! ```
//!
//! [`Model::visit`] sends the samples through in blocks, with the derivatives of every
//! coefficient where they are asked for. Prediction, simulation, identification and compensation
//! all go through it, so they cannot disagree.

mod calibration;
#[doc(hidden)]
pub mod format_v1;
mod forward_map;
#[doc(hidden)]
pub mod names;
#[doc(hidden)]
pub mod rigid_motion;
mod set_up;
#[doc(hidden)]
pub mod shapes;

pub use calibration::{Calibration, Conditions, RegionalCorrection, ResidualStep};
pub use format_v1::{is_model, load_model, model_hash, read_model};
pub use forward_map::{Model, Positions};
pub use set_up::{RawJoint, SetUp};
pub use shapes::{Direction, Profile, Shape, Variable, Where};
