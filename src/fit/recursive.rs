//! The exact fit, brought along sample by sample.
//!
//! ```text
//! G ← G + Jᵀ W J,   g ← g + Jᵀ W r₀,   c ← c + r₀ᵀ W r₀,   β = β₀ + G⁻¹ g,   cost = c − gᵀ G⁻¹ g
//! ```
//!
//! Recursive least squares in information form (Bierman 1977, ch. II): the normal matrix at a
//! linearisation β₀ only ever grows, so a new sample costs p² products however many came before,
//! and what the samples do not determine stays undetermined instead of taking a prior's word.
//! Residuals r₀ = measured − predicted at β₀, inner units.
//!
//! A model that is not linear in its coefficients drifts off its linearisation. [`Recursive::is_stale`]
//! says when: as many samples have come as there were then, or the estimate has moved the samples
//! by a part of their own noise. [`Recursive::relinearise`] goes over all samples again; as the number
//! doubles in between, that too is a constant cost for each sample. It ends at the batch's answer.

use nalgebra::DVector;

use crate::lanes::LANES;
use crate::model::Model;

use super::normal::{Normal, Sums};
use super::problem::Problem;
use super::solver::{Solution, Spectrum, Stopped};

/// A move of the samples by more than this part of their residual is worth a new linearisation.
const MOVED_SHARE: f64 = 0.1;
/// With fewer samples nothing is saved by waiting.
const FEW: usize = 32;
/// Steps of Gauss and Newton from one linearisation to the next.
const MOST_STEPS: usize = 30;

/// See the module.
#[derive(Debug, Clone)]
pub struct Recursive {
    /// β₀.
    at: Model,
    /// Lower triangle only; the sums at β₀.
    normal: Normal,
    axis_weights: [f64; 3],
    seen: usize,
    seen_when_linearised: usize,
    passes: usize,
}

impl Recursive {
    /// Begins at a model, with every sample of the problem that counts. The weights of the axes
    /// are those of the problem from now on.
    pub fn at(problem: &Problem, model: &Model) -> Self {
        let mut begun = Self {
            at: model.clone(),
            normal: Normal::new(model.coefficient_count()),
            axis_weights: problem.axis_weights,
            seen: 0,
            seen_when_linearised: 0,
            passes: 0,
        };
        begun.linearise_at(problem, model.clone());
        begun
    }

    /// Number of samples that were taken or passed over.
    pub fn seen(&self) -> usize {
        self.seen
    }

    /// The model that the sums were made at.
    pub fn linearised_at(&self) -> &Model {
        &self.at
    }

    /// Takes the samples behind those that were seen, as far as they count. The samples before are
    /// not looked at. Returns how many are new.
    pub fn take(&mut self, problem: &mut Problem) -> usize {
        problem.axis_weights = self.axis_weights;
        let (from, until) = (self.seen, problem.inputs.len());
        if from >= until {
            return 0;
        }
        self.add(problem, from);
        self.seen = until;
        until - from
    }

    /// The model that fits every sample so far, as far as it is linear.
    pub fn solution(&self) -> Solution {
        let mut normal = self.normal.clone();
        normal.complete();
        let spectrum = Spectrum::new(&normal.gram);
        let step = spectrum.step(&normal.gradient, 0.0);
        Solution {
            cost: (normal.cost - step.dot(&normal.gradient)).max(0.0),
            model: moved(&self.at, &step),
            stopped: if step.is_empty() {
                Stopped::NothingToDo
            } else {
                Stopped::Converged
            },
            passes: self.passes,
            spectrum,
        }
    }

    /// Whether the linearisation is too old to be relied on.
    pub fn is_stale(&self) -> bool {
        let new = self.seen - self.seen_when_linearised;
        if new >= self.seen_when_linearised.max(FEW) {
            return true;
        }
        let solution = self.solution();
        let mut normal = self.normal.clone();
        normal.complete();
        let step = difference(&solution.model, &self.at);
        let square = step.dot(&(&normal.gram * &step)).max(0.0);
        square > MOVED_SHARE * MOVED_SHARE * solution.cost
    }

    /// Goes over all samples of the problem again until the linearisation is the answer.
    pub fn relinearise(&mut self, problem: &mut Problem) {
        problem.axis_weights = self.axis_weights;
        for _ in 0..MOST_STEPS {
            let next = self.solution();
            let before = self.normal.cost;
            let (old, sums) = (self.at.clone(), self.normal.clone());
            self.linearise_at(problem, next.model);
            if !self.normal.cost.is_finite() || self.normal.cost > before * (1.0 + 1e-9) {
                // Nothing is gained any more; what was there is the answer.
                (self.at, self.normal) = (old, sums);
                break;
            }
            if before - self.normal.cost <= 1e-14 * before {
                break;
            }
        }
        self.seen_when_linearised = self.seen;
    }

    fn linearise_at(&mut self, problem: &Problem, model: Model) {
        self.normal = Normal::new(model.coefficient_count());
        self.at = model;
        self.add(problem, 0);
        self.seen = problem.inputs.len();
        self.seen_when_linearised = self.seen;
        self.passes += 1;
    }

    fn add(&mut self, problem: &Problem, from: usize) {
        let starts = (from..problem.inputs.len()).step_by(LANES);
        let normal = &mut self.normal;
        self.at
            .visit_blocks(&problem.inputs, true, starts, |start, block| {
                normal.add(problem, start, block, Sums::All);
            });
    }
}

fn moved(model: &Model, step: &DVector<f64>) -> Model {
    let coefficients = model.coefficients();
    let moved = coefficients.iter().zip(step.iter()).map(|(c, s)| c + s);
    model.with_coefficients(&moved.collect::<Vec<_>>())
}

fn difference(a: &Model, b: &Model) -> DVector<f64> {
    let (a, b) = (a.coefficients(), b.coefficients());
    DVector::from_iterator(a.len(), a.iter().zip(&b).map(|(a, b)| a - b))
}

#[cfg(test)]
mod tests;
