//! The stages of a model that plots show beside each other.

use crate::fit::gap::Deviations;
use crate::model::Positions;
use crate::present::chart::ColourRole;

/// The deviations of all samples at one stage of the work.
#[derive(Debug, Clone)]
pub struct Stage {
    /// What the stage is called.
    pub name: String,
    /// What it stands for, which decides its colour.
    pub role: ColourRole,
    /// Measured − where it should be, mm; NaN where a sample cannot be used.
    pub deviations: Deviations,
}

/// A session's samples at several stages.
#[derive(Debug, Clone, Default)]
pub struct Stages {
    /// Where the nominal robot has the points, mm.
    pub nominal: Positions,
    /// The joint over whose value deviations are shown, as the axis is labelled.
    pub over: String,
    /// Whether its values are in degrees.
    pub in_degrees: bool,
    /// That joint's values, degrees or mm.
    pub values: Vec<f64>,
    /// Side from which it came; 0 where it is not known.
    pub side: Vec<f64>,
    /// The stages, first to last.
    pub stages: Vec<Stage>,
    /// Noise floor, mm.
    pub floor_mm: Option<f64>,
    /// Tolerance, mm.
    pub tolerance_mm: Option<f64>,
}

impl Stage {
    /// Samples that the stage can show.
    pub(super) fn usable(&self) -> Vec<usize> {
        let lengths = &self.deviations.length_mm;
        (0..lengths.len())
            .filter(|i| lengths[*i].is_finite())
            .collect()
    }
}

/// At most about `most` of some samples, evenly over their order, with the one of the largest value.
pub(super) fn thinned(samples: &[usize], most: usize, value: impl Fn(usize) -> f64) -> Vec<usize> {
    if samples.len() <= most {
        return samples.to_vec();
    }
    let mut kept: Vec<usize> = (0..most)
        .map(|k| samples[k * samples.len() / most])
        .collect();
    let largest = samples
        .iter()
        .copied()
        .max_by(|a, b| value(*a).total_cmp(&value(*b)));
    kept.extend(largest.filter(|i| !kept.contains(i)));
    kept
}
