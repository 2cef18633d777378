//! Why a joint has no table.

use crate::text::{Text, length};

/// Why there is no table.
#[derive(Debug, Clone, PartialEq)]
pub enum TableError {
    /// The model says what another table leaves.
    AlreadyCompensated(String),
    /// The model leaves an error of the robot's size.
    Gross {
        /// RMS error, mm.
        left_mm: f64,
        /// How far the robot reaches, mm.
        size_mm: f64,
    },
    /// The controller counts the joint in a way that a table cannot.
    Conventions {
        /// The joint, counted from 1.
        joint: usize,
        /// What was corrected.
        why: Text,
    },
    /// A joint that the robot does not have.
    NoSuchJoint {
        /// The joint, counted from 1.
        joint: usize,
        /// How many there are.
        joints: usize,
    },
    /// A step that is not a positive number.
    Step(f64),
    /// A step so small that the table gets too long.
    TooMany {
        /// The step as it was given.
        step: f64,
        /// How many entries it makes.
        entries: f64,
        /// How many there may be.
        most: usize,
    },
    /// No limits, and all samples at one place.
    NoRange,
}

impl TableError {
    /// In words.
    pub fn describe(&self) -> Text {
        match self {
            Self::AlreadyCompensated(model) => text!(
                "the model comes from a session that was measured with the table of model {model} active: it says what is left, and a table made from it would lack what that one does; measure without a table",
                model
            ),
            Self::Gross { left_mm, size_mm } => text!(
                "the model leaves an RMS error of {left_mm} on a robot that reaches {size_mm}: the session is not as it says (a unit, a sign, rows of other rows), and nothing is corrected with it",
                left_mm = length(*left_mm, 3),
                size_mm = length(*size_mm, 0)
            ),
            Self::Conventions { joint, why } => text!(
                "no table for joint {joint}: {why}, and the model corrected that; correct it in the controller or in the session, identify again and make the table from that model",
                joint,
                why
            ),
            Self::NoSuchJoint { joint, joints } => {
                text!("joint {joint}: the robot has {joints}", joint, joints)
            }
            Self::Step(step) => text!("a step of {step}; expected a positive number", step),
            Self::TooMany {
                step,
                entries,
                most,
            } => text!(
                "a step of {step} makes {entries} entries; expected at most {most}",
                step,
                entries,
                most
            ),
            Self::NoRange => text!(
                "the joint has no limits and was measured at a single value: there is no range for a table"
            ),
        }
    }
}

displays_what_it_says!(TableError);

impl std::error::Error for TableError {}
