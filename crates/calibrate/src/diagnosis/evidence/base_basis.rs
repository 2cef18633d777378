//! The columns of the base, made orthonormal once: fits that differ by what they add have them nearly in
//! common, and only what is added has to be made orthonormal and projected again.
//!
//! The derivatives of the base move with its coefficients. A Gauss–Newton step with those of another
//! place still ends where the residual of the model itself is orthogonal to them: of columns that are
//! off by a share ε the coefficients are off by ε of what the noise lets them be known.

use std::cell::OnceCell;
use std::sync::Arc;

use nalgebra::DMatrix;

use crate::diagnosis::candidates::columns::{CandidateSubset, Columns};
use crate::fit::noise::Filter;
use crate::linear::Basis;
use crate::model::Model;
use crate::side_by_side::Threads;

/// How far a column may be from the base's own, as a share of it.
/// A fit takes the base's columns as they are at the base's own coefficients while they differ
/// by no more: coefficients are then off by as much of what the noise lets them be known, and a
/// sum of squares by its square.
const NEAR: f64 = 5e-3;

pub(crate) struct BaseBasis {
    /// Whitened, at the base's coefficients.
    columns: DMatrix<f64>,
    /// The square of each.
    squares: Vec<f64>,
    basis: Arc<Basis>,
    /// Products of the candidates' columns with the basis, of names and of the others.
    along: [OnceCell<DMatrix<f64>>; 2],
}

impl BaseBasis {
    /// Of whitened columns.
    pub(crate) fn new(columns: DMatrix<f64>) -> Self {
        Self {
            basis: Arc::new(Basis::new(&columns)),
            squares: columns.column_iter().map(|c| c.norm_squared()).collect(),
            columns,
            along: Default::default(),
        }
    }

    pub(crate) fn basis(&self) -> &Arc<Basis> {
        &self.basis
    }

    /// A basis of all columns of a fit, from that of the base; `None` where the base's columns are others.
    pub(crate) fn extended(
        &self,
        base: &Model,
        model: &Model,
        all: &DMatrix<f64>,
    ) -> Option<Basis> {
        let own = places(base, model)?;
        let columns = self.columns.column_iter().zip(&self.squares).zip(&own);
        let near = columns.into_iter().all(|((before, square), at)| {
            (all.column(*at) - before).norm_squared() <= NEAR * NEAR * square
        });
        near.then(|| Basis::extending(&self.basis, &own, all))
    }

    /// Products of the candidates' columns with a basis, a row for each of its columns.
    pub(crate) fn along(
        &self,
        (columns, filter): (&Columns, &Filter),
        basis: &Basis,
        among: CandidateSubset,
        threads: Threads,
    ) -> DMatrix<f64> {
        let extends = basis.extends.as_ref();
        let is_own = std::ptr::eq(basis, Arc::as_ptr(&self.basis));
        if !is_own && !extends.is_some_and(|own| Arc::ptr_eq(own, &self.basis)) {
            return columns.products(filter, &basis.q, among, threads);
        }
        let known = self.basis.rank();
        let more = basis.rank() - known;
        let new = basis.q.columns(known, more).into_owned();
        let mut all = DMatrix::zeros(basis.rank(), columns.count());
        all.rows_mut(known, more)
            .copy_from(&columns.products(filter, &new, among, threads));
        for (at, part) in [CandidateSubset::Names, CandidateSubset::Shapes]
            .into_iter()
            .enumerate()
        {
            if among == part || among == CandidateSubset::All {
                let make = || columns.products(filter, &self.basis.q, part, threads);
                let own = self.along[at].get_or_init(make);
                columns.copy(own, &mut all, part);
            }
        }
        all
    }
}

/// Where the base's columns stand among those of a model; `None` if it has not all of them.
fn places(base: &Model, model: &Model) -> Option<Vec<usize>> {
    let mut places = Vec::new();
    let mut wanted = base.terms().iter().peekable();
    let mut first = 0;
    for term in model.terms() {
        let size = term.coefficients.len();
        if let Some(own) = wanted.next_if(|own| own.same_column(term)) {
            if own.coefficients.len() != size {
                return None;
            }
            places.extend(first..first + size);
        }
        first += size;
    }
    wanted.peek().is_none().then_some(places)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnosis::Options;
    use crate::diagnosis::search::prepare::PreparedSearch;
    use crate::diagnosis::tests::two_axes;

    /// Two axes, the second with an eccentric encoder.
    #[test]
    fn a_fit_with_the_columns_of_the_base_ends_where_one_with_its_own_does() {
        let session = two_axes(
            r#"{"effect":"encoder-eccentricity","joint":2,"parameters":{"amplitude_deg":0.1,"phase_deg":20}}"#,
        );
        let prepared = PreparedSearch::new(&session, &Options::default()).unwrap();
        let regression = &prepared.regression;
        let base = regression.fit(&regression.base, &[]);
        let mut candidates = regression.table.candidates.iter();
        let there = candidates.find(|c| {
            let term = c.what.term();
            term.is_some_and(|t| t.effect.about().id == "encoder-eccentricity" && t.joint == 1)
        });
        let fit = regression.with(&base, &there.unwrap().what);
        assert!(
            fit.basis.extends.is_some(),
            "the base's own columns were taken"
        );

        // One exact step from there moves by no part of the noise that anybody could see.
        let (raw, columns) = regression.raw(&fit.model);
        let (residual, columns) = regression.whitened(&fit.model, &raw, columns);
        let exact = Basis::new(&columns);
        let step = exact.solve(&residual);
        assert!(
            (&columns * step).norm() < 0.01,
            "of the {} of the noise",
            fit.rss.sqrt()
        );
        let left = exact.reject(&residual).norm_squared();
        assert!((left - fit.rss).abs() < 1e-4, "{left} {}", fit.rss);

        // Columns of a robot that stands elsewhere are others.
        let base_basis = BaseBasis::new(
            regression
                .whitened(&base.model, &raw, regression.raw(&base.model).1)
                .1,
        );
        let mut elsewhere = base.model.coefficients();
        for coefficient in &mut elsewhere {
            *coefficient += 0.02;
        }
        let moved = base.model.stepped(&elsewhere);
        let (raw, columns) = regression.raw(&moved);
        let (_, columns) = regression.whitened(&moved, &raw, columns);
        assert!(base_basis.extended(&base.model, &moved, &columns).is_none());
    }
}
