//! The report's plots as drawings; the window saves the same ones as SVG.
//!
//! - [`workspace`](fn@workspace): where the points are and, magnified, how far off.
//! - [`deviation`](fn@deviation): the length of the deviation over a joint's value.
//! - [`waterfall`](fn@waterfall): the gap step by step.
//!
//! At most some thousand marks are drawn, whatever the number of samples; the largest deviation is
//! always among them.

mod deviation;
pub(crate) mod panel;
mod waterfall;
mod workspace;

pub use deviation::deviation;
pub use waterfall::waterfall;
pub use workspace::workspace;

use crate::fit::gap::Deviations;
use crate::model::Positions;

use super::drawing::Colour;

/// Width of a plot that fills a page of A4 between its margins, points.
pub const FULL_WIDTH: f64 = 487.0;

/// The deviations of all samples at one stage of the work.
#[derive(Debug, Clone)]
pub struct Stage {
    /// What the stage is called.
    pub name: String,
    /// Its colour.
    pub colour: Colour,
    /// Measured − where it should be, mm; NaN where a sample cannot be used.
    pub deviations: Deviations,
}

/// A session's samples at several stages.
#[derive(Debug, Clone)]
pub struct Stages {
    /// Where the nominal robot has the points, mm.
    pub nominal: Positions,
    /// The joint over whose value deviations are shown, as the axis is labelled.
    pub over: String,
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
    fn usable(&self) -> Vec<usize> {
        let lengths = &self.deviations.length_mm;
        (0..lengths.len())
            .filter(|i| lengths[*i].is_finite())
            .collect()
    }
}

/// At most about `most` of some samples, evenly over their order, with the one of the largest value.
fn thinned(samples: &[usize], most: usize, value: impl Fn(usize) -> f64) -> Vec<usize> {
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

/// A name that leaves room for the rest of a label.
pub(super) fn shortened(name: &str, most: usize) -> String {
    if name.chars().count() <= most {
        return name.to_owned();
    }
    name.chars().take(most - 1).chain(['…']).collect()
}

/// The largest of 1, 2, 5 × 10ⁿ that is not above `value`; 1 where that makes no sense.
fn round_below(value: f64) -> f64 {
    among(value, &[5.0, 2.0])
}

/// The largest of these leading digits, or 1, × 10ⁿ that is not above `value`.
fn among(value: f64, digits: &[f64]) -> f64 {
    if !(value.is_finite() && value > 0.0) {
        return 1.0;
    }
    let ten = 10f64.powf(value.log10().floor());
    let lead = value / ten;
    let digit = digits.iter().copied().find(|d| lead >= *d).unwrap_or(1.0);
    digit * ten
}
