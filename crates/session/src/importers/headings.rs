//! What a column of a foreign table is, by its heading.
//!
//! A heading of the session format (`x_mm`, `q1_deg`) means what it means there. Others are taken
//! apart into words and a unit: `X [mm]`, `Point Name`, `Theta(deg)`, `Actual J2 / °`. What is
//! nominal or a deviation is no measurement. A heading that fits nothing is kept and ignored, as in
//! a session.

use super::role::{Role, of_quantity};
use crate::importers::columns::COORDINATES;
use crate::importers::turns::{axis_of, part_of};
use crate::importers::units::{self, Word};
use crate::sessions::columns::{Heading, Quantity, Unit};

/// What a heading says.
pub(crate) fn understand(heading: &str) -> Role {
    let plain = heading.trim().trim_matches('"').to_lowercase();
    if let Heading::Known(quantity, unit) = Heading::read(&plain)
        && !quantity.needs_a_reference()
    {
        return of_quantity(quantity, unit);
    }
    if let Some(role) = super::role::role_of_word(&plain) {
        return role;
    }
    let (words, unit) = words_and_unit(&plain);
    let words: Vec<&str> = words.iter().map(String::as_str).collect();
    let role = role_of(&words);
    // A stamp may be anything, one in ns is a time.
    let is_stamp = matches!(words.last(), Some(&("stamp" | "timestamp")));
    let is_time = matches!(role, Role::Time(_)) || is_stamp && role == Role::Kept;
    match (role, unit) {
        (_, Some(Word::Time(seconds))) if is_time => Role::Time(Some(seconds)),
        (Role::Turn(turn, _), Some(Word::Unit(unit @ Unit::Angle(_)))) => {
            Role::Turn(turn, Some(unit))
        }
        (Role::Known(quantity, _), Some(Word::Unit(unit))) if takes(quantity, unit) => {
            Role::Known(quantity, Some(unit))
        }
        (Role::Turn(..) | Role::Time(_), Some(_))
        | (Role::Known(..), Some(Word::Time(_) | Word::Unit(_))) => Role::Kept,
        (role, _) => role,
    }
}

/// Whether a quantity takes a unit: an angle called x is an angle about x; a load in mm is no load.
fn takes(quantity: Quantity, unit: Unit) -> bool {
    match quantity {
        Quantity::X | Quantity::Y | Quantity::Z => matches!(unit, Unit::Length(_)),
        Quantity::Commanded(_) | Quantity::ReadBack(_) | Quantity::Speed(_) => true,
        _ => false,
    }
}

/// Whether a heading has a word for time in it.
pub(crate) fn names_a_time(heading: &str) -> bool {
    const TIME: Words =
        "time timestamp zeit zeitstempel uhrzeit clock date datum datetime secs nsecs";
    let (words, _) = words_and_unit(&heading.trim().to_lowercase());
    words.iter().any(|word| is_among(word, TIME))
}

/// The words of a heading and its unit: in brackets, behind a slash, or as the last word.
pub(crate) fn words_and_unit(heading: &str) -> (Vec<String>, Option<Word>) {
    let brackets = [('[', ']'), ('(', ')'), ('<', '>'), ('{', '}')];
    let mut name = heading.to_owned();
    let mut unit = None;
    for (open, close) in brackets {
        if let (Some(from), Some(to)) = (heading.find(open), heading.rfind(close))
            && from < to
            && let Some(found) = units::word(&heading[from + open.len_utf8()..to])
        {
            unit = Some(found);
            name = format!("{} {}", &heading[..from], &heading[to + close.len_utf8()..]);
            break;
        }
    }
    if unit.is_none()
        && let Some((before, last)) = heading.rsplit_once('/')
        && let Some(found) = units::word(last)
    {
        // `speed deg/s` is no `speed deg` in seconds, but `t/s` is a time.
        let is_time = matches!(role_of(&[before.trim()]), Role::Time(_));
        if is_time || !matches!(found, Word::Time(_)) {
            unit = Some(found);
            before.clone_into(&mut name);
        }
    }
    let separates = |c: char| !(c.is_alphanumeric() || matches!(c, '°' | 'µ' | '"' | '/'));
    let mut words: Vec<String> = name
        .split(separates)
        .filter(|word| !word.is_empty())
        .map(str::to_owned)
        .collect();
    if unit.is_none() && words.len() > 1 {
        let last = words.last().map(String::as_str).and_then(units::word);
        if last.is_some() {
            unit = last;
            words.pop();
            if words.len() > 1 && words.last().is_some_and(|word| word == "in") {
                words.pop();
            }
        }
    }
    // A topic of ROS is a path: `/tool/pose/position/x`.
    let parts = words.iter().flat_map(|word| word.split('/'));
    let words = parts.filter(|word| !word.is_empty());
    (words.map(str::to_owned).collect(), unit)
}

/// Words that say nothing more than that something was measured.
pub(crate) const MEASURED: Words = "measurement measurements messung actual act measured meas ist istwert position pos coordinate coord koordinate value \
                        wert messwert";
/// Words that say that a column was commanded.
pub(crate) const COMMANDED: Words =
    "commanded command cmd setpoint soll sollwert demand desired target angle winkel";
/// Words that say that the controller read it back.
pub(crate) const READ_BACK: Words = "read feedback actual act ist measured";

/// Words with spaces between them.
pub(crate) type Words = &'static str;

/// Whether a word is one of these.
pub(crate) fn is_among(word: &str, words: Words) -> bool {
    words.split_ascii_whitespace().any(|one| one == word)
}

fn role_of(words: &[&str]) -> Role {
    match words.join(" ").as_str() {
        "name" | "point" | "point name" | "pointname" | "point id" | "pointid" | "point no"
        | "point number" | "punkt" | "punktname" | "punktnummer" | "pkt" | "pt" | "pose"
        | "pose name" | "posename" => return Role::Point,
        "group" | "group name" | "groupname" | "collection" | "gruppe" => return Role::Group,
        "target" | "target name" | "reflector" | "smr" => {
            return Role::Known(Quantity::Target, Some(Unit::Fixed));
        }
        "time" | "timestamp" | "time stamp" | "t" | "zeit" | "zeitstempel" | "elapsed time"
        | "datetime" | "date time" | "uhrzeit" | "clock" | "utc" | "time utc" | "utc time"
        | "local time" | "elapsed" | "时间" | "时间戳" | "temps" | "tiempo" | "tempo" => {
            return Role::Time(None);
        }
        "load" | "payload" | "nutzlast" | "load kg" => {
            return Role::Known(Quantity::Load, Some(Unit::Fixed));
        }
        "temperature" | "temp" | "temperatur" => {
            return Role::Known(Quantity::Temperature, Some(Unit::Fixed));
        }
        "setup" | "station" | "aufstellung" => {
            return Role::Known(Quantity::Setup, Some(Unit::Fixed));
        }
        _ => {}
    }
    for (at, word) in words.iter().enumerate() {
        let before = word.strip_prefix("pos").or(word.strip_prefix('t'));
        let mut others = words.iter().enumerate().filter(|(index, _)| *index != at);
        if let Some(axis) = axis_of(before.unwrap_or(word))
            && others.all(|(_, word)| is_among(word, MEASURED))
        {
            return Role::Known(COORDINATES[axis], None);
        }
    }
    if let ["p", frames @ .., letter] = words
        && are_frames(frames)
        && let Some(axis) = axis_of(letter)
    {
        return Role::Known(COORDINATES[axis], None);
    }
    if let Some(role) = orientation(words) {
        return role;
    }
    if let Some(turn) = super::turns::turn(words) {
        return Role::Turn(turn, None);
    }
    joint_role(words)
}

/// Names of frames are letters, as in `p_RS_R_x`.
fn are_frames(words: &[&str]) -> bool {
    words.iter().all(|word| word.len() <= 2)
}

/// `qw`, `quat w`, `Rotation X`.
fn orientation(words: &[&str]) -> Option<Role> {
    let part = match words {
        // Between them stand names of frames: `q_RS_w`.
        [
            "q" | "quat" | "quaternion" | "orientation",
            frames @ ..,
            letter,
        ] if are_frames(frames) => part_of(letter)?,
        [word] => part_of(word.strip_prefix("quat")?)?,
        _ => return None,
    };
    Some(Role::Known(Quantity::Orientation(part), Some(Unit::Fixed)))
}

/// `J1`, `joint 2 actual`, `Theta`, `dir 1`, `speed1`.
fn joint_role(words: &[&str]) -> Role {
    // `j1` and `joint 1` alike: a word of letters, then a number.
    let mut parts: Vec<&str> = Vec::new();
    for word in words {
        match word.find(|c: char| c.is_ascii_digit()) {
            Some(at) if at > 0 => parts.extend([&word[..at], &word[at..]]),
            _ => parts.push(word),
        }
    }
    let numbers: Vec<usize> = parts.iter().filter_map(|part| part.parse().ok()).collect();
    let joint = match numbers[..] {
        [] => 0,
        [number @ 1..=9999] => number - 1,
        _ => return Role::Kept,
    };
    let names: Vec<&str> = parts
        .iter()
        .copied()
        .filter(|part| part.parse::<usize>().is_err())
        .collect();
    let Some((first, others)) = names.split_first() else {
        return Role::Kept;
    };
    let mut others = others.to_vec();
    let name = match *first {
        // The qualifier may come first: `actual j1`.
        word if is_among(word, READ_BACK) || is_among(word, COMMANDED) => {
            let at = others.iter().position(|word| is_joint(word));
            match at {
                Some(at) => {
                    let name = others.remove(at);
                    others.push(word);
                    name
                }
                None => word,
            }
        }
        word => word,
    };
    // `axis 1` alone is a joint, `a` and `j` only with a number.
    let numbered = !numbers.is_empty();
    let all = |list: Words| {
        let mut others = others.iter();
        others.all(|word| is_among(word, list) || *word == "position")
    };
    match name {
        "dir" | "direction" | "approach" | "richtung" if others.is_empty() => {
            Role::Known(Quantity::Direction(joint), Some(Unit::Fixed))
        }
        "speed" | "velocity" | "geschwindigkeit" if others.is_empty() => {
            Role::Known(Quantity::Speed(joint), None)
        }
        "a" | "j" | "q" if !numbered => Role::Kept,
        name if is_joint(name) && all(COMMANDED) => Role::Known(Quantity::Commanded(joint), None),
        name if is_joint(name) && all(READ_BACK) => Role::Known(Quantity::ReadBack(joint), None),
        _ => Role::Kept,
    }
}

pub(crate) fn is_joint(word: &str) -> bool {
    is_among(word, "q j a joint axis achse theta θ angle winkel")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn word(heading: &str) -> String {
        understand(heading).to_string()
    }

    #[test]
    fn headings_are_understood_as_people_write_them() {
        for (heading, meant) in [
            ("x_mm", "x_mm"),
            ("X [mm]", "x_mm"),
            ("Y (m)", "y_m"),
            ("Z/in", "z_in"),
            ("X in mm", "x_mm"),
            ("Measured X (µm)", "x_um"),
            ("x Istwert", "x"),
            ("Point Name", "name"),
            ("Punktname", "name"),
            ("Group", "group"),
            ("Theta(deg)", "q1_deg"),
            ("θ [°]", "q1_deg"),
            ("J2 [rad]", "q2_rad"),
            ("Joint 3", "q3"),
            ("joint 1 actual [deg]", "q1_read_deg"),
            ("Actual J2 (deg)", "q2_read_deg"),
            ("q1_read_deg", "q1_read_deg"),
            ("Speed 1 [deg/s]", "speed1_deg_s"),
            ("Time (Seconds)", "time_s"),
            ("Timestamp [ms]", "time_ms"),
            ("Zeit [h]", "time_h"),
            ("p_RS_R_x [m]", "x_m"),
            ("q_RS_w []", "qw"),
            ("%time", "time"),
            ("Winkel J2 [gon]", "q2"),
            ("Payload [kg]", "load_kg"),
            ("Temperature (°C)", "temperature_c"),
            ("Direction", "dir1"),
            ("qw", "qw"),
            ("Quat X", "qx"),
            ("measurement_x", "x"),
            ("rx [deg]", "rx_deg"),
            ("Roll (rad)", "rx_rad"),
            ("yaw", "rz"),
            ("euler2_deg", "euler2_deg"),
        ] {
            assert_eq!(word(heading), meant, "{heading}");
        }
        assert_eq!(understand("Timestamp [ms]"), Role::Time(Some(1e-3)));
    }

    #[test]
    fn what_was_not_measured_is_not_taken_for_it() {
        for heading in [
            "X nominal",
            "dX",
            "Dev X [mm]",
            "X Sigma",
            "X [deg]",
            "Remark",
            "",
            "1",
            "A",
            "Temperature [min]",
            "J0",
            "x y",
        ] {
            assert_eq!(word(heading), "-", "{heading}");
        }
    }

    #[test]
    fn the_words_of_the_option_are_those_of_a_session() {
        assert_eq!(Role::from_word("x"), Some(Role::Known(Quantity::X, None)));
        assert_eq!(
            Role::from_word("speed2"),
            Some(Role::Known(Quantity::Speed(1), None))
        );
        assert_eq!(
            Role::from_word("y_in"),
            Some(Role::Known(Quantity::Y, Some(Unit::Length(25.4))))
        );
        assert_eq!(Role::from_word("-"), Some(Role::Left));
        assert_eq!(Role::from_word("furlongs"), None);
    }
}
