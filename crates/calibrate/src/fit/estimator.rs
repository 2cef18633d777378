//! The estimator of every answer: weighted least squares with noise that is estimated together with it, without
//! outliers.
//!
//! Fitting and inspecting the residuals is repeated until the same samples are set aside and the noise no longer
//! changes. A size that cannot be negative and came out so is zero, and the others are fitted given that.

use nalgebra::{DMatrix, DVector};

use crate::effects::Term;
use crate::model::Model;
use crate::observations::figures::judge;
use crate::{budget, rounding};

use super::gap::{Deviations, deviations_again, suspects_given};
use super::noise::Noise;
use super::problem::Problem;
use super::regression::Rows;
use super::solver::{Solution, Stopped, solve};

/// How often the noise is estimated again: after that only outliers may change.
const MOST_NOISE: usize = 3;

/// Fits the coefficients of `start`. Afterwards the problem has its outliers set aside and its noise estimated.
pub(crate) fn fit_without_outliers(problem: &mut Problem, start: &Model) -> Solution {
    let mut solution = solve(problem, start);
    if problem.observed.is_some() {
        return of_all_kinds(problem, solution);
    }
    let mut residuals = Deviations::default();
    let mut may_not_repeat = false;
    for round in 0..budget::ROUNDS {
        if solution.stopped == Stopped::Cancelled {
            break;
        }
        deviations_again(problem, &solution.model, &mut residuals);
        let (rank, covariance) = (solution.spectrum.rank(), || covariance(&solution));
        let suspected = suspects_given(problem, &mut residuals, &solution.model, rank, covariance);
        let kept = problem.fit.iter().zip(&suspected).map(|(f, s)| *f && !*s);
        let used: Vec<bool> = kept.collect();
        let same = used == problem.used;
        problem.used = used;
        // A joint that stood elsewhere in a few rows looks like one that does not repeat: those rows go first.
        let first_time = same && !may_not_repeat;
        may_not_repeat |= same;
        let noise = (round < MOST_NOISE || first_time).then(|| {
            let (model, extra) = (&solution.model, &solution.extra_coefficients);
            if may_not_repeat {
                noise_given(problem, model, extra)
            } else {
                noise_of_rows(problem, &rows(problem), model, extra)
            }
        });
        let before = problem.noise.clone();
        let known = |n: &Noise| before.as_ref().is_some_and(|b| b.whitens_like(n));
        if same && noise.as_ref().is_none_or(known) {
            break;
        }
        let first = problem.noise.is_none();
        let before = problem.axis_weights;
        if let Some(noise) = noise {
            problem.set_noise(&noise, &solution.model);
        }
        let full = solution.spectrum.rank() == solution.model.coefficient_count();
        let weak = problem.priors.weak;
        if let Some(factor) = only_rescaled(problem, before).filter(|_| same && full && !weak) {
            solution.rescale(factor);
            break;
        }
        solution = solve(problem, &solution.model);
        // Before the noise was known a direction that it hides may have run away.
        let open = solution.spectrum.rank() < solution.model.coefficient_count();
        if first && open && !problem.priors.weak {
            solution = solve(problem, start);
        }
    }
    solution = without_negative_sizes(problem, solution);
    solution.model = solution.model.settled();
    solution
}

/// The covariance of the model's coefficients, without the extra columns.
fn covariance(solution: &Solution) -> DMatrix<f64> {
    let own = solution.model.coefficient_count();
    solution.spectrum.inverse().resize(own, own, 0.0)
}

/// The same where more than plain points was measured: every kind has its own noise and its own
/// outliers.
fn of_all_kinds(problem: &mut Problem, mut solution: Solution) -> Solution {
    for _ in 0..budget::ROUNDS {
        let Some(layer) = problem.observed.as_mut() else {
            break;
        };
        let (rank, covariance) = (solution.spectrum.rank(), || covariance(&solution));
        let cancelled = solution.stopped == Stopped::Cancelled;
        if cancelled || !judge(layer, &solution.model, rank, covariance) {
            break;
        }
        let used = layer.samples_with(&layer.used);
        problem.used = used;
        solution = solve(problem, &solution.model);
    }
    solution = without_negative_sizes(problem, solution);
    solution.model = solution.model.settled();
    solution
}

/// The factor of the weights where white noise on all axes alike has become known: the fit is the
/// same, in other units.
fn only_rescaled(problem: &Problem, before: [f64; 3]) -> Option<f64> {
    let white = problem.noise.as_ref().is_some_and(Noise::is_white);
    let now = problem.axis_weights;
    let factors = (0..3)
        .filter(|a| before[*a] > 0.0)
        .map(|a| now[a] / before[a]);
    let (low, high) = factors.fold((f64::INFINITY, 0.0_f64), |(l, h), f| (l.min(f), h.max(f)));
    (white && high - low <= rounding::COMPUTED * high).then_some(high)
}

/// Sizes that cannot be negative and came out so are zero; the others are fitted given that. Their covariance remains
/// that of the whole fit.
fn without_negative_sizes(problem: &Problem, solution: Solution) -> Solution {
    let negative = |t: &Term| {
        t.effect.about().non_negative && t.coefficients.first().is_some_and(|c| *c < 0.0)
    };
    let gone: Vec<Term> = solution
        .model
        .terms()
        .iter()
        .filter(|t| negative(t))
        .cloned()
        .collect();
    if gone.is_empty() || solution.stopped == Stopped::Cancelled {
        return solution;
    }
    let reduced = solve(problem, &solution.model.without(negative));
    let reduced = without_negative_sizes(problem, reduced);
    let absent = |t: Term| Term {
        coefficients: vec![0.0; t.coefficients.len()],
        ..t
    };
    let model = gone
        .into_iter()
        .map(absent)
        .fold(reduced.model, |m, t| m.with_term(t));
    Solution {
        model,
        cost: reduced.cost,
        extra_coefficients: reduced.extra_coefficients,
        ..solution
    }
}

/// The rows from which the noise is estimated.
fn rows<'a>(problem: &Problem<'a>) -> Rows<'a> {
    match stretches(problem) {
        Some(samples) => Rows::of_samples(problem, samples),
        None => Rows::of(problem),
    }
}

/// The noise estimated from the residuals of a model in the samples that count.
pub(crate) fn noise_given(problem: &Problem, model: &Model, extra_coefficients: &[f64]) -> Noise {
    let rows = rows(problem).seen_by(model);
    noise_of_rows(problem, &rows, model, extra_coefficients)
}

/// The same of some rows; repeatability is not estimated where no model has been evaluated on them.
fn noise_of_rows(
    problem: &Problem,
    rows: &Rows,
    model: &Model,
    extra_coefficients: &[f64],
) -> Noise {
    let (mut residual, columns) = rows.extract(model);
    let shapes: Vec<DVector<f64>> = problem
        .extra_columns
        .iter()
        .map(|column| rows.column(|k, axis| column[axis][rows.samples[k]]))
        .collect();
    for (shape, coefficient) in shapes.iter().zip(extra_coefficients) {
        residual.axpy(-coefficient, shape, 1.0);
    }
    let own = columns.ncols();
    let mut columns: DMatrix<f64> = columns.resize_horizontally(own + shapes.len(), 0.0);
    for (k, shape) in shapes.iter().enumerate() {
        columns.set_column(own + k, shape);
    }
    let stated = problem.session.instrument.sigma_mm;
    if problem.shows_time() {
        return Noise::estimate_with_alternatives(stated, rows, &residual, &columns);
    }
    // The alternative is a noise that is slow in time as well.
    Noise::estimate(stated, rows, &residual, &columns).made_white()
}

/// The samples of some stretches of a long problem.
fn stretches(problem: &Problem) -> Option<Vec<usize>> {
    let count = problem.samples();
    if count <= budget::SAMPLES || problem.observed.is_some() {
        return None;
    }
    let length = budget::SAMPLES / budget::CELLS;
    let first = |k: usize| k * (count - length) / (budget::CELLS - 1);
    let places = (0..budget::CELLS).flat_map(|k| first(k)..first(k) + length);
    // Of little more samples than are wanted the stretches overlap.
    let mut places: Vec<usize> = places.collect();
    places.sort_unstable();
    places.dedup();
    Some(problem.counted_at(places.into_iter()))
}
