//! Small functions on numbers that the standard library lacks.

use std::borrow::Borrow;

/// The golden ratio's part of one: no fraction of small numbers is near it, so that its multiples have no rhythm.
pub const GOLDEN_RATIO: f64 = 0.618_033_988_749_894_9;
/// The same part of a turn, rad, the shorter way round: no two joints share its multiples, and no robot is built to be
/// singular at one.
pub const GOLDEN_ANGLE: f64 = std::f64::consts::TAU * (1.0 - GOLDEN_RATIO);
/// The longest step for which a linearisation at a pose is used, rad: there its second-order part reaches 5 % of it.
pub const LONGEST_TURN: f64 = 0.3;

/// Smallest and largest of the finite values; of none +∞ and −∞.
pub fn extent<V: Borrow<f64>>(values: impl IntoIterator<Item = V>) -> [f64; 2] {
    let values = values.into_iter().map(|value| *value.borrow());
    let finite = values.filter(|value| value.is_finite());
    finite.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| {
        [a.min(v), b.max(v)]
    })
}

/// The median of the finite values, of an even number of them the upper one; of nothing `None`.
pub fn median(values: impl IntoIterator<Item = f64>) -> Option<f64> {
    let mut all: Vec<f64> = values.into_iter().filter(|v| v.is_finite()).collect();
    if all.is_empty() {
        return None;
    }
    let middle = all.len() / 2;
    Some(*all.select_nth_unstable_by(middle, f64::total_cmp).1)
}

/// The stretch with the largest sum (Kadane's algorithm), as its first place and the one behind its last.
pub fn likeliest_stretch(gains: impl IntoIterator<Item = f64>) -> (usize, usize) {
    let (mut best, mut here) = ((0.0, 0, 0), (0.0, 0));
    for (k, gain) in gains.into_iter().enumerate() {
        if here.0 <= 0.0 {
            here = (0.0, k);
        }
        here.0 += gain;
        if here.0 > best.0 {
            best = (here.0, here.1, k + 1);
        }
    }
    (best.1, best.2)
}

/// A small number that is whole already, or zero where it is below.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to what a count of digits or of pieces can be"
)]
pub fn whole(value: f64) -> usize {
    value.clamp(0.0, 1e6) as usize
}

/// A number as it is drawn; one that does not fit is infinite, and is not.
#[allow(clippy::cast_possible_truncation, reason = "drawn in single precision")]
pub fn single(value: f64) -> f32 {
    value as f32
}

/// Lengths in ascending order: how many are within any tolerance takes no counting.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Ascending {
    ascending_mm: Vec<f64>,
}

impl Ascending {
    /// These lengths, mm, without those that are not known.
    pub fn new(lengths_mm: &[f64]) -> Self {
        let known = lengths_mm.iter().copied().filter(|l| l.is_finite());
        let mut ascending_mm: Vec<f64> = known.collect();
        ascending_mm.sort_unstable_by(f64::total_cmp);
        Self { ascending_mm }
    }

    /// How many are within this tolerance, of how many.
    pub fn within(&self, tolerance_mm: f64) -> (usize, usize) {
        let inside = self.ascending_mm.partition_point(|l| *l <= tolerance_mm);
        (inside, self.ascending_mm.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_likeliest_stretch_is_that_with_the_largest_sum() {
        let of = |gains: &[f64]| likeliest_stretch(gains.iter().copied());
        assert_eq!(of(&[-1.0, 2.0, -1.0, 3.0, -5.0, 3.0]), (1, 4));
        assert_eq!(of(&[1.0, 1.0]), (0, 2));
        assert_eq!(of(&[-1.0, -2.0]), (0, 0));
        assert_eq!(of(&[]), (0, 0));
    }

    #[test]
    fn how_many_are_within_a_tolerance_is_what_counting_says() {
        let lengths_mm = [0.3, 0.1, f64::NAN, 0.2, 0.2, 5.0];
        let lengths = Ascending::new(&lengths_mm);
        for tolerance in [0.05, 0.1, 0.2, 0.25, 10.0] {
            let inside = lengths_mm.iter().filter(|l| **l <= tolerance).count();
            assert_eq!(lengths.within(tolerance), (inside, 5));
        }
    }
}
