//! The regression in which candidates are compared: the whitened rows, the table of candidates, and fits of a model
//! with named terms and anonymous shapes to the same rows. The comparison of fits is [`super::likelihood`]; the gain
//! of each candidate given one [`super::scores`].

use std::cell::OnceCell;
use std::rc::Rc;

use nalgebra::{DMatrix, DVector};

use crate::budget;
use crate::effects::Term;
use crate::fit::priors::Priors;
use crate::fit::problem::Problem;
use crate::model::Model;

use super::fit::Fit;
use super::grams::Grams;
use super::largest_in_noise::LargestInNoise;
use super::memo::Memo;
use super::projections::Projections;
use super::rival::Rival;
use super::significance::Tests;
use super::work::Work;
use crate::diagnosis::candidates::columns::pad_rows;
use crate::diagnosis::candidates::table::{CandidateKind, CandidateTable};
use crate::fit::noise::{Filter, Noise, PRICE_OF_A_VARIANCE};
use crate::fit::regression::Rows;
use crate::side_by_side::Threads;

pub(crate) struct Regression<'a> {
    pub(crate) problem: Rc<Problem<'a>>,
    pub(crate) rows: Rc<Rows<'a>>,
    pub(crate) noise: Noise,
    pub(crate) table: Rc<CandidateTable>,
    pub(crate) filter: Filter,
    pub(super) grams: OnceCell<Grams>,
    pub(crate) tests: Rc<Tests>,
    pub(crate) base: Model,
    priors: Vec<PriorRow>,
    /// Number of rows of priors, in addition to those of the samples.
    pub(crate) prior_rows: usize,
    /// On how many threads parts of it are done; the answer is the same.
    pub(crate) threads: Threads,
    /// The work that was done, of its budget.
    pub(crate) work: Work,
    /// The distribution of the largest gain in noise alone, given a fit.
    pub(super) largest_in_noise: Memo<LargestInNoise>,
    /// The last fits, by where they began.
    pub(super) fits: Memo<Fit>,
    /// Errors on unseen samples ([`super::held_out`]): in units of the rows, and in mm.
    pub(crate) unseen: Memo<[f64; 2]>,
    /// The projected columns of the candidates, given the last fits.
    pub(crate) projections: Memo<Rc<Projections>>,
    /// Other names for a fit ([`crate::diagnosis::search::aliases`]).
    pub(crate) rivals: Memo<Vec<Rival>>,
    /// The part of the evidence that the noise contributes: −½ ln of its determinant, less its penalty.
    pub(super) ln_noise: f64,
}

/// The penalty of the choice of the axes along which the noise is slow, if it is not along all.
fn choice_of_axes(rows: &Rows, rms_mm: [f64; 3]) -> f64 {
    let slow = rows.axes.iter().filter(|axis| rms_mm[**axis] > 0.0).count();
    if slow == rows.axes.len() {
        0.0
    } else {
        (rows.axes.len() as f64).ln()
    }
}

/// Results of fits that are kept: a search comes back to its last ones.
pub(crate) const KEPT: usize = 64;
/// Lists of rivals that are kept for fits that a search comes to again.
const RIVALS_KEPT: usize = 2;
/// Tables that are kept: each has a column of some tens of numbers for every column of the candidates.
const PROJECTIONS_KEPT: usize = 3;

impl<'a> Regression<'a> {
    pub(crate) fn new(
        problem: Rc<Problem<'a>>,
        rows: Rc<Rows<'a>>,
        noise: Noise,
        table: Rc<CandidateTable>,
        base: Model,
        threads: Threads,
    ) -> Self {
        let priors = prior_rows(&problem, &base);
        let prior_rows = priors.len() + rows.prior_rows(&base, &problem.priors).0.len();
        let filter = noise.filter(&rows);
        let numbers = noise.slow.map_or(0.0, |slow| {
            1.0 + slow.rms_mm.iter().filter(|s| **s > 0.0).count() as f64
        });
        let choice = noise
            .slow
            .map_or(0.0, |slow| choice_of_axes(&rows, slow.rms_mm));
        let numbers_of_a_basis = (rows.len() + prior_rows) * base.coefficient_count();
        let last_fits = (budget::NUMBERS_KEPT / numbers_of_a_basis.max(1)).min(KEPT);
        let of_robot = f64::from(u8::from(noise.joints_rad > 0.0));
        let price = PRICE_OF_A_VARIANCE * (numbers + of_robot) + choice;
        let ln_noise = -0.5 * filter.ln_determinant() - price;
        Self {
            ln_noise,
            work: Work::new(rows.samples.len()),
            problem,
            rows,
            noise,
            table,
            filter,
            grams: OnceCell::new(),
            tests: Rc::default(),
            base,
            priors,
            prior_rows,
            threads,
            largest_in_noise: Memo::new(KEPT),
            fits: Memo::new(last_fits),
            unseen: Memo::new(KEPT),
            projections: Memo::new(PROJECTIONS_KEPT),
            rivals: Memo::new(RIVALS_KEPT),
        }
    }

    /// The same samples and candidates with another noise.
    pub(crate) fn with_noise(&self, noise: Noise) -> Self {
        Self {
            tests: Rc::clone(&self.tests),
            work: self.work.clone(),
            ..self.like(Rc::clone(&self.problem), noise)
        }
    }

    /// The same samples, noise and candidates with other priors.
    pub(crate) fn with_priors(&self, priors: Priors) -> Self {
        let mut problem = (*self.problem).clone();
        problem.priors = priors;
        self.like(Rc::new(problem), self.noise.clone())
    }

    fn like(&self, problem: Rc<Problem<'a>>, noise: Noise) -> Self {
        let (rows, table) = (Rc::clone(&self.rows), Rc::clone(&self.table));
        Self::new(problem, rows, noise, table, self.base.clone(), self.threads)
    }

    /// Number of measured rows.
    pub(crate) fn m(&self) -> f64 {
        self.rows.count() as f64
    }

    /// Number of all rows: those of the samples, one for each coefficient of the base with a prior, and those of the
    /// priors of places.
    pub(crate) fn height(&self) -> usize {
        self.rows.len() + self.prior_rows
    }

    /// Rows of the priors of the base's coefficients, behind those of the samples.
    pub(crate) fn prior_rows(&self) -> std::ops::Range<usize> {
        let first = self.rows.len();
        first..first + self.priors.len()
    }

    /// Raw residuals and columns of a model on the samples.
    pub(crate) fn raw(&self, model: &Model) -> (DVector<f64>, DMatrix<f64>) {
        self.rows.extract(model)
    }

    /// Whitened residuals and columns, with the rows of the priors: `x/σ` is 0 but for noise.
    pub(crate) fn whitened(
        &self,
        model: &Model,
        raw: &DVector<f64>,
        mut columns: DMatrix<f64>,
    ) -> (DVector<f64>, DMatrix<f64>) {
        let m = self.rows.len();
        self.filter.whiten(columns.as_mut_slice());
        let mut jacobian = pad_rows(columns, self.prior_rows);
        let mut first = 0;
        for term in model.terms() {
            for (row, prior) in self.priors.iter().enumerate() {
                if prior.term.same_column(term) {
                    jacobian[(m + row, first + prior.coefficient)] = 1.0 / prior.sigma;
                }
            }
            first += term.coefficients.len();
        }
        if self.prior_rows > self.priors.len() {
            let (prior_residual, columns) = self.rows.prior_rows(model, &self.problem.priors);
            let from = m + self.priors.len();
            jacobian
                .rows_mut(from, prior_residual.len())
                .copy_from(&columns);
        }
        (self.whitened_residual(model, raw), jacobian)
    }

    /// Whitened residuals, with the rows of the priors.
    pub(super) fn whitened_residual(&self, model: &Model, raw: &DVector<f64>) -> DVector<f64> {
        let (m, more) = (self.rows.len(), self.prior_rows);
        let mut residual = raw.clone();
        self.filter.whiten(residual.as_mut_slice());
        let mut residual = residual.resize_vertically(m + more, 0.0);
        for term in model.terms() {
            for (row, prior) in self.priors.iter().enumerate() {
                if prior.term.same_column(term) {
                    residual[m + row] = -term.coefficients[prior.coefficient] / prior.sigma;
                }
            }
        }
        if more > self.priors.len() {
            let (prior_residual, _) = self.rows.prior_rows(model, &self.problem.priors);
            let from = m + self.priors.len();
            residual
                .rows_mut(from, prior_residual.len())
                .copy_from(&prior_residual);
        }
        residual
    }

    /// Frees the caches, most of the memory: what is asked for again is computed again.
    pub(crate) fn forget(&self) {
        self.fits.clear();
        self.projections.clear();
        self.rivals.clear();
        self.largest_in_noise.clear();
    }

    /// The fit with a candidate more.
    pub(crate) fn with(&self, fit: &Fit, what: &CandidateKind) -> Fit {
        match what {
            CandidateKind::Named(term) => self.fit(&fit.model.with_term(term.clone()), &fit.shapes),
            CandidateKind::Anonymous(shape) => {
                let mut shapes = fit.shapes.clone();
                shapes.push(self.placed(*shape));
                self.fit(&fit.model, &shapes)
            }
        }
    }

    /// The fit without one of the terms that the search added.
    pub(crate) fn without_term(&self, fit: &Fit, term: &Term) -> Fit {
        let model = fit.model.without(|t| t.same_column(term));
        self.fit(&model, &fit.shapes)
    }

    /// The fit without one of its shapes.
    pub(crate) fn without_shape(&self, fit: &Fit, index: usize) -> Fit {
        let mut shapes = fit.shapes.clone();
        shapes.remove(index);
        self.fit(&fit.model, &shapes)
    }

    /// Terms that the search added, in the order of the model.
    pub(crate) fn added<'f>(&self, fit: &'f Fit) -> Vec<&'f Term> {
        let base_basis = |t: &Term| self.base.terms().iter().any(|b| b.same_column(t));
        fit.model
            .terms()
            .iter()
            .filter(|t| !base_basis(t))
            .collect()
    }

    /// Estimated standard deviation of a whitened row.
    pub(crate) fn scale(&self, fit: &Fit) -> f64 {
        let freedom = (self.m() - fit.basis.rank() as f64).max(1.0);
        (fit.rss / freedom).sqrt()
    }
}

/// The prior of one coefficient of the base: 0 ± σ, inner units.
struct PriorRow {
    term: Term,
    coefficient: usize,
    sigma: f64,
}

/// The rows of the priors of a problem; none of a robot with a single joint.
fn prior_rows(problem: &Problem, base: &Model) -> Vec<PriorRow> {
    let mut rows = Vec::new();
    for term in base.terms() {
        for coefficient in (0..term.coefficients.len()).filter(|k| !term.held.contains(*k)) {
            let sigma = problem.priors.sigma(base, term, coefficient);
            rows.extend(sigma.map(|sigma| PriorRow {
                term: term.clone(),
                coefficient,
                sigma,
            }));
        }
    }
    rows
}
