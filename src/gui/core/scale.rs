//! How much of something a plot shows, and round numbers for its scales.

use crate::present::chart::{among, decade};
use crate::text::{Template, filled};

/// Up to here samples are few.
pub(crate) const FEW: usize = 1_000;

/// Arrows in one plot; beyond it they are thinned evenly, and the plot says so.
pub(crate) const MOST_ARROWS: usize = 10_000;
/// Points in one plot.
pub(crate) const MOST_POINTS: usize = 100_000;

/// Every how many of `count` things one is shown, so that there are at most `most`.
pub(crate) fn stride(count: usize, most: usize) -> usize {
    count.div_ceil(most).max(1)
}

/// What a plot says when it shows one thing in so many: a sentence with the argument `stride`.
pub(crate) fn thinned(stride: usize, says: Template) -> Option<String> {
    (stride > 1).then(|| filled(says, &[("stride", &stride)]))
}

/// The nearest of 1, 1.2, 1.5, 2, 2.5, 3, 4, 5, 6, 8 × 10ⁿ, by ratio; for what is a factor and no scale.
pub(crate) fn round(value: f64) -> f64 {
    const LEADS: [f64; 11] = [1.0, 1.2, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];
    if !(value.is_finite() && value > 0.0) {
        return 1.0;
    }
    let decade = decade(value);
    let off = |lead: f64| (value / decade / lead).ln().abs();
    let nearest = LEADS.into_iter().min_by(|a, b| off(*a).total_cmp(&off(*b)));
    nearest.unwrap_or(1.0) * decade
}

/// The largest of 1, 2, 5 × 10ⁿ that is not above `value`.
pub(crate) fn round_down(value: f64) -> f64 {
    among(value, &[5.0, 2.0])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_plot_shows_more_than_it_can_draw() {
        for count in [0, 1, 9_999, 10_000, 10_001, 1_000_000] {
            let stride = stride(count, MOST_ARROWS);
            assert!(count.div_ceil(stride) <= MOST_ARROWS);
        }
    }

    #[test]
    fn a_thinned_plot_says_so() {
        let one = phrase!("one point in {stride} shown"; stride);
        assert_eq!(thinned(1, one), None);
        let says = |n| thinned(n, one).expect("thinned");
        assert_eq!(says(100), "one point in 100 shown");
    }

    #[test]
    fn scales_are_round_numbers() {
        assert_eq!(round_down(2.3), 2.0);
        assert_eq!(round_down(0.7), 0.5);
        assert_eq!(round_down(1000.0), 1000.0);
        assert_eq!(round_down(f64::NAN), 1.0);
    }
}
