//! A chain of elementary motions some of whose sizes are free, fitted to another chain.
//!
//! ```text
//! T(q) = S_1 · S_2 · … · S_m,   S = a fixed pose, or a turn about or a shift along x, y or z by
//!                               value + q_joint
//! ```
//!
//! Gauss–Newton on the tool's origin and two points beside it, so that turns of the tool count. The
//! derivative by a step is the velocity of the point about or along the step's axis, exactly. What
//! the poses do not tell apart keeps its starting value: steps are the shortest that do (singular
//! values below 10⁻⁹ of the largest are none).

use nalgebra::{DMatrix, DVector, Point3, Translation3, Unit, UnitQuaternion, Vector3};

use crate::kinematics::{JointKind, Pose, Robot};

/// The points beside the tool's origin, mm.
const BESIDE_MM: f64 = 300.0;
/// Poses that a fit looks at.
const POSES: usize = 96;
/// Steps of a fit.
const MOST_STEPS: usize = 60;
/// Singular values below this part of the largest tell nothing.
const TELLS: f64 = 1e-9;

/// An elementary motion.
#[derive(Debug, Clone)]
pub(super) enum Step {
    /// One that stays as it is.
    Fixed(Pose),
    /// A turn (rad) about or a shift (mm) along an axis of the frame.
    Move {
        turns: bool,
        axis: Vector3<f64>,
        value: f64,
        /// The joint whose value is added.
        joint: Option<usize>,
        free: bool,
    },
}

impl Step {
    pub(super) fn turn(axis: usize, value: f64, free: bool) -> Self {
        Self::along(true, axis, value, free)
    }

    pub(super) fn shift(axis: usize, value: f64, free: bool) -> Self {
        Self::along(false, axis, value, free)
    }

    fn along(turns: bool, axis: usize, value: f64, free: bool) -> Self {
        Self::Move {
            turns,
            axis: Vector3::ith(axis, 1.0),
            value,
            joint: None,
            free,
        }
    }

    /// The same, with a joint's value added.
    pub(super) fn with_joint(mut self, index: usize) -> Self {
        if let Self::Move { joint, .. } = &mut self {
            *joint = Some(index);
        }
        self
    }

    /// Six free steps: any small motion.
    pub(super) fn any_motion() -> Vec<Self> {
        let shifts = (0..3).map(|axis| Self::shift(axis, 0.0, true));
        let turns = (0..3).map(|axis| Self::turn(axis, 0.0, true));
        shifts.chain(turns).collect()
    }

    pub(super) fn value(&self) -> f64 {
        match self {
            Self::Fixed(_) => 0.0,
            Self::Move { value, .. } => *value,
        }
    }

    pub(super) fn pose(&self, q: &[f64]) -> Pose {
        match self {
            Self::Fixed(pose) => *pose,
            Self::Move {
                turns,
                axis,
                value,
                joint,
                ..
            } => {
                let by = value + joint.map_or(0.0, |joint| q[joint]);
                if *turns {
                    let axis = Unit::new_unchecked(*axis);
                    let rotation = UnitQuaternion::from_axis_angle(&axis, by);
                    Pose::from_parts(Translation3::identity(), rotation)
                } else {
                    Pose::from(axis * by)
                }
            }
        }
    }
}

/// The motion of consecutive steps at `q`.
pub(super) fn motion(steps: &[Step], q: &[f64]) -> Pose {
    steps
        .iter()
        .map(|step| step.pose(q))
        .fold(Pose::identity(), |a, b| a * b)
}

/// Changes the free values so that the steps lead where `target` leads, over poses within `ranges`
/// (rad or mm).
pub(super) fn fit(steps: &mut [Step], target: &Robot, ranges: &[[f64; 2]]) {
    let poses = poses(ranges);
    let wanted: Vec<[Point3<f64>; 3]> = poses
        .iter()
        .map(|q| points(&target.base_from_tool(q)))
        .collect();
    let free = steps.iter().filter(|step| is_free(step)).count();
    if free == 0 {
        return;
    }
    let mut before = f64::INFINITY;
    for _ in 0..MOST_STEPS {
        let (matrix, missing) = equations(steps, free, &poses, &wanted);
        let left = missing.norm_squared();
        // Rounding goes up and down; so does nothing else this near the end.
        if left >= before {
            break;
        }
        before = left;
        let Some(by) = shortest(matrix, &missing) else {
            break;
        };
        let mut by = by.iter();
        for step in steps.iter_mut().filter(|step| is_free(step)) {
            if let (Step::Move { value, .. }, Some(by)) = (step, by.next()) {
                *value += by;
            }
        }
    }
}

fn is_free(step: &Step) -> bool {
    matches!(step, Step::Move { free: true, .. })
}

/// The origin and two points beside it.
fn points(tool: &Pose) -> [Point3<f64>; 3] {
    let beside = [Vector3::zeros(), Vector3::x(), Vector3::y()];
    beside.map(|e| tool * Point3::from(e * BESIDE_MM))
}

/// Derivatives by the free values, and what is missing.
fn equations(
    steps: &[Step],
    free: usize,
    poses: &[Vec<f64>],
    wanted: &[[Point3<f64>; 3]],
) -> (DMatrix<f64>, DVector<f64>) {
    let rows = 9 * poses.len();
    let mut matrix = DMatrix::zeros(rows, free);
    let mut missing = DVector::zeros(rows);
    for (k, (q, wanted)) in poses.iter().zip(wanted).enumerate() {
        let mut before = Vec::with_capacity(steps.len());
        let mut frame = Pose::identity();
        for step in steps {
            before.push(frame);
            frame *= step.pose(q);
        }
        let reached = points(&frame);
        let row = |point: usize| 9 * k + 3 * point;
        for point in 0..3 {
            let off = wanted[point] - reached[point];
            missing.fixed_rows_mut::<3>(row(point)).copy_from(&off);
        }
        let moving = steps.iter().zip(&before).filter(|(step, _)| is_free(step));
        for (column, (step, frame)) in moving.enumerate() {
            let Step::Move { turns, axis, .. } = step else {
                continue;
            };
            let along = frame.rotation * axis;
            for point in 0..3 {
                let velocity = if *turns {
                    along.cross(&(reached[point].coords - frame.translation.vector))
                } else {
                    along
                };
                let mut place = matrix.fixed_view_mut::<3, 1>(row(point), column);
                place.copy_from(&velocity);
            }
        }
    }
    (matrix, missing)
}

/// The shortest step of scaled values that leaves least.
fn shortest(mut matrix: DMatrix<f64>, missing: &DVector<f64>) -> Option<DVector<f64>> {
    let mut scale = Vec::with_capacity(matrix.ncols());
    for mut column in matrix.column_iter_mut() {
        let length = column.norm();
        let by = if length > 0.0 { 1.0 / length } else { 0.0 };
        column *= by;
        scale.push(by);
    }
    let svd = matrix.try_svd(true, true, f64::EPSILON, 1000)?;
    let largest = svd.singular_values.max();
    let mut step = svd.solve(missing, TELLS * largest).ok()?;
    for (value, by) in step.iter_mut().zip(scale) {
        *value *= by;
    }
    step.iter().all(|value| value.is_finite()).then_some(step)
}

/// Points of a lattice that fills the ranges evenly (Korobov; square roots of primes).
fn poses(ranges: &[[f64; 2]]) -> Vec<Vec<f64>> {
    const PRIMES: [f64; 12] = [
        2.0, 3.0, 5.0, 7.0, 11.0, 13.0, 17.0, 19.0, 23.0, 29.0, 31.0, 37.0,
    ];
    let pose = |k: usize| {
        let value = |(joint, [from, to]): (usize, &[f64; 2])| {
            let stride = PRIMES[joint % PRIMES.len()].sqrt() * (1 + joint / PRIMES.len()) as f64;
            from + (to - from) * (0.5 + (k as f64 + 1.0) * stride).fract()
        };
        ranges.iter().enumerate().map(value).collect()
    };
    (0..POSES).map(pose).collect()
}

/// Ranges that a fit looks at: the limits, else what was measured, where that is a range at all;
/// else everything.
pub(super) fn ranges(robot: &Robot, measured: &[crate::kinematics::Range]) -> Vec<[f64; 2]> {
    let joints = robot.joints.iter().enumerate();
    joints
        .map(|(k, joint)| {
            let (least, wide) = match joint.kind {
                JointKind::Revolute => (0.02, std::f64::consts::PI),
                JointKind::Prismatic => (1.0, 100.0),
            };
            let known = joint.limits.or_else(|| measured.get(k).copied());
            match known.filter(|range| range.to - range.from > least) {
                Some(range) => [range.from, range.to],
                None => [-wide, wide],
            }
        })
        .collect()
}
