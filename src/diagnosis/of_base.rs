//! The columns of the base, made orthonormal once: fits that differ by what they add have them nearly in
//! common, and only what is added has to be made orthonormal and projected again.
//!
//! The derivatives of the base move with its coefficients. A Gauss–Newton step with those of another
//! place still ends where the residual of the model itself is orthogonal to them: of columns that are
//! off by a share ε the coefficients are off by ε of what the noise lets them be known.

use std::cell::OnceCell;
use std::rc::Rc;

use nalgebra::DMatrix;

use super::columns::{Among, Columns};
use crate::fit::noise::Filter;
use crate::linear::Basis;
use crate::model::Model;

/// How far a column may be from the base's own, as a share of it.
const NEAR: f64 = 5e-3;

pub(crate) struct OfBase {
    /// Whitened, at the base's coefficients.
    columns: DMatrix<f64>,
    basis: Rc<Basis>,
    /// Products of the candidates' columns with the basis, of names and of the others.
    along: [OnceCell<DMatrix<f64>>; 2],
}

impl OfBase {
    pub(crate) fn new(columns: DMatrix<f64>) -> Self {
        Self {
            basis: Rc::new(Basis::new(&columns)),
            columns,
            along: Default::default(),
        }
    }

    /// A basis of all columns of a fit, from that of the base; `None` where the base's columns are others.
    pub(crate) fn extended(
        &self,
        base: &Model,
        model: &Model,
        all: &DMatrix<f64>,
    ) -> Option<Basis> {
        let own = places(base, model)?;
        let near = own.iter().enumerate().all(|(k, at)| {
            let before = self.columns.column(k);
            let apart = (all.column(*at) - before).norm_squared();
            apart <= NEAR * NEAR * before.norm_squared()
        });
        near.then(|| Basis::extending(&self.basis, &own, all))
    }

    /// Products of the candidates' columns with a basis, a row for each of its columns.
    pub(crate) fn along(
        &self,
        columns: &Columns,
        filter: &Filter,
        basis: &Basis,
        among: Among,
    ) -> DMatrix<f64> {
        let extends = basis.extends.as_ref();
        if !extends.is_some_and(|own| Rc::ptr_eq(own, &self.basis)) {
            return columns.products_of_many(filter, &basis.q, among);
        }
        let known = self.basis.rank();
        let more = basis.rank() - known;
        let new = basis.q.columns(known, more).into_owned();
        let mut all = DMatrix::zeros(basis.rank(), columns.count());
        all.rows_mut(known, more)
            .copy_from(&columns.products_of_many(filter, &new, among));
        for (at, part) in [Among::Names, Among::Shapes].into_iter().enumerate() {
            if among == part || among == Among::All {
                let make = || columns.products_of_many(filter, &self.basis.q, part);
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
