//! Unknown places that measurements refer to: anchors, stations, planes, sockets.
//!
//! They are no effects of the robot and do not change it, so they are in no catalogue. They are terms of a model
//! nevertheless, so that what was found of them is fitted, held, reported and saved like everything else. A part that
//! the session states is held at its stated value.
//!
//! ```text
//! anchor   x, y, z mm, offset mm          station  rotation vector rad, x, y, z mm
//! plane    normal (its largest component is kept), distance mm      socket   x, y, z mm
//! ```

use nalgebra::{Point3, Vector3};

use super::Term;
use super::place::{MOST, Place, PlaceKind};
use crate::kinematics::quaternion::log;
use crate::sessions::{Anchor, Plane, References, Socket, Station};

/// The stated coefficients of a place; `None` where the session does not state them.
pub fn stated(references: &References, place: Place) -> [Option<f64>; MOST] {
    let mut all = [None; MOST];
    let mut put = |first: usize, values: &[f64]| {
        for (to, value) in all[first..].iter_mut().zip(values) {
            *to = Some(*value);
        }
    };
    let point = |p: &Point3<f64>| <[f64; 3]>::from(p.coords);
    match place.kind {
        PlaceKind::Anchor => {
            let Anchor {
                position_mm,
                offset_mm,
                ..
            } = &references.anchors[place.index];
            if let Some(position) = position_mm {
                put(0, &point(position));
            }
            if let Some(offset) = offset_mm {
                put(3, &[*offset]);
            }
        }
        PlaceKind::Station => {
            let Station {
                position_mm,
                attitude,
                ..
            } = &references.stations[place.index];
            if let Some(attitude) = attitude {
                put(0, log(attitude).as_slice());
            }
            if let Some(position) = position_mm {
                put(3, &point(position));
            }
        }
        PlaceKind::Plane => {
            let Plane { stated: known, .. } = &references.planes[place.index];
            if let Some((normal, distance)) = known {
                put(0, normal.as_slice());
                put(3, &[*distance]);
            }
        }
        PlaceKind::Socket => {
            let Socket { position_mm, .. } = &references.sockets[place.index];
            if let Some(position) = position_mm {
                put(0, &point(position));
            }
        }
    }
    all
}

/// Name of a place in the session.
pub fn name(references: &References, place: Place) -> &str {
    match place.kind {
        PlaceKind::Anchor => &references.anchors[place.index].name,
        PlaceKind::Station => &references.stations[place.index].name,
        PlaceKind::Plane => &references.planes[place.index].name,
        PlaceKind::Socket => &references.sockets[place.index].name,
    }
}

/// The term of a place that is not wholly known, from its starting values. `attitude_only` is for a station from which
/// only directions of the tool are measured.
pub(crate) fn term(
    references: &References,
    place: Place,
    start: &[f64; MOST],
    attitude_only: bool,
) -> Term {
    let mut term = Term::absent(place.kind.effect(), 0, place.index as f64);
    let known = stated(references, place);
    for k in 0..term.coefficients.len() {
        term.coefficients[k] = known[k].unwrap_or(start[k]);
        if known[k].is_some() {
            term.held = term.held.with(k);
        }
    }
    if attitude_only {
        for k in 3..term.coefficients.len() {
            term.coefficients[k] = 0.0;
            term.held = term.held.with(k);
        }
    }
    if place.kind == PlaceKind::Plane && known[0].is_none() {
        // A normal has two degrees of freedom: its largest component stays 1 or −1.
        let own = &mut term.coefficients;
        let largest = (0..3).fold(0, |a, b| if own[b].abs() > own[a].abs() { b } else { a });
        let size = own[largest].abs().max(f64::MIN_POSITIVE);
        for normal in &mut own[..3] {
            *normal /= size;
        }
        term.held = term.held.with(largest);
    }
    term.label = Some(name(references, place).into());
    term
}

/// A normal as a place's coefficients have it, which need not be of unit length.
pub(crate) fn unit_normal(coefficients: &[f64]) -> (nalgebra::Unit<Vector3<f64>>, f64) {
    let v = Vector3::new(coefficients[0], coefficients[1], coefficients[2]);
    let length = v.norm().max(f64::MIN_POSITIVE);
    (nalgebra::Unit::new_unchecked(v / length), length)
}
