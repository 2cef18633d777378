//! What the user is told: values with intervals on all samples, each name with its evidence, whether what is left is
//! noise, what could not have been seen, and what predicts without a name. Nothing here changes which names were found.
//!
//! - `conclude`: the answer put together of `named` (the names on all samples), `open_questions`, what is left, and
//!   `predicting` (the model with what has no name); `history`; `values`, `selection`: parameters and their intervals.
//! - `named_effects`, `step_time`: the names; `equal_steps`: orders that equal steps cannot part.
//! - `judgement`, `excess`, `group_excess`, `remainder`, `unpredicted`, `withheld`: what is left, and whether noise explains it.
//! - `gross`: what no noise is so large as.
//! - `limits`, `testable`: what would have been seen, and what cannot be; `repeatability`: what the robot does not repeat.
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
