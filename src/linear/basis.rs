//! An orthonormal basis by Gram–Schmidt, done twice ("twice is enough", Giraud, Langou & Rozložník 2005) for
//! columns of which the first time leaves little (Daniel, Gragg, Kaufman & Stewart 1976), which drops columns that the
//! ones before them already explain.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use super::products::{along, norm, products};
use super::subtraction::{Sums, reject_all, subtract, subtract_with_products};

/// A column of which less than this share is left after projection is a copy of the others.
const DEPENDENT: f64 = 1e-6;
/// A column of which at least this share is left is orthogonal to the others but for ten times the rounding of a
/// number: once is enough.
const ONCE: f64 = 0.1;

/// `A = Q R` on the columns that are independent.
#[derive(Debug, Clone)]
pub(crate) struct Basis {
    /// Orthonormal columns.
    pub(crate) q: DMatrix<f64>,
    /// Upper triangular, one column for each kept column of `A`.
    r: DMatrix<f64>,
    /// Which columns of `A` were kept, in order.
    pub(crate) kept: Vec<usize>,
    columns: usize,
    /// The basis that its first columns are.
    pub(crate) extends: Option<Arc<Self>>,
}

/// Columns that a basis has to take.
struct More<'c> {
    /// Without what the basis had of them before.
    columns: &'c DMatrix<f64>,
    /// How much that was.
    known: DMatrix<f64>,
    /// How long they were.
    before: Vec<f64>,
    /// Which they are of a matrix.
    which: Vec<usize>,
}

/// A basis that still grows.
struct Growing {
    /// Orthonormal columns, one after the other.
    q: Vec<f64>,
    r: DMatrix<f64>,
    kept: Vec<usize>,
}

impl Growing {
    /// Takes columns more. The products of the next one come with the step of the one before it, while the orthonormal
    /// columns are near the processor.
    fn orthogonalize(&mut self, some: &More) {
        let m = some.columns.nrows();
        let free_of = some.known.nrows();
        let column = |k: usize| &some.columns.as_slice()[k * m..(k + 1) * m];
        let count = some.columns.ncols();
        let (mut parts, mut of_next) = (vec![0.0; count], vec![0.0; count]);
        let mut again = vec![0.0; free_of + count];
        let mut sums = Sums::new(count);
        for k in 0..count {
            let rank = self.kept.len();
            if rank >= m {
                return;
            }
            let more = rank - free_of;
            let next = (k + 1 < count).then(|| column(k + 1));
            self.q.extend_from_slice(column(k));
            let (q, v) = self.q.split_at_mut(rank * m);
            let own = &q[free_of * m..];
            if let Some(next) = next {
                subtract_with_products(own, &parts[..more], v, next, &mut of_next, &mut sums);
            } else {
                subtract(own, &parts[..more], v);
            }
            let mut r = self.r.column_mut(rank);
            r.rows_mut(0, free_of).copy_from(&some.known.column(k));
            r.rows_mut(free_of, more).copy_from_slice(&parts[..more]);
            let mut left = norm(v);
            if left < ONCE * some.before[k] {
                products(v, q, &mut again[..rank]);
                subtract(q, &again[..rank], v);
                for (r, more) in r.iter_mut().zip(&again[..rank]) {
                    *r += more;
                }
                left = norm(v);
            }
            std::mem::swap(&mut parts, &mut of_next);
            if left > DEPENDENT * some.before[k] && left > 0.0 {
                for value in v.iter_mut() {
                    *value /= left;
                }
                if let Some(next) = next {
                    products(next, v, &mut parts[more..=more]);
                }
                r[rank] = left;
                self.kept.push(some.which[k]);
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
    pub(crate) fn new(a: &DMatrix<f64>) -> Self {
        let (m, p) = a.shape();
        let mut growing = Growing {
            q: Vec::with_capacity(m * p),
            r: DMatrix::zeros(p, p),
            kept: Vec::new(),
        };
        growing.orthogonalize(&More {
            columns: a,
            known: DMatrix::zeros(0, p),
            before: lengths(a),
            which: (0..p).collect(),
        });
        growing.end(a, None)
    }

    /// Takes a matrix apart of which some columns, those of another basis in their order, are known.
    pub(crate) fn extending(known: &Arc<Self>, own: &[usize], a: &DMatrix<f64>) -> Self {
        let (m, p) = a.shape();
        let rank = known.rank();
        let mut growing = Growing {
            q: Vec::with_capacity(m * p.max(rank)),
            r: DMatrix::zeros(p, p),
            kept: known.kept.iter().map(|k| own[*k]).collect(),
        };
        growing.q.extend_from_slice(known.q.as_slice());
        growing.r.view_mut((0, 0), (rank, rank)).copy_from(&known.r);
        // What is known is taken from all the others at once.
        let which: Vec<usize> = (0..p).filter(|k| !own.contains(k)).collect();
        let mut columns = Vec::with_capacity(m * which.len());
        for k in &which {
            columns.extend_from_slice(&a.as_slice()[k * m..(k + 1) * m]);
        }
        let mut columns = DMatrix::from_vec(m, which.len(), columns);
        let before = lengths(&columns);
        let parts = reject_all(&known.q, &mut columns);
        growing.orthogonalize(&More {
            columns: &columns,
            known: parts,
            before,
            which,
        });
        growing.end(a, Some(Arc::clone(known)))
    }

    /// Number of independent columns.
    pub(crate) fn rank(&self) -> usize {
        self.kept.len()
    }

    /// The coefficients that bring `A x` closest to `y`; zero for columns that were dropped.
    pub(crate) fn solve(&self, y: &DVector<f64>) -> DVector<f64> {
        self.coefficients(along(&self.q, y))
    }

    /// The coefficients of the columns from those of the orthonormal ones; zero for columns that were
    /// dropped.
    pub(crate) fn coefficients(&self, mut along: DVector<f64>) -> DVector<f64> {
        self.back_substitute(&mut along);
        self.spread(&along)
    }

    /// `y` without its part in the span.
    pub(crate) fn reject(&self, y: &DVector<f64>) -> DVector<f64> {
        let along = along(&self.q, y);
        y - &self.q * along
    }

    /// `(Aᵀ A)⁻¹` on the kept columns; zero elsewhere.
    pub(crate) fn inverse_gram(&self) -> DMatrix<f64> {
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
    pub(crate) fn only_of(&self, own: &[usize]) -> Option<(DMatrix<f64>, DMatrix<f64>)> {
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
    pub(crate) fn leverage(&self, row: usize) -> f64 {
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

/// The length of each column.
fn lengths(a: &DMatrix<f64>) -> Vec<f64> {
    let columns = a.as_slice().chunks_exact(a.nrows().max(1));
    columns.map(norm).collect()
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

    /// One column after the other, each by products with all before it and taking these from it, twice where little
    /// is left.
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
                for time in 0..2 {
                    if time == 1 && v.norm() >= ONCE * column.norm() {
                        break;
                    }
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
