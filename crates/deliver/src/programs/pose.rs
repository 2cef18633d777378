//! A pose as the numbers of a file: position, and orientation in the maker's convention.

use nalgebra::{Point3, Quaternion, Rotation3, UnitQuaternion, Vector3};

use crate::kinematics::Pose;
use crate::kinematics::inverse::Goal;
use crate::text::Text;

use super::number::Number;

/// How an orientation is written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Orientation {
    /// q1 … q4 or qw … qz: the scalar first.
    Quaternion,
    /// A, B, C in degrees: `R_z(A) R_y(B) R_x(C)` (KUKA).
    ZyxDegrees,
    /// W, P, R in degrees: the same turns named the other way round, `R_z(R) R_y(P) R_x(W)` (FANUC).
    XyzFixedDegrees,
    /// A rotation vector in rad (Universal Robots).
    RotationVector,
    /// It is not given.
    Free,
}

impl Orientation {
    /// A position in mm and, perhaps, an orientation in a language's numbers or as a quaternion; `option` is where
    /// they were stated.
    ///
    /// # Errors
    /// What is wrong with the numbers.
    pub fn stated(self, option: &str, numbers: &[f64]) -> Result<Pose, Text> {
        let wrong = |found: Text| {
            let expected =
                text!("X,Y,Z or X,Y,Z and three angles or a quaternion, all numbers finite");
            text!(
                "{option}: {found}; expected {expected}",
                option,
                found,
                expected
            )
        };
        if !numbers.iter().all(|number| number.is_finite()) {
            return Err(wrong(text!("a number that is not finite")));
        }
        let (at, turn) = match numbers {
            [x, y, z] => ([*x, *y, *z], &[0.0; 3][..]),
            [x, y, z, turn @ ..] if matches!(turn.len(), 3 | 4) => ([*x, *y, *z], turn),
            _ => {
                return Err(wrong(
                    text!(one "{count} number", "{count} numbers", count = numbers.len()),
                ));
            }
        };
        let turn = self.read(turn);
        let turn = turn.ok_or_else(|| wrong(text!("zero length")))?;
        Ok(Pose::from_parts(at.into(), turn))
    }

    /// The orientation that three numbers (angles) or four (a quaternion) mean; `None` of another count, or
    /// of a quaternion without length. Three numbers of a language that writes quaternions are
    /// `R_z(A) R_y(B) R_x(C)` in degrees.
    pub fn read(self, numbers: &[f64]) -> Option<UnitQuaternion<f64>> {
        match (self, numbers) {
            (_, [w, x, y, z]) => {
                let quaternion = Quaternion::new(*w, *x, *y, *z);
                let length = quaternion.norm();
                let good = length.is_finite() && length > 0.0;
                good.then(|| UnitQuaternion::new_normalize(quaternion))
            }
            (Self::RotationVector, [x, y, z]) => {
                Some(UnitQuaternion::new(Vector3::new(*x, *y, *z)))
            }
            (Self::XyzFixedDegrees, [w, p, r]) => Some(turned(*w, *p, *r)),
            (_, [a, b, c]) => Some(turned(*c, *b, *a)),
            _ => None,
        }
    }

    /// An orientation as the language writes it: what its numbers are called, the numbers, their unit.
    pub fn numbers(self, pose: &Pose) -> (&'static [&'static str], Vec<f64>, &'static str) {
        match self {
            Self::Quaternion => {
                let q = pose.rotation.quaternion();
                let sign = if q.w < 0.0 { -1.0 } else { 1.0 };
                let numbers = [q.w, q.i, q.j, q.k].map(|v| sign * v);
                (&["QW", "QX", "QY", "QZ"], numbers.to_vec(), "")
            }
            Self::RotationVector => {
                let vector = crate::kinematics::quaternion::log(&pose.rotation);
                let numbers = vector.iter().copied().collect();
                (&["RX", "RY", "RZ"], numbers, " rad")
            }
            Self::XyzFixedDegrees => {
                let numbers = nearest_angles(&pose.rotation, [0.0; 3]);
                (&["W", "P", "R"], numbers, "°")
            }
            Self::ZyxDegrees | Self::Free => {
                let mut numbers = nearest_angles(&pose.rotation, [0.0; 3]);
                numbers.reverse();
                (&["A", "B", "C"], numbers, "°")
            }
        }
    }
}

/// The numbers of a pose.
#[derive(Debug, Clone, PartialEq)]
pub struct Frame {
    /// x, y, z.
    pub position: [Number; 3],
    /// mm in one of the file's units of length.
    pub mm: [f64; 3],
    /// As many numbers as the convention has.
    pub turn: Vec<Number>,
    /// How they are to be read.
    pub orientation: Orientation,
}

/// From here on the squares of a quaternion's numbers are so far from 1 that the maker's own normalising (`NOrient`)
/// takes it for an error.
const LENGTH_OFF: f64 = 0.1;

/// Digits that keep a micrometre in a number of so many mm.
fn decimals_of(mm: f64) -> usize {
    // 10⁻⁴ mm.
    if mm >= 1000.0 {
        7
    } else if mm > 1.0 {
        6
    } else {
        4
    }
}

impl Frame {
    /// x, y, z in mm and three angles in degrees.
    pub(super) fn of_degrees([x, y, z, a, b, c]: [Number; 6], orientation: Orientation) -> Self {
        Self {
            position: [x, y, z],
            mm: [1.0; 3],
            turn: vec![a, b, c],
            orientation,
        }
    }

    /// Where a quaternion stands whose length is no rounding of 1, and its length.
    pub(super) fn wrong_length(&self) -> Option<(usize, f64)> {
        let squares: f64 = self.turn.iter().map(|n| n.value * n.value).sum();
        let at = self.turn.first()?.range().start;
        ((squares - 1.0).abs() > LENGTH_OFF).then(|| (at, squares.sqrt()))
    }

    /// Where the numbers put the tool; `None` where a quaternion has no length.
    pub fn goal(&self) -> Option<Goal> {
        let at = |k: usize| self.position[k].value * self.mm[k];
        let turn: Vec<f64> = self.turn.iter().map(|n| n.value).collect();
        // A quaternion with three digits is not quite of unit length; an empty one is none.
        let squares: f64 = turn.iter().map(|v| v * v).sum();
        if self.orientation == Orientation::Quaternion && squares.sqrt() < 0.5 {
            return None;
        }
        let rotation = self.orientation.read(&turn);
        Some(Goal {
            position_mm: Point3::new(at(0), at(1), at(2)),
            rotation,
        })
    }

    /// The numbers as a pose; `None` where there is no orientation.
    pub(super) fn pose(&self) -> Option<Pose> {
        let goal = self.goal()?;
        Some(Pose::from_parts(
            goal.position_mm.coords.into(),
            goal.rotation?,
        ))
    }

    /// The numbers of another pose, in the order of the file, each with the digits it needs at least.
    /// Of the ways to write a pose it is the one nearest to the numbers that were there.
    pub(super) fn values(&self, pose: &Pose) -> Vec<(&Number, f64, usize)> {
        let at = pose.translation.vector;
        let position = (0..3).map(|k| {
            let number = &self.position[k];
            (number, at[k] / self.mm[k], decimals_of(self.mm[k]))
        });
        let turn = self.turn_values(pose);
        let decimals = match self.orientation {
            Orientation::Quaternion => 8,
            Orientation::RotationVector => 7,
            _ => 5,
        };
        let turn = self.turn.iter().zip(turn);
        position
            .chain(turn.map(|(number, value)| (number, value, decimals)))
            .collect()
    }

    fn turn_values(&self, pose: &Pose) -> Vec<f64> {
        let before: Vec<f64> = self.turn.iter().map(|n| n.value).collect();
        match self.orientation {
            Orientation::Free => Vec::new(),
            Orientation::Quaternion => {
                let q = pose.rotation.quaternion();
                let now = [q.w, q.i, q.j, q.k];
                let same: f64 = now.iter().zip(&before).map(|(a, b)| a * b).sum();
                now.iter().map(|v| v * same.signum()).collect()
            }
            Orientation::RotationVector => nearest_vector(&pose.rotation, &before),
            Orientation::ZyxDegrees => {
                let mut angles = nearest_angles(&pose.rotation, [before[2], before[1], before[0]]);
                angles.reverse();
                angles
            }
            Orientation::XyzFixedDegrees => {
                nearest_angles(&pose.rotation, [before[0], before[1], before[2]])
            }
        }
    }
}

/// `R_z(z) R_y(y) R_x(x)`, degrees.
fn turned(x: f64, y: f64, z: f64) -> UnitQuaternion<f64> {
    UnitQuaternion::from_euler_angles(x.to_radians(), y.to_radians(), z.to_radians())
}

/// x, y, z of `R_z R_y R_x` in degrees, of all that mean the same the ones nearest to `before`.
fn nearest_angles(rotation: &UnitQuaternion<f64>, before: [f64; 3]) -> Vec<f64> {
    let matrix = rotation.to_rotation_matrix();
    let m = matrix.matrix();
    let across = m[(0, 0)].hypot(m[(1, 0)]);
    let y = (-m[(2, 0)]).atan2(across).to_degrees();
    let [x, z] = if across > 1e-9 {
        [m[(2, 1)].atan2(m[(2, 2)]), m[(1, 0)].atan2(m[(0, 0)])].map(f64::to_degrees)
    } else {
        // Straight up or down x and z turn about the same axis: x stays as it was.
        let back = Rotation3::from_axis_angle(&Vector3::x_axis(), -before[0].to_radians());
        let rest = matrix * back;
        let m = rest.matrix();
        [before[0], (-m[(0, 1)]).atan2(m[(1, 1)]).to_degrees()]
    };
    let wound = |angle: f64, near: f64| angle - 360.0 * ((angle - near) / 360.0).round();
    let candidates = [[x, y, z], [x + 180.0, 180.0 - y, z + 180.0]];
    let candidates = candidates.map(|c| [0, 1, 2].map(|k| wound(c[k], before[k])));
    let far = |c: &[f64; 3]| -> f64 { c.iter().zip(before).map(|(a, b)| (a - b).powi(2)).sum() };
    let best = usize::from(far(&candidates[1]) < far(&candidates[0]));
    candidates[best].to_vec()
}

/// A rotation vector, of all that mean the same the one nearest to `before`.
fn nearest_vector(rotation: &UnitQuaternion<f64>, before: &[f64]) -> Vec<f64> {
    use std::f64::consts::TAU;
    let now = crate::kinematics::quaternion::log(rotation);
    let length = now.norm();
    if length < 1e-12 {
        return now.iter().copied().collect();
    }
    let far =
        |v: &Vector3<f64>| -> f64 { v.iter().zip(before).map(|(a, b)| (a - b).powi(2)).sum() };
    let turns = [0.0, -TAU, TAU].map(|by| now * ((length + by) / length));
    let mut best = turns[0];
    for turn in turns {
        if far(&turn) < far(&best) {
            best = turn;
        }
    }
    best.iter().copied().collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn number(value: f64) -> Number {
        let text = format!("{value:?}");
        Number::read(text.as_bytes(), 0..text.len(), false).unwrap()
    }

    fn frame(orientation: Orientation, turn: &[f64]) -> Frame {
        Frame {
            position: [1.0, 2.0, 3.0].map(number),
            mm: [1.0; 3],
            turn: turn.iter().map(|v| number(*v)).collect(),
            orientation,
        }
    }

    #[test]
    fn conventions_are_those_of_the_makers() {
        // KUKA: A about z, then B about the new y, then C about the new x.
        let kuka = frame(Orientation::ZyxDegrees, &[90.0, 0.0, 0.0])
            .goal()
            .unwrap();
        let x = kuka.rotation.unwrap() * Vector3::x();
        assert!((x - Vector3::y()).norm() < 1e-12);
        // FANUC: W about x first, in the fixed frame.
        let fanuc = frame(Orientation::XyzFixedDegrees, &[90.0, 0.0, 90.0])
            .goal()
            .unwrap();
        let y = fanuc.rotation.unwrap() * Vector3::y();
        assert!((y - Vector3::z()).norm() < 1e-12);
        let x = fanuc.rotation.unwrap() * Vector3::x();
        assert!((x - Vector3::y()).norm() < 1e-12);
        assert!(frame(Orientation::Quaternion, &[0.0; 4]).goal().is_none());
    }

    proptest! {
        #[test]
        fn what_is_written_reads_back_and_stays_near(turn in prop::collection::vec(-3.0..3.0f64, 3), by in prop::collection::vec(-0.01..0.01f64, 3)) {
            for (orientation, scale) in [
                (Orientation::ZyxDegrees, 57.3),
                (Orientation::XyzFixedDegrees, 57.3),
                (Orientation::RotationVector, 1.0),
            ] {
                let numbers: Vec<f64> = turn.iter().map(|v| v * scale).collect();
                let frame = frame(orientation, &numbers);
                let here = frame.goal().unwrap().rotation.unwrap();
                let small = UnitQuaternion::new(Vector3::new(by[0], by[1], by[2]));
                let pose = Pose::from_parts(Vector3::zeros().into(), small * here);
                let values = frame.turn_values(&pose);
                let again = Frame { turn: values.iter().map(|v| number(*v)).collect(), ..frame };
                let back = again.goal().unwrap().rotation.unwrap();
                prop_assert!(back.angle_to(&pose.rotation) < 1e-7);
            }
        }
    }

    #[test]
    fn straight_down_the_angles_do_not_jump() {
        let down = frame(Orientation::ZyxDegrees, &[30.0, 90.0, 10.0]);
        let pose = Pose::from_parts(
            Vector3::zeros().into(),
            down.goal().unwrap().rotation.unwrap(),
        );
        let values = down.turn_values(&pose);
        for (value, before) in values.iter().zip([30.0, 90.0, 10.0]) {
            assert!((value - before).abs() < 1e-5, "{values:?}");
        }
    }
}
