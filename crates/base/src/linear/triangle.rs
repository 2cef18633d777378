//! Triangles: the inverse of one, and factors of matrices that are too small for a library's.

use nalgebra::{Cholesky, DMatrix, Dyn};

use crate::wide::{Loop, wide};

/// The inverse of a lower triangle.
pub fn inverse_of_lower(l: &DMatrix<f64>) -> DMatrix<f64> {
    let n = l.nrows();
    let mut inverse = DMatrix::identity(n, n);
    wide(Solving {
        l: l.as_slice(),
        columns: inverse.as_mut_slice(),
        n,
        of_one: true,
    });
    inverse
}

/// `L⁻¹ v` of a column that is zero before a place.
#[inline(always)]
#[allow(clippy::inline_always, reason = "see Loop")]
fn solve_one(l: &[f64], n: usize, own: &mut [f64], first: usize) {
    for i in first..n {
        let column = &l[i * n..(i + 1) * n];
        let x = own[i] / column[i];
        own[i] = x;
        for (value, l) in own[i + 1..].iter_mut().zip(&column[i + 1..]) {
            *value -= x * l;
        }
    }
}

/// The same of four columns: what is below is read and written once for four rows of the triangle, and loses its
/// parts in the same order.
#[inline(always)]
#[allow(clippy::inline_always, reason = "see Loop")]
fn solve_four(l: &[f64], n: usize, own: &mut [f64], first: usize) {
    let mut all = four_columns(own, n);
    let mut i = first;
    while i + 4 <= n {
        let rows: [&[f64]; 4] = std::array::from_fn(|k| &l[(i + k) * n..(i + k + 1) * n]);
        let mut by = [[0.0; 4]; 4];
        for (own, by) in all.iter_mut().zip(&mut by) {
            for k in 0..4 {
                let x = own[i + k] / rows[k][i + k];
                own[i + k] = x;
                by[k] = x;
                for below in k + 1..4 {
                    own[i + below] -= x * rows[k][i + below];
                }
            }
        }
        let below = all.each_mut().map(|own| &mut own[i + 4..]);
        take_from_four(below, rows.map(|row| &row[i + 4..]), by);
        i += 4;
    }
    for own in &mut all {
        solve_one(l, n, own, i);
    }
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "see Loop")]
fn four_columns(all: &mut [f64], height: usize) -> [&mut [f64]; 4] {
    let (two, others) = all.split_at_mut(2 * height);
    let ((a, b), (c, d)) = (two.split_at_mut(height), others.split_at_mut(height));
    [a, b, c, d]
}

/// Takes from four columns their parts of four others, from each one after the other.
#[inline(always)]
#[allow(clippy::inline_always, reason = "see Loop")]
fn take_from_four(own: [&mut [f64]; 4], others: [&[f64]; 4], by: [[f64; 4]; 4]) {
    let n = others[0].len();
    let [a, b, c, d] = others.map(|other| &other[..n]);
    let [v, w, x, y] = own.map(|own| &mut own[..n]);
    let whole = n - n % 8;
    for at in (0..whole).step_by(8) {
        let eight = at..at + 8;
        let others = [
            &a[eight.clone()],
            &b[eight.clone()],
            &c[eight.clone()],
            &d[eight.clone()],
        ];
        take_eight(&mut v[eight.clone()], others, by[0]);
        take_eight(&mut w[eight.clone()], others, by[1]);
        take_eight(&mut x[eight.clone()], others, by[2]);
        take_eight(&mut y[eight], others, by[3]);
    }
    for (own, by) in [v, w, x, y].into_iter().zip(by) {
        for k in whole..n {
            own[k] = (((own[k] - a[k] * by[0]) - b[k] * by[1]) - c[k] * by[2]) - d[k] * by[3];
        }
    }
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "see Loop")]
fn take_eight(own: &mut [f64], [a, b, c, d]: [&[f64]; 4], by: [f64; 4]) {
    // A loop, as a closure need not be inlined.
    let mut left = [0.0; 8];
    for k in 0..8 {
        left[k] = (((own[k] - a[k] * by[0]) - b[k] * by[1]) - c[k] * by[2]) - d[k] * by[3];
    }
    own.copy_from_slice(&left);
}

/// `L⁻¹ M` for a lower triangle without a zero on its diagonal, with the bits of nalgebra's.
pub fn solve_lower(l: &DMatrix<f64>, mut m: DMatrix<f64>) -> DMatrix<f64> {
    let n = l.nrows();
    debug_assert_eq!(n, m.nrows());
    wide(Solving {
        l: l.as_slice(),
        columns: m.as_mut_slice(),
        n,
        of_one: false,
    });
    m
}

struct Solving<'a> {
    l: &'a [f64],
    columns: &'a mut [f64],
    n: usize,
    /// The columns are those of the identity: before its own row a column is zero and stays it.
    of_one: bool,
}

impl Loop for Solving<'_> {
    type Output = ();

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "see Loop")]
    fn run(self) {
        let Self {
            l,
            columns,
            n,
            of_one,
        } = self;
        let mut fours = columns.chunks_exact_mut(4 * n.max(1));
        let mut first = 0;
        for four in &mut fours {
            solve_four(l, n, four, first);
            first += if of_one { 4 } else { 0 };
        }
        for own in fours.into_remainder().chunks_exact_mut(n.max(1)) {
            solve_one(l, n, own, first);
            first += usize::from(of_one);
        }
    }
}

/// The factor of a symmetric matrix, of which the lower half is looked at, with the bits of nalgebra's; `None` where
/// it is not positive.
pub fn cholesky(mut matrix: DMatrix<f64>) -> Option<Cholesky<f64, Dyn>> {
    let n = matrix.nrows();
    debug_assert_eq!(n, matrix.ncols());
    let values = matrix.as_mut_slice();
    wide(Factoring { values, n }).then(|| Cholesky::pack_dirty(matrix))
}

struct Factoring<'a> {
    values: &'a mut [f64],
    n: usize,
}

impl Loop for Factoring<'_> {
    type Output = bool;

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "see Loop")]
    fn run(self) -> bool {
        let Self { values, n } = self;
        // Four columns at once lose what those before them have, then each what the others have.
        let mut first = 0;
        while first < n {
            let count = (n - first).min(4);
            let (before, own) = values.split_at_mut(first * n);
            let own = &mut own[..count * n];
            if count == 4 {
                let mut own = four_columns(own, n);
                for four in before.chunks_exact(4 * n) {
                    let others = [0, 1, 2, 3].map(|k| &four[k * n + first..(k + 1) * n]);
                    let by = [0, 1, 2, 3].map(|j| others.map(|other| other[j]));
                    take_from_four(own.each_mut().map(|own| &mut own[first..]), others, by);
                }
            } else {
                for other in before.chunks_exact(n) {
                    for (j, own) in own.chunks_exact_mut(n).enumerate() {
                        take(&mut own[first + j..], &other[first + j..]);
                    }
                }
            }
            for j in 0..count {
                let (before, own) = own.split_at_mut(j * n);
                let own = &mut own[first + j..n];
                for other in before.chunks_exact(n) {
                    take(own, &other[first + j..]);
                }
                let root = own[0];
                if root.is_nan() || root <= 0.0 {
                    return false;
                }
                let root = root.sqrt();
                own[0] = root;
                for v in &mut own[1..] {
                    *v /= root;
                }
            }
            first += count;
        }
        true
    }
}

/// Takes from a column of a factor what one before it has of it.
#[inline(always)]
#[allow(clippy::inline_always, reason = "see Loop")]
fn take(own: &mut [f64], other: &[f64]) {
    let by = other[0];
    for (v, other) in own.iter_mut().zip(other) {
        *v -= other * by;
    }
}

/// Cholesky factor (lower, row by row) of a small symmetric matrix; a pivot below the tolerance
/// of its row is dropped: its row of the factor is zero.
pub fn small_cholesky(g: &mut [f64], k: usize, tolerance: &[f64]) -> usize {
    let mut rank = 0;
    for i in 0..k {
        for j in 0..=i {
            let mut sum = g[i * k + j];
            for l in 0..j {
                sum -= g[i * k + l] * g[j * k + l];
            }
            if i == j {
                if sum > tolerance[i] {
                    g[i * k + i] = sum.sqrt();
                    rank += 1;
                } else {
                    g[i * k + i] = 0.0;
                }
            } else {
                let pivot = g[j * k + j];
                g[i * k + j] = if pivot > 0.0 { sum / pivot } else { 0.0 };
            }
        }
    }
    rank
}

/// `‖L⁻¹ h‖²` for a factor of [`small_cholesky`]; overwrites `h` with `L⁻¹ h`.
pub fn small_gain(l: &[f64], k: usize, h: &mut [f64]) -> f64 {
    let mut gain = 0.0;
    for i in 0..k {
        let mut sum = h[i];
        for j in 0..i {
            sum -= l[i * k + j] * h[j];
        }
        let pivot = l[i * k + i];
        h[i] = if pivot > 0.0 { sum / pivot } else { 0.0 };
        gain += h[i] * h[i];
    }
    gain
}

#[cfg(test)]
mod tests {
    use nalgebra::DVector;

    use super::super::Basis;
    use super::*;

    #[test]
    fn the_inverse_of_a_triangle_is_its_inverse() {
        for n in [1, 4, 23] {
            let a = DMatrix::from_fn(40, n, |i, j| ((i * 7 + j * i * 13) as f64 * 0.37).sin());
            let gram = a.tr_mul(&a) + DMatrix::identity(n, n);
            let factor = gram.cholesky().unwrap();
            // What is above the diagonal is not looked at.
            let inverse = inverse_of_lower(factor.l_dirty());
            assert!((factor.l() * inverse - DMatrix::identity(n, n)).amax() < 1e-12);
        }
    }

    #[test]
    fn factor_and_inverse_have_the_bits_of_nalgebras() {
        for n in [0, 1, 3, 4, 9, 50] {
            let a = DMatrix::from_fn(60, n, |i, j| ((i * 7 + j * i * 13) as f64 * 0.37).sin());
            let gram = a.tr_mul(&a) + DMatrix::identity(n, n);
            let (own, theirs) = (
                cholesky(gram.clone()).unwrap(),
                gram.clone().cholesky().unwrap(),
            );
            assert_eq!(own.l(), theirs.l());
            let one = DMatrix::identity(n, n);
            let inverse = theirs.l().solve_lower_triangular(&one).unwrap();
            assert_eq!(inverse_of_lower(own.l_dirty()), inverse);
            let some = a.transpose();
            let solved = theirs.l().solve_lower_triangular(&some).unwrap();
            assert_eq!(solve_lower(own.l_dirty(), some), solved);
            if n > 0 {
                let mut not = gram;
                not[(n - 1, n - 1)] = f64::NAN;
                assert!(cholesky(not.clone()).is_none() && not.clone().cholesky().is_none());
                not[(n - 1, n - 1)] = -1.0;
                assert!(cholesky(not.clone()).is_none() && not.cholesky().is_none());
            }
        }
    }

    #[test]
    fn the_small_factor_gives_the_same_gain_as_the_basis() {
        let a = DMatrix::from_row_slice(4, 2, &[1., 0.5, 1., -1., 1., 2., 1., 3.]);
        let y = DVector::from_row_slice(&[1.0, 3.0, 2.0, 7.0]);
        let gram = a.tr_mul(&a);
        let mut g = vec![gram[(0, 0)], gram[(0, 1)], gram[(1, 0)], gram[(1, 1)]];
        let tolerance = [0.0; 2];
        assert_eq!(small_cholesky(&mut g, 2, &tolerance), 2);
        let h = a.tr_mul(&y);
        let gain = small_gain(&g, 2, &mut [h[0], h[1]]);
        let basis = Basis::new(&a);
        assert!((gain - (y.norm_squared() - basis.reject(&y).norm_squared())).abs() < 1e-10);
    }
}
