//! What people call effects and their parameters.

use super::limits::sight;
use super::numbers::significant;
use crate::diagnosis::{Limit, Sight};
use crate::effects::find;
use crate::effects::units::Unit;
use crate::fit::Estimate;

/// The title of an effect; what is no effect stays as it is.
pub(crate) fn title(id: &str) -> &str {
    find(id).map_or(id, |effect| effect.about().title.english())
}

/// The title with the joint, counted from 1, where the robot has several.
pub(crate) fn title_on(id: &str, joint: Option<usize>, joints: usize) -> String {
    match joint.filter(|_| joints > 1) {
        Some(joint) => format!("{}, joint {joint}", title(id)),
        None => title(id).to_owned(),
    }
}

/// The title of a name that may end with its joint, `id joint`.
pub(crate) fn title_of(name: &str) -> String {
    match name.split_once(' ') {
        Some((id, joint)) => format!("{}, joint {joint}", title(id)),
        None => title(name).to_owned(),
    }
}

/// A parameter in words, and its unit as it is written behind a number.
pub(crate) fn parameter(name: &str) -> (String, &'static str) {
    let (stem, unit) = Unit::of_name(name);
    let stem = if stem.is_empty() { "rate" } else { stem };
    (stem.replace('_', " "), unit.symbol)
}

/// A figure that is no parameter, in words; without a value where the samples do not show it.
pub(crate) fn figure((name, value): (&str, Option<f64>)) -> String {
    let (name, unit) = parameter(name);
    match value {
        Some(value) => format!("{name} {} {unit}", significant(value, 3)),
        None => format!("{name}: not determined by these samples"),
    }
}

/// What is said of a value that no machine has, with the usual size.
pub(crate) fn usual_size(one: &Estimate) -> &'static str {
    find(one.effect).map_or("", |effect| effect.about().usual_size.english())
}

/// From which size (95 %) an effect would have been seen, parameter by parameter.
pub(crate) fn detection_limit(limit: &Limit) -> String {
    let sizes = limit.sizes.iter().map(|(full, size)| {
        let (name, unit) = parameter(full);
        match sight(limit.effect, full, *size) {
            Sight::Above(size) => {
                format!("{name} {} {unit}", significant(size, 3)).replace(" °", "°")
            }
            Sight::AtAnySize => format!("{name}: any size, there is no noise"),
            Sight::AtNoSize => format!("{name}: not observable with these poses"),
        }
    });
    sizes.collect::<Vec<_>>().join(", ")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::effects::CATALOGUE;
    use crate::effects::term::parameter_names;

    #[test]
    fn units_come_from_names() {
        assert_eq!(parameter("amplitude_deg"), ("amplitude".to_owned(), "°"));
        assert_eq!(parameter("mm_per_kg"), ("rate".to_owned(), "mm/kg"));
        assert_eq!(parameter("x_mm_per_h"), ("x".to_owned(), "mm/h"));
        assert_eq!(parameter("about_x_mrad"), ("about x".to_owned(), "mrad"));
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
}
