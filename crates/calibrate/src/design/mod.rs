//! Poses to measure next: those that tell rival explanations apart (`next_poses`), those that
//! make an effect testable (`enabling_poses`), a first measurement of a joint
//! (`first_measurement`), those that show the geometry of an arm (`geometry`), and all of them
//! (`plan`).
//!
//! One planner makes them all: candidates, a criterion of what they are worth, and a loop that takes what is
//! worth most.
//!
//! | | |
//! | --- | --- |
//! | candidates: a place and its conditions | `candidates` (all combinations beside a session), `first_measurement` (slot by slot of a schedule), `arm` (over the joint ranges, in every way of measuring), `conditions` (the same under loads, temperatures, from other sides) |
//! | criterion | `exchange::Information`: what is known of parameters (D-optimality); `parting::Parting`: how far models are apart, one refitted to what the other predicts (T-optimality, Atkinson & Fedorov 1975; `comparison`), with the probability of a decision between them (`decision`) |
//! | loop | `exchange`: greedily, then exchanging |
//! | as poses | `candidates::Writing` |

#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "indices come from small non-negative numbers"
)]

pub(crate) mod enabling_poses;
pub(crate) mod expected_information;
#[doc(hidden)]
pub mod forecast;
#[doc(hidden)]
pub mod geometry;
#[doc(hidden)]
pub mod needs;
#[doc(hidden)]
pub mod next_poses;
#[doc(hidden)]
pub mod pair_separation;
#[doc(hidden)]
pub mod plan;

mod arm;
mod candidate;
mod candidate_poses;
mod candidate_set;
mod comparison;
#[doc(hidden)]
pub mod conditions;
mod covariance;
mod decision;
mod every_effect;
mod exchange;
mod field;
mod first_measurement;
mod imagined;
mod information;
mod line_of_sight;
mod making;
mod measuring_methods;
mod model_separation;
mod named;
mod path;
mod plan_options;
mod reflectors;
mod rows;

pub use expected_information::{Alike, ExpectedInformation};
pub use forecast::{ExpectedError, Forecast};
pub use geometry::Geometry;
pub use making::{plan_robot, plan_session};
pub use named::Named;
pub use needs::{Need, Untestable};
pub use pair_separation::Separation;
pub use plan::{Plan, Subject};
pub use plan_options::{PlanError, PlanOptions};
