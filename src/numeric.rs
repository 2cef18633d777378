//! What the standard library lacks for numbers.

use std::borrow::Borrow;

/// Smallest and largest of the finite values; of none +∞ and −∞.
pub(crate) fn extent<V: Borrow<f64>>(values: impl IntoIterator<Item = V>) -> [f64; 2] {
    let values = values.into_iter().map(|value| *value.borrow());
    let finite = values.filter(|value| value.is_finite());
    finite.fold([f64::INFINITY, f64::NEG_INFINITY], |[a, b], v| {
        [a.min(v), b.max(v)]
    })
}

/// A small number that is whole already, or zero where it is below.
#[allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "clamped to what a count of digits or of pieces can be"
)]
pub(crate) fn whole(value: f64) -> usize {
    value.clamp(0.0, 1e6) as usize
}

/// A number as it is drawn; one that does not fit is infinite, and is not.
#[allow(clippy::cast_possible_truncation, reason = "drawn in single precision")]
pub(crate) fn single(value: f64) -> f32 {
    value as f32
}
