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
//! Where the robot should be has to be known before the rows are: a stretch of rows without a change locates the
//! instrument, whatever its own shift is, so each quarter of the session is tried with each shift. The path is then
//! improved by fits of the base model to rows that are paired again. It is reported where it is much better than the
//! best fit of the uncorrected rows, has residuals that are possible for a robot, and these are a step of the robot
//! without it: no effect does that.

#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_possible_wrap,
    clippy::cast_sign_loss,
    reason = "shifts are small whole numbers, and states of them are few"
)]

mod path;
mod starts;

use crate::answers::diagnosis::DataProblem;
use crate::effects::{Inputs, JointValues};
use crate::fit::problem::Problem;
use crate::fit::spread::places;
use crate::model::Positions;
use crate::numeric::median;
use crate::row_checks::listed;
use crate::sessions::{Session, SessionCorrection};
use crate::text::length;

use super::nearest::LEAST_SIGMA_MM;
use crate::fit::base_model;
use path::{MEDIAN_LENGTH, Path, Points};
use starts::starts;

/// How often a path is improved by a fit.
const MOST_ROUNDS: usize = 4;
/// So many of the likeliest paths are fitted …
const MOST_FITTED: usize = 3;
/// … to so many rows; of a long session they are spread evenly.
const MOST_ROWS: usize = 400;
/// The logarithm by which a shift has to be likelier.
const EVIDENCE: f64 = 25.0;
/// The residuals of the rows that move, as a share of those before.
const CORRECTED_SHARE: f64 = 0.25;
/// The largest residual of a robot with right rows, as a share of the size of the session.
const PLAUSIBLE_SHARE: f64 = 0.02;
/// A shift of all rows alike looks like a joint that lags: it is one where no robot lags so far.
const GROSS_SHARE: f64 = 0.01;
/// A step that is less than this share of the scatter does not show: neighbouring points cannot be distinguished, as
/// in a recording of a slow move.
const HIDDEN_SHARE: f64 = 0.25;
/// Where fewer than one row in so many has a longer step, no shift can be detected.
const FEWEST_HIDDEN: usize = 1000;

/// The shifts that are believed.
pub(super) fn shifted(session: &Session, values: JointValues) -> Vec<DataProblem> {
    let points = session
        .has_plain_points()
        .then(|| Points::of(session))
        .flatten();
    let found = points.and_then(|points| {
        let inputs = Inputs::new(session, values);
        let search = Search {
            session,
            values,
            inputs,
            points,
        };
        search.likeliest()
    });
    found.into_iter().collect()
}

/// A session whose rows may be shifted.
struct Search<'a> {
    session: &'a Session,
    values: JointValues,
    inputs: Inputs<'a>,
    points: Points<'a>,
}

/// A path and the fit that goes with it.
struct Fitted {
    path: Path,
    /// Where the robot is at every command.
    predicted: Positions,
    /// Scale of a coordinate of the deviations, mm.
    sigma_mm: f64,
}

impl Search<'_> {
    fn likeliest(&self) -> Option<DataProblem> {
        let points = &self.points;
        let mut trials = starts(self.session, &self.inputs, points);
        // The usual session: its rows are clearly right.
        if trials.first().is_some_and(|first| first.rows_are_right) {
            return None;
        }
        let uncorrected = self.fitted(Path::default())?;
        let hidden_mm = HIDDEN_SHARE * uncorrected.sigma_mm;
        if points.len() > FEWEST_HIDDEN * path::far_steps(&uncorrected.predicted, hidden_mm) {
            return None;
        }
        trials.sort_by(|a, b| a.cost.total_cmp(&b.cost));
        let given_the_fit = path::likeliest(points, &uncorrected.predicted, uncorrected.sigma_mm);
        let mut paths: Vec<Path> = Vec::new();
        for path in [given_the_fit]
            .into_iter()
            .chain(trials.into_iter().map(|t| t.path))
        {
            if path.is_shift() && !paths.contains(&path) {
                paths.push(path);
            }
        }
        let settled = paths
            .into_iter()
            .take(MOST_FITTED)
            .filter_map(|path| self.settled(path));
        let cost = |end: &Fitted| {
            self.cost(end, &end.path, end.sigma_mm) + points.len() as f64 * 3.0 * end.sigma_mm.ln()
        };
        let best = settled
            .map(|end| (cost(&end), end))
            .min_by(|a, b| a.0.total_cmp(&b.0));
        self.problem(&uncorrected, best?.1)
    }

    /// The base model fitted to rows that are paired again; `None` where no row remains.
    fn fitted(&self, path: Path) -> Option<Fitted> {
        let n = self.points.len();
        let mut part = self.session.clone();
        SessionCorrection::PairRows(path.changes.clone()).apply(&mut part);
        let some: Vec<Option<usize>> = places(n, MOST_ROWS).map(Some).collect();
        part.samples.select(&some);
        let mut problem = Problem::new(&part, self.values);
        if problem.samples() == 0 {
            return None;
        }
        let start = base_model::start(&part, &problem, |_| true);
        let predicted = base_model::fit(&mut problem, &start, true)
            .solution
            .model
            .predict(&self.inputs);
        let sigma_mm = self.typical(&predicted, &path, 0..n)? / MEDIAN_LENGTH;
        Some(Fitted {
            path,
            predicted,
            sigma_mm: sigma_mm.max(LEAST_SIGMA_MM),
        })
    }

    /// A path that fits itself.
    fn settled(&self, path: Path) -> Option<Fitted> {
        let mut end = self.fitted(path)?;
        for _ in 0..MOST_ROUNDS {
            let next = path::likeliest(&self.points, &end.predicted, end.sigma_mm);
            if next == end.path {
                break;
            }
            end = self.fitted(Some(next).filter(Path::is_shift)?)?;
        }
        Some(end)
    }

    /// The cost of the deviations along a path given a fit, with the penalty of its changes.
    fn cost(&self, fit: &Fitted, path: &Path, sigma_mm: f64) -> f64 {
        let n = self.points.len();
        let of = |row: usize| {
            let point = path.point_of(row, n);
            path::cost(
                point.and_then(|p| self.points.deviation_mm(&fit.predicted, row, p)),
                sigma_mm,
            )
        };
        (0..n).map(of).sum::<f64>() + path.price(n)
    }

    /// The median deviation of some rows along a path, mm.
    fn typical(
        &self,
        predicted: &Positions,
        path: &Path,
        mut rows: impl Iterator<Item = usize>,
    ) -> Option<f64> {
        let n = self.points.len();
        let of = |row: usize| {
            self.points
                .deviation_mm(predicted, row, path.point_of(row, n)?)
        };
        median(rows.by_ref().filter_map(of))
    }

    /// The message about a path that is accepted.
    fn problem(&self, uncorrected: &Fitted, end: Fitted) -> Option<DataProblem> {
        let (n, size) = (self.points.len(), self.points.size_mm());
        let cost_uncorrected = |sigma_mm: f64| self.cost(uncorrected, &uncorrected.path, sigma_mm);
        let evidence = cost_uncorrected(end.sigma_mm) - self.cost(&end, &end.path, end.sigma_mm);
        let rows: Vec<usize> = end.path.moved(n).collect();
        let of_moved = |fit: &Fitted| self.typical(&fit.predicted, &fit.path, rows.iter().copied());
        let of_all = |fit: &Fitted| self.typical(&fit.predicted, &fit.path, 0..n);
        let (before, after) = (of_moved(uncorrected)?, of_moved(&end)?);
        let gross = end.path.changes.len() > 1 || end.path.changes[0].0 > 0;
        let believed = evidence > EVIDENCE
            && after < CORRECTED_SHARE * before
            && of_all(&end)? < PLAUSIBLE_SHARE * size
            && (gross || of_all(uncorrected)? > GROSS_SHARE * size);
        if !believed {
            return None;
        }
        let lost = (0..n).filter(|row| end.path.point_of(*row, n).is_none());
        let lost: Vec<usize> = lost.collect();
        let away = end
            .path
            .changes
            .iter()
            .map(|change| change.1.unsigned_abs());
        let cause = end.path.in_words();
        let what = match away.max() {
            Some(largest @ 2..) => {
                text!(
                    "rows shifted by one (or up to {largest}): {cause}",
                    largest,
                    cause
                )
            }
            _ => text!("rows shifted by one: {cause}", cause),
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
        let evidence = text!(
            "{rows} rows are {before} from where the robot can be (median) as they are, and {after} paired again; more than 1000 times likelier",
            rows = rows.len(),
            before = length(before, 3),
            after = length(after, 3)
        );
        let correction = SessionCorrection::PairRows(end.path.changes);
        Some(DataProblem {
            samples: rows,
            ..DataProblem::of_all(what, evidence, proposal, correction)
        })
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
