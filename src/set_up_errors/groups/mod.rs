//! Places that samples share and that are elsewhere than they should be: a target in the tool, a socket
//! on the table, a setup, a station, a plane, an anchor. One place that is off spreads over everything that is
//! fitted beside it.
//!
//! Each is set free by itself, with the whole base model beside it, and believed where the samples are
//! likelier by far then, leave clearly less, and the place is off by more than what is known of it.

#![allow(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a setting is a small whole number"
)]

mod moved;
mod targets;

use crate::effects::{JointValues, Term, joint_zero, tool_radius};
use crate::fit::gap::lengths_mm;
use crate::fit::problem::Problem;
use crate::fit::{base_model, fit_without_outliers, free_frames};
use crate::kinematics::JointKind;
use crate::model::Model;
use crate::sessions::Session;
use crate::text::Text;

use super::DataProblem;

/// Samples that a trial looks at.
const MOST_SAMPLES: usize = 400;
/// Of more places than these the trials, each a fit of all of them, would take longer than the answer.
const MOST_PLACES: usize = 64;
/// With fewer samples nothing is told.
const FEWEST_SAMPLES: usize = 16;
/// The logarithm by which a place that is elsewhere has to make the samples likelier.
const EVIDENCE: f64 = 30.0;
/// … and the share of the error that it has to leave.
const LEAVES: f64 = 0.6;

/// The session with those places free that are elsewhere; `None` where none is.
pub(super) fn freed(
    session: &Session,
    values: JointValues,
    problems: &mut Vec<DataProblem>,
) -> Option<Session> {
    if session.samples.len() < FEWEST_SAMPLES {
        return None;
    }
    let moved = moved::moved(session, values, problems);
    let session = moved.as_ref().unwrap_or(session);
    let elsewhere = targets::elsewhere(session, values, problems);
    elsewhere.or(moved)
}

/// Every so many-th sample of a session, whole.
fn thinned(session: &Session) -> Session {
    let n = session.samples.len();
    let mut part = session.clone();
    if n > MOST_SAMPLES {
        let some = (0..MOST_SAMPLES).map(|k| Some(k * n / MOST_SAMPLES));
        part.samples.select(&some.collect::<Vec<_>>());
    }
    part
}

/// The base model fitted to a session, and the root mean square of what it leaves, mm, without the
/// twentieth of the samples that is farthest off.
fn fitted(session: &Session, values: JointValues) -> Option<(Model, f64)> {
    let mut problem = Problem::observing(session, values);
    if problem.samples() == 0 {
        return None;
    }
    let model = if base_model::is_arm(session) || problem.observed.is_some() {
        let start = start_of(session, &problem);
        base_model::fit(&mut problem, &start, true).solution.model
    } else {
        let start = start_of(session, &problem);
        fit_without_outliers(&mut problem, &start).model
    };
    let left = trimmed_rms_mm(&problem, &model);
    Some((model, left))
}

/// Root mean square of what a model leaves, mm, without the twentieth of the samples that is farthest off.
fn trimmed_rms_mm(problem: &Problem, model: &Model) -> f64 {
    let mut lengths = lengths_mm(problem, model);
    lengths.retain(|v| v.is_finite());
    lengths.sort_by(f64::total_cmp);
    lengths.truncate(lengths.len() - lengths.len() / 20);
    let square = lengths.iter().map(|v| v * v).sum::<f64>() / lengths.len().max(1) as f64;
    square.sqrt()
}

fn start_of(session: &Session, problem: &Problem) -> Model {
    if base_model::is_arm(session) {
        return base_model::start(session, problem, |_| true);
    }
    let mut terms = vec![Term::absent(joint_zero(), 0, 0.0)];
    let joints = session.robot.joints.as_slice();
    if matches!(joints, [joint] if joint.kind == JointKind::Revolute) {
        terms.push(Term::absent(tool_radius(), 0, 0.0));
    }
    terms.extend(match &problem.observed {
        Some(layer) => crate::fit::observed::terms_beside(session, layer),
        None => free_frames(session, problem),
    });
    Model::new(session.robot.clone(), terms)
}

/// How much likelier samples are of which so many leave less, beside more numbers.
fn evidence(samples: usize, axes: usize, before_mm: f64, after_mm: f64, numbers: usize) -> f64 {
    let rows = (samples * axes) as f64;
    let gain = rows * (before_mm / after_mm.max(1e-9)).max(1e-9).ln();
    gain - 0.5 * numbers as f64 * rows.max(2.0).ln()
}

/// Whether that is enough for belief, where no more than this share of the error may be left.
fn is_believed(evidence: f64, before_mm: f64, after_mm: f64, leaves: f64) -> bool {
    evidence > EVIDENCE && after_mm < leaves * before_mm
}

fn in_numbers(before_mm: f64, after_mm: f64, evidence: f64) -> Text {
    text!(
        "the base model leaves {before} mm as it stands and {after} mm with the place free; e^{evidence} times likelier",
        before = format!("{before_mm:.3}"),
        after = format!("{after_mm:.3}"),
        evidence = format!("{evidence:.0}")
    )
}
