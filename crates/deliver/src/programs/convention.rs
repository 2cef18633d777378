//! Joint values as a file has them, and as the model counts them.
//!
//! A session can have been measured with a set-up error that was found and corrected (a joint's sign, its
//! home, the order of joints, a unit, a coupling). The model counts joints the corrected way, its controller
//! still the raw way: what a program says is raw, and what is written into it has to be raw again. This is
//! the one place where the two meet: everything in front of it is raw, everything behind it the model's.
//! Positions and orientations are the same in both.

use crate::kinematics::Robot;
use crate::model::{Calibration, SetUp};

/// How raw joint values become those of the model. Without corrections of the set-up they are the same.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Convention<'m> {
    robot: &'m Robot,
    set_up: &'m SetUp,
}

impl<'m> Convention<'m> {
    /// That of a model's session.
    pub(super) fn of(calibration: &'m Calibration) -> Self {
        Self {
            robot: &calibration.model.robot,
            set_up: &calibration.set_up,
        }
    }

    /// Raw joint values (rad or mm, one for each joint) become the model's.
    pub(super) fn to_model(self, q: &mut [f64]) {
        self.set_up.to_model(self.robot, q);
    }

    /// The model's joint values (rad or mm, one for each joint) become raw ones.
    pub(super) fn to_raw(self, q: &mut [f64]) {
        self.set_up.to_raw(self.robot, q);
    }

    /// Sides from which joints come (+1, −1, 0; raw) become the model's: a reversed joint comes from the
    /// other one.
    pub(super) fn sides_to_model(self, sides: &mut [Option<f64>]) {
        if !self.set_up.moves_joints() {
            return;
        }
        let mut signs: Vec<f64> = sides.iter().map(|side| side.unwrap_or(0.0)).collect();
        self.set_up.signs_to_model(&mut signs);
        for (side, sign) in sides.iter_mut().zip(signs) {
            *side = (sign != 0.0).then_some(sign);
        }
    }
}
