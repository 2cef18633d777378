//! Directions of approach against the way from row to row: columns of two joints that are exchanged, and a time in which
//! they are written the other way.

use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::numeric::likeliest_stretch;
use crate::sessions::{Session, SessionCorrection, in_rows};

use super::rows::in_order;
use super::speeds::{FEWEST, NEARLY_ALL, agreement};

/// Every two joints whose commands agree with the directions of the other.
pub(super) fn exchanged(session: &Session, _: JointValues) -> Vec<DataProblem> {
    let joints = session.samples.dir.len().min(session.samples.q.len());
    let pairs =
        (0..joints).flat_map(|first| (first + 1..joints).map(move |second| (first, second)));
    let found = pairs.filter_map(|(first, second)| of_pair(session, first, second));
    found.collect()
}

/// Successive rows in which the joints move against their directions, while they move with them in others.
pub(super) fn reversed_for_a_time(session: &Session, _: JointValues) -> Vec<DataProblem> {
    let samples = &session.samples;
    let n = samples.len();
    let order = in_order(samples);
    // Of each row joints that moved with their directions and against them.
    let of_row = |place: usize| {
        let (row, before) = (order[place], order[place.checked_sub(1)?]);
        let signs = samples.q.iter().zip(&samples.dir).filter_map(|(q, dir)| {
            let moved = (q[row] - q[before]) * dir.as_ref()?[row];
            (moved != 0.0 && moved.is_finite()).then_some(moved > 0.0)
        });
        Some(signs.fold((0, 0), |(with, against), sign| {
            (with + usize::from(sign), against + usize::from(!sign))
        }))
    };
    let moves: Vec<(usize, usize)> = (0..n).map(|k| of_row(k).unwrap_or_default()).collect();
    let gain = |(with, against): &(usize, usize)| *against as f64 - *with as f64;
    let (first, end) = likeliest_stretch(moves.iter().map(gain));
    let sum = |places: &mut dyn Iterator<Item = usize>| {
        places.fold((0, 0), |sum: (usize, usize), k| {
            (sum.0 + moves[k].0, sum.1 + moves[k].1)
        })
    };
    let inside = sum(&mut (first..end));
    let outside = sum(&mut (0..first).chain(end..n));
    let nearly_all = |count: usize, (with, against): (usize, usize)| {
        with + against >= FEWEST && count as f64 >= NEARLY_ALL * (with + against) as f64
    };
    if !nearly_all(inside.1, inside) || !nearly_all(outside.0, outside) {
        return Vec::new();
    }
    // Before the first row nothing is known of the motion: it goes with the second.
    let mut rows: Vec<usize> = order[if first == 1 { 0 } else { first }..end].to_vec();
    rows.sort_unstable();
    let ranges = in_rows::ranges(&rows);
    vec![DataProblem {
        what: text!(
            "the directions of approach are written the other way, in {rows}",
            rows = in_rows::listed(&ranges)
        ),
        evidence: text!(
            "from row to row the joints move as their directions say in {with} of {moves} moves before and after, and the other way in {turned} of {others} there",
            with = outside.0,
            moves = outside.0 + outside.1,
            turned = inside.1,
            others = inside.0 + inside.1
        ),
        proposal: text!("they are reversed there; correct the columns"),
        mend: Some(SessionCorrection::InRows {
            rows: ranges,
            by: Box::new(SessionCorrection::TurnDirections),
        }),
        samples: rows,
    }]
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
    Some(DataProblem::of_all(
        text!(
            "the directions of approach of joints {a} and {b} are exchanged",
            a,
            b
        ),
        text!(
            "from row to row joint {a} moves as dir{b} says in {agree} of {moves}, and as its own column says in {own}",
            a,
            b,
            agree = crossed[0].0,
            moves = crossed[0].1,
            own = own[0].0
        ),
        text!(
            "they are exchanged; correct the headings dir{a} and dir{b}",
            a,
            b
        ),
        SessionCorrection::ExchangeDirections { first, second },
    ))
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
    fn directions_that_are_written_the_other_way_for_a_time_are_turned_back() {
        let right = session(false);
        assert_eq!(reversed_for_a_time(&right, JointValues::Commanded), []);
        for (rows, said) in [(18..30, "samples 19 to 30"), (0..11, "samples 1 to 11")] {
            let mut wrong = session(false);
            for column in wrong.samples.dir.iter_mut().flatten() {
                column[rows.clone()].iter_mut().for_each(|dir| *dir = -*dir);
            }
            let found = reversed_for_a_time(&wrong, JointValues::Commanded);
            assert_eq!(found.len(), 1);
            assert!(found[0].what.contains(said), "{:?}", found[0].what);
            found[0].mend.as_ref().expect("known").apply(&mut wrong);
            assert_eq!(wrong.samples.dir, right.samples.dir);
        }
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
