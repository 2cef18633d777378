//! A height over a flat: a displacement sensor or a dial gauge carried over a plane. A row has
//! `distance_mm` and `plane`. One row.
//!
//! ```text
//! m = n·p − d,   n = v/|v|
//! ```

use super::touch::Touch;
use crate::effects::Place;
use crate::effects::places::unit_normal;
use crate::lanes::dot;
use crate::observations::{AboutKind, Kind, Observable, Residual, Seen, Unit, put_name};
use crate::sessions::{Instrument, Session};

pub(crate) struct Height;

static ABOUT: AboutKind = AboutKind {
    name: "height",
    title: phrase!("height"),
    looks: Observable::AtPoint,
    unit: Unit::Millimetre,
    usual_sigma: 0.02,
    shows_length: true,
    holds: false,
};

/// Whether a sample is a height: a distance over a plane.
pub(crate) fn is_height(session: &Session, sample: usize) -> bool {
    !shown(session, sample).is_nan() && Touch.place(session, sample).is_some()
}

fn shown(session: &Session, sample: usize) -> f64 {
    let column = session.samples.observed.distance_mm.as_ref();
    column.map_or(f64::NAN, |column| column[sample])
}

impl Kind for Height {
    fn about(&self) -> &'static AboutKind {
        &ABOUT
    }

    fn measured(&self, session: &Session, sample: usize) -> bool {
        is_height(session, sample)
    }

    fn place(&self, session: &Session, sample: usize) -> Option<Place> {
        Touch.place(session, sample)
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
        let (normal, _) = unit_normal(seen.place);
        let height = dot(normal.into_inner().into(), seen.point) - seen.place[3];
        let count = session.samples.len();
        let observed = &mut session.samples.observed;
        let distances = &mut observed.distance_mm;
        distances.get_or_insert_with(|| vec![f64::NAN; count])[sample] = height + noise[0];
        put_name(&mut observed.plane, count, sample, place);
    }

    fn residual(&self, session: &Session, sample: usize, seen: &Seen) -> Residual {
        // A touch leaves d − n·p, and so has the derivatives of n·p − d.
        let mut residual = Touch.residual(session, sample, seen);
        residual.left[0] += shown(session, sample);
        residual
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::observations::KINDS;

    #[test]
    fn a_distance_over_a_plane_is_a_height_and_nothing_else() {
        let session = crate::sessions::parse(
            br#"{"format": "truepose-session/1", "name": "flat", "robot": {"name": "column", "joints": [{"name": "a", "kind": "revolute",
                "axis": [0, 0, 1], "point_mm": [0, 0, 0]}], "tool": {"position_mm": [250, 0, 300],
                "quaternion_wxyz": [1, 0, 0, 0]}}, "planes": {"table": {"normal": [0, 0, 1], "distance_mm": 100}},
                "samples": {"columns": {"q1_deg": [0, 10, 20], "distance_mm": [200.5, null, 200],
                "plane": ["table", "table", "table"]}}}"#,
        )
        .unwrap()
        .session;
        let kinds = |sample: usize| {
            let has = |kind: &&&dyn Kind| kind.measured(&session, sample);
            let names = KINDS.iter().filter(has).map(|kind| kind.about().name);
            names.collect::<Vec<_>>()
        };
        assert_eq!([kinds(0), kinds(1)], [["height"], ["touch"]]);
        let seen = Seen {
            point: [250.0, 0.0, 300.0],
            attitude: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
            place: &[0.0, 0.0, 1.0, 100.0],
        };
        let residual = Height.residual(&session, 0, &seen);
        assert!((residual.left[0] - 0.5).abs() < 1e-12);
        assert_eq!(residual.by_point[0], [0.0, 0.0, 1.0]);
    }
}
