//! A robot with several joints as its session stands, and what a change of it has to be for belief.
//!
//! The frame, the tool and the zero offsets alone run away where few poses show them, and then anything
//! is better. So the session as it stands is also seen by the nominal robot with the best rigid motion,
//! and by the whole base model with its priors; the best of all counts. A change keeps the samples to
//! the robot's scale, ends with values that a robot may have, and predicts samples that it was not
//! fitted to.

use nalgebra::Vector3;

use crate::answers::far_tool::farthest_tool_mm;
use crate::effects::{JointValues, MEASURING_FRAME, TOOL_POSITION, joint_zero};
use crate::fit::base_model;
use crate::fit::gap::lengths_mm;
use crate::fit::problem::Problem;
use crate::kinematics::JointKind;
use crate::model::Model;
use crate::sessions::{Session, SessionCorrection};
use crate::units::rad_from_deg;

use super::thresholds::LARGEST_OFFSET_DEG;
use super::trial::{in_order, trial, within};

/// The spread of the points agrees with that of the robot within this, as a ratio.
const TO_SCALE: f64 = 2.0;
/// With fewer samples none can be kept back.
const FEWEST_TO_SPLIT: usize = 24;
/// Samples that were kept back leave at most so many times as much as a change may leave.
const UNSEEN: f64 = 2.0;

/// The least that so large a share of the samples is off by as the session stands, mm; infinite where nothing fits.
pub(super) fn least_mm(part: &Session, values: JointValues, free_frame: bool, share: f64) -> f64 {
    let nominal_mm = nominal_mm(part, values, free_frame, share);
    nominal_mm.min(with_priors_mm(part, values, free_frame, share))
}

/// What so large a share of the samples is off by at most, mm.
fn within_mm(problem: &Problem, model: &Model, share: f64) -> f64 {
    within(&in_order(lengths_mm(problem, model)), share)
}

/// The nominal robot, where the best rigid motion puts it.
pub(super) fn nominal_mm(part: &Session, values: JointValues, free_frame: bool, share: f64) -> f64 {
    let problem = Problem::new(part, values);
    let frame = MEASURING_FRAME.about().id;
    let frames = free_frame || part.samples.setups.is_some();
    let mut model = base_model::start(part, &problem, |id| frames && id == frame);
    model = model.without(|t| t.effect.about().id != frame);
    within_mm(&problem, &model, share)
}

/// The whole base model with its priors; infinite for points of another size than the robot's: links that shrink
/// leave little of those whatever the robot is.
fn with_priors_mm(part: &Session, values: JointValues, free_frame: bool, share: f64) -> f64 {
    if !has_the_robots_size(part, values) {
        return f64::INFINITY;
    }
    let mut problem = Problem::new(part, values);
    let frame = MEASURING_FRAME.about().id;
    let frames = free_frame || part.samples.setups.is_some();
    let start = base_model::start(part, &problem, |id| frames || id != frame);
    let fitted = base_model::fit(&mut problem, &start, true).solution.model;
    if is_plausible(part, &fitted) {
        within_mm(&problem, &fitted, share)
    } else {
        f64::INFINITY
    }
}

/// Whether the zero offsets and the tool of a model are those of a robot that was set up.
pub(super) fn is_plausible(session: &Session, model: &Model) -> bool {
    let zero = joint_zero().about().id;
    let tool = TOOL_POSITION.about().id;
    let most = farthest_tool_mm(&session.robot);
    model.terms().iter().all(|term| {
        let id = term.effect.about().id;
        if id == zero && session.robot.joints[term.joint].kind == JointKind::Revolute {
            let turn = term.coefficients[0];
            turn.sin().atan2(turn.cos()).abs() <= rad_from_deg(LARGEST_OFFSET_DEG)
        } else if id == tool {
            Vector3::from_column_slice(&term.coefficients[..3]).norm() <= most
        } else {
            true
        }
    })
}

/// Whether a change that scales the samples brings them to the size of the robot, which they do not have
/// as they are.
pub(super) fn is_to_scale(part: &Session, changed: &Session, values: JointValues) -> bool {
    let lengths = part.samples.spread_mm() / changed.samples.spread_mm().max(1e-12);
    let is_scaled = (lengths.ln()).abs() > 0.01;
    !is_scaled || has_the_robots_size(changed, values) && !has_the_robots_size(part, values)
}

/// Whether the points are spread as widely as the nominal robot spreads them.
fn has_the_robots_size(session: &Session, values: JointValues) -> bool {
    let problem = Problem::new(session, values);
    let nominal = Model::nominal(session.robot.clone()).predict(&problem.inputs);
    let mut seen = session.samples.clone();
    seen.x_mm = nominal.x_mm;
    seen.y_mm = nominal.y_mm;
    seen.z_mm = session.samples.z_mm.is_some().then_some(nominal.z_mm);
    let ratio = session.samples.spread_mm() / seen.spread_mm().max(1e-12);
    (1.0 / TO_SCALE..=TO_SCALE).contains(&ratio)
}

/// Whether a change predicts samples that its trial has not seen, so large a share of them to within what it may leave.
pub(super) fn predicts(
    part: &Session,
    values: JointValues,
    mends: &[SessionCorrection],
    [share, most_mm]: [f64; 2],
) -> bool {
    let mut changed = part.clone();
    for mend in mends {
        mend.apply(&mut changed);
    }
    let n = changed.samples.len();
    if n < FEWEST_TO_SPLIT {
        return true;
    }
    let rows = |odd: bool| (0..n).filter(move |row| (row % 2 == 1) == odd);
    let with = |odd: bool| {
        let mut some = changed.clone();
        let kept: Vec<Option<usize>> = rows(odd).map(Some).collect();
        some.samples.select(&kept);
        some
    };
    let (seen, unseen) = (with(false), with(true));
    let Some(end) = trial(&seen, values, true) else {
        return false;
    };
    // What may be left is told in the units of the samples as they stand.
    let scale = changed.samples.spread_mm() / part.samples.spread_mm().max(1e-12);
    let left_mm = within_mm(&Problem::new(&unseen, values), &end.model, share);
    left_mm <= UNSEEN * most_mm * scale.max(1.0)
}
