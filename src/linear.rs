//! Least squares on explicit columns: an orthonormal basis by Gram–Schmidt, done twice ("twice is
//! enough", Giraud, Langou & Rozložník 2005), which drops columns that the ones before them already
//! explain.

use std::sync::Arc;

use nalgebra::{DMatrix, DVector};

use crate::wide::{Loop, wide};

/// A column of which less than this share is left after projection is a copy of the others.
const DEPENDENT: f64 = 1e-6;

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

impl Basis {
    /// Takes a matrix apart.
    pub(crate) fn new(a: &DMatrix<f64>) -> Self {
        let (m, p) = a.shape();
        let mut basis = Self {
            q: DMatrix::zeros(m, p),
            r: DMatrix::zeros(p, p),
            kept: Vec::new(),
            columns: p,
            extends: None,
        };
        for column in 0..p {
            basis.take(column, a.column(column).into_owned());
        }
        basis.end()
    }

    /// Takes a matrix apart of which some columns, those of another basis in their order, are known.
    pub(crate) fn extending(known: &Arc<Self>, own: &[usize], a: &DMatrix<f64>) -> Self {
        let (m, p) = a.shape();
        let rank = known.rank();
        let mut basis = Self {
            q: DMatrix::zeros(m, p),
            r: DMatrix::zeros(p, p),
            kept: known.kept.iter().map(|k| own[*k]).collect(),
            columns: p,
            extends: Some(Arc::clone(known)),
        };
        basis.q.columns_mut(0, rank).copy_from(&known.q);
        basis.r.view_mut((0, 0), (rank, rank)).copy_from(&known.r);
        for column in (0..p).filter(|k| !own.contains(k)) {
            basis.take(column, a.column(column).into_owned());
        }
        basis.end()
    }

    /// Takes one column more.
    fn take(&mut self, column: usize, mut v: DVector<f64>) {
        let m = self.q.nrows();
        let rank = self.kept.len();
        if rank >= m {
            return;
        }
        let before = v.norm();
        let own = &self.q.as_slice()[..rank * m];
        let mut parts = vec![0.0; rank];
        let mut r = vec![0.0; rank];
        for _ in 0..2 {
            products(v.as_slice(), own, &mut parts);
            subtract(own, &parts, v.as_mut_slice());
            for (r, part) in r.iter_mut().zip(&parts) {
                *r += part;
            }
        }
        let norm = v.norm();
        if norm > DEPENDENT * before && norm > 0.0 {
            self.r.view_mut((0, rank), (rank, 1)).copy_from_slice(&r);
            self.r[(rank, rank)] = norm;
            self.q.set_column(rank, &(v / norm));
            self.kept.push(column);
        }
    }

    fn end(mut self) -> Self {
        let rank = self.kept.len();
        self.q = self.q.resize_horizontally(rank, 0.0);
        self.r = self.r.view((0, 0), (rank, rank)).into_owned();
        self
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

/// Makes the lower half of a symmetric matrix its Cholesky factor; whether it has one. What is above the diagonal
/// stays. The operations and their order are those of nalgebra's, with wide vectors.
#[must_use]
pub(crate) fn cholesky(m: &mut DMatrix<f64>) -> bool {
    let n = m.nrows();
    wide(Factoring {
        m: m.as_mut_slice(),
        n,
    })
}

/// The inverse of a lower triangle.
pub(crate) fn inverse_of_lower(l: &DMatrix<f64>) -> DMatrix<f64> {
    let n = l.nrows();
    let mut inverse = DMatrix::identity(n, n);
    wide(Inverting {
        l: l.as_slice(),
        inverse: inverse.as_mut_slice(),
        n,
    });
    inverse
}

struct Factoring<'a> {
    m: &'a mut [f64],
    n: usize,
}

impl Loop for Factoring<'_> {
    type Output = bool;

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "see Loop")]
    fn run(self) -> bool {
        let Self { m, n } = self;
        for j in 0..n {
            let (before, own) = m.split_at_mut(j * n);
            let own = &mut own[j..n];
            let column = |k: usize| &before[k * n + j..(k + 1) * n];
            let mut k = 0;
            while k + 4 <= j {
                take_four(
                    own,
                    [column(k), column(k + 1), column(k + 2), column(k + 3)],
                );
                k += 4;
            }
            for k in k..j {
                let column = column(k);
                let factor = column[0];
                for (own, column) in own.iter_mut().zip(column) {
                    *own -= factor * column;
                }
            }
            let pivot = own[0];
            if pivot.is_nan() || pivot <= 0.0 {
                return false;
            }
            let pivot = pivot.sqrt();
            own[0] = pivot;
            for own in &mut own[1..] {
                *own /= pivot;
            }
        }
        true
    }
}

/// Takes from a column four others, each times its first number.
#[inline(always)]
#[allow(clippy::inline_always, reason = "see Loop")]
fn take_four(own: &mut [f64], columns: [&[f64]; 4]) {
    let [a, b, c, d] = columns;
    let (ka, kb, kc, kd) = (a[0], b[0], c[0], d[0]);
    let rows = a.iter().zip(b).zip(c.iter().zip(d));
    for (own, ((a, b), (c, d))) in own.iter_mut().zip(rows) {
        *own = (((*own - ka * a) - kb * b) - kc * c) - kd * d;
    }
}

struct Inverting<'a> {
    l: &'a [f64],
    inverse: &'a mut [f64],
    n: usize,
}

impl Loop for Inverting<'_> {
    type Output = ();

    #[inline(always)]
    #[allow(clippy::inline_always, reason = "see Loop")]
    fn run(self) {
        let Self { l, inverse, n } = self;
        for (first, own) in inverse.chunks_exact_mut(n.max(1)).enumerate() {
            for i in first..n {
                let column = &l[i * n..(i + 1) * n];
                let x = own[i] / column[i];
                own[i] = x;
                for (value, l) in own[i + 1..].iter_mut().zip(&column[i + 1..]) {
                    *value -= x * l;
                }
            }
        }
    }
}

/// Cholesky factor (lower, row by row) of a small symmetric matrix; a pivot below the tolerance
/// of its row is dropped: its row of the factor is zero.
pub(crate) fn small_cholesky(g: &mut [f64], k: usize, tolerance: &[f64]) -> usize {
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
pub(crate) fn small_gain(l: &[f64], k: usize, h: &mut [f64]) -> f64 {
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

/// Orthonormal columns, added one by one.
pub(crate) struct Kept {
    rows: usize,
    q: Vec<DVector<f64>>,
    /// For each: which it is, and its parts along those before it and itself.
    kept: Vec<(usize, Vec<f64>)>,
}

impl Kept {
    pub(crate) fn new(rows: usize) -> Self {
        Self {
            rows,
            q: Vec::new(),
            kept: Vec::new(),
        }
    }

    /// What is left of a column.
    pub(crate) fn reject(&self, column: &DVector<f64>) -> DVector<f64> {
        let mut left = column.clone();
        if self.q.len() >= self.rows {
            left.fill(0.0);
        }
        let mut part = [0.0];
        for _ in 0..2 {
            for q in &self.q {
                reject(q.as_slice(), left.as_mut_slice(), &mut part);
            }
        }
        left
    }

    pub(crate) fn push(&mut self, index: usize, column: &DVector<f64>, free: &DVector<f64>) {
        let q = free / free.norm();
        let mut along = self.along(column);
        along.push(dot(q.as_slice(), column.as_slice()));
        self.q.push(q);
        self.kept.push((index, along));
    }

    fn along(&self, column: &DVector<f64>) -> Vec<f64> {
        let one = |q: &DVector<f64>| dot(q.as_slice(), column.as_slice());
        self.q.iter().map(one).collect()
    }

    /// How much of each kept column a dependent one is made of.
    pub(crate) fn parts(&self, column: &DVector<f64>) -> Vec<(usize, f64)> {
        let mut parts = self.along(column);
        for k in (0..parts.len()).rev() {
            let (earlier, along) = self.kept[k].1.split_at(k);
            parts[k] /= along[0];
            let value = parts[k];
            for (part, r) in parts.iter_mut().zip(earlier) {
                *part -= r * value;
            }
        }
        let kept = self.kept.iter().map(|k| k.0);
        kept.zip(parts).collect()
    }

    /// Takes a column in the place of another that was kept.
    pub(crate) fn exchange(
        &mut self,
        out: usize,
        new: usize,
        column: &DVector<f64>,
        of: impl Fn(usize) -> DVector<f64>,
    ) {
        // What comes before it stays as it is.
        let at = self.kept.iter().position(|k| k.0 == out);
        let at = at.unwrap_or(self.kept.len());
        let behind = self.kept.iter().skip(at + 1);
        let mut all: Vec<(usize, DVector<f64>)> = behind.map(|k| (k.0, of(k.0))).collect();
        all.push((new, column.clone()));
        self.q.truncate(at);
        self.kept.truncate(at);
        for (index, column) in all {
            let free = self.reject(&column);
            self.push(index, &column, &free);
        }
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
        // Of nine columns with six: squares, what is beside them, and what is below.
        let a = DMatrix::from_fn(203, 9, |i, j| ((i * 7 + j * i * 13) as f64 * 0.37).sin());
        let b = DMatrix::from_fn(203, 6, |i, j| ((i * 5 + j * i * 3) as f64 * 0.61).cos());
        assert_eq!(cross(&a, &b), a.tr_mul(&b));
        assert_eq!(own_products(&a), a.tr_mul(&a));
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
    fn a_factor_has_the_bits_of_nalgebras_and_its_inverse_is_one() {
        for n in [1, 4, 23] {
            let a = DMatrix::from_fn(40, n, |i, j| ((i * 7 + j * i * 13) as f64 * 0.37).sin());
            let gram = a.tr_mul(&a) + DMatrix::identity(n, n);
            let mut factor = gram.clone();
            assert!(cholesky(&mut factor));
            let expected = gram.clone().cholesky().unwrap();
            assert_eq!(factor, *expected.l_dirty());
            let inverse = inverse_of_lower(&factor);
            assert!((expected.l() * inverse - DMatrix::identity(n, n)).amax() < 1e-12);
            assert!(!cholesky(&mut (-gram)));
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
