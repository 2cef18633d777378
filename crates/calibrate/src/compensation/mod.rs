//! Compensation: from a model to the commands that make the real robot go where the nominal one would.
//!
//! For a pose q the joints are commanded q + c instead, with c such that
//!
//! ```text
//! Σ over reflectors | model(q + c) − nominal(q) |²  → least
//! ```
//!
//! The residual is what no joint can remove: a link that is too short stays too short however the joint turns. It is
//! stated as a number, and in words (`remainder`).
//!
//! - `conditions`: under which a correction holds; the reference is standstill, 20 °C, no load.
//! - `inverse`: the minimisation above, for any model and any number of joints.
//! - `pose`: the same for the whole pose of the tool, position first.
//! - `regional`: the source paper's `q_c = q + M Δρ`, equation (8), and the joint command that
//!   comes closest to it.
//! - `plan`: [`Compensation`], one interface for both kinds of model.
//! - `table`: the correction of one joint over its limits; `interpolation`: reading it fast.
//! - `remainder`: the residual, and which data of the controller would remove it.
//! - `verification`: the errors on another session; `with_table`: the residual with a table; `decision`:
//!   whether that is within the tolerance.
//!
//! Signs: a correction is what to add to the command, minus the deviation to first order.
//!
//! The instrument's effects (its scale, a frame that drifts or was bumped) are no error of the robot; they are left
//! out of the model before the model is inverted.

mod as_read;
mod carried_over;
#[doc(hidden)]
pub mod conditions;
mod conventions;
pub mod decision;
mod gross;
mod hand_out;
#[doc(hidden)]
pub mod interpolation;
#[doc(hidden)]
pub mod inverse;
mod observed;
#[doc(hidden)]
pub mod plan;
#[doc(hidden)]
pub mod pose;
pub(crate) mod regional;
#[doc(hidden)]
pub mod remainder;
mod set_aside;
pub(crate) mod table;
mod table_error;
#[doc(hidden)]
pub mod verification;
pub(crate) mod verify;
#[doc(hidden)]
pub mod with_table;

pub use conditions::{Conditions, Side};
pub use hand_out::{NotHandedOut, VerifiedCalibration};
pub use interpolation::SortedTable;
pub use plan::Compensation;
pub use regional::Regional;
pub use remainder::{Remainder, Share};
pub use table::JointTable;
pub use table_error::TableError;
pub use verification::{
    Compensated, HeldOutErrors, Trimmed, Verification, VerifyError, WithinTolerance,
};
pub use verify::verify;
