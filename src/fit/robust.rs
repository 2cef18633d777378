//! Suspected outliers: samples whose deviation is far outside what the others show.
//!
//! The scale is the median length of the deviations, which half the samples would have to be
//! wrong to move. For Gaussian noise on three axes the length has a median of 1.54 σ, and the
//! limit of five medians lies near 7.7 σ: clean noise does not reach it, heavy tails seldom.

use super::gap::Deviations;
use super::problem::Problem;

/// How many medians a deviation may be long.
const LIMIT: f64 = 5.0;
/// With fewer samples the median says little, and nothing is suspected.
const FEWEST_SAMPLES: usize = 8;
/// Deviations below this are rounding, not outliers, mm.
const ROUNDING_MM: f64 = 1e-6;

/// Marks the samples that are suspected; only samples that can be used are.
pub fn suspects(problem: &Problem, deviations: &Deviations) -> Vec<bool> {
    let lengths = &deviations.length_mm;
    let mut sorted: Vec<f64> = (0..lengths.len())
        .filter(|i| problem.fit[*i])
        .map(|i| lengths[i])
        .collect();
    if sorted.len() < FEWEST_SAMPLES {
        return vec![false; lengths.len()];
    }
    let middle = sorted.len() / 2;
    let (_, median, _) = sorted.select_nth_unstable_by(middle, f64::total_cmp);
    let limit = (LIMIT * *median).max(ROUNDING_MM);
    lengths.iter().map(|length| *length > limit).collect()
}
