//! Headings that name a joint as the robot's description does: `shoulder_pan_joint`.
//!
//! The name alone, with or without a unit, is certain. Among other words of a joint (`actual
//! shoulder_pan_joint position`) it is a guess, as any heading of another program. A joint that is
//! called like something that is measured (`x`) is not recognised by its name.

use std::collections::BTreeMap;

use crate::importers::headings;
use crate::importers::headings::{COMMANDED, READ_BACK, Words, is_among, words_and_unit};
use crate::importers::role::{Proposal, Role};
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
        let is_other = match headings::understand(name) {
            Role::Known(quantity, _) => quantity.joint().is_none(),
            role => matches!(role, Role::Time(_) | Role::Point),
        };
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

/// Words of columns that are about joints and state no position.
const OTHER_QUANTITY: Words = "velocity velocities speed vel qd dq acceleration acc accel effort torque moment tau force \
                               current strom temperature temp error err deviation dev delta std sigma limit min max";

/// The headings that are none by themselves and name the joints, each once, with the same words before and behind:
/// as the robot's description does, or numbered (`ur5e_elbow_joint`, `kr10_a1`, `panda_joint3`). Columns and what they
/// are, one of each joint; or the first headings of several sets, of which each names all joints.
pub(crate) fn shared(
    headings: &[String],
    roles: &[Role],
    joints: &Joints,
) -> Proposal<Vec<(usize, Role)>> {
    let own = own_words(joints);
    let mut sets: BTreeMap<String, Vec<(usize, usize, Option<Unit>)>> = BTreeMap::new();
    for (index, (heading, role)) in headings.iter().zip(roles).enumerate() {
        if *role != Role::Kept {
            continue;
        }
        let (words, unit) = words_and_unit(&heading.trim().trim_matches('"').to_lowercase());
        let unit = match unit {
            None => None,
            Some(Word::Unit(unit)) => Some(unit),
            Some(_) => continue,
        };
        if words.iter().any(|word| is_among(word, OTHER_QUANTITY)) {
            continue;
        }
        for (set, joint) in by_name(&words, &own).into_iter().chain(by_number(&words)) {
            sets.entry(set).or_default().push((index, joint, unit));
        }
    }
    let count = joints.len();
    let mut found: Vec<(String, Vec<(usize, Role)>)> = Vec::new();
    for (set, mut members) in sets {
        members.sort_by_key(|(_, joint, _)| *joint);
        let is_numbered = set.starts_with('#');
        let first = usize::from(is_numbered && members.first().is_some_and(|one| one.1 > 0));
        let are_in_order = |members: &[(usize, usize, Option<Unit>)]| {
            (first..).zip(members).all(|(joint, one)| joint == one.1)
        };
        // Counted from zero a gripper may come last, as where nothing is before the numbers.
        if is_numbered && first == 0 && count > 0 {
            members.truncate(count);
        }
        let is_whole = match count {
            0 => is_numbered && members.len() > 1,
            1 => !is_numbered && members.len() == 1,
            _ => members.len() == count,
        };
        if !is_whole || !are_in_order(&members) {
            continue;
        }
        let is_read = set.split(' ').any(|word| is_among(word, READ_BACK));
        let columns = members.into_iter().map(|(index, joint, unit)| {
            let joint = joint - first;
            let quantity = if is_read {
                Quantity::ReadBack(joint)
            } else {
                Quantity::Commanded(joint)
            };
            (index, Role::Known(quantity, unit))
        });
        let columns: Vec<(usize, Role)> = columns.collect();
        if !found.iter().any(|(_, other)| *other == columns) {
            found.push((headings[columns[0].0].clone(), columns));
        }
    }
    // Read back beside commanded is another quantity.
    let is_read =
        |columns: &[(usize, Role)]| matches!(columns[0].1, Role::Known(Quantity::ReadBack(_), _));
    let (read, commanded): (Vec<_>, Vec<_>) =
        found.into_iter().partition(|(_, columns)| is_read(columns));
    for set in [&commanded, &read] {
        if set.len() > 1 {
            return Proposal::Several(set.iter().map(|(first, _)| first.clone()).collect());
        }
    }
    let all: Vec<(usize, Role)> = commanded
        .into_iter()
        .chain(read)
        .flat_map(|(_, columns)| columns)
        .collect();
    if all.is_empty() {
        Proposal::None
    } else {
        Proposal::One(all)
    }
}

/// The words of each joint's name, as it is and without what all of them have in common.
fn own_words(joints: &Joints) -> Vec<[Vec<String>; 2]> {
    let names: Vec<Vec<String>> = joints
        .iter()
        .map(|(name, _)| split(&name.to_lowercase()))
        .collect();
    let shortest = names.iter().map(Vec::len).min().unwrap_or(0);
    let alike = |word: &dyn Fn(&Vec<String>) -> String| {
        names.windows(2).all(|two| word(&two[0]) == word(&two[1]))
    };
    let before = (0..shortest)
        .take_while(|at| alike(&|name| name[*at].clone()))
        .count();
    let behind = (1..=shortest - before.min(shortest))
        .take_while(|at| alike(&|name| name[name.len() - at].clone()))
        .count();
    let core = |name: &Vec<String>| match joints.len() {
        0 | 1 => name.clone(),
        _ => name[before..name.len() - behind].to_vec(),
    };
    names
        .iter()
        .map(|name| [name.clone(), core(name)])
        .collect()
}

/// The joint whose name is among these words, the longest one, and the words around it.
fn by_name(words: &[String], own: &[[Vec<String>; 2]]) -> Option<(String, usize)> {
    let places = own.iter().enumerate().flat_map(|(joint, names)| {
        let at = |name: &Vec<String>| {
            let mut windows = words.windows(name.len().max(1));
            let at = windows.position(|part| part == name)?;
            let (before, behind) = (&words[..at], &words[at + name.len()..]);
            let around = format!("{} # {}", before.join(" "), behind.join(" "));
            Some((name.len(), around, joint))
        };
        names
            .iter()
            .filter(|name| !name.is_empty())
            .filter_map(at)
            .collect::<Vec<_>>()
    });
    let (_, around, joint) = places.max_by_key(|(length, ..)| *length)?;
    Some((format!("name {around}"), joint))
}

/// The numbers of joints among these words, each with the words around it.
fn by_number(words: &[String]) -> Vec<(String, usize)> {
    let mut parts: Vec<&str> = Vec::new();
    for word in words {
        let mut rest = word.as_str();
        while let Some(first) = rest.chars().next() {
            let is_digit = first.is_ascii_digit();
            let end = rest.find(|c: char| c.is_ascii_digit() != is_digit);
            let (part, others) = rest.split_at(end.unwrap_or(rest.len()));
            parts.push(part);
            rest = others;
        }
    }
    let joint_at = |at: usize| {
        let before = at.checked_sub(1).map(|at| parts[at]);
        let behind = parts.get(at + 1);
        let is_one = before.is_some_and(headings::is_joint)
            || behind.is_some_and(|word| is_among(word, "joint axis achse"));
        parts[at].parse().ok().filter(|_| is_one)
    };
    let around = |at: usize| {
        format!(
            "# {} # {}",
            parts[..at].join(" "),
            parts[at + 1..].join(" ")
        )
    };
    (0..parts.len())
        .filter_map(|at| Some((around(at), joint_at(at)?)))
        .collect()
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

    fn found(headings: &[&str], joints: &[&str]) -> String {
        let headings: Vec<String> = headings.iter().map(|name| (*name).to_owned()).collect();
        let joints: Vec<(String, bool)> = joints
            .iter()
            .map(|name| ((*name).to_owned(), false))
            .collect();
        let roles: Vec<Role> = headings
            .iter()
            .map(|name| understand(name, &joints))
            .collect();
        match shared(&headings, &roles, &joints) {
            Proposal::None => "none".to_owned(),
            Proposal::Several(sets) => format!("{} sets", sets.len()),
            Proposal::One(columns) => {
                let words = columns
                    .iter()
                    .map(|(index, role)| format!("{index} {role}"));
                words.collect::<Vec<_>>().join(", ")
            }
        }
    }

    #[test]
    fn joints_are_told_by_what_their_headings_have_in_common() {
        let ur = ["shoulder_pan_joint", "shoulder_lift_joint", "elbow_joint"];
        let numbered = ["joint_1", "joint_2", "joint_3"];
        for (headings, joints, meant) in [
            (
                &["kr10_a1", "kr10_a2", "kr10_a3"][..],
                &numbered,
                "0 q1, 1 q2, 2 q3",
            ),
            (
                &["panda_joint3", "panda_joint1", "panda_joint2 [deg]"],
                &numbered,
                "1 q1, 2 q2_deg, 0 q3",
            ),
            (
                &["arm_left_1_joint", "arm_left_2_joint", "arm_left_3_joint"],
                &ur,
                "0 q1, 1 q2, 2 q3",
            ),
            // From zero, a gripper last.
            (
                &["r_joint_0", "r_joint_1", "r_joint_2", "r_joint_3"],
                &ur,
                "0 q1, 1 q2, 2 q3",
            ),
            (
                &[
                    "ur5e_elbow_joint",
                    "ur5e_shoulder_pan_joint",
                    "ur5e_shoulder_lift_joint",
                ],
                &ur,
                "1 q1, 2 q2, 0 q3",
            ),
            (
                &["shoulder_pan.pos", "shoulder_lift.pos", "elbow.pos"],
                &ur,
                "0 q1, 1 q2, 2 q3",
            ),
            (
                &[
                    "fr3_joint1_actual",
                    "fr3_joint2_actual",
                    "fr3_joint3_actual",
                ],
                &numbered,
                "0 q1_read, 1 q2_read, 2 q3_read",
            ),
            // Two arms, one joint of another, none of a robot with as many, no position.
            (
                &["l_j1", "l_j2", "l_j3", "r_j1", "r_j2", "r_j3"],
                &ur,
                "2 sets",
            ),
            (&["l_j1", "l_j2", "r_j3"], &ur, "none"),
            (&["kr10_a1", "kr10_a2", "kr10_a3", "kr10_a4"], &ur, "none"),
            (
                &["kr10_torque_a1", "kr10_torque_a2", "kr10_torque_a3"],
                &ur,
                "none",
            ),
            (&["marker_1", "marker_2", "marker_3"], &ur, "none"),
        ] {
            assert_eq!(found(headings, joints), meant, "{headings:?}");
        }
        assert_eq!(
            found(&["arm_q1", "arm_q2"], &[]),
            "0 q1, 1 q2",
            "the robot is not known"
        );
    }
}
