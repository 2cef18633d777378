//! Set-up errors, tried before any effect: on a real arm with a tracker they were worth
//! more than any effect, and faked one.
//!
//! A set-up error is a hypothesis about the data: the session is changed as the error would have it,
//! the base fit is made again, and the change is believed if the gap falls to a small part of
//! what it was and only then makes sense for a robot. The search goes on with the mended session.

mod arm_hypotheses;
mod arms;
mod as_it_stands;
mod corrected;
mod gravity;
mod groups;
mod hypotheses;
mod left;
mod looked;
mod losses;
mod measured_points;
mod motor_values;
mod orientation_frame;
mod orientations;
mod parts;
mod read_back;
mod refraction;
mod settling;
mod several;
mod station_scale;
mod targets_in_base;
mod thinned;
mod thresholds;
mod trial;

use std::borrow::Cow;

pub use crate::answers::diagnosis::DataProblem;
use crate::effects::{JointValues, Role, Term, joint_zero, tool_radius};
use crate::fit::gap::deviations;
use crate::fit::problem::Problem;
use crate::fit::solver::solve;
use crate::kinematics::JointKind;
use crate::model::Model;
use crate::row_checks;
use crate::sessions::{Session, SessionCorrection};
use crate::text::length;
use crate::units::rad_from_deg;
pub use corrected::CorrectedSession;

use crate::fit::base_model;

use corrected::made_for;
use hypotheses::{Hypothesis, change_of_measure, hypotheses};
use looked::Looked;
use losses::{losses, mislocked};
use thinned::thinned;
use thresholds::{FEWEST_SAMPLES, GROSS_SHARE, LARGEST_OFFSET_DEG, MENDED_SHARE};

/// They are tried on whole points, where they are so large a part of the samples.
const ENOUGH_POINTS: f64 = 0.5;

fn has_enough_points(session: &Session, joint_values: JointValues) -> bool {
    if session.has_plain_points() {
        return true;
    }
    let points = Problem::new(session, joint_values).samples();
    let all = Problem::observing(session, joint_values).samples();
    points as f64 >= ENOUGH_POINTS * all as f64
}

/// Checks the rows, tries the set-up errors and corrects what it finds.
///
/// A session that cannot be computed with ([`Session::checked`] says why) stays as it is.
pub fn corrected_session(raw: &Session, joint_values: JointValues) -> CorrectedSession<'_> {
    match raw.whole() {
        Ok(Cow::Borrowed(raw)) => mended(raw, joint_values),
        Ok(Cow::Owned(completed)) => {
            let CorrectedSession { session, problems } = mended(&completed, joint_values);
            CorrectedSession {
                session: Cow::Owned(session.into_owned()),
                problems,
            }
        }
        Err(_) => CorrectedSession {
            session: Cow::Borrowed(raw),
            problems: Vec::new(),
        },
    }
}

/// The same of a session that is whole.
pub(crate) fn mended(raw: &Session, joint_values: JointValues) -> CorrectedSession<'_> {
    without_mistakes(raw, joint_values, true)
}

/// The rows and the gross mistakes alone, for an identification.
#[doc(hidden)]
pub fn noticed(raw: &Session, joint_values: JointValues) -> CorrectedSession<'_> {
    without_mistakes(raw, joint_values, false)
}

/// Where coordinates have another unit, the rows are checked again with the right one: their digits are of another size.
fn without_mistakes(
    raw: &Session,
    joint_values: JointValues,
    small_ones: bool,
) -> CorrectedSession<'_> {
    let first = without_mistakes_of(raw, joint_values, small_ones);
    let of_digits =
        |problem: &DataProblem| matches!(problem.mend, Some(SessionCorrection::WidenNoise(_)));
    let of_lengths = |problem: &&DataProblem| {
        matches!(
            problem.mend,
            Some(SessionCorrection::ScaleLengths(_) | SessionCorrection::ScaleCoordinate { .. })
        )
    };
    let lengths: Vec<DataProblem> = first.problems.iter().filter(of_lengths).cloned().collect();
    if lengths.is_empty() || !first.problems.iter().any(of_digits) {
        return first;
    }
    let mut scaled = raw.clone();
    for mend in made_for(&lengths) {
        mend.apply(&mut scaled);
    }
    let again = without_mistakes_of(&scaled, joint_values, small_ones);
    let CorrectedSession { session, problems } = again;
    let mut session = session.into_owned();
    let mut made: Vec<SessionCorrection> = made_for(&lengths).collect();
    if raw.samples.corrected.is_none() {
        made.extend(
            session
                .samples
                .corrected
                .take()
                .into_iter()
                .flat_map(|c| c.by),
        );
    }
    let problems = lengths.into_iter().chain(problems).collect();
    CorrectedSession::new(raw, Cow::Owned(session), problems, made)
}

/// `small_ones`: samples that the instrument lost or took of another target, and values that were read back late, too.
fn without_mistakes_of(
    raw: &Session,
    joint_values: JointValues,
    small_ones: bool,
) -> CorrectedSession<'_> {
    let checked = row_checks::checked(raw, joint_values);
    let (mut session, mut problems) = (checked.session, checked.problems);
    let whole_points = has_enough_points(raw, joint_values);
    if whole_points
        && let Some(placed) = targets_in_base::corrected(&session, joint_values, &mut problems)
    {
        session = Cow::Owned(placed);
    }
    let mut made: Vec<SessionCorrection> = made_for(&problems).collect();
    let small_ones = whole_points && small_ones;
    if small_ones {
        losses(raw, &mut problems);
    }
    // What was only said until here was not made.
    let known = problems.len();
    if whole_points {
        // With a part that differs no one change of all rows fits, and many would be tried.
        if let Some(better) = parts::gross(&session, joint_values, &mut problems) {
            session = Cow::Owned(better);
        }
        let corrected = if base_model::is_arm(raw) {
            arms::corrected(&session, joint_values, &mut problems)
        } else {
            of_one_joint(&session, joint_values, &mut problems)
        };
        if let Some(better) = corrected {
            session = Cow::Owned(better);
        }
    }
    if let Some(turned) = parts::steps(&session, joint_values, &mut problems) {
        session = Cow::Owned(turned);
    }
    if let Some(freed) = groups::freed(&session, joint_values, &mut problems) {
        session = Cow::Owned(freed);
    }
    if whole_points
        && let Some(without) = orientations::left_out(&session, joint_values, &mut problems)
    {
        session = Cow::Owned(without);
    }
    if whole_points
        && let Some(without) = orientation_frame::left_out(&session, joint_values, &mut problems)
    {
        session = Cow::Owned(without);
    }
    if small_ones
        && let Some(brought_up) = read_back::lagging(&session, joint_values, &mut problems)
    {
        session = Cow::Owned(brought_up);
    }
    if small_ones {
        rarely_stated(&mut session, joint_values, &mut problems);
    }
    made.extend(made_for(&problems[known..]));
    if small_ones {
        mislocked(&session, joint_values, &mut problems);
    }
    CorrectedSession::new(raw, session, problems, made)
}

/// What instruments, stations and mountings do that no session states. One fit serves all of them until one changes the
/// session.
fn rarely_stated(session: &mut Cow<Session>, values: JointValues, problems: &mut Vec<DataProblem>) {
    let mut looked = None;
    for corrected in [
        settling::corrected,
        refraction::straightened,
        station_scale::corrected,
        gravity::turned,
    ] {
        looked = looked.or_else(|| Looked::at(session, values));
        let better = looked
            .as_ref()
            .and_then(|looked| corrected(session, values, looked, problems));
        if let Some(better) = better {
            *session = Cow::Owned(better);
            looked = None;
        }
    }
}

/// The session of a single joint without its mistakes; `None` where there is none. One error may hide another: at
/// most two in a row.
fn of_one_joint(
    session: &Session,
    joint_values: JointValues,
    problems: &mut Vec<DataProblem>,
) -> Option<Session> {
    let mut mended: Option<Session> = None;
    for _ in 0..2 {
        let now = mended.as_ref().unwrap_or(session);
        let Some((better, problem)) = gross_error(now, joint_values) else {
            break;
        };
        problems.push(problem);
        mended = Some(better);
    }
    mended
}

fn gross_error(session: &Session, joint_values: JointValues) -> Option<(Session, DataProblem)> {
    let sample = thinned(session);
    if sample.samples.len() < FEWEST_SAMPLES {
        return None;
    }
    let gap = base_gap(&sample, joint_values)?;
    let size = size_mm(&sample);
    if gap < GROSS_SHARE * size {
        return None;
    }
    let mut best: Option<(f64, Hypothesis)> = None;
    for hypothesis in hypotheses(&sample, joint_values, |trial| base_gap(trial, joint_values)) {
        let mut trial = sample.clone();
        hypothesis.mend.apply(&mut trial);
        let Some(after) = base_gap(&trial, joint_values) else {
            continue;
        };
        let mends = std::slice::from_ref(&hypothesis.mend);
        let after = after * change_of_measure(mends, size, size_mm(&trial));
        if after < MENDED_SHARE * gap && best.as_ref().is_none_or(|b| after < 0.8 * b.0) {
            best = Some((after, hypothesis));
        }
    }
    let (after, hypothesis) = best?;
    let mut better = session.clone();
    hypothesis.mend.apply(&mut better);
    let problem = DataProblem {
        evidence: text!(
            "with zero offset and link length fitted the RMS error is {before} as it stands and {after} with the set-up error corrected",
            before = length(gap, 3),
            after = length(after, 3)
        ),
        what: hypothesis.what,
        proposal: hypothesis.proposal,
        mend: Some(hypothesis.mend),
        samples: Vec::new(),
    };
    Some((better, problem))
}

/// The session's tool distance or the spread of its points, whichever is larger, mm.
fn size_mm(session: &Session) -> f64 {
    let samples = &session.samples;
    let square = |i: usize| {
        let z = samples.z_mm.as_ref().map_or(0.0, |z| z[i]);
        samples.x_mm[i].powi(2) + samples.y_mm[i].powi(2) + z * z
    };
    let all: Vec<f64> = (0..samples.len())
        .map(square)
        .filter(|v| v.is_finite())
        .collect();
    (all.iter().sum::<f64>() / all.len().max(1) as f64).sqrt()
}

/// Median length of the deviations after the base fit, mm. A zero offset beyond
/// [`LARGEST_OFFSET_DEG`] counts as a gap: a joint that reversed with its home a quarter turn off
/// would pass for two axes that were swapped. So does a link beyond [`LARGEST_STRETCH`].
fn base_gap(session: &Session, joint_values: JointValues) -> Option<f64> {
    let problem = Problem::new(session, joint_values);
    let mut terms = Vec::new();
    for joint in 0..session.robot.joints.len() {
        terms.push(Term::absent(joint_zero(), joint, 0.0));
    }
    if let [joint] = session.robot.joints.as_slice()
        && joint.kind == JointKind::Revolute
    {
        terms.push(Term::absent(tool_radius(), 0, 0.0));
    }
    terms.extend(crate::fit::free_frames(session, &problem));
    let start = Model::new(session.robot.clone(), terms);
    let fitted = solve(&problem, &start);
    let after = deviations(&problem, &fitted.model);
    let mut lengths: Vec<f64> = after
        .length_mm
        .iter()
        .copied()
        .filter(|v| v.is_finite())
        .collect();
    lengths.sort_by(f64::total_cmp);
    let median = lengths.get(lengths.len() / 2).copied()?;
    let offsets = fitted
        .model
        .terms()
        .iter()
        .filter(|t| t.effect.about().role == Role::JointZero);
    let largest = offsets
        .filter(|t| session.robot.joints[t.joint].kind == JointKind::Revolute)
        .map(|t| t.coefficients[0].sin().atan2(t.coefficients[0].cos()).abs())
        .fold(0.0, f64::max);
    let size = size_mm(session);
    let beyond = (largest - rad_from_deg(LARGEST_OFFSET_DEG)).max(0.0);
    let stretched = fitted
        .model
        .terms()
        .iter()
        .filter(|t| t.effect.about().role == Role::ToolRadius)
        .map(|t| (t.coefficients[0].abs() - LARGEST_STRETCH * size).max(0.0))
        .fold(0.0, f64::max);
    Some(median + beyond * size + stretched)
}
/// No link is longer or shorter than it should be by more than this share of the robot's size; one
/// that is turned inside out stands for half a turn.
const LARGEST_STRETCH: f64 = 0.2;
