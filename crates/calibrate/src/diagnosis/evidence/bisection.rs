//! Bisection: where a monotonic function crosses a limit.

use crate::budget;

/// The end of a range beyond which `is_below` no longer holds, by bisection down to the resolution of doubles.
pub(crate) fn bisected([mut low, mut high]: [f64; 2], is_below: impl Fn(f64) -> bool) -> f64 {
    for _ in 0..budget::STEPS {
        let middle = 0.5 * (low + high);
        if is_below(middle) {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}
