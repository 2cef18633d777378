//! The answer: values with intervals on all samples, each name with its evidence, whether the residuals are noise,
//! detection limits, and what predicts without a name. Nothing here changes which names were found.
//!
//! - `conclude`: the answer put together of `named` (the names on all samples), `open_questions`, the residuals, and
//!   `predicting` (the model with what has no name); `history`; `values`, `selection`: parameters and their intervals.
//! - `named_effects`, `step_time`: the names; `equal_steps`: orders that equal steps cannot distinguish.
//! - `judgement`, `excess`, `group_excess`, `remainder`, `unpredicted`, `withheld`: whether noise explains the
//!   residuals.
//! - `gross`: errors larger than any noise.
//! - `limits`, `testable`: detection limits, and what cannot be tested; `repeatability`: the repeatability of the
//!   robot.
//! - `handed_out`, `divergent_terms`, `unseen`: which model is handed out; `unnamed`: what predicts without a name.

mod conclude;
mod divergent_terms;
pub(crate) mod equal_steps;
mod excess;
mod gross;
mod group_excess;
mod handed_out;
mod history;
mod judgement;
pub(crate) mod limits;
mod named;
mod named_effects;
mod open_questions;
mod predicting;
mod remainder;
mod repeatability;
mod repeating;
mod selection;
mod step_time;
mod testable;
mod unnamed;
mod unpredicted;
mod unseen;
mod values;
mod withheld;

pub(crate) use conclude::answer;
pub(crate) use open_questions::{Planner, Proposal, Undecided};
pub(crate) use testable::not_testable;
