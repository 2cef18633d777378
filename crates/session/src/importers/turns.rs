//! The parts of an orientation in three angles or a rotation vector, and the words for them.

use crate::sessions::columns::Unit;

/// Which of the three numbers of an orientation a column holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Turn {
    /// The angle about x, y or z, counted from 0.
    About(usize),
    /// The first, second or third of the order, counted from 0.
    Nth(usize),
}

impl Turn {
    pub(super) fn place(self) -> usize {
        match self {
            Self::About(at) | Self::Nth(at) => at,
        }
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

fn axis_of(word: &str) -> Option<usize> {
    ["x", "y", "z"].iter().position(|axis| *axis == word)
}

fn nth(word: &str) -> Option<Turn> {
    let at = ["1", "2", "3"].iter().position(|n| *n == word)?;
    Some(Turn::Nth(at))
}

/// The word of `--columns` for one.
pub(crate) fn word(turn: Turn, unit: Option<Unit>) -> String {
    let name = match turn {
        Turn::About(axis) => ["rx", "ry", "rz"][axis].to_owned(),
        Turn::Nth(at) => format!("euler{}", at + 1),
    };
    match unit {
        Some(Unit::Angle(1.0)) => format!("{name}_rad"),
        Some(Unit::Angle(factor)) if (factor - 1.0_f64.to_radians()).abs() < 1e-15 => {
            format!("{name}_deg")
        }
        _ => name,
    }
}
