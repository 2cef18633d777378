//! The scores of all candidates given a fit.

use std::rc::Rc;

use nalgebra::DMatrix;

use crate::effects::{FixedMask, Form, Term};
use crate::linear::{Basis, reject_all, small_cholesky, small_gain};
use crate::model::Model;

use super::fit::Fit;
use super::likelihood::{EFFECT_PRIOR_PENALTY, choices, price_of, price_of_owner, subsets};
use super::regression::Regression;
use super::score::{Score, weight_of};
use super::significance::Significance;
use crate::diagnosis::candidates::columns::{CandidateSubset, pad_rows};
use crate::diagnosis::candidates::table::{Candidate, CandidateKind};

/// By how much a candidate lowers the sum of squares.
struct Gain {
    all: f64,
    rank: usize,
    /// The same for some of a vector's components alone: how many, and how much.
    parts: Vec<(usize, f64)>,
}

impl Regression<'_> {
    /// Scores of candidates given a fit's rank and residual sum of squares, from the Cholesky factor of the projected
    /// columns of each and their products with its residual.
    pub(crate) fn scores(
        &self,
        (rank_of_fit, rss): (usize, f64),
        among: CandidateSubset,
        factor: impl Fn(&Candidate) -> (Vec<f64>, usize),
        pulls: &[f64],
    ) -> Vec<Score> {
        let m = self.m();
        let freedom = m - rank_of_fit as f64;
        let total = self.rounded(rss);
        let mut scores = Vec::new();
        let mut tests: Vec<Option<Rc<Significance>>> = Vec::new();
        let candidates = self.table.candidates.iter().enumerate();
        for (index, candidate) in candidates.filter(|c| among.has(c.1)) {
            let Some(Gain {
                all: gain,
                rank,
                parts,
            }) = Self::gain(factor(candidate), candidate, pulls)
            else {
                continue;
            };
            let nu = freedom - rank as f64;
            if nu < 2.0 {
                continue;
            }
            tests.resize(tests.len().max(rank + 1), None);
            let test = tests[rank].get_or_insert_with(|| self.tests.of(rank, nu));
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
                        CandidateKind::Named(term) => EFFECT_PRIOR_PENALTY + price_of_owner(term),
                        CandidateKind::Anonymous(shape) => price_of(shape),
                    },
            });
        }
        scores
    }

    /// The columns of a term that is absent so far, given a fit.
    pub(crate) fn columns_of(&self, fit: &Fit, term: &Term) -> DMatrix<f64> {
        let absent = Term::absent(term.effect, term.joint, term.setting);
        let model = fit.model.with_term(absent.clone());
        let before = model.terms().iter().take_while(|t| !t.same_column(&absent));
        let first: usize = before.map(|t| t.coefficients.len()).sum();
        // Of the others no column is asked for.
        let terms = model.terms().iter().map(|t| Term {
            held: if t.same_column(&absent) {
                t.held
            } else {
                FixedMask::ALL
            },
            ..t.clone()
        });
        let alone = Model::new(model.robot.clone(), terms.collect());
        let (_, columns) = self.rows.extract(&alone);
        let own = columns.columns(first, absent.coefficients.len());
        own.into_owned()
    }

    /// By how much a term that is absent so far would lower the sum of squares of a fit.
    pub(crate) fn gain_of_term(&self, fit: &Fit, term: &Term) -> f64 {
        self.gain_of_columns(fit, &self.columns_of(fit, term))
    }

    /// By how much columns that are not in a fit would lower its sum of squares.
    pub(super) fn gain_of_columns(&self, fit: &Fit, own: &DMatrix<f64>) -> f64 {
        let mut free = self.white_of(own);
        reject_all(&fit.basis.q, &mut free);
        Basis::new(&free).q.tr_mul(&fit.residual).norm_squared()
    }

    /// Columns of terms without a prior, whitened, with the rows of the priors.
    pub(super) fn white_of(&self, raw: &DMatrix<f64>) -> DMatrix<f64> {
        let mut white = raw.clone();
        self.filter.whiten(white.as_mut_slice());
        pad_rows(white, self.prior_rows)
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
        pad_rows(raw, self.prior_rows)
    }

    /// By how much a candidate lowers the sum of squares; `None` where it is linearly dependent on the fit, or where
    /// it would have to be negative and cannot.
    fn gain(
        (factor, rank): (Vec<f64>, usize),
        candidate: &Candidate,
        pulls: &[f64],
    ) -> Option<Gain> {
        let k = candidate.size;
        if rank == 0 {
            return None;
        }
        let pull = &pulls[candidate.first..candidate.first + k];
        let about = candidate.what.term().map(|t| t.effect.about());
        if k == 1 && pull[0] < 0.0 && about.is_some_and(|a| a.non_negative) {
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
}
