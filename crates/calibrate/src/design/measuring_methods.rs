//! The different ways in which the samples of a session were measured: kinds, places, targets. A new
//! pose is measured in one of them.

use super::plan_options::PROPOSED;
use nalgebra::Point3;

use super::candidate::typed;
use super::imagined::place_of;
use crate::effects::inputs::reflectors_at_home;
use crate::effects::places::{name, stated};
use crate::effects::{Inputs, Place, PlaceKind};
use crate::kinematics::Range;
use crate::model::Model;
use crate::observations::constrained::bring;
use crate::observations::{KINDS, Seen};
use crate::sessions::Session;
use crate::text::Text;

/// One way of measuring.
#[derive(Debug, Clone)]
pub(crate) struct MeasuringMethod {
    /// The sample that was measured so; none: a point of a robot that was not measured.
    pub(crate) like: Option<usize>,
    pub(crate) target: u32,
    /// What is measured, and the places that it refers to.
    pub(crate) places: MeasuredKinds,
    /// Where the target has to be.
    pub(crate) held: Option<(usize, Place)>,
    /// From where it is seen, measuring frame.
    pub(crate) from: Option<Point3<f64>>,
}

/// What was measured of a sample: kinds, and the places that they refer to.
pub(crate) type MeasuredKinds = Vec<(usize, Option<Place>)>;

impl MeasuringMethod {
    /// What is measured, in words.
    pub(crate) fn describe(&self, session: &Session) -> Text {
        let references = &session.instrument.references;
        let one = |(kind, place): &(usize, Option<Place>)| {
            let kind = KINDS[*kind].about().in_words();
            match place {
                Some(place) => {
                    let name = Text::verbatim(name(references, *place));
                    Text::listed([kind, name], " ")
                }
                None => kind,
            }
        };
        Text::listed(self.places.iter().map(one), ", ")
    }

    /// Joint values as a technician types them, or where the target is held where it has to be; none
    /// within the limits: `None`.
    pub(crate) fn brought(
        &self,
        session: &Session,
        base: &Model,
        ranges: &[Range],
        mut q: Vec<f64>,
    ) -> Option<Vec<f64>> {
        let joints = &session.robot.joints;
        let Some((kind, place)) = self.held else {
            for ((q, range), joint) in q.iter_mut().zip(ranges).zip(joints) {
                *q = typed(*q, joint.kind).clamp(range.from, range.to);
            }
            return Some(q);
        };
        let columns = q.iter().map(|q| vec![*q]).collect();
        let mut own = Inputs::at_poses(columns, reflectors_at_home(session));
        own.target = Some(vec![self.target].into());
        own.setup = last_setup(session).map(|last| vec![last]);
        let at = place_of(session, base, place);
        let there = bring(base, &mut own, |point| {
            let seen = Seen {
                point,
                attitude: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
                place: &at,
            };
            let residual = KINDS[kind].residual(session, self.like.unwrap_or(0), &seen);
            (
                residual.left[..residual.rows].to_vec(),
                residual.by_point[..residual.rows].to_vec(),
            )
        });
        let q: Vec<f64> = own.q.iter().map(|q| q[0]).collect();
        let inside = |(q, range): (&f64, &Range)| *q >= range.from && *q <= range.to;
        (there && q.iter().zip(ranges).all(inside)).then_some(q)
    }
}

/// The setup of the last sample, where there are any.
pub(crate) fn last_setup(session: &Session) -> Option<f64> {
    let setups = session.samples.setups.as_ref()?;
    setups.index.last().map(|last| f64::from(*last))
}

/// The different ways in which the samples were measured; `from` is the place of an instrument that is no station.
pub(crate) fn ways(session: &Session, from: Option<Point3<f64>>) -> Vec<MeasuringMethod> {
    let mut known: Vec<(MeasuredKinds, u32)> = Vec::new();
    let mut ways = Vec::new();
    for sample in 0..session.samples.len() {
        let measured = KINDS
            .iter()
            .enumerate()
            .filter(|(_, kind)| kind.measured(session, sample));
        let kinds: Vec<_> = measured
            .map(|(k, kind)| (k, kind.place(session, sample)))
            .collect();
        let target = session.samples.target.as_ref().map_or(0, |t| t[sample]);
        let key = (kinds, target);
        if key.0.is_empty() || known.contains(&key) || ways.len() >= PROPOSED {
            continue;
        }
        let places = || {
            key.0
                .iter()
                .filter_map(|(k, place)| place.map(|place| (*k, place)))
        };
        let station = places().find(|(_, place)| place.kind == PlaceKind::Station);
        let position = station.and_then(|(_, place)| {
            let at = stated(&session.instrument.references, place);
            Some(Point3::new(at[3]?, at[4]?, at[5]?))
        });
        ways.push(MeasuringMethod {
            like: Some(sample),
            target,
            places: key.0.clone(),
            held: places().find(|(k, _)| KINDS[*k].about().holds),
            from: position.or(from),
        });
        known.push(key);
    }
    ways
}
