//! Where candidates compete: the whitened rows, the table of candidates, and fits of a model with
//! named terms and anonymous shapes to the same rows.
//!
//! Fits are compared by an approximate marginal likelihood (Schwarz 1978) with every name equally
//! likely beforehand:
//!
//! ```text
//! ln E = −(m/2) ln rss − (k/2) ln m − Σ ln(settings tried) − (shapes) ln 20
//! ```

use std::cell::{OnceCell, RefCell};
use std::rc::Rc;

use nalgebra::{DMatrix, DVector};

use crate::effects::{Form, Setting, Term};
use crate::fit::problem::Problem;
use crate::model::Model;

use super::aliases::Rival;
use super::candidates::{Candidate, Table, What};
use super::columns::Among;
use super::familywise::Familywise;
use super::memo::Memo;
use super::of_base::OfBase;
use super::placed::Placed;
use super::projected::{Grams, Projected};
use super::significance::Tests;
use crate::fit::noise::{Filter, Noise, PRICE_OF_A_VARIANCE};
use crate::fit::regression::Rows;
use crate::linear::{Basis, small_cholesky, small_gain};
use crate::model::shapes::Shape;

/// Every name pays for being one of the twenty of the catalogue (ln 20): a set of names is as simple
/// as it is small.
pub(crate) const PRICE_OF_A_NAME: f64 = 3.0;
/// A shape pays as a name does, and has to be this much likelier besides, as a logarithm: thirty
/// times …
const PRICE_OF_A_SHAPE: f64 = 3.5 + PRICE_OF_A_NAME;
/// … and this much more for each setting that is fitted finely.
const PRICE_OF_A_SETTING: f64 = 1.5;

fn price_of(shape: &Shape) -> f64 {
    PRICE_OF_A_SHAPE + PRICE_OF_A_SETTING * shape.refined() as f64
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
    pub(crate) minus_ln_p: f64,
    /// Change of the logarithm of the evidence.
    pub(crate) ln_odds: f64,
}

pub(crate) struct Regression<'a> {
    pub(crate) problem: Rc<Problem<'a>>,
    pub(crate) rows: Rc<Rows<'a>>,
    pub(crate) noise: Noise,
    pub(crate) table: Rc<Table>,
    filter: Filter,
    grams: OnceCell<Grams>,
    of_base: OnceCell<OfBase>,
    pub(super) tests: Rc<Tests>,
    pub(crate) base: Model,
    priors: Vec<PriorRow>,
    /// Number of rows beside those of the samples.
    pub(super) beside: usize,
    pub(crate) seed: u64,
    pub(crate) familywise: RefCell<Familywise>,
    scores_of_names: Memo<Vec<Score>>,
    scores_of_shapes: Memo<Vec<Score>>,
    /// Other names for a fit ([`super::aliases`]).
    pub(crate) rivals: Memo<Vec<Rival>>,
    /// What the noise itself says of the rows: −½ ln of its determinant, less its price.
    ln_noise: f64,
}

/// What it costs to say along which of the axes the noise is slow, if not along all.
fn choice_of_axes(rows: &Rows, rms_mm: [f64; 3]) -> f64 {
    let slow = rows.axes.iter().filter(|axis| rms_mm[**axis] > 0.0).count();
    if slow == rows.axes.len() {
        0.0
    } else {
        (rows.axes.len() as f64).ln()
    }
}

/// Lists of scores and of rivals that are kept for fits that a search comes to again.
const SCORES_KEPT: usize = 64;
const RIVALS_KEPT: usize = 4;

/// Steps of a fit that may take the base's own columns; one that has not converged by then takes those of
/// where it is.
const WITH_THE_BASES_OWN: usize = 4;

/// The square of a value over its standard deviation from which on it is clear of zero: p = 0.001.
const CLEAR: f64 = 10.8;

impl<'a> Regression<'a> {
    pub(crate) fn new(
        problem: Rc<Problem<'a>>,
        rows: Rc<Rows<'a>>,
        noise: Noise,
        table: Rc<Table>,
        base: Model,
        seed: u64,
    ) -> Self {
        let priors = prior_rows(&problem, &base);
        let beside = priors.len() + rows.known(&base, &problem.priors).0.len();
        let filter = noise.filter(&rows);
        let numbers = noise.slow.map_or(0.0, |slow| {
            1.0 + slow.rms_mm.iter().filter(|s| **s > 0.0).count() as f64
        });
        let choice = noise
            .slow
            .map_or(0.0, |slow| choice_of_axes(&rows, slow.rms_mm));
        let price = PRICE_OF_A_VARIANCE * numbers + choice;
        let ln_noise = -0.5 * filter.ln_determinant() - price;
        Self {
            ln_noise,
            problem,
            rows,
            noise,
            table,
            filter,
            grams: OnceCell::new(),
            of_base: OnceCell::new(),
            tests: Rc::default(),
            base,
            priors,
            beside,
            seed,
            familywise: RefCell::new(Familywise::default()),
            scores_of_names: Memo::new(SCORES_KEPT),
            scores_of_shapes: Memo::new(SCORES_KEPT),
            rivals: Memo::new(RIVALS_KEPT),
        }
    }

    /// The same samples and candidates with another noise.
    pub(crate) fn with_noise(&self, noise: Noise) -> Self {
        let other = Self::new(
            Rc::clone(&self.problem),
            Rc::clone(&self.rows),
            noise,
            Rc::clone(&self.table),
            self.base.clone(),
            self.seed,
        );
        Self {
            tests: Rc::clone(&self.tests),
            ..other
        }
    }

    /// Number of measured rows.
    pub(crate) fn m(&self) -> f64 {
        self.rows.count() as f64
    }

    /// Number of all rows: those of the samples, and one for each coefficient of the base of which
    /// something is known beforehand, and for what is known of places.
    pub(crate) fn height(&self) -> usize {
        self.rows.len() + self.beside
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
        columns: &DMatrix<f64>,
    ) -> (DVector<f64>, DMatrix<f64>) {
        let (m, more) = (self.rows.len(), self.beside);
        let residual = self.noise.whitened_vector(&self.rows, raw);
        let mut residual = residual.resize_vertically(m + more, 0.0);
        let mut jacobian = lengthened(self.noise.whitened(&self.rows, columns), more);
        let mut first = 0;
        for term in model.terms() {
            for (row, prior) in self.priors.iter().enumerate() {
                if prior.term.same_column(term) {
                    let k = prior.coefficient;
                    jacobian[(m + row, first + k)] = 1.0 / prior.sigma;
                    residual[m + row] = -term.coefficients[k] / prior.sigma;
                }
            }
            first += term.coefficients.len();
        }
        if more > self.priors.len() {
            let (left, columns) = self.rows.known(model, &self.problem.priors);
            let from = m + self.priors.len();
            residual.rows_mut(from, left.len()).copy_from(&left);
            jacobian.rows_mut(from, left.len()).copy_from(&columns);
        }
        (residual, jacobian)
    }

    /// Fits a model and shapes, starting from their coefficients.
    pub(crate) fn fit(&self, start: &Model, shapes: Vec<Placed>) -> Fit {
        let mut model = start.clone();
        let mut shapes = shapes;
        let mut last = None;
        for round in 0..8 {
            let (raw, columns) = self.raw(&model);
            let (residual, jacobian) = self.whitened(&model, &raw, &columns);
            let own = jacobian.ncols();
            let width = own + shapes.iter().map(|s| s.white.ncols()).sum::<usize>();
            let mut all = DMatrix::zeros(self.height(), width);
            all.columns_mut(0, own).copy_from(&jacobian);
            let mut at = own;
            for shape in &shapes {
                all.columns_mut(at, shape.white.ncols())
                    .copy_from(&shape.white);
                at += shape.white.ncols();
            }
            let extended = (round < WITH_THE_BASES_OWN)
                .then(|| self.of_base().extended(&self.base, &model, &all))
                .flatten();
            let basis = extended.unwrap_or_else(|| Basis::new(&all));
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
            let empty = DMatrix::zeros(self.height(), 0);
            (DVector::zeros(self.height()), Basis::new(&empty), 0.0)
        });
        let ln_evidence =
            self.ln_evidence(&model, &shapes, rss, basis.rank()) + self.spared(&model, &basis, rss);
        Fit {
            model,
            shapes,
            residual,
            basis,
            rss,
            ln_evidence,
        }
    }

    fn ln_evidence(&self, model: &Model, shapes: &[Placed], rss: f64, rank: usize) -> f64 {
        let m = self.m();
        let of_base = |t: &Term| self.base.terms().iter().any(|b| b.same_column(t));
        let names = model.terms().iter().map(|t| {
            let name = if of_base(t) { 0.0 } else { PRICE_OF_A_NAME };
            name + self.price_of_term(t)
        });
        let anonymous = shapes
            .iter()
            .map(|s| s.shape.tried.max(1.0).ln() + price_of(&s.shape));
        -0.5 * m * self.rounded(rss).ln()
            - 0.5 * rank as f64 * m.ln()
            - names.sum::<f64>()
            - anonymous.sum::<f64>()
            + shapes.iter().map(|s| s.credit).sum::<f64>()
            + self.ln_noise
    }

    /// By how much too much the terms that were added pay: a vector of which one component is there
    /// carries the information of one column and not of three. Each pays for its best subset of
    /// components, and for the choice of it. What cannot be negative and is pays everything.
    fn spared(&self, model: &Model, basis: &Basis, rss: f64) -> f64 {
        let mut first = 0;
        let mut spared = 0.0;
        let mut covariance: Option<DMatrix<f64>> = None;
        for term in model.terms() {
            let own = first..first + term.coefficients.len();
            first = own.end;
            if self.base.terms().iter().any(|b| b.same_column(term)) {
                continue;
            }
            if term.effect.about().never_negative && term.coefficients[0] < 0.0 {
                return f64::NEG_INFINITY;
            }
            let vector = matches!(term.effect.about().form, Form::Plain(q) if q.len() > 1);
            if vector && term.effect.about().never_negative {
                // What the effect is named for has to be there: the others alone are something else.
                let all = covariance.get_or_insert_with(|| basis.inverse_gram());
                let variance = all[(own.start, own.start)] * self.rounded(rss) / self.m();
                let clear = term.coefficients[0].powi(2) > CLEAR * variance;
                if !basis.kept.contains(&own.start) || !clear {
                    return f64::NEG_INFINITY;
                }
            }
            // Components that the samples do not show pay nothing.
            let own: Vec<usize> = own.filter(|k| basis.kept.contains(k)).collect();
            if !vector || own.len() < 2 {
                continue;
            }
            let first = first - term.coefficients.len();
            let all = covariance.get_or_insert_with(|| basis.inverse_gram());
            let best = subsets(own.len())
                .filter_map(|dropped| {
                    let at: Vec<usize> = dropped.iter().map(|k| own[*k]).collect();
                    let c = all.select_rows(&at).select_columns(&at);
                    let b = DVector::from_iterator(
                        at.len(),
                        at.iter().map(|k| term.coefficients[k - first]),
                    );
                    let lost = b.dot(&c.cholesky()?.solve(&b));
                    Some(
                        -0.5 * self.m() * (lost / self.rounded(rss)).ln_1p()
                            + 0.5 * at.len() as f64 * self.m().ln()
                            - choices(own.len(), at.len()),
                    )
                })
                .fold(0.0, f64::max);
            spared += best;
        }
        spared
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

    /// What an order that is not whole pays: for a number that is fitted.
    pub(crate) fn price_of_a_fraction(&self) -> f64 {
        PRICE_OF_A_SETTING + 0.5 * self.m().ln()
    }

    /// By how much a term that is absent so far would lower the sum of squares of a fit.
    pub(crate) fn gain_of_term(&self, fit: &Fit, term: &Term) -> f64 {
        let absent = Term::absent(term.effect, term.joint, term.setting);
        let model = fit.model.with_term(absent.clone());
        let before = model.terms().iter().take_while(|t| !t.same_column(&absent));
        let first: usize = before.map(|t| t.coefficients.len()).sum();
        let (_, columns) = self.rows.extract(&model);
        let own = columns
            .columns(first, absent.coefficients.len())
            .into_owned();
        let white = lengthened(self.noise.whitened(&self.rows, &own), self.beside);
        let along = fit.basis.q.tr_mul(&white);
        let mut free = white;
        free.gemm(-1.0, &fit.basis.q, &along, 1.0);
        Basis::new(&free).q.tr_mul(&fit.residual).norm_squared()
    }

    pub(crate) fn price_of_term(&self, term: &Term) -> f64 {
        if term.effect.about().setting == Setting::None {
            return 0.0;
        }
        let fraction =
            if term.setting.fract() != 0.0 && term.effect.about().setting.takes_fractions() {
                self.price_of_a_fraction()
            } else {
                0.0
            };
        let mut same = self.table.candidates.iter().filter(|c| {
            c.what.term().is_some_and(|t| {
                t.effect.about().id == term.effect.about().id && t.joint == term.joint
            })
        });
        fraction + same.next().map_or(0.0, |c| c.tried.ln())
    }

    /// Scores candidates beside a fit; those that the fit leaves nothing of are left out.
    pub(crate) fn scan(&self, fit: &Fit, among: Among) -> Vec<Score> {
        let beside = |among: Among| self.scan_beside(&self.projected(&fit.basis, among), fit);
        match among {
            Among::Names => self.scores_of_names.of(fit, || beside(Among::Names)),
            Among::Shapes => self.scores_of_shapes.of(fit, || beside(Among::Shapes)),
            Among::All => {
                let mut all = self.scan(fit, Among::Names);
                all.extend(self.scan(fit, Among::Shapes));
                all
            }
        }
    }

    /// The same with the table projected already.
    fn scan_beside(&self, projected: &Projected, fit: &Fit) -> Vec<Score> {
        let pulls = projected.pulls(&fit.residual);
        let m = self.m();
        let freedom = m - fit.basis.rank() as f64;
        let total = self.rounded(fit.rss);
        let mut scores = Vec::new();
        let candidates = self.table.candidates.iter().enumerate();
        for (index, candidate) in candidates.filter(|c| projected.has(c.1)) {
            let Some(Gain {
                all: gain,
                rank,
                parts,
            }) = Self::gain(projected, candidate, &pulls)
            else {
                continue;
            };
            let nu = freedom - rank as f64;
            if nu < 2.0 {
                continue;
            }
            let test = self.tests.of(rank, nu);
            let r2 = (gain / total).clamp(0.0, 1.0 - 1e-15);
            let worth = |gain: f64, rank: usize| {
                let r2 = (gain / total).clamp(0.0, 1.0 - 1e-15);
                -0.5 * m * (-r2).ln_1p() - 0.5 * rank as f64 * m.ln()
            };
            let best_part = parts
                .iter()
                .map(|(size, gain)| worth(*gain, *size) - choices(rank, *size))
                .fold(worth(gain, rank), f64::max);
            scores.push(Score {
                candidate: index,
                gain,
                minus_ln_p: test.of(r2) - weight_of(candidate),
                ln_odds: best_part
                    - candidate.tried.max(1.0).ln()
                    - match &candidate.what {
                        What::Named(_) => PRICE_OF_A_NAME,
                        What::Anonymous(shape) => price_of(shape),
                    },
            });
        }
        scores
    }

    /// The table's columns without what a basis explains.
    pub(crate) fn projected<'r>(&'r self, basis: &'r Basis, among: Among) -> Projected<'r> {
        let (columns, filter) = (&self.table.columns, &self.filter);
        let make = || Grams::new(columns, filter, &self.table.candidates);
        let table = (columns, filter, self.grams.get_or_init(make));
        let along = self.of_base().along(columns, filter, basis, among);
        Projected::new(table, basis, along, among)
    }

    fn of_base(&self) -> &OfBase {
        self.of_base.get_or_init(|| {
            let (raw, columns) = self.raw(&self.base);
            OfBase::new(self.whitened(&self.base, &raw, &columns).1)
        })
    }

    /// Whitened columns of some candidates, with the rows of the priors.
    pub(crate) fn white_columns(&self, candidates: &[&Candidate]) -> DMatrix<f64> {
        let width = candidates.iter().map(|c| c.size).sum();
        let mut raw = DMatrix::zeros(self.rows.len(), width);
        let mut at = 0;
        for candidate in candidates {
            let own = self.table.columns.raw(candidate.first, candidate.size);
            raw.columns_mut(at, candidate.size).copy_from(&own);
            at += candidate.size;
        }
        self.filter.whiten(raw.as_mut_slice());
        lengthened(raw, self.beside)
    }

    /// By how much a candidate lowers the sum of squares; `None` where nothing of it is left, or
    /// where it would have to be negative and cannot.
    fn gain(projected: &Projected, candidate: &Candidate, pulls: &DVector<f64>) -> Option<Gain> {
        let k = candidate.size;
        let (factor, rank) = projected.factor(candidate);
        if rank == 0 {
            return None;
        }
        let pull = &pulls.as_slice()[candidate.first..candidate.first + k];
        let about = candidate.what.term().map(|t| t.effect.about());
        if k == 1 && pull[0] < 0.0 && about.is_some_and(|a| a.never_negative) {
            return None;
        }
        let all = small_gain(&factor, k, &mut pull.to_vec());
        let vector = about.is_some_and(|a| matches!(a.form, Form::Plain(q) if q.len() > 1));
        let mut parts = Vec::new();
        if vector {
            let gram = |i: usize, j: usize| -> f64 {
                (0..=i.min(j))
                    .map(|l| factor[i * k + l] * factor[j * k + l])
                    .sum()
            };
            // All components of full rank are the whole, which is `all`; of a lower rank, as many as the
            // rank may be any of them.
            for kept in subsets(k).filter(|s| s.len() < rank || s.len() == rank && rank < k) {
                let size = kept.len();
                let mut own: Vec<f64> = (0..size * size)
                    .map(|x| gram(kept[x / size], kept[x % size]))
                    .collect();
                let tolerance: Vec<f64> = (0..size).map(|i| 1e-9 * own[i * size + i]).collect();
                if small_cholesky(&mut own, size, &tolerance) == size {
                    let mut h: Vec<f64> = kept.iter().map(|i| pull[*i]).collect();
                    parts.push((size, small_gain(&own, size, &mut h)));
                }
            }
        }
        Some(Gain { all, rank, parts })
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

/// What is known beforehand of one coefficient of the base: it is 0 within σ, inner units.
struct PriorRow {
    term: Term,
    coefficient: usize,
    sigma: f64,
}

/// The rows of the priors that a problem carries; none of a robot with a single joint.
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

/// A matrix with so many rows of zeros more.
pub(super) fn lengthened(columns: DMatrix<f64>, more: usize) -> DMatrix<f64> {
    if more == 0 {
        return columns;
    }
    let rows = columns.nrows();
    columns.resize_vertically(rows + more, 0.0)
}

/// By how much a candidate lowers the sum of squares.
struct Gain {
    all: f64,
    rank: usize,
    /// The same for some of a vector's components alone: how many, and how much.
    parts: Vec<(usize, f64)>,
}

/// Every choice of at least one of so few things.
fn subsets(of: usize) -> impl Iterator<Item = Vec<usize>> {
    (1_usize..1 << of).map(move |mask| (0..of).filter(|k| mask >> k & 1 == 1).collect())
}

/// Logarithm of the number of ways to choose `some` of `of` components.
fn choices(of: usize, some: usize) -> f64 {
    let ways = (0..some).map(|k| (of - k) as f64 / (k + 1) as f64);
    ways.product::<f64>().ln()
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
