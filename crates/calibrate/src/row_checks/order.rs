//! Rows whose clock runs backwards again and again: the file was sorted after the measurement.
//!
//! Whatever depends on the order of measuring uses the clock's then ([`measuring_order`]); here it is reported.
//!
//! [`measuring_order`]: crate::sessions::measuring_order

use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::sessions::measuring_order::falls_of_the_clock;
use crate::sessions::{Samples, Session};
use crate::text::Text;

pub(super) fn out_of_order(session: &Session, _: JointValues) -> Vec<DataProblem> {
    let samples = &session.samples;
    let Some(time_s) = samples.time_s.as_deref() else {
        return Vec::new();
    };
    let Some(falls) = falls_of_the_clock(time_s) else {
        return Vec::new();
    };
    let rows = samples.len();
    let evidence = match sorted_by(samples) {
        None => text!(
            "the time runs backwards at {falls} of {rows} rows",
            falls,
            rows
        ),
        Some(by) => text!(
            "the time runs backwards at {falls} of {rows} rows; they are sorted by {by}",
            falls,
            rows,
            by
        ),
    };
    vec![DataProblem::of_all(
        text!("rows out of order: the file is not in the order of its clock"),
        evidence,
        text!(
            "the samples are taken in the order of time_s, for directions of approach, drift and noise; keep the file in measuring order"
        ),
        None,
    )]
}

/// The column by which the rows of a file are sorted.
fn sorted_by(samples: &Samples) -> Option<Text> {
    let rises = |column: &[f64]| column.windows(2).all(|pair| pair[0] <= pair[1]);
    let falls = |column: &[f64]| column.windows(2).all(|pair| pair[0] >= pair[1]);
    let joint = samples.q.iter().position(|q| rises(q) || falls(q));
    let of_joint = joint.map(|joint| text!("joint {joint}", joint = joint + 1));
    let target = samples.target.as_deref();
    let of_target = || {
        let by = target?.windows(2).all(|pair| pair[0] <= pair[1]);
        by.then(|| text!("target"))
    };
    of_joint.or_else(of_target)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::row_checks::tests::axis;

    #[test]
    fn a_file_that_was_sorted_by_angle_is_said() {
        let mut session = axis(80);
        assert!(out_of_order(&session, JointValues::Commanded).is_empty());
        let q = session.samples.q[0].clone();
        let mut rows: Vec<usize> = (0..80).collect();
        rows.sort_by(|a, b| q[*a].total_cmp(&q[*b]));
        let rows: Vec<Option<usize>> = rows.into_iter().map(Some).collect();
        session.samples.select(&rows);
        let problems = out_of_order(&session, JointValues::Commanded);
        assert_eq!(problems.len(), 1);
        assert!(problems[0].what.contains("rows out of order"));
        assert!(problems[0].evidence.contains("sorted by joint 1"));
    }
}
