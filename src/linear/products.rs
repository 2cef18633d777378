//! Products of columns with wide vectors, each with the bits that nalgebra's scalar product has.

use nalgebra::{DMatrix, DVector};

use crate::wide::{Loop, wide};

/// Scalar product, in the order of nalgebra's: the same bits, with wide vectors.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    wide(Dot { a, b })
}

/// Takes from `v` its parts along orthonormal columns, one after the other, and says how large each was.
pub(crate) fn reject(columns: &[f64], v: &mut [f64], parts: &mut [f64]) {
    wide(Rejecting { columns, v, parts });
}

/// Takes from `v` columns times their coefficients, one after the other.
pub(crate) fn subtract(columns: &[f64], coefficients: &[f64], v: &mut [f64]) {
    wide(Subtracting {
        columns,
        coefficients,
        v,
    });
}

/// The length of a vector, with the bits that nalgebra's has.
pub(crate) fn norm(v: &[f64]) -> f64 {
    dot(v, v).sqrt()
}

/// The square of the distance between two vectors.
pub(crate) fn square_apart(a: &[f64], b: &[f64]) -> f64 {
    wide(Apart { a, b })
}

/// Some columns that lie side by side.
pub(crate) fn some_columns(a: &DMatrix<f64>, first: usize, count: usize) -> DMatrix<f64> {
    let height = a.nrows();
    let own = &a.as_slice()[first * height..(first + count) * height];
    DMatrix::from_vec(height, count, own.to_vec())
}

/// The running sums of [`subtract_with_products`].
pub(crate) struct Sums(Vec<[f64; 8]>);

impl Sums {
    /// For so many columns at most.
    pub(crate) fn new(columns: usize) -> Self {
        Self(vec![[0.0; 8]; columns])
    }
}

/// Takes from `v` columns times their coefficients, one after the other, and says what products they then have with
/// it, or with another vector: the bits of [`subtract`] and [`products`], with each column read once.
pub(crate) fn subtract_with_products(
    columns: &[f64],
    coefficients: &[f64],
    v: &mut [f64],
    other: Option<&[f64]>,
    out: &mut [f64],
    sums: &mut Sums,
) {
    wide(SubtractingWithProducts {
        columns,
        coefficients,
        v,
        other,
        out,
        sums: &mut sums.0,
    });
}

/// Rows of a Gram matrix that are made at once.
const GRAM_ROWS: usize = 48;

/// `Aᵀ A` of some columns: its lower half by blocks of rows, the other half is the same.
pub(crate) fn gram(a: &DMatrix<f64>) -> DMatrix<f64> {
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

/// `Aᵀ B` with the bits of [`dot`] for every product.
pub(crate) fn cross(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
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
pub(crate) fn lower_cross(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
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

/// `Aᵀ A` with the bits of [`dot`] for every product.
pub(crate) fn own_products(a: &DMatrix<f64>) -> DMatrix<f64> {
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

/// `Aᵀ v` with the bits of [`dot`] for every product.
pub(crate) fn along(a: &DMatrix<f64>, v: &DVector<f64>) -> DVector<f64> {
    let mut all = DVector::zeros(a.ncols());
    products(v.as_slice(), a.as_slice(), all.as_mut_slice());
    all
}

/// Takes from columns what orthonormal ones span of them.
pub(crate) fn reject_all(q: &DMatrix<f64>, columns: &mut DMatrix<f64>) {
    let parts = cross(q, columns);
    if columns.ncols() > FEW {
        columns.gemm(-1.0, q, &parts, 1.0);
        return;
    }
    let height = q.nrows().max(1);
    let own = columns.as_mut_slice().chunks_exact_mut(height);
    for (own, parts) in own.zip(parts.column_iter()) {
        subtract(q.as_slice(), parts.as_slice(), own);
    }
}

/// A product of matrices puts all numbers of both in another order first: for so few columns that is most of it.
const FEW: usize = 8;

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

/// Scalar products of a vector with columns, each with the bits of [`dot`].
pub(crate) fn products(v: &[f64], columns: &[f64], out: &mut [f64]) {
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
fn with_products(sums: [f64; 8], a: &[f64], b: &[f64]) -> [f64; 8] {
    std::array::from_fn(|k| sums[k] + a[k] * b[k])
}

struct Dot<'a> {
    a: &'a [f64],
    b: &'a [f64],
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
fn total(sums: &[f64; 8]) -> f64 {
    (0..4).fold(0.0, |sum, k| sum + (sums[k] + sums[k + 4]))
}

/// Rows that are worked on at once: four wide vectors, in which they stay while all columns go over them.
const ROWS: usize = 32;

struct SubtractingWithProducts<'a> {
    columns: &'a [f64],
    coefficients: &'a [f64],
    v: &'a mut [f64],
    other: Option<&'a [f64]>,
    out: &'a mut [f64],
    sums: &'a mut [[f64; 8]],
}

impl Loop for SubtractingWithProducts<'_> {
    type Output = ();

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "see Loop")]
    fn run(self) {
        let Self {
            columns,
            coefficients,
            v,
            other,
            out,
            sums,
        } = self;
        let (height, count) = (v.len(), coefficients.len());
        if height == 0 || count == 0 {
            return;
        }
        let columns = &columns[..count * height];
        let (sums, out) = (&mut sums[..count], &mut out[..count]);
        sums.fill([0.0; 8]);
        let mut at = 0;
        while at + ROWS <= height {
            let own = &mut v[at..at + ROWS];
            let (mut v0, mut v1) = (eight(&own[..8]), eight(&own[8..16]));
            let (mut v2, mut v3) = (eight(&own[16..24]), eight(&own[24..]));
            for (column, by) in columns.chunks_exact(height).zip(coefficients) {
                let q = &column[at..at + ROWS];
                v0 = without_part(v0, &q[..8], *by);
                v1 = without_part(v1, &q[8..16], *by);
                v2 = without_part(v2, &q[16..24], *by);
                v3 = without_part(v3, &q[24..], *by);
            }
            own[..8].copy_from_slice(&v0);
            own[8..16].copy_from_slice(&v1);
            own[16..24].copy_from_slice(&v2);
            own[24..].copy_from_slice(&v3);
            if let Some(other) = other {
                let other = &other[at..at + ROWS];
                (v0, v1) = (eight(&other[..8]), eight(&other[8..16]));
                (v2, v3) = (eight(&other[16..24]), eight(&other[24..]));
            }
            for (column, sums) in columns.chunks_exact(height).zip(sums.iter_mut()) {
                let q = &column[at..at + ROWS];
                let mut own = *sums;
                own = with_products(own, &q[..8], &v0);
                own = with_products(own, &q[8..16], &v1);
                own = with_products(own, &q[16..24], &v2);
                own = with_products(own, &q[24..], &v3);
                *sums = own;
            }
            at += ROWS;
        }
        for (column, by) in columns.chunks_exact(height).zip(coefficients) {
            for (v, q) in v[at..].iter_mut().zip(&column[at..]) {
                *v -= q * by;
            }
        }
        let rest = match other {
            Some(other) => &other[at..height],
            None => &v[at..],
        };
        let columns = columns.chunks_exact(height);
        for ((column, sums), out) in columns.zip(sums.iter_mut()).zip(out) {
            let mut k = 0;
            let column = &column[at..];
            while k + 8 <= rest.len() {
                *sums = with_products(*sums, &column[k..k + 8], &rest[k..k + 8]);
                k += 8;
            }
            let pairs = column[k..].iter().zip(&rest[k..]);
            *out = pairs.fold(total(sums), |sum, (a, b)| sum + a * b);
        }
    }
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "see Loop")]
fn eight(v: &[f64]) -> [f64; 8] {
    std::array::from_fn(|k| v[k])
}

#[inline(always)]
#[allow(clippy::inline_always, reason = "see Loop")]
fn without_part(v: [f64; 8], column: &[f64], by: f64) -> [f64; 8] {
    std::array::from_fn(|k| v[k] - column[k] * by)
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

struct Rejecting<'a> {
    columns: &'a [f64],
    v: &'a mut [f64],
    parts: &'a mut [f64],
}

impl Loop for Rejecting<'_> {
    type Output = ();

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "see Loop")]
    fn run(self) {
        let columns = self.columns.chunks_exact(self.v.len().max(1));
        for (column, part) in columns.zip(self.parts) {
            *part = Dot {
                a: column,
                b: self.v,
            }
            .run();
            for (v, column) in self.v.iter_mut().zip(column) {
                *v -= column * *part;
            }
        }
    }
}

struct Subtracting<'a> {
    columns: &'a [f64],
    coefficients: &'a [f64],
    v: &'a mut [f64],
}

impl Loop for Subtracting<'_> {
    type Output = ();

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "see Loop")]
    fn run(self) {
        let Self {
            columns,
            coefficients,
            v,
        } = self;
        let height = v.len().max(1);
        let count = coefficients.len().min(columns.len() / height);
        let columns = &columns[..count * height];
        let coefficients = &coefficients[..count];
        // Four at once: the vector is read and written once for them, and each number loses its parts in the same
        // order.
        let (fours, of_fours) = (
            columns.chunks_exact(4 * height),
            coefficients.chunks_exact(4),
        );
        let (columns, coefficients) = (fours.remainder(), of_fours.remainder());
        for (four, of) in fours.zip(of_fours) {
            let (ab, cd) = four.split_at(2 * height);
            let ((a, b), (c, d)) = (ab.split_at(height), cd.split_at(height));
            let (ka, kb, kc, kd) = (of[0], of[1], of[2], of[3]);
            let rows = a.iter().zip(b).zip(c.iter().zip(d));
            for (v, ((a, b), (c, d))) in v.iter_mut().zip(rows) {
                *v = (((*v - a * ka) - b * kb) - c * kc) - d * kd;
            }
        }
        for (column, coefficient) in columns.chunks_exact(height).zip(coefficients) {
            for (v, column) in v.iter_mut().zip(column) {
                *v -= column * coefficient;
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::Basis;
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
        let mut left = a.column(4).into_owned();
        let mut own = left.clone();
        let coefficients = [0.3, -1.7];
        left.gemv(
            -1.0,
            &a.columns(0, 2),
            &DVector::from_column_slice(&coefficients),
            1.0,
        );
        subtract(&a.as_slice()[..406], &coefficients, own.as_mut_slice());
        assert_eq!(own, left);
        let five = [0.3, -1.7, 0.2, 2.5, -0.9];
        left.gemv(-1.0, &a, &DVector::from_column_slice(&five), 1.0);
        subtract(a.as_slice(), &five, own.as_mut_slice());
        assert_eq!(own, left);
        // Both at once, of the vector itself and of another one.
        for height in [0, 5, 32, 203] {
            let own = a.rows(0, height).into_owned();
            let (column, other) = (own.column(1).into_owned(), own.column(3).into_owned());
            for other in [None, Some(other.as_slice())] {
                let (mut expected, mut v) = (column.clone(), column.clone());
                subtract(own.as_slice(), &five, expected.as_mut_slice());
                let (mut parts, mut out) = ([0.0; 5], [0.0; 5]);
                products(
                    other.unwrap_or(expected.as_slice()),
                    own.as_slice(),
                    &mut parts,
                );
                let sums = &mut Sums::new(5);
                subtract_with_products(
                    own.as_slice(),
                    &five,
                    v.as_mut_slice(),
                    other,
                    &mut out,
                    sums,
                );
                assert_eq!((v, out), (expected, parts));
            }
            assert_eq!(norm(column.as_slice()), column.norm());
            let apart = square_apart(column.as_slice(), other.as_slice());
            assert!((apart - (column - other).norm_squared()).abs() < 1e-12);
        }
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
        // Few columns and many.
        let q = Basis::new(&b).q;
        for width in [2, 9] {
            let mut free = a.columns(0, width).into_owned();
            reject_all(&q, &mut free);
            assert!(q.tr_mul(&free).amax() < 1e-12 * a.norm());
            assert!((a.columns(0, width) - &free).norm() > 0.1);
        }
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
