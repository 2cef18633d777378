//! The corrections of the set-up that a model carries; joints count from 1.

use crate::document::kinds::{NUMBER, TEXT, count};
use crate::document::object::{Cursor, Kind, written};
use crate::document::{Member, Value};
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
    let (Some(joint), Some(other)) = (parts.joint.checked_sub(1), parts.other.checked_sub(1))
    else {
        return at.wrong();
    };
    let factor = parts.factor;
    let needs_a_factor = matches!(
        parts.correction.as_str(),
        "scale-joint" | "scale-joints" | "couple-joint" | "scale-lengths" | "scale-coordinate"
    );
    // Of some rows it says that the joint does not move what was measured; of all it has no inverse.
    if needs_a_factor && factor == 0.0 && parts.rows.is_empty() {
        return at.wrong();
    }
    let correction = match parts.correction.as_str() {
        "scale-joint" => SessionCorrection::ScaleJoint { joint, factor },
        "scale-joints" => SessionCorrection::ScaleJoints { factor },
        "exchange-joints" => SessionCorrection::ExchangeJoints {
            first: joint,
            second: other,
        },
        "couple-joint" => SessionCorrection::CoupleJoint {
            joint,
            from: other,
            factor,
        },
        "take-read-back" => SessionCorrection::TakeReadBack,
        "turn-home" => SessionCorrection::TurnHome {
            joint,
            by_rad: parts.by_rad,
        },
        "scale-lengths" => SessionCorrection::ScaleLengths(factor),
        "scale-coordinate" => {
            let axis = parts.axis.checked_sub(1).filter(|axis| *axis < 3);
            let Some(axis) = axis else {
                return at.wrong();
            };
            SessionCorrection::ScaleCoordinate { axis, factor }
        }
        "reorder" => {
            let mut order = [0; 3];
            for (to, from) in order.iter_mut().zip(parts.order) {
                let Some(k) = [1.0, 2.0, 3.0].iter().position(|k| *k == from) else {
                    return at.wrong();
                };
                *to = k;
            }
            SessionCorrection::Reorder(order)
        }
        "free-frame" => SessionCorrection::FreeFrame,
        name => match of_numbers(name, &parts.values) {
            Some(correction) => correction,
            None => return at.wrong(),
        },
    };
    if parts.rows.is_empty() {
        return Some(correction);
    }
    let Some(rows) = rows_of(&parts.rows) else {
        return at.wrong();
    };
    let by = Box::new(correction);
    Some(SessionCorrection::InRows { rows, by })
}

const VALUES: Kind<Vec<f64>> = Kind {
    expected: phrase!("an array of numbers"),
    read: |at| match &at.node.value {
        Value::Numbers(values) if values.iter().all(|value| value.is_finite()) => {
            Some(values.clone())
        }
        Value::List(list) if list.is_empty() => Some(Vec::new()),
        _ => at.wrong(),
    },
    write: |values| values.iter().copied().collect(),
};

const THREE: Kind<[f64; 3]> = Kind {
    expected: phrase!("the places of x, y and z among 1, 2, 3"),
    read: |at| at.numbers(),
    write: |three| (*three).into(),
};

fn correction_written(correction: &SessionCorrection) -> Value {
    let object = |name: &str, members: Vec<Member>| {
        let first = Member::new("correction", name);
        Value::Object([first].into_iter().chain(members).collect())
    };
    let joint = |key: &'static str, joint: usize| Member::new(key, joint + 1);
    let number = |key: &'static str, value: f64| Member::new(key, value);
    match correction {
        SessionCorrection::ScaleJoint { joint: of, factor } => object(
            "scale-joint",
            vec![joint("joint", *of), number("factor", *factor)],
        ),
        SessionCorrection::ScaleJoints { factor } => {
            object("scale-joints", vec![number("factor", *factor)])
        }
        SessionCorrection::ExchangeJoints { first, second } => object(
            "exchange-joints",
            vec![joint("joint", *first), joint("other_joint", *second)],
        ),
        SessionCorrection::CoupleJoint {
            joint: of,
            from,
            factor,
        } => object(
            "couple-joint",
            vec![
                joint("joint", *of),
                joint("other_joint", *from),
                number("factor", *factor),
            ],
        ),
        SessionCorrection::TakeReadBack => object("take-read-back", Vec::new()),
        SessionCorrection::TurnHome { joint: of, by_rad } => object(
            "turn-home",
            vec![joint("joint", *of), number("by_rad", *by_rad)],
        ),
        SessionCorrection::ScaleLengths(factor) => {
            object("scale-lengths", vec![number("factor", *factor)])
        }
        SessionCorrection::ScaleCoordinate { axis, factor } => object(
            "scale-coordinate",
            vec![Member::new("axis", axis + 1), number("factor", *factor)],
        ),
        SessionCorrection::Reorder(order) => {
            let places = order.map(|k| k as f64 + 1.0);
            object("reorder", vec![Member::new("order", places)])
        }
        SessionCorrection::FreeFrame => object("free-frame", Vec::new()),
        SessionCorrection::InRows { rows, by } => match correction_written(by) {
            Value::Object(mut members) => {
                let rows: Value = numbers_of_rows(rows).into_iter().collect();
                members.push(Member::new("rows", rows));
                Value::Object(members)
            }
            other => other,
        },
        of_samples => match numbers_of(of_samples) {
            Some((name, values)) => object(
                name,
                vec![Member::new("values", values.into_iter().collect::<Value>())],
            ),
            None => written((), |_, ()| {}),
        },
    }
}
