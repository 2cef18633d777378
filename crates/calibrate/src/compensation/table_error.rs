//! Why a joint has no table.

use crate::text::{Text, length};

/// Why there is no table.
#[derive(Debug, Clone, PartialEq)]
pub enum TableError {
    /// The model contains the residual of another table.
    AlreadyCompensated(String),
    /// The model has a residual of the robot's size.
    Gross {
        /// RMS error, mm.
        left_mm: f64,
        /// How far the robot reaches, mm.
        size_mm: f64,
    },
    /// There is no such table.
    None(Text),
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
            Self::None(why) => why.clone(),
        }
    }
}

displays_what_it_says!(TableError);

impl std::error::Error for TableError {}
