//! The inverse of a model for the tool's whole pose: which commands bring the real tool to given
//! poses.
//!
//! The position of the tool's origin comes first, its orientation as far as the joints then still
//! allow (task priority: Nakamura 1991). With six joints or more both are met; of several commands
//! that do, the nearest is taken. The derivatives are the exact ones of the model
//! ([`Model::visit_by_commands`]).
//!
//! The tool's orientation is that of three points around its origin, so that it holds for every
//! effect, whatever it moves. Where the tool can hardly be moved in some direction (less than a
//! hundredth of the best) a pose is singular: a tiny gain would cost a large move, and it is left.

use std::borrow::Cow;

use nalgebra::{DMatrix, DVector, Matrix3, Point3, Rotation3, UnitQuaternion};

use crate::effects::Inputs;
use crate::kinematics::{JointKind, Pose, Robot};
use crate::lanes::{add_scaled, cross, dot, minus};
use crate::model::Model;

/// How far from the tool's origin the points stand that carry its orientation, mm.
const LEVER_MM: f64 = 100.0;
/// Directions in which the tool moves less than this part of the most are singular.
const FLATTEST: f64 = 1e-2;
/// A step below this (rad, or the same part of the reach) changes nothing any more.
const SETTLED: f64 = 1e-13;
/// The longest single step, rad; a model is not trusted further away.
const LONGEST: f64 = 0.5;
/// Poses that do not settle by then do not settle.
const MOST_PASSES: usize = 40;
/// Enough for the singular values of any small matrix.
const MOST_ROTATIONS: usize = 1000;

/// Where the commands of one pose ended.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Reached {
    /// The commands, rad or mm.
    pub q: Vec<f64>,
    /// What is missing of the position, mm.
    pub position_mm: f64,
    /// What is missing of the orientation, rad.
    pub rotation_rad: f64,
    /// Whether the tool can hardly be moved in some direction there.
    pub singular: bool,
    /// Whether the search has settled.
    pub settled: bool,
}

/// Where a model has the tool at each pose of `inputs`; its targets play no part.
pub(crate) fn tool_poses(model: &Model, inputs: &Inputs) -> Vec<Pose> {
    let seen = seen(model, inputs);
    (0..inputs.len()).map(|i| seen[i].pose()).collect()
}

/// The commands that bring the tool of `model` to `wanted`, starting from the commands of `inputs`.
/// Only the joints in `free` (counted from 0) move.
pub(crate) fn commands_for_poses(
    model: &Model,
    inputs: &Inputs,
    wanted: &[Pose],
    free: &[usize],
) -> Vec<Reached> {
    let free = &model.robot.leading(free)[..];
    let mut trial = inputs.clone();
    let scale = Scale::of(&model.robot, free);
    let mut done = vec![false; inputs.len()];
    let mut singular = vec![false; inputs.len()];
    for _ in 0..MOST_PASSES {
        let seen = seen(model, &trial);
        for i in 0..inputs.len() {
            if done[i] {
                continue;
            }
            let Some(step) = scale.step(&model.robot, &seen[i], &wanted[i], free) else {
                singular[i] = true;
                done[i] = true;
                continue;
            };
            for (joint, by) in free.iter().zip(&step) {
                let by = by.clamp(-LONGEST, LONGEST) * scale.unit(*joint);
                trial.q[*joint].to_mut()[i] += by;
                for (follower, ratio) in model.robot.followers(*joint) {
                    trial.q[follower].to_mut()[i] += ratio * by;
                }
            }
            done[i] = step.iter().all(|by| by.abs() <= SETTLED * SETTLING);
        }
        if done.iter().all(|d| *d) {
            break;
        }
    }
    let seen = seen(model, &trial);
    (0..inputs.len())
        .map(|i| {
            let (way, turn) = seen[i].missing(&wanted[i]);
            Reached {
                q: trial.q.iter().map(|q: &Cow<[f64]>| q[i]).collect(),
                position_mm: dot(way, way).sqrt(),
                rotation_rad: dot(turn, turn).sqrt(),
                singular: singular[i],
                settled: done[i] && !singular[i],
            }
        })
        .collect()
}

/// Whether the nominal tool can hardly be moved in some direction at these joint values (rad or mm).
pub(crate) fn is_singular(robot: &Robot, q: &[f64], free: &[usize]) -> bool {
    conditioning(robot, q, free) <= FLATTEST
}

/// How evenly the free joints move the nominal tool at these joint values (rad or mm): least over
/// largest singular value of its Jacobian, 0 where it is singular, at most 1.
pub(crate) fn conditioning(robot: &Robot, q: &[f64], free: &[usize]) -> f64 {
    let free = &robot.leading(free)[..];
    let scale = Scale::of(robot, free);
    let jacobian = scale.nominal(robot, q, free);
    let (rows, rank) = if scale.whole {
        (6, 6)
    } else {
        (3, scale.directions)
    };
    let part = jacobian.rows(0, rows).into_owned();
    let Some(svd) = part.try_svd(false, false, f64::EPSILON, MOST_ROTATIONS) else {
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

/// Rounding keeps the last steps from becoming smaller than this many times [`SETTLED`].
const SETTLING: f64 = 100.0;

/// The tool at one pose: its origin and the points that carry its orientation, and how they move.
struct Seen {
    /// Origin, and points along x, y and z of the tool frame, mm.
    at: [[f64; 3]; 4],
    /// Their derivatives by each joint's command.
    by: Vec<[[f64; 3]; 4]>,
}

fn seen(model: &Model, inputs: &Inputs) -> Vec<Seen> {
    let joints = inputs.q.len();
    let nothing = || Seen {
        at: [[0.0; 3]; 4],
        by: vec![[[0.0; 3]; 4]; joints],
    };
    let mut all: Vec<Seen> = (0..inputs.len()).map(|_| nothing()).collect();
    let mut one = inputs.clone();
    one.target = None;
    for (point, at_mm) in points_at_home(&model.robot).into_iter().enumerate() {
        one.reflectors_at_home = vec![at_mm];
        model.visit_by_commands(&one, |start, block| {
            for i in 0..block.len {
                let seen = &mut all[start + i];
                seen.at[point] = [block.point[0][i], block.point[1][i], block.point[2][i]];
                for (by, column) in seen.by.iter_mut().zip(&block.columns) {
                    by[point] = [column[0][i], column[1][i], column[2][i]];
                }
            }
        });
    }
    all
}

/// The tool's origin and a point along each of its axes, at home, base frame, mm.
fn points_at_home(robot: &Robot) -> [[f64; 3]; 4] {
    let tool = &robot.base_from_tool;
    let along = |k: usize| {
        let mut point = Point3::origin();
        if k > 0 {
            point[k - 1] = LEVER_MM;
        }
        (tool * point).coords.into()
    };
    std::array::from_fn(along)
}

impl Seen {
    /// The tool's axes, nearly of unit length.
    fn axes(&self) -> [[f64; 3]; 3] {
        std::array::from_fn(|k| minus(self.at[k + 1], self.at[0]).map(|v| v / LEVER_MM))
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

    /// What is missing of a pose: a way, mm, and a rotation vector, rad.
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

    /// How the tool moves and turns per rad or mm of a joint's command.
    fn motion(&self, joint: usize) -> ([f64; 3], [f64; 3]) {
        let by = &self.by[joint];
        let axes = self.axes();
        let turn = (0..3).fold([0.0; 3], |sum, k| {
            let slope = minus(by[k + 1], by[0]).map(|v| v / LEVER_MM);
            add_scaled(sum, cross(axes[k], slope), 0.5)
        });
        (by[0], turn)
    }
}

/// How ways and turns are weighed against each other, and what the robot can do at all.
struct Scale {
    reach_mm: f64,
    kinds: Vec<JointKind>,
    /// Whether position and orientation can be met at once.
    whole: bool,
    /// In how many directions the free joints move the tool's origin in a generic pose.
    directions: usize,
}

impl Scale {
    fn of(robot: &Robot, free: &[usize]) -> Self {
        let mut scale = Self {
            reach_mm: robot.reach_mm(),
            kinds: robot.joints.iter().map(|joint| joint.kind).collect(),
            whole: false,
            directions: 0,
        };
        let rank = |rows: std::ops::Range<usize>, jacobian: &DMatrix<f64>| {
            let part = jacobian.rows_range(rows).into_owned();
            part.rank(1e-6)
        };
        for seed in 1..=3 {
            let q: Vec<f64> = (0..robot.joints.len())
                .map(|j| (GENERIC_STEP * (j + seed) as f64) % 2.0 - 1.0)
                .collect();
            let jacobian = scale.nominal(robot, &q, free);
            scale.directions = scale.directions.max(rank(0..3, &jacobian));
            scale.whole |= rank(0..6, &jacobian) == 6;
        }
        scale
    }

    /// The Jacobian of the nominal robot.
    fn nominal(&self, robot: &Robot, q: &[f64], free: &[usize]) -> DMatrix<f64> {
        let twists = robot.joint_twists(q);
        let tool = Point3::from(robot.base_from_tool(q).translation.vector);
        let columns = free.iter().map(|j| {
            let own = |j: usize| {
                (
                    twists[j].velocity_at(&tool).into(),
                    twists[j].angular.into(),
                )
            };
            with_followers(robot, *j, own)
        });
        self.jacobian(columns, free)
    }

    /// A length of joint travel that moves the tool about as far as one rad.
    fn unit(&self, joint: usize) -> f64 {
        match self.kinds[joint] {
            JointKind::Revolute => 1.0,
            JointKind::Prismatic => self.reach_mm,
        }
    }

    /// Rows: position in parts of the reach, orientation in rad; a column for each free joint.
    fn jacobian(
        &self,
        columns: impl Iterator<Item = ([f64; 3], [f64; 3])>,
        free: &[usize],
    ) -> DMatrix<f64> {
        let mut jacobian = DMatrix::zeros(6, free.len());
        for (k, (way, turn)) in columns.enumerate() {
            let unit = self.unit(free[k]);
            for axis in 0..3 {
                jacobian[(axis, k)] = way[axis] * unit / self.reach_mm;
                jacobian[(axis + 3, k)] = turn[axis] * unit;
            }
        }
        jacobian
    }

    /// The next step in [`Scale::unit`]s; `None` where the pose is singular.
    fn step(&self, robot: &Robot, seen: &Seen, wanted: &Pose, free: &[usize]) -> Option<Vec<f64>> {
        let (way, turn) = seen.missing(wanted);
        let jacobian = free
            .iter()
            .map(|j| with_followers(robot, *j, |j| seen.motion(j)));
        let jacobian = self.jacobian(jacobian, free);
        let finite = jacobian
            .iter()
            .chain(&way)
            .chain(&turn)
            .all(|v| v.is_finite());
        if !finite {
            return None;
        }
        let way = DVector::from_iterator(3, way.iter().map(|v| v / self.reach_mm));
        let turn = DVector::from_row_slice(&turn);
        if self.whole {
            let all = DVector::from_iterator(6, way.iter().chain(turn.iter()).copied());
            return solved(&jacobian, &all, 6).map(|step| step.as_slice().to_vec());
        }
        let position = jacobian.rows(0, 3).into_owned();
        let orientation = jacobian.rows(3, 3).into_owned();
        let first = solved(&position, &way, self.directions)?;
        // What the position leaves free turns the tool.
        let spare = spare_directions(&position, self.directions)?;
        let rest = turn - &orientation * &first;
        let second = least_squares(&(&orientation * &spare), &rest);
        Some((first + spare * second).as_slice().to_vec())
    }
}

/// The way and the turn that a joint gives the tool, with those of the joints that follow it.
fn with_followers(
    robot: &Robot,
    joint: usize,
    motion: impl Fn(usize) -> ([f64; 3], [f64; 3]),
) -> ([f64; 3], [f64; 3]) {
    let (mut way, mut turn) = motion(joint);
    for (follower, ratio) in robot.followers(joint) {
        let (more, turns) = motion(follower);
        for axis in 0..3 {
            way[axis] += ratio * more[axis];
            turn[axis] += ratio * turns[axis];
        }
    }
    (way, turn)
}

/// An angle that no two joints share and no robot is built to be singular at.
const GENERIC_STEP: f64 = 2.399_963_229_728_653;

/// The least step that solves the equations; `None` where fewer than `rank` directions are good.
fn solved(matrix: &DMatrix<f64>, right: &DVector<f64>, rank: usize) -> Option<DVector<f64>> {
    let svd = matrix
        .clone()
        .try_svd(true, true, f64::EPSILON, MOST_ROTATIONS)?;
    let most = svd.singular_values.max();
    let good = svd.singular_values.iter().filter(|s| **s > FLATTEST * most);
    if most <= 0.0 || good.count() < rank {
        return None;
    }
    svd.solve(right, FLATTEST * most).ok()
}

/// The least step of the least squares; directions that do nothing are left alone.
fn least_squares(matrix: &DMatrix<f64>, right: &DVector<f64>) -> DVector<f64> {
    let none = DVector::zeros(matrix.ncols());
    if matrix.is_empty() {
        return none;
    }
    let Some(svd) = matrix
        .clone()
        .try_svd(true, true, f64::EPSILON, MOST_ROTATIONS)
    else {
        return none;
    };
    svd.solve(right, FLATTEST).unwrap_or(none)
}

/// An orthonormal basis of the joint motions that leave the position where it is, as columns.
fn spare_directions(position: &DMatrix<f64>, rank: usize) -> Option<DMatrix<f64>> {
    let n = position.ncols();
    // Square, so that the decomposition has a vector for every joint.
    let square = position.transpose() * position;
    let eigen = square.try_symmetric_eigen(f64::EPSILON, MOST_ROTATIONS)?;
    let mut order: Vec<usize> = (0..n).collect();
    order.sort_by(|a, b| eigen.eigenvalues[*a].total_cmp(&eigen.eigenvalues[*b]));
    let spare = n.saturating_sub(rank);
    let columns: Vec<_> = order[..spare]
        .iter()
        .map(|k| eigen.eigenvectors.column(*k).into_owned())
        .collect();
    Some(if columns.is_empty() {
        DMatrix::zeros(n, 0)
    } else {
        DMatrix::from_columns(&columns)
    })
}
