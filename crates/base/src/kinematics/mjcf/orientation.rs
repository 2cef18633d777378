//! Orientations as MJCF writes them: `quat`, `axisangle`, `euler`, `xyaxes` or `zaxis`.
//!
//! ```text
//! euler, eulerseq a b c:   lower case  R = R_a R_b R_c     turned with the body
//!                          upper case  R = R_c R_b R_a     about the axes of the parent
//! ```

use nalgebra::{Matrix3, Quaternion, Rotation3, Unit, UnitQuaternion, Vector3};

use crate::diagnostic::Rejected;
use crate::rounding;

use super::super::xml::Document;

/// The attributes of `compiler` for angles.
#[derive(Debug)]
pub(super) struct Angles {
    radians: bool,
    /// Axis of each turn, and whether it is the parent's.
    sequence: [(usize, bool); 3],
}

impl Default for Angles {
    fn default() -> Self {
        Self {
            radians: false,
            sequence: [(0, false), (1, false), (2, false)],
        }
    }
}

impl Angles {
    /// Takes over the attributes of a `compiler` element.
    ///
    /// # Errors
    /// Another unit or sequence than there are.
    pub(super) fn read(&mut self, document: &Document, compiler: usize) -> Result<(), Rejected> {
        match document.attribute(compiler, "angle") {
            None => {}
            Some("radian") => self.radians = true,
            Some("degree") => self.radians = false,
            Some(_) => {
                return Err(document.refuse_value(compiler, "angle", text!("degree or radian")));
            }
        }
        if let Some(text) = document.attribute(compiler, "eulerseq") {
            let axis = |letter: char| {
                let place = "xyz".find(letter.to_ascii_lowercase())?;
                Some((place, letter.is_ascii_uppercase()))
            };
            let turns: Option<Vec<(usize, bool)>> = text.chars().map(axis).collect();
            let turns = turns.and_then(|turns| <[(usize, bool); 3]>::try_from(turns).ok());
            self.sequence = turns.ok_or_else(|| {
                let expected = text!("three of x, y, z, X, Y, Z");
                document.refuse_value(compiler, "eulerseq", expected)
            })?;
        }
        Ok(())
    }

    /// Radians in the file's unit of angle.
    pub(super) fn unit(&self) -> f64 {
        if self.radians {
            1.0
        } else {
            1_f64.to_radians()
        }
    }

    /// The orientation of the first of these elements that states one.
    ///
    /// # Errors
    /// Two of them in one element, numbers that are none, directions of zero length.
    pub(super) fn rotation(
        &self,
        document: &Document,
        levels: &[usize],
    ) -> Result<UnitQuaternion<f64>, Rejected> {
        const KINDS: [&str; 5] = ["quat", "axisangle", "euler", "xyaxes", "zaxis"];
        for &element in levels {
            let said = |name: &&str| document.attribute(element, name).is_some();
            let given: Vec<&str> = KINDS.into_iter().filter(said).collect();
            match given[..] {
                [] => {}
                [name] => return self.one(document, element, name),
                [first, second, ..] => {
                    let found = text!("both {first} and {second}", first, second);
                    return Err(document.refuse(element, found, text!("one orientation")));
                }
            }
        }
        Ok(UnitQuaternion::identity())
    }

    fn one(
        &self,
        document: &Document,
        element: usize,
        name: &str,
    ) -> Result<UnitQuaternion<f64>, Rejected> {
        let no_direction =
            || document.refuse_value(element, name, text!("directions of non-zero length"));
        let unit = |v: Vector3<f64>| Unit::try_new(v, rounding::COMPUTED).ok_or_else(no_direction);
        match name {
            "quat" => {
                let [w, x, y, z] = document.numbers(element, name)?.unwrap_or_default();
                let quaternion = Quaternion::new(w, x, y, z);
                UnitQuaternion::try_new(quaternion, rounding::COMPUTED).ok_or_else(|| {
                    document.refuse_value(element, name, text!("a quaternion of non-zero length"))
                })
            }
            "axisangle" => {
                let [x, y, z, angle] = document.numbers(element, name)?.unwrap_or_default();
                let axis = unit(Vector3::new(x, y, z))?;
                Ok(UnitQuaternion::from_axis_angle(&axis, angle * self.unit()))
            }
            "euler" => {
                let angles = document.numbers::<3>(element, name)?.unwrap_or_default();
                let mut all = UnitQuaternion::identity();
                for (angle, (axis, of_parent)) in angles.into_iter().zip(self.sequence) {
                    let axis = Unit::new_unchecked(Vector3::ith(axis, 1.0));
                    let turn = UnitQuaternion::from_axis_angle(&axis, angle * self.unit());
                    all = if of_parent { turn * all } else { all * turn };
                }
                Ok(all)
            }
            "xyaxes" => {
                let [a, b, c, d, e, f] = document.numbers(element, name)?.unwrap_or_default();
                let x = unit(Vector3::new(a, b, c))?.into_inner();
                let y = Vector3::new(d, e, f);
                let y = unit(y - x * x.dot(&y))?.into_inner();
                let matrix = Matrix3::from_columns(&[x, y, x.cross(&y)]);
                let rotation = Rotation3::from_matrix_unchecked(matrix);
                Ok(UnitQuaternion::from_rotation_matrix(&rotation))
            }
            _ => {
                let z = document.numbers::<3>(element, "zaxis")?.unwrap_or_default();
                let z = unit(Vector3::from(z))?.into_inner();
                // The smallest turn; straight down it is half a turn about x.
                let turn = UnitQuaternion::rotation_between(&Vector3::z(), &z);
                let down =
                    UnitQuaternion::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI);
                Ok(turn.unwrap_or(down))
            }
        }
    }
}
