//! Headings that name a joint as the robot's description does: `shoulder_pan_joint`.
//!
//! The name alone, with or without a unit, is certain. Among other words of a joint (`actual
//! shoulder_pan_joint position`) it is a guess, as any heading of another program. A joint that is
//! called like something that is measured (`x`) is not recognised by its name.

use crate::importers::headings;
use crate::importers::headings::{COMMANDED, READ_BACK, is_among, words_and_unit};
use crate::importers::role::Role;
use crate::importers::units::Word;
use crate::sessions::columns::{Heading, Quantity, Unit};

/// Names of joints and whether they slide, from base to tool.
type Joints = [(String, bool)];

/// What a heading says, to someone who knows the robot's joints.
pub(crate) fn understand(heading: &str, joints: &Joints) -> Role {
    let plain = heading.trim().trim_matches('"').to_lowercase();
    let own = matches!(Heading::read(&plain), Heading::Known(..));
    let found = if own { None } else { named(&plain, joints) };
    found.map_or_else(|| headings::understand(heading), |(role, _)| role)
}

/// Whether a heading is the name of a joint, with or without its unit.
pub(crate) fn is_one(heading: &str, joints: &Joints) -> bool {
    let plain = heading.trim().trim_matches('"').to_lowercase();
    named(&plain, joints).is_some_and(|(_, certain)| certain)
}

/// The joint that a heading names, and whether it says nothing else.
fn named(plain: &str, joints: &Joints) -> Option<(Role, bool)> {
    let (words, unit) = words_and_unit(plain);
    let unit = match unit {
        None => None,
        Some(Word::Unit(unit)) => Some(unit),
        Some(_) => return None,
    };
    let mut best: Option<(usize, Role, bool)> = None;
    for (joint, (name, slides)) in joints.iter().enumerate() {
        let (own, suffix) = words_and_unit(&name.to_lowercase());
        // A name may end in what reads as a unit.
        let (own, words, unit) = match suffix {
            Some(_) => (split(&name.to_lowercase()), split(plain), None),
            None => (own, words.clone(), unit),
        };
        let is_other = matches!(headings::understand(name), Role::Known(quantity, _) if !is_of_a_joint(quantity))
            || matches!(headings::understand(name), Role::Time(_) | Role::Point);
        if own.is_empty() || is_other {
            continue;
        }
        let Some(at) = words.windows(own.len()).position(|part| part == own) else {
            continue;
        };
        let mut rest = words;
        rest.drain(at..at + own.len());
        let fits = match unit {
            Some(Unit::Length(_)) => *slides,
            Some(_) => !slides,
            None => true,
        };
        let Some(quantity) = quantity_of(&rest, joint).filter(|_| fits) else {
            continue;
        };
        let unit = match quantity {
            Quantity::Torque(_) => Some(Unit::Fixed),
            _ => unit,
        };
        if best.as_ref().is_none_or(|(length, ..)| own.len() > *length) {
            best = Some((own.len(), Role::Known(quantity, unit), rest.is_empty()));
        }
    }
    best.map(|(_, role, certain)| (role, certain))
}

fn is_of_a_joint(quantity: Quantity) -> bool {
    matches!(
        quantity,
        Quantity::Commanded(_)
            | Quantity::ReadBack(_)
            | Quantity::Speed(_)
            | Quantity::Direction(_)
    )
}

fn split(name: &str) -> Vec<String> {
    let words = name.split(|c: char| !c.is_alphanumeric());
    words
        .filter(|word| !word.is_empty())
        .map(str::to_owned)
        .collect()
}

/// What the words beside a joint's name make of it.
fn quantity_of(rest: &[String], joint: usize) -> Option<Quantity> {
    const PLACE: &str = "position pos value joint states state";
    let all = |allowed: &[&'static str]| {
        let mut rest = rest.iter();
        rest.all(|word| allowed.iter().any(|list| is_among(word, list)))
    };
    match rest {
        [one] if one == "velocity" || one == "speed" => return Some(Quantity::Speed(joint)),
        [one] if one == "effort" || one == "torque" => return Some(Quantity::Torque(joint)),
        [one] if one == "dir" || one == "direction" => return Some(Quantity::Direction(joint)),
        _ => {}
    }
    if all(&[PLACE, COMMANDED]) {
        Some(Quantity::Commanded(joint))
    } else if all(&[PLACE, READ_BACK]) {
        Some(Quantity::ReadBack(joint))
    } else {
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_robots_own_names_are_known_and_what_measures_keeps_its_meaning() {
        let names = [
            "shoulder_pan_joint",
            "joint_1",
            "joint_10",
            "rail",
            "x",
            "panda_joint1_m",
        ];
        let joints: Vec<(String, bool)> = names
            .iter()
            .map(|name| ((*name).to_owned(), *name == "rail"))
            .collect();
        for (heading, meant, certain) in [
            ("shoulder_pan_joint", "q1", true),
            ("Shoulder_Pan_Joint [rad]", "q1_rad", true),
            ("shoulder_pan_joint_deg", "q1_deg", true),
            ("actual shoulder_pan_joint", "q1_read", false),
            ("shoulder_pan_joint.position", "q1", false),
            ("shoulder_pan_joint_velocity", "speed1", false),
            ("joint_1", "q2", true),
            ("joint_10", "q3", true),
            ("rail_mm", "q4_mm", true),
            ("panda_joint1_m", "q6", true),
            ("x", "x", false),
            ("q1_deg", "q1_deg", false),
        ] {
            assert_eq!(understand(heading, &joints).to_string(), meant, "{heading}");
            assert_eq!(is_one(heading, &joints), certain, "{heading}");
        }
    }
}
