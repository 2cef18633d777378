//! Gains of candidates given a fit, and given the same fit without one of its terms, from one table: with `Q` the
//! orthonormal columns of the fit and `r` its residual,
//!
//! ```text
//! P = W − Q A,   A = Qᵀ W,   PᵀP = WᵀW − AᵀA,   Pᵀr = Wᵀr − Aᵀ Qᵀ r
//! ```
//!
//! With `u = Q c` the directions that only one term spans, the basis of the reduced fit is `Q` without `u`, and its
//! products follow by an update of low rank:
//!
//! ```text
//! b = cᵀ (Qᵀ W),   PᵀP + bᵀb,   Pᵀr + bᵀβ,   ‖r‖² + ‖β‖²,   β = uᵀ (what the term explains)
//! ```
//!
//! so that a question about each of the terms in turn costs no fit and no sample is visited again. To first order: the
//! columns of the other terms are kept as they are in the fit. What comes close is fitted before it is used.

use std::sync::Arc;

use nalgebra::{DMatrix, DMatrixView, DVector};

use super::grams::Grams;
use crate::diagnosis::candidates::columns::CandidateSubset;
use crate::diagnosis::candidates::table::Candidate;
use crate::linear::{Basis, small_cholesky, small_gain};

/// The candidates' columns projected orthogonal to a fit.
pub(crate) struct Projections {
    pub(crate) among: CandidateSubset,
    pub(super) basis: Arc<Basis>,
    /// Products of the fit's orthonormal columns with the candidates'.
    pub(crate) along: DMatrix<f64>,
    /// Gram matrices of the projected columns.
    pub(crate) projected: Grams,
    /// The least square norm of a projected column for it to count.
    pub(crate) least: Vec<f64>,
    /// Products of the projected columns with the residual.
    pub(crate) pulls: DVector<f64>,
}

/// A fit without some of its columns, to first order.
#[derive(Debug, Clone)]
pub(crate) struct ReducedFit {
    /// `c`: of the fit's orthonormal columns, those that the columns alone span.
    pub(crate) directions: DMatrix<f64>,
    /// `β`, a single column.
    pub(crate) explained: DMatrix<f64>,
    /// The residual sum of squares.
    pub(crate) rss: f64,
    /// The rank.
    pub(crate) rank: usize,
    /// A lower bound of the logarithm of the evidence; [`Regression::without`] states by how much it may be too low.
    pub(crate) ln_evidence: f64,
}

impl Projections {
    /// Cholesky factor of the Gram matrix of a candidate's projected columns (lower, row by row), and their rank.
    pub(crate) fn factor(&self, candidate: &Candidate) -> (Vec<f64>, usize) {
        let (first, k) = (candidate.first, candidate.size);
        let mut gram = self.projected.of(candidate).to_vec();
        let rank = small_cholesky(&mut gram, k, &self.least[first..first + k]);
        (gram, rank)
    }

    /// The same with these products added back.
    pub(super) fn factor_with(
        &self,
        candidate: &Candidate,
        back: DMatrixView<f64>,
    ) -> (Vec<f64>, usize) {
        let (first, k) = (candidate.first, candidate.size);
        let mut gram = self.projected.of(candidate).to_vec();
        for i in 0..k {
            for j in 0..=i {
                gram[i * k + j] += back.column(i).dot(&back.column(j));
            }
        }
        let rank = small_cholesky(&mut gram, k, &self.least[first..first + k]);
        (gram, rank)
    }

    /// By how much a candidate would lower the sum of squares of a fit without some columns.
    pub(crate) fn gain(&self, reduced: &ReducedFit, candidate: &Candidate) -> f64 {
        let (first, k) = (candidate.first, candidate.size);
        let back = reduced.directions.tr_mul(&self.along.columns(first, k));
        let (factor, _) = self.factor_with(candidate, back.as_view());
        let mut pulls = self.pulls.rows(first, k).into_owned();
        pulls.gemv_tr(1.0, &back, &reduced.explained.column(0), 1.0);
        small_gain(&factor, k, pulls.as_mut_slice())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnosis::Options;
    use crate::diagnosis::search::prepare::PreparedSearch;
    use crate::diagnosis::tests::two_axes;

    /// Two axes: the second with an eccentric encoder and a gear, the first with backlash.
    #[test]
    fn what_is_known_from_one_table_is_what_fits_without_each_term_say() {
        let session = two_axes(
            r#"{"effect":"encoder-eccentricity","joint":2,"parameters":{"amplitude_deg":0.03,"phase_deg":20}},
            {"effect":"gear-transmission-error","joint":2,"parameters":{"order":17,"amplitude_deg":0.02,"phase_deg":70}},
            {"effect":"backlash","joint":1,"parameters":{"width_deg":0.03}}"#,
        );
        let prepared = PreparedSearch::new(&session, &Options::default()).unwrap();
        let regression = &prepared.regression;
        let mut fit = regression.fit(&regression.base, &[]);
        for (id, joint, order) in [
            ("encoder-eccentricity", 1, 0.0),
            ("gear-transmission-error", 1, 17.0),
            ("backlash", 0, 0.0),
        ] {
            let wanted = |c: &&Candidate| {
                let term = c.what.term();
                term.is_some_and(|t| {
                    t.effect.about().id == id && t.joint == joint && t.setting == order
                })
            };
            let candidates = &regression.table.candidates;
            fit = regression.with(&fit, &candidates.iter().find(wanted).unwrap().what);
        }
        let around = regression.projections(&fit, CandidateSubset::Names);
        for term in regression.added(&fit) {
            let known = regression.without(&fit, term).unwrap();
            let reduced = regression.without_term(&fit, term);
            assert!(
                (known.rss / reduced.rss - 1.0).abs() < 0.01,
                "{} {}",
                known.rss,
                reduced.rss
            );
            assert_eq!(known.rank, reduced.basis.rank());
            assert!((known.ln_evidence - reduced.ln_evidence).abs() < 1.0);
            let by_table = regression.scan_without(&around, &known);
            let by_fit = regression.scan(&reduced, CandidateSubset::Names);
            assert_eq!(by_table.len(), by_fit.len());
            for (a, b) in by_table.iter().zip(&by_fit) {
                assert_eq!(a.candidate, b.candidate);
                let apart = (a.gain - b.gain).abs();
                assert!(
                    apart < 1.0 + 0.03 * b.gain,
                    "{:?} {} {}",
                    regression.table.candidates[a.candidate].what,
                    a.gain,
                    b.gain
                );
                let one = around.gain(&known, &regression.table.candidates[a.candidate]);
                assert!((one - a.gain).abs() < 1e-6 * (1.0 + a.gain));
            }
        }
    }
}
