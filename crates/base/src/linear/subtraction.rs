//! Columns that are taken from a vector, one after the other, and the products that are left with them.

use nalgebra::DMatrix;

use crate::wide::{Loop, wide};

use super::products::{Dot, cross, total, with_products};

/// Takes from `v` its parts along orthonormal columns, one after the other, and says how large each was.
pub(crate) fn reject(columns: &[f64], v: &mut [f64], parts: &mut [f64]) {
    wide(Rejecting { columns, v, parts });
}

/// Takes from `v` columns times their coefficients, one after the other.
pub fn subtract(columns: &[f64], coefficients: &[f64], v: &mut [f64]) {
    wide(Subtracting {
        columns,
        coefficients,
        v,
    });
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

/// Takes from columns what orthonormal ones span of them.
pub fn reject_all(q: &DMatrix<f64>, columns: &mut DMatrix<f64>) {
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
    use nalgebra::DVector;

    use super::super::Basis;
    use super::super::products::products;
    use super::*;

    #[test]
    fn what_is_left_has_the_bits_of_nalgebras() {
        let a = DMatrix::from_fn(203, 5, |i, j| ((i * 7 + j * 13) as f64 * 0.37).sin());
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
    }

    #[test]
    fn nothing_along_orthonormal_columns_is_left() {
        let a = DMatrix::from_fn(203, 9, |i, j| ((i * 7 + j * i * 13) as f64 * 0.37).sin());
        let b = DMatrix::from_fn(203, 6, |i, j| ((i * 5 + j * i * 3) as f64 * 0.61).cos());
        // Few columns and many.
        let q = Basis::new(&b).q;
        for width in [2, 9] {
            let mut free = a.columns(0, width).into_owned();
            reject_all(&q, &mut free);
            assert!(q.tr_mul(&free).amax() < 1e-12 * a.norm());
            assert!((a.columns(0, width) - &free).norm() > 0.1);
        }
    }

    /// Of the vector itself and of another one.
    #[test]
    fn taking_columns_and_their_products_at_once_has_the_bits_of_one_after_the_other() {
        let a = DMatrix::from_fn(203, 5, |i, j| ((i * 7 + j * 13) as f64 * 0.37).sin());
        let five = [0.3, -0.7, 0.01, 0.2, 1.1];
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
        }
    }
}
