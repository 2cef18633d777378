//! The inverse of a model for the tool's whole pose: which commands bring the real tool to given
//! poses.
//!
//! The position of the tool comes first, its orientation as far as the joints then still allow (task priority:
//! Nakamura 1991). With p and r the remaining errors of position and orientation, and x the step of the joints,
//!
//! ```text
//! x = Jp⁺ p + N z,   N Jp-free motions,   least |r − Jr x|² + Σ λᵢ² (vᵢ · (q + x − q₀))²  over z
//! λᵢ² = ε² − σᵢ²  where σᵢ < ε, else 0
//! ```
//!
//! σᵢ and vᵢ are the singular values and directions of the orientation's part Jr N. Where the joints turn the tool
//! well (σ ≥ ε, `DAMPED_BELOW`) both are met, and of several commands that do the nearest are taken. Near a singular
//! pose (a stretched wrist) a turn about the lost axis would take a large move: there the orientation is met in part,
//! the less the nearer, with a continuous transition to the exact solution (numerical filtering: Maciejewski and Klein
//! 1988). The damping holds the commands to q₀, the ones of the target, so that it does not depend on how many steps
//! are taken, and no joint moves further for the orientation than 1/ε times its error.
//!
//! A position is singular where the tool can hardly be moved in some direction (less than a two-hundredth of the
//! best): a tiny gain would cost a large move, and it is not corrected.
//!
//! The tool's orientation is that of three points around its origin, so that it is valid for every effect, whatever it
//! moves. The derivatives are those of the nominal robot at the tool's real place: effects change them by thousandths,
//! so that every step leaves a thousandth of the error, and they cost next to nothing compared with the exact ones of
//! a model with gravity in it.

use std::borrow::Cow;

use nalgebra::{DMatrix, Matrix3, Point3, Rotation3, UnitQuaternion, Vector3};

use crate::decompose;
use crate::effects::Inputs;
use crate::kinematics::screw::Twist;
use crate::kinematics::{JointKind, Pose, Robot};
use crate::lanes::{LANES, add_scaled, cross, dot, minus};
use crate::model::Model;
use crate::numeric::{GOLDEN_ANGLE, LONGEST_TURN};
use crate::observations::streams::ARM_MM;
use crate::{budget, rounding};

use super::inverse::FLATTEST;
use super::plan::{blocks, some_of};

/// The same for a position alone.
const FLATTEST_POSITION: f64 = 5e-3;
/// ε: directions in which the joints turn the tool less than this (rad per rad) are damped.
pub(crate) const DAMPED_BELOW: f64 = 0.04;

/// Where the commands of one pose ended.
#[derive(Debug, Clone, PartialEq)]
pub struct Reached {
    /// The commands, rad or mm.
    pub q: Vec<f64>,
    /// The remaining error of the position, mm.
    pub position_mm: f64,
    /// The remaining error of the orientation, rad.
    pub rotation_rad: f64,
    /// Whether the tool can hardly be moved in some direction there.
    pub singular: bool,
    /// Whether the search has settled.
    pub settled: bool,
    /// Whether a part of the orientation was given up, because it would take a large move.
    pub damped: bool,
}

/// Tools: the pose of each at home, in the base frame, and which of them each pose is of.
#[derive(Debug, Clone, PartialEq)]
pub struct Tools {
    /// At home, base frame; at least one.
    pub base_from_tool: Vec<Pose>,
    /// For each pose an index into them; empty: always the first.
    pub of_pose: Vec<u32>,
}

impl Tools {
    /// The tool of a robot.
    pub fn of(robot: &Robot) -> Self {
        Self {
            base_from_tool: vec![robot.base_from_tool],
            of_pose: Vec::new(),
        }
    }
}

/// Where a model has the tools at each pose of `inputs`; its targets play no part.
pub fn tool_poses(model: &Model, inputs: &Inputs, tools: &Tools) -> Vec<Pose> {
    let mut poses = Vec::with_capacity(inputs.len());
    for block in blocks(inputs, LANES) {
        let part = with_tools(inputs, tools, &block);
        let seen = seen(model, &part, tools);
        poses.extend(seen.iter().map(ToolAtPose::pose));
    }
    poses
}

/// The commands that bring the tool of `model` to `wanted`, starting from the commands of `inputs`.
/// Only the joints in `free` (counted from 0) move.
pub fn commands_for_poses(
    model: &Model,
    inputs: &Inputs,
    wanted: &[Pose],
    free: &[usize],
    tools: &Tools,
) -> Vec<Reached> {
    let free = &model.robot.leading(free)[..];
    let scale = Scale::of(&model.robot, free);
    let mut reached = Vec::with_capacity(inputs.len());
    for block in blocks(inputs, LANES) {
        let part = with_tools(inputs, tools, &block);
        let wanted = &wanted[block[0]..][..block.len()];
        reached.extend(commands_of_block(model, &scale, part, wanted, free, tools));
    }
    reached
}

/// Some poses of `inputs`, with the tool of each.
fn with_tools(inputs: &Inputs, tools: &Tools, poses: &[usize]) -> Inputs<'static> {
    let mut part = some_of(inputs, poses);
    let of_pose = (!tools.of_pose.is_empty()).then(|| {
        poses
            .iter()
            .map(|i| tools.of_pose.get(*i).copied().unwrap_or(0))
    });
    part.target = of_pose.map(Iterator::collect);
    part
}

fn commands_of_block(
    model: &Model,
    scale: &Scale,
    mut trial: Inputs<'static>,
    wanted: &[Pose],
    free: &[usize],
    tools: &Tools,
) -> Vec<Reached> {
    let count = trial.len();
    let first: Vec<Vec<f64>> = trial.q.iter().map(|q| q.to_vec()).collect();
    let mut state: Vec<State> = (0..count).map(|_| State::default()).collect();
    let mut step = Vec::with_capacity(free.len());
    let mut so_far = Vec::with_capacity(free.len());
    let mut q = vec![0.0; trial.q.len()];
    // Only what has not settled goes through the model again.
    let mut moving: Vec<usize> = (0..count).collect();
    let mut last: Vec<ToolAtPose> = vec![ToolAtPose::default(); count];
    for pass in 0..=2 * budget::STEPS {
        let some = some_of(&trial, &moving);
        for (i, seen) in moving.iter().copied().zip(seen(model, &some, tools)) {
            last[i] = seen;
            let state = &mut state[i];
            if state.stepped || pass == 2 * budget::STEPS {
                state.done = state.stepped;
                continue;
            }
            if pass == budget::STEPS {
                // What does not settle keeps its orientation and gets its position.
                state.position_only = true;
                for joint in free {
                    trial.q[*joint].to_mut()[i] = first[*joint][i];
                }
                continue;
            }
            so_far.clear();
            so_far.extend(
                free.iter()
                    .map(|j| (trial.q[*j][i] - first[*j][i]) / scale.unit(*j)),
            );
            for (q, all) in q.iter_mut().zip(&trial.q) {
                *q = all[i];
            }
            let twists = model.robot.joint_twists(&q);
            scale.step(
                &last[i],
                &wanted[i],
                (free, &twists),
                &so_far,
                state,
                &mut step,
            );
            if state.singular {
                state.done = true;
                continue;
            }
            for (joint, by) in free.iter().zip(&step) {
                let by = by.clamp(-LONGEST_TURN, LONGEST_TURN) * scale.unit(*joint);
                trial.q[*joint].to_mut()[i] += by;
                for (follower, ratio) in model.robot.followers(*joint) {
                    trial.q[follower].to_mut()[i] += ratio * by;
                }
            }
            state.stepped = step.iter().all(|by| by.abs() <= rounding::COMPUTED);
        }
        moving.retain(|i| !state[*i].done);
        if moving.is_empty() {
            break;
        }
    }
    let all = state.iter().enumerate().map(|(i, state)| {
        let (way, turn) = last[i].missing(&wanted[i]);
        Reached {
            q: trial.q.iter().map(|q: &Cow<[f64]>| q[i]).collect(),
            position_mm: dot(way, way).sqrt(),
            rotation_rad: dot(turn, turn).sqrt(),
            singular: state.singular,
            settled: state.done && !state.singular,
            damped: state.damped || state.position_only,
        }
    });
    all.collect()
}

/// How far the search of one pose is.
#[derive(Debug, Clone, Copy, Default)]
#[allow(
    clippy::struct_excessive_bools,
    reason = "each is a fact of its own about the last step, and any of them can hold beside the others"
)]
struct State {
    done: bool,
    /// The last step was negligible; its end is evaluated once more.
    stepped: bool,
    singular: bool,
    /// Whether the last step was damped.
    damped: bool,
    position_only: bool,
}

/// In how many directions the free joints move the tool's origin in a generic pose.
pub fn directions(robot: &Robot, free: &[usize]) -> usize {
    Scale::of(robot, free).directions
}

/// Whether the nominal tool can hardly be moved in some direction at these joint values (rad or mm).
pub fn is_singular(robot: &Robot, q: &[f64], free: &[usize]) -> bool {
    conditioning(robot, q, free) <= FLATTEST
}

/// How evenly the free joints move the nominal tool at these joint values (rad or mm): least over
/// largest singular value of its Jacobian, 0 where it is singular, at most 1.
pub fn conditioning(robot: &Robot, q: &[f64], free: &[usize]) -> f64 {
    let free = &robot.leading(free)[..];
    let scale = Scale::of(robot, free);
    let jacobian = scale.nominal(robot, q, free);
    let (rows, rank) = if scale.whole {
        (6, 6)
    } else {
        (3, scale.directions)
    };
    let part = jacobian.rows(0, rows).into_owned();
    let Some(svd) = decompose::svd(part) else {
        return 0.0;
    };
    let mut values: Vec<f64> = svd.singular_values.iter().copied().collect();
    values.sort_by(|a, b| b.total_cmp(a));
    match (
        values.first(),
        rank.checked_sub(1).and_then(|k| values.get(k)),
    ) {
        (Some(most), Some(least)) if *most > 0.0 => least / most,
        _ => 0.0,
    }
}

/// The tool at one pose: its origin and the points that define its orientation.
#[derive(Debug, Clone, Copy, Default)]
struct ToolAtPose {
    /// Origin, and points along x, y and z of the tool frame, mm.
    at: [[f64; 3]; 4],
}

fn seen(model: &Model, inputs: &Inputs, tools: &Tools) -> Vec<ToolAtPose> {
    let mut all = vec![ToolAtPose::default(); inputs.len()];
    let mut one = inputs.clone();
    let points: Vec<_> = tools.base_from_tool.iter().map(points_at_home).collect();
    for point in 0..4 {
        one.reflectors_at_home = points.iter().map(|points| points[point]).collect();
        let positions = model.predict(&one);
        for (i, seen) in all.iter_mut().enumerate() {
            seen.at[point] = positions.get(i);
        }
    }
    all
}

/// The tool's origin and a point along each of its axes, at home, base frame, mm.
fn points_at_home(tool: &Pose) -> [[f64; 3]; 4] {
    let along = |k: usize| {
        let mut point = Point3::origin();
        if k > 0 {
            point[k - 1] = ARM_MM;
        }
        (tool * point).coords.into()
    };
    std::array::from_fn(along)
}

impl ToolAtPose {
    /// The tool's axes, nearly of unit length.
    fn axes(&self) -> [[f64; 3]; 3] {
        std::array::from_fn(|k| minus(self.at[k + 1], self.at[0]).map(|v| v / ARM_MM))
    }

    /// The pose of a rigid tool that fits the points.
    fn pose(&self) -> Pose {
        let columns = self.axes().map(nalgebra::Vector3::from);
        let matrix = Matrix3::from_columns(&columns);
        let rotation = Rotation3::from_matrix_eps(&matrix, 1e-15, 100, Rotation3::identity());
        let rotation = UnitQuaternion::from_rotation_matrix(&rotation);
        let at = nalgebra::Vector3::from(self.at[0]);
        Pose::from_parts(at.into(), rotation)
    }

    /// The remaining error of a pose: a translation, mm, and a rotation vector, rad.
    fn missing(&self, wanted: &Pose) -> ([f64; 3], [f64; 3]) {
        let way = minus(wanted.translation.vector.into(), self.at[0]);
        let matrix = wanted.rotation.to_rotation_matrix();
        let axes = self.axes();
        let turn = (0..3).fold([0.0; 3], |sum, k| {
            let goal: [f64; 3] = matrix.matrix().column(k).into_owned().into();
            add_scaled(sum, cross(axes[k], goal), 0.5)
        });
        (way, turn)
    }
}

/// How ways and turns are weighed against each other, and what the robot can do at all.
struct Scale<'r> {
    robot: &'r Robot,
    reach_mm: f64,
    kinds: Vec<JointKind>,
    /// Whether position and orientation can be met at once.
    whole: bool,
    /// In how many directions the free joints move the tool's origin in a generic pose.
    directions: usize,
}

impl<'r> Scale<'r> {
    fn of(robot: &'r Robot, free: &[usize]) -> Self {
        let mut scale = Self {
            robot,
            reach_mm: robot.reach_mm(),
            kinds: robot.joints.iter().map(|joint| joint.kind).collect(),
            whole: false,
            directions: 0,
        };
        let rank = |rows: std::ops::Range<usize>, jacobian: &DMatrix<f64>| {
            let part = jacobian.rows_range(rows).into_owned();
            decompose::svd(part).map_or(0, |svd| svd.rank(1e-6))
        };
        for seed in 1..=3 {
            let q: Vec<f64> = (0..robot.joints.len())
                .map(|j| (GOLDEN_ANGLE * (j + seed) as f64) % 2.0 - 1.0)
                .collect();
            let jacobian = scale.nominal(robot, &q, free);
            scale.directions = scale.directions.max(rank(0..3, &jacobian));
            scale.whole |= rank(0..6, &jacobian) == 6;
        }
        scale
    }

    /// The Jacobian of the nominal robot: position in parts of the reach, orientation in rad.
    fn nominal(&self, robot: &Robot, q: &[f64], free: &[usize]) -> DMatrix<f64> {
        let twists = robot.joint_twists(q);
        let tool = Point3::from(robot.base_from_tool(q).translation.vector);
        let columns = self.columns(&twists, &tool, free);
        let columns = columns
            .iter()
            .flat_map(|(way, turn)| way.iter().chain(turn));
        DMatrix::from_iterator(6, free.len(), columns.copied())
    }

    /// The translation and the turn of the tool for each free joint, with the joints that follow it: in parts of the
    /// reach, and in rad, for a [`Scale::unit`] of the joint.
    fn columns(
        &self,
        twists: &[Twist],
        tool: &Point3<f64>,
        free: &[usize],
    ) -> Vec<(Vector3<f64>, Vector3<f64>)> {
        let motion = |joint: usize| (twists[joint].velocity_at(tool), twists[joint].angular);
        let of = |joint: &usize| {
            let (mut way, mut turn) = motion(*joint);
            for (follower, ratio) in self.robot.followers(*joint) {
                let (more, turns) = motion(follower);
                way += more * ratio;
                turn += turns * ratio;
            }
            let unit = self.unit(*joint);
            (way * (unit / self.reach_mm), turn * unit)
        };
        free.iter().map(of).collect()
    }

    /// A length of joint travel that moves the tool about as far as one rad.
    fn unit(&self, joint: usize) -> f64 {
        match self.kinds[joint] {
            JointKind::Revolute => 1.0,
            JointKind::Prismatic => self.reach_mm,
        }
    }

    /// The next step in [`Scale::unit`]s. `so_far`: what the steps before have moved, in the same.
    fn step(
        &self,
        seen: &ToolAtPose,
        wanted: &Pose,
        (free, twists): (&[usize], &[Twist]),
        so_far: &[f64],
        state: &mut State,
        step: &mut Vec<f64>,
    ) {
        step.clear();
        step.resize(free.len(), 0.0);
        let (way, turn) = seen.missing(wanted);
        let way = Vector3::from(way) / self.reach_mm;
        let turn = Vector3::from(turn);
        let tool = Point3::from(Vector3::from(seen.at[0]));
        let columns = self.columns(twists, &tool, free);
        let finite = |v: &Vector3<f64>| v.iter().all(|v| v.is_finite());
        let good = finite(&way) && finite(&turn);
        if !good || !columns.iter().all(|(a, b)| finite(a) && finite(b)) {
            state.singular = true;
            return;
        }
        let gram = columns
            .iter()
            .fold(Matrix3::zeros(), |sum, (p, _)| sum + p * p.transpose());
        let Some(inverse) = self.position_inverse(&gram) else {
            state.singular = true;
            return;
        };
        let pull = inverse * way;
        for (step, (p, _)) in step.iter_mut().zip(&columns) {
            *step = p.dot(&pull);
        }
        if state.position_only {
            return;
        }
        // The null space of the position turns the tool: Jr (1 − Jp⁺ Jp), column by column.
        let across = columns
            .iter()
            .fold(Matrix3::zeros(), |sum, (p, r)| sum + r * p.transpose());
        let taken = across * inverse;
        let spare = |(p, r): &(Vector3<f64>, Vector3<f64>)| r - taken * p;
        let (mut turned, mut moved) = (Vector3::zeros(), Vector3::zeros());
        let mut spread = Matrix3::zeros();
        for ((column, step), so_far) in columns.iter().zip(step.iter()).zip(so_far) {
            let free = spare(column);
            turned += column.1 * *step;
            moved += free * *so_far;
            spread += free * free.transpose();
        }
        let rest = turn - turned;
        let eigen = decompose::eigen(spread);
        let mut pull = Vector3::zeros();
        state.damped = false;
        for k in 0..3 {
            let squared = eigen.eigenvalues[k];
            if squared <= rounding::WRITTEN * rounding::WRITTEN {
                state.damped |= self.whole;
                continue;
            }
            let along = eigen.eigenvectors.column(k).into_owned();
            let asked = along.dot(&rest);
            let most = DAMPED_BELOW * DAMPED_BELOW;
            pull += along
                * if squared >= most {
                    asked / squared
                } else {
                    state.damped = true;
                    (asked - (most - squared) * along.dot(&moved) / squared) / most
                };
        }
        for (step, column) in step.iter_mut().zip(&columns) {
            *step += spare(column).dot(&pull);
        }
    }

    /// The inverse of Jp Jpᵀ over the directions in which the tool moves well; `None` where they are fewer
    /// than in a generic pose.
    fn position_inverse(&self, gram: &Matrix3<f64>) -> Option<Matrix3<f64>> {
        let eigen = decompose::eigen(*gram);
        let most = eigen.eigenvalues.max();
        let mut inverse = Matrix3::zeros();
        let mut good = 0;
        for k in 0..3 {
            let value = eigen.eigenvalues[k];
            if most > 0.0 && value > FLATTEST_POSITION * FLATTEST_POSITION * most {
                let along = eigen.eigenvectors.column(k);
                inverse += along * along.transpose() / value;
                good += 1;
            }
        }
        (good >= self.directions && good > 0).then_some(inverse)
    }
}
