//! The noise of a session before anything is fitted.

use crate::sessions::Sigma;

use super::problem::Problem;

/// Noise where none is stated, mm: that of a tracker.
pub(crate) const USUAL_NOISE_MM: f64 = 0.05;

/// Variance of a coordinate of weight one, where the instrument's maker states it.
pub(super) fn stated_variance(problem: &Problem) -> Option<f64> {
    if let Some(layer) = &problem.observed {
        return Some(layer.unit_mm * layer.unit_mm);
    }
    problem
        .session
        .instrument
        .sigma_mm
        .map(|sigma| match sigma {
            Sigma::Overall(sigma) => sigma * sigma,
            Sigma::PerAxis(_) => 1.0,
        })
}
