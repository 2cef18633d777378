//! Poses to measure next: those that tell rival explanations apart ([`next_poses`]), those that
//! make an effect testable ([`enabling_poses`]), a first measurement of a robot
//! (`first_measurement`), and all of them as a measuring list ([`plan`]).
//!
//! A pose is worth what it adds to the separation of two models, one refitted to what the other
//! predicts (`comparison`; T-optimality, Atkinson & Fedorov 1975).

#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "indices come from small non-negative numbers"
)]

pub mod measuring_list;
pub mod needs;
pub mod next_poses;
pub mod plan;

mod candidate_poses;
mod comparison;
mod decision;
pub mod enabling_poses;
pub mod expected_information;
mod first_measurement;
mod information;
pub mod pair_separation;

pub use measuring_list::measuring_list;
