//! A distance from an anchor: a ballbar, a draw-wire, an interferometer. One row.
//!
//! ```text
//! m = |p − a| + offset
//! ```

use crate::effects::{Place, PlaceKind};
use crate::lanes::{dot, minus, scaled};
use crate::observations::{AboutKind, Kind, Observable, Residual, Seen, Unit, named, put_name};
use crate::rounding;
use crate::sessions::{Instrument, Session};

pub(crate) struct Distance;

static ABOUT: AboutKind = AboutKind {
    name: "distance",
    title: phrase!("distance"),
    looks: Observable::AtPoint,
    unit: Unit::Millimetre,
    usual_sigma: 0.02,
    shows_length: true,
    holds: false,
};

fn distance(session: &Session, sample: usize) -> f64 {
    let column = session.samples.observed.distance_mm.as_ref();
    column.map_or(f64::NAN, |column| column[sample])
}

impl Kind for Distance {
    fn about(&self) -> &'static AboutKind {
        &ABOUT
    }

    fn measured(&self, session: &Session, sample: usize) -> bool {
        !distance(session, sample).is_nan() && self.place(session, sample).is_some()
    }

    fn place(&self, session: &Session, sample: usize) -> Option<Place> {
        let column = session.samples.observed.anchor.as_ref();
        named(column, sample, PlaceKind::Anchor)
    }

    fn sigma(&self, instrument: &Instrument) -> Option<f64> {
        instrument.sigma_distance_mm
    }

    fn show(
        &self,
        session: &mut Session,
        sample: usize,
        place: Option<usize>,
        seen: &Seen,
        noise: [f64; 3],
    ) {
        let arm = minus(seen.point, [seen.place[0], seen.place[1], seen.place[2]]);
        let shown = dot(arm, arm).sqrt() + seen.place[3] + noise[0];
        let count = session.samples.len();
        let observed = &mut session.samples.observed;
        let distances = &mut observed.distance_mm;
        distances.get_or_insert_with(|| vec![f64::NAN; count])[sample] = shown;
        put_name(&mut observed.anchor, count, sample, place);
    }

    fn residual(&self, session: &Session, sample: usize, seen: &Seen) -> Residual {
        let [x, y, z, offset] = [0, 1, 2, 3].map(|k| seen.place[k]);
        let arm = minus(seen.point, [x, y, z]);
        let length = dot(arm, arm).sqrt();
        // On the anchor itself every direction is as good as another.
        let along = if length > rounding::COMPUTED {
            scaled(arm, 1.0 / length)
        } else {
            [0.0, 0.0, 1.0]
        };
        let mut residual = Residual::new(1);
        residual.left[0] = distance(session, sample) - length - offset;
        residual.by_point[0] = along;
        residual.by_place[0][..3].copy_from_slice(&scaled(along, -1.0));
        residual.by_place[0][3] = 1.0;
        residual
    }
}
