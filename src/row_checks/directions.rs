//! Directions of approach against the way from row to row: columns of two joints that are exchanged.

use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::sessions::{Session, SessionCorrection};

use super::speeds::{FEWEST, NEARLY_ALL, agreement};

/// Every two joints whose commands say that each has the other's directions.
pub(super) fn exchanged(session: &Session, _: JointValues) -> Vec<DataProblem> {
    let joints = session.samples.dir.len().min(session.samples.q.len());
    let pairs =
        (0..joints).flat_map(|first| (first + 1..joints).map(move |second| (first, second)));
    let found = pairs.filter_map(|(first, second)| of_pair(session, first, second));
    found.collect()
}

fn of_pair(session: &Session, first: usize, second: usize) -> Option<DataProblem> {
    let agrees = |joint: usize, with: usize| {
        let side = session.samples.dir[with].as_deref()?;
        let (agree, of) = agreement(session, joint, side);
        (of >= FEWEST).then_some((agree, of))
    };
    let nearly_all = |(agree, of): (usize, usize)| agree as f64 >= NEARLY_ALL * of as f64;
    let own = [agrees(first, first)?, agrees(second, second)?];
    let crossed = [agrees(first, second)?, agrees(second, first)?];
    if own.into_iter().any(nearly_all) || !crossed.into_iter().all(nearly_all) {
        return None;
    }
    let (a, b) = (first + 1, second + 1);
    Some(DataProblem {
        what: text!(
            "the directions of approach of joints {a} and {b} are exchanged",
            a,
            b
        ),
        evidence: text!(
            "from row to row joint {a} moves as dir{b} says in {agree} of {moves}, and as its own column says in {own}",
            a,
            b,
            agree = crossed[0].0,
            moves = crossed[0].1,
            own = own[0].0
        ),
        proposal: text!(
            "they are exchanged; correct the headings dir{a} and dir{b}",
            a,
            b
        ),
        mend: Some(SessionCorrection::ExchangeDirections { first, second }),
        samples: Vec::new(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sessions::parse;

    /// Two joints at random places; the directions are those of their travel, or the other joint's.
    fn session(exchanged: bool) -> Session {
        let q =
            |joint: u32| move |k: u32| 90.0 * (f64::from(k * k) * (1.3 + f64::from(joint))).sin();
        let column = |of: &dyn Fn(u32) -> f64| (0..30).map(of).collect::<Vec<f64>>();
        let travel = |joint: u32| {
            move |k: u32| {
                if k == 0 {
                    0.0
                } else {
                    (q(joint)(k) - q(joint)(k - 1)).signum()
                }
            }
        };
        let dir = if exchanged { [1, 0] } else { [0, 1] };
        let document = serde_json::json!({
            "format": "truepose-session/1", "name": "s",
            "robot": { "name": "r", "joints": [
                { "name": "a", "kind": "revolute", "axis": [0, 0, 1], "point_mm": [0, 0, 0] },
                { "name": "b", "kind": "revolute", "axis": [0, 1, 0], "point_mm": [0, 0, 100] },
            ], "tool": { "position_mm": [300, 0, 100], "quaternion_wxyz": [1, 0, 0, 0] } },
            "samples": { "columns": {
                "q1_deg": column(&q(0)), "q2_deg": column(&q(1)),
                "x_mm": column(&|_| 1.0), "y_mm": column(&|_| 2.0), "z_mm": column(&|_| 3.0),
                "dir1": column(&travel(dir[0])), "dir2": column(&travel(dir[1])),
            } },
        });
        parse(document.to_string().as_bytes())
            .expect("it is a session")
            .session
    }

    #[test]
    fn columns_that_are_exchanged_are_exchanged_back() {
        assert_eq!(exchanged(&session(false), JointValues::Commanded), []);
        let mut wrong = session(true);
        let found = exchanged(&wrong, JointValues::Commanded);
        assert_eq!(found.len(), 1);
        found[0].mend.as_ref().expect("known").apply(&mut wrong);
        assert_eq!(wrong.samples.dir, session(false).samples.dir);
    }
}
