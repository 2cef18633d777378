//! Products of matrices with many rows. nalgebra's product of a transposed matrix takes one column at a time; a
//! transposed copy takes blocks, several times as fast.

use nalgebra::DMatrix;

use crate::lanes::LANES;

/// `Aᵀ B`.
pub fn cross(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    a.transpose() * b
}

/// `Aᵀ A` of some columns: its lower half by blocks of rows, the other half is the same.
pub fn gram(a: &DMatrix<f64>) -> DMatrix<f64> {
    let p = a.ncols();
    let transposed = a.transpose();
    let mut gram = DMatrix::zeros(p, p);
    for first in (0..p).step_by(LANES) {
        let end = (first + LANES).min(p);
        let rows = transposed.rows(first, end - first);
        let mut block = gram.view_mut((first, 0), (end - first, end));
        block.gemm(1.0, &rows, &a.columns(0, end), 0.0);
    }
    gram.fill_upper_triangle_with_lower_triangle();
    gram
}

/// Takes from columns what orthonormal ones have of them, `C − Q QᵀC`, twice ("twice is enough", Giraud, Langou &
/// Rozložník 2005); `QᵀC`.
pub fn reject_all(q: &DMatrix<f64>, columns: &mut DMatrix<f64>) -> DMatrix<f64> {
    let mut all = DMatrix::zeros(q.ncols(), columns.ncols());
    let transposed = q.transpose();
    for _ in 0..2 {
        let along = &transposed * &*columns;
        columns.gemm(-1.0, q, &along, 1.0);
        all += along;
    }
    all
}

#[cfg(test)]
mod tests {
    use super::super::Basis;
    use super::*;

    fn wild(rows: usize, columns: usize) -> DMatrix<f64> {
        DMatrix::from_fn(rows, columns, |i, j| {
            ((i * 7 + j * i * 13) as f64 * 0.37).sin()
        })
    }

    #[test]
    fn a_gram_matrix_is_every_product() {
        for p in [1, LANES, 2 * LANES + 5] {
            let a = wild(71, p);
            let gram = gram(&a);
            assert!((&gram - a.tr_mul(&a)).amax() < 1e-12);
            assert_eq!(gram, gram.transpose());
        }
    }

    #[test]
    fn nothing_along_orthonormal_columns_is_left() {
        let (a, b) = (wild(203, 9), wild(203, 15).columns(9, 6).into_owned());
        let q = Basis::new(&b).q;
        let mut free = a.clone();
        let along = reject_all(&q, &mut free);
        assert!(q.tr_mul(&free).amax() < 1e-12 * a.norm());
        assert!((&a - &q * along - &free).amax() < 1e-12);
        assert!((a - free).norm() > 0.1);
    }
}
