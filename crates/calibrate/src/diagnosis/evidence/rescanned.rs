//! What a fit leaves of samples that it has not seen, each of its terms at the setting that the others like best.
//!
//! The step of a fit without some rows is taken from where the fit ended, with the columns that it has there; its
//! shapes are solved for afresh, so that what is to be explained is what the model alone leaves. Where the base's own
//! columns are near enough they tell whether any setting is another ([`BaseBasis`](super::base_basis::BaseBasis)); a setting is
//! exchanged beside the fit's own.

use crate::effects::{Setting, Term};
use crate::linear::Basis;
use nalgebra::{DMatrix, DVector};
use std::cell::OnceCell;

use super::exchanged::{Exchanged, FittedColumns, Scanned};
use super::fit::Fit;
use super::regression::Regression;
use super::surroundings::Without;
use crate::diagnosis::candidates::columns::CandidateSubset;

/// Another setting rivals the term's own from this share of what that does on.
const RIVALS: f64 = 0.6;
/// Settings that are scanned afresh, at most …
const MOST_SETTINGS: usize = 16;
/// … of those that would lower the square by this share of what the term does, over all samples: a fifth of them
/// does not make up for the rest.
const NEAR: f64 = 0.3;
/// Products for each number of a fit's columns, as of two rounds of a fit.
const OF_THE_COLUMNS: f64 = 300.0;

/// Whether other settings of a term would do nearly as much as its own.
pub(super) fn has_near_rivals(
    regression: &Regression,
    fit: &Fit,
    term: &Term,
    rest: &Without,
) -> bool {
    !near_its_own(regression, fit, term, rest, RIVALS).is_empty()
}

/// Whether a term's setting is scanned afresh in every fold.
pub(super) fn is_scanned(term: &Term) -> bool {
    // A fade is a coefficient like others: every fold's fit moves it.
    !matches!(
        term.effect.about().setting,
        Setting::None | Setting::Setup | Setting::Target | Setting::Place | Setting::Fade
    )
}

/// Settings of a term, other than its own, that would lower the square by more than a share of what the term does.
fn near_its_own(
    regression: &Regression,
    fit: &Fit,
    term: &Term,
    rest: &Without,
    share: f64,
) -> Vec<usize> {
    let own = rest.rss - fit.rss;
    let around = regression.surroundings(fit, CandidateSubset::Names);
    let gain = |index: usize| around.gain(rest, &regression.table.candidates[index]);
    let setting = |index: &usize| {
        let term = regression.table.candidates[*index].what.term();
        term.map(|t| t.setting)
    };
    let others = settings(regression, term).into_iter();
    let others = others.filter(|c| setting(c) != Some(term.setting));
    let gains = others.map(|index| (gain(index), index));
    let mut gains: Vec<(f64, usize)> = gains.filter(|g| g.0 > share * own).collect();
    gains.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    gains.truncate(MOST_SETTINGS);
    let mut kept: Vec<usize> = gains.iter().map(|g| g.1).collect();
    kept.sort_unstable();
    kept
}

/// Candidates that are a term with any setting.
fn settings(regression: &Regression, term: &Term) -> Vec<usize> {
    let id = term.effect.about().id;
    let same = |index: &usize| {
        let candidate = &regression.table.candidates[*index];
        let other = candidate.what.term();
        other.is_some_and(|t| t.effect.about().id == id && t.joint == term.joint)
    };
    let count = regression.table.candidates.len();
    (0..count).filter(same).collect()
}

/// A fit of all rows, from which every fold is taken in turn.
pub(super) struct Rescanned<'f, 'a> {
    regression: &'f Regression<'a>,
    whole: Whole,
    terms: Vec<Scanned>,
    fitted: FittedColumns,
    /// The same where no column is the base's.
    exact: OnceCell<FittedColumns>,
}

/// What a fit leaves and its columns, its shapes at the end, whitened and as they are measured.
struct Whole {
    residual: DVector<f64>,
    white: DMatrix<f64>,
    raw_residual: DVector<f64>,
    raw: DMatrix<f64>,
}

impl Whole {
    fn of(regression: &Regression, fit: &Fit) -> Self {
        let (raw_residual, mut raw) = regression.raw(&fit.model);
        let (residual, mut white) = regression.whitened(&fit.model, &raw_residual, raw.clone());
        for shape in &fit.shapes {
            for (all, own) in [(&mut raw, &*shape.raw), (&mut white, &*shape.white)] {
                let at = all.ncols();
                let wider = std::mem::take(all).resize_horizontally(at + own.ncols(), 0.0);
                *all = wider;
                all.columns_mut(at, own.ncols()).copy_from(own);
            }
        }
        Self {
            residual,
            white,
            raw_residual,
            raw,
        }
    }
}

impl<'f, 'a> Rescanned<'f, 'a> {
    pub(crate) fn new(regression: &'f Regression<'a>, fit: &Fit) -> Self {
        let whole = Whole::of(regression, fit);
        let terms = scanned_terms(regression, fit, &whole.white);
        let (height, width) = whole.white.shape();
        // As many as making a basis without each of the terms would take, which is more than it does.
        let settings: usize = terms.iter().map(|t| 2 + t.candidates.len()).sum();
        let more = width.saturating_sub(regression.base.coefficient_count()) + 1;
        let bases = (1 + terms.len()) * 4 * more + 4 * settings;
        let products = OF_THE_COLUMNS + bases as f64;
        regression.work.did((height * width) as f64 * products);
        let base_basis = regression.base_basis();
        let basis = base_basis.extended(&regression.base, &fit.model, &whole.white);
        let basis = basis.unwrap_or_else(|| Basis::new(&whole.white));
        Self {
            fitted: FittedColumns::new(basis, &terms),
            exact: OnceCell::new(),
            regression,
            whole,
            terms,
        }
    }

    /// What a fit without each of these sets of rows leaves of them, where its first so many columns predict.
    pub(crate) fn left(&self, folds: &[Vec<usize>], columns: usize) -> Vec<Vec<f64>> {
        let steps = self.steps(folds).into_iter().zip(folds);
        steps
            .map(|(step, rows)| self.left_by(step, rows, columns))
            .collect()
    }

    fn left_by(
        &self,
        (step, exchanged): (DVector<f64>, Vec<Exchanged>),
        rows: &[usize],
        columns: usize,
    ) -> Vec<f64> {
        let width = columns.min(self.whole.raw.ncols());
        // What terms with another setting do more than with the fit's.
        let more = exchanged.into_iter().map(|(at, setting, own)| {
            let term = &self.terms[at];
            let table = &self.regression.table;
            let candidate = &table.candidates[term.candidates[setting]];
            let raw = table.columns.raw(candidate.first, candidate.size);
            raw * own - self.whole.raw.columns(term.first, term.size) * &term.coefficients
        });
        let more: Vec<DVector<f64>> = more.collect();
        let left = rows.iter().map(|row| {
            let own = self.whole.raw.row(*row);
            let predicted = own.columns(0, width).tr_dot(&step.rows(0, width));
            let more: f64 = more.iter().map(|own| own[*row]).sum();
            self.whole.raw_residual[*row] - predicted - more
        });
        left.collect()
    }

    /// The steps without each of these sets of rows, and the terms with another setting.
    fn steps(&self, folds: &[Vec<usize>]) -> Vec<(DVector<f64>, Vec<Exchanged>)> {
        let (terms, residual) = (&self.terms, &self.whole.residual);
        let of = |fitted: &FittedColumns, which: &[usize]| {
            let step = |k: usize| fitted.step(terms, residual, &folds[which[k]]);
            self.regression.threads.each(which.len(), step)
        };
        let all: Vec<usize> = (0..folds.len()).collect();
        let mut steps = of(&self.fitted, &all);
        if self.fitted.is_near() {
            let others = |k: &usize| steps[*k].as_ref().is_none_or(|step| !step.1.is_empty());
            let anew: Vec<usize> = all.into_iter().filter(others).collect();
            if !anew.is_empty() {
                let exact = || FittedColumns::new(Basis::new(&self.whole.white), &self.terms);
                let exact = of(self.exact.get_or_init(exact), &anew);
                for (k, step) in anew.into_iter().zip(exact) {
                    steps[k] = step;
                }
            }
        }
        let steps = steps.into_iter().zip(folds);
        steps
            .map(|(step, rows)| step.unwrap_or_else(|| self.told_by_the_rest(rows)))
            .collect()
    }

    /// The same where the rows that stay do not tell all columns: which they do not has to be seen in them.
    fn told_by_the_rest(&self, rows: &[usize]) -> (DVector<f64>, Vec<Exchanged>) {
        let mut out = vec![false; self.whole.white.nrows()];
        for row in rows {
            out[*row] = true;
        }
        let stay: Vec<usize> = (0..out.len()).filter(|row| !out[*row]).collect();
        let terms = self.terms.iter().map(|term| Scanned {
            coefficients: term.coefficients.clone(),
            candidates: term.candidates.clone(),
            white: term.white.select_rows(&stay),
            ..*term
        });
        let terms: Vec<Scanned> = terms.collect();
        let white = self.whole.white.select_rows(&stay);
        let residual = self.whole.residual.select_rows(&stay);
        let fitted = FittedColumns::new(Basis::new(&white), &terms);
        let step = fitted.step(&terms, &residual, &[]);
        step.unwrap_or_else(|| (DVector::zeros(white.ncols()), Vec::new()))
    }
}

/// The scanned terms of a fit that have rivals among their settings.
fn scanned_terms(regression: &Regression, fit: &Fit, white: &DMatrix<f64>) -> Vec<Scanned> {
    let mut first = 0;
    let mut all = Vec::new();
    let many = regression.rows.samples.len() >= FEW;
    for term in fit.model.terms() {
        let size = term.coefficients.len();
        let at = first;
        first += size;
        if !is_scanned(term) {
            continue;
        }
        let rest = many.then(|| regression.without(fit, term)).flatten();
        let candidates = match rest {
            Some(rest) => near_its_own(regression, fit, term, &rest, NEAR),
            None => settings(regression, term),
        };
        if candidates.is_empty() {
            continue;
        }
        let of_table = candidates.iter().map(|i| &regression.table.candidates[*i]);
        let others = regression.white_columns(&of_table.collect::<Vec<_>>());
        let width = others.ncols();
        let mut both = others.resize_horizontally(width + size, 0.0);
        both.columns_mut(width, size)
            .copy_from(&white.columns(at, size));
        all.push(Scanned {
            first: at,
            size,
            coefficients: DVector::from_column_slice(&term.coefficients),
            candidates,
            white: both,
        });
    }
    all
}

/// Below this number of samples every sector is left out in turn.
pub(crate) const FEW: usize = 60;

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnosis::Options;
    use crate::diagnosis::search::prepare::PreparedSearch;
    use crate::diagnosis::tests::eccentric;

    /// One axis with an eccentric encoder, fitted with nothing and with a shape.
    #[test]
    fn what_is_left_of_a_fold_is_what_a_fit_of_the_other_rows_leaves() {
        let session = eccentric(5, 0.05);
        let prepared = PreparedSearch::new(&session, &Options::default()).unwrap();
        let regression = &prepared.regression;
        let base = regression.fit(&regression.base, &[]);
        let mut candidates = regression.table.candidates.iter();
        let shape = candidates.find(|c| c.what.term().is_none()).unwrap();
        let with_shape = regression.with(&base, &shape.what);
        assert_eq!(with_shape.shapes.len(), 1);
        for fit in [&base, &with_shape] {
            let rescanned = Rescanned::new(regression, fit);
            let whole = &rescanned.whole;
            let rows = 0..whole.raw.nrows();
            let out: Vec<usize> = rows.filter(|row| row / 7 % 5 == 1).collect();
            let stay = (0..whole.white.nrows()).filter(|row| !out.contains(row));
            let stay: Vec<usize> = stay.collect();
            let anew = Basis::new(&whole.white.select_rows(&stay));
            // Shapes are solved for afresh.
            let step = anew.solve(&whole.residual.select_rows(&stay));
            let expected = &whole.raw_residual - &whole.raw * step;
            let folds = [out];
            let left = rescanned.left(&folds, usize::MAX).remove(0);
            let [out] = folds;
            let apart = out.iter().zip(&left).map(|(row, e)| expected[*row] - e);
            let apart = apart.fold(0.0, |most: f64, e| most.max(e.abs()));
            assert!(apart < 1e-3 * expected.amax(), "{apart}");
        }
    }
}
