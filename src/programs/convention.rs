//! Joint values as a file has them, and as the model counts them.
//!
//! A session can have been measured with a set-up error that was found and corrected (a joint's sign, its
//! home, the order of joints, a unit, a coupling). The model counts joints the corrected way, its controller
//! still the raw way: what a program says is raw, and what is written into it has to be raw again. This is
//! the one place where the two meet: everything in front of it is raw, everything behind it the model's.
//! Positions and orientations are the same in both.

use crate::model::Calibration;

/// How raw joint values become those of the model. Without corrections of the set-up they are the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Convention;

impl Convention {
    /// That of a model's session.
    pub(super) fn of(_calibration: &Calibration) -> Self {
        Self
    }

    /// Raw joint values (rad or mm, one for each joint) become the model's.
    #[allow(
        clippy::unused_self,
        reason = "a convention without corrections has nothing to do"
    )]
    pub(super) fn to_model(self, _q: &mut [f64]) {}

    /// The model's joint values (rad or mm, one for each joint) become raw ones.
    #[allow(
        clippy::unused_self,
        reason = "a convention without corrections has nothing to do"
    )]
    pub(super) fn to_raw(self, _q: &mut [f64]) {}

    /// Sides from which joints come (+1, −1, 0; raw) become the model's: a reversed joint comes from the
    /// other one.
    #[allow(
        clippy::unused_self,
        reason = "a convention without corrections has nothing to do"
    )]
    pub(super) fn sides_to_model(self, _sides: &mut [Option<f64>]) {}
}
