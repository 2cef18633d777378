//! A fit that a group of samples elsewhere does not mislead.

use crate::effects::{JointValues, Term, joint_zero, tool_radius};
use crate::fit::gap::lengths_mm;
use crate::fit::problem::Problem;
use crate::fit::spread::places;
use crate::fit::{base_model, fit_without_outliers, free_frames};
use crate::kinematics::JointKind;
use crate::model::Model;
use crate::sessions::Session;
use crate::set_up_errors::thresholds::MOST_SAMPLES;

/// Of more places than these the trials, each a fit of all of them, would take longer than the answer.
pub(super) const MOST_PLACES: usize = 64;

/// Some samples of a session, whole.
pub(super) fn thinned(session: &Session) -> Session {
    let n = session.samples.len();
    let mut part = session.clone();
    if n > MOST_SAMPLES {
        let some = places(n, MOST_SAMPLES).map(Some);
        part.samples.select(&some.collect::<Vec<_>>());
    }
    part
}

/// The base model fitted to a session, and the root mean square of what it leaves, mm, without the
/// twentieth of the samples that is farthest off.
pub(in crate::set_up_errors) fn fitted(
    session: &Session,
    values: JointValues,
) -> Option<(Model, f64)> {
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

/// What the base model leaves of a session, mm, without the twentieth of the samples that is farthest off.
pub(in crate::set_up_errors) fn left_mm(session: &Session, values: JointValues) -> Option<f64> {
    Some(fitted(&thinned(session), values)?.1)
}

/// Root mean square of what a model leaves, mm, without the twentieth of the samples that is farthest off.
pub(super) fn trimmed_rms_mm(problem: &Problem, model: &Model) -> f64 {
    let mut lengths = lengths_mm(problem, model);
    lengths.retain(|v| v.is_finite());
    lengths.sort_by(f64::total_cmp);
    lengths.truncate(lengths.len() - lengths.len() / 20);
    let square = lengths.iter().map(|v| v * v).sum::<f64>() / lengths.len().max(1) as f64;
    square.sqrt()
}

/// The base model of a session, absent.
pub(in crate::set_up_errors) fn start_of(session: &Session, problem: &Problem) -> Model {
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
