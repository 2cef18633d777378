//! From measured samples to a model: the paper's corrections by region ([`identify_regional`]),
//! and the exact nonlinear fit ([`identify_exact`]).

pub mod base_model;
pub mod expected;
pub mod gap;
pub(crate) mod gauge;
pub mod levels;
pub mod noise;
pub mod normal;
pub mod priors;
pub mod problem;
pub mod regression;
pub mod scan;
pub mod solver;
pub mod uncertainty;

mod adaptive;
mod estimator;
mod exact;
pub(crate) mod observed;
mod plane;
mod regional;
mod unidentifiable;

pub use crate::answers::identification::{
    Estimate, Gap, IMPLAUSIBLE, Identification, LeftOut, NotIdentifiable, Outlier, Quality,
    RegionResult, measured_ranges,
};
pub(crate) use base_model::free_frames;
pub use estimator::{fit_without_outliers, noise_beside};
pub(crate) use exact::outliers;
pub use exact::{
    DEFAULT_EFFECTS, covariance_of, identify_exact, identify_watched, parameters_of, report,
    testable_effects,
};
pub use plane::{RegionSums, sum_by_region};
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
    /// Whoever asked does not want the answer any more.
    #[error("the identification was cancelled")]
    Cancelled,
}
