//! The fits that a search has made: on its several ways it comes to the same ones again.
//!
//! What a fit of a model alone is stays known. The basis of its columns, which is nearly all of its numbers, stays of
//! the last only; of the others it is made again where it is asked for, from the place that it was taken at. So a fit
//! that comes again has the bits that it had, and what starts from it is known as well.

use std::cell::RefCell;
use std::sync::Arc;

use nalgebra::DMatrix;

use super::fit::Fit;
use super::memo::Key;
use crate::linear::Basis;
use crate::model::Model;

/// So many fits are remembered at most.
const MOST: usize = 512;

/// Where the basis of a fit was taken.
#[derive(Debug, Clone)]
pub(super) struct TakenAt {
    pub(crate) model: Model,
    /// Whether the base's own columns were good enough.
    pub(super) with_the_bases_own: bool,
}

/// A fit that is known.
#[derive(Clone)]
pub(crate) struct Known {
    key: Key,
    pub(crate) fit: Fit,
    pub(crate) at: TakenAt,
    /// Whether the fit still has its basis.
    pub(super) has_basis: bool,
    /// Products that it takes where every step takes all columns anew.
    pub(crate) products: f64,
}

/// The fits of a search.
pub(super) struct KnownFits {
    /// So many have their bases.
    most: usize,
    /// What comes again counts as work unless it is among the last so many: whatever else is remembered does not
    /// change how far a search gets.
    counted: usize,
    known: RefCell<Vec<Known>>,
    last: RefCell<Vec<Key>>,
}

impl KnownFits {
    pub(crate) fn new(most: usize, counted: usize) -> Self {
        Self {
            most: most.max(1),
            counted: counted.max(1),
            known: RefCell::default(),
            last: RefCell::default(),
        }
    }

    /// Whether what is asked for counts as work.
    pub(crate) fn counts(&self, key: &Key) -> bool {
        let mut last = self.last.borrow_mut();
        if last.iter().any(|own| own == key) {
            return false;
        }
        if last.len() >= self.counted {
            last.remove(0);
        }
        last.push(key.clone());
        true
    }

    /// The fit with this key.
    pub(crate) fn of(&self, key: &Key) -> Option<Known> {
        let known = self.known.borrow();
        known.iter().rev().find(|known| known.key == *key).cloned()
    }

    /// Keeps a fit that is new.
    pub(crate) fn keep(&self, key: Key, fit: &Fit, at: TakenAt, products: f64) {
        let known = Known {
            key,
            fit: fit.clone(),
            at,
            has_basis: true,
            products,
        };
        let mut all = self.known.borrow_mut();
        if all.len() >= MOST {
            all.remove(0);
        }
        all.push(known);
        drop(all);
        self.forget_bases();
    }

    /// Keeps the basis of a fit again, as of the last.
    pub(super) fn keep_again(&self, key: &Key, basis: &Arc<Basis>) {
        let mut all = self.known.borrow_mut();
        if let Some(at) = all.iter().position(|known| known.key == *key) {
            let mut known = all.remove(at);
            known.fit.basis = Arc::clone(basis);
            known.has_basis = true;
            all.push(known);
        }
        drop(all);
        self.forget_bases();
    }

    /// Takes the bases of all.
    pub(crate) fn forget_all_bases(&self) {
        self.forget_bases_but(0);
    }

    /// Takes the bases of all but the last.
    fn forget_bases(&self) {
        self.forget_bases_but(self.most);
    }

    /// Takes the bases of all but the last so many. Fits with shapes are forgotten with them: shapes have as many
    /// numbers, and made anew such a fit has the bits that it had.
    fn forget_bases_but(&self, most: usize) {
        let mut with = 0;
        let mut all = self.known.borrow_mut();
        for known in all.iter_mut().rev().filter(|known| known.has_basis) {
            with += 1;
            if with > most {
                known.has_basis = false;
                known.fit.basis = Arc::new(Basis::new(&DMatrix::zeros(0, 0)));
            }
        }
        all.retain(|known| known.has_basis || known.fit.shapes.is_empty());
    }

    /// Forgets all of them.
    pub(crate) fn clear(&self) {
        self.known.borrow_mut().clear();
        self.last.borrow_mut().clear();
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnosis::Options;
    use crate::diagnosis::candidates::table::CandidateKind;
    use crate::diagnosis::search::prepare::PreparedSearch;
    use crate::diagnosis::tests::eccentric;

    #[test]
    fn a_fit_that_comes_again_has_the_bits_that_it_had_and_counts_as_if_it_were_made_again() {
        let session = eccentric(5, 0.05);
        let mut prepared = PreparedSearch::new(&session, &Options::default()).unwrap();
        prepared.regression.fits = KnownFits::new(1, 2);
        let regression = &prepared.regression;
        let eccentric = |what: &CandidateKind| {
            what.term()
                .is_some_and(|t| t.effect.about().id == "encoder-eccentricity")
        };
        let candidates = &regression.table.candidates;
        let what = &candidates.iter().find(|c| eccentric(&c.what)).unwrap().what;
        let base = regression.fit(&regression.base, &[]);
        let fit = regression.with(&base, what);
        let again = regression.fit(&regression.base, &[]);
        assert_eq!(again.basis.q, base.basis.q);
        assert_eq!(again.residual, base.residual);
        // What is left of the rows is the same without their derivatives.
        let apart = regression.rows.residual(&fit.model) - regression.raw(&fit.model).0;
        assert!(apart.amax() < 1e-9);

        let fits = KnownFits::new(9, 2);
        let start_at = |zero: f64| {
            let coefficients = vec![zero; base.model.coefficient_count()];
            Key::of_start(&base.model.with_coefficients(&coefficients), &[])
        };
        let counts = [1.0, 2.0, 1.0, 3.0, 1.0].map(|zero| fits.counts(&start_at(zero)));
        assert_eq!(counts, [true, true, false, true, true]);
    }
}
