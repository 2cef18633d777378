//! Whether the values of a joint are equal steps.

use crate::fewest;

/// Steps are equal where none differs by more than this share from their median.
pub const EQUAL: f64 = 0.02;

/// The step of values that are equal steps, in their unit.
pub fn step_of(values: &[f64]) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let span = sorted.last()? - sorted.first()?;
    let same = 1e-4 * span;
    let mut steps: Vec<f64> = sorted.windows(2).map(|w| w[1] - w[0]).collect();
    steps.retain(|step| *step > same);
    if steps.len() < fewest::NO_ACCIDENT {
        return None;
    }
    steps.sort_by(f64::total_cmp);
    let median = steps[steps.len() / 2];
    // A value that is left out makes a step of two.
    let off = |step: &f64| (step / median - (step / median).round()).abs();
    let equal = steps.iter().all(|s| off(s) < EQUAL && *s > 0.5 * median);
    // Values are rounded; their span is known best.
    equal.then(|| span / (span / median).round())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_left_out_makes_a_step_of_two_and_uneven_ones_have_none() {
        assert_eq!(step_of(&[0.0, 1.0, 2.0, 4.0, 5.0, 2.0]), Some(1.0));
        assert_eq!(step_of(&[0.0, 1.0, 2.3, 4.0, 5.1]), None);
        assert_eq!(step_of(&[1.0, 1.0]), None);
        assert_eq!(step_of(&[]), None);
    }
}
