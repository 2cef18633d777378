//! The curve of an unexplained correction on disk.
//!
//! Its numbers are those that the program computes with (rad, mm), so that it is read back to the
//! last bit; `parameters` repeats the range for people, and has to agree where it is given.

use crate::text::{Template, Text};
use std::sync::Arc;

use super::exact::{DISAGREES, agrees};
use super::set_up::VALUES;
use crate::document::kinds::{NUMBER, count};
use crate::document::object::{Cursor, Kind, Object, written};
use crate::document::{Member, Value};
use crate::effects::curve::{Curve, CurveError, Knots, PARTS, Parts};
use crate::effects::{Parameter, SMOOTH, Term};
use crate::kinematics::JointKind;
use crate::sessions::files::format_v1::robot::to_display;
use crate::units::rad_from_deg;

/// Keys of the values and of their standard deviations, part by part.
const KEYS: [[&str; PARTS]; 2] = [
    [
        "motion_inner",
        "radial_mm",
        "axial_mm",
        "half_reversal_motion_inner",
        "half_reversal_radial_mm",
        "half_reversal_axial_mm",
    ],
    [
        "sigma_motion_inner",
        "sigma_radial_mm",
        "sigma_axial_mm",
        "sigma_half_reversal_motion_inner",
        "sigma_half_reversal_radial_mm",
        "sigma_half_reversal_axial_mm",
    ],
];
const CURVE: Template = phrase!("an object with from_inner, to_inner, knots and values");

/// The points of a curve: values and standard deviations part by part, rad or mm; a part without values is left out.
#[derive(Clone)]
struct Points {
    knots: Knots,
    lists: [Parts; 2],
}

impl Points {
    fn curve(self) -> Result<Curve, CurveError> {
        let [values, sigma] = self.lists;
        Curve::new(self.knots, values, sigma)
    }
}

pub(super) fn written_curve(curve: &Curve) -> Value {
    let all = |list: fn(&Curve, usize) -> &[f64]| -> Parts {
        std::array::from_fn(|part| list(curve, part).to_vec())
    };
    let points = Points {
        knots: *curve.knots(),
        lists: [all(Curve::values), all(Curve::sigma)],
    };
    written(points, declare)
}

fn declare(o: &mut Object<'_, '_>, own: &mut Points) {
    o.required("from_inner", &mut own.knots.from, &NUMBER);
    o.required("to_inner", &mut own.knots.to, &NUMBER);
    o.optional("period_inner", &mut own.knots.period, &NUMBER);
    let knots = count(phrase!("a whole number of knots"));
    o.required("knots", &mut own.knots.count, &knots);
    for (keys, lists) in KEYS.iter().zip(&mut own.lists) {
        for (key, list) in keys.iter().zip(lists) {
            o.usual_if(!list.is_empty(), key, list, &LIST);
        }
    }
    if !o.has_read_well() {
        return;
    }
    let Err(error) = own.clone().curve() else {
        return;
    };
    let (key, expected) = match error {
        CurveError::Range { .. } => ("to_inner", text!("a number above from_inner")),
        CurveError::Period(_) => ("period_inner", text!("a number above 0")),
        CurveError::Count(_) => ("knots", text!("a whole number from 2 on")),
        CurveError::NotANumber => {
            return o.error(
                Text::verbatim(error.to_string()),
                text!("numbers; a sigma is not negative"),
            );
        }
        CurveError::Lengths { expected, .. } => {
            let length = |list: usize, d: usize| own.lists[list][d].len();
            let wrong = (0..2 * PARTS)
                .map(|k| (k / PARTS, k % PARTS))
                .find(|(list, d)| {
                    let there = length(0, *d) > 0 || length(1, *d) > 0;
                    there && length(*list, *d) != expected
                });
            let expected = text!("an array of {expected} numbers, one a knot", expected);
            let Some((list, d)) = wrong else {
                return o.error(Text::verbatim(error.to_string()), expected);
            };
            (KEYS[list][d], expected)
        }
    };
    o.error_in(key, Text::verbatim(error.to_string()), expected);
}

/// Finite numbers, one or more.
pub(super) const LIST: Kind<Vec<f64>> = Kind {
    expected: phrase!("an array of numbers"),
    read: |at| match (VALUES.read)(at)? {
        none if none.is_empty() => at.wrong(),
        all => Some(all),
    },
    write: |list| list.as_slice().into(),
};

/// The range for people.
pub(super) fn parameters(curve: &Curve, kind: JointKind) -> Vec<Parameter> {
    let knots = curve.knots();
    let names = match kind {
        JointKind::Revolute => ["from_deg", "to_deg", "period_deg"],
        JointKind::Prismatic => ["from_mm", "to_mm", "period_mm"],
    };
    let values = [Some(knots.from), Some(knots.to), knots.period];
    let there = names.into_iter().zip(values);
    let there = there.filter_map(|(name, value)| Some((name, value?)));
    there
        .map(|(name, value)| Parameter {
            name,
            value: to_display(kind, value),
        })
        .collect()
}

/// The term of an unexplained correction; `joint` is counted from 1.
pub(super) fn unexplained(
    at: &mut Cursor<'_, '_>,
    members: &[Member],
    joint: usize,
) -> Option<Term> {
    let blank = Points {
        knots: Knots {
            from: 0.0,
            to: 0.0,
            period: None,
            count: 0,
        },
        lists: Default::default(),
    };
    let points = at.under(members, "curve", CURVE, |at| at.object(blank, declare))?;
    let curve = points.curve().ok()?;
    let expected = phrase!("an object with the range of the curve");
    at.under_if(members, "parameters", expected, |at| {
        readable(at, curve.knots())
    })?;
    Some(Term {
        curve: Some(Arc::new(curve)),
        ..Term::absent(&SMOOTH, joint - 1, 0.0)
    })
}

/// Whether the range for people is that of the curve.
fn readable(at: &mut Cursor<'_, '_>, knots: &Knots) -> Option<()> {
    let members = at.members()?;
    let known = [
        ("from_deg", "from_mm", Some(knots.from)),
        ("to_deg", "to_mm", Some(knots.to)),
        ("period_deg", "period_mm", knots.period),
    ];
    let names = known.map(|(a, b, _)| [a, b]);
    at.fields
        .unknown_keys(members, at.path, names.as_flattened());
    let mut good = Some(());
    for (turning, sliding, exact) in known {
        for (key, inner) in [(turning, rad_from_deg as fn(f64) -> f64), (sliding, |v| v)] {
            let agreed = at.under_if(members, key, NUMBER.expected, |at| {
                let value = (NUMBER.read)(at)?;
                let agrees = exact.is_some_and(|exact| agrees(exact, inner(value)));
                let found = Text::verbatim(value.to_string());
                agrees.then_some(()).or_else(|| at.error(found, DISAGREES))
            });
            good = good.and(agreed).map(|_| ());
        }
    }
    good
}
