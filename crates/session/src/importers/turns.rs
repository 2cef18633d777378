//! The parts of an orientation in three angles or a rotation vector, and the words for them.

use crate::sessions::columns::Unit;

/// The axis that a letter names.
pub(crate) fn axis_of(letter: &str) -> Option<usize> {
    ["x", "y", "z"].iter().position(|axis| *axis == letter)
}

/// The part of a quaternion that a letter names.
pub(crate) fn part_of(letter: &str) -> Option<usize> {
    let parts = ["w", "x", "y", "z"];
    parts.iter().position(|part| *part == letter)
}

/// Which of the three numbers of an orientation a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Turn {
    /// The angle about x, y or z, counted from 0.
    About(usize),
    /// The first, second or third of the order, counted from 0.
    Nth(usize),
}

/// The words of `--columns` for them, about x, y, z and then in order.
const NAMES: [&str; 6] = ["rx", "ry", "rz", "euler1", "euler2", "euler3"];

impl Turn {
    pub(super) fn place(self) -> usize {
        match self {
            Self::About(at) | Self::Nth(at) => at,
        }
    }

    /// The one that a word of `--columns` names.
    pub(super) fn named(name: &str) -> Option<Self> {
        let at = NAMES.iter().position(|own| *own == name)?;
        Some(match at {
            0..3 => Self::About(at),
            _ => Self::Nth(at - 3),
        })
    }
}

/// The words of three angles in a heading: `rx`, `Roll`, `euler 2`, `rot z`.
pub(crate) fn turn(words: &[&str]) -> Option<Turn> {
    let about = match words {
        ["rx" | "roll" | "rotx" | "wx"] => 0,
        ["ry" | "pitch" | "roty" | "wy"] => 1,
        ["rz" | "yaw" | "rotz" | "wz"] => 2,
        ["rot" | "rotvec" | "rvec", axis] | ["rotation", "vector", axis] => axis_of(axis)?,
        [word] => return nth(word.strip_prefix("euler")?),
        ["euler", "angle", number] | ["euler", number] => {
            return nth(number).or_else(|| axis_of(number).map(Turn::About));
        }
        _ => return None,
    };
    Some(Turn::About(about))
}

fn nth(word: &str) -> Option<Turn> {
    let at = ["1", "2", "3"].iter().position(|n| *n == word)?;
    Some(Turn::Nth(at))
}

/// The word of `--columns` for one.
pub(crate) fn word(turn: Turn, unit: Option<Unit>) -> String {
    let name = match turn {
        Turn::About(at) => NAMES[at],
        Turn::Nth(at) => NAMES[at + 3],
    };
    match unit.and_then(Unit::suffix) {
        Some(unit) => format!("{name}_{unit}"),
        None => name.to_owned(),
    }
}
