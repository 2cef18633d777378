//! Gauss–Newton with Levenberg–Marquardt damping on the analytic Jacobian.
//!
//! ```text
//! (D⁻¹ G D⁻¹ + λ 1) D δ = D⁻¹ g,   D = diag(√G_kk)
//! ```
//!
//! (Levenberg 1944, Marquardt 1963; scaling as in Moré 1978). The damped step is solved in the
//! eigenbasis of the scaled Gram matrix, whose small eigenvalues tell what cannot be determined:
//! along them the step is zero, so a deficient problem still gets the smallest answer that fits.
//!
//! A long session is solved on evenly spaced blocks first. One pass over all samples from there
//! is as good as many from afar, and a last pass with the same Gram matrix polishes it.

use std::borrow::Cow;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use crate::effects::Role;
use crate::effects::block::Block;
use crate::lanes::LANES;
use crate::linear::{cholesky, inverse_of_lower};
use crate::model::Model;
use crate::text::Template;

use super::normal::{Normal, Sums, Whitening};
use super::problem::Problem;

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

/// A direction in the space of coefficients along which the samples say nothing.
#[derive(Debug, Clone, PartialEq)]
pub struct NullDirection {
    /// One component for each coefficient, inner units, of arbitrary size.
    pub components: DVector<f64>,
}

/// The scaled Gram matrix taken apart.
#[derive(Debug, Clone)]
pub struct Spectrum {
    scale: DVector<f64>,
    values: DVector<f64>,
    vectors: DMatrix<f64>,
    /// Which eigenvectors the samples determine.
    determined: Vec<bool>,
    /// Number of coefficients that are held where they are.
    held: usize,
}

/// Eigenvalues of the scaled Gram matrix below this are rounding: its entries are sums of products
/// with a relative error of some 1e-14, and its diagonal is 1.
const RANK_TOLERANCE: f64 = 1e-11;

impl Spectrum {
    /// Takes a Gram matrix apart.
    pub fn new(gram: &DMatrix<f64>) -> Self {
        let (scale, scaled) = scaled(gram);
        if gram.is_empty() {
            // Nothing to take apart; the decomposition takes no empty matrix.
            return Self {
                held: 0,
                scale,
                values: DVector::zeros(0),
                vectors: DMatrix::zeros(0, 0),
                determined: Vec::new(),
            };
        }
        let eigen = crate::decompose::eigen(scaled);
        let values = eigen.eigenvalues;
        Self {
            scale,
            determined: values.iter().map(|v| *v > RANK_TOLERANCE).collect(),
            values,
            vectors: eigen.eigenvectors,
            held: 0,
        }
    }

    /// The same, where a direction counts as determined only if going along it as far as makes any
    /// sense (`reaches`, one for each coefficient) would raise the cost by at least `least`. A
    /// column of rounding is no column, and what the samples leave open over its whole range runs
    /// nowhere.
    #[must_use]
    pub fn within(mut self, reaches: &[f64], least: f64) -> Self {
        for k in 0..self.values.len() {
            let along = (0..reaches.len()).map(|i| {
                let moved = self.vectors[(i, k)].abs() * self.unscale(i);
                if moved > 0.0 {
                    reaches[i] / moved
                } else {
                    f64::INFINITY
                }
            });
            let furthest = along.fold(f64::INFINITY, f64::min);
            let open = furthest.is_finite() && self.values[k] * furthest * furthest < least;
            self.determined[k] &= !open;
        }
        self
    }

    fn unscale(&self, k: usize) -> f64 {
        if self.scale[k] > 0.0 {
            1.0 / self.scale[k]
        } else {
            0.0
        }
    }

    /// Takes the Gram matrix of a model's coefficients apart, apart from those that it holds.
    fn of_model(gram: &DMatrix<f64>, model: &Model) -> Self {
        let (apart, held) = without_held(gram, model);
        let mut spectrum = Self::new(&apart);
        for k in &held {
            spectrum.scale[*k] = 0.0;
        }
        spectrum.held = held.len();
        spectrum
    }

    fn determined(&self, index: usize) -> bool {
        self.determined[index]
    }

    /// Number of independent combinations of coefficients that the samples determine.
    pub fn rank(&self) -> usize {
        let determined = (0..self.values.len()).filter(|k| self.determined(*k));
        // Beside columns that are not finite even what is held is not determined.
        determined.count().saturating_sub(self.held)
    }

    /// Ratio of the largest to the smallest determined eigenvalue of the scaled Gram matrix; its
    /// root is the condition number of the scaled Jacobian.
    pub fn condition(&self) -> f64 {
        let determined = (0..self.values.len()).filter(|k| self.determined(*k));
        let (low, high) = determined.fold((f64::INFINITY, 0.0_f64), |(low, high), k| {
            (low.min(self.values[k]), high.max(self.values[k]))
        });
        if high > 0.0 { (high / low).sqrt() } else { 1.0 }
    }

    /// The damped step for a gradient.
    pub fn step(&self, gradient: &DVector<f64>, damping: f64) -> DVector<f64> {
        let unscale = |k: usize| self.unscale(k);
        let scaled = DVector::from_fn(gradient.len(), |k, _| gradient[k] * unscale(k));
        let mut along = self.vectors.tr_mul(&scaled);
        for k in 0..along.len() {
            along[k] = if self.determined(k) {
                along[k] / (self.values[k] + damping)
            } else {
                0.0
            };
        }
        let step = &self.vectors * along;
        DVector::from_fn(step.len(), |k, _| step[k] * unscale(k))
    }

    /// Inverse of the Gram matrix on the determined directions.
    pub fn inverse(&self) -> DMatrix<f64> {
        let p = self.values.len();
        let unscale = |k: usize| self.unscale(k);
        DMatrix::from_fn(p, p, |i, j| {
            let along = (0..p).filter(|k| self.determined(*k));
            let sum: f64 = along
                .map(|k| self.vectors[(i, k)] * self.vectors[(j, k)] / self.values[k])
                .sum();
            sum * unscale(i) * unscale(j)
        })
    }

    /// The directions that the samples do not determine.
    pub fn null_directions(&self) -> Vec<NullDirection> {
        let p = self.values.len();
        let undetermined = (0..p).filter(|k| !self.determined(*k));
        let directions = undetermined.map(|k| {
            let components = DVector::from_fn(p, |i, _| {
                let seen = self.scale[i] > 0.0;
                self.vectors[(i, k)] / if seen { self.scale[i] } else { 1.0 }
            });
            NullDirection { components }
        });
        directions.collect()
    }

    /// How far one coefficient of a direction moves the samples, relative to the others.
    pub fn scaled_component(&self, components: &DVector<f64>, coefficient: usize) -> f64 {
        let scale = self.scale[coefficient];
        components[coefficient].abs() * if scale > 0.0 { scale } else { 1.0 }
    }

    /// How much of a coefficient lies in undetermined directions, from 0 to 1.
    pub fn undetermined_share(&self, coefficient: usize) -> f64 {
        let undetermined = (0..self.values.len()).filter(|k| !self.determined(*k));
        undetermined
            .map(|k| self.vectors[(coefficient, k)].powi(2))
            .sum()
    }
}

/// The roots of a Gram matrix's diagonal, and the matrix in units of them.
fn scaled(gram: &DMatrix<f64>) -> (DVector<f64>, DMatrix<f64>) {
    let root = |d: f64| if d > 0.0 { d.sqrt() } else { 0.0 };
    let scale = gram.diagonal().map(root);
    let inverse = scale.map(|s| if s > 0.0 { 1.0 / s } else { 0.0 });
    let scaled = DMatrix::from_fn(gram.nrows(), gram.ncols(), |i, j| {
        gram[(i, j)] * inverse[i] * inverse[j]
    });
    (scale, scaled)
}

/// A Gram matrix in which each coefficient that a model holds is a direction of its own, which takes no step as its
/// gradient is zero; and which these are.
fn without_held<'g>(gram: &'g DMatrix<f64>, model: &Model) -> (Cow<'g, DMatrix<f64>>, Vec<usize>) {
    let columns = model.columns().enumerate();
    let held: Vec<usize> = columns
        .filter(|(_, (term, k))| term.held.contains(*k))
        .map(|(column, _)| column)
        .collect();
    let mut apart = Cow::Borrowed(gram);
    for k in &held {
        apart.to_mut()[(*k, *k)] = 1.0;
    }
    (apart, held)
}

/// The answer of the solver.
#[derive(Debug, Clone)]
pub struct Solution {
    /// The model with the coefficients found.
    pub model: Model,
    /// Coefficients of the columns beside the model.
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
        self.spectrum.scale *= factor.sqrt();
    }
}

const MOST_STEPS: usize = 60;
/// A session of more blocks than this is solved on as many first.
const COARSE_BLOCKS: usize = 192;

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
    let mut directions = Directions::of(problem, &normal, &model);
    let mut damping = 0.0;
    let mut passes = 1;
    let stopped = loop {
        if model.count() == 0 {
            break Stopped::NothingToDo;
        }
        if passes > MOST_STEPS {
            break Stopped::TooManySteps;
        }
        if !problem.watch.goes_on() {
            break Stopped::Cancelled;
        }
        let step = directions.step(&normal.gradient, damping);
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
            directions = Directions::of(problem, &normal, &model);
            damping = if damping > 1e-9 { damping / 10.0 } else { 0.0 };
        } else {
            damping = if damping > 0.0 { damping * 10.0 } else { 1e-6 };
            if damping > 1e12 {
                break Stopped::NoDescent;
            }
        }
    };
    let solution = Solution {
        model: model.model.clone(),
        extra_coefficients: model.extra_coefficients.clone(),
        spectrum: directions.taken_apart(problem, &normal),
        cost: normal.cost,
        stopped,
        passes,
    };
    (solution, model)
}

/// What a step is taken with: the eigenvectors, or of many coefficients, all determined beyond doubt, a factor that is
/// found many times faster.
enum Directions {
    Apart(Spectrum),
    Factored(Factored),
}

/// Scales of the coefficients and the scaled Gram matrix with its factor.
struct Factored {
    inverse_scale: DVector<f64>,
    scaled: DMatrix<f64>,
    factor: Cholesky<f64, Dyn>,
    /// Where this is.
    state: State,
}

/// Of fewer coefficients the eigenvectors take no time.
const MANY_COEFFICIENTS: usize = 128;

impl Directions {
    fn of(problem: &Problem, normal: &Normal, state: &State) -> Self {
        let factored = (state.count() >= MANY_COEFFICIENTS)
            .then(|| Factored::of(problem, normal, state))
            .flatten();
        factored.map_or_else(
            || Self::Apart(spectrum_of(problem, normal, state)),
            Self::Factored,
        )
    }

    fn step(&self, gradient: &DVector<f64>, damping: f64) -> DVector<f64> {
        match self {
            Self::Apart(spectrum) => spectrum.step(gradient, damping),
            Self::Factored(factored) => factored.step(gradient, damping),
        }
    }

    /// The spectrum of the sums that these directions are of.
    fn taken_apart(self, problem: &Problem, normal: &Normal) -> Spectrum {
        match self {
            Self::Apart(spectrum) => spectrum,
            Self::Factored(factored) => spectrum_of(problem, normal, &factored.state),
        }
    }
}

impl Factored {
    /// `None` where a direction may be undetermined, as [`Spectrum::within`] has it.
    fn of(problem: &Problem, normal: &Normal, state: &State) -> Option<Self> {
        let (gram, held) = without_held(&normal.gram, &state.model);
        let (scale, scaled) = scaled(&gram);
        let factor = cholesky(scaled.clone())?;
        // λ ≥ 1/‖L⁻¹‖², and a direction has no component above 1.
        let smallest = 1.0 / inverse_of_lower(&factor.l()).norm_squared();
        let (reaches, least) = told(problem, normal, state);
        let reach = |k: usize| reaches[k] * scale[k];
        let shortest = (0..reaches.len())
            .filter(|k| !held.contains(k))
            .map(reach)
            .fold(f64::INFINITY, f64::min);
        let all = smallest > RANK_TOLERANCE && smallest * shortest * shortest >= least;
        let mut inverse_scale = scale.map(|s| if s > 0.0 { 1.0 / s } else { 0.0 });
        for k in held {
            inverse_scale[k] = 0.0;
        }
        all.then(|| Self {
            inverse_scale,
            scaled,
            factor,
            state: state.clone(),
        })
    }

    fn step(&self, gradient: &DVector<f64>, damping: f64) -> DVector<f64> {
        let scaled = gradient.component_mul(&self.inverse_scale);
        let damped = (damping > 0.0).then(|| {
            let mut damped = self.scaled.clone();
            for k in 0..damped.nrows() {
                damped[(k, k)] += damping;
            }
            cholesky(damped)
        });
        let factor = damped.flatten();
        let step = factor.as_ref().unwrap_or(&self.factor).solve(&scaled);
        step.component_mul(&self.inverse_scale)
    }
}

/// Where the solver is.
#[derive(Debug, Clone)]
struct State {
    model: Model,
    /// Coefficients of the columns beside the model.
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
    if last.cost > normal.cost * (1.0 + 1e-9) {
        // The blocks that were left out hold something that the coarse fit knows nothing of.
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
            if let Some(whitening) = &mut whitening {
                normal.add_whitened(problem, start, block, sums, whitening);
            } else {
                normal.add(problem, start, block, sums);
            }
        });
    normal.complete();
    problem.priors.add(&state.model, &mut normal);
    normal
}

/// A move by two standard deviations is the least that samples can tell.
/// What the samples leave open over the whole range that makes sense they do not determine.
const LEAST_TOLD: f64 = 4.0;
/// Where the noise is not known yet: rounding of the coordinates, mm, in every sample.
const ROUNDING_MM: f64 = 1e-6;

/// The spectrum of a problem with another noise at a solution, the cost there, and the step to the
/// solution under that noise.
pub(super) fn spectrum_at(problem: &Problem, solution: &Solution) -> (Spectrum, f64, DVector<f64>) {
    let state = State {
        model: solution.model.clone(),
        extra_coefficients: solution.extra_coefficients.clone(),
    };
    let blocks: Vec<usize> = (0..problem.inputs.len()).step_by(LANES).collect();
    let normal = sum(problem, &state, &blocks, Sums::All);
    let spectrum = spectrum_of(problem, &normal, &state);
    let step = spectrum.step(&normal.gradient, 0.0);
    (spectrum, normal.cost, step)
}

fn spectrum_of(problem: &Problem, normal: &Normal, state: &State) -> Spectrum {
    let (reaches, least) = told(problem, normal, state);
    Spectrum::of_model(&normal.gram, &state.model).within(&reaches, least)
}

/// How far it makes sense to go along each coefficient, and by how much the cost has to rise there.
fn told(problem: &Problem, normal: &Normal, state: &State) -> (Vec<f64>, f64) {
    let shapes = std::iter::repeat_n(f64::INFINITY, state.extra_coefficients.len());
    let reaches: Vec<f64> = state
        .model
        .terms()
        .iter()
        .flat_map(|term| term.effect.about().form.max_magnitudes())
        .chain(shapes)
        .collect();
    let least = if problem.noise.is_some() {
        LEAST_TOLD
    } else {
        normal.weight * ROUNDING_MM * ROUNDING_MM
    };
    (reaches, least)
}

/// Puts the columns beside the model behind its own, and what they do into the points.
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

/// The step of a robot with several joints, shortened so that nothing of its geometry goes farther
/// at once than a linear step has a meaning. One joint alone needs no such bound.
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
const LONGEST_TURN: f64 = 0.3;
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

/// Convergence is quadratic where the residuals vanish and fast where they are small, so a step
/// that moves the samples by a ten-thousandth of the residual is the last. Where nothing is left
/// the limit is rounding.
fn negligible(step: &DVector<f64>, normal: &Normal) -> bool {
    displacement(step, normal) <= (1e-6 * rms(normal)).max(1e-13)
}
