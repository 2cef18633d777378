//! Scans of all candidates given a fit, and given that fit without one of its terms.

use crate::effects::Term;
use nalgebra::DMatrix;
use std::rc::Rc;
use std::sync::Arc;

use super::fit::Fit;
use super::grams::Grams;
use super::likelihood::{EFFECT_PRIOR_PENALTY, price_of};
use super::memo::Key;
use super::projections::{Projections, ReducedFit};
use super::regression::Regression;
use super::score::Score;
use crate::diagnosis::candidates::columns::CandidateSubset;
use crate::diagnosis::candidates::table::Candidate;
use crate::side_by_side::Threads;

impl Regression<'_> {
    /// The candidates' columns projected orthogonal to a fit.
    pub(crate) fn projections(&self, fit: &Fit, among: CandidateSubset) -> Rc<Projections> {
        let key = Key::of(fit).with(among as usize);
        let work = || Rc::new(self.new_projections(fit, among));
        self.projections.of_key(key, work)
    }

    fn new_projections(&self, fit: &Fit, among: CandidateSubset) -> Projections {
        let (columns, filter) = (&self.table.columns, &self.filter);
        let candidates = &self.table.candidates;
        let make = || Grams::new(columns, filter, candidates);
        let grams = self.grams.get_or_init(make);
        let along = columns.products(filter, &fit.basis.q, among, self.threads);
        let more = fit
            .basis
            .rank()
            .saturating_sub(self.base.coefficient_count())
            + 8;
        let products = columns.count() * self.rows.samples.len() * more;
        self.work.did(products as f64);
        let residual = DMatrix::from_column_slice(fit.residual.len(), 1, fit.residual.as_slice());
        let pulls = columns.products(filter, &residual, among, Threads::ONE);
        let mut pulls = pulls.row(0).transpose();
        let inside = fit.basis.q.tr_mul(&fit.residual);
        pulls.gemv_tr(-1.0, &along, &inside, 1.0);
        Projections {
            among,
            basis: Arc::clone(&fit.basis),
            projected: grams.less(&along, candidates.iter().filter(|c| among.has(c))),
            least: grams.least(candidates),
            along,
            pulls,
        }
    }

    /// The columns of a candidate projected orthogonal to a fit.
    pub(crate) fn projected_columns(
        &self,
        around: &Projections,
        candidate: &Candidate,
    ) -> DMatrix<f64> {
        let mut own = self.white_columns(&[candidate]);
        let along = around.along.columns(candidate.first, candidate.size);
        own.gemm(-1.0, &around.basis.q, &along, 1.0);
        own
    }

    /// Scores of candidates given a fit, without those that are linearly dependent on it.
    pub(crate) fn scan(&self, fit: &Fit, among: CandidateSubset) -> Vec<Score> {
        let around = self.projections(fit, among);
        let whole = (fit.basis.rank(), fit.rss);
        self.scores(whole, among, |c| around.factor(c), around.pulls.as_slice())
    }

    /// A fit without a term that was added. The evidence is an upper bound but for rounding: the correction of a
    /// vector's penalty for its zero components is not subtracted.
    pub(crate) fn without(&self, fit: &Fit, term: &Term) -> Option<ReducedFit> {
        self.without_all(fit, std::slice::from_ref(term))
    }

    /// The same without some of them.
    pub(crate) fn without_all(&self, fit: &Fit, terms: &[Term]) -> Option<ReducedFit> {
        let (mut first, mut price) = (0, 0.0);
        let (mut columns, mut coefficients) = (Vec::new(), Vec::new());
        for own in fit.model.terms() {
            let size = own.coefficients.len();
            if terms.iter().any(|t| t.same_column(own)) {
                columns.extend(first..first + size);
                coefficients.extend_from_slice(&own.coefficients);
                price += EFFECT_PRIOR_PENALTY + self.price_of_term(own);
            }
            first += size;
        }
        self.less(fit, &columns, &coefficients, price)
    }

    /// A fit without one of its shapes.
    pub(crate) fn without_placed(&self, fit: &Fit, index: usize) -> Option<ReducedFit> {
        let terms = fit.model.terms().iter().map(|t| t.coefficients.len());
        let before = fit.shapes[..index].iter().map(|s| s.white.ncols());
        let first = terms.sum::<usize>() + before.sum::<usize>();
        let own = &fit.shapes[index];
        let price = own.shape.tried.max(1.0).ln() + price_of(&own.shape) - own.credit;
        let columns: Vec<usize> = (first..first + own.white.ncols()).collect();
        self.less(fit, &columns, own.coefficients.as_slice(), price)
    }

    fn less(
        &self,
        fit: &Fit,
        columns: &[usize],
        coefficients: &[f64],
        price: f64,
    ) -> Option<ReducedFit> {
        let (directions, parts) = fit.basis.only_of(columns)?;
        let own = DMatrix::from_column_slice(coefficients.len(), 1, coefficients);
        let explained = parts * own;
        let rss = fit.rss + explained.norm_squared();
        let (m, gone) = (self.m(), directions.ncols());
        let fell = -0.5 * m * (self.rounded(rss) / self.rounded(fit.rss)).ln();
        Some(ReducedFit {
            rss,
            rank: fit.basis.rank().saturating_sub(gone),
            ln_evidence: fit.ln_evidence + fell + 0.5 * gone as f64 * m.ln() + price,
            directions,
            explained,
        })
    }

    /// Scores of candidates given a reduced fit.
    pub(crate) fn scan_without(&self, around: &Projections, reduced: &ReducedFit) -> Vec<Score> {
        let along = reduced.directions.tr_mul(&around.along);
        let mut pulls = around.pulls.clone();
        pulls.gemv_tr(1.0, &along, &reduced.explained.column(0), 1.0);
        let factor = |c: &Candidate| around.factor_with(c, along.columns(c.first, c.size));
        let reduced = (reduced.rank, reduced.rss);
        self.scores(reduced, around.among, factor, pulls.as_slice())
    }
}
