//! Azimuth and elevation of a direction, and what is left of measured ones.

use crate::sessions::{Azimuth, Session};

/// The measured azimuth (in the counterclockwise sense) and elevation of a sample, rad.
pub(super) fn measured(session: &Session, sample: usize, sense: Azimuth) -> Option<[f64; 2]> {
    let observed = &session.samples.observed;
    let azimuth = observed.azimuth.as_ref()?[sample];
    let elevation = observed.elevation.as_ref()?[sample];
    let there = !azimuth.is_nan() && !elevation.is_nan();
    there.then_some([azimuth * sense.sign(), elevation])
}

/// What is left of a measured direction beside a predicted one of any length, in the station's axes:
/// azimuth times the cosine of the measured elevation, and elevation; and how both, as predicted,
/// depend on the direction.
pub(super) fn left(measured: [f64; 2], direction: [f64; 3]) -> ([f64; 2], [[f64; 3]; 2]) {
    let [x, y, z] = direction;
    let flat = x.hypot(y).max(1e-12);
    let square = (flat * flat + z * z).max(1e-24);
    let (azimuth, elevation) = (y.atan2(x), z.atan2(flat));
    let shrink = measured[1].cos();
    let turn = std::f64::consts::TAU;
    let around = measured[0] - azimuth;
    let around = around - turn * (around / turn).round();
    let left = [around * shrink, measured[1] - elevation];
    let by = [
        [-y / (flat * flat) * shrink, x / (flat * flat) * shrink, 0.0],
        [
            -z * x / (flat * square),
            -z * y / (flat * square),
            flat / square,
        ],
    ];
    (left, by)
}
