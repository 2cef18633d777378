//! Detection limits: how large an effect would have had to be to be seen.

use crate::rounding;
use crate::units::LARGEST_NUMBER;

/// From which size an effect would have been seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Detectability {
    /// Above this, in the parameter's unit.
    Above(f64),
    /// At any: there is no noise that it could hide in.
    AtAnySize,
    /// At none: these poses do not show it, however large it is.
    AtNoSize,
}

impl Detectability {
    /// The meaning of a detection limit.
    pub fn of(size: f64) -> Self {
        match size {
            size if size < rounding::COMPUTED => Self::AtAnySize,
            size if size <= LARGEST_NUMBER => Self::Above(size),
            // NaN belongs here as well.
            _ => Self::AtNoSize,
        }
    }
}

/// What one effect would have had to be.
#[derive(Debug, Clone, PartialEq)]
pub struct Limit {
    /// The effect's name.
    pub effect: &'static str,
    /// Joint, counted from 0; `None` where it belongs to none.
    pub joint: Option<usize>,
    /// For each parameter its name and the size above which it would have been detected; [`Detectability::of`] gives
    /// the meaning of a size.
    pub sizes: Vec<(&'static str, f64)>,
}
