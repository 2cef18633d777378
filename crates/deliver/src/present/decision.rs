//! Whether a robot is within its tolerance, in words.

use super::numbers::{mm, short};
use super::units::{LengthUnit, Units};
use crate::compensation::decision::{MeasuredDeviation, Outcome, Rule};
use crate::text::Template;

/// What a rule says, in words.
pub fn title(outcome: Outcome) -> Template {
    match outcome {
        Outcome::Pass => phrase!("Pass"),
        Outcome::Fail => phrase!("Fail"),
        Outcome::Undecided => phrase!("Neither pass nor fail is proven"),
    }
}

/// That nothing is decided, and why.
pub fn none(because: &str) -> String {
    say!("No decision: {because}", because)
}

/// What a decision rests on, in the units of this thread; a tolerance in mm as it was stated.
pub fn rests_on(measured: &MeasuredDeviation, rule: Rule, tolerance_mm: f64) -> String {
    let of = if measured.predicted {
        say!("predicted with corrected commands")
    } else {
        say!("as measured with the correction table active")
    };
    let rule = match rule {
        Rule::Iso14253 => "ISO 14253-1",
        Rule::Simple => say!("simple acceptance (JCGM 106, 8.2)"),
    };
    let units = Units::spoken();
    let [largest, uncertainty, tolerance] = if units.length == LengthUnit::Millimetre {
        let tolerance = short(tolerance_mm) + " mm";
        [mm(measured.largest_mm), mm(measured.expanded_mm), tolerance]
    } else {
        [measured.largest_mm, measured.expanded_mm, tolerance_mm].map(|mm| units.length(mm))
    };
    say!(
        "largest deviation {largest} ({of}), expanded uncertainty U = {uncertainty} (k = 2), tolerance {tolerance}; decision rule: {rule}",
        largest,
        of,
        uncertainty,
        tolerance,
        rule
    )
}
