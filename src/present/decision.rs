//! Whether a robot is within its tolerance, in words.

use super::numbers::{mm, short};
use crate::compensation::decision::{Measured, Rule};

/// What a decision rests on.
pub fn rests_on(measured: &Measured, rule: Rule, tolerance_mm: f64) -> String {
    let of = if measured.predicted {
        "predicted with corrected commands"
    } else {
        "as measured with the table active"
    };
    format!(
        "largest deviation {} ({of}), expanded uncertainty U = {} (k = 2), tolerance {} mm; \
         decision rule: {}",
        mm(measured.largest_mm),
        mm(measured.expanded_mm),
        short(tolerance_mm),
        rule.title()
    )
}
