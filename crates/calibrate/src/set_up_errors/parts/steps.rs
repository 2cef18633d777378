//! A home that moved while the robot was measured (an encoder that slips on its shaft, one that is homed anew), or a base
//! or an instrument that moved and turned (bolts that came loose, a tripod).
//!
//! The residuals of the fitted robot are regressed on the motion of each joint from a row on, together with every
//! column of the base model and what else may look like a step: what repeats over each joint, its side of approach, a
//! drift.
//! The gain of a step at row k, with the column's part along the base projected out,
//!
//! ```text
//! g(k) = v² / (cᵀc − |Qᵀc|²),   c = J_j on the rows from k on,   v = cᵀr
//! ```
//!
//! comes from sums over the rows from the last to the first, at a cost linear in the rows; a frame has six columns.
//! One step after another is added while it is likelier; then each has to be much likelier given all the others, sharp
//! in its row, and likelier than a target that moved or, for a home, a frame that did. The weakest of those that are
//! not is dropped, and the others are tested again.

use nalgebra::{DMatrix, DVector, SMatrix, SVector, Vector3};

use crate::answers::diagnosis::DataProblem;
use crate::effects::JointValues;
use crate::fit::base_model;
use crate::linear::Basis;
use crate::model::Model;
use crate::numeric;
use crate::sessions::{Group, Session};

use super::moved::{Step, What};
use crate::set_up_errors::fits::fitted;
use crate::set_up_errors::residuals::{MOST, Motion, Projected, Residuals, joined};
use crate::set_up_errors::rows::{Part, RowsInOrder};
use crate::set_up_errors::thresholds;
use crate::thresholds::BENDS;

/// Rows that are looked at.
const MOST_ROWS: usize = 240;
/// With fewer rows that count nothing is reported.
const FEWEST_ROWS: usize = 24;
/// Fewest rows on either side of a step.
const FEWEST_OUTSIDE: usize = 4;
/// Most steps of one session.
const MOST_STEPS: usize = 6;
/// Rows to a column, at least.
const ROWS_TO_A_COLUMN: usize = 2;
/// The logarithm by which a step is likelier at its row than so large a share of the rows before and behind.
const SHARP: f64 = 8.0;
const NEIGHBOUR_SHARE: f64 = 1.0 / 15.0;
/// The logarithm by which the home has to be likelier than a target or a frame that moved.
const LIKELIER: f64 = 3.0;
/// How often sizes are fitted again with what they corrected.
const ROUNDS: usize = 3;

/// Everything that moved: homes to which the rows before are turned, and frames of their own.
pub(in crate::set_up_errors) fn steps(session: &Session, values: JointValues) -> Vec<DataProblem> {
    if !session.has_plain_points() {
        return Vec::new();
    }
    let rows = RowsInOrder::of(session, MOST_ROWS).of_new_places(session);
    let rows = rows.of_moving_points(session, values);
    if rows.len() < FEWEST_ROWS {
        return Vec::new();
    }
    sized(&rows.select(session), values).map_or_else(Vec::new, |(steps, residual_mm)| {
        let problem = |step: &Step| {
            let before = rows.ranges(session, Part::Stretch(0, step.from));
            step.problem(session, &rows, before, residual_mm)
        };
        steps.iter().map(problem).collect()
    })
}

/// The steps in the order in which they are corrected, and the residual of the base model before and after, mm.
fn sized(few: &Session, values: JointValues) -> Option<(Vec<Step>, [f64; 2])> {
    let (model, before_mm) = fitted(few, values)?;
    let mut steps = found(few, values, &model)?;
    // A frame is that of all rows before its step until an earlier one takes some: the last is made first.
    steps.sort_by_key(|step| match step.what {
        What::Frame => (0, few.samples.len() - step.from),
        What::Home(_) => (1, step.from),
    });
    let mut residual_mm = before_mm;
    for round in 0..ROUNDS {
        let mut corrected = few.clone();
        for step in &steps {
            step.correction(vec![(0, step.from)]).apply(&mut corrected);
        }
        let (model, after_mm) = fitted(&corrected, values)?;
        residual_mm = after_mm;
        let residuals = Residuals::of(&corrected, values, &model)?;
        refine(&residuals, &mut steps);
        // Before large steps are corrected, their curvature looks like small ones.
        if round > 0 {
            let all = steps.clone();
            steps.retain(|step| still_likelier(&residuals, &all, *step));
        }
    }
    (residual_mm < before_mm).then_some((steps, [before_mm, residual_mm]))
}

impl Residuals {
    /// The columns of what moves, and of a step of it.
    fn columns_of(&self, what: What) -> Vec<DVector<f64>> {
        match what {
            What::Home(joint) => vec![self.joints[joint].clone()],
            What::Frame => self.moved(&self.frame, MOST),
        }
    }

    fn from(&self, what: What, first: usize) -> Vec<DVector<f64>> {
        let is_after = |i: usize| f64::from(u8::from(i >= first));
        let columns = self.columns_of(what).into_iter();
        columns.map(|own| self.times(&own, is_after)).collect()
    }

    /// What else may look like a step: what repeats over each joint, its side of approach, a drift of its home and of the
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
        all.extend(self.waves(few, &[1.0, 2.0]));
        for own in &self.joints {
            all.push(self.times(own, |i| time(i) * time(i)));
        }
        all.extend(self.repeating(few));
        all
    }

    /// What repeats over a joint's value, its scale first: along a sweep a step in time is one over the value.
    fn repeating(&self, few: &Session) -> Vec<DVector<f64>> {
        let over_range = |joint: usize, wave: &dyn Fn(f64) -> f64| {
            let q = &few.samples.q[joint];
            let [low, high] = numeric::extent(q);
            let width = (high - low).max(1e-9);
            self.times(&self.joints[joint], |i| wave((q[i] - low) / width))
        };
        let joints = || 0..self.joints.len();
        let scales = joints().map(|joint| over_range(joint, &|at| at));
        let waves = (1..=BENDS).flat_map(|halves| {
            let wave = move |at: f64| (halves as f64 * std::f64::consts::PI * at).cos();
            joints().map(move |joint| over_range(joint, &wave))
        });
        scales.chain(waves).collect()
    }
}

/// The gain in square of columns from a row on, for each row.
fn gains(
    residuals: &Residuals,
    Projected { basis, free, .. }: &Projected,
    columns: &[DVector<f64>],
) -> Vec<f64> {
    let (n, count) = (residuals.n, columns.len());
    let mut gram = SMatrix::<f64, MOST, MOST>::zeros();
    let mut pull = SVector::<f64, MOST>::zeros();
    let mut along = DMatrix::<f64>::zeros(basis.rank(), count);
    let mut gains = vec![0.0; n];
    for i in (0..n).rev() {
        for row in (0..residuals.axes.len()).map(|a| a * n + i) {
            let by = |k: usize| columns.get(k).map_or(0.0, |column| column[row]);
            let by = SVector::<f64, MOST>::from_fn(|k, _| by(k));
            gram += by * by.transpose();
            pull += by * free[row];
            let q = basis.q.row(row);
            for k in 0..count {
                for (to, q) in along.column_mut(k).iter_mut().zip(q.iter()) {
                    *to += by[k] * q;
                }
            }
        }
        if i < FEWEST_OUTSIDE || i + FEWEST_OUTSIDE > n || !residuals.may_move_at[i] {
            continue;
        }
        let mut projected = gram;
        for k in 0..count {
            for j in 0..count {
                projected[(k, j)] -= along.column(k).dot(&along.column(j));
            }
        }
        // A linear dependency on the base shows nothing.
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
    let residuals = Residuals::of(few, values, model)?;
    let mut all: Vec<What> = (0..residuals.joints.len()).map(What::Home).collect();
    let setups = few.samples.setups.as_ref();
    if base_model::is_arm(few) && setups.is_none_or(|setups| setups.names.len() < 2) {
        all.push(What::Frame);
    }
    let mut steps: Vec<Step> = Vec::new();
    while steps.len() < MOST_STEPS {
        let given = residuals.given_steps(few, &steps)?;
        let each = all.iter().map(|what| (*what, given.best(*what)));
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
    residuals.keep_likely(few, &mut steps);
    // Repeatability is estimated given what moved, which looks like it.
    let columns: Vec<_> = steps
        .iter()
        .flat_map(|step| residuals.from(step.what, step.from))
        .collect();
    let residuals = residuals.with_pose_noise(few, values, model, &columns);
    residuals.keep_likely(few, &mut steps);
    (!steps.is_empty()).then_some(steps)
}

impl Residuals {
    /// Given what may look like steps, and these.
    fn given_steps(&self, few: &Session, steps: &[Step]) -> Option<AtRows<'_>> {
        let mut columns = self.rivals(few);
        // What matters most comes first.
        let most = (self.residual.len() / ROWS_TO_A_COLUMN).checked_sub(self.base.ncols())?;
        columns.truncate(most);
        columns.extend(
            steps
                .iter()
                .flat_map(|step| self.from(step.what, step.from)),
        );
        AtRows::given(self, &columns)
    }

    /// Drops the weakest step until each is much likelier given the others.
    fn keep_likely(&self, few: &Session, steps: &mut Vec<Step>) {
        loop {
            let evidence = |k: usize| {
                let mut others = steps.clone();
                let step = others.remove(k);
                self.given_steps(few, &others)
                    .map_or(f64::MIN, |given| given.evidence(few, step))
            };
            let each = (0..steps.len()).map(|k| (k, evidence(k)));
            match each.min_by(|a, b| a.1.total_cmp(&b.1)) {
                Some((weakest, evidence)) if evidence < thresholds::LIKELIER => {
                    steps.remove(weakest)
                }
                _ => return,
            };
        }
    }
}

/// The gains of steps at each row, given other columns.
struct AtRows<'a> {
    residuals: &'a Residuals,
    projected: Projected<'a>,
}

impl<'a> AtRows<'a> {
    fn given(residuals: &'a Residuals, columns: &[DVector<f64>]) -> Option<Self> {
        let projected = Projected::of(residuals, columns)?;
        Some(Self {
            residuals,
            projected,
        })
    }

    /// The logarithm by which a step of so many parameters is likelier than none, less the penalty of its row.
    fn nats(&self, gain: f64, numbers: usize) -> f64 {
        self.projected.nats(gain, numbers) - (self.residuals.n as f64).ln()
    }

    /// That of columns from each row on, at the price of so many numbers.
    fn of_rows(&self, columns: &[DVector<f64>], numbers: usize) -> Vec<f64> {
        let gains = gains(self.residuals, &self.projected, columns).into_iter();
        gains.map(|gain| self.nats(gain, numbers)).collect()
    }

    /// That of a step, by row.
    fn by_row(&self, what: What) -> Vec<f64> {
        self.of_rows(&self.residuals.columns_of(what), what.numbers())
    }

    /// The likeliest row of a step.
    fn best(&self, what: What) -> (usize, f64) {
        let all = self.by_row(what).into_iter().enumerate();
        let best = all.max_by(|a, b| a.1.total_cmp(&b.1));
        best.unwrap_or((0, f64::MIN))
    }

    /// The logarithm by which a step is likelier, reduced for correlated noise; the minimum for what is as likely some
    /// rows on or before, and where something else that moved about there is as likely.
    fn evidence(&self, few: &Session, step: Step) -> f64 {
        let Step { what, from, .. } = step;
        let (residuals, n) = (self.residuals, self.residuals.n);
        let all = self.by_row(what);
        let own = all[from];
        let aside = numeric::whole((NEIGHBOUR_SHARE * n as f64).max(3.0));
        let about = from.saturating_sub(aside)..(from + aside + 1).min(n);
        let there = [from.checked_sub(aside), Some(from + aside)];
        let begin = |k: &usize| (0..=*k).rev().find(|i| residuals.may_move_at[*i]);
        let mut there = there.iter().flatten().filter(|k| **k < n).filter_map(begin);
        let is_sharp = there.all(|k| own >= all[k] + SHARP);
        let best = |nats: &[f64]| nats[about.clone()].iter().copied().fold(f64::MIN, f64::max);
        let gained = |motion: &Motion, numbers: usize| {
            best(&self.of_rows(&residuals.moved(motion, 3), numbers))
        };
        let mut rivals = match what {
            // The home of a prismatic joint is equivalent to its frame along it, with a penalty of one parameter.
            What::Home(_) => {
                best(&self.by_row(What::Frame)).max(gained(&residuals.frame, 1)) + LIKELIER
            }
            // A frame that moved and did not turn is an effect.
            What::Frame => {
                let homes = (0..residuals.joints.len()).map(|j| best(&self.by_row(What::Home(j))));
                homes.fold(gained(&residuals.frame, 3), f64::max) + thresholds::LIKELIER
            }
        };
        for target in 0..Group::Target.count(few) {
            let of_sample = |(i, motion): (usize, &[Vector3<f64>; MOST])| {
                let is_own = Group::Target.of(few, i) == Some(target);
                motion.map(|by| by * f64::from(u8::from(is_own)))
            };
            let own: Motion = residuals.target.iter().enumerate().map(of_sample).collect();
            rivals = rivals.max(gained(&own, 3) + LIKELIER);
        }
        if !is_sharp || own <= rivals {
            return f64::MIN;
        }
        let along = self.projected.own(&residuals.from(what, from));
        own / self.projected.dilution(&along)
    }
}

/// Adds to each home's step its part of the residuals of the corrected rows.
fn refine(residuals: &Residuals, steps: &mut [Step]) {
    let homes = steps.iter().filter(|step| step.what != What::Frame);
    let columns: Vec<DVector<f64>> = homes
        .flat_map(|step| residuals.from(step.what, step.from))
        .collect();
    let all = joined(&residuals.base, &columns);
    let solution = Basis::new(&all).solve(&residuals.residual);
    let homes = steps.iter_mut().filter(|step| step.what != What::Frame);
    for (k, (step, column)) in homes.zip(&columns).enumerate() {
        step.by += solution[residuals.base.ncols() + k] / column.norm().max(1e-12);
    }
}

/// Whether a home's step is likelier than none where every step is corrected.
fn still_likelier(residuals: &Residuals, all: &[Step], step: Step) -> bool {
    if step.what == What::Frame {
        return true;
    }
    let is_other = |other: &&Step| (other.what, other.from) != (step.what, step.from);
    let others = all.iter().filter(is_other);
    let others: Vec<_> = others
        .flat_map(|other| residuals.from(other.what, other.from))
        .collect();
    AtRows::given(residuals, &others).is_some_and(|at_rows| {
        let own = &residuals.from(step.what, step.from)[0];
        let own = at_rows.projected.basis.reject(own);
        at_rows
            .projected
            .nats_without(step.by * step.by * own.norm_squared())
            - (residuals.n as f64).ln()
            >= thresholds::LIKELIER
    })
}
