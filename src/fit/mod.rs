//! From measured samples to a model: the paper's corrections by region ([`identify_regional`]),
//! and the exact nonlinear fit ([`identify_exact`]).

pub(crate) mod base_model;
pub(crate) mod expected;
pub(crate) mod gap;
pub(crate) mod gauge;
pub(crate) mod levels;
pub(crate) mod noise;
pub(crate) mod normal;
pub(crate) mod priors;
pub(crate) mod problem;
pub(crate) mod regression;
pub(crate) mod scan;
pub(crate) mod solver;
pub(crate) mod uncertainty;

mod adaptive;
mod estimator;
mod exact;
#[cfg(test)]
mod example;
pub(crate) mod observed;
pub(crate) mod plane;
mod regional;
mod unidentifiable;

pub use crate::answers::errors::{Errors, Expected, Level, Spread, Unusable};
pub use crate::answers::identification::{
    Estimate, Gap, Identification, LeftOut, NotIdentifiable, Outlier, Quality, RegionResult,
    measured_ranges,
};
pub use crate::answers::noise::{Noise, Slow, StatedNoise};
pub(crate) use base_model::free_frames;
pub(crate) use estimator::{fit_without_outliers, noise_beside};
pub use exact::{DEFAULT_EFFECTS, identify_exact, identify_watched};
pub(crate) use exact::{covariance_of, outliers, parameters_of, report};
pub use regional::identify_regional;

/// Why an identification could not be made.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum IdentifyError {
    /// No effect of this name.
    #[error("no effect is called '{0}'; `truepose effects` lists them")]
    UnknownEffect(String),
    /// Every sample is held out or cannot be used.
    #[error(
        "no sample can be fitted: every one is held out, or lacks a joint value or a coordinate"
    )]
    NothingToFit,
    /// The paper's method is for one revolute joint.
    #[error("regional identification is for a single revolute joint; {0}")]
    NotASingleRevoluteJoint(String),
    /// The regions make no sense.
    #[error("{0}")]
    Regions(#[from] crate::sessions::division::RegionError),
    /// The session is no whole one: columns of different lengths, more joints than a robot has.
    #[error(transparent)]
    Rejected(#[from] crate::diagnostic::Rejected),
    /// Whoever asked does not want the answer any more.
    #[error("the identification was cancelled")]
    Cancelled,
}
