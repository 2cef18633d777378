//! Sockets that moved between two visits, or are not where the session says.

use nalgebra::Vector3;

use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::fit::gap::deviations;
use crate::fit::problem::Problem;
use crate::sessions::{Mend, Session};
use crate::text::Text;

use super::{MOST_PLACES, MOST_SAMPLES, evidence, fitted, in_numbers, is_believed};

/// At most so many sockets are taken to have moved; of most of them none is known to stand still.
const MOST_MOVED: usize = 4;
/// Fewest samples on either side of a move.
const FEWEST: usize = 3;
/// A move smaller than this is within what a ball sits in its socket, mm.
const LEAST_MM: f64 = 0.1;
/// A socket alone need not carry the whole error: it has to leave less than this share of it.
const LEAVES: f64 = 0.9;

/// The session with the sockets that moved taken as two places each.
pub(super) fn moved(
    session: &Session,
    values: JointValues,
    problems: &mut Vec<DataProblem>,
) -> Option<Session> {
    let sockets = session.samples.observed.socket.as_ref()?;
    let several = 2..=MOST_PLACES;
    if session.samples.len() > MOST_SAMPLES * 4
        || !several.contains(&session.instrument.references.sockets.len())
    {
        return None;
    }
    let rows_of = |socket: usize| -> Vec<usize> {
        let own = sockets.iter().enumerate();
        own.filter(|(_, s)| s.is_some_and(|s| s as usize == socket))
            .map(|(row, _)| row)
            .collect()
    };
    let (model, first_mm) = fitted(session, values)?;
    let problem = Problem::observing(session, values);
    let left = deviations(&problem, &model);
    let at = |row: usize| {
        Vector3::new(
            left.axes_mm[0][row],
            left.axes_mm[1][row],
            left.axes_mm[2][row],
        )
    };
    // The sockets in which a step explains most, the clearest first.
    let mut steps: Vec<(f64, usize, usize)> = (0..session.instrument.references.sockets.len())
        .filter_map(|socket| {
            let rows = rows_of(socket);
            let (gain, from) = step(&rows, &at)?;
            Some((gain, socket, from))
        })
        .collect();
    steps.sort_by(|a, b| b.0.total_cmp(&a.0));
    let mut now: Option<(Session, f64)> = None;
    let mut said: Vec<DataProblem> = Vec::new();
    for (_, socket, from) in steps.into_iter().take(MOST_MOVED) {
        let (here, before) = now.as_ref().map_or((session, first_mm), |n| (&n.0, n.1));
        let mend = Mend::SplitSocket { socket, from };
        let mut split = here.clone();
        mend.apply(&mut split);
        let Some((fit, after)) = fitted(&split, values) else {
            continue;
        };
        let evidence = evidence(session.samples.len(), 3, before, after, 4);
        let own = is_believed(evidence, before, after * super::LEAVES / LEAVES);
        let by = apart_mm(&split, &fit, socket);
        if !own || by.is_some_and(|by| by < LEAST_MM) {
            continue;
        }
        let name = &session.instrument.references.sockets[socket].name;
        let size = by.map_or(String::new(), |by| format!(" by {by:.2} mm"));
        said.push(DataProblem {
            what: Text::verbatim(format!(
                "socket {name} is elsewhere{size} from sample {} on",
                from + 1
            )),
            evidence: Text::verbatim(in_numbers(before, after, evidence)),
            proposal: text!(
                "its samples from there on are taken as those of another socket, whose place is fitted; fasten it, or give it another name"
            ),
            mend: Some(mend),
            samples: rows_of(socket)
                .into_iter()
                .filter(|row| *row >= from)
                .collect(),
        });
        now = Some((split, after));
    }
    problems.append(&mut said);
    now.map(|now| now.0)
}

/// Where a step of the deviations explains most: how much, and the first row behind it.
fn step(rows: &[usize], at: &dyn Fn(usize) -> Vector3<f64>) -> Option<(f64, usize)> {
    let known: Vec<(usize, Vector3<f64>)> = rows
        .iter()
        .map(|row| (*row, at(*row)))
        .filter(|(_, e)| e.iter().all(|v| v.is_finite()))
        .collect();
    let n = known.len();
    let total: Vector3<f64> = known.iter().map(|k| k.1).sum();
    let mut before = Vector3::zeros();
    let mut best: Option<(f64, usize)> = None;
    for k in 1..n {
        before += known[k - 1].1;
        if k < FEWEST || n - k < FEWEST {
            continue;
        }
        let (a, b) = (k as f64, (n - k) as f64);
        let apart = before / a - (total - before) / b;
        let gain = apart.norm_squared() * a * b / n as f64;
        if best.is_none_or(|best| gain > best.0) {
            best = Some((gain, known[k].0));
        }
    }
    best
}

/// How far the two places of a socket that was taken as two are apart, mm.
fn apart_mm(split: &Session, model: &crate::model::Model, socket: usize) -> Option<f64> {
    use crate::effects::places::PlaceKind;
    let last = split.instrument.references.sockets.len() - 1;
    let place = |index: usize| {
        let known = split.instrument.references.sockets[index].position_mm;
        let term = model.terms().iter().find(|t| {
            PlaceKind::of(t) == Some(PlaceKind::Socket) && t.setting.round() as usize == index
        });
        let fitted = term.and_then(|t| Some(Vector3::from_column_slice(t.coefficients.get(..3)?)));
        fitted.or(known.map(|p| p.coords))
    };
    Some((place(socket)? - place(last)?).norm())
}
