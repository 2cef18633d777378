//! The inverse of an information matrix.

use nalgebra::DMatrix;

/// Information that every direction has at least, as a share of what the columns could bring.
pub(super) const LEAST_INFORMATION: f64 = 1e-9;

/// Inverse of an information matrix, well scaled or not.
pub(crate) fn inverse(information: &DMatrix<f64>) -> DMatrix<f64> {
    let p = information.nrows();
    // What nothing depends on, such as where an absent effect fades, is left alone.
    let scale_of = |own: f64| if own > 1e-200 { 1.0 / own.sqrt() } else { 0.0 };
    let scale: Vec<f64> = (0..p).map(|k| scale_of(information[(k, k)])).collect();
    let scaled = DMatrix::from_fn(p, p, |i, j| information[(i, j)] * scale[i] * scale[j]);
    // Rounding may leave a direction a hair below zero.
    let lifted = scaled + DMatrix::identity(p, p) * 1e-12;
    let inverse = lifted
        .clone()
        .cholesky()
        .map(|c| c.inverse())
        .or_else(|| lifted.try_inverse())
        .unwrap_or_else(|| DMatrix::identity(p, p));
    DMatrix::from_fn(p, p, |i, j| inverse[(i, j)] * scale[i] * scale[j])
}
