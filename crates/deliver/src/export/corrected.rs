//! The robot that was built, as far as it is a chain of joints again.
//!
//! Some effects only put joints and tool elsewhere: a zero offset, a longer link, a base that was
//! surveyed wrongly. With them the robot is still a chain, only another one; with backlash or
//! eccentricity it is none. Which is which is not listed anywhere, it is tried: the frame of every
//! link is followed to where the effects put it at home,
//!
//! ```text
//! moved(j) = rigid motion of what joint j carries, at home, by the effects of the joints up to j
//! axis(j) → moved(j) · axis(j),    M → moved(tool) · M
//! ```
//!
//! and the chain that results has to lead where the model leads at many poses, from both sides, under
//! loads, warm and cold. So an effect that is added to the catalogue is treated rightly without a
//! word here.

use nalgebra::{Matrix3, Point3, Rotation3, Translation3, UnitQuaternion, Vector3};

use super::Job;
use super::poses::poses;
use crate::compensation::Side;
use crate::compensation::plan::of_the_robot;
use crate::effects::{Inputs, Stage, Term};
use crate::kinematics::{Pose, Robot};
use crate::lanes::{dot, minus};
use crate::model::Model;

/// A chain leads to the same place up to this, mm.
const SAME_MM: f64 = 1e-9;
/// Distance of the points that show a motion, mm.
const APART_MM: f64 = 1000.0;

#[derive(Debug, Clone)]
pub(super) struct Corrected {
    /// The chain.
    pub(super) robot: Robot,
    /// How each joint's link moved at home, and at last the tool.
    pub(super) moved: Vec<Pose>,
    pub(super) carried: Vec<Term>,
    /// What is not.
    pub(super) left_out: Vec<Term>,
}

impl Corrected {
    /// As many effects of the model as a chain can carry.
    pub(super) fn new(job: &Job) -> Self {
        let nominal = &job.calibration.model.robot;
        // No chain holds what predicts without a name; the geometry is then the one without it.
        let alone = job.calibration.model.with_geometry_alone();
        let terms = of_the_robot(&alone, job.calibration.measured_places())
            .terms()
            .to_vec();
        let (mut carried, mut left_out) = (Vec::new(), Vec::new());
        for term in terms {
            let alone = Model::new(nominal.clone(), vec![term.clone()]);
            if Self::chain(&alone).is_some_and(|(robot, _)| leads_the_same(job, &alone, &robot)) {
                carried.push(term);
            } else {
                left_out.push(term);
            }
        }
        let model = Model::new(nominal.clone(), carried.clone());
        match Self::chain(&model).filter(|(robot, _)| leads_the_same(job, &model, robot)) {
            Some((robot, moved)) => Self {
                robot,
                moved,
                carried,
                left_out,
            },
            // Each is a chain and all together are not: no effect does that today.
            None => Self {
                robot: nominal.clone(),
                moved: vec![Pose::identity(); nominal.joints.len() + 1],
                carried: Vec::new(),
                left_out: [carried, left_out].concat(),
            },
        }
    }

    /// The motion of the tool by a model's effects, at home; `None` where it is not rigid.
    pub(super) fn motion(model: &Model) -> Option<Pose> {
        motion_at_home(model)
    }

    /// The chain that a model's links form at home.
    fn chain(model: &Model) -> Option<(Robot, Vec<Pose>)> {
        let mut robot = model.robot.clone();
        let mut moved = Vec::new();
        for joint in 0..robot.joints.len() {
            let behind = |t: &Term| {
                let about = t.effect.about();
                about.stage == Stage::Tool || about.per_joint && t.joint > joint
            };
            let by = motion_at_home(&model.without(behind))?;
            robot.joints[joint].axis = robot.joints[joint].axis.moved_by(&by);
            if let Some(link) = &mut robot.joints[joint].link {
                link.centre_mm = by * link.centre_mm;
            }
            moved.push(by);
        }
        let by = motion_at_home(model)?;
        robot.base_from_tool = by * robot.base_from_tool;
        moved.push(by);
        Some((robot, moved))
    }
}

/// The motion of the tool by a model's effects, at home; `None` where it is not rigid.
fn motion_at_home(model: &Model) -> Option<Pose> {
    let home = vec![vec![0.0]; model.robot.joints.len()];
    let origin = model.robot.base_from_tool.translation.vector;
    let seen = |point: Vector3<f64>| -> Vector3<f64> {
        let inputs = Inputs::at_poses(home.clone(), vec![point.into()]);
        model.predict(&inputs).get(0).into()
    };
    let there = seen(origin);
    let edges = [Vector3::x(), Vector3::y(), Vector3::z()];
    let edges = edges.map(|e| (seen(origin + e * APART_MM) - there) / APART_MM);
    let turn = Matrix3::from_columns(&edges);
    let rigid =
        (turn.transpose() * turn - Matrix3::identity()).amax() < 1e-9 && turn.determinant() > 0.0;
    // Near the identity, where a rotation's own digits are the best there are.
    let rotation = Rotation3::from_matrix_eps(&turn, 1e-15, 100, Rotation3::identity());
    let rotation = UnitQuaternion::from_rotation_matrix(&rotation);
    rigid.then(|| {
        let shift = there - rotation * origin;
        Pose::from_parts(Translation3::from(shift), rotation)
    })
}

/// Whether a chain leads where the model leads, under every condition.
fn leads_the_same(job: &Job, model: &Model, robot: &Robot) -> bool {
    farthest(&various(job, model), model, robot) <= SAME_MM
}

/// The largest distance between a model and a chain over these poses, mm.
pub(super) fn farthest(poses: &[Inputs], model: &Model, robot: &Robot) -> f64 {
    let apart = |inputs: &Inputs| {
        let away = differences(inputs, model, robot);
        away.iter().map(|v| dot(*v, *v).sqrt()).fold(0.0, f64::max)
    };
    poses.iter().map(apart).fold(0.0, f64::max)
}

/// Model − chain, pose by pose and reflector by reflector, mm.
pub(super) fn differences(inputs: &Inputs, model: &Model, robot: &Robot) -> Vec<[f64; 3]> {
    let mut all = Vec::new();
    for home in &inputs.reflectors_at_home {
        let mut one = inputs.clone();
        one.target = None;
        one.reflectors_at_home = vec![*home];
        let there = model.predict(&one);
        let in_tool = model
            .robot
            .base_from_tool
            .inverse_transform_point(&Point3::from(*home));
        let at_home = robot.base_from_tool * in_tool;
        one.reflectors_at_home = vec![at_home.coords.into()];
        let chain = Model::nominal(robot.clone()).predict(&one);
        all.extend((0..one.len()).map(|i| minus(there.get(i), chain.get(i))));
    }
    all
}

/// The measured range from both sides, at speed, under load, warm, and with points beside the tool's
/// origin so that a turn of the tool shows.
fn various(job: &Job, model: &Model) -> Vec<Inputs<'static>> {
    let tool = &model.robot.base_from_tool;
    let beside = [Vector3::zeros(), Vector3::x(), Vector3::y()];
    let beside: Vec<[f64; 3]> = beside
        .iter()
        .map(|e| (tool * Point3::from(e * APART_MM)).coords.into())
        .collect();
    let mut all = Vec::new();
    for (side, factor) in [
        (Side::Forward, 0.0),
        (Side::Forward, 1.0),
        (Side::Reverse, 1.0),
    ] {
        let mut conditions = job.conditions;
        conditions.speed += factor * 0.5;
        conditions.load_kg += factor * 7.0;
        conditions.temperature_c += factor * 10.0;
        let job = Job { conditions, ..*job };
        let mut inputs = poses(&job, side);
        inputs.reflectors_at_home.clone_from(&beside);
        all.push(inputs);
    }
    all
}
