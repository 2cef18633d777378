//! Simulated measurements other than plain points.
//!
//! The samples take the ways to measure in turn, and each way its places in turn. Where the target has
//! to be in a socket or on a plane the stop is moved there by the shortest way of the joints (Newton's
//! method on the real robot), off by the noise of the seat or of the touch.

use nalgebra::Vector3;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};

use super::SimulateError;
use super::random::{Stream, random};
use super::scenario::{Measure, Scenario};
use crate::diagnostic::{Diagnostic, Place as FilePlace, Rejected};
use crate::effects::base_offset::AXES;
use crate::effects::place::MOST;
use crate::effects::places::stated;
use crate::effects::{Inputs, JointValues, Place, PlaceKind};
use crate::lanes::dot;
use crate::model::Model;
use crate::observations::constrained::{Missing, bring};
use crate::observations::streams::predictions;
use crate::observations::{KINDS, Kind, Seen};
use crate::rounding;
use crate::sessions::{References, Session};

/// The kinds that one way to measure has.
fn kinds_of(measure: Measure) -> &'static [&'static str] {
    match measure {
        Measure::Point => &["point"],
        Measure::Pose => &["point", "orientation"],
        Measure::Distance => &["distance"],
        Measure::Bearing => &["bearing"],
        Measure::Pointing => &["pointing"],
        Measure::Socket => &["socket"],
        Measure::Touch => &["touch"],
    }
}

/// The places that one way to measure refers to.
fn places_of(measure: Measure, all: &References) -> Vec<Place> {
    let listed = all.pointing.as_ref().and_then(|p| p.stations.as_ref());
    let points = |station: &usize| listed.is_none_or(|listed| listed.contains(station));
    let (kind, indices): (_, Vec<usize>) = match measure {
        Measure::Point | Measure::Pose => return Vec::new(),
        Measure::Distance => (PlaceKind::Anchor, (0..all.anchors.len()).collect()),
        Measure::Bearing => {
            let pointing = all.pointing.is_some();
            let sees = |station: &usize| !(pointing && points(station));
            let stations = (0..all.stations.len()).filter(sees);
            (PlaceKind::Station, stations.collect())
        }
        Measure::Pointing => {
            let stations = (0..all.stations.len()).filter(points);
            (PlaceKind::Station, stations.collect())
        }
        Measure::Socket => (PlaceKind::Socket, (0..all.sockets.len()).collect()),
        Measure::Touch => (PlaceKind::Plane, (0..all.planes.len()).collect()),
    };
    let place = |index| Place { kind, index };
    indices.into_iter().map(place).collect()
}

/// How one sample is measured: the way, and its place where it has one.
fn turn_of(scenario: &Scenario, sample: usize) -> (Measure, Option<Place>) {
    let ways = scenario.measure.len();
    let measure = scenario.measure[sample % ways];
    let places = places_of(measure, &scenario.instrument.references);
    let turn = sample / ways;
    let place = (!places.is_empty()).then(|| places[turn % places.len()]);
    (measure, place)
}

/// Measures every sample in its own way; `outliers` are those that go wrong. The session is left without what the
/// scenario hides.
///
/// # Errors
/// A socket or a plane that the robot does not reach.
pub(crate) fn measure(
    scenario: &Scenario,
    model: &Model,
    session: &mut Session,
    outliers: &[usize],
    seed: u64,
) -> Result<(), SimulateError> {
    let mut draw = random(seed, Stream::Kinds);
    let count = session.samples.len();
    let normal = |draw: &mut ChaCha8Rng| -> [f64; 3] {
        std::array::from_fn(|_| StandardNormal.sample(draw))
    };
    let noises: Vec<[f64; 3]> = (0..count).map(|_| normal(&mut draw)).collect();
    let turned: Vec<[f64; 3]> = (0..count).map(|_| normal(&mut draw)).collect();
    let points = scenario.noise.map_or(0.0, |noise| noise.sigma_mm);
    for sample in 0..count {
        let (measure, place) = turn_of(scenario, sample);
        if let (Measure::Socket | Measure::Touch, Some(place)) = (measure, place) {
            let wild = if outliers.contains(&sample) {
                scenario.outliers.map_or(0.0, |o| o.mm)
            } else {
                0.0
            };
            let sigma = match measure {
                Measure::Touch => scenario.instrument.sigma_touch_mm.unwrap_or(0.0),
                _ => points,
            };
            let off = noises[sample].map(|n| sigma * n + wild);
            brought(scenario, model, session, sample, (place, off))?;
        }
    }
    let seen = predictions(session, JointValues::Commanded, model);
    if scenario
        .measure
        .iter()
        .all(|m| !matches!(m, Measure::Point | Measure::Pose))
    {
        session.samples.z_mm = Some(vec![f64::NAN; count]);
    }
    for sample in 0..count {
        let (measure, place) = turn_of(scenario, sample);
        let references = &session.instrument.references;
        let at = place.map_or([None; MOST], |place| stated(references, place));
        let at = at.map(|v| v.unwrap_or(0.0));
        let seen = Seen {
            point: seen[sample].0,
            attitude: seen[sample].1,
            place: &at,
        };
        if measure != Measure::Point && measure != Measure::Pose {
            let samples = &mut session.samples;
            (samples.x_mm[sample], samples.y_mm[sample]) = (f64::NAN, f64::NAN);
            if let Some(z) = &mut samples.z_mm {
                z[sample] = f64::NAN;
            }
        }
        let wild = outliers
            .contains(&sample)
            .then_some(scenario.outliers)
            .flatten();
        let kinds = kinds_of(measure).iter();
        for own in kinds.filter_map(|name| KINDS.iter().find(|k| k.about().name == *name)) {
            let unit = if own.about().name == "orientation" {
                turned[sample]
            } else {
                noises[sample]
            };
            let Some(noise) = noise_of(*own, scenario, &seen, unit) else {
                continue;
            };
            let wild = wild.map_or(0.0, |o| o.mm / own.lever_mm(&seen).max(rounding::COMPUTED));
            let noise = noise.map(|n| n + wild);
            own.show(session, sample, place.map(|p| p.index), &seen, noise);
        }
    }
    hide(&mut session.instrument.references, &scenario.unknown);
    Ok(())
}

/// The noise of one measurement, inner units; `None` for a plain point, which has its own already.
fn noise_of(kind: &dyn Kind, scenario: &Scenario, seen: &Seen, unit: [f64; 3]) -> Option<[f64; 3]> {
    let instrument = &scenario.instrument;
    if kind.about().name != "point" {
        let sigma = kind.sigma(instrument).unwrap_or(0.0);
        return Some(unit.map(|n| sigma * n));
    }
    let tracker = instrument.tracker?;
    let beam = Vector3::from(seen.point) - tracker.position_mm.coords;
    let far = beam.norm();
    let along = beam / far.max(rounding::COMPUTED);
    let unit = Vector3::from(unit);
    let part = unit.dot(&along);
    let across = unit - along * part;
    let noise = along * (part * tracker.sigma_range_mm) + across * (tracker.sigma_angle * far);
    Some(noise.into())
}

/// Moves a stop so that the real robot has its target in a socket or on a plane.
fn brought(
    scenario: &Scenario,
    model: &Model,
    session: &mut Session,
    sample: usize,
    (Place { kind, index }, off): (Place, [f64; 3]),
) -> Result<(), SimulateError> {
    let references = &scenario.instrument.references;
    let mut own = Inputs::new(session, JointValues::Commanded).select(&[sample]);
    let missing = |at: [f64; 3]| -> Option<Missing> {
        if kind == PlaceKind::Plane {
            let (normal, distance) = references.planes[index].stated?;
            let n: [f64; 3] = normal.into_inner().into();
            return Some((vec![distance + off[0] - dot(n, at)], vec![n]));
        }
        let socket = references.sockets[index].position_mm?;
        let left = (0..3).map(|k| socket[k] + off[k] - at[k]).collect();
        Some((left, AXES.to_vec()))
    };
    if missing([0.0; 3]).is_none() {
        return Ok(());
    }
    if bring(model, &mut own, |at| missing(at).unwrap_or_default()) {
        for (to, from) in session.samples.q.iter_mut().zip(&own.q) {
            to[sample] = from[0];
        }
        return Ok(());
    }
    let name = crate::effects::places::name(references, Place { kind, index });
    let found = text!(
        "'{name}' is not reached from stop {sample}",
        name,
        sample = sample + 1
    );
    let place = FilePlace::default().in_field("measure");
    let expected = text!("places within reach, and poses near them");
    Err(Rejected::because(Diagnostic::error(place, found, expected)).into())
}

/// Removes what the session does not state.
fn hide(references: &mut References, unknown: &[PlaceKind]) {
    let hidden = |kind| unknown.contains(&kind);
    for anchor in &mut references.anchors {
        if hidden(PlaceKind::Anchor) {
            (anchor.position_mm, anchor.offset_mm) = (None, None);
        }
    }
    for station in &mut references.stations {
        if hidden(PlaceKind::Station) {
            (station.position_mm, station.attitude) = (None, None);
        }
    }
    for plane in references
        .planes
        .iter_mut()
        .filter(|_| hidden(PlaceKind::Plane))
    {
        plane.stated = None;
    }
    for socket in references
        .sockets
        .iter_mut()
        .filter(|_| hidden(PlaceKind::Socket))
    {
        socket.position_mm = None;
    }
}
