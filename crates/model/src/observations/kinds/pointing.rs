//! Pointing: the direction of an axis of the tool, as azimuth and elevation. Two rows, rad. Where the
//! tool is makes no difference: a telescope, an antenna, a lamp that points at infinity.
//!
//! With a station the angles are in its axes, else in the measuring frame's.

use super::angles;
use super::bearing::{by_attitude, sense, station, transposed};
use crate::effects::rotation::rotation;
use crate::effects::{Place, PlaceKind};
use crate::lanes::{cross, dot, times};
use crate::observations::{AboutKind, Kind, Observable, Residual, Seen, Unit};
use crate::sessions::{Azimuth, Instrument, Session};

pub(crate) struct Pointing;

static ABOUT: AboutKind = AboutKind {
    name: "pointing",
    title: phrase!("direction of the tool"),
    looks: Observable::AtAttitude,
    unit: Unit::Radian,
    usual_sigma: 5e-5,
    shows_length: false,
    holds: false,
};

impl Kind for Pointing {
    fn about(&self) -> &'static AboutKind {
        &ABOUT
    }

    fn measured(&self, session: &Session, sample: usize) -> bool {
        let there = angles::measured(session, sample, Azimuth::default()).is_some();
        there && station(session, sample).1
    }

    fn place(&self, session: &Session, sample: usize) -> Option<Place> {
        let index = station(session, sample).0?;
        let kind = PlaceKind::Station;
        Some(Place { kind, index })
    }

    fn sigma(&self, instrument: &Instrument) -> Option<f64> {
        instrument.sigma_direction
    }

    fn show(
        &self,
        session: &mut Session,
        sample: usize,
        place: Option<usize>,
        seen: &Seen,
        noise: [f64; 3],
    ) {
        let Some(pointing) = &session.instrument.references.pointing else {
            return;
        };
        let direction = times(seen.attitude, pointing.axis.into_inner().into());
        let omega = match place {
            Some(_) => [seen.place[0], seen.place[1], seen.place[2]],
            None => [0.0; 3],
        };
        let into = transposed(rotation(omega));
        angles::show(session, sample, place, times(into, direction), noise);
    }

    fn residual(&self, session: &Session, sample: usize, seen: &Seen) -> Residual {
        let mut residual = Residual::new(2);
        let station = station(session, sample).0;
        let references = &session.instrument.references;
        let measured = angles::measured(session, sample, sense(session, station));
        let (Some(measured), Some(pointing)) = (measured, &references.pointing) else {
            return residual;
        };
        let direction = times(seen.attitude, pointing.axis.into_inner().into());
        let omega = match station {
            Some(_) => [seen.place[0], seen.place[1], seen.place[2]],
            None => [0.0; 3],
        };
        let into = transposed(rotation(omega));
        let (off, by) = angles::residual_of(measured, times(into, direction));
        let spins = by_attitude(omega, into, direction);
        for row in 0..2 {
            residual.left[row] = off[row];
            let across = times(transposed(into), by[row]);
            // ∂(ω × d)·a = ω·(d × a)
            residual.by_turn[row] = cross(direction, across);
            if station.is_some() {
                for k in 0..3 {
                    residual.by_place[row][k] = dot(by[row], spins[k]);
                }
            }
        }
        residual
    }
}
