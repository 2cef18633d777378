//! What people call effects and their parameters, in the language of this thread.

use super::numbers::significant;
use crate::effects::find;
use crate::effects::units::Unit;
use crate::fit::Estimate;
use crate::text::{Template, current, known_in, spoken};

/// The title of an effect; what is no effect stays as it is.
pub fn title(id: &str) -> &str {
    find(id).map_or(id, |effect| spoken(effect.about().title))
}

/// The title with the joint, counted from 1, where the robot has several.
pub fn title_on(id: &str, joint: Option<usize>, joints: usize) -> String {
    match joint.filter(|_| joints > 1) {
        Some(joint) => on_joint(id, &joint.to_string()),
        None => title(id).to_owned(),
    }
}

/// The title of a name that may end with its joint, `id joint`.
pub fn title_of(name: &str) -> String {
    match name.split_once(' ') {
        Some((id, joint)) => on_joint(id, joint),
        None => title(name).to_owned(),
    }
}

/// The title of an effect on a joint, counted from 1.
pub(crate) fn on_joint(id: &str, joint: &str) -> String {
    say!("{effect}, joint {joint}", effect = title(id), joint)
}

/// A parameter in words, and its unit as it is written behind a number.
pub fn parameter(name: &str) -> (String, &'static str) {
    let (words, unit) = parameter_in_english(name);
    (word(&words), unit)
}

/// The same in English, as what other programs read has it.
pub fn parameter_in_english(name: &str) -> (String, &'static str) {
    let (stem, unit) = Unit::of_name(name);
    let stem = if stem.is_empty() { "rate" } else { stem };
    (stem.replace('_', " "), unit.symbol)
}

/// Words that files and commands have and people read: of verdicts, kinds of robots and of places, reasons, steps of
/// a model's history.
const WORDS: &[Template] = &[
    phrase!("ambiguous"),
    phrase!("anchor"),
    phrase!("changed"),
    phrase!("explained"),
    phrase!("external"),
    phrase!("frame"),
    phrase!("geometry: frame, zero offsets, links and tool"),
    phrase!("noise"),
    phrase!("nominal robot"),
    phrase!("partly-explained"),
    phrase!("plane"),
    phrase!("relative"),
    phrase!("SCARA"),
    phrase!("singular"),
    phrase!("socket"),
    phrase!("station"),
    phrase!("unexplained"),
    phrase!("unreachable"),
    phrase!("unused"),
    phrase!("what predicts without a name"),
    phrase!("zero offset and link length"),
];

/// A word of a name in files (of a parameter, of a kind of measurement) in the language of this thread; what no
/// catalogue has stays as it is.
pub fn word(english: &str) -> String {
    match WORDS.iter().find(|word| word.english() == english) {
        Some(word) => spoken(*word).to_owned(),
        None => known_in(current(), "", english, &[]).unwrap_or_else(|| english.to_owned()),
    }
}

/// A figure that is no parameter, in words; without a value where the samples do not show it.
pub(crate) fn figure((name, value): (&str, Option<f64>)) -> String {
    let (name, unit) = parameter(name);
    match value {
        Some(value) => format!("{name} {} {unit}", significant(value, 3)),
        None => say!("{name}: not determined by these samples", name),
    }
}

/// What is said of a value that no machine has, with the usual size.
pub fn usual_size(one: &Estimate) -> &'static str {
    find(one.effect).map_or("", |effect| spoken(effect.about().usual_size))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::CATALOGUE;
    use crate::effects::term::parameter_names;
    use crate::text::{Language, choose};
    use crate::units::LengthUnit;

    #[test]
    fn units_come_from_names() {
        assert_eq!(parameter("amplitude_deg"), ("amplitude".to_owned(), "°"));
        assert_eq!(parameter("mm_per_kg"), ("rate".to_owned(), "mm/kg"));
        assert_eq!(parameter("x_mm_per_h"), ("x".to_owned(), "mm/h"));
        assert_eq!(parameter("about_x_mrad"), ("about x".to_owned(), "mrad"));
    }

    #[test]
    fn every_length_of_the_catalogue_has_its_unit_in_inches() {
        for effect in CATALOGUE {
            for name in parameter_names(effect) {
                let (_, unit) = parameter(name);
                let of_a_length = unit.starts_with("mm");
                let named = LengthUnit::Inch.name_of_rate(unit);
                assert_eq!(named.is_some(), of_a_length, "{name}: {unit}");
                if let Some(named) = named {
                    assert_eq!(named, unit.replacen("mm", "in", 1));
                }
            }
        }
    }

    #[test]
    fn every_parameter_of_the_catalogue_has_a_name_and_a_unit() {
        for effect in CATALOGUE {
            for name in parameter_names(effect) {
                let (words, unit) = parameter(name);
                assert!(!words.is_empty() && !words.contains('_'), "{name}: {words}");
                let pure = ["order", "ratio", "from_joint"].contains(&name);
                assert_eq!(unit.is_empty(), pure, "{name}: {unit}");
            }
        }
    }

    #[test]
    fn the_parameters_of_every_effect_are_known_to_the_catalogues() {
        choose(Language::Marked);
        for effect in CATALOGUE {
            for name in parameter_names(effect) {
                let (words, _) = parameter(name);
                let is_known = words.starts_with('⟦') || words.chars().count() == 1;
                assert!(is_known, "{}: {words}", effect.about().id);
            }
        }
        choose(Language::English);
    }
}
