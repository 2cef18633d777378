//! What the rows of a session leave beside the base model, and the columns of what may explain it.

use nalgebra::{DMatrix, DVector, Vector3};

use crate::effects::JointValues;
use crate::fit::problem::Problem;
use crate::fit::regression::Rows;
use crate::kinematics::JointKind;
use crate::linear::Basis;
use crate::model::Model;
use crate::numeric::{self, median};
use crate::sessions::{Session, SessionCorrection};

use super::groups::fitted;

/// A turn by which a joint's motion is measured, rad; of a slide mm.
const SMALL: f64 = 1e-5;
/// Rows that are farther off than so many times the median are wrong in themselves.
const WRONG: f64 = 8.0;
/// Most numbers of what may move at a row.
pub(super) const MOST: usize = 6;

/// The motion of what may move at a row: for each sample its columns.
pub(super) type Motion = Vec<[Vector3<f64>; MOST]>;

/// What the rows of a session leave, and the columns beside.
pub(super) struct Left {
    pub(super) residual: DVector<f64>,
    pub(super) base: DMatrix<f64>,
    /// Of each joint, per unit.
    pub(super) joints: Vec<DVector<f64>>,
    /// Of the frame: turns about x, y, z and moves along them, by sample.
    pub(super) frame: Motion,
    /// Of a target.
    pub(super) target: Motion,
    /// Where the model expects the measured points. A column of where they were measured has in it what is left.
    pub(super) expected: Vec<[f64; 3]>,
    /// Samples, and axes of each.
    pub(super) n: usize,
    pub(super) axes: Vec<usize>,
    /// The noise along each axis, up to a common factor.
    pub(super) scale: Vec<f64>,
}

impl Left {
    /// With the base model fitted to these rows, and the root mean square of what that leaves, mm.
    pub(super) fn after_a_fit(few: &Session, values: JointValues) -> Option<(Self, f64)> {
        let (model, rms_mm) = fitted(few, values)?;
        Some((Self::of(few, values, &model)?, rms_mm))
    }

    pub(super) fn of(few: &Session, values: JointValues, model: &Model) -> Option<Self> {
        let problem = Problem::new(few, values);
        let n = few.samples.len();
        let rows = Rows::of_samples(&problem, (0..n).collect());
        if rows.samples.iter().copied().ne(0..n) {
            return None;
        }
        let (mut residual, mut base) = rows.extract(model);
        let axes = rows.axes.clone();
        let turned = |joint: usize| {
            let mut moved = few.clone();
            SessionCorrection::TurnHome {
                joint,
                by_rad: SMALL,
            }
            .apply(&mut moved);
            let problem = Problem::new(&moved, values);
            let there = Rows::of_samples(&problem, (0..n).collect()).residual(model);
            (&residual - there) / SMALL
        };
        let mut joints: Vec<DVector<f64>> = (0..few.robot.joints.len()).map(turned).collect();
        let points = rows.points(model);
        let mean = points
            .iter()
            .map(|p| Vector3::from(*p))
            .sum::<Vector3<f64>>()
            / n as f64;
        let along = |axis: usize| {
            let mut moved = few.clone();
            let mut by_mm = [0.0; 3];
            by_mm[axis] = 1.0;
            for target in 0..moved.targets.len() {
                SessionCorrection::MoveTarget { target, by_mm }.apply(&mut moved);
            }
            let problem = Problem::new(&moved, values);
            Rows::of_samples(&problem, (0..n).collect()).points(model)
        };
        let displaced = [0, 1, 2].map(along);
        let zero = Vector3::zeros();
        let unit = |k: usize| Vector3::ith(k, 1.0);
        let size = points
            .iter()
            .map(|p| (Vector3::from(*p) - mean).norm())
            .fold(1.0, f64::max);
        let frame = points.iter().map(|p| {
            let arm = (Vector3::from(*p) - mean) / size;
            std::array::from_fn(|k| {
                if k < 3 {
                    unit(k)
                } else {
                    unit(k - 3).cross(&arm)
                }
            })
        });
        let target = (0..n).map(|i| {
            let place = Vector3::from(points[i]);
            let by = |k: usize| Vector3::from(displaced[k][i]) - place;
            std::array::from_fn(|k| if k < 3 { by(k) } else { zero })
        });
        let (frame, target) = (frame.collect(), target.collect());
        // Axes count as the instrument is said to see them: what is left of them is the error that is looked for.
        let weights = problem.axis_weights;
        let scale: Vec<f64> = axes
            .iter()
            .map(|axis| weights[*axis].sqrt().recip())
            .collect();
        for (a, scale) in scale.iter().enumerate() {
            residual.rows_mut(a * n, n).unscale_mut(*scale);
            base.rows_mut(a * n, n).unscale_mut(*scale);
            for joint in &mut joints {
                joint.rows_mut(a * n, n).unscale_mut(*scale);
            }
        }
        Some(Self {
            residual,
            base,
            joints,
            frame,
            target,
            expected: points,
            n,
            axes,
            scale,
        })
    }

    /// A column with each sample's part times a factor.
    pub(super) fn times(
        &self,
        column: &DVector<f64>,
        factor: impl Fn(usize) -> f64,
    ) -> DVector<f64> {
        DVector::from_fn(column.len(), |row, _| column[row] * factor(row % self.n))
    }

    /// Waves of so many cycles a turn over each joint; of a slide over its travel.
    pub(super) fn waves(&self, few: &Session, order: f64) -> Vec<DVector<f64>> {
        let mut all = Vec::new();
        for (joint, own) in self.joints.iter().enumerate() {
            let q = &few.samples.q[joint];
            let cycle = match few.robot.joints[joint].kind {
                JointKind::Revolute => order,
                JointKind::Prismatic => {
                    let [low, high] = numeric::extent(q);
                    order * std::f64::consts::TAU / (high - low).max(1e-9)
                }
            };
            all.push(self.times(own, |i| (cycle * q[i]).sin()));
            all.push(self.times(own, |i| (cycle * q[i]).cos()));
        }
        all
    }

    pub(super) fn column(&self, of: impl Fn(usize) -> Vector3<f64>) -> DVector<f64> {
        DVector::from_fn(self.residual.len(), |row, _| {
            let a = row / self.n;
            of(row % self.n)[self.axes[a]] / self.scale[a]
        })
    }
}

/// Columns side by side.
pub(super) fn beside(base: &DMatrix<f64>, more: &[DVector<f64>]) -> DMatrix<f64> {
    let mut all = base
        .clone()
        .resize_horizontally(base.ncols() + more.len(), 0.0);
    for (k, column) in more.iter().enumerate() {
        all.set_column(base.ncols() + k, column);
    }
    for mut column in all.column_iter_mut() {
        let norm = column.norm();
        if norm > 0.0 {
            column /= norm;
        }
    }
    all
}

/// What is left beside the base model and other columns.
pub(super) struct Beside {
    pub(super) basis: Basis,
    /// Rows that are wrong in themselves count as what is usual.
    pub(super) free: DVector<f64>,
    square: f64,
    freedom: f64,
}

impl Beside {
    /// `None` where no direction is left.
    pub(super) fn of(left: &Left, columns: &[DVector<f64>]) -> Option<Self> {
        let basis = Basis::new(&beside(&left.base, columns));
        let free = basis.reject(&left.residual);
        let freedom = free.len().checked_sub(basis.rank()).filter(|n| *n > 0)? as f64;
        let usual = median(free.iter().map(|e| e.abs()))?;
        let free = free.map(|e| e.clamp(-WRONG * usual, WRONG * usual));
        let free = basis.reject(&free);
        let square = free.norm_squared();
        Some(Self {
            basis,
            free,
            square,
            freedom,
        })
    }

    /// The logarithm by which columns of so many numbers that take this square out of what is left are likelier than
    /// none (BIC).
    pub(super) fn nats(&self, gain: f64, numbers: usize) -> f64 {
        let remaining = (self.square - gain).max(1e-6 * self.square);
        let rows = self.free.len() as f64;
        0.5 * self.freedom * (self.square / remaining.max(f64::MIN_POSITIVE)).ln()
            - 0.5 * numbers as f64 * rows.ln()
    }

    /// The logarithm by which a column is likelier than none whose part of this square was taken out before.
    pub(super) fn nats_without(&self, gain: f64) -> f64 {
        let square = self.square.max(f64::MIN_POSITIVE);
        let rows = self.free.len() as f64;
        0.5 * self.freedom * (1.0 + gain / square).ln() - 0.5 * rows.ln()
    }

    /// What columns take out of what is left: their factors, and the logarithm by which they are likelier than none.
    pub(super) fn with(&self, columns: &[DVector<f64>]) -> (DVector<f64>, f64) {
        let own: Vec<_> = columns.iter().map(|c| self.basis.reject(c)).collect();
        let own = Basis::new(&DMatrix::from_columns(&own));
        let taken = &self.free - own.reject(&self.free);
        let nats = self.nats(taken.norm_squared(), columns.len());
        (own.solve(&self.free), nats)
    }
}
