//! The corrections of the set-up in a model; joints count from 1.

use crate::document::kinds::{NUMBER, TEXT, count};
use crate::document::object::{Cursor, Kind};
use crate::document::{Value, object};
use crate::model::SetUp;
use crate::sessions::SessionCorrection;
use crate::text::Template;

use super::of_samples::{numbers_of, numbers_of_rows, of_numbers, rows_of};

const EXPECTED: Template = phrase!(
    "an object with the key correction: scale-joint, scale-joints, exchange-joints, couple-joint, take-read-back, turn-home, scale-lengths, scale-coordinate, reorder or free-frame, or a correction of samples with its values"
);

pub(super) const SET_UP: Kind<SetUp> = Kind {
    expected: phrase!("an array of objects"),
    read: |at| at.list_by(correction).map(SetUp::new),
    write: |set_up| {
        let all = set_up.all().iter();
        all.map(correction_written).collect()
    },
};

const JOINT: Kind<usize> = count(phrase!("a joint, counted from 1"));
const AXIS: Kind<usize> = count(phrase!("the place of x, y or z: 1, 2 or 3"));

/// Everything that any of them may have.
struct Parts {
    correction: String,
    joint: usize,
    other: usize,
    axis: usize,
    factor: f64,
    by_rad: f64,
    order: [f64; 3],
    values: Vec<f64>,
    /// The first and the last of those that it is made in; none: of all.
    rows: Vec<f64>,
}

fn correction(at: &mut Cursor<'_, '_>) -> Option<SessionCorrection> {
    at.expected = EXPECTED.into();
    let blank = Parts {
        correction: String::new(),
        joint: 1,
        other: 1,
        axis: 1,
        factor: 1.0,
        by_rad: 0.0,
        order: [1.0, 2.0, 3.0],
        values: Vec::new(),
        rows: Vec::new(),
    };
    let parts = at.object(blank, |o, own| {
        o.required("correction", &mut own.correction, &TEXT);
        o.usual("joint", &mut own.joint, &JOINT);
        o.usual("other_joint", &mut own.other, &JOINT);
        o.usual("axis", &mut own.axis, &AXIS);
        o.usual("factor", &mut own.factor, &NUMBER);
        o.usual("by_rad", &mut own.by_rad, &NUMBER);
        o.usual("order", &mut own.order, &THREE);
        o.usual("values", &mut own.values, &VALUES);
        o.usual("rows", &mut own.rows, &VALUES);
    })?;
    parts.correction().or_else(|| at.wrong())
}

impl Parts {
    fn correction(&self) -> Option<SessionCorrection> {
        use SessionCorrection as Is;
        let (joint, other) = (self.joint.checked_sub(1)?, self.other.checked_sub(1)?);
        let (factor, by_rad) = (self.factor, self.by_rad);
        let name = self.correction.as_str();
        let needs_a_factor = matches!(
            name,
            "scale-joint" | "scale-joints" | "couple-joint" | "scale-lengths" | "scale-coordinate"
        );
        // For some rows zero states that the joint does not move what was measured; for all it has no inverse.
        if needs_a_factor && factor == 0.0 && self.rows.is_empty() {
            return None;
        }
        let correction = match name {
            "scale-joint" => Is::ScaleJoint { joint, factor },
            "scale-joints" => Is::ScaleJoints { factor },
            "exchange-joints" => {
                let (first, second) = (joint, other);
                Is::ExchangeJoints { first, second }
            }
            "couple-joint" => {
                let from = other;
                Is::CoupleJoint {
                    joint,
                    from,
                    factor,
                }
            }
            "take-read-back" => Is::TakeReadBack,
            "turn-home" => Is::TurnHome { joint, by_rad },
            "scale-lengths" => Is::ScaleLengths(factor),
            "scale-coordinate" => {
                let axis = self.axis.checked_sub(1).filter(|axis| *axis < 3)?;
                Is::ScaleCoordinate { axis, factor }
            }
            "reorder" => {
                let place = |from| [1.0, 2.0, 3.0].iter().position(|k| *k == from);
                let [x, y, z] = self.order.map(place);
                Is::Reorder([x?, y?, z?])
            }
            "free-frame" => Is::FreeFrame,
            name => of_numbers(name, &self.values)?,
        };
        if self.rows.is_empty() {
            return Some(correction);
        }
        let (rows, by) = (rows_of(&self.rows)?, Box::new(correction));
        Some(Is::InRows { rows, by })
    }
}

/// Finite numbers.
pub(super) const VALUES: Kind<Vec<f64>> = Kind {
    expected: phrase!("an array of numbers"),
    read: |at| {
        let all = at.column().filter(|all| all.iter().all(|v| v.is_finite()));
        all.map(<[f64]>::to_vec).or_else(|| at.wrong())
    },
    write: |values| values.iter().copied().collect(),
};

const THREE: Kind<[f64; 3]> = Kind {
    expected: phrase!("the places of x, y and z among 1, 2, 3"),
    read: |at| at.numbers(),
    write: |three| (*three).into(),
};

fn correction_written(correction: &SessionCorrection) -> Value {
    use SessionCorrection as Is;
    let (name, more) = match correction {
        Is::ScaleJoint { joint, factor } => (
            "scale-joint",
            object! { "joint": joint + 1, "factor": *factor },
        ),
        Is::ScaleJoints { factor } => ("scale-joints", object! { "factor": *factor }),
        Is::ExchangeJoints { first, second } => (
            "exchange-joints",
            object! { "joint": first + 1, "other_joint": second + 1 },
        ),
        Is::CoupleJoint {
            joint,
            from,
            factor,
        } => (
            "couple-joint",
            object! { "joint": joint + 1, "other_joint": from + 1, "factor": *factor },
        ),
        Is::TakeReadBack => ("take-read-back", object! {}),
        Is::TurnHome { joint, by_rad } => (
            "turn-home",
            object! { "joint": joint + 1, "by_rad": *by_rad },
        ),
        Is::ScaleLengths(factor) => ("scale-lengths", object! { "factor": *factor }),
        Is::ScaleCoordinate { axis, factor } => (
            "scale-coordinate",
            object! { "axis": axis + 1, "factor": *factor },
        ),
        Is::Reorder(order) => (
            "reorder",
            object! { "order": order.map(|k| k as f64 + 1.0) },
        ),
        Is::FreeFrame => ("free-frame", object! {}),
        Is::InRows { rows, by } => {
            return correction_written(by).with(object! { "rows": numbers_of_rows(rows) });
        }
        of_samples => match numbers_of(of_samples) {
            Some((name, values)) => (name, object! { "values": values }),
            None => return object! {},
        },
    };
    object! { "correction": name }.with(more)
}
