//! The conditions for which a correction is valid.
//!
//! A table knows only the command and the direction of travel, so it is made for one set of
//! conditions: the reference is standstill, 20 °C and no load, long after the last reversal (lost
//! motion has fully built up).

use std::borrow::Cow;

use crate::effects::Inputs;
use crate::effects::inputs::REFERENCE_TEMPERATURE_C;

/// Side from which the joint comes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// Moving towards larger values.
    Forward,
    /// Moving towards smaller values.
    Reverse,
    /// Not known: effects of the side are left out.
    Unknown,
}

impl Side {
    /// The side from which a joint comes that counts the other way.
    #[must_use]
    pub fn reversed(self) -> Self {
        match self {
            Self::Forward => Self::Reverse,
            Self::Reverse => Self::Forward,
            Self::Unknown => Self::Unknown,
        }
    }

    /// +1, −1 or 0.
    pub fn sign(self) -> f64 {
        match self {
            Self::Forward => 1.0,
            Self::Reverse => -1.0,
            Self::Unknown => 0.0,
        }
    }
}

/// Load, temperature, speed and direction of approach for which a correction is computed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Conditions {
    /// Speed of every joint while it passes, without sign, rad/s or mm/s.
    pub speed: f64,
    /// Load at the tool's origin, kg.
    pub load_kg: f64,
    /// Temperature, °C.
    pub temperature_c: f64,
}

impl Default for Conditions {
    fn default() -> Self {
        Self {
            speed: 0.0,
            load_kg: 0.0,
            temperature_c: REFERENCE_TEMPERATURE_C,
        }
    }
}

impl Conditions {
    /// Poses under these conditions, every joint approached from the same side.
    pub fn inputs(
        &self,
        q: Vec<Vec<f64>>,
        side: Side,
        reflectors_at_home: Vec<[f64; 3]>,
    ) -> Inputs<'static> {
        let mut inputs = Inputs::at_poses(q, reflectors_at_home);
        let n = inputs.len();
        let constant = |value: f64| Some(Cow::Owned(vec![value; n]));
        inputs.dir.fill(constant(side.sign()));
        inputs.speed.fill(constant(side.sign() * self.speed));
        inputs.load_kg = constant(self.load_kg);
        inputs.above_20_c = Some(vec![self.temperature_c - REFERENCE_TEMPERATURE_C; n]);
        inputs
    }

    /// The poses of a session as a table treats them: their own commands and sides, and otherwise these conditions.
    pub fn impose_on(&self, inputs: &Inputs) -> Inputs<'static> {
        let own = |column: &Cow<[f64]>| column.clone().into_owned();
        let q = inputs.q.iter().map(own).collect();
        let mut imposed = self.inputs(q, Side::Unknown, inputs.reflectors_at_home.clone());
        for (joint, dir) in inputs.dir.iter().enumerate() {
            if let Some(dir) = dir {
                let speed = dir.iter().map(|side| side * self.speed).collect();
                imposed.speed[joint] = Some(Cow::Owned(speed));
                imposed.dir[joint] = Some(Cow::Owned(own(dir)));
            }
        }
        imposed
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_speed_has_the_sign_of_the_side_that_a_pose_is_reached_from() {
        let conditions = Conditions {
            speed: 0.3,
            load_kg: 4.0,
            temperature_c: 25.0,
        };
        let sides = [
            (Side::Forward, 1.0),
            (Side::Reverse, -1.0),
            (Side::Unknown, 0.0),
        ];
        for (side, sign) in sides {
            let inputs = conditions.inputs(vec![vec![0.1, 0.2]], side, vec![[0.0; 3]]);
            assert_eq!(inputs.dir[0].as_deref(), Some(&[sign; 2][..]));
            assert_eq!(inputs.speed[0].as_deref(), Some(&[0.3 * sign; 2][..]));
            assert_eq!(inputs.load_kg.as_deref(), Some(&[4.0; 2][..]));
            assert_eq!(inputs.above_20_c.as_deref(), Some(&[5.0; 2][..]));
        }
    }
}
