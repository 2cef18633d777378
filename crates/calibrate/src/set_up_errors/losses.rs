//! Samples in which the instrument did not measure what it should. They are reported, and no fit counts them anyway.

use std::borrow::Cow;

use nalgebra::Vector3;

use crate::answers::diagnosis::DataProblem;
use crate::effects::{Inputs, JointValues};
use crate::fit::problem::Problem;
use crate::kinematics::Range;
use crate::model::Model;
use crate::sessions::Session;
use crate::text::Text;

use super::thresholds::{MOVED_MM, SAME_MM};
use crate::fit::base_model;

/// So many points at one place are no accident.
const FEWEST_STUCK: usize = 3;
/// With fewer samples no outlier is certain, with more a fit takes long.
const SAMPLES: std::ops::RangeInclusive<usize> = 8..=20_000;

/// Samples where the instrument lost the reflector.
pub(super) fn lost(session: &Session) -> Vec<DataProblem> {
    let mut lost = session.samples.lost_reflector();
    lost.retain(|row| !session.samples.is_excluded(*row));
    some(lost, |rows, which| {
        DataProblem::of_rows(
            text!(
                one "the instrument lost the reflector in {count} sample: {which}",
                "the instrument lost the reflector in {count} samples: {which}",
                count = rows.len(),
                which
            ),
            text!("it wrote 0, 0, 0"),
            text!("these samples are excluded; measure them again"),
            rows,
        )
    })
}

/// The message about some samples, if there are any: with their indices, and as a person reads them, counted from 1.
fn some(rows: Vec<usize>, problem: impl Fn(Vec<usize>, Text) -> DataProblem) -> Vec<DataProblem> {
    let first = rows.iter().take(8).map(|i| (i + 1).to_string());
    let first = first.collect::<Vec<_>>().join(", ");
    let which = match rows.len().saturating_sub(8) {
        0 => Text::verbatim(first),
        more => text!("{first} and {more} more", first, more),
    };
    let found = (!rows.is_empty()).then(|| problem(rows, which));
    found.into_iter().collect()
}

/// Samples that are far off and lie where another reflector is, or all at one place.
pub(super) fn mislocked(session: &Session, values: JointValues) -> Vec<DataProblem> {
    if !SAMPLES.contains(&session.samples.len()) {
        return Vec::new();
    }
    let mut problem = Problem::new(session, values);
    let start = base_model::start(session, &problem, |_| true);
    let fitted = base_model::fit(&mut problem, &start, true).solution.model;
    let is_off = |i: &usize| problem.fit[*i] && !problem.used[*i];
    let off: Vec<usize> = (0..problem.fit.len()).filter(is_off).collect();
    if off.is_empty() || off.len() * 3 > problem.fit.len() {
        return Vec::new();
    }
    let mut problems = Vec::new();
    for (other, target) in (0..).zip(&session.targets) {
        let mut inputs = problem.inputs.clone();
        inputs.target = Some(Cow::Owned(vec![other; inputs.len()]));
        let elsewhere = fitted.predict(&inputs);
        let is_its = |i: usize| {
            let own = problem.inputs.target.as_ref().map_or(0, |t| t[i]);
            let apart = point(session, i) - Vector3::from(elsewhere.get(i));
            own != other && apart.norm() < MOVED_MM
        };
        let close = off.iter().copied().filter(|i| is_its(*i)).collect();
        let name = &target.name;
        problems.extend(some(close, |rows, which| {
            DataProblem::of_rows(
                text!(
                    one "the instrument saw reflector {name} instead in {count} sample: {which}",
                    "the instrument saw reflector {name} instead in {count} samples: {which}",
                    name,
                    count = rows.len(),
                    which
                ),
                text!("the points lie where {name} should be", name),
                text!("these samples are excluded; correct their target or measure them again"),
                rows,
            )
        }));
    }
    problems.extend(at_one_place(session, &problem, &fitted, &off));
    problems
}

/// The same point again and again while the commands move the robot. Where the robot was there at one of them, it is
/// the robot that stood still; with equal commands it is normal.
fn at_one_place(
    session: &Session,
    problem: &Problem,
    fitted: &Model,
    off: &[usize],
) -> Vec<DataProblem> {
    let at = |i: usize| point(session, i);
    let predicted = fitted.predict(&problem.inputs);
    let place = |i: usize| Vector3::from(predicted.get(i));
    let is_same = |i: usize, j: usize| (at(i) - at(j)).norm() < SAME_MM;
    let moves = |i: usize, j: usize| (place(i) - place(j)).norm() > MOVED_MM;
    let stuck = off.iter().copied().filter(|i| {
        let same = || off.iter().copied().filter(|j| is_same(*i, *j));
        same().count() >= FEWEST_STUCK && same().any(|j| moves(*i, j))
    });
    let at_the_limits = fitted.predict(&within_limits(session, &problem.inputs));
    let is_at_a_limit = |i: usize| {
        let limit = Vector3::from(at_the_limits.get(i));
        (at(i) - limit).norm() < MOVED_MM && (place(i) - limit).norm() > MOVED_MM
    };
    let was_there = |i: &usize| {
        is_at_a_limit(*i) || (0..problem.used.len()).any(|j| problem.used[j] && is_same(*i, j))
    };
    let (still, stuck): (Vec<usize>, Vec<usize>) = stuck.partition(was_there);
    let mut problems = some(still, |rows, which| {
        DataProblem::of_rows(
            text!(
                one "the robot stood still in {count} sample: {which}",
                "the robot stood still in {count} samples: {which}",
                count = rows.len(),
                which
            ),
            text!(
                "the measured point stays where the robot is at another command or at the limit of a joint, while the commands move on"
            ),
            text!("these samples are excluded; look for a stop or a limit, and measure them again"),
            rows,
        )
    });
    problems.extend(some(stuck, |rows, which| {
        DataProblem::of_rows(
            text!(
                one "the instrument was locked on a point that does not move in {count} sample: {which}",
                "the instrument was locked on a point that does not move in {count} samples: {which}",
                count = rows.len(),
                which
            ),
            text!("the measured point stays while the robot moves"),
            text!("these samples are excluded; measure them again"),
            rows,
        )
    }));
    problems
}

/// Where a sample was measured, mm; in a plane without height.
fn point(session: &Session, i: usize) -> Vector3<f64> {
    let [x, y, z] = session.samples.coordinates(i);
    Vector3::new(
        x,
        y,
        if session.samples.z_mm.is_some() {
            z
        } else {
            0.0
        },
    )
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
