//! The RMS error: one definition for every figure that is called so.
//!
//! ```text
//! RMS error = √( Σ |e_i|² / n ),   e = measured − predicted, mm, of three coordinates (two in a planar session)
//! ```
//!
//! It is of a position, over the samples that can be used. Which model predicts gives it its name:
//!
//! - *nominal*: the robot as its controller believes it to be, of a session with setups from where each
//!   fits best;
//! - *after identification*: the model of `identify`;
//! - *with found effects*: the model that a diagnosis hands out, never above the one before;
//! - *cross-validated* (*held-out*): each sample by a fit that has not seen it, by the same procedure.
//!
//! `verify` states it over all samples, and in addition *trimmed*, without those that are suspected outliers, with
//! their number. `identify` and `diagnose` fit without suspected outliers: there they count in the largest error and
//! not in the RMS error, and the answer states how many there are. Where more than a third would be set aside all
//! count: of samples held out these are the evidence.

use crate::observations::outliers::are_the_rule;

/// Root mean square of some lengths; `None` of none.
pub(crate) fn rms_error(lengths_mm: impl Iterator<Item = f64>) -> Option<f64> {
    let (sum, count) = lengths_mm.fold((0.0, 0_usize), |(sum, count), length| {
        (sum + length * length, count + 1)
    });
    (count > 0).then(|| (sum / count as f64).sqrt())
}

/// Root mean square and largest of some lengths; `None` where there is none.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Spread {
    /// Root mean square, without suspected outliers, mm.
    pub rms_mm: f64,
    /// Largest, suspected outliers included, mm.
    pub max_mm: f64,
}

impl Spread {
    /// Over the samples that `counts` picks; those that `outlier` picks count in the largest only, where they are few.
    pub fn of(
        lengths_mm: &[f64],
        counts: impl Fn(usize) -> bool,
        outlier: impl Fn(usize) -> bool,
    ) -> Option<Self> {
        let counted = || {
            let all = lengths_mm.iter().copied().enumerate();
            all.filter(|(i, length)| !length.is_nan() && counts(*i))
        };
        let max_mm = counted().map(|(_, length)| length).reduce(f64::max)?;
        let count = counted().count();
        let few = !are_the_rule(counted().filter(|(i, _)| outlier(*i)).count(), count);
        let kept = counted().filter(|(i, _)| !(few && outlier(*i)));
        let rms_mm = rms_error(kept.map(|(_, length)| length)).unwrap_or(max_mm);
        Some(Self { rms_mm, max_mm })
    }
}
