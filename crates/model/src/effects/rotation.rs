//! Rotations by their rotation vectors, and how they change with them.

use super::base_offset::AXES;
use crate::lanes::{add_scaled, cross, scaled};

/// Exchanges a rotation vector of more than half a turn for the shorter one of the same rotation.
pub(crate) fn unwind(coefficients: &mut [f64]) {
    use std::f64::consts::{PI, TAU};
    let omega = [coefficients[0], coefficients[1], coefficients[2]];
    let angle = crate::lanes::dot(omega, omega).sqrt();
    // A little beyond half a turn is left alone, lest a fit hop to and fro there.
    if angle > 1.25 * PI {
        let shorter = angle - TAU * (angle / TAU).round();
        for (coefficient, omega) in coefficients.iter_mut().zip(omega) {
            *coefficient = omega / angle * shorter;
        }
    }
}

/// Rotation matrix of a rotation vector, by rows (Rodrigues).
pub(crate) fn rotation(omega: [f64; 3]) -> [[f64; 3]; 3] {
    let (a, b, _) = rodrigues_factors(omega);
    from_factors(omega, 1.0, a, b)
}

/// Left Jacobian of SO(3), by rows: `1 + b [ω] + c [ω]²`.
pub(crate) fn left_jacobian(omega: [f64; 3]) -> [[f64; 3]; 3] {
    let (_, b, c) = rodrigues_factors(omega);
    from_factors(omega, 1.0, b, c)
}

/// sin θ/θ, (1 − cos θ)/θ², (θ − sin θ)/θ³, by their series near zero.
fn rodrigues_factors(omega: [f64; 3]) -> (f64, f64, f64) {
    let t2 = crate::lanes::dot(omega, omega);
    if t2 < 1e-6 {
        let a = 1.0 - t2 / 6.0 + t2 * t2 / 120.0;
        let b = 0.5 - t2 / 24.0 + t2 * t2 / 720.0;
        let c = 1.0 / 6.0 - t2 / 120.0 + t2 * t2 / 5040.0;
        (a, b, c)
    } else {
        let t = t2.sqrt();
        (t.sin() / t, (1.0 - t.cos()) / t2, (t - t.sin()) / (t2 * t))
    }
}

/// `one·1 + a [ω] + b [ω]²` by rows.
fn from_factors(omega: [f64; 3], one: f64, a: f64, b: f64) -> [[f64; 3]; 3] {
    let columns = AXES.map(|e| {
        let once = cross(omega, e);
        let twice = cross(omega, once);
        add_scaled(add_scaled(scaled(e, one), once, a), twice, b)
    });
    std::array::from_fn(|row| std::array::from_fn(|column| columns[column][row]))
}
