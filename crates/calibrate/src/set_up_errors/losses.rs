//! Samples in which the instrument did not see what it should.

use std::borrow::Cow;

use nalgebra::Vector3;

use crate::effects::{Inputs, JointValues, Term, joint_zero};
use crate::fit::problem::{Problem, unusable};
use crate::fit::{base_model, fit_without_outliers};
use crate::kinematics::Range;
use crate::model::Model;
use crate::sessions::{Samples, Session, SessionCorrection};
use crate::text::Text;

use super::DataProblem;

/// Points within this are the same, mm.
const SAME_MM: f64 = 0.5;
/// A robot that goes farther has moved, mm.
const MOVED_MM: f64 = 3.0;
/// So many points at one place are no accident.
const FEWEST_STUCK: usize = 3;

/// Samples where the instrument lost the reflector.
pub(super) fn losses(session: &Session, problems: &mut Vec<DataProblem>) {
    use crate::fit::problem::UnusableReason;
    let lost: Vec<usize> = (0..session.samples.len())
        .filter(|i| unusable(session, *i) == Some(UnusableReason::LostReflector))
        .collect();
    if lost.is_empty() {
        return;
    }
    problems.push(DataProblem {
        what: text!(
            one "the instrument lost the reflector in {count} sample: {which}",
            "the instrument lost the reflector in {count} samples: {which}",
            count = lost.len(),
            which = listed(&lost)
        ),
        evidence: text!("it wrote 0, 0, 0"),
        proposal: text!("these samples are excluded; measure them again"),
        mend: Some(SessionCorrection::Remove(lost.clone())),
        samples: lost,
    });
}

/// Samples that are far off and lie where another reflector is, or all at one place.
pub(super) fn mislocked(
    session: &Session,
    joint_values: JointValues,
    problems: &mut Vec<DataProblem>,
) {
    if session.samples.len() > 20_000 || session.samples.len() < 8 {
        return;
    }
    let mut problem = Problem::new(session, joint_values);
    let fitted = if base_model::is_arm(session) {
        let start = base_model::start(session, &problem, |_| true);
        base_model::fit(&mut problem, &start, true).solution.model
    } else {
        let zero = Term::absent(joint_zero(), 0, 0.0);
        let start = Model::new(session.robot.clone(), vec![zero]);
        fit_without_outliers(&mut problem, &start).model
    };
    let off: Vec<usize> = (0..problem.fit.len())
        .filter(|i| problem.fit[*i] && !problem.used[*i])
        .collect();
    if off.is_empty() || off.len() * 3 > problem.fit.len() {
        return;
    }
    let samples = &session.samples;
    let at = |i: usize| point(samples, i);
    for other in 0..session.targets.len() {
        let mut inputs = problem.inputs.clone();
        let n = inputs.len();
        let number = u32::try_from(other).unwrap_or(0);
        inputs.target = Some(Cow::Owned(vec![number; n]));
        let elsewhere = fitted.predict(&inputs);
        let here = |i: usize| problem.inputs.target.as_ref().map_or(0, |t| t[i]) != number;
        let close: Vec<usize> = off
            .iter()
            .copied()
            .filter(|i| here(*i) && (at(*i) - Vector3::from(elsewhere.get(*i))).norm() < 3.0)
            .collect();
        if !close.is_empty() {
            let name = &session.targets[other].name;
            problems.push(DataProblem {
                what: text!(
                    one "the instrument saw reflector {name} instead in {count} sample: {which}",
                    "the instrument saw reflector {name} instead in {count} samples: {which}",
                    name,
                    count = close.len(),
                    which = listed(&close)
                ),
                evidence: text!("the points lie where {name} should be", name),
                proposal: text!(
                    "these samples are excluded; correct their target or measure them again"
                ),
                mend: Some(SessionCorrection::Remove(close.clone())),
                samples: close,
            });
        }
    }
    at_one_place(session, &problem, &fitted, &off, problems);
}

/// The same point again and again while the commands move the robot. Where the robot was there at one of them, it is
/// the robot that stood still; beside equal commands nothing is odd.
fn at_one_place(
    session: &Session,
    problem: &Problem,
    fitted: &Model,
    off: &[usize],
    problems: &mut Vec<DataProblem>,
) {
    let samples = &session.samples;
    let at = |i: usize| point(samples, i);
    let predicted = fitted.predict(&problem.inputs);
    let place = |i: usize| Vector3::from(predicted.get(i));
    let is_same = |i: usize, j: usize| (at(i) - at(j)).norm() < SAME_MM;
    let moves = |i: usize, j: usize| (place(i) - place(j)).norm() > MOVED_MM;
    let stuck = off.iter().copied().filter(|i| {
        let same = || off.iter().copied().filter(|j| is_same(*i, *j));
        same().count() >= FEWEST_STUCK && same().any(|j| moves(*i, j))
    });
    let stuck: Vec<usize> = stuck.collect();
    if stuck.is_empty() {
        return;
    }
    let at_the_limits = fitted.predict(&within_limits(session, &problem.inputs));
    let is_at_a_limit = |i: usize| {
        let limit = Vector3::from(at_the_limits.get(i));
        (at(i) - limit).norm() < MOVED_MM && (place(i) - limit).norm() > MOVED_MM
    };
    let was_there = |i: usize| {
        is_at_a_limit(i) || (0..problem.used.len()).any(|j| problem.used[j] && is_same(i, j))
    };
    let (still, stuck): (Vec<usize>, Vec<usize>) = stuck.into_iter().partition(|i| was_there(*i));
    if !still.is_empty() {
        problems.push(DataProblem {
            what: text!(
                one "the robot stood still in {count} sample: {which}",
                "the robot stood still in {count} samples: {which}",
                count = still.len(),
                which = listed(&still)
            ),
            evidence: text!(
                "the measured point stays where the robot is at another command or at the limit of a joint, while the commands move on"
            ),
            proposal: text!("these samples are excluded; look for a stop or a limit, and measure them again"),
            mend: Some(SessionCorrection::Remove(still.clone())),
            samples: still,
        });
    }
    if !stuck.is_empty() {
        problems.push(DataProblem {
            what: text!(
                one "the instrument was locked on a point that does not move in {count} sample: {which}",
                "the instrument was locked on a point that does not move in {count} samples: {which}",
                count = stuck.len(),
                which = listed(&stuck)
            ),
            evidence: text!("the measured point stays while the robot moves"),
            proposal: text!("these samples are excluded; measure them again"),
            mend: Some(SessionCorrection::Remove(stuck.clone())),
            samples: stuck,
        });
    }
}

/// Where a sample was measured, mm.
fn point(samples: &Samples, i: usize) -> Vector3<f64> {
    let z = samples.z_mm.as_ref().map_or(0.0, |z| z[i]);
    Vector3::new(samples.x_mm[i], samples.y_mm[i], z)
}

/// The commands as far as the limits of the joints let them.
fn within_limits<'a>(session: &Session, inputs: &Inputs<'a>) -> Inputs<'a> {
    let mut within = inputs.clone();
    for (joint, q) in session.robot.joints.iter().zip(&mut within.q) {
        if let Some(Range { from, to }) = joint.limits {
            let held = q.iter().map(|q| q.max(from).min(to));
            *q = Cow::Owned(held.collect());
        }
    }
    within
}

/// Sample numbers for reading, counted from 1.
fn listed(samples: &[usize]) -> Text {
    let first: Vec<String> = samples
        .iter()
        .take(8)
        .map(|i| (i + 1).to_string())
        .collect();
    let more = samples.len().saturating_sub(8);
    let first = first.join(", ");
    match more {
        0 => Text::verbatim(first),
        more => text!("{first} and {more} more", first, more),
    }
}
