//! A home that moved while the robot was measured: an encoder that slips on its shaft, one that is homed anew.
//!
//! What the fitted robot leaves is regressed on the motion of each joint from a row on, beside every column of the base
//! model and what else may look like a step: waves over each joint, its side of approach, a drift. The gain of a step at
//! row k, with the columns' part along the base projected out,
//!
//! ```text
//! g(k) = v² / (cᵀc − |Qᵀc|²),   c = J_j on the rows from k on,   v = cᵀr
//! ```
//!
//! comes from sums over the rows from the last to the first, at a cost linear in the rows. A target that moved and a frame
//! that did are tried at the same rows: only where the home of a joint is likelier than these is it said. One step after
//! another is added while it is likelier by far.

use nalgebra::{DMatrix, DVector, SMatrix, SVector, Vector3};

use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::fit::problem::Problem;
use crate::fit::regression::Rows;
use crate::kinematics::JointKind;
use crate::linear::Basis;
use crate::model::Model;
use crate::numeric::{self, median};
use crate::sessions::{Group, Session, SessionCorrection};
use crate::text::{angle, length};

use super::nearest::EVIDENCE;
use super::rows::{Part, RowsInOrder};
use crate::set_up_errors::groups::fitted;

/// Rows that are looked at.
const MOST_ROWS: usize = 240;
/// With fewer rows that count nothing is reported.
const FEWEST_ROWS: usize = 24;
/// Fewest rows on either side of a step.
const FEWEST_BESIDE: usize = 4;
/// Most steps of one session.
const MOST_STEPS: usize = 6;
/// Rows to a column, at least.
const ROWS_TO_A_COLUMN: usize = 2;
/// The logarithm by which a step is likelier at its row than so large a share of the rows before and behind.
const SHARP: f64 = 8.0;
const BESIDE_SHARE: f64 = 1.0 / 15.0;
/// The logarithm by which the home has to be likelier than a target or a frame that moved.
const LIKELIER: f64 = 3.0;
/// A turn by which a joint's motion is measured, rad; of a slide mm.
const SMALL: f64 = 1e-5;
/// Rows that are farther off than so many times the median are wrong in themselves.
const WRONG: f64 = 8.0;
/// How often sizes are fitted again with what they corrected.
const ROUNDS: usize = 3;
/// Most numbers of what may move at a row.
const MOST: usize = 6;

/// A home that moved: by so much (rad, mm) from the k-th row that counts on.
#[derive(Debug, Clone, Copy)]
struct Step {
    joint: usize,
    from: usize,
    by: f64,
}

/// The session with every row turned to the homes as they were in the end; `None` where none moved.
pub(in crate::set_up_errors) fn corrected(
    session: &Session,
    values: JointValues,
    problems: &mut Vec<DataProblem>,
) -> Option<Session> {
    let rows = RowsInOrder::of(session, MOST_ROWS);
    if rows.len() < FEWEST_ROWS || !session.has_plain_points() {
        return None;
    }
    let few = rows.select(session);
    let (model, before_mm) = fitted(&few, values)?;
    let mut steps = found(&few, values, &model)?;
    let mut left_mm = before_mm;
    for _ in 0..ROUNDS {
        let mut corrected = few.clone();
        for step in &steps {
            step.correction(vec![(0, step.from)]).apply(&mut corrected);
        }
        let (model, left) = fitted(&corrected, values)?;
        left_mm = left;
        refine(&corrected, values, &model, &mut steps)?;
    }
    if left_mm >= before_mm {
        return None;
    }
    steps.sort_by_key(|step| step.from);
    let mut better = session.clone();
    for step in &steps {
        let before = rows.ranges(session, Part::Stretch(0, step.from));
        let mend = step.correction(before);
        mend.apply(&mut better);
        problems.push(step.problem(session, &rows, mend, [before_mm, left_mm]));
    }
    Some(better)
}

impl Step {
    /// Turns these rows, which were measured before it.
    fn correction(&self, rows: Vec<(usize, usize)>) -> SessionCorrection {
        SessionCorrection::InRows {
            rows,
            by: Box::new(SessionCorrection::TurnHome {
                joint: self.joint,
                by_rad: -self.by,
            }),
        }
    }

    fn problem(
        &self,
        session: &Session,
        rows: &RowsInOrder,
        mend: SessionCorrection,
        [before_mm, left_mm]: [f64; 2],
    ) -> DataProblem {
        let joint = self.joint + 1;
        let by = match session.robot.joints[self.joint].kind {
            JointKind::Revolute => angle(self.by, 4),
            JointKind::Prismatic => length(self.by, 3),
        };
        DataProblem {
            what: text!(
                "the home position of joint {joint} moved by {by} at sample {sample}",
                joint,
                by = by.clone(),
                sample = rows.row(self.from) + 1
            ),
            evidence: text!(
                "the base model leaves {before} as it stands and {after} with these samples corrected; more than 1000 times likelier",
                before = length(before_mm, 3),
                after = length(left_mm, 3)
            ),
            proposal: text!(
                "the samples before are turned by it, to the home as it is now; look at the encoder's coupling, or at how joint {joint} is homed",
                joint
            ),
            mend: Some(mend),
            samples: (0..rows.len())
                .filter(|k| *k < self.from)
                .map(|k| rows.row(k))
                .collect(),
        }
    }
}

/// The motion of what may move at a row: for each sample its columns.
type Motion = Vec<[Vector3<f64>; MOST]>;

/// What the rows of a session leave, and the columns beside.
struct Left {
    residual: DVector<f64>,
    base: DMatrix<f64>,
    /// Of each joint, per unit.
    joints: Vec<DVector<f64>>,
    /// Of the frame: turns about x, y, z and moves along them, by sample.
    frame: Motion,
    /// Of a target.
    target: Motion,
    /// Samples, and axes of each.
    n: usize,
    axes: Vec<usize>,
    /// The size of a deviation along each axis.
    scale: Vec<f64>,
}

impl Left {
    fn of(few: &Session, values: JointValues, model: &Model) -> Option<Self> {
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
        // Axes count by what they leave.
        let of_axis = |a: usize| median((0..n).map(|i| residual[a * n + i].abs()));
        let scale: Vec<f64> = (0..axes.len())
            .map(|a| of_axis(a).unwrap_or(1.0).max(1e-6))
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
            n,
            axes,
            scale,
        })
    }

    /// A column with each sample's part times a factor.
    fn times(&self, column: &DVector<f64>, factor: impl Fn(usize) -> f64) -> DVector<f64> {
        DVector::from_fn(column.len(), |row, _| column[row] * factor(row % self.n))
    }

    fn from(&self, joint: usize, first: usize) -> DVector<f64> {
        self.times(&self.joints[joint], |i| f64::from(u8::from(i >= first)))
    }

    /// What else may look like a step: waves over each joint, its side of approach, a drift of its home and of the
    /// frame.
    fn rivals(&self, few: &Session) -> Vec<DVector<f64>> {
        let mut all = Vec::new();
        let half = 0.5 * self.n as f64;
        let time = |i: usize| (i as f64 - half) / half;
        let samples = &few.samples;
        let known = |column: &[f64], i: usize| {
            if column[i].is_finite() {
                column[i]
            } else {
                0.0
            }
        };
        for (joint, own) in self.joints.iter().enumerate() {
            all.push(self.times(own, time));
            let of_joint = [&samples.dir, &samples.speed].map(|columns| columns.get(joint));
            let of_joint = of_joint.into_iter().flatten();
            let recorded = [&samples.temperature_c, &samples.load_kg];
            for column in of_joint.chain(recorded).flatten() {
                all.push(self.times(own, |i| known(column, i)));
            }
        }
        for power in [1, 2] {
            for along in 0..3 {
                all.push(self.column(|i| self.frame[i][along] * time(i).powi(power)));
            }
        }
        for order in [1.0, 2.0] {
            for (joint, own) in self.joints.iter().enumerate() {
                let q = &samples.q[joint];
                // A slide has waves over its travel.
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
        }
        for own in &self.joints {
            all.push(self.times(own, |i| time(i) * time(i)));
        }
        all
    }

    fn column(&self, of: impl Fn(usize) -> Vector3<f64>) -> DVector<f64> {
        DVector::from_fn(self.residual.len(), |row, _| {
            let a = row / self.n;
            of(row % self.n)[self.axes[a]] / self.scale[a]
        })
    }
}

/// Columns side by side.
fn beside(base: &DMatrix<f64>, more: &[DVector<f64>]) -> DMatrix<f64> {
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

/// The gain in square of what moves from a row on, for each row: the first so many of its columns.
fn gains(
    left: &Left,
    basis: &Basis,
    free: &DVector<f64>,
    motion: &Motion,
    count: usize,
    own: impl Fn(usize) -> bool,
) -> Vec<f64> {
    let n = left.n;
    let rank = basis.rank();
    let mut gram = SMatrix::<f64, MOST, MOST>::zeros();
    let mut pull = SVector::<f64, MOST>::zeros();
    let mut along = DMatrix::<f64>::zeros(rank, count);
    let mut gains = vec![0.0; n];
    for i in (0..n).rev() {
        if own(i) {
            for (a, axis) in left.axes.iter().enumerate() {
                let row = a * n + i;
                let by = SVector::<f64, MOST>::from_fn(|k, _| {
                    if k < count {
                        motion[i][k][*axis] / left.scale[a]
                    } else {
                        0.0
                    }
                });
                gram += by * by.transpose();
                pull += by * free[row];
                let q = basis.q.row(row);
                for k in 0..count {
                    for (to, q) in along.column_mut(k).iter_mut().zip(q.iter()) {
                        *to += by[k] * q;
                    }
                }
            }
        }
        if i < FEWEST_BESIDE || i + FEWEST_BESIDE > n {
            continue;
        }
        let mut projected = gram;
        for k in 0..count {
            for j in 0..count {
                projected[(k, j)] -= along.column(k).dot(&along.column(j));
            }
        }
        // What the base follows all the same shows nothing.
        for k in 0..MOST {
            let least = 1e-3 * gram[(k, k)].max(1e-12);
            projected[(k, k)] = projected[(k, k)].max(0.0) + least;
        }
        let solved = nalgebra::Cholesky::new(projected).map(|factor| factor.solve(&pull));
        gains[i] = solved.map_or(0.0, |x| x.dot(&pull));
    }
    gains
}

/// Every home that moved.
fn found(few: &Session, values: JointValues, model: &Model) -> Option<Vec<Step>> {
    let left = Left::of(few, values, model)?;
    let rows = left.residual.len();
    let mut rivals = left.rivals(few);
    // What matters most comes first.
    let most = (rows / ROWS_TO_A_COLUMN).checked_sub(left.base.ncols())?;
    rivals.truncate(most);
    let mut steps: Vec<Step> = Vec::new();
    while steps.len() < MOST_STEPS {
        let basis = Basis::new(&beside(&left.base, &rivals));
        let free = basis.reject(&left.residual);
        let Some(step) = likeliest(few, &left, &basis, &free) else {
            break;
        };
        rivals.push(left.from(step.joint, step.from));
        steps.push(step);
    }
    (!steps.is_empty()).then_some(steps)
}

/// The joint and the row of the likeliest step, if it is likely enough.
fn likeliest(few: &Session, left: &Left, basis: &Basis, free: &DVector<f64>) -> Option<Step> {
    let n = left.n;
    let rows = free.len();
    let freedom = rows.saturating_sub(basis.rank()) as f64;
    // Rows that are wrong in themselves count as what is usual.
    let usual = median(free.iter().map(|e| e.abs()))?;
    let free = free.map(|e| e.clamp(-WRONG * usual, WRONG * usual));
    let square = free.norm_squared();
    let nats = |gain: f64, numbers: usize| {
        let remaining = (square - gain).max(1e-6 * square).max(f64::MIN_POSITIVE);
        0.5 * freedom * (square / remaining).ln()
            - 0.5 * numbers as f64 * (rows as f64).ln()
            - (n as f64).ln()
    };
    let best_of = |gains: Vec<f64>| {
        let best = gains.into_iter().enumerate();
        best.max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, 0.0))
    };
    let of_joint = |joint: usize| {
        let motion: Motion = (0..n)
            .map(|i| {
                let mut own = [Vector3::zeros(); MOST];
                for (a, axis) in left.axes.iter().enumerate() {
                    own[0][*axis] = left.joints[joint][a * n + i] * left.scale[a];
                }
                own
            })
            .collect();
        let all = gains(left, basis, &free, &motion, 1, |_| true);
        let (from, gain) = best_of(all.clone());
        (joint, from, gain, all)
    };
    let homes = (0..left.joints.len()).map(of_joint);
    let (joint, from, gain, all) = homes.max_by(|a, b| a.2.total_cmp(&b.2))?;
    // What is as likely some rows on is no step.
    let aside = numeric::whole((BESIDE_SHARE * n as f64).max(3.0));
    let beside = [from.checked_sub(aside), Some(from + aside)];
    let beside = beside.into_iter().flatten().filter_map(|k| all.get(k));
    if beside
        .into_iter()
        .any(|other| nats(gain, 1) < nats(*other, 1) + SHARP)
    {
        return None;
    }
    let own = nats(gain, 1);
    // Correlated noise has fewer independent rows.
    let own = own / dilution(left, &(&free - projection(left, basis, joint, from, &free)));
    if own < EVIDENCE {
        return None;
    }
    let everything = |_: usize| true;
    let moved = best_of(gains(left, basis, &free, &left.frame, 3, everything)).1;
    let turned = best_of(gains(left, basis, &free, &left.frame, 6, everything)).1;
    // A slide's home is its frame along it: that has a name of its own.
    let mut rivals = nats(moved, 1).max(nats(turned, 6));
    for target in 0..Group::Target.count(few) {
        let own = |i: usize| Group::Target.of(few, i) == Some(target);
        let gain = best_of(gains(left, basis, &free, &left.target, 3, own)).1;
        rivals = rivals.max(nats(gain, 3));
    }
    (nats(gain, 1) > rivals + LIKELIER).then_some(Step {
        joint,
        from,
        by: 0.0,
    })
}

/// The part of what is left along a step.
fn projection(
    left: &Left,
    basis: &Basis,
    joint: usize,
    from: usize,
    free: &DVector<f64>,
) -> DVector<f64> {
    let column = basis.reject(&left.from(joint, from));
    let square = column.norm_squared().max(1e-12);
    &column * (column.dot(free) / square)
}

/// By how much rows that follow one another say the same: (1 + ρ)/(1 − ρ) with the correlation ρ of neighbours, at
/// least 1.
fn dilution(left: &Left, residual: &DVector<f64>) -> f64 {
    let n = left.n;
    let mut product = 0.0;
    for a in 0..left.axes.len() {
        product += (1..n)
            .map(|i| residual[a * n + i] * residual[a * n + i - 1])
            .sum::<f64>();
    }
    let correlation = (product / residual.norm_squared().max(1e-300)).clamp(0.0, 0.95);
    (1.0 + correlation) / (1.0 - correlation)
}

/// Adds to each step what the corrected rows leave of it.
fn refine(
    corrected: &Session,
    values: JointValues,
    model: &Model,
    steps: &mut [Step],
) -> Option<()> {
    let left = Left::of(corrected, values, model)?;
    let columns: Vec<DVector<f64>> = steps
        .iter()
        .map(|step| left.from(step.joint, step.from))
        .collect();
    let all = beside(&left.base, &columns);
    let norms: Vec<f64> = columns
        .iter()
        .map(|column| column.norm().max(1e-12))
        .collect();
    let solution = Basis::new(&all).solve(&left.residual);
    for (k, step) in steps.iter_mut().enumerate() {
        step.by += solution[left.base.ncols() + k] / norms[k];
    }
    Some(())
}
