//! Fits without some of the rows in which the settings of the terms are scanned afresh, from one fit of all rows.
//!
//! With `Q` the orthonormal columns of the fit and `c` the part of them that the terms in question alone span
//! ([`Basis::only_of`]), the columns of the others are those of `Q` with `cᵀx = 0`. In the rows that stay, with
//! `S = QᵀQ = L Lᵀ`, `W = L⁻¹ QᵀF` and `V = L⁻¹ c`, the others leave of any columns `F`
//!
//! ```text
//! FᵀF − WᵀW + UᵀU,   U = K⁻¹ Vᵀ W,   Vᵀ V = K Kᵀ
//! ```
//!
//! so that a setting in the place of a term, in whichever rows, costs products of a few columns: no basis is made
//! again. A setting that is likelier in the rows that stay takes the place of the fit's, term by term.

use nalgebra::{DMatrix, DMatrixView, DVector};

use super::reduced_basis::ReducedBasis;
use crate::linear::{Basis, cross, own_products, small_cholesky, small_gain};

/// A setting has to be better than the fit's by this share of its gain.
const BETTER: f64 = 1e-9;

/// A term with the other settings that may take the place of its own.
pub(super) struct Scanned {
    /// Where its columns stand among those of the fit.
    pub(crate) first: usize,
    pub(crate) size: usize,
    pub(crate) coefficients: DVector<f64>,
    pub(crate) candidates: Vec<usize>,
    /// Whitened columns of all of these, its own behind them.
    pub(crate) white: DMatrix<f64>,
}

impl Scanned {
    /// The columns of one of its settings; its own stand behind all others.
    fn columns(&self, setting: usize) -> DMatrixView<'_, f64> {
        self.white.columns(setting * self.size, self.size)
    }

    /// What it does in the fit.
    fn done(&self) -> DVector<f64> {
        self.columns(self.candidates.len()) * &self.coefficients
    }
}

/// Which term, at which of its settings, with which coefficients.
pub(super) type Exchanged = (usize, usize, DVector<f64>);

/// The columns of a fit and of its terms' settings, with what does not depend on the rows that are left out.
pub(super) struct FittedColumns {
    basis: Basis,
    of_terms: Vec<TermColumns>,
}

struct TermColumns {
    /// What it alone spans of the basis.
    alone: DMatrix<f64>,
    /// `QᵀF` of its settings.
    along: DMatrix<f64>,
    /// `FᵀF` of each setting.
    grams: Vec<DMatrix<f64>>,
}

impl FittedColumns {
    /// Of a fit's columns, and the terms that are scanned.
    pub(crate) fn new(basis: Basis, terms: &[Scanned]) -> Self {
        let transposed = basis.q.transpose();
        let of_term = |term: &Scanned| {
            let own: Vec<usize> = (term.first..term.first + term.size).collect();
            let alone = basis.only_of(&own);
            let gram = |setting| own_products(&term.columns(setting).into_owned());
            TermColumns {
                alone: alone.map_or_else(|| DMatrix::zeros(basis.rank(), 0), |(alone, _)| alone),
                along: &transposed * &term.white,
                grams: (0..=term.candidates.len()).map(gram).collect(),
            }
        };
        Self {
            of_terms: terms.iter().map(of_term).collect(),
            basis,
        }
    }

    /// Whether some of the columns are those of another fit, which are nearly its own.
    pub(super) fn is_near(&self) -> bool {
        self.basis.extends.is_some()
    }

    /// The step of a fit without these rows from what the fit leaves, and the terms with another setting; `None`
    /// where the others do not tell all columns.
    pub(crate) fn step(
        &self,
        terms: &[Scanned],
        residual: &DVector<f64>,
        rows: &[usize],
    ) -> Option<(DVector<f64>, Vec<Exchanged>)> {
        let left_out = ReducedBasis::new(&self.basis, rows)?;
        let mut seen = RetainedRows {
            fitted: self,
            terms,
            left_out: &left_out,
            y: residual.clone(),
            exchanged: Vec::new(),
        };
        for at in 0..terms.len() {
            let setting = seen.best(at)?;
            if setting < terms[at].candidates.len() {
                seen.exchange(at, setting);
            }
        }
        seen.solve()
    }
}

/// The rows that stay, with the settings that were exchanged so far.
struct RetainedRows<'s> {
    fitted: &'s FittedColumns,
    terms: &'s [Scanned],
    left_out: &'s ReducedBasis<'s>,
    /// What there is to explain: with what the terms whose setting was exchanged do.
    y: DVector<f64>,
    exchanged: Vec<(usize, usize)>,
}

/// The columns that took the place of others beside those that stayed.
struct ExchangedColumns {
    /// `V` of all terms that are out, and the factor `K` of its products.
    out: DMatrix<f64>,
    root: Vec<f64>,
    /// The columns that were taken instead, `W` and `U` of them, and the factor of what the others leave of them.
    columns: DMatrix<f64>,
    along: DMatrix<f64>,
    back: DMatrix<f64>,
    factor: Vec<f64>,
}

impl ExchangedColumns {
    /// `U` of columns with this `W`.
    fn back(&self, along: &DMatrix<f64>) -> DMatrix<f64> {
        solve_lower(&self.root, self.out.tr_mul(along))
    }

    /// What there is of these columns beside those that were taken, as products with them.
    fn orthogonal_products(
        &self,
        seen: DMatrix<f64>,
        along: &DMatrix<f64>,
        back: &DMatrix<f64>,
    ) -> DMatrix<f64> {
        let free = seen - self.along.tr_mul(along) + self.back.tr_mul(back);
        solve_lower(&self.factor, free)
    }
}

impl RetainedRows<'_> {
    /// Products of columns in the rows that stay.
    fn products(&self, a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
        let rows = self.left_out.rows();
        cross(a, b) - cross(&a.select_rows(rows), &b.select_rows(rows))
    }

    /// `W` of columns.
    fn along(&self, a: &DMatrix<f64>) -> DMatrix<f64> {
        let along = cross(&self.fitted.basis.q, a);
        let without = a.select_rows(self.left_out.rows());
        self.left_out.along(&along, &without)
    }

    /// With the terms that were exchanged, and this one, out.
    fn taken(&self, more: Option<usize>) -> Option<ExchangedColumns> {
        let out = self.exchanged.iter().map(|e| e.0).chain(more);
        let out: Vec<&DMatrix<f64>> = out.map(|at| &self.fitted.of_terms[at].alone).collect();
        let mut directions = DMatrix::zeros(
            self.fitted.basis.rank(),
            out.iter().map(|d| d.ncols()).sum(),
        );
        let mut first = 0;
        for own in out {
            directions.columns_mut(first, own.ncols()).copy_from(own);
            first += own.ncols();
        }
        let out = self.left_out.within(&directions);
        let products = out.tr_mul(&out);
        let k = products.ncols();
        let mut root = products.as_slice().to_vec();
        let least: Vec<f64> = products
            .diagonal()
            .iter()
            .map(|p| LEAST_APART * p)
            .collect();
        if small_cholesky(&mut root, k, &least) < k {
            return None;
        }
        let width = self.exchanged.iter().map(|e| self.terms[e.0].size).sum();
        let basis = &self.fitted.basis;
        let mut columns = DMatrix::zeros(basis.q.nrows(), width);
        let mut along = DMatrix::zeros(basis.rank(), width);
        let mut first = 0;
        for (at, setting) in &self.exchanged {
            let term = &self.terms[*at];
            let own = self.fitted.of_terms[*at]
                .along
                .columns(setting * term.size, term.size);
            columns
                .columns_mut(first, term.size)
                .copy_from(&term.columns(*setting));
            along.columns_mut(first, term.size).copy_from(&own);
            first += term.size;
        }
        let without = columns.select_rows(self.left_out.rows());
        let along = self.left_out.along(&along, &without);
        let mut taken = ExchangedColumns {
            back: DMatrix::zeros(0, 0),
            factor: Vec::new(),
            out,
            root,
            columns,
            along,
        };
        taken.back = taken.back(&taken.along);
        let own = self.products(&taken.columns, &taken.columns);
        let least: Vec<f64> = own.diagonal().iter().map(|g| LEAST_APART * g).collect();
        let free = own - taken.along.tr_mul(&taken.along) + taken.back.tr_mul(&taken.back);
        taken.factor = free.as_slice().to_vec();
        small_cholesky(&mut taken.factor, width, &least);
        Some(taken)
    }

    /// The best setting of a term beside everything else in the rows that stay, the fit's own being the last;
    /// `None` where they do not tell everything else.
    fn best(&self, at: usize) -> Option<usize> {
        let (term, of_term) = (&self.terms[at], &self.fitted.of_terms[at]);
        let taken = self.taken(Some(at))?;
        let y = &self.y + self.terms[at].done();
        let y = DMatrix::from_column_slice(y.len(), 1, y.as_slice());
        let y_along = self.along(&y);
        let y_back = taken.back(&y_along);
        let seen = self.products(&taken.columns, &y);
        let y_beside = taken.orthogonal_products(seen, &y_along, &y_back);

        let without = term.white.select_rows(self.left_out.rows());
        let along = self.left_out.along(&of_term.along, &without);
        let back = taken.back(&along);
        let seen = self.products(&taken.columns, &term.white);
        let beside = taken.orthogonal_products(seen, &along, &back);
        let mut pulls = self.products(&term.white, &y);
        pulls.gemm_tr(-1.0, &along, &y_along, 1.0);
        pulls.gemm_tr(1.0, &back, &y_back, 1.0);
        pulls.gemm_tr(-1.0, &beside, &y_beside, 1.0);
        let size = term.size;
        let gain = |setting: usize| {
            let first = setting * size;
            let of = |m: &DMatrix<f64>| {
                let own = m.columns(first, size);
                own.tr_mul(&own)
            };
            let whole = &of_term.grams[setting];
            let free = whole - of(&without) - of(&along) + of(&back) - of(&beside);
            let least: Vec<f64> = whole.diagonal().iter().map(|g| LEAST_APART * g).collect();
            // Symmetric: by rows as by columns.
            let mut factor = free.as_slice().to_vec();
            small_cholesky(&mut factor, size, &least);
            let mut pull = pulls.as_slice()[first..first + size].to_vec();
            small_gain(&factor, size, &mut pull)
        };
        let own = term.candidates.len();
        let mut best = (gain(own) * (1.0 + BETTER), own);
        for setting in 0..term.candidates.len() {
            let gain = gain(setting);
            if gain > best.0 {
                best = (gain, setting);
            }
        }
        Some(best.1)
    }

    fn exchange(&mut self, at: usize, setting: usize) {
        self.y += self.terms[at].done();
        self.exchanged.push((at, setting));
    }

    /// The coefficients of the fit's own columns, and of those that were taken instead.
    fn solve(&self) -> Option<(DVector<f64>, Vec<Exchanged>)> {
        if self.exchanged.is_empty() {
            return Some((self.left_out.solve(&self.y), Vec::new()));
        }
        let taken = self.taken(None)?;
        let y = DMatrix::from_column_slice(self.y.len(), 1, self.y.as_slice());
        let along = self.along(&y);
        let back = taken.back(&along);
        let seen = self.products(&taken.columns, &y);
        let instead = solve_upper(
            &taken.factor,
            taken.orthogonal_products(seen, &along, &back),
        );
        // Of the basis, what is left for it, without what the terms that are out alone span.
        let mut along = along;
        along.gemm(-1.0, &taken.along, &instead, 1.0);
        let out = solve_upper(&taken.root, taken.back(&along));
        along.gemm(-1.0, &taken.out, &out, 1.0);
        let mut coefficients = self.left_out.coefficients(&along.column(0).into_owned());
        let mut first = 0;
        let mut all = Vec::new();
        for (at, setting) in &self.exchanged {
            let term = &self.terms[*at];
            coefficients.rows_mut(term.first, term.size).fill(0.0);
            let own = instead
                .view((first, 0), (term.size, 1))
                .column(0)
                .into_owned();
            all.push((*at, *setting, own));
            first += term.size;
        }
        Some((coefficients, all))
    }
}

/// Columns of which less than this (of the square) is left add nothing.
const LEAST_APART: f64 = 1e-10;

/// `L⁻¹ M` for a factor of [`small_cholesky`]; nothing along what was dropped.
fn solve_lower(factor: &[f64], mut m: DMatrix<f64>) -> DMatrix<f64> {
    let k = m.nrows();
    for mut column in m.column_iter_mut() {
        small_gain(factor, k, column.as_mut_slice());
    }
    m
}

/// `L⁻ᵀ M` for the same.
fn solve_upper(factor: &[f64], mut m: DMatrix<f64>) -> DMatrix<f64> {
    let k = m.nrows();
    for mut x in m.column_iter_mut() {
        for i in (0..k).rev() {
            let known: f64 = (i + 1..k).map(|j| factor[j * k + i] * x[j]).sum();
            let pivot = factor[i * k + i];
            x[i] = if pivot > 0.0 {
                (x[i] - known) / pivot
            } else {
                0.0
            };
        }
    }
    m
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wild(rows: usize, columns: usize, seed: f64) -> DMatrix<f64> {
        DMatrix::from_fn(rows, columns, |i, j| {
            ((i * i * 7 + i * j * 13 + j) as f64 * 0.37 + seed).sin()
        })
    }

    /// Two terms of two columns each beside three others, each with three more settings.
    fn fit() -> (DMatrix<f64>, DVector<f64>, Vec<Scanned>) {
        let a = wild(60, 7, 0.0);
        let settings = [wild(60, 6, 1.0), wild(60, 6, 3.0)];
        // What there is: the others, the first term as it stands, and the second at another setting.
        let other = settings[1].columns(2, 2) * DVector::from_vec(vec![0.8, -1.1]);
        let noise = wild(60, 1, 5.0).column(0) * 0.05;
        let known = DVector::from_vec(vec![0.3, -0.2, 0.5, 1.0, 0.7, 0.0, 0.0]);
        let y = &a * known + other + noise;
        let coefficients = Basis::new(&a).solve(&y);
        let terms = [1, 5].into_iter().zip(settings).map(|(first, others)| {
            let mut white = others.resize_horizontally(8, 0.0);
            white.columns_mut(6, 2).copy_from(&a.columns(first, 2));
            Scanned {
                first,
                size: 2,
                coefficients: coefficients.rows(first, 2).into_owned(),
                candidates: vec![0, 1, 2],
                white,
            }
        });
        let terms = terms.collect();
        (a, y, terms)
    }

    /// The columns with a term's at a setting, and by how much they explain more than without the term.
    fn with(a: &DMatrix<f64>, term: &Scanned, setting: usize) -> DMatrix<f64> {
        let mut a = a.clone();
        a.columns_mut(term.first, 2)
            .copy_from(&term.columns(setting));
        a
    }

    #[test]
    fn settings_are_those_of_a_fit_of_the_rows_that_stay() {
        let (a, y, terms) = fit();
        let basis = Basis::new(&a);
        let residual = basis.reject(&y);
        let fitted = FittedColumns::new(basis, &terms);
        let mut others = 0;
        for fold in 0..5 {
            let out: Vec<usize> = (0..60).filter(|row| row / 4 % 5 == fold).collect();
            let stay: Vec<usize> = (0..60).filter(|row| row / 4 % 5 != fold).collect();
            let (step, exchanged) = fitted.step(&terms, &residual, &out).expect("told");
            // Anew: each term in turn at the setting that leaves least of the rows that stay.
            let mut now = a.clone();
            let mut settings = Vec::new();
            for (at, term) in terms.iter().enumerate() {
                let left = |setting: usize| {
                    let basis = Basis::new(&with(&now, term, setting).select_rows(&stay));
                    basis.reject(&y.select_rows(&stay)).norm_squared()
                };
                let own = left(3);
                let best = (0..3).min_by(|i, j| left(*i).total_cmp(&left(*j))).unwrap();
                if left(best) < own {
                    now = with(&now, term, best);
                    settings.push((at, best));
                }
            }
            let named: Vec<_> = exchanged.iter().map(|e| (e.0, e.1)).collect();
            assert_eq!(named, settings);
            others += settings.len();
            // The rows that are left out are predicted the same way.
            let anew = Basis::new(&now.select_rows(&stay)).solve(&y.select_rows(&stay));
            let expected = now.select_rows(&out) * anew;
            let start = Basis::new(&a).solve(&y);
            let mut moved = start + &step;
            let mut predicted = DVector::zeros(out.len());
            for (at, setting, own) in &exchanged {
                let term = &terms[*at];
                moved.rows_mut(term.first, 2).fill(0.0);
                predicted += term.columns(*setting).select_rows(&out) * own;
            }
            predicted += a.select_rows(&out) * moved;
            assert!((predicted - expected).amax() < 1e-8);
        }
        assert!(
            others >= 5,
            "the second term's setting is another in every fold"
        );
    }

    #[test]
    fn rows_that_do_not_tell_a_column_are_not_taken_for_rows_that_do() {
        let (mut a, y, terms) = fit();
        for row in 10..60 {
            a[(row, 0)] = 0.0;
        }
        let basis = Basis::new(&a);
        let residual = basis.reject(&y);
        let fitted = FittedColumns::new(basis, &terms);
        let out: Vec<usize> = (0..10).collect();
        assert!(fitted.step(&terms, &residual, &out).is_none());
        let stay: Vec<usize> = (10..60).collect();
        let seen = Basis::new(&a.select_rows(&stay));
        let terms = terms.into_iter().map(|term| Scanned {
            white: term.white.select_rows(&stay),
            ..term
        });
        let terms: Vec<Scanned> = terms.collect();
        let residual = residual.select_rows(&stay);
        let fitted = FittedColumns::new(seen, &terms);
        let step = fitted.step(&terms, &residual, &[]);
        let (step, _) = step.expect("of the rows alone");
        assert_eq!(step[0], 0.0);
    }
}
