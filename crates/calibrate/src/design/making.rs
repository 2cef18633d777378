//! The steps by which a plan is made.
//!
//! 1. Rivals of the diagnosis first (`next_poses`), or the two effects that the user names
//!    (`pair_separation`).
//! 2. Of a single joint then what is not testable (`enabling_poses`): which condition is missing, and
//!    poses under that condition; and where more poses are asked for those that lower the detection
//!    limits of every effect of the catalogue (`first_measurement`).
//! 3. Of several joints poses that determine the geometry best (`geometry`), whatever is measured, under
//!    conditions that determine the effects (`conditions`).
//!
//! The claims of the plan are checked on the session as it would be with the poses measured (`expected_information`):
//! an effect counts as enabled only if it is testable there.

use super::plan_options::{POSES_IN_ADDITION, POSES_OF_AN_ARM, PROPOSED};
use crate::answers::pose::to_raw;
use crate::diagnosis::candidates::table::NotTestable;
use crate::diagnosis::evidence::Fit;
use crate::diagnosis::search::aliases::open_rivals;
use crate::diagnosis::search::mean_sigma_mm;
use crate::diagnosis::search::prepare::PreparedSearch;
use crate::diagnosis::verdict::not_testable;
use crate::diagnosis::{DiagnoseError, NextPose, Watch, checked, prepared, searched};
use crate::effects::Term;
use crate::kinematics::Robot;
use crate::model::{Model, SetUp};
use crate::observations::KINDS;
use crate::sessions::{Session, Target};
use crate::{fewest, rounding};

use super::arm::Arm;
use super::expected_information::expected;
use super::geometry;
use super::imagined::{extended, unmeasured, with_noise};
use super::needs::Untestable;
use super::pair_separation::separate_two;
use super::plan::{Geometry, Plan, Subject, USUAL_SIGMA_MM};
use super::plan_options::PlanOptions;
use super::reflectors::reflectors;
use super::{enabling_poses, first_measurement, next_poses};

/// Poses of a first measurement of a single joint, where no number is given; of several joints, and in addition to a
/// session of them.
const POSES_PER_JOINT: usize = 10;

/// A plan for a session: it is diagnosed, and poses for its open questions are planned. Where it has other
/// measurements than points it is planned for its geometry.
///
/// # Errors
/// If an option makes no sense, if there is no sample to fit, or if the watcher stops it.
pub fn plan_session(
    session: &Session,
    options: &PlanOptions,
    watch: Watch,
) -> Result<Plan, DiagnoseError> {
    options.check(&session.robot)?;
    let session = &*session.whole()?;
    let between = options.between(&session.robot)?;
    let arm = session.robot.joints.len() > 1;
    let corrected = checked(session, &options.diagnosis, watch)?;
    let session: &Session = &corrected.session;
    let (robot, targets) = (&session.robot, &session.targets);
    let mut plan = Plan::empty(Subject::Session, &session.name, robot, targets);
    if arm && between.is_none() && !session.has_plain_points() {
        let stated = || KINDS[0].sigma(&session.instrument);
        let sigma_mm = options.sigma_mm.or_else(stated);
        plan.sigma_mm = sigma_mm.unwrap_or(KINDS[0].about().usual_sigma);
        add_geometry(&mut plan, session, options)?;
        poses_to_raw(&mut plan, session);
        return Ok(plan);
    }
    let first = prepared(session, &options.diagnosis, watch)?;
    let (prepared, found) = searched(first, &options.diagnosis, watch)?;
    let (regression, fit) = (&prepared.regression, &found.fit);
    let sigma_mm = || mean_sigma_mm(regression) * regression.scale(fit).max(rounding::WRITTEN);
    plan.sigma_mm = options.sigma_mm.unwrap_or_else(sigma_mm);
    let most = options.poses.unwrap_or(PROPOSED);
    let base = regression.fit(&regression.base, &[]);
    let untestable_now = enabling_poses::untestable(&prepared, &not_testable(regression, &base));
    if let Some(between) = between {
        let separation = separate_two(&prepared, fit, between, most);
        plan.add(separation.poses.clone());
        plan.separation = Some(separation);
    } else {
        let rivals = open_rivals(regression, fit);
        let rivals: Vec<_> = rivals.iter().collect();
        let ids = |terms: &[Term]| terms.iter().map(|t| t.name_on(robot)).collect();
        let open = rivals.iter().map(|r| [ids(&r.removed), ids(&r.instead)]);
        plan.open = open.collect();
        plan.open.dedup();
        plan.add(next_poses::separate(&prepared, fit, &rivals, most));
        if arm {
            add_geometry(&mut plan, session, options)?;
        } else {
            add_what_is_untestable(&mut plan, &prepared, fit, &untestable_now, options);
        }
    }
    let with_poses = extended(session, &fit.model, &plan.poses, &plan.targets);
    let imagined = PreparedSearch::new(&with_poses, &options.diagnosis)?;
    plan.expected = expected(&imagined, plan.sigma_mm);
    let still = |l: &Untestable| {
        let same = |n: &NotTestable| n.effect == l.effect && n.joint == l.joint;
        plan.expected.not_testable.iter().any(same)
    };
    (plan.cannot, plan.enables) = untestable_now.into_iter().partition(still);
    poses_to_raw(&mut plan, session);
    Ok(plan)
}

/// Brings the poses of a plan into the controller's convention, where the session's set-up was corrected.
fn poses_to_raw(plan: &mut Plan, session: &Session) {
    let made = session.samples.corrected.iter();
    let set_up = SetUp::new(made.flat_map(|corrected| corrected.by.clone()));
    to_raw(&mut plan.poses, &set_up, &session.robot);
    if let Some(separation) = &mut plan.separation {
        to_raw(&mut separation.poses, &set_up, &session.robot);
    }
}

/// Poses of a single joint that make testable what is not, and where more are asked for, those that lower the
/// detection limits most.
fn add_what_is_untestable(
    plan: &mut Plan,
    prepared: &PreparedSearch,
    fit: &Fit,
    untestable_now: &[Untestable],
    options: &PlanOptions,
) {
    let room = |plan: &Plan| options.poses.map(|n| n - plan.poses.len());
    let most = room(plan).unwrap_or(PROPOSED);
    let load_kg = options.load_kg;
    let mut more = enabling_poses::enable(prepared, fit, untestable_now, load_kg, most);
    // A technician mounts one bar.
    if let Some(own) = plan.poses.iter().find(|p| p.target_mm.is_some()) {
        for pose in more.iter_mut().filter(|p| p.target_mm.is_some()) {
            pose.target.clone_from(&own.target);
            pose.target_mm = own.target_mm;
        }
    }
    plan.add(more);
    if let Some(room) = room(plan).filter(|n| *n > 0) {
        let sharper = first_measurement::design(plan, room, options, Some(prepared));
        plan.poses.extend(sharper);
    }
}

/// Poses in addition to a session that determine the geometry best.
fn add_geometry(
    plan: &mut Plan,
    session: &Session,
    options: &PlanOptions,
) -> Result<(), DiagnoseError> {
    let room = options.poses.map(|n| n - plan.poses.len());
    let arm = Arm::of_session(session, &plan.poses, options)?;
    let wanted = room.unwrap_or(POSES_IN_ADDITION);
    let (poses, geometry) = geometry::best(&arm, wanted, options.accuracy_mm)?;
    plan.poses.extend(poses);
    plan.geometry = Some(geometry);
    Ok(())
}

/// A first measurement of a robot that was not measured.
///
/// # Errors
/// If an option makes no sense.
pub fn plan_robot(robot: &Robot, options: &PlanOptions) -> Result<Plan, DiagnoseError> {
    options.check(robot)?;
    let between = options.between(robot)?;
    let sigma_mm = options.sigma_mm.unwrap_or(USUAL_SIGMA_MM);
    let usual = match robot.joints.len() {
        1 => fewest::TO_SCAN,
        several => POSES_OF_AN_ARM + POSES_PER_JOINT * several,
    };
    let poses = options.poses.unwrap_or(usual);
    let targets = reflectors(robot);
    let mut plan = Plan::empty(Subject::Robot, &robot.name, robot, &targets);
    plan.sigma_mm = sigma_mm;
    let nominal = Model::nominal(robot.clone());
    let measured = |poses: &[NextPose], targets: &[Target]| {
        let blank = unmeasured(robot, targets, Some(sigma_mm));
        let seed = options.diagnosis.seed.wrapping_add(1);
        with_noise(extended(&blank, &nominal, poses, targets), sigma_mm, seed)
    };
    let mut decisive = Vec::new();
    if let Some(between) = between {
        // Half of the poses measure the robot, of the other half as many as it takes decide.
        let (first, _) = first_poses(&plan, poses.div_ceil(2), options)?;
        let session = measured(&first, &targets);
        let prepared = PreparedSearch::new(&session, &options.diagnosis)?;
        let fit = prepared.regression.fit(&prepared.regression.base, &[]);
        let separation = separate_two(&prepared, &fit, between, poses - first.len());
        decisive.clone_from(&separation.poses);
        plan.separation = Some(separation);
    }
    let asked = plan.separation.as_ref();
    if asked.is_none_or(|separation| separation.impossible.is_none()) {
        let rest = poses - decisive.len();
        (plan.poses, plan.geometry) = first_poses(&plan, rest, options)?;
    }
    plan.add(decisive);
    if plan.poses.is_empty() {
        return Ok(plan);
    }
    let session = measured(&plan.poses, &plan.targets);
    let prepared = PreparedSearch::new(&session, &options.diagnosis)?;
    plan.expected = expected(&prepared, sigma_mm);
    plan.cannot = enabling_poses::untestable(&prepared, &plan.expected.not_testable);
    Ok(plan)
}

/// So many poses of a robot that was not measured; of several joints as many as an accuracy needs.
fn first_poses(
    plan: &Plan,
    count: usize,
    options: &PlanOptions,
) -> Result<(Vec<NextPose>, Option<Geometry>), DiagnoseError> {
    if plan.robot.joints.len() == 1 {
        return Ok((first_measurement::design(plan, count, options, None), None));
    }
    let arm = Arm::of_robot(plan, options);
    let (poses, geometry) = geometry::best(&arm, count, options.accuracy_mm)?;
    Ok((poses, Some(geometry)))
}
