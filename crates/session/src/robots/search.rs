//! Robots by typed text.
//!
//! Text and names are compared by their letters and digits alone, in lower case and without accents: `UR 5e`,
//! `ur-5e` and `ur5e` are one. A robot is found where every word of the text is part of its names; the better
//! its name matches, the earlier it stands.

use super::{LibraryRobot, library};
use crate::refusal::Refusal;

/// How many names are proposed in place of an unknown one.
const PROPOSALS: usize = 5;

/// Letters and digits in lower case, without accents.
fn plain(text: &str) -> String {
    let letter = |c: char| match c {
        'ä' | 'Ä' | 'á' | 'à' | 'â' => Some('a'),
        'ö' | 'Ö' | 'ó' | 'ô' => Some('o'),
        'ü' | 'Ü' | 'ú' | 'û' => Some('u'),
        'é' | 'è' | 'ê' => Some('e'),
        c if c.is_alphanumeric() => c.to_lowercase().next(),
        _ => None,
    };
    text.chars().filter_map(letter).collect()
}

/// Its names, plain: what the robot itself is called first.
fn names(robot: &LibraryRobot) -> Vec<String> {
    let own = [robot.id.as_str(), &robot.model];
    let also = robot.also.iter().map(String::as_str);
    let mut names: Vec<String> = own.into_iter().chain(also).map(plain).collect();
    names.push(plain(&robot.title()));
    names
}

/// How well a robot matches, the smaller the better; `None`: not at all.
fn rank(robot: &LibraryRobot, text: &str) -> Option<usize> {
    let (whole, names) = (plain(text), names(robot));
    if names.contains(&whole) {
        return Some(0);
    }
    if names.iter().any(|name| name.starts_with(&whole)) {
        return Some(1);
    }
    if names.iter().any(|name| name.contains(&whole)) {
        return Some(2);
    }
    let all = format!("{} {}", names.join(" "), plain(robot.kind.name()));
    let every = text
        .split_whitespace()
        .map(plain)
        .all(|word| all.contains(&word));
    every.then_some(3)
}

/// The robots that match a text: all of them for an empty one, the best match first.
pub fn find(text: &str) -> Vec<&'static LibraryRobot> {
    if plain(text).is_empty() {
        return library().iter().collect();
    }
    let matching = |robot: &'static LibraryRobot| Some((rank(robot, text)?, robot));
    let mut found: Vec<(usize, &LibraryRobot)> = library().iter().filter_map(matching).collect();
    found.sort_by_key(|(rank, _)| *rank);
    found.into_iter().map(|(_, robot)| robot).collect()
}

/// The one robot that has a text as one of its names: a part of the only name that has it may be another robot's.
///
/// # Errors
/// With the nearest names.
pub fn named(text: &str) -> Result<&'static LibraryRobot, Refusal> {
    let found = find(text);
    let is_named = |robot: &&LibraryRobot| rank(robot, text) == Some(0);
    match found.partition_point(is_named) {
        1 => Ok(found[0]),
        count => {
            let named = || {
                found[..count]
                    .iter()
                    .map(|robot| robot.id.clone())
                    .collect()
            };
            let nearest = if count == 0 {
                nearest(text, &found)
            } else {
                named()
            };
            Err(Refusal(text!(
                "no robot of the library is called '{name}'; nearest: {nearest}",
                name = text,
                nearest = nearest.join(", ")
            )))
        }
    }
}

/// What may have been meant: the robots that match, else those whose names differ in few letters.
fn nearest(text: &str, found: &[&LibraryRobot]) -> Vec<String> {
    if !found.is_empty() && found.len() < library().len() {
        let ids = found.iter().map(|robot| robot.id.clone());
        return ids.take(PROPOSALS).collect();
    }
    let text = plain(text);
    let mut all: Vec<(usize, &LibraryRobot)> = library()
        .iter()
        .map(|robot| {
            let names = names(robot);
            let off = names.iter().map(|name| edits(&text, name)).min();
            (off.unwrap_or(usize::MAX), robot)
        })
        .collect();
    all.sort_by_key(|(off, _)| *off);
    let ids = all.into_iter().map(|(_, robot)| robot.id.clone());
    ids.take(PROPOSALS).collect()
}

/// Letters to insert, to leave out or to exchange from one text to the other (Levenshtein 1966).
fn edits(one: &str, other: &str) -> usize {
    let other: Vec<char> = other.chars().collect();
    let mut row: Vec<usize> = (0..=other.len()).collect();
    for (i, a) in one.chars().enumerate() {
        let mut diagonal = row[0];
        row[0] = i + 1;
        for (j, b) in other.iter().enumerate() {
            let exchanged = diagonal + usize::from(a != *b);
            diagonal = row[j + 1];
            row[j + 1] = exchanged.min(row[j] + 1).min(diagonal + 1);
        }
    }
    row[other.len()]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ids(text: &str) -> Vec<&str> {
        find(text).iter().map(|robot| robot.id.as_str()).collect()
    }

    #[test]
    fn case_spaces_signs_and_accents_do_not_matter() {
        for text in ["UR5e", "ur 5e", "UR-5e", "universal robots ur5e", "  ur5E "] {
            assert_eq!(ids(text)[0], "ur5e", "{text}");
        }
        for text in ["KR 6 R700", "kr6r700", "kuka kr6 r700"] {
            assert_eq!(ids(text)[0], "kr6-r700", "{text}");
        }
        assert_eq!(ids("staubli").len(), ids("Stäubli").len());
        assert!(ids("Stäubli").len() >= 5);
    }

    #[test]
    fn every_word_has_to_match_and_kinds_are_words() {
        let seven = find("kuka seven");
        assert!(!seven.is_empty());
        assert!(seven.iter().all(|robot| robot.robot.joint_count() == 7));
        assert!(ids("scara").contains(&"cobra600"));
        assert!(ids("kuka ur5e").is_empty());
        assert_eq!(ids("").len(), library().len());
    }

    #[test]
    fn a_name_is_one_robot_and_a_wrong_one_proposes_the_nearest() {
        assert_eq!(named("UR 5e").unwrap().id, "ur5e");
        assert_eq!(named("panda").unwrap().id, "fer");
        // Part of several names, and the whole of one.
        assert_eq!(named("ur3").unwrap().id, "ur3");
        let nearest = |text| {
            let refused = named(text).unwrap_err().to_string();
            refused.rsplit_once("nearest: ").unwrap().1.to_owned()
        };
        assert_eq!(nearest("irb 1200"), "irb1200-5-0.9, irb1200-7-0.7");
        // The only name with this in it is another robot's.
        assert_eq!(nearest("irb 240"), "irb2400-16");
        assert!(named("ur10e beside irb 120").is_err());
        let slip = nearest("ur5w");
        assert!(slip.split(", ").any(|name| name == "ur5e"), "{slip}");
        let slip = nearest("lrmate2000id");
        assert!(slip.starts_with("lrmate200id,"), "{slip}");
    }

    #[test]
    fn the_distance_counts_letters() {
        assert_eq!(edits("kitten", "sitting"), 3);
        assert_eq!(edits("", "abc"), 3);
        assert_eq!(edits("gp8", "gp8"), 0);
    }
}
