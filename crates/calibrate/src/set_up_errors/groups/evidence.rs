//! The evidence that a group of samples is elsewhere.

use crate::set_up_errors::thresholds::EVIDENCE;
use crate::text::Text;
use crate::text::length;

/// The largest share of the error that may remain where a place is elsewhere.
pub(super) const RESIDUAL_SHARE: f64 = 0.6;

/// Of more places than these the trials, each a fit of all of them, would take longer than the answer.
pub(super) const MOST_PLACES: usize = 64;

/// The log odds of so many samples whose residuals fall, with more parameters.
pub(in crate::set_up_errors) fn evidence(
    samples: usize,
    axes: usize,
    before_mm: f64,
    after_mm: f64,
    numbers: usize,
) -> f64 {
    let rows = (samples * axes) as f64;
    let gain = rows * (before_mm / after_mm.max(1e-9)).max(1e-9).ln();
    gain - 0.5 * numbers as f64 * rows.max(2.0).ln()
}

/// Whether that is enough to be reported, where no more than this share of the error may remain.
pub(super) fn is_believed(evidence: f64, before_mm: f64, after_mm: f64, share: f64) -> bool {
    evidence > EVIDENCE && after_mm < share * before_mm
}

pub(super) fn in_numbers(before_mm: f64, after_mm: f64) -> Text {
    text!(
        "the base model leaves {before} as it stands and {after} with the place free; more than 1000 times likelier",
        before = length(before_mm, 3),
        after = length(after_mm, 3)
    )
}
