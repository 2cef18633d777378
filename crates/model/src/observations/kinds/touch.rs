//! A touch: the target lies in a plane. One row: a touch probe, a line laser on flats. The radius of a
//! probe's ball belongs to the plane's distance.
//!
//! ```text
//! n·p = d,   n = v/|v|
//! ```

use crate::effects::places::unit_normal;
use crate::effects::{Place, PlaceKind};
use crate::lanes::{add_scaled, dot, scaled};
use crate::observations::{AboutKind, Kind, Observable, Residual, Seen, Unit, named, put_name};
use crate::sessions::{Instrument, Session};

pub(crate) struct Touch;

static ABOUT: AboutKind = AboutKind {
    name: "touch",
    title: phrase!("touch"),
    looks: Observable::AtPoint,
    unit: Unit::Millimetre,
    usual_sigma: 0.02,
    shows_length: false,
    holds: true,
};

impl Kind for Touch {
    fn about(&self) -> &'static AboutKind {
        &ABOUT
    }

    fn place(&self, session: &Session, sample: usize) -> Option<Place> {
        let column = session.samples.observed.plane.as_ref();
        named(column, sample, PlaceKind::Plane)
    }

    fn sigma(&self, instrument: &Instrument) -> Option<f64> {
        instrument.sigma_touch_mm
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
        put_name(&mut session.samples.observed.plane, count, sample, place);
    }

    fn residual(&self, _: &Session, _: usize, seen: &Seen) -> Residual {
        let (normal, length) = unit_normal(seen.place);
        let normal: [f64; 3] = normal.into_inner().into();
        let height = dot(normal, seen.point);
        let mut residual = Residual::new(1);
        residual.left[0] = seen.place[3] - height;
        residual.by_point[0] = normal;
        // ∂n/∂v = (1 − n nᵀ)/|v|
        let flat = add_scaled(seen.point, normal, -height);
        residual.by_place[0][..3].copy_from_slice(&scaled(flat, 1.0 / length));
        residual.by_place[0][3] = -1.0;
        residual
    }
}
