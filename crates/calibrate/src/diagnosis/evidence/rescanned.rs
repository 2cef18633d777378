//! Cross-validated residuals of a fit, each of its terms at the setting that is best without the samples held out.
//!
//! The step of a fit without some rows starts from the full fit, with its columns there; the shapes are linear and are
//! solved for again, so that the signal to be explained is the residual of the model alone.

use super::fitting::OF_A_FIT;
use crate::effects::{Setting, Term};
use crate::fewest;
use nalgebra::{DMatrix, DVector};

use super::fit::Fit;
use super::left_out::{Exchanged, Fitted, Scanned};
use super::projections::ReducedFit;
use super::regression::Regression;
use super::shares::{Gains, SHARES, dealt};
use crate::diagnosis::candidates::columns::CandidateSubset;
use crate::diagnosis::candidates::compatible;

/// Settings that are scanned again, at most …
pub(crate) const MOST_SETTINGS: usize = 16;
/// … of those whose gain is this share of the term's, over all samples: a fifth of them does not make up for more.
const NEAR: f64 = 0.3;

/// Whether a term's setting is scanned again in every fold.
fn is_scanned(term: &Term) -> bool {
    // A fade is a coefficient like others: every fold's fit moves it.
    !matches!(
        term.effect.about().setting,
        Setting::None | Setting::Setup | Setting::Target | Setting::Place | Setting::Fade
    )
}

/// Settings of a term, other than its own, whose gain is a large part of the term's.
fn near_its_own(
    regression: &Regression,
    fit: &Fit,
    term: &Term,
    reduced: &ReducedFit,
) -> Vec<usize> {
    let own = reduced.rss - fit.rss;
    let around = regression.projections(fit, CandidateSubset::Names);
    let gain = |index: usize| around.gain(reduced, &regression.table.candidates[index]);
    let setting = |index: &usize| {
        let term = regression.table.candidates[*index].what.term();
        term.map(|t| t.setting)
    };
    let others = settings(regression, term).into_iter();
    let others = others.filter(|c| setting(c) != Some(term.setting));
    let gains = others.map(|index| (gain(index), index));
    let mut gains: Vec<(f64, usize)> = gains.filter(|g| g.0 > NEAR * own).collect();
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
    fitted: Fitted,
    /// The residual of the model alone, and its columns with those of the shapes, not whitened.
    residual: DVector<f64>,
    columns: DMatrix<f64>,
}

impl<'f, 'a> Rescanned<'f, 'a> {
    /// A fit, with the settings of its terms that may be likelier in some of the rows.
    pub(crate) fn new(regression: &'f Regression<'a>, fit: &Fit) -> Self {
        Self::of(regression, fit, scanned_terms(regression, fit))
    }

    /// A fit with the settings that it has.
    pub(crate) fn as_it_is(regression: &'f Regression<'a>, fit: &Fit) -> Self {
        Self::of(regression, fit, Vec::new())
    }

    fn of(regression: &'f Regression<'a>, fit: &Fit, terms: Vec<Scanned>) -> Self {
        let (residual, mut columns) = regression.raw(&fit.model);
        let (residuals, mut white) = regression.whitened(&fit.model, &residual, columns.clone());
        for shape in &fit.shapes {
            for (all, own) in [(&mut columns, &*shape.raw), (&mut white, &*shape.white)] {
                let at = all.ncols();
                let wider = std::mem::take(all).resize_horizontally(at + own.ncols(), 0.0);
                *all = wider;
                all.columns_mut(at, own.ncols()).copy_from(own);
            }
        }
        let (height, width) = white.shape();
        // As many as making a basis without each of the terms would take, which is more than it does.
        let settings: usize = terms.iter().map(|t| 2 + t.candidates.len()).sum();
        let more = width.saturating_sub(regression.base.coefficient_count()) + 1;
        let bases = (1 + terms.len()) * 4 * more + 4 * settings;
        let products = 2.0 * OF_A_FIT + bases as f64;
        regression.work.did((height * width) as f64 * products);
        Self {
            fitted: Fitted::new(&fit.basis, &white, residuals, terms),
            regression,
            residual,
            columns,
        }
    }

    /// The residuals of each of these sets of rows in a fit without them, where its first so many columns predict.
    pub(crate) fn residuals(&self, folds: &[Vec<usize>], columns: usize) -> Vec<Vec<f64>> {
        let fitted = &self.fitted;
        let steps = self
            .regression
            .threads
            .each(folds.len(), |k| fitted.step(&folds[k]));
        let steps = steps.into_iter().zip(folds);
        steps
            .map(|(step, rows)| self.residuals_of(step, rows, columns))
            .collect()
    }

    fn residuals_of(
        &self,
        (step, exchanged): (DVector<f64>, Vec<Exchanged>),
        rows: &[usize],
        columns: usize,
    ) -> Vec<f64> {
        let width = columns.min(self.columns.ncols());
        // The difference of terms with another setting from the fit's.
        let more = exchanged.into_iter().map(|(at, setting, own)| {
            let term = &self.fitted.terms()[at];
            let table = &self.regression.table;
            let candidate = &table.candidates[term.candidates[setting]];
            let raw = table.columns.raw(candidate.first, candidate.size);
            raw * own - self.columns.columns(term.first, candidate.size) * &term.coefficients
        });
        let more: Vec<DVector<f64>> = more.collect();
        let residuals = rows.iter().map(|row| {
            let own = self.columns.row(*row);
            let predicted = own.columns(0, width).tr_dot(&step.rows(0, width));
            let more: f64 = more.iter().map(|own| own[*row]).sum();
            self.residual[*row] - predicted - more
        });
        residuals.collect()
    }
}

/// The gain of a term where its joint and its setting are chosen again without each share of the poses in turn. (Among
/// all names of as many coefficients one that is right lost to its neighbours: of 56 stars a telescope's encoder.)
pub(crate) fn chosen_again(
    regression: &Regression,
    fit: &Fit,
    reduced: &Fit,
    term: &Term,
) -> Gains {
    let rows = &regression.rows;
    let share = dealt(rows);
    let n = share.len();
    let of_share = |own: usize| {
        (0..rows.len())
            .filter(|row| share[row % n] == own)
            .collect()
    };
    let shares: Vec<Vec<usize>> = (0..SHARES).map(of_share).collect();
    let anywhere = anywhere(regression, fit, reduced, term);
    let with = Rescanned::of(regression, fit, vec![anywhere]);
    let without = Rescanned::as_it_is(regression, reduced);
    let mut squares = vec![[0.0; 2]; n];
    for (k, of) in [without, with].into_iter().enumerate() {
        for (own, residuals) in shares.iter().zip(of.residuals(&shares, usize::MAX)) {
            for (row, e) in own.iter().zip(residuals) {
                squares[row % n][k] += (rows.mm(*row) * e).powi(2);
            }
        }
    }
    Gains::of(rows, &squares)
}

/// A term with all joints and settings that may replace its own.
fn anywhere(regression: &Regression, fit: &Fit, reduced: &Fit, term: &Term) -> Scanned {
    let before = fit.model.terms().iter();
    let before = before.take_while(|t| !t.same_column(term));
    let there = regression.added(reduced);
    let id = term.effect.about().id;
    let all = regression.table.candidates.iter().enumerate();
    let own = all.filter(|(_, candidate)| {
        let named = candidate.what.term();
        candidate.size == term.coefficients.len()
            && named.is_some_and(|t| t.effect.about().id == id && compatible(&there, t))
    });
    let candidates: Vec<usize> = own.map(|own| own.0).collect();
    let of_table = candidates.iter().map(|i| &regression.table.candidates[*i]);
    Scanned {
        first: before.map(|t| t.coefficients.len()).sum(),
        coefficients: DVector::from_column_slice(&term.coefficients),
        white: regression.white_columns(&of_table.collect::<Vec<_>>()),
        candidates,
    }
}

/// The scanned terms of a fit that have rivals among their settings.
fn scanned_terms(regression: &Regression, fit: &Fit) -> Vec<Scanned> {
    let mut first = 0;
    let mut all = Vec::new();
    let many = regression.rows.samples.len() >= fewest::TO_SCAN;
    for term in fit.model.terms() {
        let size = term.coefficients.len();
        let at = first;
        first += size;
        if !is_scanned(term) {
            continue;
        }
        let reduced = many.then(|| regression.without(fit, term)).flatten();
        let candidates = match reduced {
            Some(reduced) => near_its_own(regression, fit, term, &reduced),
            None => settings(regression, term),
        };
        if candidates.is_empty() {
            continue;
        }
        let of_table = candidates.iter().map(|i| &regression.table.candidates[*i]);
        all.push(Scanned {
            first: at,
            coefficients: DVector::from_column_slice(&term.coefficients),
            white: regression.white_columns(&of_table.collect::<Vec<_>>()),
            candidates,
        });
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnosis::Options;
    use crate::diagnosis::search::prepare::PreparedSearch;
    use crate::diagnosis::tests::eccentric;
    use crate::linear::Basis;

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
            let (raw, mut columns) = regression.raw(&fit.model);
            let (residual, mut white) = regression.whitened(&fit.model, &raw, columns.clone());
            for shape in &fit.shapes {
                columns = DMatrix::from_columns(
                    &columns
                        .column_iter()
                        .chain(shape.raw.column_iter())
                        .collect::<Vec<_>>(),
                );
                white = DMatrix::from_columns(
                    &white
                        .column_iter()
                        .chain(shape.white.column_iter())
                        .collect::<Vec<_>>(),
                );
            }
            let out: Vec<usize> = (0..raw.len()).filter(|row| row / 7 % 5 == 1).collect();
            let stay = (0..white.nrows()).filter(|row| !out.contains(row));
            let stay: Vec<usize> = stay.collect();
            let anew = Basis::new(&white.select_rows(&stay));
            // Shapes are solved for afresh.
            let step = anew.solve(&residual.select_rows(&stay));
            let expected = &raw - &columns * step;
            let folds = [out];
            let residuals = rescanned.residuals(&folds, usize::MAX).remove(0);
            let [out] = folds;
            let apart = out
                .iter()
                .zip(&residuals)
                .map(|(row, e)| expected[*row] - e);
            let apart = apart.fold(0.0, |most: f64, e| most.max(e.abs()));
            assert!(apart < 1e-3 * expected.amax(), "{apart}");
        }
    }

    /// An eccentric encoder predicts when its setting is chosen again; a ripple in addition to it, fitted to noise at
    /// its likeliest order, does not.
    #[test]
    fn what_noise_chose_predicts_nothing_where_it_is_chosen_again() {
        let session = eccentric(15, 0.05);
        let prepared = PreparedSearch::new(&session, &Options::default()).unwrap();
        let regression = &prepared.regression;
        let base = regression.fit(&regression.base, &[]);
        let named = |id: &str, fit: &Fit| {
            let scores = regression.scan(fit, CandidateSubset::Names);
            let own = scores.into_iter().filter(|score| {
                let term = regression.table.candidates[score.candidate].what.term();
                term.is_some_and(|t| t.effect.about().id == id)
            });
            let best = own.max_by(|a, b| a.gain.total_cmp(&b.gain)).unwrap();
            regression.with(fit, &regression.table.candidates[best.candidate].what)
        };
        let gain = |fit: &Fit, reduced: &Fit| {
            let term = regression.added(fit).pop().unwrap();
            chosen_again(regression, fit, reduced, term)
        };
        let one = named("encoder-eccentricity", &base);
        let there = gain(&one, &base);
        assert!(there.sigmas > 5.0 && there.after_mm < 0.5 * there.before_mm);
        let two = named("gear-transmission-error", &one);
        assert!(two.rss < one.rss);
        let accident = gain(&two, &one);
        assert!(accident.sigmas < 1.0 && accident.after_mm > accident.before_mm);
    }
}
