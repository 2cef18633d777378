//! The curve of an unexplained correction on disk.
//!
//! Its numbers are those that the program computes with (rad, mm), so that it is read back to the
//! last bit; `parameters` repeats the range for people, and has to agree where it is given.

use std::sync::Arc;

use serde::Serialize;

use super::exact::{DISAGREES, agrees};
use super::read::count;
use crate::effects::curve::{Curve, CurveError, Knots};
use crate::effects::{Parameter, Term, Unexplained};
use crate::kinematics::JointKind;
use crate::sessions::format_v1::degrees::degrees;
use crate::sessions::json::{Fields, Member, Node, Path, Value, optional};
use crate::units::rad_from_deg;

/// Keys of the values and of their standard deviations, by direction.
const VALUES: [&str; 3] = ["motion_inner", "radial_mm", "axial_mm"];
const SIGMA: [&str; 3] = ["sigma_motion_inner", "sigma_radial_mm", "sigma_axial_mm"];
const KNOWN: [&str; 10] = [
    "from_inner",
    "to_inner",
    "period_inner",
    "knots",
    VALUES[0],
    VALUES[1],
    VALUES[2],
    SIGMA[0],
    SIGMA[1],
    SIGMA[2],
];
const CURVE: &str = "an object with from_inner, to_inner, knots and values";

/// The curve as serde writes it: rad or mm; a direction without values is left out.
#[derive(Serialize)]
pub(super) struct CurveTwin<'a> {
    from_inner: f64,
    to_inner: f64,
    #[serde(skip_serializing_if = "Option::is_none")]
    period_inner: Option<f64>,
    knots: usize,
    #[serde(skip_serializing_if = "<[f64]>::is_empty")]
    motion_inner: &'a [f64],
    #[serde(skip_serializing_if = "<[f64]>::is_empty")]
    radial_mm: &'a [f64],
    #[serde(skip_serializing_if = "<[f64]>::is_empty")]
    axial_mm: &'a [f64],
    #[serde(skip_serializing_if = "<[f64]>::is_empty")]
    sigma_motion_inner: &'a [f64],
    #[serde(skip_serializing_if = "<[f64]>::is_empty")]
    sigma_radial_mm: &'a [f64],
    #[serde(skip_serializing_if = "<[f64]>::is_empty")]
    sigma_axial_mm: &'a [f64],
}

impl<'a> CurveTwin<'a> {
    pub(super) fn of(curve: &'a Curve) -> Self {
        let knots = curve.knots();
        Self {
            from_inner: knots.from,
            to_inner: knots.to,
            period_inner: knots.period,
            knots: knots.count,
            motion_inner: curve.values(0),
            radial_mm: curve.values(1),
            axial_mm: curve.values(2),
            sigma_motion_inner: curve.sigma(0),
            sigma_radial_mm: curve.sigma(1),
            sigma_axial_mm: curve.sigma(2),
        }
    }
}

/// The range for people.
pub(super) fn parameters(curve: &Curve, kind: JointKind) -> Vec<Parameter> {
    let knots = curve.knots();
    let (names, outer): ([_; 3], fn(f64) -> f64) = match kind {
        JointKind::Revolute => (["from_deg", "to_deg", "period_deg"], degrees),
        JointKind::Prismatic => (["from_mm", "to_mm", "period_mm"], |v| v),
    };
    let values = [Some(knots.from), Some(knots.to), knots.period];
    let there = names.into_iter().zip(values);
    let there = there.filter_map(|(name, value)| Some((name, value?)));
    there
        .map(|(name, value)| Parameter {
            name,
            value: outer(value),
        })
        .collect()
}

/// The term of an unexplained correction; `joint` is counted from 1.
pub(super) fn unexplained(
    fields: &mut Fields<'_>,
    members: &[Member],
    at: usize,
    path: &Path<'_>,
    joint: usize,
    joints: usize,
) -> Option<Term> {
    if joint == 0 || joint > joints {
        let expected = format!("a joint from 1 to {joints}");
        fields.error(at, &path.key("joint"), joint.to_string(), expected);
        return None;
    }
    let node = fields.required(members, at, path, "curve", CURVE)?;
    let curve = curve(fields, node, &path.key("curve"))?;
    if let Some(given) = optional(members, "parameters") {
        readable(fields, given, &path.key("parameters"), curve.knots())?;
    }
    Some(Term {
        curve: Some(Arc::new(curve)),
        ..Term::absent(&Unexplained, joint - 1, 0.0)
    })
}

fn curve(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>) -> Option<Curve> {
    let members = fields.object(node, path, CURVE)?;
    fields.unknown_keys(members, path, &KNOWN);
    let from = fields.required_number(members, node.at, path, "from_inner");
    let to = fields.required_number(members, node.at, path, "to_inner");
    let period = match optional(members, "period_inner") {
        None => Some(None),
        Some(node) => fields.number(node, &path.key("period_inner")).map(Some),
    };
    let whole = "a whole number of knots";
    let knots = fields.required(members, node.at, path, "knots", whole);
    let knots = knots.and_then(|n| count(fields, n, &path.key("knots"), whole));
    let mut lists = [VALUES, SIGMA].map(|keys| keys.map(|key| list(fields, members, path, key)));
    let knots = Knots {
        from: from?,
        to: to?,
        period: period?,
        count: knots?,
    };
    let mut take = |which: usize| -> Option<[Vec<f64>; 3]> {
        let [a, b, c] = &mut lists[which];
        Some([a.take()?, b.take()?, c.take()?])
    };
    let (values, sigma) = (take(0)?, take(1)?);
    let lengths = [&values, &sigma].map(|all| all.each_ref().map(Vec::len));
    match Curve::new(knots, values, sigma) {
        Ok(curve) => Some(curve),
        Err(error) => {
            let (key, expected) = match error {
                CurveError::Range { .. } => ("to_inner", "a number above from_inner".to_owned()),
                CurveError::Period(_) => ("period_inner", "a number above 0".to_owned()),
                CurveError::Count(_) => ("knots", "a whole number from 2 on".to_owned()),
                CurveError::NotANumber => ("", "numbers; a sigma is not negative".to_owned()),
                CurveError::Lengths { expected, .. } => {
                    let keys = [VALUES, SIGMA];
                    let wrong = (0..6).map(|k| (k / 3, k % 3)).find(|(which, d)| {
                        let there = lengths[0][*d] > 0 || lengths[1][*d] > 0;
                        there && lengths[*which][*d] != expected
                    });
                    let key = wrong.map_or("", |(which, d)| keys[which][d]);
                    (key, format!("an array of {expected} numbers, one a knot"))
                }
            };
            let member = members.iter().find(|m| m.key == key);
            let at = member.map_or(node.at, |m| m.node.at);
            let deeper = path.key(key);
            let path = if key.is_empty() { path } else { &deeper };
            fields.error(at, path, error.to_string(), expected);
            None
        }
    }
}

/// An array of finite numbers; empty where it is not there.
fn list(
    fields: &mut Fields<'_>,
    members: &[Member],
    path: &Path<'_>,
    key: &str,
) -> Option<Vec<f64>> {
    let Some(node) = optional(members, key) else {
        return Some(Vec::new());
    };
    match &node.value {
        Value::Numbers(values) if values.iter().all(|v| v.is_finite()) => Some(values.clone()),
        _ => {
            fields.mismatch(node, &path.key(key), "an array of numbers");
            None
        }
    }
}

/// Whether the range for people is that of the curve.
fn readable(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>, knots: &Knots) -> Option<()> {
    let expected = "an object with the range of the curve";
    let members = fields.object(node, path, expected)?;
    let known = [
        ("from_deg", "from_mm", Some(knots.from)),
        ("to_deg", "to_mm", Some(knots.to)),
        ("period_deg", "period_mm", knots.period),
    ];
    let names = known.map(|(a, b, _)| [a, b]);
    fields.unknown_keys(members, path, names.as_flattened());
    let mut good = Some(());
    for (turning, sliding, exact) in known {
        for (key, inner) in [(turning, rad_from_deg as fn(f64) -> f64), (sliding, |v| v)] {
            let Some(node) = optional(members, key) else {
                continue;
            };
            let value = fields.number(node, &path.key(key))?;
            if !exact.is_some_and(|exact| agrees(exact, inner(value))) {
                fields.error(node.at, &path.key(key), value.to_string(), DISAGREES);
                good = None;
            }
        }
    }
    good
}
