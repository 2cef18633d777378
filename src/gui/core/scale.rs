//! How much of something a plot shows, and round numbers for its scales.

use crate::present::chart::{among, decade};
use crate::text::{Template, filled};

/// Up to here samples are few.
pub(crate) const FEW: usize = 1_000;

/// Arrows in one plot; beyond it they are thinned evenly, and the plot says so.
const MOST_ARROWS: usize = 10_000;
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
fn round(value: f64) -> f64 {
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

/// The part of the workspace's radius that a long deviation is drawn over.
const LONG: f64 = 0.32;

/// The median one is drawn so long, points …
const USUAL_POINTS: f64 = 25.0;
/// … in a large plot longer, so that it is no less than this part of the radius: it would be lost there.
const LEAST: f64 = 0.1;
/// The part of the radius over which the longer ones are drawn at most.
const LONGEST: f64 = 0.4;

/// The workspace is drawn over so many points where nothing is known of the plot: in a window of 1280 × 800.
pub(crate) const ROOM: f64 = 310.0;

/// What decides at which magnification deviations can be read.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Readable {
    radius_mm: f64,
    median_mm: f64,
    /// Nine of ten are shorter.
    long_mm: f64,
}

impl Readable {
    /// Of these deviations in a workspace of this radius.
    pub(crate) fn new(radius_mm: f64, lengths_mm: &[f64]) -> Self {
        let step = stride(lengths_mm.len(), MOST_ARROWS);
        let some = lengths_mm.iter().copied().step_by(step);
        let mut some: Vec<f64> = some.filter(|l| l.is_finite()).collect();
        // One sample that is far off must not shrink all others.
        let mut of_rank = |tenths: usize| {
            let place = some.len().checked_sub(1).map(|last| last * tenths / 10);
            place.map_or(0.0, |place| {
                *some.select_nth_unstable_by(place, f64::total_cmp).1
            })
        };
        Self {
            radius_mm,
            median_mm: of_rank(5),
            long_mm: of_rank(9),
        }
    }

    /// The magnification at which the median one is some 25 points long where the workspace is drawn over
    /// `room` points, and nine of ten stay within it.
    pub(crate) fn magnification(&self, room: f64) -> f64 {
        if self.long_mm < 1e-9 {
            return 1.0;
        }
        let part = f64::max(2.0 * USUAL_POINTS / room, LEAST);
        let usual = part / self.median_mm.max(1e-12);
        round(f64::min(usual, LONGEST / self.long_mm) * self.radius_mm)
    }
}

/// The deviation that is drawn long at this magnification, mm: the upper end of colour scales, so
/// that colour and length say the same.
pub(crate) fn long_mm(radius_mm: f64, magnification: f64) -> f64 {
    LONG * radius_mm / magnification
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

    #[test]
    fn vectors_are_magnified_by_a_round_number_that_shows_the_longer_ones() {
        let at = |lengths: &[f64], room| Readable::new(250.0, lengths).magnification(room);
        assert_eq!(at(&[13.8; 30], ROOM), 3.0);
        assert_eq!(at(&[0.05; 30], ROOM), 800.0);
        // A part of them that is long stays within the workspace.
        let mixed: Vec<f64> = (0..30)
            .map(|k| if k % 5 == 0 { 5.0 } else { 0.1 })
            .collect();
        assert_eq!(at(&mixed, ROOM), 20.0);
        let exact: Vec<f64> = (0..30)
            .map(|k| if k % 5 == 0 { 5.0 } else { 0.0 })
            .collect();
        assert_eq!(at(&exact, ROOM), 20.0);
        assert_eq!(at(&[f64::NAN, 0.0], ROOM), 1.0);
        assert_eq!(at(&[], ROOM), 1.0);
        // Half the room: twice as much, as far as the longer ones allow.
        assert_eq!(at(&[0.05; 30], 0.5 * ROOM), 1500.0);
        assert_eq!(at(&mixed, 0.5 * ROOM), 20.0);
        // In a large plot a tenth of the radius.
        assert_eq!(at(&[0.05; 30], 5.0 * ROOM), 500.0);
    }
}
