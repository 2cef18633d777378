//! Codes for missing values: −999 in the column of a joint, 0 in one of temperatures. A fit would take them for
//! values.

use std::f64::consts::TAU;

use super::rows::listed;
use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::kinematics::JointKind;
use crate::sessions::Session;
use crate::sessions::columns::Quantity;

/// With fewer other values it is not known what is usual.
const FEWEST_OTHERS: usize = 5;
/// A code for a missing value is there at least twice, and in no more than this share of the samples.
const FEWEST: usize = 2;
const MOST_SHARE: f64 = 0.4;
/// No machine that is calibrated is as cold or as warm, °C.
pub(super) const TEMPERATURES_C: std::ops::RangeInclusive<f64> = -60.0..=200.0;

/// Where it is colder it may freeze, °C.
const COLD_C: f64 = 10.0;

/// No joint without limits is calibrated so many turns from its home.
const MOST_TURNS: f64 = 2.0;

pub(super) fn coded(session: &Session, values: JointValues) -> Vec<DataProblem> {
    let (joints, samples) = (&session.robot.joints, &session.samples);
    let mut problems = Vec::new();
    for (joint, own) in joints.iter().enumerate() {
        let (quantity, column) = match (values, &samples.q_read[joint]) {
            (JointValues::Read, Some(read)) => (Quantity::ReadBack(joint), read),
            _ => (Quantity::Commanded(joint), &samples.q[joint]),
        };
        // Beyond its limits, and farther than all others reach.
        let is_none = |v: f64| match (own.limits, own.kind) {
            (Some(limits), _) => !(limits.from..=limits.to).contains(&v),
            (None, JointKind::Revolute) => v.abs() > MOST_TURNS * TAU,
            (None, JointKind::Prismatic) => false,
        };
        let shown = |v: f64| own.kind.to_display(v);
        problems.extend(repeated(session, quantity, column, shown, is_none));
    }
    if let Some(column) = &samples.temperature_c {
        // 0 °C is one of a cold morning, unless all others are of a warm room.
        let is_warm = |v: &f64| *v == 0.0 || *v > COLD_C;
        let warm = column.iter().filter(|v| v.is_finite()).all(is_warm);
        let is_none = |v: f64| v == 0.0 && warm || !TEMPERATURES_C.contains(&v);
        problems.extend(repeated(
            session,
            Quantity::Temperature,
            column,
            |v| v,
            is_none,
        ));
    }
    problems
}

/// A value that is there again and again, and farther from all others than they are from each other.
fn repeated(
    session: &Session,
    quantity: Quantity,
    column: &[f64],
    shown: impl Fn(f64) -> f64,
    is_none: impl Fn(f64) -> bool,
) -> Option<DataProblem> {
    let mut sorted: Vec<f64> = column.iter().copied().filter(|v| v.is_finite()).collect();
    sorted.sort_by(f64::total_cmp);
    let (least, most) = (*sorted.first()?, *sorted.last()?);
    let (code, others) = [least, most].into_iter().find_map(|code| {
        let others: Vec<f64> = sorted.iter().copied().filter(|v| *v != code).collect();
        let (low, high) = (*others.first()?, *others.last()?);
        let count = sorted.len() - others.len();
        let far = (code - low).abs().min((code - high).abs()) > high - low;
        let is_code = count >= FEWEST
            && count as f64 <= MOST_SHARE * sorted.len() as f64
            && others.len() >= FEWEST_OTHERS
            && low < high
            && far
            && is_none(code);
        is_code.then_some((code, [low, high]))
    })?;
    let rows: Vec<usize> = (0..column.len()).filter(|i| column[*i] == code).collect();
    let number = |v: f64| {
        let text = format!("{:.4}", shown(v));
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    };
    Some(DataProblem::of_rows(
        text!(
            "missing values: {column} is {code} in {count} samples",
            column = quantity.heading(Some(quantity.written_in(&session.robot.joints))),
            code = number(code),
            count = rows.len()
        ),
        text!(
            "all other values are between {low} and {high}; {rows}",
            low = number(others[0]),
            high = number(others[1]),
            rows = listed(&rows)
        ),
        text!("leave these samples out, or write their values"),
        rows,
    ))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::row_checks::tests::axis;

    #[test]
    fn a_code_for_a_missing_joint_value_is_left_out() {
        let mut session = axis(60);
        assert!(coded(&session, JointValues::Commanded).is_empty());
        for row in [7, 8, 31] {
            session.samples.q[0][row] = (-999.0_f64).to_radians();
        }
        let problems = coded(&session, JointValues::Commanded);
        assert_eq!(problems.len(), 1);
        assert_eq!(problems[0].samples, [7, 8, 31]);
        let what = problems[0].what.to_string();
        assert_eq!(what, "missing values: q1_deg is -999 in 3 samples");
    }

    #[test]
    fn home_and_a_cold_morning_are_values() {
        let mut session = axis(60);
        // Two returns to home, far from a narrow range of the others.
        for (k, q) in session.samples.q[0].iter_mut().enumerate() {
            *q = if k < 2 { 0.0 } else { 1.0 + 0.005 * k as f64 };
        }
        let cold = |k: usize| if k < 4 { 0.0 } else { 0.4 * k as f64 };
        session.samples.temperature_c = Some((0..60).map(cold).collect());
        assert!(coded(&session, JointValues::Commanded).is_empty());
        let frost = |k: usize| if k < 4 { 0.0 } else { 3.0 + 0.03 * k as f64 };
        session.samples.temperature_c = Some((0..60).map(frost).collect());
        assert!(coded(&session, JointValues::Commanded).is_empty());
        let missing = |k: usize| {
            if k.is_multiple_of(9) {
                0.0
            } else {
                20.0 + 0.1 * k as f64
            }
        };
        session.samples.temperature_c = Some((0..60).map(missing).collect());
        assert_eq!(coded(&session, JointValues::Commanded).len(), 1);
    }
}
