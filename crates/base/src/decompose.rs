//! Decompositions of matrices that end: nalgebra's own go on for ever where a number is none, and where
//! rounding keeps a value from settling. Beyond a number of steps that no sound matrix needs there is no
//! answer.

use nalgebra::allocator::Allocator;
use nalgebra::linalg::{SVD, SymmetricEigen};
use nalgebra::{DefaultAllocator, Dim, DimDiff, DimMin, DimMinimum, DimSub, OMatrix, OVector, U1};

/// A value below this share of its neighbours is none, as nalgebra has it.
const NEGLIGIBLE: f64 = 5.0 * f64::EPSILON;

/// Steps that are taken at most: a sound matrix takes two or three for each of its rows.
fn most_steps(rows: usize) -> usize {
    1000 + 30 * rows
}

/// Singular values and directions; `None` where they are not found, as of a matrix without rows or columns.
pub fn svd<R: DimMin<C>, C: Dim>(matrix: OMatrix<f64, R, C>) -> Option<SVD<f64, R, C>>
where
    DimMinimum<R, C>: DimSub<U1>,
    DefaultAllocator: Allocator<R, C>
        + Allocator<C>
        + Allocator<R>
        + Allocator<DimDiff<DimMinimum<R, C>, U1>>
        + Allocator<DimMinimum<R, C>, C>
        + Allocator<R, DimMinimum<R, C>>
        + Allocator<DimMinimum<R, C>>,
{
    let most = most_steps(matrix.nrows().min(matrix.ncols()));
    let usable = !matrix.is_empty() && matrix.iter().all(|v| v.is_finite());
    usable.then(|| SVD::try_new(matrix, true, true, NEGLIGIBLE, most))?
}

/// Eigenvalues and directions of a symmetric matrix; where they are not found every value is 0, as of
/// directions in which nothing is known.
pub fn eigen<D: DimSub<U1>>(matrix: OMatrix<f64, D, D>) -> SymmetricEigen<f64, D>
where
    DefaultAllocator: Allocator<D, D> + Allocator<D> + Allocator<DimDiff<D, U1>>,
{
    let (rows, columns) = matrix.shape_generic();
    let most = most_steps(matrix.nrows());
    let finite = matrix.iter().all(|v| v.is_finite());
    let found = finite.then(|| SymmetricEigen::try_new(matrix, f64::EPSILON, most));
    found.flatten().unwrap_or_else(|| SymmetricEigen {
        eigenvalues: OVector::zeros_generic(rows, U1),
        eigenvectors: OMatrix::identity_generic(rows, columns),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{DMatrix, Matrix3};

    #[test]
    fn sound_matrices_are_decomposed_as_nalgebra_does() {
        let matrix = DMatrix::from_fn(7, 4, |i, j| ((i * 4 + j) as f64 * 0.7).sin());
        let own = svd(matrix.clone()).unwrap();
        assert_eq!(
            own.singular_values,
            matrix.clone().svd(true, true).singular_values
        );
        assert_eq!(own.rank(1e-9), matrix.rank(1e-9));
        let square = Matrix3::new(4.0, 1.0, 0.5, 1.0, 3.0, 0.2, 0.5, 0.2, 2.0);
        assert_eq!(
            eigen(square).eigenvalues,
            square.symmetric_eigen().eigenvalues
        );
    }

    #[test]
    fn what_is_no_number_ends_at_once() {
        for bad in [f64::NAN, f64::INFINITY] {
            let mut matrix = Matrix3::identity();
            matrix[(1, 2)] = bad;
            assert!(svd(matrix).is_none());
            assert_eq!(eigen(matrix).eigenvalues.max(), 0.0);
        }
    }
}
