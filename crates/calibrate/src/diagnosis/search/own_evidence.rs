//! Whether the evidence for a name is in the samples, or only in the priors of the geometry.
//!
//! Where few poses determine the geometry, the priors hold the base: how far off links, zero offsets and tools usually
//! are. A robot that is farther off then leaves an error that a name may take up: one that the geometry would take up
//! as well, were it free. So every name is tested once more with ten times wider priors of the geometry. Its remaining
//! gain has to be as improbable by chance as before.

use nalgebra::DMatrix;

use super::prepare::PreparedSearch;
use crate::diagnosis::evidence::Fit;
use crate::diagnosis::evidence::Significance;
use crate::effects::Term;
use crate::linear::Basis;
use crate::odds;

/// The factor by which the priors of the geometry are widened: no robot is ten times as far off as others are.
const LESS: f64 = 0.1;

/// The name of a fit with the least evidence in the samples themselves, if that is not enough.
pub(super) fn least_proven(prepared: &PreparedSearch, fit: &Fit) -> Option<Term> {
    let regression = &prepared.regression;
    let priors = regression.prior_rows();
    let terms = regression.added(fit);
    if priors.is_empty() || terms.is_empty() {
        return None;
    }
    let (raw, columns) = regression.raw(&fit.model);
    let (mut residual, mut all) = regression.whitened(&fit.model, &raw, columns);
    for row in priors {
        residual[row] *= LESS;
        all.row_mut(row).scale_mut(LESS);
    }
    let own = all.ncols();
    let width = own + fit.shapes.iter().map(|s| s.white.ncols()).sum::<usize>();
    let mut all = all.resize_horizontally(width, 0.0);
    let mut at = own;
    for shape in &fit.shapes {
        let size = shape.white.ncols();
        all.columns_mut(at, size).copy_from(&*shape.white);
        residual -= &*shape.white * &shape.coefficients;
        at += size;
    }
    let whole = Basis::new(&all);
    let with = whole.reject(&residual).norm_squared();
    let freedom = (regression.m() - whole.rank() as f64).max(2.0);
    let coefficients = fit.model.coefficients();
    let mut least: Option<(f64, Term)> = None;
    let mut first = 0;
    for term in fit.model.terms() {
        let size = term.coefficients.len();
        if terms.iter().any(|t| t.same_column(term)) {
            // −ln p of some columns: of the term alone, and of those that are tested together with it.
            let of = |own: &[usize]| {
                let kept: Vec<usize> = (0..width).filter(|k| !own.contains(k)).collect();
                let reduced: DMatrix<f64> = all.select_columns(&kept);
                let mut partial_residual = residual.clone();
                for k in own {
                    partial_residual.axpy(coefficients[*k], &all.column(*k), 1.0);
                }
                let basis = Basis::new(&reduced);
                let without = basis.reject(&partial_residual).norm_squared();
                let share = (1.0 - with / without.max(1e-300)).clamp(0.0, 1.0 - 1e-15);
                let rank = whole.rank().saturating_sub(basis.rank()).max(1);
                Significance::new(rank, freedom).of(share)
            };
            let own: Vec<usize> = (first..first + size).collect();
            let mut minus_ln_p = of(&own) - 0.5 * regression.price_of_term(term);
            let together = regression.together(fit, term);
            if together.len() > 1 {
                minus_ln_p = minus_ln_p.max(of(&places(fit, &together)));
            }
            let unproven = regression.chance_in_noise(minus_ln_p, fit) > odds::TAKEN.chance();
            if unproven && least.as_ref().is_none_or(|least| minus_ln_p < least.0) {
                least = Some((minus_ln_p, term.clone()));
            }
        }
        first += size;
    }
    least.map(|least| least.1)
}

/// Places of the columns of some terms in a fit.
fn places(fit: &Fit, terms: &[Term]) -> Vec<usize> {
    let mut all = Vec::new();
    let mut first = 0;
    for own in fit.model.terms() {
        let end = first + own.coefficients.len();
        if terms.iter().any(|t| t.same_column(own)) {
            all.extend(first..end);
        }
        first = end;
    }
    all
}
