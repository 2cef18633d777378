//! What a column of a foreign table is.

use crate::importers::turns::Turn;
use crate::importers::units::{self, TimeUnit};
use crate::sessions::columns::{Heading, Quantity, Unit};
use std::fmt;

/// What a column is for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Role {
    /// The measured point's name.
    Point,
    /// The group that the point's name is in.
    Group,
    /// A quantity of a session, in this unit; `None` where the heading does not say.
    Known(Quantity, Option<Unit>),
    /// A time in a unit of so many seconds; `None` where the heading does not say.
    Time(Option<f64>),
    /// The measured position of a joint itself, in rad or mm; joints count from 0.
    Axis(usize),
    /// One of the three angles (or parts of the rotation vector) of a measured orientation, in this
    /// unit; `None` where the heading does not say.
    Turn(Turn, Option<Unit>),
    /// Kept and ignored.
    Kept,
    /// Not even kept.
    Left,
}

/// What columns are proposed to be, by what their headings have in common.
#[derive(Debug, PartialEq)]
pub(crate) enum Proposal<T> {
    None,
    One(T),
    /// Only a person can say which; by their names.
    Several(Vec<String>),
}

impl Role {
    /// Whether its cells are numbers.
    pub(crate) fn is_number(self) -> bool {
        match self {
            Self::Known(quantity, _) => {
                !quantity.is_named() && !matches!(quantity, Quantity::Direction(_))
            }
            Self::Time(_) | Self::Turn(..) => true,
            _ => false,
        }
    }

    /// The quantity, where it is one.
    pub(crate) fn quantity(self) -> Option<Quantity> {
        match self {
            Self::Known(quantity, _) => Some(quantity),
            Self::Time(_) => Some(Quantity::Time),
            _ => None,
        }
    }

    /// Reads a word of `--columns`: a session's heading, with or without its unit, `name`, `group`,
    /// or `-`.
    pub(crate) fn from_word(word: &str) -> Option<Self> {
        match word {
            "" | "-" => return Some(Self::Left),
            "name" | "point" => return Some(Self::Point),
            "group" => return Some(Self::Group),
            "time" => return Some(Self::Time(None)),
            _ => {}
        }
        if let Heading::Known(quantity, unit) = Heading::read(word) {
            return Some(of_quantity(quantity, unit));
        }
        if let Some(role) = role_of_word(word) {
            return Some(role);
        }
        if let Some(units::Word::Time(seconds)) = word.strip_prefix("time_").and_then(units::word) {
            return Some(Self::Time(Some(seconds)));
        }
        // The same heading with a unit added is known: only the unit is missing.
        let mut units = ["mm", "deg", "mm_s", "deg_s"].iter();
        units.find_map(|unit| match Heading::read(&format!("{word}_{unit}")) {
            Heading::Known(quantity, _) => Some(Self::Known(quantity, None)),
            Heading::Unknown { .. } => None,
        })
    }
}

/// Whether one of the columns is this.
pub(crate) fn has(roles: &[Role], quantity: Quantity) -> bool {
    roles.iter().any(|role| role.quantity() == Some(quantity))
}

pub(super) fn of_quantity(quantity: Quantity, unit: Unit) -> Role {
    match quantity {
        Quantity::Time => Role::Time(Some(1.0)),
        _ => Role::Known(quantity, Some(unit)),
    }
}

/// As `--columns` takes it: `name`, `x_mm`, `q1`, `-`.
impl fmt::Display for Role {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Point => f.write_str("name"),
            Self::Group => f.write_str("group"),
            Self::Time(seconds) => {
                let is = |unit: &TimeUnit| Some(unit.in_s()) == *seconds;
                match TimeUnit::ALL.into_iter().find(is) {
                    Some(unit) => write!(f, "time_{}", unit.symbol()),
                    None => f.write_str("time"),
                }
            }
            Self::Axis(_) => f.write_str("position"),
            Self::Kept | Self::Left => f.write_str("-"),
            Self::Known(quantity, unit) => f.write_str(&quantity.heading(*unit)),
            Self::Turn(turn, unit) => f.write_str(&super::turns::word(*turn, *unit)),
        }
    }
}

/// A word of `--columns`: `rx`, `ry_deg`, `euler1_rad`.
pub(crate) fn role_of_word(word: &str) -> Option<Role> {
    let (name, unit) = match word.rsplit_once('_') {
        None => (word, None),
        Some((name, unit)) => (name, Some(Unit::from_suffix(unit)?)),
    };
    let is_angle = unit.is_none_or(|unit| matches!(unit, Unit::Angle(_)));
    let turn = Turn::named(name).filter(|_| is_angle)?;
    Some(Role::Turn(turn, unit))
}
