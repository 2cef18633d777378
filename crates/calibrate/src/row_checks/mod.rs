//! Mistakes in the rows of a session that show without any fit: copies, an order that is not that of measuring,
//! speeds and loads in another unit, digits.
//!
//! A row that is wrong makes a model wrong that fits every sample, so these checks come before the set-up errors and
//! the effects. Each states its evidence, how certain it is, and, where that is mechanical, the change of the session
//! that corrects it. The caller goes on with that change made; no row changes its place, so that a sample keeps its
//! number.

mod conditions;
mod copies;
mod digits;
mod directions;
mod midnight;
mod missing_values;
mod order;
pub(crate) mod returns;
mod rows;
mod speeds;

use std::borrow::Cow;

use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::sessions::{Corrected, Session, SessionCorrection, hash_of_samples};

pub(crate) use digits::coarse;
pub(crate) use rows::{in_order, listed};

/// What looks for mistakes in a session; a correction that it proposes is made before the next.
pub(crate) type Check = fn(&Session, JointValues) -> Vec<DataProblem>;

/// Every check of rows, in the order in which they are made: what would disturb others comes first. Rounding
/// ([`coarse`]) is checked when the unit is known.
pub(crate) const CHECKS: [Check; 9] = [
    midnight::passed,
    missing_values::coded,
    copies::copied,
    returns::far_apart,
    order::out_of_order,
    conditions::in_other_units,
    directions::exchanged,
    directions::reversed_for_a_time,
    speeds::turned_or_scaled,
];

/// A session with its mistakes corrected, and what they were.
#[derive(Debug, Clone)]
pub struct CorrectedSession<'a> {
    /// The session to go on with, its rows at their places.
    pub session: Cow<'a, Session>,
    /// What was wrong.
    pub problems: Vec<DataProblem>,
}

impl<'a> CorrectedSession<'a> {
    /// A session as it is.
    pub(crate) fn of(session: &'a Session) -> Self {
        Self {
            session: Cow::Borrowed(session),
            problems: Vec::new(),
        }
    }

    /// A session after `correct` once it is whole; one that cannot be computed with (see [`Session::checked`]) is
    /// returned unchanged.
    pub(crate) fn of_whole(
        raw: &'a Session,
        correct: impl for<'b> Fn(&'b Session) -> CorrectedSession<'b>,
    ) -> Self {
        match raw.whole() {
            Ok(Cow::Borrowed(raw)) => correct(raw),
            Ok(Cow::Owned(completed)) => {
                let CorrectedSession { session, problems } = correct(&completed);
                Self {
                    session: Cow::Owned(session.into_owned()),
                    problems,
                }
            }
            Err(_) => Self::of(raw),
        }
    }

    /// Corrects what a check finds, so often at most: one mistake may hide another.
    pub(crate) fn look_for(&mut self, check: Check, values: JointValues, most: usize) {
        for _ in 0..most {
            let found = check(&self.session, values);
            if found.is_empty() {
                return;
            }
            for correction in found.iter().filter_map(|problem| problem.mend.as_ref()) {
                correction.apply_keeping_rows(self.session.to_mut());
            }
            self.problems.extend(found);
        }
    }

    /// Notes in the samples what was corrected: a model that is fitted to them contains it. `raw` is what was read.
    pub(crate) fn note_corrections(&mut self, raw: &Session) {
        let made = self
            .problems
            .iter()
            .filter_map(|problem| problem.mend.clone());
        let by: Vec<SessionCorrection> = made.collect();
        if raw.samples.corrected.is_none() && !by.is_empty() {
            let raw_hash = hash_of_samples(raw);
            self.session.to_mut().samples.corrected = Some(Corrected { by, raw_hash });
        }
    }
}

/// Makes every check, one after the other.
///
/// A session that cannot be computed with (see [`Session::checked`]) has none.
pub fn check(session: &Session, values: JointValues) -> CorrectedSession<'_> {
    CorrectedSession::of_whole(session, |session| {
        let mut checked = CorrectedSession::of(session);
        for check in CHECKS.into_iter().chain([coarse as Check]) {
            checked.look_for(check, values, 1);
        }
        checked
    })
}

#[cfg(test)]
pub(crate) mod tests {
    use super::*;
    use crate::simulation::{parse_scenario, simulate, unwatched};

    /// One axis, commands all over the place, so many samples of two targets, noise of 0.02 mm, zero offset 0.3°.
    pub(crate) fn axis(n: usize) -> Session {
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
