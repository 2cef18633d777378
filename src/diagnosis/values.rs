//! Values of the parameters with their intervals: one fit to all samples that count, by the same
//! estimator that `identify` uses, with what no name explains beside the model.
//!
//! A search looks at a part of a long session, and at none of the samples that an option locks
//! away; the names that it found are fitted once more to all of them.

use nalgebra::DMatrix;

use crate::effects::Term;
use crate::fit::problem::Problem;
use crate::fit::solver::{Solution, solve};
use crate::fit::{DEFAULT_EFFECTS, Estimate, covariance_of, noise_beside, parameters_of};
use crate::model::Model;

use super::arena::Fit;
use super::prepare::Prepared;

/// Values of shapes that a fit to all samples may carry at most.
const MOST_BESIDE: usize = 20_000_000;

/// A model fitted to all samples that count, and how sure its coefficients are.
pub(crate) struct Values<'a> {
    pub(crate) problem: Problem<'a>,
    pub(crate) solution: Solution,
    pub(crate) model: Model,
    /// Of the coefficients, inner units.
    pub(crate) covariance: Option<DMatrix<f64>>,
    /// One list for each term of the model.
    estimates: Vec<Vec<Estimate>>,
}

impl<'a> Values<'a> {
    /// The names of a fit, fitted to the samples of a problem that count.
    pub(crate) fn of(prepared: &Prepared, problem: &Problem<'a>, fit: &Fit) -> Self {
        let mut problem = problem.clone();
        let width: usize = fit.shapes.iter().map(|s| s.raw.ncols()).sum();
        if width * problem.used.len() * 3 <= MOST_BESIDE {
            problem.beside = prepared.arena.table.ground.on_all(&problem, &fit.shapes);
        }
        problem.set_noise(&prepared.arena.noise);
        let mut solution = solve(&problem, &fit.model);
        for _ in 0..2 {
            let noise = noise_beside(&problem, &solution.model, &solution.beside);
            let known = problem.noise.as_ref();
            if known.is_some_and(|known| noise.whitens_like(known)) {
                break;
            }
            problem.set_noise(&noise);
            solution = solve(&problem, &solution.model);
        }
        let covariance = covariance_of(&problem, &solution);
        let estimates = parameters_of(&problem, &solution, covariance.as_ref());
        let own = solution.model.coefficient_count();
        Self {
            model: solution.model.clone(),
            covariance: covariance
                .filter(|_| own > 0)
                .map(|c| c.view((0, 0), (own, own)).into_owned()),
            estimates,
            solution,
            problem,
        }
    }

    /// Estimates of one of its terms.
    pub(crate) fn parameters_of(&self, term: &Term) -> Vec<Estimate> {
        let mut terms = self.model.terms().iter();
        let at = terms.position(|t| t.same_column(term));
        at.map_or_else(Vec::new, |at| self.estimates[at].clone())
    }

    /// Estimates of what belongs to every calibration.
    pub(crate) fn identified(&self) -> Vec<Estimate> {
        let terms = self.model.terms().iter().zip(&self.estimates);
        let base = terms.filter(|(t, _)| DEFAULT_EFFECTS.contains(&t.effect.about().id));
        base.flat_map(|(_, own)| own.clone()).collect()
    }
}
