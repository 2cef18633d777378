//! Triangles, and factors of small matrices that may not have full rank.

use nalgebra::DMatrix;

/// The inverse of a lower triangle without a zero on its diagonal.
pub fn inverse_of_lower(l: &DMatrix<f64>) -> DMatrix<f64> {
    let n = l.nrows();
    solve_lower(l, DMatrix::identity(n, n))
}

/// `L⁻¹ M` for a lower triangle without a zero on its diagonal.
pub fn solve_lower(l: &DMatrix<f64>, mut m: DMatrix<f64>) -> DMatrix<f64> {
    l.solve_lower_triangular_unchecked_mut(&mut m);
    m
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
    use super::super::Basis;
    use super::*;
    use nalgebra::DVector;

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
