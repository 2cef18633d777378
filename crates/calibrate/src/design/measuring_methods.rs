//! The different ways in which the samples of a session were measured: kinds, places, targets. A new
//! pose is measured in one of them.

use super::plan_options::PROPOSED;
use nalgebra::Point3;

use super::candidate::{Candidate, typed};
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

    /// A pose near these joint values, measured in this way, which is that one of the list: joint values as a
    /// technician types them, or where the target is held where it has to be; none within the limits: `None`.
    pub(crate) fn brought(
        &self,
        way: usize,
        session: &Session,
        base: &Model,
        ranges: &[Range],
        mut q: Vec<f64>,
    ) -> Option<Candidate> {
        if let Some((kind, place)) = self.held {
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
            q = own.q.iter().map(|q| q[0]).collect();
            let inside = |(q, range): (&f64, &Range)| *q >= range.from && *q <= range.to;
            if !(there && q.iter().zip(ranges).all(inside)) {
                return None;
            }
        } else {
            for ((q, range), joint) in q.iter_mut().zip(ranges).zip(&session.robot.joints) {
                *q = typed(*q, joint.kind).clamp(range.from, range.to);
            }
        }
        Some(Candidate {
            target: self.target,
            way,
            ..Candidate::at(q)
        })
    }
}

/// The setup of the last sample, where there are any.
pub(crate) fn last_setup(session: &Session) -> Option<f64> {
    let setups = session.samples.setups.as_ref()?;
    setups.index.last().map(|last| f64::from(*last))
}

/// The different ways in which the samples were measured; `from` is the place of an instrument that is no station.
pub(crate) fn ways(session: &Session, from: Option<Point3<f64>>) -> Vec<MeasuringMethod> {
    let mut ways: Vec<MeasuringMethod> = Vec::new();
    for sample in 0..session.samples.len() {
        let all = KINDS.iter().enumerate();
        let measured = all.filter(|(_, kind)| kind.measured(session, sample));
        let kinds = measured.map(|(k, kind)| (k, kind.place(session, sample)));
        let kinds: MeasuredKinds = kinds.collect();
        let target = session.samples.target.as_ref().map_or(0, |t| t[sample]);
        let mut known = ways.iter();
        if kinds.is_empty() || known.any(|way| way.places == kinds && way.target == target) {
            continue;
        }
        if ways.len() >= PROPOSED {
            break;
        }
        let places = || kinds.iter().filter_map(|(k, place)| Some((*k, (*place)?)));
        let station = places().find(|(_, place)| place.kind == PlaceKind::Station);
        let position = station.and_then(|(_, place)| {
            let at = stated(&session.instrument.references, place);
            Some(Point3::new(at[3]?, at[4]?, at[5]?))
        });
        ways.push(MeasuringMethod {
            like: Some(sample),
            target,
            held: places().find(|(k, _)| KINDS[*k].about().holds),
            from: position.or(from),
            places: kinds,
        });
    }
    ways
}
