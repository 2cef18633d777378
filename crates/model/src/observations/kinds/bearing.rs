//! A bearing: the direction in which a station (a theodolite, a camera) sees the target. Two rows, rad,
//! the azimuth scaled by the cosine of the elevation.
//!
//! ```text
//! d = Rᵀ (p − s),   azimuth = atan2(d_y, d_x),   elevation = atan2(d_z, √(d_x² + d_y²))
//! ```

use super::angles;
use crate::effects::rotation::{left_jacobian, rotation};
use crate::effects::{Place, PlaceKind};
use crate::lanes::{cross, dot, minus, times};
use crate::observations::{AboutKind, Kind, Observable, Residual, Seen, Unit};
use crate::sessions::{Azimuth, Instrument, Session};

pub(crate) struct Bearing;

static ABOUT: AboutKind = AboutKind {
    name: "bearing",
    title: phrase!("direction"),
    looks: Observable::AtPoint,
    unit: Unit::Radian,
    usual_sigma: 5e-5,
    shows_length: false,
    holds: false,
};

/// The station of a sample, and whether what it sees is the axis that points.
pub(super) fn station(session: &Session, sample: usize) -> (Option<usize>, bool) {
    let index = session.samples.observed.station.as_ref();
    let index = index.and_then(|c| c[sample]).map(|i| i as usize);
    let pointing = session.instrument.references.pointing.as_ref();
    let points = pointing.is_some_and(|pointing| match (&pointing.stations, index) {
        (None, _) | (Some(_), None) => true,
        (Some(listed), Some(index)) => listed.contains(&index),
    });
    (index, points)
}

/// Which way a station counts.
pub(super) fn sense(session: &Session, station: Option<usize>) -> Azimuth {
    let stations = &session.instrument.references.stations;
    station.map_or(Azimuth::default(), |index| stations[index].azimuth)
}

/// By rows of a matrix, its columns.
pub(super) fn transposed(m: [[f64; 3]; 3]) -> [[f64; 3]; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| m[j][i]))
}

/// How a direction in a station's axes depends on the station's rotation vector, column by column;
/// `across` is the direction in the measuring frame.
pub(super) fn by_attitude(omega: [f64; 3], into: [[f64; 3]; 3], across: [f64; 3]) -> [[f64; 3]; 3] {
    let spins = transposed(left_jacobian(omega));
    spins.map(|spin| times(into, cross(across, spin)))
}

impl Kind for Bearing {
    fn about(&self) -> &'static AboutKind {
        &ABOUT
    }

    fn measured(&self, session: &Session, sample: usize) -> bool {
        let (station, points) = station(session, sample);
        let there = angles::measured(session, sample, Azimuth::default()).is_some();
        there && station.is_some() && !points
    }

    fn place(&self, session: &Session, sample: usize) -> Option<Place> {
        let index = station(session, sample).0?;
        let kind = PlaceKind::Station;
        Some(Place { kind, index })
    }

    fn sigma(&self, instrument: &Instrument) -> Option<f64> {
        instrument.sigma_direction
    }

    fn lever_mm(&self, seen: &Seen) -> f64 {
        let arm = minus(seen.point, [seen.place[3], seen.place[4], seen.place[5]]);
        dot(arm, arm).sqrt()
    }

    fn show(
        &self,
        session: &mut Session,
        sample: usize,
        place: Option<usize>,
        seen: &Seen,
        noise: [f64; 3],
    ) {
        let into = transposed(rotation([seen.place[0], seen.place[1], seen.place[2]]));
        let arm = minus(seen.point, [seen.place[3], seen.place[4], seen.place[5]]);
        angles::show(session, sample, place, times(into, arm), noise);
    }

    fn residual(&self, session: &Session, sample: usize, seen: &Seen) -> Residual {
        let mut residual = Residual::new(2);
        let sense = sense(session, station(session, sample).0);
        let Some(measured) = angles::measured(session, sample, sense) else {
            return residual;
        };
        let omega = [seen.place[0], seen.place[1], seen.place[2]];
        let station = [seen.place[3], seen.place[4], seen.place[5]];
        let into = transposed(rotation(omega));
        let arm = minus(seen.point, station);
        let (off, by) = angles::residual_of(measured, times(into, arm));
        let out = transposed(into);
        let spins = by_attitude(omega, into, arm);
        for row in 0..2 {
            residual.left[row] = off[row];
            residual.by_point[row] = times(out, by[row]);
            for k in 0..3 {
                residual.by_place[row][k] = dot(by[row], spins[k]);
                residual.by_place[row][3 + k] = -residual.by_point[row][k];
            }
        }
        residual
    }
}
