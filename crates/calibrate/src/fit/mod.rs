//! The fit of a model to measured samples: the paper's corrections by region ([`identify_regional`]),
//! and the exact nonlinear fit ([`identify_exact`]).

#[doc(hidden)]
pub mod base_model;
#[doc(hidden)]
pub mod expected;
#[doc(hidden)]
pub mod gap;
pub(crate) mod gauge;
#[doc(hidden)]
pub mod levels;
pub(crate) mod levers;
#[doc(hidden)]
pub mod noise;
pub(crate) mod normal;
pub(crate) mod priors;
#[doc(hidden)]
pub mod problem;
#[doc(hidden)]
pub mod ranges;
pub(crate) mod regression;
pub(crate) mod scan;
#[doc(hidden)]
pub mod solver;
mod specification;
pub(crate) mod spectrum;
#[doc(hidden)]
pub mod uncertainty;
#[doc(hidden)]
pub mod unseen;

mod adaptive;
mod answer;
mod error;
mod estimator;
mod exact;
#[cfg(test)]
pub(crate) mod example;
mod frames;
pub(crate) mod observed;
#[doc(hidden)]
pub mod plane;
mod prior_rows;
mod prior_scale;
mod regional;
pub(crate) mod spread;
pub(crate) mod target_places;
mod unidentifiable;
mod unrepeated;
pub(crate) mod usual_noise;

pub use crate::answers::errors::{Errors, Expected, Level, Spread, UnusableReason};
pub use crate::answers::identification::{
    Estimate, Gap, Identification, LeftOut, NotIdentifiable, Outlier, Quality, RegionResult,
    measured_ranges,
};
pub use crate::answers::noise::{Noise, Slow, StatedNoise};
pub use adaptive::regions_of;
pub(crate) use answer::{covariance_of, outliers, parameters_of, report};
pub use error::IdentifyError;
pub(crate) use estimator::noise_given;
pub use exact::{DEFAULT_EFFECTS, identify_exact, identify_watched};
pub use regional::identify_regional;
