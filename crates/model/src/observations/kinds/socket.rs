//! A socket: the target is in the same place in all samples of that name. Three rows; no instrument is needed at all.
//! The measured value of p − s is zero.

use crate::effects::{Place, PlaceKind};
use crate::lanes::minus;
use crate::observations::{AboutKind, Kind, Observable, Residual, Seen, Unit, named, put_name};
use crate::sessions::{Instrument, Session, Sigma};

pub(crate) struct Socket;

static ABOUT: AboutKind = AboutKind {
    name: "socket",
    title: phrase!("socket"),
    looks: Observable::AtPoint,
    unit: Unit::Millimetre,
    usual_sigma: 0.05,
    shows_length: false,
    holds: true,
};

impl Kind for Socket {
    fn about(&self) -> &'static AboutKind {
        &ABOUT
    }

    fn place(&self, session: &Session, sample: usize) -> Option<Place> {
        let column = session.samples.observed.socket.as_ref();
        named(column, sample, PlaceKind::Socket)
    }

    fn sigma(&self, instrument: &Instrument) -> Option<f64> {
        instrument.sigma_mm.map(|sigma| match sigma {
            Sigma::Overall(sigma) => sigma,
            Sigma::PerAxis(each) => (each.iter().map(|s| s * s).sum::<f64>() / 3.0).sqrt(),
        })
    }

    fn show(
        &self,
        session: &mut Session,
        sample: usize,
        place: Option<usize>,
        _: &Seen,
        _: [f64; 3],
    ) {
        let count = session.samples.len();
        put_name(&mut session.samples.observed.socket, count, sample, place);
    }

    fn residual(&self, _: &Session, _: usize, seen: &Seen) -> Residual {
        let mut residual = Residual::new(3);
        let socket = [seen.place[0], seen.place[1], seen.place[2]];
        residual.left = minus(socket, seen.point);
        for k in 0..3 {
            residual.by_point[k][k] = 1.0;
            residual.by_place[k][k] = -1.0;
        }
        residual
    }
}
