//! Rows whose measured points belong to the commands before or after: a point is missing, or is there
//! twice, in the file of the instrument, and from there on every row is one off.
//!
//! Which row a point belongs to is a hidden state s of every row i, its point being that of row i + s;
//! it changes at few rows. With the deviation r(i, s) of point i + s from where the robot should be at
//! command i, heavy-tailed noise of scale σ, and a price for every change, the likeliest path of states
//! is found in one pass (Viterbi 1967), at a cost linear in the rows:
//!
//! ```text
//! C = Σ_i ½(ν + d) ln(1 + r(i, s_i)²/(ν σ²)) + Σ changes · price
//! ```
//!
//! Where the robot should be has to be known before the rows are: a stretch of rows that no change
//! falls into shows where the instrument stands, whatever its own shift is, so each quarter of the
//! session is tried with each shift. The path is then improved by fits of the base model to rows that
//! are paired again. It is said where it is better by far than the best fit of the rows as they are,
//! leaves what a robot may leave, and misses by a step of the robot without it: no effect does that.

mod fitted;
mod path;
mod starts;

use crate::answers::diagnosis::DataProblem;
use crate::effects::{Inputs, JointValues};
use crate::numeric::median;
use crate::sessions::{Session, SessionCorrection};
use crate::text::length;

use super::problem::listed;
use fitted::{Fitted, fitted};
use path::{FEWEST_SAMPLES, Path, Points};
use starts::starts;
/// How often a path is improved by a fit.
const MOST_ROUNDS: usize = 4;
/// So many of the likeliest paths are fitted.
const MOST_FITTED: usize = 3;
/// The logarithm by which a shift has to be likelier.
const EVIDENCE: f64 = 25.0;
/// What the rows that move leave afterwards, as a share of before.
const MENDED_SHARE: f64 = 0.25;
/// What a robot may leave once its rows are right, as a share of the size of the session.
const PLAUSIBLE_SHARE: f64 = 0.02;
/// A shift of all rows alike looks like a joint that lags: it is one where no robot lags so far.
const GROSS_SHARE: f64 = 0.01;
/// A step that is less than this share of the scatter does not show: no point can be told from the one beside
/// it, as in a recording of a slow move.
const HIDDEN_SHARE: f64 = 0.25;
/// Where fewer than one row in so many has a longer step, no shift can be seen.
const FEWEST_HIDDEN: usize = 1000;
/// More changes than this are no points that were lost.
const MOST_CHANGES: usize = 8;

pub(super) fn shifted(session: &Session, values: JointValues) -> Vec<DataProblem> {
    let found = search(session, values);
    found
        .map(|found| found.problem(session))
        .into_iter()
        .collect()
}

/// A path that is believed.
struct BelievedPath {
    path: Path,
    /// Median deviation as the rows are and paired again, mm.
    median_mm: [f64; 2],
}

fn search(session: &Session, values: JointValues) -> Option<BelievedPath> {
    if session.samples.len() < FEWEST_SAMPLES || !session.has_plain_points() {
        return None;
    }
    let inputs = Inputs::new(session, values);
    let points = Points::of(session)?;
    let mut trials = starts(session, &inputs, &points);
    // The usual session: its rows are right, and nothing is in doubt.
    if trials.first().is_some_and(|first| first.rows_are_right) {
        return None;
    }
    let as_it_is = fitted(session, values, &inputs, &points, &Path::default())?;
    let hidden_mm = HIDDEN_SHARE * as_it_is.sigma_mm;
    if points.len() > FEWEST_HIDDEN * path::far_steps(&as_it_is.predicted, hidden_mm) {
        return None;
    }
    let mut paths: Vec<Path> = Vec::new();
    if let Some(path) = path::likeliest(&points, &as_it_is.predicted, as_it_is.sigma_mm) {
        paths.push(path);
    }
    trials.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    paths.extend(trials.into_iter().map(|trial| trial.path));
    paths.retain(|path| !path.is_none() && path.changes.len() <= MOST_CHANGES);
    let mut tried: Vec<Path> = Vec::new();
    let mut best: Option<(f64, Path, Fitted)> = None;
    for path in paths {
        if tried.len() >= MOST_FITTED {
            break;
        }
        if tried.contains(&path) {
            continue;
        }
        tried.push(path.clone());
        let Some((path, end)) = settled(session, values, &inputs, &points, path) else {
            continue;
        };
        let cost = end.cost_at(&points, &path, end.sigma_mm)
            + path.price(points.len())
            + points.len() as f64 * 3.0 * end.sigma_mm.ln();
        if best.as_ref().is_none_or(|b| cost < b.0) {
            best = Some((cost, path, end));
        }
    }
    let (_, path, end) = best?;
    judged(&points, path, &as_it_is, &end)
}

/// A path and the fit that goes with it.
fn settled(
    session: &Session,
    values: JointValues,
    inputs: &Inputs,
    points: &Points<'_>,
    mut path: Path,
) -> Option<(Path, Fitted)> {
    let mut end = fitted(session, values, inputs, points, &path)?;
    for _ in 0..MOST_ROUNDS {
        let next = path::likeliest(points, &end.predicted, end.sigma_mm).unwrap_or_default();
        if next == path {
            break;
        }
        if next.is_none() || next.changes.len() > MOST_CHANGES {
            return None;
        }
        path = next;
        end = fitted(session, values, inputs, points, &path)?;
    }
    Some((path, end))
}

/// Whether a path is to be believed.
fn judged(
    points: &Points<'_>,
    path: Path,
    as_it_is: &Fitted,
    end: &Fitted,
) -> Option<BelievedPath> {
    let none = Path::default();
    let before = as_it_is.cost_at(points, &none, end.sigma_mm);
    let after = end.cost_at(points, &path, end.sigma_mm) + path.price(points.len());
    let evidence = before - after;
    let moved: Vec<usize> = path.moved(points.len()).collect();
    let with = |fit: &Fitted, path: &Path, rows: &[usize]| {
        median(rows.iter().filter_map(|row| {
            let point = path.point_of(*row, points.len())?;
            points.deviation_mm(&fit.predicted, *row, point)
        }))
    };
    let all: Vec<usize> = (0..points.len()).collect();
    let of_moved = [with(as_it_is, &none, &moved)?, with(end, &path, &moved)?];
    let of_all = [with(as_it_is, &none, &all)?, with(end, &path, &all)?];
    let size = points.size_mm();
    let gross = path.changes.len() > 1 || path.changes[0].0 > 0;
    let believed = evidence > EVIDENCE
        && of_moved[1] < MENDED_SHARE * of_moved[0]
        && of_all[1] < PLAUSIBLE_SHARE * size
        && (gross || of_all[0] > GROSS_SHARE * size);
    believed.then_some(BelievedPath {
        path,
        median_mm: [of_moved[0], of_moved[1]],
    })
}

impl BelievedPath {
    fn problem(self, session: &Session) -> DataProblem {
        let n = session.samples.len();
        let rows: Vec<usize> = self.path.moved(n).collect();
        let lost: Vec<usize> = (0..n)
            .filter(|row| self.path.point_of(*row, n).is_none())
            .collect();
        let largest = self
            .path
            .changes
            .iter()
            .map(|c| c.1.abs())
            .max()
            .unwrap_or(1);
        let cause = self.path.in_words();
        let what = if largest == 1 {
            text!("rows shifted by one: {cause}", cause)
        } else {
            text!(
                "rows shifted by one (or up to {largest}): {cause}",
                largest = largest.unsigned_abs(),
                cause
            )
        };
        let proposal = if lost.is_empty() {
            text!(
                "the rows are paired again; look for the point that is missing or there twice in the instrument's file"
            )
        } else {
            text!(
                "the rows are paired again; {lost} left without a point; look for the point that is missing or there twice in the instrument's file",
                lost = listed(&lost)
            )
        };
        DataProblem {
            what,
            evidence: text!(
                "{rows} rows are {before} from where the robot can be (median) as they are, and {after} paired again; more than 1000 times likelier",
                rows = rows.len(),
                before = length(self.median_mm[0], 3),
                after = length(self.median_mm[1], 3)
            ),
            proposal,
            mend: Some(SessionCorrection::PairRows(self.path.changes.clone())),
            samples: rows,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::row_checks::tests::axis;

    /// The points of a session as a file has them in which one is missing from this row on.
    fn lost_at(session: &mut Session, row: usize) {
        let samples = &mut session.samples;
        let n = samples.len();
        let columns = [&mut samples.x_mm, &mut samples.y_mm];
        for column in columns.into_iter().chain(samples.z_mm.as_mut()) {
            let lost = column.remove(row);
            // The file has one point less, and its last row none.
            column.push(if row + 1 == n { lost } else { f64::NAN });
        }
    }

    #[test]
    fn a_point_that_is_missing_is_found_wherever_it_is() {
        for row in [0, 2, 10, 33, 55, 57] {
            let mut session = axis(60);
            let right = session.clone();
            lost_at(&mut session, row);
            let problems = shifted(&session, JointValues::Commanded);
            assert_eq!(problems.len(), 1, "{row}");
            assert!(
                problems[0].what.contains("rows shifted by one"),
                "{problems:?}"
            );
            problems[0]
                .mend
                .as_ref()
                .expect("known")
                .apply(&mut session);
            for k in 0..60 {
                let x = session.samples.x_mm[k];
                let same = x.to_bits() == right.samples.x_mm[k].to_bits();
                assert!(same || k == row && x.is_nan(), "{row}: {k}");
            }
        }
    }

    #[test]
    fn rows_that_are_right_are_left_alone() {
        assert!(shifted(&axis(60), JointValues::Commanded).is_empty());
        let mut session = axis(60);
        // A large zero offset and a link of another length are no shift.
        let q = &mut session.samples.q[0];
        for q in q.iter_mut() {
            *q += 0.1;
        }
        assert!(shifted(&session, JointValues::Commanded).is_empty());
    }
}
