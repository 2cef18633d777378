//! Products of columns with wide vectors, each with the bits that nalgebra's scalar product has.

use nalgebra::{DMatrix, DVector};

use crate::wide::{Loop, wide};

/// Scalar product, in the order of nalgebra's: the same bits, with wide vectors.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    wide(Dot { a, b })
}

/// The length of a vector, with the bits that nalgebra's has.
pub(crate) fn norm(v: &[f64]) -> f64 {
    dot(v, v).sqrt()
}

/// The square of the distance between two vectors.
pub fn square_apart(a: &[f64], b: &[f64]) -> f64 {
    wide(Apart { a, b })
}

/// Some columns that lie side by side.
pub fn some_columns(a: &DMatrix<f64>, first: usize, count: usize) -> DMatrix<f64> {
    let height = a.nrows();
    let own = &a.as_slice()[first * height..(first + count) * height];
    DMatrix::from_vec(height, count, own.to_vec())
}

/// Rows of a Gram matrix that are made at once.
const GRAM_ROWS: usize = 48;

/// `Aᵀ A` of some columns: its lower half by blocks of rows, the other half is the same.
pub fn gram(a: &DMatrix<f64>) -> DMatrix<f64> {
    let p = a.ncols();
    let transposed = a.transpose();
    let mut gram = DMatrix::zeros(p, p);
    for first in (0..p).step_by(GRAM_ROWS) {
        let end = (first + GRAM_ROWS).min(p);
        let rows = transposed.rows(first, end - first);
        let mut block = gram.view_mut((first, 0), (end - first, end));
        block.gemm(1.0, &rows, &a.columns(0, end), 0.0);
    }
    gram.fill_upper_triangle_with_lower_triangle();
    gram
}

/// Columns whose products with each other are made at once: each of them is read once for all of the others.
const SQUARE: usize = 4;

/// `Aᵀ B` with the bits of `dot` for every product.
pub fn cross(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    let mut all = DMatrix::zeros(a.ncols(), b.ncols());
    wide(Cross {
        height: a.nrows().min(b.nrows()),
        a: a.as_slice(),
        b: b.as_slice(),
        out: all.as_mut_slice(),
        lower: false,
    });
    all
}

/// The lower half of `Aᵀ B` where that is symmetric, as [`cross`] has it; what is above the diagonal is not asked for.
pub fn lower_cross(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    let mut all = DMatrix::zeros(a.ncols(), b.ncols());
    wide(Cross {
        height: a.nrows().min(b.nrows()),
        a: a.as_slice(),
        b: b.as_slice(),
        out: all.as_mut_slice(),
        lower: true,
    });
    all
}

/// `Aᵀ A` with the bits of `dot` for every product.
pub fn own_products(a: &DMatrix<f64>) -> DMatrix<f64> {
    let p = a.ncols();
    let mut all = DMatrix::zeros(p, p);
    wide(Cross {
        height: a.nrows(),
        a: a.as_slice(),
        b: a.as_slice(),
        out: all.as_mut_slice(),
        lower: true,
    });
    all.fill_upper_triangle_with_lower_triangle();
    all
}

/// `Aᵀ v` with the bits of `dot` for every product.
pub fn along(a: &DMatrix<f64>, v: &DVector<f64>) -> DVector<f64> {
    let mut all = DVector::zeros(a.ncols());
    products(v.as_slice(), a.as_slice(), all.as_mut_slice());
    all
}

struct Cross<'a> {
    height: usize,
    a: &'a [f64],
    b: &'a [f64],
    out: &'a mut [f64],
    /// Only what is not above the diagonal, and what lies beside it.
    lower: bool,
}

impl Loop for Cross<'_> {
    type Output = ();

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "see Loop")]
    fn run(self) {
        let Self {
            height,
            a,
            b,
            out,
            lower,
        } = self;
        if height == 0 {
            return;
        }
        let (rows, columns) = (a.len() / height, b.len() / height);
        let of = |all: &'_ [f64], k: usize| -> std::ops::Range<usize> {
            debug_assert!((k + 1) * height <= all.len(), "one of the columns");
            k * height..(k + 1) * height
        };
        let whole = columns - columns % SQUARE;
        for j in (0..whole).step_by(SQUARE) {
            let four: [&[f64]; SQUARE] = std::array::from_fn(|k| &b[of(b, j + k)]);
            let first = if lower { j } else { 0 };
            let mut i = first;
            while i + SQUARE <= rows {
                let own: [&[f64]; SQUARE] = std::array::from_fn(|k| &a[of(a, i + k)]);
                let square = square_of_products(own, four);
                for (k, column) in square.iter().enumerate() {
                    let at = (j + k) * rows + i;
                    out[at..at + SQUARE].copy_from_slice(column);
                }
                i += SQUARE;
            }
            for i in i..rows {
                let one = four_products(&a[of(a, i)], four);
                for (k, product) in one.into_iter().enumerate() {
                    out[(j + k) * rows + i] = product;
                }
            }
        }
        for j in whole..columns {
            let first = if lower { j } else { 0 };
            for i in first..rows {
                let (a, b) = (&a[of(a, i)], &b[of(b, j)]);
                out[j * rows + i] = Dot { a, b }.run();
            }
        }
    }
}

/// The products of four columns with four others, a list for each of the others.
#[inline(always)]
#[allow(clippy::inline_always, reason = "see Loop")]
fn square_of_products(a: [&[f64]; SQUARE], b: [&[f64]; SQUARE]) -> [[f64; SQUARE]; SQUARE] {
    let n = a[0].len();
    let [a0, a1, a2, a3] = a.map(|column| &column[..n]);
    let [b0, b1, b2, b3] = b.map(|column| &column[..n]);
    // One by one, so that every sum stays in a vector.
    let none = [0.0; 8];
    let (mut s00, mut s10, mut s20, mut s30) = (none, none, none, none);
    let (mut s01, mut s11, mut s21, mut s31) = (none, none, none, none);
    let (mut s02, mut s12, mut s22, mut s32) = (none, none, none, none);
    let (mut s03, mut s13, mut s23, mut s33) = (none, none, none, none);
    let mut k = 0;
    while k + 8 <= n {
        let eight = k..k + 8;
        let (x0, x1) = (&a0[eight.clone()], &a1[eight.clone()]);
        let (x2, x3) = (&a2[eight.clone()], &a3[eight.clone()]);
        let y = &b0[eight.clone()];
        s00 = with_products(s00, x0, y);
        s10 = with_products(s10, x1, y);
        s20 = with_products(s20, x2, y);
        s30 = with_products(s30, x3, y);
        let y = &b1[eight.clone()];
        s01 = with_products(s01, x0, y);
        s11 = with_products(s11, x1, y);
        s21 = with_products(s21, x2, y);
        s31 = with_products(s31, x3, y);
        let y = &b2[eight.clone()];
        s02 = with_products(s02, x0, y);
        s12 = with_products(s12, x1, y);
        s22 = with_products(s22, x2, y);
        s32 = with_products(s32, x3, y);
        let y = &b3[eight];
        s03 = with_products(s03, x0, y);
        s13 = with_products(s13, x1, y);
        s23 = with_products(s23, x2, y);
        s33 = with_products(s33, x3, y);
        k += 8;
    }
    let rest = |sums: &[f64; 8], a: &[f64], b: &[f64]| {
        let pairs = a[k..].iter().zip(&b[k..]);
        pairs.fold(total(sums), |sum, (a, b)| sum + a * b)
    };
    let of = |sums: [&[f64; 8]; SQUARE], b: &[f64]| {
        let [s0, s1, s2, s3] = sums;
        [
            rest(s0, a0, b),
            rest(s1, a1, b),
            rest(s2, a2, b),
            rest(s3, a3, b),
        ]
    };
    [
        of([&s00, &s10, &s20, &s30], b0),
        of([&s01, &s11, &s21, &s31], b1),
        of([&s02, &s12, &s22, &s32], b2),
        of([&s03, &s13, &s23, &s33], b3),
    ]
}

/// Scalar products of a vector with columns, each with the bits of `dot`.
pub fn products(v: &[f64], columns: &[f64], out: &mut [f64]) {
    wide(Products { v, columns, out });
}

struct Products<'a> {
    v: &'a [f64],
    columns: &'a [f64],
    out: &'a mut [f64],
}

impl Loop for Products<'_> {
    type Output = ();

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "see Loop")]
    fn run(self) {
        let Self { v, columns, out } = self;
        let height = v.len().max(1);
        let count = out.len().min(columns.len() / height);
        let column = |k: usize| &columns[k * height..(k + 1) * height];
        let mut k = 0;
        while k + 4 <= count {
            let four = [column(k), column(k + 1), column(k + 2), column(k + 3)];
            out[k..k + 4].copy_from_slice(&four_products(v, four));
            k += 4;
        }
        for k in k..count {
            let (a, b) = (v, column(k));
            out[k] = Dot { a, b }.run();
        }
    }
}

/// Four at once: one sum alone waits for itself at every step.
#[inline(always)]
#[allow(clippy::inline_always, reason = "see Loop")]
fn four_products(v: &[f64], columns: [&[f64]; 4]) -> [f64; 4] {
    let n = v.len();
    let [a, b, c, d] = columns.map(|column| &column[..n]);
    let (mut sa, mut sb, mut sc, mut sd) = ([0.0; 8], [0.0; 8], [0.0; 8], [0.0; 8]);
    let mut k = 0;
    while k + 8 <= n {
        let eight = k..k + 8;
        let v = &v[eight.clone()];
        sa = with_products(sa, v, &a[eight.clone()]);
        sb = with_products(sb, v, &b[eight.clone()]);
        sc = with_products(sc, v, &c[eight.clone()]);
        sd = with_products(sd, v, &d[eight]);
        k += 8;
    }
    let rest = |sums: &[f64; 8], column: &[f64]| {
        let pairs = v[k..].iter().zip(&column[k..]);
        pairs.fold(total(sums), |sum, (a, b)| sum + a * b)
    };
    [rest(&sa, a), rest(&sb, b), rest(&sc, c), rest(&sd, d)]
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "see Loop")]
pub(super) fn with_products(sums: [f64; 8], a: &[f64], b: &[f64]) -> [f64; 8] {
    std::array::from_fn(|k| sums[k] + a[k] * b[k])
}

pub(super) struct Dot<'a> {
    pub(super) a: &'a [f64],
    pub(super) b: &'a [f64],
}

impl Loop for Dot<'_> {
    type Output = f64;

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "see Loop")]
    fn run(self) -> f64 {
        let mut sums = [0.0; 8];
        let (a, b) = (self.a.chunks_exact(8), self.b.chunks_exact(8));
        let rest = a.remainder().iter().zip(b.remainder());
        for (a, b) in a.zip(b) {
            for (sum, (a, b)) in sums.iter_mut().zip(a.iter().zip(b)) {
                *sum += a * b;
            }
        }
        rest.fold(total(&sums), |sum, (a, b)| sum + a * b)
    }
}

/// The running sums together. Not inlined: that they have to lie in memory side by side is what makes the
/// compiler keep them in one wide vector.
#[inline(never)]
pub(super) fn total(sums: &[f64; 8]) -> f64 {
    (0..4).fold(0.0, |sum, k| sum + (sums[k] + sums[k + 4]))
}

struct Apart<'a> {
    a: &'a [f64],
    b: &'a [f64],
}

impl Loop for Apart<'_> {
    type Output = f64;

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "see Loop")]
    fn run(self) -> f64 {
        let mut sums = [0.0; 8];
        let (a, b) = (self.a.chunks_exact(8), self.b.chunks_exact(8));
        let rest = a.remainder().iter().zip(b.remainder());
        for (a, b) in a.zip(b) {
            sums = std::array::from_fn(|k| sums[k] + (a[k] - b[k]) * (a[k] - b[k]));
        }
        rest.fold(total(&sums), |sum, (a, b)| sum + (a - b) * (a - b))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn products_have_the_bits_of_nalgebras() {
        let a = DMatrix::from_fn(203, 5, |i, j| ((i * 7 + j * 13) as f64 * 0.37).sin());
        let mut all = [0.0; 5];
        products(&a.as_slice()[..203], a.as_slice(), &mut all);
        assert_eq!(all, *a.tr_mul(&a.column(0)).as_slice());
        let (b, c) = (a.column(1), a.column(2));
        assert_eq!(
            dot(b.into_owned().as_slice(), c.into_owned().as_slice()),
            b.dot(&c)
        );
        let (b, c) = (b.into_owned(), c.into_owned());
        assert_eq!(norm(b.as_slice()), b.norm());
        let apart = square_apart(b.as_slice(), c.as_slice());
        assert!((apart - (&b - &c).norm_squared()).abs() < 1e-12);
        assert_eq!(some_columns(&a, 1, 3), a.columns(1, 3));
        // Of nine columns with six: squares, what is beside them, and what is below.
        let a = DMatrix::from_fn(203, 9, |i, j| ((i * 7 + j * i * 13) as f64 * 0.37).sin());
        let b = DMatrix::from_fn(203, 6, |i, j| ((i * 5 + j * i * 3) as f64 * 0.61).cos());
        assert_eq!(cross(&a, &b), a.tr_mul(&b));
        assert_eq!(own_products(&a), a.tr_mul(&a));
        let lower = lower_cross(&a, &b).lower_triangle();
        assert_eq!(lower, a.tr_mul(&b).lower_triangle());
        let v = b.column(2).into_owned();
        assert_eq!(along(&a, &v), a.tr_mul(&v));
    }

    #[test]
    fn a_gram_matrix_is_every_product() {
        for p in [1, GRAM_ROWS, 2 * GRAM_ROWS + 5] {
            let a = DMatrix::from_fn(71, p, |i, j| ((i * 7 + j * i * 13) as f64 * 0.37).sin());
            let gram = gram(&a);
            assert!((&gram - a.tr_mul(&a)).amax() < 1e-12);
            assert_eq!(gram, gram.transpose());
        }
    }
}
