//! Values of which the `robot` object is made, whatever it is given as.

use crate::document::kinds::{NUMBER, TEXT, VECTOR, point, wxyz};
use crate::document::object::{Kind, Object, written};
use crate::kinematics::{JointKind, Pose, Range};
use crate::text::Text;
use nalgebra::{Point3, Quaternion, UnitQuaternion};

use super::unit;

/// Limits that a file says.
pub(super) fn range(kind: JointKind, ends: [f64; 2]) -> Range {
    let [from, to] = ends.map(|end| kind.to_base_units(end));
    Range { from, to }
}

/// Whether a joint turns or slides.
pub(super) const JOINT_KIND: Kind<JointKind> = Kind {
    expected: TEXT.expected,
    read: |at| {
        at.one_of(
            &[JointKind::Revolute, JointKind::Prismatic],
            JointKind::name,
        )
    },
    write: |kind| kind.name().into(),
};

/// Two numbers, the smaller first.
pub(super) const ENDS: Kind<[f64; 2]> = Kind {
    expected: phrase!("an array of 2 numbers"),
    read: |at| {
        let [from, to] = at.numbers::<2>()?;
        if from >= to {
            let found = text!("limits from {from} to {to}", from, to);
            return at.error(found, text!("a range from the smaller to the larger value"));
        }
        Some([from, to])
    },
    write: |ends| (*ends).into(),
};

/// A pose at home, in the base frame.
pub const POSE: Kind<Pose> = Kind {
    expected: phrase!("an object"),
    read: |at| at.object(Pose::identity(), pose),
    write: |own| written(*own, pose),
};

fn pose(o: &mut Object<'_, '_>, own: &mut Pose) {
    o.required("position_mm", &mut own.translation.vector, &VECTOR);
    o.required("quaternion_wxyz", &mut own.rotation, &QUATERNION);
}

const QUATERNION: Kind<UnitQuaternion<f64>> = Kind {
    expected: phrase!("an array of 4 numbers: w, x, y, z"),
    read: |at| {
        let Some([w, x, y, z]) = unit(at.numbers::<4>()?) else {
            return at.error(text!("zero length"), Text::verbatim("[1, 0, 0, 0]"));
        };
        Some(UnitQuaternion::new_unchecked(Quaternion::new(w, x, y, z)))
    },
    write: wxyz,
};

pub(super) const MASS: Kind<f64> = Kind {
    expected: phrase!("a mass of 0 kg or more"),
    read: |at| {
        let mass = NUMBER.read(at.fields, at.node, at.path)?;
        if mass < 0.0 { at.wrong() } else { Some(mass) }
    },
    write: NUMBER.write,
};

pub(super) const CENTRE: Kind<Point3<f64>> = point(VECTOR.expected);
