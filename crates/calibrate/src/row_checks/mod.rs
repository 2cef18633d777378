//! Mistakes in the rows of a session, looked for before anything is fitted: points beside the wrong
//! commands, copies, an order that is not that of measuring, speeds and loads in another unit, digits.
//!
//! A row that is wrong makes a model wrong that fits every sample, so these checks come before the
//! set-up errors and the effects. Each says what it saw, how sure that is, and, where that is
//! mechanical, the change of the session that takes it back. The caller goes on with that change made;
//! no row changes its place, so that a sample keeps its number.

#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_sign_loss,
    reason = "shifts are small whole numbers, and states of them are few"
)]

mod conditions;
mod copies;
mod digits;
mod directions;
mod midnight;
mod missing_values;
mod order;
mod problem;
pub(crate) mod returns;
mod shifted;
mod speeds;

use std::borrow::Cow;

use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::sessions::Session;

/// A session without the mistakes of its rows, and what they were.
#[derive(Debug, Clone)]
pub struct CheckedRows<'a> {
    /// The session to go on with, its rows at their places.
    pub session: Cow<'a, Session>,
    /// What was wrong.
    pub problems: Vec<DataProblem>,
}

/// A check: what it found in a session. A correction that it proposes is made before the next check.
type RowCheck = fn(&Session, JointValues) -> Vec<DataProblem>;

/// Every check, in the order in which they are made: what others would stumble over comes first.
const CHECKS: [RowCheck; 11] = [
    midnight::passed,
    missing_values::coded,
    copies::copied,
    returns::far_apart,
    order::out_of_order,
    conditions::in_other_units,
    directions::exchanged,
    directions::reversed_for_a_time,
    speeds::turned_or_scaled,
    digits::coarse,
    shifted::shifted,
];

/// Makes every check, one after the other.
///
/// A session that cannot be computed with ([`Session::checked`] says why) has none.
pub fn check(session: &Session, values: JointValues) -> CheckedRows<'_> {
    match session.whole() {
        Ok(Cow::Borrowed(session)) => checked(session, values),
        Ok(Cow::Owned(completed)) => {
            let CheckedRows { session, problems } = checked(&completed, values);
            CheckedRows {
                session: Cow::Owned(session.into_owned()),
                problems,
            }
        }
        Err(_) => CheckedRows {
            session: Cow::Borrowed(session),
            problems: Vec::new(),
        },
    }
}

/// The same of a session that is whole.
pub(crate) fn checked(session: &Session, values: JointValues) -> CheckedRows<'_> {
    let mut checked = CheckedRows {
        session: Cow::Borrowed(session),
        problems: Vec::new(),
    };
    for check in CHECKS {
        for problem in check(&checked.session, values) {
            if let Some(mend) = &problem.mend {
                mend.apply_keeping_rows(checked.session.to_mut());
            }
            checked.problems.push(problem);
        }
    }
    checked
}

#[cfg(test)]
mod tests {
    use super::problem::listed;
    use super::*;
    use crate::simulation::{parse_scenario, simulate, unwatched};

    /// One axis, commands all over the place, so many samples of two targets, noise of 0.02 mm, zero offset 0.3°.
    pub(in crate::row_checks) fn axis(n: usize) -> Session {
        let mut at: f64 = 0.0;
        // Two targets are seen at every pose.
        let poses: Vec<String> = (0..n.div_ceil(2))
            .map(|k| {
                let to = 300.0 * ((k as f64 * 0.618_033_988_7).fract() - 0.5);
                let side = if to > at { 1 } else { -1 };
                at = to;
                format!(r#"{{"q_deg":[{to}],"dir":[{side}]}}"#)
            })
            .collect();
        let scenario = format!(
            r#"{{"format":"truepose-scenario/1","name":"r","robot":{{"name":"r","joints":[
            {{"name":"pan","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0],"limits":[-170,170]}}],
            "tool":{{"position_mm":[320,0,210],"quaternion_wxyz":[1,0,0,0]}}}},
            "targets":{{"A":[0,0,0],"B":[90,30,50]}},"instrument":{{"name":"t","sigma_mm":0.02}},
            "poses":{{"list":[{}]}},"conditions":{{"seconds_per_pose":8}},
            "effects":[{{"effect":"joint-zero-offset","joint":1,"parameters":{{"offset_deg":0.3}}}}],
            "noise":{{"sigma_mm":0.02,"kind":"gauss"}},"seed":4}}"#,
            poses.join(",")
        );
        let scenario = parse_scenario(scenario.as_bytes()).unwrap().scenario;
        let mut session = simulate(&scenario, 1, unwatched).unwrap().0;
        let rows: Vec<Option<usize>> = (0..n).map(Some).collect();
        session.samples.select(&rows);
        session
    }

    #[test]
    fn a_session_without_mistakes_has_nothing_to_say() {
        let session = axis(60);
        let checked = check(&session, JointValues::Commanded);
        assert!(checked.problems.is_empty(), "{:?}", checked.problems);
        assert!(matches!(checked.session, Cow::Borrowed(_)));
        for n in [1, 2, 5] {
            assert!(check(&axis(n), JointValues::Commanded).problems.is_empty());
        }
    }

    #[test]
    fn rows_are_listed_as_runs() {
        let listed = |rows: &[usize]| listed(rows).to_string();
        assert_eq!(listed(&[4]), "row 5");
        assert_eq!(listed(&[0, 1, 2, 6]), "rows 1–3, 7");
        assert_eq!(listed(&[0, 2, 4, 6, 8, 9]), "rows 1, 3, 5, 7 and 2 more");
    }
}
