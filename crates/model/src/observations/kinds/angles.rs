//! Azimuth and elevation of a direction, and the residuals of measured ones.

use crate::observations::put_name;
use crate::rounding;
use crate::sessions::{Azimuth, Session};

/// The measured azimuth (in the counterclockwise sense) and elevation of a sample, rad.
pub(super) fn measured(session: &Session, sample: usize, sense: Azimuth) -> Option<[f64; 2]> {
    let observed = &session.samples.observed;
    let azimuth = observed.azimuth.as_ref()?[sample];
    let elevation = observed.elevation.as_ref()?[sample];
    let there = !azimuth.is_nan() && !elevation.is_nan();
    there.then_some([azimuth * sense.sign(), elevation])
}

/// The residual of a measured direction and a predicted one of any length, in the station's axes: azimuth times the
/// cosine of the measured elevation, and elevation; and the derivatives of both, as predicted, with respect to the
/// direction.
pub(super) fn residual_of(measured: [f64; 2], direction: [f64; 3]) -> ([f64; 2], [[f64; 3]; 2]) {
    let [x, y, z] = direction;
    let flat = x.hypot(y).max(f64::EPSILON);
    let square = flat * flat + z * z;
    let (azimuth, elevation) = (y.atan2(x), z.atan2(flat));
    let shrink = measured[1].cos();
    let turn = std::f64::consts::TAU;
    let around = measured[0] - azimuth;
    let around = around - turn * (around / turn).round();
    let off = [around * shrink, measured[1] - elevation];
    let by = [
        [-y / (flat * flat) * shrink, x / (flat * flat) * shrink, 0.0],
        [
            -z * x / (flat * square),
            -z * y / (flat * square),
            flat / square,
        ],
    ];
    (off, by)
}

/// Writes down the azimuth (from 0 to a full turn) and the elevation of a direction in a station's
/// axes.
pub(super) fn show(
    session: &mut Session,
    sample: usize,
    station: Option<usize>,
    direction: [f64; 3],
    noise: [f64; 3],
) {
    let [x, y, z] = direction;
    let elevation = z.atan2(x.hypot(y));
    // The same angle in space, wherever it is seen.
    let azimuth = y.atan2(x) + noise[0] / elevation.cos().max(rounding::COMPUTED);
    let stations = &session.instrument.references.stations;
    let sense = station.map_or(Azimuth::default(), |index| stations[index].azimuth);
    let azimuth = (azimuth * sense.sign()).rem_euclid(std::f64::consts::TAU);
    let half = std::f64::consts::FRAC_PI_2;
    let elevation = (elevation + noise[1]).clamp(-half, half);
    let count = session.samples.len();
    let observed = &mut session.samples.observed;
    for (column, value) in [
        (&mut observed.azimuth, azimuth),
        (&mut observed.elevation, elevation),
    ] {
        column.get_or_insert_with(|| vec![f64::NAN; count])[sample] = value;
    }
    put_name(&mut observed.station, count, sample, station);
}
