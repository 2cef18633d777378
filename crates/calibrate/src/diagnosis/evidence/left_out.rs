//! Fits without some of the rows (leave-out updates), from sums over all rows less those over the rows left out:
//!
//! ```text
//! G = XᵀX − X_BᵀX_B,   b = Xᵀy − X_Bᵀy_B,   G = L Lᵀ,   x = L⁻ᵀ L⁻¹ b
//! ```
//!
//! (`X` the columns of a fit, `y` its residual, `B` the rows left out). A setting of a term with columns `F` lowers
//! the sum of squares given all other columns by `hᵀ S⁻¹ h` with `S = FᵀF − WᵀW`, `h = Fᵀy − Wᵀ L⁻¹ b`, `W = L⁻¹ XᵀF`,
//! all without the term's own columns: the setting with the largest gain over the remaining rows replaces that of the
//! fit, term by term, and no row is visited twice.

use nalgebra::{DMatrix, DVector};

use crate::linear::{Basis, cross, gram, small_cholesky, small_gain};
use crate::rounding;

/// A term with the other settings that may replace its own.
pub(super) struct Scanned {
    /// The index of its first column among those of the fit.
    pub(super) first: usize,
    pub(super) coefficients: DVector<f64>,
    pub(super) candidates: Vec<usize>,
    /// Whitened columns of all of these.
    pub(super) white: DMatrix<f64>,
}

impl Scanned {
    fn size(&self) -> usize {
        self.coefficients.len()
    }

    /// Where the columns of a setting are.
    fn columns(&self, setting: usize) -> (usize, usize) {
        (setting * self.size(), self.size())
    }
}

/// Columns of all settings of a term, and how many each has.
type Settings = (usize, DMatrix<f64>);

/// Which term, at which of its settings, with which coefficients.
pub(super) type Exchanged = (usize, usize, DVector<f64>);

/// The columns of a fit, its residual, and the settings of its terms, with their products over all rows.
pub(super) struct Fitted {
    /// Which columns count, in the order in which they are taken.
    kept: Vec<usize>,
    width: usize,
    /// The least share of the square of each that has to be independent of the others.
    least: Vec<f64>,
    columns: DMatrix<f64>,
    residual: DVector<f64>,
    terms: Vec<Scanned>,
    all: Sums,
}

/// Products over some rows.
#[derive(Clone)]
struct Sums {
    /// `XᵀX` and `Xᵀy`.
    gram: DMatrix<f64>,
    along: DVector<f64>,
    /// Of each term's settings `F`: `XᵀF`, `FᵀF` of each setting side by side, `Fᵀy`.
    with: Vec<DMatrix<f64>>,
    own: Vec<DMatrix<f64>>,
    pulls: Vec<DVector<f64>>,
}

impl Sums {
    /// Settings come with the number of columns of each.
    fn of(columns: &DMatrix<f64>, residual: &DVector<f64>, settings: &[Settings]) -> Self {
        Self {
            gram: gram(columns),
            along: columns.tr_mul(residual),
            with: settings.iter().map(|(_, f)| cross(columns, f)).collect(),
            own: settings.iter().map(|(size, f)| grams(f, *size)).collect(),
            pulls: settings.iter().map(|(_, f)| f.tr_mul(residual)).collect(),
        }
    }

    fn less(&self, other: &Self) -> Self {
        let less =
            |a: &[DMatrix<f64>], b: &[DMatrix<f64>]| a.iter().zip(b).map(|(a, b)| a - b).collect();
        let pulls = self.pulls.iter().zip(&other.pulls);
        Self {
            gram: &self.gram - &other.gram,
            along: &self.along - &other.along,
            with: less(&self.with, &other.with),
            own: less(&self.own, &other.own),
            pulls: pulls.map(|(a, b)| a - b).collect(),
        }
    }
}

/// The products of so many columns with each other, then those of the next so many.
fn grams(columns: &DMatrix<f64>, size: usize) -> DMatrix<f64> {
    let mut all = DMatrix::zeros(size, columns.ncols());
    for first in (0..columns.ncols()).step_by(size) {
        let own = columns.columns(first, size);
        all.columns_mut(first, size).copy_from(&own.tr_mul(&own));
    }
    all
}

/// The columns that are fitted, at some places among all, in rows that stay.
struct Factor {
    places: Vec<usize>,
    /// Cholesky factor, row by row.
    lower: Vec<f64>,
}

impl Factor {
    fn of(gram: &DMatrix<f64>, places: Vec<usize>, least: &[f64]) -> Self {
        let k = places.len();
        let mut lower = vec![0.0; k * k];
        for (i, a) in places.iter().enumerate() {
            for (j, b) in places[..=i].iter().enumerate() {
                lower[i * k + j] = gram[(*a, *b)];
            }
        }
        let least: Vec<f64> = places.iter().map(|place| least[*place]).collect();
        small_cholesky(&mut lower, k, &least);
        Self { places, lower }
    }

    /// `L⁻¹` of columns.
    fn forward(&self, columns: &DMatrix<f64>) -> DMatrix<f64> {
        let mut own = columns.select_rows(&self.places);
        for mut column in own.column_iter_mut() {
            small_gain(&self.lower, self.places.len(), column.as_mut_slice());
        }
        own
    }

    /// The coefficients of all `width` columns; zero where the rows do not determine one.
    fn solve(&self, along: &DVector<f64>) -> DVector<f64> {
        let k = self.places.len();
        let mut own: Vec<f64> = self.places.iter().map(|place| along[*place]).collect();
        small_gain(&self.lower, k, &mut own);
        for i in (0..k).rev() {
            let known: f64 = (i + 1..k).map(|j| self.lower[j * k + i] * own[j]).sum();
            let pivot = self.lower[i * k + i];
            own[i] = if pivot > 0.0 {
                (own[i] - known) / pivot
            } else {
                0.0
            };
        }
        let mut all = DVector::zeros(along.len());
        for (place, value) in self.places.iter().zip(own) {
            all[*place] = value;
        }
        all
    }
}

impl Fitted {
    /// From a fit's whitened columns with their basis, its residual, and the terms that are scanned.
    pub(super) fn new(
        basis: &Basis,
        white: &DMatrix<f64>,
        residual: DVector<f64>,
        terms: Vec<Scanned>,
    ) -> Self {
        let columns = white.select_columns(&basis.kept);
        let settings = terms.iter().map(|t| (t.size(), t.white.clone()));
        let settings: Vec<Settings> = settings.collect();
        Self {
            all: Sums::of(&columns, &residual, &settings),
            kept: basis.kept.clone(),
            width: white.ncols(),
            least: basis
                .remaining_norms()
                .map(|left| rounding::COMPUTED * left * left)
                .collect(),
            columns,
            residual,
            terms,
        }
    }

    pub(super) fn terms(&self) -> &[Scanned] {
        &self.terms
    }

    /// Places of a term's columns among those that count.
    fn places(&self, first: usize, size: usize) -> Vec<usize> {
        let own = |k: &usize| (first..first + size).contains(&self.kept[*k]);
        (0..self.kept.len()).filter(own).collect()
    }

    fn without(&self, own: &[usize]) -> Vec<usize> {
        (0..self.kept.len()).filter(|k| !own.contains(k)).collect()
    }

    fn in_rows(&self, rows: &[usize]) -> (DMatrix<f64>, DVector<f64>, Vec<Settings>) {
        (
            self.columns.select_rows(rows),
            self.residual.select_rows(rows),
            self.terms
                .iter()
                .map(|t| (t.size(), t.white.select_rows(rows)))
                .collect(),
        )
    }

    /// The step of a fit without these rows, for all columns of the fit, and the terms with another setting.
    pub(super) fn step(&self, rows: &[usize]) -> (DVector<f64>, Vec<Exchanged>) {
        let (columns, residual, settings) = self.in_rows(rows);
        let out = Sums::of(&columns, &residual, &settings);
        let mut stay = self.all.less(&out);
        let mut taken = Vec::new();
        for at in 0..self.terms.len() {
            if let Some(setting) = self.better(at, &stay) {
                self.exchange(at, setting, &mut stay, &settings);
                taken.push((at, setting));
            }
        }
        let all = Factor::of(&stay.gram, self.without(&[]), &self.least);
        let solved = all.solve(&stay.along);
        let mut step = DVector::zeros(self.width);
        for (place, value) in self.kept.iter().zip(&solved) {
            step[*place] = *value;
        }
        let taken = taken.into_iter().map(|(at, setting)| {
            let (first, size) = (self.terms[at].first, self.terms[at].size());
            let own = step.rows(first, size).into_owned();
            step.rows_mut(first, size).fill(0.0);
            (at, setting, own)
        });
        let taken = taken.collect();
        (step, taken)
    }

    /// The setting with a larger gain than the fit's own, if there is one.
    fn better(&self, at: usize, stay: &Sums) -> Option<usize> {
        let term = &self.terms[at];
        let own = self.places(term.first, term.size());
        if own.len() < term.size() {
            return None;
        }
        let factor = Factor::of(&stay.gram, self.without(&own), &self.least);
        // The signal to be explained without the term.
        let of_own = stay.gram.select_columns(&own);
        let along = &stay.along + &of_own * &term.coefficients;
        let explained = factor.forward(&DMatrix::from_column_slice(
            along.len(),
            1,
            along.as_slice(),
        ));
        let gain = |gram: DMatrix<f64>, with: &DMatrix<f64>, pull: DVector<f64>| {
            let least: Vec<f64> = gram
                .diagonal()
                .iter()
                .map(|g| rounding::COMPUTED * g)
                .collect();
            let free = gram - with.tr_mul(with);
            let mut pull = pull - with.tr_mul(&explained).column(0);
            let mut lower = free.as_slice().to_vec();
            small_cholesky(&mut lower, least.len(), &least);
            small_gain(&lower, least.len(), pull.as_mut_slice())
        };
        let with = factor.forward(&of_own);
        let own_gain = gain(of_own.select_rows(&own), &with, along.select_rows(&own));
        let with = factor.forward(&stay.with[at]);
        let pulls = &stay.pulls[at] + stay.with[at].select_rows(&own).tr_mul(&term.coefficients);
        let mut best = (own_gain * (1.0 + rounding::COMPUTED), None);
        for setting in 0..term.candidates.len() {
            let (first, size) = term.columns(setting);
            let whole = stay.own[at].columns(first, size).into_owned();
            let with = with.columns(first, size).into_owned();
            let gain = gain(whole, &with, pulls.rows(first, size).into_owned());
            if gain > best.0 {
                best = (gain, Some(setting));
            }
        }
        best.1
    }

    /// Replaces the term's columns by those of a setting: the signal to be explained is then the residual of the fit
    /// plus the term's part of it.
    fn exchange(&self, at: usize, setting: usize, stay: &mut Sums, out: &[Settings]) {
        let term = &self.terms[at];
        let own = self.places(term.first, term.size());
        stay.along += stay.gram.select_columns(&own) * &term.coefficients;
        for (pull, with) in stay.pulls.iter_mut().zip(&stay.with) {
            *pull += with.select_rows(&own).tr_mul(&term.coefficients);
        }
        let (first, size) = term.columns(setting);
        let with = stay.with[at].columns(first, size).into_owned();
        for (k, place) in own.iter().enumerate() {
            stay.gram.set_column(*place, &with.column(k));
            stay.gram.set_row(*place, &with.column(k).transpose());
            stay.along[*place] = stay.pulls[at][first + k];
        }
        for (i, a) in own.iter().enumerate() {
            for (j, b) in own.iter().enumerate() {
                stay.gram[(*a, *b)] = stay.own[at][(i, first + j)];
            }
        }
        let [all, left_out] =
            [&term.white, &out[at].1].map(|f| f.columns(first, size).into_owned());
        for (other, with) in stay.with.iter_mut().enumerate() {
            let now = cross(&all, &self.terms[other].white) - cross(&left_out, &out[other].1);
            for (k, place) in own.iter().enumerate() {
                with.set_row(*place, &now.row(k));
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn wild(rows: usize, columns: usize, seed: f64) -> DMatrix<f64> {
        DMatrix::from_fn(rows, columns, |i, j| {
            ((i * i * 7 + i * j * 13 + j) as f64 * 0.37 + seed).sin()
        })
    }

    /// Two terms of two columns each with three others, each with three more settings; the signal to be fitted.
    fn fit() -> (DMatrix<f64>, DVector<f64>, Vec<Scanned>) {
        let a = wild(60, 7, 0.0);
        let settings = [wild(60, 6, 1.0), wild(60, 6, 3.0)];
        // The signal: the others, the first term at its setting, and the second at another one.
        let other = settings[1].columns(2, 2) * DVector::from_vec(vec![0.8, -1.1]);
        let noise = wild(60, 1, 5.0).column(0) * 0.05;
        let known = DVector::from_vec(vec![0.3, -0.2, 0.5, 1.0, 0.7, 0.0, 0.0]);
        let y = &a * known + other + noise;
        let coefficients = Basis::new(&a).solve(&y);
        let terms = [1, 5].into_iter().zip(settings);
        let terms = terms.map(|(first, white)| Scanned {
            first,
            coefficients: coefficients.rows(first, 2).into_owned(),
            candidates: vec![0, 1, 2],
            white,
        });
        let terms = terms.collect();
        (a, y, terms)
    }

    fn with(a: &DMatrix<f64>, term: &Scanned, setting: usize) -> DMatrix<f64> {
        let mut a = a.clone();
        let (first, size) = term.columns(setting);
        a.columns_mut(term.first, 2)
            .copy_from(&term.white.columns(first, size));
        a
    }

    #[test]
    fn settings_are_those_of_a_fit_of_the_rows_that_stay() {
        let (a, y, terms) = fit();
        let basis = Basis::new(&a);
        let fitted = Fitted::new(&basis, &a, basis.reject(&y), terms);
        let mut others = 0;
        for fold in 0..5 {
            let out: Vec<usize> = (0..60).filter(|row| row / 4 % 5 == fold).collect();
            let stay: Vec<usize> = (0..60).filter(|row| row / 4 % 5 != fold).collect();
            let (step, exchanged) = fitted.step(&out);
            // By brute force: each term in turn at the setting with the least residual of the remaining rows.
            let mut now = a.clone();
            let mut settings = Vec::new();
            for (at, term) in fitted.terms().iter().enumerate() {
                let left = |a: &DMatrix<f64>| {
                    let basis = Basis::new(&a.select_rows(&stay));
                    basis.reject(&y.select_rows(&stay)).norm_squared()
                };
                let of = |setting: usize| left(&with(&now, term, setting));
                let best = (0..3).min_by(|i, j| of(*i).total_cmp(&of(*j))).unwrap();
                if of(best) < left(&now) {
                    now = with(&now, term, best);
                    settings.push((at, best));
                }
            }
            let named: Vec<_> = exchanged.iter().map(|e| (e.0, e.1)).collect();
            assert_eq!(named, settings);
            others += settings.len();
            // The rows left out are predicted in the same way.
            let anew = Basis::new(&now.select_rows(&stay)).solve(&y.select_rows(&stay));
            let expected = now.select_rows(&out) * anew;
            let mut moved = basis.solve(&y) + &step;
            let mut predicted = DVector::zeros(out.len());
            for (at, setting, own) in &exchanged {
                let term = &fitted.terms()[*at];
                moved.rows_mut(term.first, 2).fill(0.0);
                let (first, size) = term.columns(*setting);
                predicted += term.white.columns(first, size).select_rows(&out) * own;
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
    fn a_column_that_the_rows_that_stay_do_not_tell_is_not_moved() {
        let (mut a, y, terms) = fit();
        for row in 10..60 {
            a[(row, 0)] = 0.0;
        }
        let basis = Basis::new(&a);
        let fitted = Fitted::new(&basis, &a, basis.reject(&y), terms);
        let out: Vec<usize> = (0..10).collect();
        assert_eq!(fitted.step(&out).0[0], 0.0);
    }
}
