//! Kinds of values that documents have in common.

use nalgebra::{Point3, Unit, UnitQuaternion, Vector3};

use super::object::Kind;
use super::{Value, degrees};
use crate::text::Template;
use crate::units::rad_from_deg;

pub const TEXT: Kind<String> = Kind {
    expected: phrase!("a text"),
    read: |at| match &at.node.value {
        Value::Text(text) => Some(text.clone()),
        _ => at.wrong(),
    },
    write: |text| text.into(),
};

/// A finite number, as it stands.
pub const NUMBER: Kind<f64> = Kind {
    expected: phrase!("a number"),
    read: |at| at.number(|_| true),
    write: |value| (*value).into(),
};

/// An angle: degrees in the file, rad in the program.
pub const DEGREES: Kind<f64> = Kind {
    expected: phrase!("a number"),
    read: |at| at.number(|_| true).map(rad_from_deg),
    write: |rad| degrees(*rad).into(),
};

/// A number above 0.
pub const fn positive(expected: Template) -> Kind<f64> {
    Kind {
        expected,
        read: |at| at.number(|value| value > 0.0),
        write: |value| (*value).into(),
    }
}

/// A whole number from 0 on.
pub const fn count(expected: Template) -> Kind<usize> {
    Kind {
        expected,
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a whole number in the range of the type"
        )]
        read: |at| {
            let whole = |value: f64| value.fract() == 0.0 && (0.0..=1e15).contains(&value);
            at.number(whole).map(|value| value as usize)
        },
        write: |count| (*count).into(),
    }
}

/// A position, mm.
pub(crate) const fn point(expected: Template) -> Kind<Point3<f64>> {
    Kind {
        expected,
        read: |at| at.numbers::<3>().map(Point3::from),
        write: |point| <[f64; 3]>::from(point.coords).into(),
    }
}

/// Three numbers.
pub const VECTOR: Kind<Vector3<f64>> = Kind {
    expected: phrase!("an array of 3 numbers"),
    read: |at| at.numbers::<3>().map(Vector3::from),
    write: |vector| <[f64; 3]>::from(*vector).into(),
};

/// What a direction is written as.
pub fn components(direction: &Unit<Vector3<f64>>) -> Value {
    <[f64; 3]>::from(direction.into_inner()).into()
}

/// What an attitude is written as: w, x, y, z.
pub fn wxyz(attitude: &UnitQuaternion<f64>) -> Value {
    [attitude.w, attitude.i, attitude.j, attitude.k].into()
}
