//! Where candidates compete: the whitened rows, the table of candidates, and fits of a model with
//! named terms and anonymous shapes to the same rows.
//!
//! Fits are compared by an approximate marginal likelihood (Schwarz 1978) with every name equally
//! likely beforehand:
//!
//! ```text
//! ln E = −(m/2) ln rss − (k/2) ln m − Σ ln(settings tried) − (shapes) ln 20
//! ```

use std::cell::RefCell;

use nalgebra::{DMatrix, DVector};

use crate::effects::{Setting, Term};
use crate::fit::problem::Problem;
use crate::model::Model;

use super::anonymous::Shape;
use super::candidates::{Candidate, Table, What};
use super::evidence::{Noise, Rows};
use super::familywise::Familywise;
use super::linear::{Basis, small_cholesky, small_gain};
use super::significance::Significance;

/// A shape has to be this much likelier than names to be preferred, as a logarithm …
const PRICE_OF_A_SHAPE: f64 = 3.5;
/// … and this much more for each setting that is fitted finely.
const PRICE_OF_A_SETTING: f64 = 1.5;

fn price_of(shape: &Shape) -> f64 {
    PRICE_OF_A_SHAPE + PRICE_OF_A_SETTING * shape.refined() as f64
}

/// How much of a column has to be left beside the model for a candidate to count, squared.
const SEEN: f64 = 1e-6;

/// A shape in a fit.
#[derive(Debug, Clone)]
pub(crate) struct Placed {
    pub(crate) shape: Shape,
    pub(crate) white: DMatrix<f64>,
    pub(crate) raw: DMatrix<f64>,
    pub(crate) coefficients: DVector<f64>,
}

/// A model fitted to the rows.
#[derive(Debug, Clone)]
pub(crate) struct Fit {
    pub(crate) model: Model,
    pub(crate) shapes: Vec<Placed>,
    pub(crate) residual: DVector<f64>,
    pub(crate) basis: Basis,
    pub(crate) rss: f64,
    pub(crate) ln_evidence: f64,
}

/// What one candidate would do beside a fit.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Score {
    pub(crate) candidate: usize,
    /// By how much the sum of squares would fall.
    pub(crate) gain: f64,
    /// −ln p, less what the settings tried cost: the scale of the family-wise test.
    pub(crate) surprise: f64,
    /// Change of the logarithm of the evidence.
    pub(crate) ln_odds: f64,
}

pub(crate) struct Arena<'a> {
    pub(crate) problem: Problem<'a>,
    pub(crate) rows: Rows,
    pub(crate) noise: Noise,
    pub(crate) table: Table,
    pub(crate) white: DMatrix<f64>,
    /// Squared norms of the columns of `white`.
    norms: Vec<f64>,
    pub(crate) base: Model,
    pub(crate) seed: u64,
    pub(crate) familywise: RefCell<Familywise>,
}

impl<'a> Arena<'a> {
    pub(crate) fn new(
        problem: Problem<'a>,
        rows: Rows,
        noise: Noise,
        table: Table,
        base: Model,
        seed: u64,
    ) -> Self {
        let white = noise.whitened(&rows, &table.raw);
        let norms = white.column_iter().map(|c| c.norm_squared()).collect();
        Self {
            problem,
            rows,
            noise,
            table,
            white,
            norms,
            base,
            seed,
            familywise: RefCell::new(Familywise::default()),
        }
    }

    /// The same noise on other samples, with nothing to search for.
    pub(crate) fn on(&self, problem: Problem<'a>) -> Self {
        let rows = Rows::of(&problem);
        let table = self.table.emptied(&rows);
        let (noise, base) = (self.noise.clone(), self.base.clone());
        Self::new(problem, rows, noise, table, base, self.seed)
    }

    /// Number of rows.
    pub(crate) fn m(&self) -> f64 {
        self.rows.len() as f64
    }

    /// Fits a model and shapes, starting from their coefficients.
    pub(crate) fn fit(&self, start: &Model, shapes: Vec<Placed>) -> Fit {
        let mut model = start.clone();
        let mut shapes = shapes;
        let mut last = None;
        for round in 0..8 {
            let (raw, columns) = self.rows.extract(&model);
            let residual = self.noise.whitened_vector(&self.rows, &raw);
            let jacobian = self.noise.whitened(&self.rows, &columns);
            let own = jacobian.ncols();
            let width = own + shapes.iter().map(|s| s.white.ncols()).sum::<usize>();
            let mut all = DMatrix::zeros(self.rows.len(), width);
            all.columns_mut(0, own).copy_from(&jacobian);
            let mut at = own;
            for shape in &shapes {
                all.columns_mut(at, shape.white.ncols())
                    .copy_from(&shape.white);
                at += shape.white.ncols();
            }
            let basis = Basis::new(&all);
            // The shapes are linear: they are solved for afresh, the model by steps.
            let step = basis.solve(&residual);
            let left = basis.reject(&residual);
            let moved = (&jacobian * step.rows(0, own)).norm_squared();
            model = model.stepped(&step.as_slice()[..own]);
            let mut at = own;
            for shape in &mut shapes {
                let size = shape.white.ncols();
                shape.coefficients = step.rows(at, size).into_owned();
                at += size;
            }
            let rss = left.norm_squared();
            last = Some((left, basis, rss));
            // A step of a hundredth of the noise changes nothing to second order.
            if own == 0 || moved <= 1e-10 * self.m().max(1.0) + 1e-8 * rss && round > 0 {
                break;
            }
        }
        let (residual, basis, rss) = last.unwrap_or_else(|| {
            let empty = DMatrix::zeros(self.rows.len(), 0);
            (DVector::zeros(self.rows.len()), Basis::new(&empty), 0.0)
        });
        let ln_evidence = self.ln_evidence(&model, &shapes, rss, basis.rank());
        Fit {
            model,
            shapes,
            residual,
            basis,
            rss,
            ln_evidence,
        }
    }

    /// See the module.
    fn ln_evidence(&self, model: &Model, shapes: &[Placed], rss: f64, rank: usize) -> f64 {
        let m = self.m();
        let names = model.terms().iter().map(|t| self.price_of_term(t));
        let anonymous = shapes
            .iter()
            .map(|s| s.shape.tried.max(1.0).ln() + price_of(&s.shape));
        -0.5 * m * self.rounded(rss).ln()
            - 0.5 * rank as f64 * m.ln()
            - names.sum::<f64>()
            - anonymous.sum::<f64>()
    }

    /// A sum of squares cannot say more than the rounding of the numbers in a file.
    fn rounded(&self, rss: f64) -> f64 {
        let rounding: f64 = self
            .rows
            .axes
            .iter()
            .map(|a| (ROUNDING_MM / self.noise.sigma_mm[*a]).powi(2))
            .sum();
        rss + rounding * self.rows.samples.len() as f64
    }

    fn price_of_term(&self, term: &Term) -> f64 {
        if term.effect.about().setting == Setting::None {
            return 0.0;
        }
        let mut same = self.table.candidates.iter().filter(|c| {
            c.what.term().is_some_and(|t| {
                t.effect.about().id == term.effect.about().id && t.joint == term.joint
            })
        });
        same.next().map_or(0.0, |c| c.tried.ln())
    }

    /// Scores every candidate beside a fit; those that the fit leaves nothing of are left out.
    pub(crate) fn scan(&self, fit: &Fit) -> Vec<Score> {
        self.scan_beside(&fit.basis, &fit.residual, fit.rss)
    }

    pub(crate) fn scan_beside(
        &self,
        basis: &Basis,
        residual: &DVector<f64>,
        rss: f64,
    ) -> Vec<Score> {
        let projected = self.projected(basis);
        let m = self.m();
        let freedom = m - basis.rank() as f64;
        let total = self.rounded(rss);
        let mut tests: Vec<Option<Significance>> = Vec::new();
        let mut scores = Vec::new();
        for (index, candidate) in self.table.candidates.iter().enumerate() {
            let k = candidate.size;
            let Some((gain, rank)) = self.gain(&projected, candidate, residual) else {
                continue;
            };
            let nu = freedom - rank as f64;
            if nu < 2.0 {
                continue;
            }
            if tests.len() <= rank {
                tests.resize(rank + 1, None);
            }
            let test = tests[rank].get_or_insert_with(|| Significance::new(rank, nu));
            let r2 = (gain / total).clamp(0.0, 1.0 - 1e-15);
            let _ = k;
            scores.push(Score {
                candidate: index,
                gain,
                surprise: test.of(r2) - weight_of(candidate),
                ln_odds: -0.5 * m * (-r2).ln_1p()
                    - 0.5 * rank as f64 * m.ln()
                    - candidate.tried.max(1.0).ln()
                    - match &candidate.what {
                        What::Named(_) => 0.0,
                        What::Anonymous(shape) => price_of(shape),
                    },
            });
        }
        scores
    }

    /// The table's columns without what the fit explains.
    pub(crate) fn projected(&self, basis: &Basis) -> DMatrix<f64> {
        let along = basis.q.transpose() * &self.white;
        let mut projected = self.white.clone();
        projected.gemm(-1.0, &basis.q, &along, 1.0);
        projected
    }

    /// By how much a candidate lowers the sum of squares, and its rank; `None` where nothing of
    /// it is left.
    fn gain(
        &self,
        projected: &DMatrix<f64>,
        candidate: &Candidate,
        residual: &DVector<f64>,
    ) -> Option<(f64, usize)> {
        let k = candidate.size;
        let (factor, rank) = self.factor(projected, candidate);
        if rank == 0 {
            return None;
        }
        let mut h: Vec<f64> = (0..k)
            .map(|i| projected.column(candidate.first + i).dot(residual))
            .collect();
        Some((small_gain(&factor, k, &mut h), rank))
    }

    /// Cholesky factor of a candidate's projected columns.
    pub(crate) fn factor(
        &self,
        projected: &DMatrix<f64>,
        candidate: &Candidate,
    ) -> (Vec<f64>, usize) {
        let k = candidate.size;
        let mut gram = vec![0.0; k * k];
        for i in 0..k {
            let a = projected.column(candidate.first + i);
            for j in 0..=i {
                gram[i * k + j] = a.dot(&projected.column(candidate.first + j));
            }
        }
        let tolerance: Vec<f64> = (0..k)
            .map(|i| (SEEN * self.norms[candidate.first + i]).max(1e-300))
            .collect();
        let rank = small_cholesky(&mut gram, k, &tolerance);
        (gram, rank)
    }

    /// A shape ready to be fitted.
    pub(crate) fn placed(&self, shape: Shape) -> Placed {
        let raw = self.table.ground.columns(&shape);
        let white = self.noise.whitened(&self.rows, &raw);
        Placed {
            coefficients: DVector::zeros(raw.ncols()),
            shape,
            white,
            raw,
        }
    }

    /// The fit with a candidate more.
    pub(crate) fn with(&self, fit: &Fit, what: &What) -> Fit {
        let mut shapes = fit.shapes.clone();
        match what {
            What::Named(term) => self.fit(&fit.model.with_term(term.clone()), shapes),
            What::Anonymous(shape) => {
                shapes.push(self.placed(*shape));
                self.fit(&fit.model, shapes)
            }
        }
    }

    /// The fit without one of the terms that the search added.
    pub(crate) fn without_term(&self, fit: &Fit, term: &Term) -> Fit {
        let model = fit.model.without(|t| t.same_column(term));
        self.fit(&model, fit.shapes.clone())
    }

    /// The fit without one of its shapes.
    pub(crate) fn without_shape(&self, fit: &Fit, index: usize) -> Fit {
        let mut shapes = fit.shapes.clone();
        shapes.remove(index);
        self.fit(&fit.model, shapes)
    }

    /// Terms that the search added, in the order of the model.
    pub(crate) fn added<'f>(&self, fit: &'f Fit) -> Vec<&'f Term> {
        let of_base = |t: &Term| self.base.terms().iter().any(|b| b.same_column(t));
        fit.model.terms().iter().filter(|t| !of_base(t)).collect()
    }

    /// Estimated standard deviation of a whitened row.
    pub(crate) fn scale(&self, fit: &Fit) -> f64 {
        let freedom = (self.m() - fit.basis.rank() as f64).max(1.0);
        (fit.rss / freedom).sqrt()
    }
}

/// Rounding of the measured coordinates, mm: files carry a tenth of a micrometre or better.
const ROUNDING_MM: f64 = 1e-6;

/// What a candidate pays in the family-wise test for the settings of its kind: the square root of
/// their number, so that plain effects keep power beside the hundreds of gear orders; shapes pay
/// three times as much as names.
pub(crate) fn weight_of(candidate: &Candidate) -> f64 {
    let anonymous = if candidate.named() { 0.0 } else { 3.0_f64.ln() };
    0.5 * candidate.tried.max(1.0).ln() + anonymous
}
