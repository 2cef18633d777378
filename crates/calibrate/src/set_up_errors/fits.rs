//! Fits of some samples of a session, by which every hypothesis is judged.

use crate::effects::{
    JointValues, MEASURING_FRAME, Role, Setting, TOOL_POSITION, Term, joint_zero,
};
use crate::fit::base_model;
use crate::fit::gap::lengths_mm;
use crate::fit::problem::Problem;
use crate::fit::solver::solve;
use crate::fit::spread::places;
use crate::kinematics::JointKind;
use crate::model::Model;
use crate::numeric::whole;
use crate::sessions::Session;
use crate::units::rad_from_deg;

use super::rows::RowsInOrder;
use super::thresholds::{LARGEST_OFFSET_DEG, LARGEST_STRETCH, MOST_SAMPLES};

/// At most so many of the samples that count, spread evenly.
pub(super) fn thinned(session: &Session, most: usize) -> Session {
    RowsInOrder::of(session, most).select(session)
}

/// Some samples of a session, whatever was measured in them.
pub(super) fn some_samples(session: &Session) -> Session {
    let some = places(session.samples.len(), MOST_SAMPLES).map(Some);
    session.of_rows(&some.collect::<Vec<_>>())
}

/// The base model fitted to a session, and its RMS residual, mm, without the twentieth of the samples that is farthest
/// off.
pub(super) fn fitted(session: &Session, values: JointValues) -> Option<(Model, f64)> {
    fitted_from(session, values, |start| start)
}

/// The same from another start.
pub(super) fn fitted_from(
    session: &Session,
    values: JointValues,
    change: impl Fn(Model) -> Model,
) -> Option<(Model, f64)> {
    let mut problem = Problem::observing(session, values);
    if problem.samples() == 0 {
        return None;
    }
    let start = change(base_model::start(session, &problem, |_| true));
    let model = base_model::fit(&mut problem, &start, true).solution.model;
    let mut lengths = in_order(lengths_mm(&problem, &model));
    lengths.truncate(lengths.len() - lengths.len() / 20);
    let square = lengths.iter().map(|v| v * v).sum::<f64>() / lengths.len().max(1) as f64;
    Some((model, square.sqrt()))
}

/// RMS residual of the base model over some samples, mm.
pub(super) fn residual_mm(session: &Session, values: JointValues) -> Option<f64> {
    Some(fitted(&some_samples(session), values)?.1)
}

/// What a trial ends with.
pub(super) struct Trial {
    /// Lengths of the deviations, the smallest first, mm; at least one.
    lengths_mm: Vec<f64>,
    pub(super) model: Model,
}

impl Trial {
    /// The length that so large a share of the deviations is within, mm.
    pub(super) fn within_mm(&self, share: f64) -> f64 {
        within(&self.lengths_mm, share)
    }
}

/// Lengths that are known, the smallest first.
fn in_order(mut lengths_mm: Vec<f64>) -> Vec<f64> {
    lengths_mm.retain(|v| v.is_finite());
    lengths_mm.sort_by(f64::total_cmp);
    lengths_mm
}

/// The length that so large a share does not exceed; infinite where there is none.
fn within(in_order_mm: &[f64], share: f64) -> f64 {
    let at = whole(share * in_order_mm.len() as f64);
    let last = in_order_mm.len().saturating_sub(1);
    in_order_mm
        .get(at.min(last))
        .copied()
        .unwrap_or(f64::INFINITY)
}

/// The same of lengths in any order.
pub(super) fn share_within(lengths_mm: Vec<f64>, share: f64) -> f64 {
    within(&in_order(lengths_mm), share)
}

/// Fits what is adjusted when a robot is mounted: the frame, one shift of the tool and the zero offsets, of a single
/// joint the zero offset and the link; `None` where the values found are impossible for a robot.
pub(super) fn trial(session: &Session, values: JointValues, free_frame: bool) -> Option<Trial> {
    let problem = Problem::new(session, values);
    let is_arm = base_model::is_arm(session);
    let parts = [
        (
            MEASURING_FRAME.about().id,
            free_frame || session.samples.setups.is_some(),
        ),
        (TOOL_POSITION.about().id, is_arm),
    ];
    let mut terms = base_model::terms(session, &problem, |id| parts.contains(&(id, true)));
    // Targets sit on the tool as the drawing has them.
    terms.retain(|t| t.effect.about().setting != Setting::Target || t.setting == 0.0);
    if is_arm {
        // The first zero offset is the frame's.
        let others = 1..session.robot.joints.len();
        terms.extend(others.map(|joint| Term::absent(joint_zero(), joint, 0.0)));
    } else {
        terms.extend(base_model::of_a_single_joint(session, &problem, |_| true));
    }
    let model = solve(&problem, &Model::new(session.robot.clone(), terms)).model;
    let reach_mm = session.robot.length_along_links_mm();
    let is_possible = |term: &Term| match term.effect.about().role {
        Role::JointZero => is_small_turn(session, term),
        Role::ToolRadius => term.coefficients[0].abs() <= LARGEST_STRETCH * reach_mm,
        _ => true,
    };
    let lengths_mm = in_order(lengths_mm(&problem, &model));
    let possible = !lengths_mm.is_empty() && model.terms().iter().all(is_possible);
    possible.then_some(Trial { lengths_mm, model })
}

/// Whether the zero offset of a joint that turns is one with which robots are set up.
pub(super) fn is_small_turn(session: &Session, zero: &Term) -> bool {
    let turn = zero.coefficients[0];
    session.robot.joints[zero.joint].kind != JointKind::Revolute
        || turn.sin().atan2(turn.cos()).abs() <= rad_from_deg(LARGEST_OFFSET_DEG)
}
