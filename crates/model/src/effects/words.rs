//! The words for the names of parameters of effects in files.

use super::units::Unit;
use crate::text::{Template, Text};

/// The words that names of parameters are made of, without their units.
const WORDS: &[Template] = &[
    phrase!("about x"),
    phrase!("about y"),
    phrase!("about z"),
    phrase!("amplitude"),
    phrase!("axial"),
    phrase!("compliance"),
    phrase!("delay"),
    phrase!("delta"),
    phrase!("fade"),
    phrase!("from joint"),
    phrase!("lead"),
    phrase!("offset"),
    phrase!("order"),
    phrase!("phase"),
    phrase!("radial"),
    phrase!("rate"),
    phrase!("ratio"),
    phrase!("scale"),
    phrase!("time"),
    phrase!("width"),
];

/// A parameter in words, and its unit as it is written behind a number.
pub fn parameter(name: &str) -> (Text, &'static str) {
    let (stem, unit) = Unit::of_name(name);
    let stem = if stem.is_empty() { "rate" } else { stem };
    let english = stem.replace('_', " ");
    let known = WORDS.iter().find(|word| word.english() == english);
    let words = known.map_or_else(|| Text::verbatim(english), Text::from);
    (words, unit.symbol)
}
