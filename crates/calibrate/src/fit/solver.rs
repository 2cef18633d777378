//! Gauss–Newton with Levenberg–Marquardt damping on the analytic Jacobian.
//!
//! ```text
//! (D⁻¹ G D⁻¹ + λ 1) D δ = D⁻¹ g,   D = diag(√G_kk)
//! ```
//!
//! (Levenberg 1944, Marquardt 1963; scaling as in Moré 1978). The damped step is solved in the eigenbasis of the
//! scaled Gram matrix, whose small eigenvalues show what is not determined: along them the step is zero, so a
//! deficient problem still gets the smallest solution that fits.
//!
//! A long session is solved on evenly spaced blocks first. One pass over all samples from there
//! is as good as many from afar, and a last pass with the same Gram matrix polishes it.

use nalgebra::{DMatrix, DVector};

use crate::effects::Role;
use crate::effects::block::Block;
use crate::lanes::LANES;
use crate::model::Model;
use crate::numeric::LONGEST_TURN;
use crate::text::Template;
use crate::{budget, rounding};

use super::normal::{Normal, Sums, Whitening};
use super::problem::Problem;
use super::spectrum::{Spectrum, StepSolver};
use super::unrepeated::Unrepeated;

/// Why the solver stopped.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stopped {
    /// A further step would move the samples by less than anything that could matter.
    Converged,
    /// There was nothing to solve for.
    NothingToDo,
    /// The steps did not become small in the allowed number.
    TooManySteps,
    /// No step, however short, made the fit better.
    NoDescent,
    /// Cancelled.
    Cancelled,
}

impl Stopped {
    /// In words.
    pub fn describe(self) -> Template {
        match self {
            Self::Converged => phrase!("converged"),
            Self::NothingToDo => phrase!("there was nothing to solve for"),
            Self::TooManySteps => {
                phrase!("stopped after the largest number of steps: the result may be rough")
            }
            Self::Cancelled => phrase!("cancelled"),
            Self::NoDescent => {
                phrase!("stopped where no step made the fit better: the result may be rough")
            }
        }
    }
}

/// The answer of the solver.
#[derive(Debug, Clone)]
pub struct Solution {
    /// The model with the coefficients found.
    pub model: Model,
    /// Coefficients of the extra columns.
    pub extra_coefficients: Vec<f64>,
    /// The Gram matrix there, taken apart.
    pub spectrum: Spectrum,
    /// `rᵀ W r` there.
    pub cost: f64,
    /// Why it stopped.
    pub stopped: Stopped,
    /// Passes over all or some of the samples.
    pub passes: usize,
}

impl Solution {
    /// The same solution where every weight is so many times as large.
    pub(super) fn rescale(&mut self, factor: f64) {
        self.cost *= factor;
        self.spectrum.rescale(factor);
    }
}

/// A session of more blocks than this is solved on as many first.
pub(super) const COARSE_BLOCKS: usize = 192;

/// Fits the coefficients of `start` to the samples of the problem that count.
pub fn solve(problem: &Problem, start: &Model) -> Solution {
    let start = &State {
        model: start.clone(),
        extra_coefficients: vec![0.0; problem.extra_columns.len()],
    };
    let blocks: Vec<usize> = (0..problem.inputs.len()).step_by(LANES).collect();
    let few = blocks.len() <= 2 * COARSE_BLOCKS || problem.observed.is_some();
    if few || start.count() == 0 {
        return descend(problem, start, &blocks).0;
    }
    let spaced = |k: usize| blocks[k * blocks.len() / COARSE_BLOCKS];
    let coarse: Vec<usize> = (0..COARSE_BLOCKS).map(spaced).collect();
    let (near, from) = descend(problem, start, &coarse);
    if near.stopped == Stopped::Cancelled {
        return near;
    }
    polish(problem, &from, &blocks, near.passes)
}

/// Levenberg–Marquardt from far away.
fn descend(problem: &Problem, start: &State, blocks: &[usize]) -> (Solution, State) {
    let mut model = start.clone();
    let mut normal = sum(problem, &model, blocks, Sums::All);
    let mut steps = steps_at(problem, &normal, &model);
    let mut damping = 0.0;
    let mut passes = 1;
    let stopped = loop {
        if model.count() == 0 {
            break Stopped::NothingToDo;
        }
        if passes > budget::STEPS {
            break Stopped::TooManySteps;
        }
        if !problem.watch.goes_on() {
            break Stopped::Cancelled;
        }
        let step = steps.step(&normal.gradient, damping);
        let step = bounded(&model.model, step);
        let trial = moved(&model, &step);
        if negligible(&step, &normal) {
            model = trial;
            break Stopped::Converged;
        }
        let next = sum(problem, &trial, blocks, Sums::All);
        passes += 1;
        if next.cost.is_finite() && next.cost <= normal.cost * (1.0 + 1e-12) {
            model = trial;
            normal = next;
            steps = steps_at(problem, &normal, &model);
            damping = if damping > rounding::COMPUTED {
                damping / 10.0
            } else {
                0.0
            };
        } else {
            damping = if damping > 0.0 { damping * 10.0 } else { 1e-6 };
            if damping * rounding::LAST_BITS > 1.0 {
                break Stopped::NoDescent;
            }
        }
    };
    let solution = Solution {
        model: model.model.clone(),
        extra_coefficients: model.extra_coefficients.clone(),
        spectrum: steps.into_spectrum(|| spectrum_of(problem, &normal, &model)),
        cost: normal.cost,
        stopped,
        passes,
    };
    (solution, model)
}

/// The state of the solver.
#[derive(Debug, Clone)]
struct State {
    model: Model,
    /// Coefficients of the extra columns.
    extra_coefficients: Vec<f64>,
}

impl State {
    fn count(&self) -> usize {
        self.model.coefficient_count() + self.extra_coefficients.len()
    }
}

/// Two passes over all samples from a model that is nearly right.
fn polish(problem: &Problem, near: &State, blocks: &[usize], passes: usize) -> Solution {
    let normal = sum(problem, near, blocks, Sums::All);
    let spectrum = spectrum_of(problem, &normal, near);
    let step = spectrum.step(&normal.gradient, 0.0);
    let model = moved(near, &step);
    let last = sum(problem, &model, blocks, Sums::Gradient);
    if last.cost > normal.cost * (1.0 + rounding::COMPUTED) {
        // The blocks that were left out contain something that the coarse fit does not.
        return descend(problem, near, blocks).0;
    }
    let correction = spectrum.step(&last.gradient, 0.0);
    let settled = displacement(&correction, &normal) <= 1e-3 * rms(&last);
    if !settled {
        return descend(problem, &model, blocks).0;
    }
    let model = moved(&model, &correction);
    Solution {
        model: model.model,
        extra_coefficients: model.extra_coefficients,
        spectrum,
        cost: last.cost - correction.dot(&last.gradient),
        stopped: Stopped::Converged,
        passes: passes + 2,
    }
}

fn sum(problem: &Problem, state: &State, blocks: &[usize], sums: Sums) -> Normal {
    let columns = state.count();
    let mut normal = Normal::new(columns);
    if let Some(layer) = &problem.observed {
        layer.visit(&state.model, true, |rows| {
            rows.keep(&layer.used);
            normal.add_rows(rows, sums);
        });
        normal.complete();
        problem.priors.add(&state.model, &mut normal);
        return normal;
    }
    let mut unrepeated = Unrepeated::new(problem, columns);
    let mut whitening = Whitening::new(problem.noise.as_ref(), columns);
    let starts = blocks.iter().copied();
    state
        .model
        .visit_blocks(&problem.inputs, true, starts, |start, block| {
            let mut joined: Block;
            let block = if problem.extra_columns.is_empty() {
                block
            } else {
                joined = block.clone();
                join(&mut joined, problem, state, start);
                &joined
            };
            if let Some(unrepeated) = &mut unrepeated {
                normal.add_with_joint_noise(problem, start, block, sums, unrepeated);
            } else if let Some(whitening) = &mut whitening {
                normal.add_whitened(problem, start, block, sums, whitening);
            } else {
                normal.add(problem, start, block, sums);
            }
        });
    normal.complete();
    problem.priors.add(&state.model, &mut normal);
    normal
}

/// The least rise of the cost by which samples determine a coefficient: that of a move by two standard deviations, 2².
/// What rises by less over the whole plausible range is not determined.
const LEAST_RISE: f64 = 4.0;

/// The spectrum of a problem with another noise at a solution, the cost there, and the step to the
/// solution under that noise.
pub(super) fn spectrum_at(problem: &Problem, solution: &Solution) -> (Spectrum, f64, DVector<f64>) {
    let state = state_at(solution);
    let normal = equations_at(problem, solution);
    let spectrum = spectrum_of(problem, &normal, &state);
    let step = spectrum.step(&normal.gradient, 0.0);
    (spectrum, normal.cost, step)
}

/// The same coefficients as a solution of another problem; extra columns that only one of them has are zero.
pub(crate) fn solution_at(problem: &Problem, solution: &Solution) -> Solution {
    let mut there = solution.clone();
    let extra = problem.extra_columns.len();
    there.extra_coefficients.resize(extra, 0.0);
    let (spectrum, cost, _) = spectrum_at(problem, &there);
    Solution {
        spectrum,
        cost,
        ..there
    }
}

/// The covariance of a model's coefficients where it fits a problem: zero of what no sample determines.
pub(crate) fn covariance_at(problem: &Problem, model: &Model) -> DMatrix<f64> {
    let state = State {
        model: model.clone(),
        extra_coefficients: Vec::new(),
    };
    let blocks: Vec<usize> = (0..problem.inputs.len()).step_by(LANES).collect();
    let normal = sum(problem, &state, &blocks, Sums::All);
    spectrum_of(problem, &normal, &state).inverse()
}

/// The equations of a problem at a solution, with those of its priors.
pub(super) fn equations_at(problem: &Problem, solution: &Solution) -> Normal {
    let blocks: Vec<usize> = (0..problem.inputs.len()).step_by(LANES).collect();
    sum(problem, &state_at(solution), &blocks, Sums::All)
}

fn state_at(solution: &Solution) -> State {
    State {
        model: solution.model.clone(),
        extra_coefficients: solution.extra_coefficients.clone(),
    }
}

fn spectrum_of(problem: &Problem, normal: &Normal, state: &State) -> Spectrum {
    let (reaches, least) = limits_of_determinacy(problem, normal, state);
    Spectrum::of_model(&normal.gram, &state.model).within(&reaches, least)
}

/// The factorisation for the steps from a state.
fn steps_at(problem: &Problem, normal: &Normal, state: &State) -> StepSolver {
    let (reaches, least) = limits_of_determinacy(problem, normal, state);
    StepSolver::of(&normal.gram, &state.model, &reaches, least)
}

/// The plausible range of each coefficient, and by how much the cost has to rise there.
fn limits_of_determinacy(problem: &Problem, normal: &Normal, state: &State) -> (Vec<f64>, f64) {
    let shapes = std::iter::repeat_n(f64::INFINITY, state.extra_coefficients.len());
    let reaches: Vec<f64> = state
        .model
        .terms()
        .iter()
        .flat_map(|term| term.effect.about().form.max_magnitudes())
        .chain(shapes)
        .collect();
    let least = if problem.noise.is_some() {
        LEAST_RISE
    } else {
        normal.weight * rounding::WRITTEN * rounding::WRITTEN
    };
    (reaches, least)
}

/// Appends the extra columns to those of the model, and adds their part to the points.
fn join(block: &mut Block, problem: &Problem, state: &State, start: usize) {
    for (column, coefficient) in problem.extra_columns.iter().zip(&state.extra_coefficients) {
        let mut own = [[0.0; LANES]; 3];
        for (axis, values) in column.iter().enumerate() {
            own[axis][..block.len].copy_from_slice(&values[start..start + block.len]);
            for (point, own) in block.point[axis].iter_mut().zip(own[axis]) {
                *point += coefficient * own;
            }
        }
        block.columns.push(own);
    }
}

/// The step of a robot with several joints, shortened to the range in which the geometry is nearly linear. One joint
/// alone needs no such bound.
fn bounded(model: &Model, step: DVector<f64>) -> DVector<f64> {
    if model.robot.joints.len() < 2 {
        return step;
    }
    let mut first = 0;
    let mut factor = 1.0_f64;
    for term in model.terms() {
        let (about, own) = (term.effect.about(), first);
        first += term.coefficients.len();
        if !about.role.is_of_every_calibration() {
            continue;
        }
        for k in 0..term.coefficients.len() {
            let turns = about.form.turns(k, model.robot.joints[term.joint].kind);
            if about.role == Role::Place && !turns {
                // A place may be as far off as it likes; only a turn is not linear.
                continue;
            }
            let most = if turns { LONGEST_TURN } else { LONGEST_MOVE_MM };
            let size = step[own + k].abs();
            if size > most {
                factor = factor.min(most / size);
            }
        }
    }
    step * factor
}

/// As far as geometry may go in one step, rad and mm.
/// Derived: there the second-order part of a step reaches 5 % of it.
const LONGEST_MOVE_MM: f64 = 200.0;

fn moved(state: &State, step: &DVector<f64>) -> State {
    let (own, rest) = step.as_slice().split_at(state.model.coefficient_count());
    State {
        model: state.model.stepped(own),
        extra_coefficients: state
            .extra_coefficients
            .iter()
            .zip(rest)
            .map(|(c, s)| c + s)
            .collect(),
    }
}

/// How far a step moves the samples, root mean square, in the units of the weighted residual.
fn displacement(step: &DVector<f64>, normal: &Normal) -> f64 {
    let square = step.dot(&(&normal.gram * step)).max(0.0);
    (square / normal.weight.max(f64::MIN_POSITIVE)).sqrt()
}

fn rms(normal: &Normal) -> f64 {
    (normal.cost / normal.weight.max(f64::MIN_POSITIVE)).sqrt()
}

/// Convergence is quadratic where the residuals vanish and fast where they are small, so a step that moves the samples
/// by a millionth of the residual is the last. Where the residual is zero the limit is rounding.
fn negligible(step: &DVector<f64>, normal: &Normal) -> bool {
    displacement(step, normal) <= (rounding::WRITTEN * rms(normal)).max(rounding::LAST_BITS)
}
