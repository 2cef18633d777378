//! A point: up to three coordinates, single ones of which may be missing.
//!
//! A tracker measures a range and two angles, so that its noise is small along the beam and grows with
//! the distance across it:
//!
//! ```text
//! Σ = σ_r² b bᵀ + (σ_a D)² (1 − b bᵀ),   b the direction of the beam, D its length
//! ```
//!
//! Rows are whitened with the inverse of the Cholesky factor of Σ on the coordinates that are there.

use nalgebra::{Cholesky, DMatrix, Matrix3, Vector3};

use crate::observations::{AboutKind, Kind, Observable, Residual, Seen, Unit};
use crate::rounding;
use crate::sessions::{Instrument, Session, Sigma};

pub(crate) struct Point;

static ABOUT: AboutKind = AboutKind {
    name: "point",
    title: phrase!("point"),
    looks: Observable::AtPoint,
    unit: Unit::Millimetre,
    usual_sigma: 0.05,
    shows_length: true,
    holds: false,
};

/// The coordinates of a sample; NaN where one is missing.
fn coordinates(session: &Session, sample: usize) -> [f64; 3] {
    let samples = &session.samples;
    let z = samples.z_mm.as_ref().map_or(f64::NAN, |z| z[sample]);
    [samples.x_mm[sample], samples.y_mm[sample], z]
}

/// The axes that were measured.
fn axes(measured: [f64; 3]) -> impl Iterator<Item = usize> {
    (0..3).filter(move |axis| !measured[*axis].is_nan())
}

impl Kind for Point {
    fn about(&self) -> &'static AboutKind {
        &ABOUT
    }

    fn measured(&self, session: &Session, sample: usize) -> bool {
        let at = coordinates(session, sample);
        // An instrument that has lost its target writes zeros.
        let lost = at.iter().all(|v| *v == 0.0 || v.is_nan());
        axes(at).next().is_some() && !lost
    }

    fn sigma(&self, instrument: &Instrument) -> Option<f64> {
        if let Some(tracker) = instrument.tracker {
            return Some(tracker.sigma_range_mm);
        }
        instrument.sigma_mm.map(|sigma| match sigma {
            Sigma::Overall(sigma) => sigma,
            Sigma::PerAxis(each) => (each.iter().map(|s| s * s).sum::<f64>() / 3.0).sqrt(),
        })
    }

    fn residual(&self, session: &Session, sample: usize, seen: &Seen) -> Residual {
        let measured = coordinates(session, sample);
        let mut residual = Residual::new(axes(measured).count());
        for (row, axis) in axes(measured).enumerate() {
            residual.left[row] = measured[axis] - seen.point[axis];
            residual.by_point[row][axis] = 1.0;
        }
        residual
    }

    fn show(
        &self,
        session: &mut Session,
        sample: usize,
        _: Option<usize>,
        seen: &Seen,
        noise: [f64; 3],
    ) {
        let samples = &mut session.samples;
        samples.x_mm[sample] = seen.point[0] + noise[0];
        samples.y_mm[sample] = seen.point[1] + noise[1];
        if let Some(z) = &mut samples.z_mm {
            z[sample] = seen.point[2] + noise[2];
        }
    }

    fn weighed(
        &self,
        session: &Session,
        sample: usize,
        sigma: f64,
        residual: &Residual,
    ) -> Residual {
        let measured = coordinates(session, sample);
        let mut by = [[0.0; 3]; 3];
        let instrument = &session.instrument;
        // Where the noise is another than is stated it keeps its form.
        let scale = self.sigma(instrument).map_or(1.0, |stated| stated / sigma);
        if let Some(tracker) = instrument.tracker {
            let at = Vector3::from(measured.map(|v| if v.is_nan() { 0.0 } else { v }));
            let beam = at - tracker.position_mm.coords;
            let length = beam.norm();
            let along = beam / length.max(rounding::COMPUTED);
            let across = (tracker.sigma_angle * length).max(rounding::COMPUTED);
            let projector = along * along.transpose();
            let sizes = tracker.sigma_range_mm.powi(2) * projector
                + across.powi(2) * (Matrix3::identity() - projector);
            let there: Vec<usize> = axes(measured).collect();
            let sizes =
                DMatrix::from_fn(there.len(), there.len(), |i, j| sizes[(there[i], there[j])]);
            let factor = Cholesky::new(sizes).map(|c| c.l());
            if let Some(inverse) = factor.and_then(DMatrix::try_inverse) {
                for i in 0..there.len() {
                    for j in 0..there.len() {
                        by[i][j] = scale * inverse[(i, j)];
                    }
                }
                return residual.mixed(&by, residual.rows);
            }
        }
        for (row, axis) in axes(measured).enumerate() {
            by[row][row] = match instrument.sigma_mm {
                Some(Sigma::PerAxis(each)) => scale / each[axis],
                _ => 1.0 / sigma,
            };
        }
        residual.mixed(&by, residual.rows)
    }
}
