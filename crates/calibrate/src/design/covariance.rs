//! The covariance of parameters, `C = G⁻¹` of an information matrix, well scaled or not: it is inverted with
//! a unit diagonal, and what nothing depends on, such as where an absent effect fades, has variance 0.

use nalgebra::{DMatrix, DVector};

use crate::rounding;

use super::rows::Rows;

/// A matrix with a unit diagonal, and by how much each parameter was scaled.
fn scaled(information: &DMatrix<f64>) -> (DMatrix<f64>, DVector<f64>) {
    let of = |own: f64| {
        if own > f64::MIN_POSITIVE {
            1.0 / own.sqrt()
        } else {
            0.0
        }
    };
    let scale = information.diagonal().map(of);
    let p = scale.len();
    let unit = DMatrix::from_fn(p, p, |i, j| information[(i, j)] * scale[i] * scale[j]);
    (unit + DMatrix::identity(p, p) * rounding::LAST_BITS, scale)
}

/// Inverse of an information matrix.
pub(crate) fn inverse(information: &DMatrix<f64>) -> DMatrix<f64> {
    let p = information.nrows();
    let (unit, scale) = scaled(information);
    let factor = unit.clone().cholesky().map(|c| c.inverse());
    let inverse = factor.or_else(|| unit.try_inverse());
    let inverse = inverse.unwrap_or_else(|| DMatrix::identity(p, p));
    DMatrix::from_fn(p, p, |i, j| inverse[(i, j)] * scale[i] * scale[j])
}

/// Covariance of a model's parameters over what was measured already, for candidates.
pub(crate) fn given_samples(gram: &DMatrix<f64>, candidates: &Rows) -> DMatrix<f64> {
    let mut information = gram.clone();
    for (k, reach) in candidates.squares().into_iter().enumerate() {
        information[(k, k)] += rounding::COMPUTED * (gram[(k, k)] + reach).max(1e-300);
    }
    inverse(&information)
}

/// Draws with this information from draws of white noise.
pub(crate) fn drawn(information: &DMatrix<f64>, white: &DMatrix<f64>) -> DMatrix<f64> {
    let (unit, scale) = scaled(information);
    let solved = unit.cholesky().map(|c| c.l().transpose());
    let Some(mut all) = solved.and_then(|upper| upper.solve_upper_triangular(white)) else {
        return DMatrix::zeros(white.nrows(), white.ncols());
    };
    for (mut row, scale) in all.row_iter_mut().zip(&scale) {
        row *= *scale;
    }
    all
}
