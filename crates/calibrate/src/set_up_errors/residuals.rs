//! The residuals of a session in the base model, and the columns of what may explain them.

use nalgebra::{DMatrix, DVector, Vector3};

use crate::effects::JointValues;
use crate::fit::noise::{Filter, Noise};
use crate::fit::problem::Problem;
use crate::fit::regression::Rows;
use crate::kinematics::JointKind;
use crate::linear::Basis;
use crate::model::Model;
use crate::numeric::{self, median};
use crate::sessions::{Session, SessionCorrection};

use super::fits::fitted;

/// A turn by which a joint's motion is measured, rad; of a slide mm.
const SMALL: f64 = 1e-5;
/// Rows that are farther off than so many times the median are wrong in themselves.
const WRONG: f64 = 8.0;
/// Powers of the travel by which a guide may move its carriage: of a parabola, which is what all else may look like, and
/// two more.
const GUIDE_POWERS: i32 = 4;
/// Most numbers of what may move at a row.
pub(super) const MOST: usize = 6;

/// The motion of what may move at a row: for each sample its columns.
pub(super) type Motion = Vec<[Vector3<f64>; MOST]>;

/// The residuals of a session, and columns to explain them.
pub(super) struct Residuals {
    pub(super) residual: DVector<f64>,
    pub(super) base: DMatrix<f64>,
    /// Of each joint, per unit.
    pub(super) joints: Vec<DVector<f64>>,
    /// What a guide that is not straight does to its carriage: a joint that slides among others, its moves across it and
    /// its turns, per unit.
    guides: Vec<(usize, DVector<f64>)>,
    /// Of the frame: turns about x, y, z and moves along them, by sample.
    pub(super) frame: Motion,
    /// Of a target.
    pub(super) target: Motion,
    /// The measured points as the model predicts them. A column of the measured ones would contain the residuals.
    pub(super) expected: Vec<[f64; 3]>,
    /// Samples, and axes of each.
    pub(super) n: usize,
    /// Whether something may have moved before a sample: not between those of the same pose.
    pub(super) may_move_at: Vec<bool>,
    pub(super) axes: Vec<usize>,
    /// The noise along each axis, up to a common factor.
    scale: Vec<f64>,
    /// The whitening filter, where rows of a pose share the error of repeatability.
    filter: Option<Filter>,
}

impl Residuals {
    /// With the base model fitted to these rows, and its RMS residual, mm.
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
        let (residual, base) = rows.extract(model);
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
        let joints: Vec<DVector<f64>> = (0..few.robot.joints.len()).map(turned).collect();
        let guides = carried(few, &rows, model);
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
        // Axes count by the stated noise of the instrument: their residuals contain the error that is searched for.
        let weights = problem.axis_weights;
        let scale: Vec<f64> = axes
            .iter()
            .map(|axis| weights[*axis].sqrt().recip())
            .collect();
        let mut residuals = Self {
            residual,
            base,
            joints,
            guides,
            frame,
            target,
            expected: points,
            n,
            may_move_at: vec![true; n],
            axes,
            scale,
            filter: None,
        };
        residuals.whiten();
        Some(residuals)
    }

    /// The same where rows of a pose share the error of repeatability, as far as it shows given some columns: they
    /// have the information of one row on what moves it.
    pub(super) fn with_pose_noise(
        mut self,
        few: &Session,
        values: JointValues,
        model: &Model,
        columns: &[DVector<f64>],
    ) -> Self {
        let problem = Problem::new(few, values);
        let rows = Rows::of_samples(&problem, (0..self.n).collect()).seen_by(model);
        // In mm, as the noise is.
        let (residual, base) = rows.extract(model);
        let (n, scale) = (self.n, self.scale.clone());
        let in_mm = |column: &DVector<f64>| {
            let mut column = column.clone();
            for (a, scale) in scale.iter().enumerate() {
                column.rows_mut(a * n, n).scale_mut(*scale);
            }
            column
        };
        let columns: Vec<_> = columns.iter().map(in_mm).collect();
        let stated = few.instrument.sigma_mm;
        let noise =
            Noise::estimate(stated, &rows, &residual, &joined(&base, &columns)).made_white();
        let poses = rows.inputs.pose.as_deref();
        if let Some(poses) = poses.filter(|_| noise.joints_rad > 0.0) {
            let begins = |i: usize| i == 0 || poses[i] != poses[i - 1];
            self.may_move_at = (0..n).map(begins).collect();
            self.filter = Some(noise.filter(&rows));
            self.joints = self.joints.iter().map(in_mm).collect();
            for (_, own) in &mut self.guides {
                *own = in_mm(own);
            }
            (self.residual, self.base) = (residual, base);
            self.whiten();
        }
        self
    }

    /// Whitens the residuals and their columns.
    fn whiten(&mut self) {
        let all = std::mem::take(&mut self.joints).into_iter();
        self.joints = all.map(|column| self.whitened(column)).collect();
        let all = std::mem::take(&mut self.guides).into_iter();
        self.guides = all
            .map(|(joint, own)| (joint, self.whitened(own)))
            .collect();
        self.residual = self.whitened(self.residual.clone());
        for k in 0..self.base.ncols() {
            let own = self.whitened(self.base.column(k).clone_owned());
            self.base.set_column(k, &own);
        }
    }

    /// A column in units of the noise.
    fn whitened(&self, mut column: DVector<f64>) -> DVector<f64> {
        if let Some(filter) = &self.filter {
            filter.whiten(column.as_mut_slice());
            return column;
        }
        for (a, scale) in self.scale.iter().enumerate() {
            column.rows_mut(a * self.n, self.n).unscale_mut(*scale);
        }
        column
    }

    /// A column with each sample's part times a factor.
    pub(super) fn times(
        &self,
        column: &DVector<f64>,
        factor: impl Fn(usize) -> f64,
    ) -> DVector<f64> {
        DVector::from_fn(column.len(), |row, _| column[row] * factor(row % self.n))
    }

    /// What repeats over each joint: waves of so many cycles a turn, of a slide over its travel; and what its guide does.
    pub(super) fn waves(&self, few: &Session, orders: &[f64]) -> Vec<DVector<f64>> {
        let mut all = Vec::new();
        for order in orders {
            for (joint, own) in self.joints.iter().enumerate() {
                let q = &few.samples.q[joint];
                let cycle = match few.robot.joints[joint].kind {
                    JointKind::Revolute => *order,
                    JointKind::Prismatic => {
                        let [low, high] = numeric::extent(q);
                        order * std::f64::consts::TAU / (high - low).max(1e-9)
                    }
                };
                all.push(self.times(own, |i| (cycle * q[i]).sin()));
                all.push(self.times(own, |i| (cycle * q[i]).cos()));
            }
        }
        for (joint, own) in &self.guides {
            let q = &few.samples.q[*joint];
            let [low, high] = numeric::extent(q);
            let at = |i: usize| (2.0 * q[i] - low - high) / (high - low).max(1e-9);
            all.extend((1..=GUIDE_POWERS).map(|power| self.times(own, |i| at(i).powi(power))));
        }
        all
    }

    pub(super) fn column(&self, of: impl Fn(usize) -> Vector3<f64>) -> DVector<f64> {
        let at = |row: usize| of(row % self.n)[self.axes[row / self.n]];
        self.whitened(DVector::from_fn(self.residual.len(), |row, _| at(row)))
    }

    /// The first so many columns of what moves.
    pub(super) fn moved(&self, motion: &Motion, count: usize) -> Vec<DVector<f64>> {
        let columns = (0..count).map(|k| self.column(|i| motion[i][k]));
        columns.collect()
    }
}

/// The columns of what the guides of a robot of several joints do, the motion of the joint first.
fn carried(few: &Session, rows: &Rows, model: &Model) -> Vec<(usize, DVector<f64>)> {
    let joints = &few.robot.joints;
    let slides = |joint: &usize| joints.len() > 1 && joints[*joint].kind == JointKind::Prismatic;
    let of_joint = |joint: usize| {
        let moves = rows.moves_of(model, joint).into_iter();
        moves.map(move |own| (joint, own))
    };
    (0..joints.len())
        .filter(slides)
        .flat_map(of_joint)
        .collect()
}

/// Columns side by side.
pub(super) fn joined(base: &DMatrix<f64>, more: &[DVector<f64>]) -> DMatrix<f64> {
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

/// The residuals projected orthogonal to the base model and other columns.
pub(super) struct Projected<'a> {
    residuals: &'a Residuals,
    pub(super) basis: Basis,
    /// Outliers are limited to what is usual.
    pub(super) free: DVector<f64>,
    square: f64,
    freedom: f64,
}

impl<'a> Projected<'a> {
    /// `None` without degrees of freedom.
    pub(super) fn of(residuals: &'a Residuals, columns: &[DVector<f64>]) -> Option<Self> {
        let basis = Basis::new(&joined(&residuals.base, columns));
        let free = basis.reject(&residuals.residual);
        let freedom = free.len().checked_sub(basis.rank()).filter(|n| *n > 0)? as f64;
        let usual = median(free.iter().map(|e| e.abs()))?;
        let free = free.map(|e| e.clamp(-WRONG * usual, WRONG * usual));
        let free = basis.reject(&free);
        let square = free.norm_squared();
        Some(Self {
            residuals,
            basis,
            free,
            square,
            freedom,
        })
    }

    /// The logarithm by which so many columns that reduce the residual sum of squares by this are likelier than none:
    /// Zellner's prior with the weight of one row (Liang et al. 2008, equation 6). Of many rows it is the BIC; of few
    /// it stays finite however small the residual is.
    pub(super) fn nats(&self, gain: f64, numbers: usize) -> f64 {
        let rows = self.free.len() as f64;
        let share = (1.0 - gain / self.square).clamp(0.0, 1.0);
        let spent = self.freedom - numbers as f64;
        0.5 * (spent * rows.ln_1p() - self.freedom * (rows * share).ln_1p())
    }

    /// The logarithm by which a column is likelier than none whose part of this square was projected out before.
    pub(super) fn nats_without(&self, gain: f64) -> f64 {
        let square = self.square.max(f64::MIN_POSITIVE);
        let rows = self.free.len() as f64;
        0.5 * self.freedom * (1.0 + gain / square).ln() - 0.5 * rows.ln()
    }

    /// The coefficients of columns fitted to the residuals, and the logarithm by which they are likelier than none.
    pub(super) fn with(&self, columns: &[DVector<f64>]) -> (DVector<f64>, f64) {
        let own = self.own(columns);
        let taken = &self.free - own.reject(&self.free);
        let nats = self.nats(taken.norm_squared(), columns.len());
        (own.solve(&self.free), nats / self.dilution(&own))
    }

    /// A basis of the columns projected orthogonal to the others.
    pub(super) fn own(&self, columns: &[DVector<f64>]) -> Basis {
        let own: Vec<_> = columns.iter().map(|c| self.basis.reject(c)).collect();
        Basis::new(&DMatrix::from_columns(&own))
    }

    /// By how much the information of successive rows is reduced by correlation, given some columns: (1 + ρ)/(1 − ρ)
    /// with the correlation ρ of neighbours, at least 1.
    pub(super) fn dilution(&self, own: &Basis) -> f64 {
        let residual = own.reject(&self.free);
        let n = self.residuals.n;
        let of_axis = |a: usize| {
            (a * n + 1..(a + 1) * n)
                .map(|row| residual[row] * residual[row - 1])
                .sum::<f64>()
        };
        let product: f64 = (0..self.residuals.axes.len()).map(of_axis).sum();
        let correlation = (product / residual.norm_squared().max(1e-300)).clamp(0.0, 0.95);
        (1.0 + correlation) / (1.0 - correlation)
    }
}
