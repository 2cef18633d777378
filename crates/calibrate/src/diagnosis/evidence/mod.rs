//! The evidence of the samples: a model fitted to them, the gain of each candidate given it, how likely that is, how
//! often noise alone would look like it, and cross-validation. Nothing here chooses.
//!
//! - `regression`: the whitened rows and the table; `fit`, `fitting`, `refine`, `placement`: fits to them.
//! - `score`, `scores`, `scan`, `grams`, `projections`: the gain of each candidate given a fit.
//! - `likelihood`: how fits are compared; `significance`, `trials`, `largest_in_noise`,
//!   `familywise`: the distribution in noise alone.
//! - `held_out`, `left_out`, `rescanned`, `shares`: errors on samples that a fit, or a choice, has not seen.
//! - `rival`: an alternative explanation of the same samples.
//! - `memo`: what was computed before; `work`: how much may be computed.

mod bisection;
mod familywise;
mod fit;
mod fitting;
mod grams;
mod held_out;
mod largest_in_noise;
mod left_out;
mod likelihood;
pub(crate) mod memo;
mod placement;
mod projections;
mod refine;
mod regression;
mod rescanned;
pub(crate) mod rival;
mod scan;
mod score;
mod scores;
pub(crate) mod shares;
mod significance;
mod trials;
mod work;

pub(crate) use bisection::bisected;
pub(crate) use familywise::{FamilyP, SMALLEST};
pub(crate) use fit::Fit;
pub(crate) use grams::projected_units;
pub(crate) use held_out::Folds;
pub(crate) use likelihood::{EFFECT_PRIOR_PENALTY, is_beyond};
pub(crate) use projections::{Projections, ReducedFit};
pub(crate) use refine::NEIGHBOURS;
pub(crate) use regression::{KEPT, Regression};
pub(crate) use rescanned::{MOST_SETTINGS, chosen_again};
pub(crate) use score::{Score, by_odds, weight_of};
pub(crate) use significance::Significance;
pub(crate) use work::{FIRST_SEARCH, OTHER_SETS, RIVALS, SECOND_SEARCH, Work};
