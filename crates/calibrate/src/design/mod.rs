//! Poses to measure next: those that distinguish rival explanations (`next_poses`), or two effects
//! (`pair_separation`), those that make an effect testable (`enabling_poses`), a first measurement of a joint
//! (`first_measurement`), those that determine the geometry of an arm (`geometry`), and all of them (`plan`,
//! `making`). All are made in one way:
//!
//! 1. **Candidates**: a place and the conditions there (`candidate`), in all combinations for a session
//!    (`candidate_poses`), slot by slot of a schedule (`first_measurement`), over the joint ranges in every way of
//!    measuring (`arm`), the same under loads, warmth and from other sides (`conditions`).
//! 2. **Rows** `J = ∂y/∂β / σ`, `d = (y′ − y)/σ` of every candidate (`rows`), of points or of what an imagined session
//!    would have measured (`imagined`); the covariance C of what is known already (`covariance`).
//! 3. **A criterion**: D-optimality `ln det(1 + J C Jᵀ)` (`information`), or T-optimality (Atkinson & Fedorov 1975),
//!    `Δ = min_β ‖d − J β‖² + βᵀ C⁻¹ β`, how far a refitted rival stays from each truth (`comparison`, all pairs at
//!    once in `model_separation`), until the right one is found often enough (`decision`).
//! 4. **A choice**: greedily, then exchanging (`exchange`; Fedorov 1972), for an arm again around what was chosen
//!    (`candidate_set`).
//! 5. **An order**: of arms a short way through the poses of a stretch (`path`).
//!
//! Then the expected information of the poses is computed: detection limits and names that look alike
//! (`expected_information`), of an arm the expected error and the observability index (`forecast`).

#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "indices come from small non-negative numbers"
)]

mod arm;
mod candidate;
mod candidate_poses;
mod candidate_set;
mod comparison;
mod conditions;
mod covariance;
mod decision;
mod enabling_poses;
mod every_effect;
mod exchange;
mod expected_information;
mod first_measurement;
mod forecast;
mod geometry;
mod imagined;
mod information;
mod line_of_sight;
mod making;
mod measuring_methods;
mod model_separation;
mod needs;
mod next_poses;
mod pair_separation;
mod path;
mod plan;
mod plan_options;
mod reflectors;
mod rows;

#[doc(hidden)]
pub use conditions::approach;
pub use expected_information::{Alike, ExpectedInformation};
pub use making::{plan_robot, plan_session};
pub use needs::{Need, Untestable};
#[doc(hidden)]
pub use next_poses::propose;
pub use plan::{ExpectedError, Forecast, Geometry, Plan, Separation, Subject};
pub use plan_options::PlanOptions;
