//! What a table format is, in one place: its sign, its digits, its grid, its limits, and what its
//! reader does between the entries, beyond them, and at a change of direction.
//!
//! ```text
//! correction c = −e,   deviation e = where the joint stands − where it was sent
//! ```
//!
//! Half of all controllers want c and half of them want e; [`EntryMeaning`] is the one place that knows.

use crate::kinematics::JointKind;
use crate::text::Template;

/// What the numbers of a table are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EntryMeaning {
    /// What to add to the command.
    Correction,
    /// Where the joint stands beyond its command; its controller subtracts it.
    Deviation,
}

impl EntryMeaning {
    /// What turns a correction into the table's number, and back.
    pub fn sign(self) -> f64 {
        match self {
            Self::Correction => 1.0,
            Self::Deviation => -1.0,
        }
    }

    /// In words, for the user of the table.
    pub fn sentence(self) -> Template {
        match self {
            Self::Correction => {
                phrase!(
                    "the numbers are corrections: add them to the command, so that the robot ends up where it was commanded (the deviation measured − commanded has the other sign)"
                )
            }
            Self::Deviation => {
                phrase!(
                    "the numbers are deviations, actual − commanded: the controller takes them away from the command (the correction, what is added to it, has the other sign)"
                )
            }
        }
    }
}

/// Where entries may stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Spacing {
    /// At equal steps only.
    Equal,
    /// Anywhere, as long as they ascend.
    Free,
}

/// Whether a table knows from which side a joint comes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Directions {
    /// One column for each.
    Both,
    /// One column for both. Where they differ noticeably the export is refused.
    One {
        /// What to do then.
        instead: Template,
    },
}

/// Sign, digits, grid and limits of one table format.
#[derive(Debug, Clone, Copy)]
pub struct Rules {
    /// Name of the format.
    pub format: &'static str,
    /// What its numbers are.
    pub meaning: EntryMeaning,
    /// The smallest difference that the file can hold, degrees or mm; `None`: every digit.
    pub resolution: Option<f64>,
    /// Unit of its numbers on a joint that turns and on one that slides.
    pub units: [&'static str; 2],
    /// How many of that unit make a degree or a mm.
    pub per_outer: f64,
    /// Where entries may stand.
    pub spacing: Spacing,
    /// The widest steps that are chosen for it, degrees or mm.
    pub widest_step: f64,
    /// The most entries that its reader takes.
    pub most_entries: usize,
    /// Where that limit comes from.
    pub limit_because: Template,
    /// Whether it has a column for each direction.
    pub directions: Directions,
    /// Whether it can say that it repeats after a turn.
    pub repeats: bool,
    /// What happens between two entries.
    pub interpolation: &'static str,
    /// What happens beyond the first and the last.
    pub outside: &'static str,
    /// Which column holds when.
    pub direction: &'static str,
    /// What happens after a full turn.
    pub full_turn: &'static str,
    /// What is not sure about it.
    pub label: Option<Template>,
}

impl Rules {
    /// Unit of the file's numbers.
    pub fn unit(&self, kind: JointKind) -> &'static str {
        match kind {
            JointKind::Revolute => self.units[0],
            JointKind::Prismatic => self.units[1],
        }
    }

    /// A number as the file can hold it.
    pub fn rounded(&self, value: f64) -> f64 {
        match self.resolution {
            None => value,
            // Dividing by a whole number gives the decimal that is meant, multiplying by a
            // fraction its neighbour.
            Some(resolution) => {
                let per_unit = (1.0 / resolution).round();
                (value * per_unit).round() / per_unit
            }
        }
    }
}

/// Resolution of the formats that write decimals: 10⁻⁹ degrees or mm, far below any machine.
pub(super) const DECIMALS: Option<f64> = Some(1e-9);

/// What has only been read about.
pub(super) const FROM_THE_MANUAL: Template =
    phrase!("syntax from the manual, not tried on a controller");

/// A number with a decimal point and without an exponent, whatever the locale; never −0.
pub(super) fn decimal(value: f64) -> String {
    let text = format!("{}", value + 0.0);
    if text.contains('.') {
        text
    } else {
        format!("{text}.0")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn decimals_have_a_point_and_no_exponent() {
        for (value, text) in [
            (0.0, "0.0"),
            (-0.0, "0.0"),
            (90.0, "90.0"),
            (1e-9, "0.000000001"),
            (-1e20, "-100000000000000000000.0"),
        ] {
            assert_eq!(decimal(value), text);
        }
    }
}
