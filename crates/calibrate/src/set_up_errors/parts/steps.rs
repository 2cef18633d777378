//! A home that moved while the robot was measured (an encoder that slips on its shaft, one that is homed anew), or a base
//! or an instrument that moved and turned (bolts that came loose, a tripod).
//!
//! What the fitted robot leaves is regressed on the motion of each joint from a row on, beside every column of the base
//! model and what else may look like a step: waves over each joint, its side of approach, a drift. The gain of a step at
//! row k, with the columns' part along the base projected out,
//!
//! ```text
//! g(k) = v² / (cᵀc − |Qᵀc|²),   c = J_j on the rows from k on,   v = cᵀr
//! ```
//!
//! comes from sums over the rows from the last to the first, at a cost linear in the rows; a frame has six columns.
//! One step after another is added while it is likelier; then each has to be likelier by far beside all the others, sharp
//! in its row, and likelier than a target that moved or, for a home, a frame that did. The weakest of those that are not
//! is dropped, and the others are looked at again.

use nalgebra::{DMatrix, DVector, SMatrix, SVector, Vector3};

use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::fit::base_model;
use crate::linear::Basis;
use crate::model::Model;
use crate::numeric;
use crate::sessions::{Group, Session};

use super::moved::{Step, What};
use super::rows::{Part, RowsInOrder};
use crate::set_up_errors::groups::fitted;
use crate::set_up_errors::left::{Beside, Left, MOST, Motion, beside};
use crate::set_up_errors::thresholds;

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
/// How often sizes are fitted again with what they corrected.
const ROUNDS: usize = 3;

/// The session with every row turned to the homes as they were in the end; `None` where none moved.
pub(in crate::set_up_errors) fn corrected(
    session: &Session,
    values: JointValues,
    problems: &mut Vec<DataProblem>,
) -> Option<Session> {
    let rows = RowsInOrder::of(session, MOST_ROWS).of_new_places(session);
    if rows.len() < FEWEST_ROWS || !session.has_plain_points() {
        return None;
    }
    let few = rows.select(session);
    let (model, before_mm) = fitted(&few, values)?;
    let mut steps = found(&few, values, &model)?;
    // A frame is that of all rows before its step until an earlier one takes some: the last is made first.
    steps.sort_by_key(|step| match step.what {
        What::Frame => (0, rows.len() - step.from),
        What::Home(_) => (1, step.from),
    });
    let mut left_mm = before_mm;
    for round in 0..ROUNDS {
        let mut corrected = few.clone();
        for step in &steps {
            step.correction(vec![(0, step.from)]).apply(&mut corrected);
        }
        let (model, left) = fitted(&corrected, values)?;
        left_mm = left;
        let left = Left::of(&corrected, values, &model)?;
        refine(&left, &mut steps);
        // Beside large steps, before they are corrected, their curvature looks like small ones.
        if round > 0 {
            let all = steps.clone();
            steps.retain(|step| still_likelier(&left, &all, *step));
        }
    }
    if left_mm >= before_mm || steps.is_empty() {
        return None;
    }
    let mut better = session.clone();
    for step in &steps {
        let before = rows.ranges(session, Part::Stretch(0, step.from));
        let mend = step.correction(before);
        mend.apply(&mut better);
        problems.push(step.problem(session, &rows, mend, [before_mm, left_mm]));
    }
    Some(better)
}

impl Left {
    /// The columns of a step.
    fn from(&self, what: What, first: usize) -> Vec<DVector<f64>> {
        let is_after = |i: usize| f64::from(u8::from(i >= first));
        match what {
            What::Home(joint) => vec![self.times(&self.joints[joint], is_after)],
            What::Frame => (0..MOST)
                .map(|k| self.column(|i| self.frame[i][k] * is_after(i)))
                .collect(),
        }
    }

    /// What moves at a row, by sample.
    fn motion(&self, what: What) -> Motion {
        let What::Home(joint) = what else {
            return self.frame.clone();
        };
        let of_sample = |i: usize| {
            let mut own = [Vector3::zeros(); MOST];
            for (a, axis) in self.axes.iter().enumerate() {
                own[0][*axis] = self.joints[joint][a * self.n + i] * self.scale[a];
            }
            own
        };
        (0..self.n).map(of_sample).collect()
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
            let columns = [
                &samples.dir,
                &samples.speed,
                &samples.joint_temperature_c,
                &samples.torque_nm,
            ];
            let of_joint = columns.map(|columns| columns.get(joint));
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
            all.extend(self.waves(few, order));
        }
        for own in &self.joints {
            all.push(self.times(own, |i| time(i) * time(i)));
        }
        all
    }
}

/// The gain in square of what moves from a row on, for each row: the first so many of its columns.
fn gains(
    left: &Left,
    Beside { basis, free, .. }: &Beside,
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

/// Everything that moved.
fn found(few: &Session, values: JointValues, model: &Model) -> Option<Vec<Step>> {
    let left = Left::of(few, values, model)?;
    let mut rivals = left.rivals(few);
    // What matters most comes first.
    let most = (left.residual.len() / ROWS_TO_A_COLUMN).checked_sub(left.base.ncols())?;
    rivals.truncate(most);
    let mut all: Vec<What> = (0..left.joints.len()).map(What::Home).collect();
    let setups = few.samples.setups.as_ref();
    if base_model::is_arm(few) && setups.is_none_or(|setups| setups.names.len() < 2) {
        all.push(What::Frame);
    }
    let beside_these = |steps: &[Step]| {
        let own = steps
            .iter()
            .flat_map(|step| left.from(step.what, step.from));
        let columns: Vec<_> = rivals.iter().cloned().chain(own).collect();
        AtRows::beside(&left, &columns)
    };
    let mut steps: Vec<Step> = Vec::new();
    while steps.len() < MOST_STEPS {
        let beside = beside_these(&steps)?;
        let each = all.iter().map(|what| (*what, beside.best(*what)));
        let price = |what| f64::from(u8::from(what == What::Frame)) * thresholds::LIKELIER;
        let likeliest = |(what, (_, nats)): &(What, (usize, f64))| nats - price(*what);
        let best = each.max_by(|a, b| likeliest(a).total_cmp(&likeliest(b)));
        let (what, (from, nats)) = best?;
        if nats < thresholds::LIKELIER {
            break;
        }
        let by = 0.0;
        steps.push(Step { what, from, by });
    }
    while !steps.is_empty() {
        let evidence = |k: usize| {
            let mut others = steps.clone();
            let step = others.remove(k);
            beside_these(&others).map_or(f64::MIN, |beside| beside.evidence(few, step))
        };
        let each = (0..steps.len()).map(|k| (k, evidence(k)));
        let (weakest, evidence) = each.min_by(|a, b| a.1.total_cmp(&b.1))?;
        if evidence >= thresholds::LIKELIER {
            return Some(steps);
        }
        steps.remove(weakest);
    }
    None
}

/// What moved at which row, beside other columns.
struct AtRows<'a> {
    left: &'a Left,
    beside: Beside,
}

impl<'a> AtRows<'a> {
    fn beside(left: &'a Left, columns: &[DVector<f64>]) -> Option<Self> {
        let beside = Beside::of(left, columns)?;
        Some(Self { left, beside })
    }

    /// The logarithm by which a step of so many numbers is likelier than none, its row paid for.
    fn nats(&self, gain: f64, numbers: usize) -> f64 {
        self.beside.nats(gain, numbers) - (self.left.n as f64).ln()
    }

    /// That of each row, for the first so many numbers of what moves in the samples that do.
    fn of_rows(&self, motion: &Motion, count: usize, own: impl Fn(usize) -> bool) -> Vec<f64> {
        gains(self.left, &self.beside, motion, count, own)
    }

    /// That of a step, by row.
    fn by_row(&self, what: What) -> Vec<f64> {
        let numbers = what.numbers();
        let gains = self.of_rows(&self.left.motion(what), numbers, |_| true);
        gains
            .into_iter()
            .map(|gain| self.nats(gain, numbers))
            .collect()
    }

    /// The likeliest row of a step.
    fn best(&self, what: What) -> (usize, f64) {
        let all = self.by_row(what).into_iter().enumerate();
        let best = all.max_by(|a, b| a.1.total_cmp(&b.1));
        best.unwrap_or((0, f64::MIN))
    }

    /// The logarithm by which a step is likelier, of correlated noise so much less; the lowest there is for what is as
    /// likely some rows on or before, and where something else that moved about there is as likely.
    fn evidence(&self, few: &Session, step: Step) -> f64 {
        let Step { what, from, .. } = step;
        let (left, n) = (self.left, self.left.n);
        let all = self.by_row(what);
        let own = all[from];
        let aside = numeric::whole((BESIDE_SHARE * n as f64).max(3.0));
        let about = from.saturating_sub(aside)..(from + aside + 1).min(n);
        let there = [from.checked_sub(aside), Some(from + aside)];
        let there = there.into_iter().flatten().filter_map(|k| all.get(k));
        let is_sharp = there.into_iter().all(|nats| own >= nats + SHARP);
        let best = |nats: &[f64]| nats[about.clone()].iter().copied().fold(f64::MIN, f64::max);
        let gained =
            |motion: &Motion, count: usize, is_own: &dyn Fn(usize) -> bool, numbers: usize| {
                let gains = self.of_rows(motion, count, is_own);
                let nats: Vec<f64> = gains.into_iter().map(|g| self.nats(g, numbers)).collect();
                best(&nats)
            };
        let mut rivals = match what {
            // A slide's home is its frame along it: that has a name of its own, at the price of one number.
            What::Home(_) => {
                let moved = gained(&left.frame, 3, &|_| true, 1);
                best(&self.by_row(What::Frame)).max(moved) + LIKELIER
            }
            // A frame that moved and did not turn is an effect.
            What::Frame => {
                let moved = gained(&left.frame, 3, &|_| true, 3);
                let homes = (0..left.joints.len()).map(|j| best(&self.by_row(What::Home(j))));
                homes.fold(moved, f64::max) + thresholds::LIKELIER
            }
        };
        for target in 0..Group::Target.count(few) {
            let is_own = |i: usize| Group::Target.of(few, i) == Some(target);
            rivals = rivals.max(gained(&left.target, 3, &is_own, 3) + LIKELIER);
        }
        if !is_sharp || own <= rivals {
            return f64::MIN;
        }
        let columns = left.from(what, from);
        let columns: Vec<_> = columns
            .iter()
            .map(|own| self.beside.basis.reject(own))
            .collect();
        let along = Basis::new(&DMatrix::from_columns(&columns));
        own / dilution(left, &along.reject(&self.beside.free))
    }
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

/// Adds to each home's step what the corrected rows leave of it.
fn refine(left: &Left, steps: &mut [Step]) {
    let homes = steps.iter().filter(|step| step.what != What::Frame);
    let columns: Vec<DVector<f64>> = homes
        .flat_map(|step| left.from(step.what, step.from))
        .collect();
    let all = beside(&left.base, &columns);
    let solution = Basis::new(&all).solve(&left.residual);
    let homes = steps.iter_mut().filter(|step| step.what != What::Frame);
    for (k, (step, column)) in homes.zip(&columns).enumerate() {
        step.by += solution[left.base.ncols() + k] / column.norm().max(1e-12);
    }
}

/// Whether a home's step is likelier than none where every step is corrected.
fn still_likelier(left: &Left, all: &[Step], step: Step) -> bool {
    if step.what == What::Frame {
        return true;
    }
    let is_other = |other: &&Step| (other.what, other.from) != (step.what, step.from);
    let others = all.iter().filter(is_other);
    let others: Vec<_> = others
        .flat_map(|other| left.from(other.what, other.from))
        .collect();
    AtRows::beside(left, &others).is_some_and(|at_rows| {
        let own = &left.from(step.what, step.from)[0];
        let own = at_rows.beside.basis.reject(own);
        at_rows
            .beside
            .nats_without(step.by * step.by * own.norm_squared())
            - (left.n as f64).ln()
            >= thresholds::LIKELIER
    })
}
