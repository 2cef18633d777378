//! Orientations as three angles or as a rotation vector, made into quaternions.
//!
//! Three angles mean nothing without the order of their axes and without what the axes do: about
//! fixed axes each turn is about an axis of the measuring frame, so that the first one acts first;
//! about moving axes it is about an axis that the turns before it have carried along.
//!
//! ```text
//! xyz-fixed:  R = Rz(rz) Ry(ry) Rx(rx)      zyx-moving: the same matrix
//! xyz-moving: R = Rx(rx) Ry(ry) Rz(rz)      zyx-fixed:  the same matrix
//! rotvec:     R = exp([rx, ry, rz]×)
//! ```
//!
//! Columns are named by their axis (`rx_deg, ry_deg, rz_deg`) or by their turn (`euler1_deg` is the
//! first of the order). Where an axis recurs (`zyz`) only the turn names a column, so that `rx, ry, rz`
//! are then taken as the first, second and third.

use crate::text::{Template, Text};
use nalgebra::{Quaternion, Unit as Direction, UnitQuaternion, Vector3};

use super::options::EULER;
use super::turns::Turn;
use crate::importers::columns::Columns;
use crate::importers::role::Role;
use crate::importers::settings::{About, ReadContext, wrong_value};
use crate::sessions::columns::Quantity;

/// How three numbers make an orientation.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Convention {
    /// The direction is the axis, the length the angle.
    RotationVector,
    /// Turns about these axes (0 to 2) in this order; about axes that the turns before have carried
    /// along, or about those of the frame.
    Euler {
        /// Axes in the order of the turns.
        order: [usize; 3],
        /// Whether the axes move.
        moving: bool,
    },
}

/// What an answer to `--euler` is.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Answer {
    /// It says everything.
    Known(Convention),
    /// The order is there, but not whether the axes move.
    Axes(String),
    /// Nothing that is understood.
    Wrong,
}

/// Reads `xyz-fixed`, `ZYX-moving`, `zyz-moving`, `rotvec`, `rpy`.
pub(crate) fn read(answer: &str) -> Answer {
    let plain = answer.trim().to_lowercase().replace(['_', ' '], "-");
    match plain.as_str() {
        "rotvec" | "rotation-vector" | "axis-angle" => {
            return Answer::Known(Convention::RotationVector);
        }
        "rpy" => {
            return Answer::Known(Convention::Euler {
                order: [0, 1, 2],
                moving: false,
            });
        }
        _ => {}
    }
    let (letters, moving) = match plain.split_once('-') {
        None => (plain.as_str(), None),
        Some((letters, "fixed" | "extrinsic" | "static")) => (letters, Some(false)),
        Some((letters, "moving" | "intrinsic" | "rotating")) => (letters, Some(true)),
        Some(_) => return Answer::Wrong,
    };
    let axes: Option<Vec<usize>> = letters.chars().map(|c| "xyz".find(c)).collect();
    let Some([first, second, third]) = axes
        .as_deref()
        .and_then(|axes| <[usize; 3]>::try_from(axes).ok())
    else {
        return Answer::Wrong;
    };
    // Two turns about one axis in a row are one turn.
    if first == second || second == third {
        return Answer::Wrong;
    }
    match moving {
        Some(moving) => Answer::Known(Convention::Euler {
            order: [first, second, third],
            moving,
        }),
        None => Answer::Axes(letters.to_owned()),
    }
}

impl Convention {
    /// The orientation of three angles in the order of their columns x, y, z (`by_axis`) or first,
    /// second, third; rad.
    pub(crate) fn orientation(self, angles: [f64; 3], by_axis: bool) -> UnitQuaternion<f64> {
        match self {
            Self::RotationVector => UnitQuaternion::from_scaled_axis(Vector3::from(angles)),
            Self::Euler { order, moving } => {
                let recurs = order[0] == order[2];
                let mut all = UnitQuaternion::identity();
                for (turn, &axis) in order.iter().enumerate() {
                    let angle = if by_axis && !recurs {
                        angles[axis]
                    } else {
                        angles[turn]
                    };
                    let direction = Direction::new_unchecked(Vector3::ith(axis, 1.0));
                    let one = UnitQuaternion::from_axis_angle(&direction, angle);
                    all = if moving { all * one } else { one * all };
                }
                all
            }
        }
    }

    /// The convention and its product, for a note.
    pub(crate) fn describe(self) -> Text {
        match self {
            Self::RotationVector => {
                text!(
                    "the orientation is a rotation vector: its direction the axis, its length the angle"
                )
            }
            Self::Euler { order, moving } => {
                let letters: Vec<&str> = order.iter().map(|axis| ["x", "y", "z"][*axis]).collect();
                let mut factors: Vec<String> =
                    letters.iter().map(|axis| format!("R{axis}")).collect();
                if !moving {
                    factors.reverse();
                }
                let product = factors.join(" · ");
                text!("the orientation is three angles: R = {product}", product)
            }
        }
    }
}

/// The columns of angles among these, in the order x, y, z or first, second, third, and whether they
/// are named by axis; `None` where there is none. The error says what is missing.
pub(crate) fn columns_of(roles: &[Role]) -> Option<Result<([usize; 3], bool), Text>> {
    let mut found = [None; 3];
    let mut named = [false; 2];
    for (index, role) in roles.iter().enumerate() {
        if let Role::Turn(turn, _) = role {
            found[turn.place()].get_or_insert(index);
            named[usize::from(matches!(turn, Turn::About(_)))] = true;
        }
    }
    let [by_turn, by_axis] = named;
    if !by_turn && !by_axis {
        return None;
    }
    let [Some(a), Some(b), Some(c)] = found else {
        let count = found.iter().flatten().count();
        return Some(Err(text!(
            "{count} of the {all} numbers of an orientation",
            count,
            all = 3
        )));
    };
    if by_turn && by_axis {
        return Some(Err(text!("angles named by axis and angles named by turn")));
    }
    Some(Ok(([a, b, c], by_axis)))
}

const OPEN: Template = phrase!(
    "three angles of an orientation, and the order of their axes, or whether these move, is not stated"
);

impl ReadContext<'_> {
    /// Angles of an orientation: how they are to be read is asked where the format can be told, and
    /// they are kept and ignored where it cannot.
    pub(crate) fn ask_about_angles(&mut self, roles: &mut [Role]) -> Option<Convention> {
        let found = columns_of(roles)?;
        let can_be_told = self.found.kind.is_some_and(|kind| {
            let mut options = kind.options.iter();
            options.any(|option| option.name == EULER)
        });
        if !can_be_told {
            for role in roles
                .iter_mut()
                .filter(|role| matches!(role, Role::Turn(..)))
            {
                *role = Role::Kept;
            }
            return None;
        }
        if let Err(found) = found {
            self.refuse(found, text!("rx, ry and rz, or euler1, euler2 and euler3; --columns with - for those that are to be ignored"));
            return None;
        }
        let quaternion = |role: &Role| matches!(role.quantity(), Some(Quantity::Orientation(_)));
        if roles.iter().any(quaternion) {
            self.ask(
                About::Columns,
                text!("the orientation is there as a quaternion and as angles"),
                &[],
            );
            return None;
        }
        let answer = self.reading.options.get(EULER).map(|answer| read(answer));
        match answer {
            Some(Answer::Known(convention)) => return Some(convention),
            Some(Answer::Axes(order)) => {
                let [fixed, moving] = ["fixed", "moving"].map(|axes| format!("{order}-{axes}"));
                self.ask(About::Own(EULER), OPEN, &[&fixed, &moving]);
            }
            Some(Answer::Wrong) => {
                self.refuse(
                    wrong_value(EULER, &self.reading.options[EULER]),
                    text!("an order of axes and whether they move, such as zyx-moving or xyz-fixed, or rotvec"),
                );
            }
            None => {
                self.ask(
                    About::Own(EULER),
                    OPEN,
                    &[
                        "xyz-fixed",
                        "zyx-moving",
                        "xyz-moving",
                        "zyz-moving",
                        "rotvec",
                    ],
                );
            }
        }
        None
    }
}

/// Replaces the three columns of angles by the four parts of a quaternion. A row that lacks one of
/// the angles has no orientation.
pub(crate) fn to_quaternions(columns: &mut Columns, convention: Convention) {
    let roles: Vec<Role> = columns.list.iter().map(|column| column.role).collect();
    let Some(Ok((at, by_axis))) = columns_of(&roles) else {
        return;
    };
    let angles = at.map(|index| columns.list[index].in_base_units().unwrap_or_default());
    let turned = (0..columns.rows()).map(|row| {
        let three = angles
            .each_ref()
            .map(|values| values.get(row).copied().unwrap_or(f64::NAN));
        if three.iter().all(|angle| angle.is_finite()) {
            convention.orientation(three, by_axis).into_inner()
        } else {
            [f64::NAN; 4].into()
        }
    });
    let turned: Vec<Quaternion<f64>> = turned.collect();
    columns
        .list
        .retain(|column| !matches!(column.role, Role::Turn(..)));
    columns.put_orientations(&turned);
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A rotation matrix as a textbook has it.
    fn matrix(axis: usize, angle: f64) -> nalgebra::Matrix3<f64> {
        let (s, c) = angle.sin_cos();
        let m = match axis {
            0 => [1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c],
            1 => [c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c],
            _ => [c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0],
        };
        nalgebra::Matrix3::from_row_slice(&m)
    }

    fn convention_of(answer: &str) -> Convention {
        match read(answer) {
            Answer::Known(convention) => convention,
            other => panic!("{answer}: {other:?}"),
        }
    }

    #[test]
    fn each_convention_is_the_product_that_its_note_says() {
        let [a, b, c] = [0.3, -0.7, 1.1];
        for (answer, by_axis, product) in [
            (
                "xyz-fixed",
                true,
                matrix(2, c) * matrix(1, b) * matrix(0, a),
            ),
            ("rpy", true, matrix(2, c) * matrix(1, b) * matrix(0, a)),
            (
                "zyx-moving",
                true,
                matrix(2, c) * matrix(1, b) * matrix(0, a),
            ),
            (
                "xyz-moving",
                true,
                matrix(0, a) * matrix(1, b) * matrix(2, c),
            ),
            (
                "zyx-moving",
                false,
                matrix(2, a) * matrix(1, b) * matrix(0, c),
            ),
            (
                "zyz-moving",
                true,
                matrix(2, a) * matrix(1, b) * matrix(2, c),
            ),
            (
                "ZYZ fixed",
                false,
                matrix(2, c) * matrix(1, b) * matrix(2, a),
            ),
        ] {
            let q = convention_of(answer).orientation([a, b, c], by_axis);
            let off = (q.to_rotation_matrix().into_inner() - product).norm();
            assert!(off < 1e-14, "{answer}: {off}");
        }
        let turned = convention_of("rotvec").orientation([0.0, 0.0, 0.5], true);
        assert!((turned.to_rotation_matrix().into_inner() - matrix(2, 0.5)).norm() < 1e-14);
    }

    #[test]
    fn an_order_alone_and_an_order_that_is_none_are_not_taken() {
        assert_eq!(read("zyx"), Answer::Axes("zyx".to_owned()));
        for wrong in ["xxy", "xy", "xyzz", "abc", "xyz-sideways", ""] {
            assert_eq!(read(wrong), Answer::Wrong, "{wrong}");
        }
    }
}
