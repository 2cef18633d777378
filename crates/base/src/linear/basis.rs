//! An orthonormal basis by Gram–Schmidt, done twice ("twice is
//! enough", Giraud, Langou & Rozložník 2005), which drops columns that the ones before them already
//! explain.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use super::products::{along, norm, products};
use super::subtraction::{Sums, subtract, subtract_with_products};

/// A column of which less than this share is left after projection is a copy of the others.
const DEPENDENT: f64 = 1e-6;

/// `A = Q R` on the columns that are independent.
#[derive(Debug, Clone)]
pub struct Basis {
    /// Orthonormal columns.
    pub q: DMatrix<f64>,
    /// Upper triangular, one column for each kept column of `A`.
    r: DMatrix<f64>,
    /// Which columns of `A` were kept, in order.
    pub kept: Vec<usize>,
    columns: usize,
    /// The basis that its first columns are.
    pub extends: Option<Arc<Self>>,
}

/// A basis that still grows.
struct Growing {
    /// Orthonormal columns, one after the other.
    q: Vec<f64>,
    r: DMatrix<f64>,
    kept: Vec<usize>,
}

impl Growing {
    /// Takes some columns of a matrix more. The products of the next column come with the last step of the one
    /// before it, while the orthonormal columns are near the processor.
    fn orthogonalize(&mut self, a: &DMatrix<f64>, which: impl Iterator<Item = usize>) {
        let (m, p) = a.shape();
        let column = |k: usize| &a.as_slice()[k * m..(k + 1) * m];
        let (mut parts, mut again) = (vec![0.0; p], vec![0.0; p]);
        let mut sums = Sums::new(p);
        let mut which = which.peekable();
        if let (Some(first), false) = (which.peek(), self.kept.is_empty()) {
            products(column(*first), &self.q, &mut parts[..self.kept.len()]);
        }
        while let Some(own) = which.next() {
            let rank = self.kept.len();
            if rank >= m {
                return;
            }
            let next = which.peek().map(|next| column(*next));
            let before = norm(column(own));
            self.q.extend_from_slice(column(own));
            let (q, v) = self.q.split_at_mut(rank * m);
            subtract_with_products(q, &parts[..rank], v, None, &mut again, &mut sums);
            for (k, (first, second)) in parts.iter().zip(&again).take(rank).enumerate() {
                self.r[(k, rank)] = first + second;
            }
            if next.is_some() {
                subtract_with_products(q, &again[..rank], v, next, &mut parts, &mut sums);
            } else {
                subtract(q, &again[..rank], v);
            }
            let norm = norm(v);
            if norm > DEPENDENT * before && norm > 0.0 {
                for value in v.iter_mut() {
                    *value /= norm;
                }
                if let Some(next) = next {
                    products(next, v, &mut parts[rank..=rank]);
                }
                self.r[(rank, rank)] = norm;
                self.kept.push(own);
            } else {
                self.q.truncate(rank * m);
            }
        }
    }

    fn end(mut self, a: &DMatrix<f64>, extends: Option<Arc<Basis>>) -> Basis {
        let (m, columns) = a.shape();
        let rank = self.kept.len();
        self.q.shrink_to_fit();
        Basis {
            q: DMatrix::from_vec(m, rank, self.q),
            r: self.r.view((0, 0), (rank, rank)).into_owned(),
            kept: self.kept,
            columns,
            extends,
        }
    }
}

impl Basis {
    /// Takes a matrix apart.
    pub fn new(a: &DMatrix<f64>) -> Self {
        let (m, p) = a.shape();
        let mut growing = Growing {
            q: Vec::with_capacity(m * p),
            r: DMatrix::zeros(p, p),
            kept: Vec::new(),
        };
        growing.orthogonalize(a, 0..p);
        growing.end(a, None)
    }

    /// Takes a matrix apart of which some columns, those of another basis in their order, are known.
    pub fn extending(known: &Arc<Self>, own: &[usize], a: &DMatrix<f64>) -> Self {
        let (m, p) = a.shape();
        let rank = known.rank();
        let mut growing = Growing {
            q: Vec::with_capacity(m * p.max(rank)),
            r: DMatrix::zeros(p, p),
            kept: known.kept.iter().map(|k| own[*k]).collect(),
        };
        growing.q.extend_from_slice(known.q.as_slice());
        growing.r.view_mut((0, 0), (rank, rank)).copy_from(&known.r);
        growing.orthogonalize(a, (0..p).filter(|k| !own.contains(k)));
        growing.end(a, Some(Arc::clone(known)))
    }

    /// Number of independent columns.
    pub fn rank(&self) -> usize {
        self.kept.len()
    }

    /// The coefficients that bring `A x` closest to `y`; zero for columns that were dropped.
    pub fn solve(&self, y: &DVector<f64>) -> DVector<f64> {
        self.coefficients(along(&self.q, y))
    }

    /// The coefficients of the columns from those of the orthonormal ones; zero for columns that were
    /// dropped.
    pub fn coefficients(&self, mut along: DVector<f64>) -> DVector<f64> {
        self.back_substitute(&mut along);
        self.spread(&along)
    }

    /// `y` without its part in the span.
    pub fn reject(&self, y: &DVector<f64>) -> DVector<f64> {
        let along = along(&self.q, y);
        y - &self.q * along
    }

    /// `(Aᵀ A)⁻¹` on the kept columns; zero elsewhere.
    pub fn inverse_gram(&self) -> DMatrix<f64> {
        let rank = self.rank();
        let mut inverse_r = DMatrix::identity(rank, rank);
        for k in 0..rank {
            let mut column = inverse_r.column(k).into_owned();
            self.back_substitute(&mut column);
            inverse_r.set_column(k, &column);
        }
        let own = &inverse_r * inverse_r.transpose();
        let mut all = DMatrix::zeros(self.columns, self.columns);
        for (i, a) in self.kept.iter().enumerate() {
            for (j, b) in self.kept.iter().enumerate() {
                all[(*a, *b)] = own[(i, j)];
            }
        }
        all
    }

    /// What some columns of `A` alone span: `c`, with `Q c` orthonormal and orthogonal to all other columns, and
    /// `(Q c)ᵀ A` of those columns. `None` where the others span all of it.
    ///
    /// The columns of `R⁻ᵀ` are dual to those of `A`.
    pub fn only_of(&self, own: &[usize]) -> Option<(DMatrix<f64>, DMatrix<f64>)> {
        let rank = self.rank();
        let at: Vec<usize> = (0..rank).filter(|k| own.contains(&self.kept[*k])).collect();
        if at.is_empty() {
            return None;
        }
        let mut directions = DMatrix::zeros(rank, at.len());
        for (place, unit) in at.iter().enumerate() {
            let mut dual = vec![0.0; rank];
            for row in *unit..rank {
                let one = if row == *unit { 1.0 } else { 0.0 };
                let column = self.r.column(row);
                let known: f64 = (*unit..row).map(|j| column[j] * dual[j]).sum();
                dual[row] = (one - known) / column[row];
            }
            let mut dual = DVector::from_vec(dual);
            for _ in 0..2 {
                for before in 0..place {
                    let along = directions.column(before).dot(&dual);
                    dual.axpy(-along, &directions.column(before), 1.0);
                }
            }
            let norm = dual.norm();
            directions.set_column(place, &(dual / norm.max(1e-300)));
        }
        let mut parts = DMatrix::zeros(at.len(), own.len());
        for unit in &at {
            let along = directions.tr_mul(&self.r.column(*unit));
            let place = own.iter().position(|k| *k == self.kept[*unit]);
            let Some(place) = place else { continue };
            parts.set_column(place, &along);
        }
        Some((directions, parts))
    }

    /// Share of row `i` that the fit explains by itself.
    pub fn leverage(&self, row: usize) -> f64 {
        self.q.row(row).norm_squared()
    }

    fn back_substitute(&self, x: &mut DVector<f64>) {
        for k in (0..self.rank()).rev() {
            let known: f64 = (k + 1..self.rank()).map(|j| self.r[(k, j)] * x[j]).sum();
            x[k] = (x[k] - known) / self.r[(k, k)];
        }
    }

    fn spread(&self, x: &DVector<f64>) -> DVector<f64> {
        let mut all = DVector::zeros(self.columns);
        for (value, column) in x.iter().zip(&self.kept) {
            all[*column] = *value;
        }
        all
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_basis_that_extends_another_is_as_good() {
        let a = DMatrix::from_fn(50, 6, |i, j| ((i * i * 7 + i * j * 13) as f64 * 0.37).sin());
        let own = [1, 2, 5];
        let known = Arc::new(Basis::new(&a.select_columns(&own)));
        let (whole, extended) = (Basis::new(&a), Basis::extending(&known, &own, &a));
        let y = DVector::from_fn(50, |i, _| (i as f64).cos());
        assert!((whole.solve(&y) - extended.solve(&y)).norm() < 1e-9);
        assert!((whole.reject(&y) - extended.reject(&y)).norm() < 1e-9);
        assert!((whole.inverse_gram() - extended.inverse_gram()).norm() < 1e-9);
        assert_eq!(extended.q.columns(0, 3), known.q.columns(0, 3));
        // A copy of what is known is dropped.
        let mut twice = a.clone();
        twice.set_column(0, &a.column(5));
        assert_eq!(Basis::extending(&known, &own, &twice).kept, [1, 2, 5, 3, 4]);
    }

    /// One column after the other, each by products with all before it and taking these from it, twice.
    #[test]
    fn it_has_the_bits_of_gram_schmidt_step_by_step() {
        for (m, p) in [(203, 9), (32, 5), (70, 70), (5, 9), (0, 3)] {
            let mut a = DMatrix::from_fn(m, p, |i, j| ((i * 7 + j * i * 13) as f64 * 0.37).sin());
            if m > 40 {
                let copy = a.column(1) * 2.0;
                a.set_column(3, &copy);
            }
            let basis = Basis::new(&a);
            let mut q: Vec<DVector<f64>> = Vec::new();
            for (k, column) in a.column_iter().enumerate() {
                let mut v = column.into_owned();
                let mut r = vec![0.0; q.len()];
                for _ in 0..2 {
                    let parts: Vec<f64> = q.iter().map(|q| q.dot(&v)).collect();
                    for ((q, part), r) in q.iter().zip(parts).zip(&mut r) {
                        v.axpy(-part, q, 1.0);
                        *r += part;
                    }
                }
                if !basis.kept.contains(&k) {
                    continue;
                }
                r.push(v.norm());
                assert_eq!(r, basis.r.column(q.len()).as_slice()[..=q.len()]);
                q.push(&v / v.norm());
            }
            assert_eq!(q.len(), basis.rank());
            assert_eq!(basis.kept.contains(&3), m <= 40 && m > 0);
            assert!(q.iter().zip(basis.q.column_iter()).all(|(a, b)| *a == b));
        }
    }

    #[test]
    fn a_repeated_column_is_dropped_and_the_rest_still_solves() {
        let a = DMatrix::from_row_slice(4, 3, &[1., 2., 0., 1., 2., 1., 1., 2., 2., 1., 2., 3.]);
        let basis = Basis::new(&a);
        assert_eq!(basis.kept, [0, 2]);
        let y = DVector::from_row_slice(&[1.0, 3.0, 5.0, 7.0]);
        let x = basis.solve(&y);
        assert!((x - DVector::from_row_slice(&[1.0, 0.0, 2.0])).norm() < 1e-12);
        assert!(basis.reject(&y).norm() < 1e-12);
    }
}
