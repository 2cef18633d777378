//! What to measure: for a session the poses that decide what it leaves open, that make testable
//! what it cannot show, and that sharpen the rest; for a robot alone a first measurement.
//!
//! 1. Rivals of the diagnosis first (`next_poses`), or the two effects that
//!    the user names (`pair_separation`).
//! 2. Then what is not testable (`enabling_poses`): which condition is missing, and poses under
//!    that condition.
//! 3. Then, where more poses are asked for, greedy D-optimality over every effect of the catalogue
//!    (`first_measurement`), which lowers the detection limits.
//!
//! What the plan claims is checked on the session as it would be with the poses measured
//! (`expected_information`): an effect counts as enabled only if nothing stands against
//! it there.

use crate::effects::{Form, find};
use crate::kinematics::Robot;
use crate::sessions::{Session, Target};

use super::comparison::{Axes, predictions};
use super::enabling_poses;
use super::expected_information::{self, ExpectedInformation};
use super::first_measurement::{self, Arrival, PlannedPose, Request};
use super::needs::{self, TEST_LOAD_KG, Untestable};
use super::next_poses;
use super::pair_separation::{self, Named, Separation};
use crate::diagnosis::NextPose;
use crate::diagnosis::candidates::NotTestable;
use crate::diagnosis::prepare::Prepared;
use crate::diagnosis::search::mean_sigma_mm;
use crate::diagnosis::testable::not_testable;
use crate::diagnosis::{DiagnoseError, Options, Watch, checked, searched};

/// Noise of the instrument where nobody says it, mm: a laser tracker.
pub const USUAL_SIGMA_MM: f64 = 0.03;
/// Poses of a first measurement for each joint, where nobody says how many.
const POSES_PER_JOINT: usize = 60;
/// Poses that make effects testable, where no number is given.
const MOST_ENABLING: usize = 24;
/// Poses that a plan holds at most.
pub const MOST_POSES: usize = 2000;

/// What the plan is to do.
#[derive(Debug, Clone, Default)]
pub struct PlanOptions {
    /// Number of poses; by default as many as are needed.
    pub poses: Option<usize>,
    /// Two effects to tell apart, as `ID` or `ID:JOINT`.
    pub separate: Option<[String; 2]>,
    /// Noise of the instrument, mm; for a session its own where it is not given.
    pub sigma_mm: Option<f64>,
    /// Heaviest load that the robot may carry for a test, kg.
    pub load_kg: Option<f64>,
    /// How a session is diagnosed.
    pub diagnosis: Options,
}

/// What the plan is made for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Subject {
    /// A session that was measured.
    Session,
    /// A robot that was not.
    Robot,
}

/// A plan.
#[derive(Debug, Clone, PartialEq)]
pub struct Plan {
    /// What it is made for.
    pub subject: Subject,
    /// Its name.
    pub name: String,
    /// The robot.
    pub robot: Robot,
    /// Reflectors that the poses use; a new one is listed after the session's.
    pub targets: Vec<Target>,
    /// The poses in measuring order.
    pub poses: Vec<NextPose>,
    /// Explanations that the samples cannot tell apart: the names that stand, and those that could.
    pub open: Vec<[Vec<String>; 2]>,
    /// The two effects that were asked for.
    pub separation: Option<Separation>,
    /// What the poses make testable.
    pub enables: Vec<Untestable>,
    /// What stays untestable; `needs` says what would help beside poses, if anything does.
    pub cannot: Vec<Untestable>,
    /// Noise that the detection limits are for, mm.
    pub sigma_mm: f64,
    /// What can be told once the poses are measured.
    pub expected: ExpectedInformation,
}

/// Why there is no plan.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PlanError {
    /// A number of poses that makes no sense.
    #[error("--poses is {0}; expected a whole number from 1 to {MOST_POSES}")]
    Poses(usize),
    /// A noise that makes no sense.
    #[error("--sigma is {0}; expected a length above 0 in mm, such as 0.03")]
    Sigma(f64),
    /// A load that makes no sense.
    #[error("--load is {0}; expected a mass above 0 in kg, such as 3")]
    Load(f64),
    /// A joint that is not there, or not a number.
    #[error(
        "--separate {given}: expected an effect, or an effect and a joint from 1 to {joints} such as backlash:1"
    )]
    Joint {
        /// What was given.
        given: String,
        /// Number of joints.
        joints: usize,
    },
    /// Twice the same effect.
    #[error("--separate {0},{0}: expected two different effects")]
    Same(String),
    /// The diagnosis failed.
    #[error(transparent)]
    Diagnose(#[from] DiagnoseError),
}

impl PlanOptions {
    fn check(&self) -> Result<(), PlanError> {
        let above_zero = |v: &f64| v.is_finite() && *v > 0.0;
        if let Some(n) = self.poses.filter(|n| *n == 0 || *n > MOST_POSES) {
            return Err(PlanError::Poses(n));
        }
        if let Some(sigma) = self.sigma_mm.filter(|s| !above_zero(s)) {
            return Err(PlanError::Sigma(sigma));
        }
        match self.load_kg.filter(|l| !above_zero(l)) {
            Some(load) => Err(PlanError::Load(load)),
            None => Ok(self.diagnosis.check()?),
        }
    }

    /// The two effects, found in the catalogue.
    fn between(&self, robot: &Robot) -> Result<Option<[Named; 2]>, PlanError> {
        let joints = robot.joints.len();
        let Some(two) = &self.separate else {
            return Ok(None);
        };
        let named = |given: &String| -> Result<Named, PlanError> {
            let (id, joint) = given.split_once(':').unwrap_or((given, "1"));
            let in_catalogue = crate::effects::CATALOGUE.iter();
            let effect = in_catalogue
                .map(|e| e.about().id)
                .find(|known| *known == id)
                .ok_or_else(|| DiagnoseError::UnknownEffect(id.to_owned()))?;
            let number = joint.parse::<usize>().ok();
            let joint = number.filter(|j| (1..=joints).contains(j));
            let wrong = || PlanError::Joint {
                given: given.clone(),
                joints,
            };
            Ok(Named {
                id: effect,
                joint: joint.ok_or_else(wrong)? - 1,
            })
        };
        let [one, other] = [named(&two[0])?, named(&two[1])?];
        if one == other {
            return Err(PlanError::Same(two[0].clone()));
        }
        Ok(Some([one, other]))
    }
}

/// A plan for a session: it is diagnosed, and what that leaves open is planned for.
///
/// # Errors
/// If an option makes no sense, if there is no sample to fit, or if the watcher stops it.
pub fn plan_session(
    session: &Session,
    options: &PlanOptions,
    watch: Watch,
) -> Result<Plan, PlanError> {
    options.check()?;
    let between = options.between(&session.robot)?;
    let mended = checked(session, &options.diagnosis, watch).map_err(DiagnoseError::from)?;
    let session: &Session = &mended.session;
    let (prepared, found) = searched(session, &options.diagnosis, watch)?;
    let (regression, fit) = (&prepared.regression, &found.fit);
    let sigma_mm = options
        .sigma_mm
        .unwrap_or_else(|| mean_sigma_mm(regression) * regression.scale(fit).max(1e-6));
    let most = |usual: usize| options.poses.unwrap_or(usual);
    let base = regression.fit(&regression.base, Vec::new());
    let untestable_now = enabling_poses::untestable(&prepared, &not_testable(regression, &base));
    let name = session.name.clone();
    let (robot, targets) = (&session.robot, &session.targets);
    let mut plan = Plan::empty(Subject::Session, name, robot, targets, sigma_mm);
    if let Some(between) = between {
        let separation = two(&prepared, &found.fit, between, most(next_poses::MOST));
        plan.poses.clone_from(&separation.poses);
        plan.separation = Some(separation);
    } else {
        let rivals = crate::diagnosis::aliases::open_rivals(regression, fit);
        let rivals: Vec<_> = rivals.iter().collect();
        let ids = |terms: &[crate::effects::Term]| {
            terms.iter().map(|t| t.name_on(&session.robot)).collect()
        };
        plan.open = rivals
            .iter()
            .map(|r| [ids(&r.removed), ids(&r.instead)])
            .collect();
        plan.open.dedup();
        plan.poses = next_poses::separate(&prepared, fit, &rivals, most(next_poses::MOST));
        let room = options
            .poses
            .map_or(MOST_ENABLING, |n| n - plan.poses.len());
        let own_reflector = plan
            .poses
            .iter()
            .find_map(|p| p.target_mm.map(|_| p.clone()));
        let mut more = enabling_poses::enable(&prepared, fit, &untestable_now, true, room);
        same_reflector(&mut more, own_reflector.as_ref());
        plan.poses.extend(more);
    }
    plan.targets.extend(new_targets(&plan.poses, &plan.targets));
    if let Some(room) = options
        .poses
        .filter(|_| plan.separation.is_none())
        .map(|n| n - plan.poses.len())
        .filter(|n| *n > 0)
    {
        let sharper = sharpen(&prepared, &plan, options, room);
        plan.poses.extend(sharper);
    }
    let with_poses =
        expected_information::extended(session, &fit.model, &plan.poses, &plan.targets);
    plan.expected = expected_information::expected(&with_poses, sigma_mm, &options.diagnosis)?;
    let still = |l: &Untestable| {
        let same = |n: &NotTestable| n.effect == l.effect && n.joint == l.joint;
        plan.expected.not_testable.iter().any(same)
    };
    let (cannot, enables): (Vec<Untestable>, Vec<Untestable>) =
        untestable_now.into_iter().partition(still);
    (plan.cannot, plan.enables) = (cannot, enables);
    Ok(plan)
}

/// A first measurement of a robot that nobody has measured.
///
/// # Errors
/// If an option makes no sense.
pub fn plan_robot(robot: &Robot, options: &PlanOptions) -> Result<Plan, PlanError> {
    options.check()?;
    let between = options.between(robot)?;
    let sigma_mm = options.sigma_mm.unwrap_or(USUAL_SIGMA_MM);
    let usual = (POSES_PER_JOINT * (1 + robot.joints.len()) / 2).min(240);
    let poses = options.poses.unwrap_or(usual);
    let targets = first_measurement::reflectors(robot);
    let request = Request {
        poses,
        load_kg: options.load_kg.unwrap_or(TEST_LOAD_KG),
        seed: options.diagnosis.seed,
    };
    let mut planned = first_measurement::design(robot, &targets, &request);
    let name = robot.name.clone();
    let mut plan = Plan::empty(Subject::Robot, name, robot, &targets, sigma_mm);
    let imagined = |planned: &[PlannedPose]| {
        let choices: Vec<_> = planned.iter().map(|s| s.choice.clone()).collect();
        let noise = (sigma_mm, options.diagnosis.seed.wrapping_add(1));
        expected_information::imagined(robot, &targets, &choices, Some(noise))
    };
    let mut decisive = Vec::new();
    if let Some(between) = between {
        // Half of the poses measure the robot, of the other half as many as it takes decide.
        planned.truncate(poses.div_ceil(2));
        let session = imagined(&planned);
        let prepared = Prepared::new(&session, &options.diagnosis)?;
        let fit = prepared
            .regression
            .fit(&prepared.regression.base, Vec::new());
        let separation = two(&prepared, &fit, between, poses - planned.len());
        decisive.clone_from(&separation.poses);
        let rest = Request {
            poses: poses - decisive.len(),
            ..request
        };
        planned = first_measurement::design(robot, &targets, &rest);
        if separation.impossible.is_some() {
            planned.clear();
        }
        plan.separation = Some(separation);
    }
    plan.poses = poses_of_planned(&planned, &targets, robot);
    plan.poses.extend(decisive.iter().cloned());
    plan.targets.extend(new_targets(&plan.poses, &targets));
    if planned.is_empty() {
        return Ok(plan);
    }
    let model = crate::model::Model::nominal(robot.clone());
    let session =
        expected_information::extended(&imagined(&planned), &model, &decisive, &plan.targets);
    plan.expected = expected_information::expected(&session, sigma_mm, &options.diagnosis)?;
    let prepared = Prepared::new(&session, &options.diagnosis)?;
    plan.cannot = enabling_poses::untestable(&prepared, &plan.expected.not_testable);
    Ok(plan)
}

/// Two effects, unless one of them cannot be seen by any measurement.
fn two(
    prepared: &Prepared,
    fit: &crate::diagnosis::regression::Fit,
    between: [Named; 2],
    most: usize,
) -> Separation {
    let met = needs::all_met(&prepared.survey);
    for named in between {
        let obstacle = find(named.id).and_then(|effect| effect.obstacle(&met, named.joint));
        if let Some(because) = obstacle {
            let because = format!("{} cannot be seen: {because}", named.id);
            return pair_separation::nothing(between, &because);
        }
    }
    pair_separation::separate_two(prepared, fit, between, most)
}

/// New reflectors of two lists of poses become one: a technician mounts one bar.
fn same_reflector(poses: &mut [NextPose], like: Option<&NextPose>) {
    let Some(like) = like else { return };
    for pose in poses.iter_mut().filter(|p| p.target_mm.is_some()) {
        pose.target.clone_from(&like.target);
        pose.target_mm = like.target_mm;
    }
}

/// Reflectors that poses use and that are not there yet.
fn new_targets(poses: &[NextPose], there: &[Target]) -> Vec<Target> {
    let mut new: Vec<Target> = Vec::new();
    for pose in poses {
        if let (Some(name), Some(mm)) = (&pose.target, pose.target_mm) {
            let known = |t: &Target| t.name == *name;
            if !there.iter().any(known) && !new.iter().any(known) {
                new.push(Target {
                    name: name.clone(),
                    position_mm: mm.into(),
                });
            }
        }
    }
    new
}

/// More poses for a session, where they lower the detection limits most.
fn sharpen(prepared: &Prepared, plan: &Plan, options: &PlanOptions, count: usize) -> Vec<NextPose> {
    let session = prepared.problem.session;
    let heaviest = prepared.survey.largest_load_kg;
    let load = if heaviest > 0.0 {
        heaviest
    } else {
        TEST_LOAD_KG
    };
    let request = Request {
        poses: count,
        load_kg: options.load_kg.unwrap_or(load),
        seed: options.diagnosis.seed,
    };
    let axes = Axes {
        axes: prepared.regression.rows.axes.clone(),
        sigma_mm: [1.0; 3],
    };
    let extended = expected_information::extended(
        session,
        &prepared.regression.base,
        &plan.poses,
        &plan.targets,
    );
    let inputs = crate::effects::Inputs::new(&extended, prepared.options().joint_values);
    let ranges = super::candidate_poses::ranges(&session.robot, Some(&prepared.problem.inputs));
    let known = |model: &crate::model::Model| predictions(model, model, &inputs, &axes);
    let planned =
        first_measurement::extension(&session.robot, &plan.targets, &ranges, &request, &known);
    let mut poses = poses_of_planned(&planned, &plan.targets, &session.robot);
    for pose in &mut poses {
        let is_new = |t: &&Target| Some(&t.name) == pose.target.as_ref();
        let own = session.targets.iter().any(|t| is_new(&t));
        let place = plan.targets.iter().find(is_new).filter(|_| !own);
        pose.target_mm = place.map(|t| t.position_mm.coords.into());
    }
    poses
}

/// The planned poses of a design, with the reason for each.
fn poses_of_planned(planned: &[PlannedPose], targets: &[Target], robot: &Robot) -> Vec<NextPose> {
    let loads = planned.iter().any(|s| s.choice.load_kg != 0.0);
    let one = |planned_pose: &PlannedPose| {
        let choice = &planned_pose.choice;
        let target = targets.get(choice.target as usize);
        NextPose {
            q: choice.q.clone(),
            dir: choice.dir.clone(),
            target: target.filter(|_| targets.len() > 1).map(|t| t.name.clone()),
            target_mm: target
                .filter(|_| choice.target > 0)
                .map(|t| t.position_mm.coords.into()),
            speed: Some(choice.speed.clone()),
            load_kg: loads.then_some(choice.load_kg),
            temperature_c: Some(choice.warmth_c + crate::effects::inputs::REFERENCE_TEMPERATURE_C),
            why: why(planned_pose, robot),
        }
    };
    planned.iter().map(one).collect()
}

fn why(planned_pose: &PlannedPose, robot: &Robot) -> String {
    match planned_pose.arrival {
        Arrival::Return(to) => format!("return to pose {} of this list: repeatability", to + 1),
        Arrival::Short(_) => {
            "a short approach after a reversal: lost motion against backlash".to_owned()
        }
        Arrival::Long if planned_pose.choice.speed.iter().any(|s| *s != 0.0) => {
            "measure while moving: tracking lag against backlash".to_owned()
        }
        Arrival::Long if robot.joints.len() > 1 => "joint values that tell most".to_owned(),
        Arrival::Long => "a place that tells most, unequal steps".to_owned(),
    }
}

/// A detection limit as the user reads it.
#[derive(Debug, Clone, PartialEq)]
pub struct SeenAbove {
    /// The effect's name.
    pub effect: &'static str,
    /// Joint, counted from 1; `None` where it belongs to none.
    pub joint: Option<usize>,
    /// For each parameter its name with its unit and the size above which it will be seen.
    pub sizes: Vec<(&'static str, f64)>,
}

impl Plan {
    fn empty(
        subject: Subject,
        name: String,
        robot: &Robot,
        targets: &[Target],
        sigma_mm: f64,
    ) -> Self {
        Self {
            subject,
            name,
            robot: robot.clone(),
            targets: targets.to_vec(),
            poses: Vec::new(),
            open: Vec::new(),
            separation: None,
            enables: Vec::new(),
            cannot: Vec::new(),
            sigma_mm,
            expected: ExpectedInformation::default(),
        }
    }

    /// Detection limits once the poses are measured; what is called degrees is millimetres where
    /// a joint slides.
    pub fn seen_above(&self) -> Vec<SeenAbove> {
        let one = |limit: &crate::diagnosis::limits::Limit| {
            let kind = self.robot.joints[limit.joint.unwrap_or(0)].kind;
            let quantities = find(limit.effect).map(|e| e.about().form);
            let size = |(name, size): &(&'static str, f64)| {
                let quantity = match quantities {
                    Some(Form::Plain(all)) => all.iter().find(|q| q.name == *name).copied(),
                    Some(Form::Harmonic(quantity) | Form::Fading(quantity)) => Some(quantity),
                    None => None,
                };
                quantity.map_or((*name, *size), |quantity| {
                    let on = quantity.on(kind);
                    (on.name, size * quantity.unit.inner / on.unit.inner)
                })
            };
            SeenAbove {
                effect: limit.effect,
                joint: limit.joint.map(|j| j + 1),
                sizes: limit.sizes.iter().map(size).collect(),
            }
        };
        self.expected.limits.iter().map(one).collect()
    }
}
