//! Poses to measure next: those that tell rival explanations apart ([`next_poses`]), those that
//! make an effect testable ([`enabling_poses`]), a first measurement of a joint
//! (`first_measurement`), those that show the geometry of an arm ([`geometry`]), and all of them as a
//! measuring list ([`plan`]).
//!
//! All of them are candidates and a criterion, and one planner takes what is worth most
//! (`exchange`): a pose is worth what it adds to the separation of two models, one refitted to what the
//! other predicts (`comparison`; T-optimality, Atkinson & Fedorov 1975), or to the information about
//! parameters (D-optimality).

#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "indices come from small non-negative numbers"
)]

pub mod enabling_poses;
pub mod expected_information;
pub mod geometry;
pub mod measuring_list;
pub mod needs;
pub mod next_poses;
pub mod outlook;
pub mod pair_separation;
pub mod plan;

mod arm;
mod bench;
mod candidate_poses;
mod comparison;
mod conditions;
mod decision;
mod exchange;
mod first_measurement;
mod imagined;
mod information;
mod making;
mod path;
mod sight;

pub use measuring_list::{measuring_list, measuring_program};
