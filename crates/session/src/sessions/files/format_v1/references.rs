//! `anchors`, `stations`, `planes`, `sockets`, `socket_distances_mm`, `pointing`: what measurements
//! other than points refer to.

use crate::text::Template;
use nalgebra::{Point3, Quaternion, Unit, UnitQuaternion, Vector3};

use crate::document::kinds::{NUMBER, TEXT, components, point, wxyz};
use crate::document::object::{Cursor, Kind, Object, written};
use crate::document::{Member, Node, Value};
use crate::sessions::references::{
    Anchor, Azimuth, Plane, Pointing, References, Socket, SocketDistance, Station,
};

/// The fields of a session, or a scenario, that are declared here.
pub fn references(o: &mut Object<'_, '_>, all: &mut References) {
    named(o, "anchors", &mut all.anchors, &ANCHOR);
    named(o, "stations", &mut all.stations, &STATION);
    named(o, "planes", &mut all.planes, &PLANE);
    named(o, "sockets", &mut all.sockets, &SOCKET);
    let (key, sockets) = ("socket_distances_mm", &all.sockets);
    if o.given(key) {
        let read = |at: &mut Cursor<'_, '_>| Some(distances(at, sockets));
        let name = |index: usize| Value::from(&sockets[index].name);
        let write = |all: &Vec<SocketDistance>| {
            let one = |d: &SocketDistance| {
                let [a, b] = d.between;
                [name(a), name(b), d.distance_mm.into()]
            };
            (!all.is_empty()).then(|| all.iter().map(one).collect())
        };
        o.with(key, &mut all.socket_distances, BETWEEN, read, write);
    }
    let (key, stations) = ("pointing", &all.stations);
    if o.given(key) {
        let declare = |o: &mut Object<'_, '_>, own: &mut Pointing| pointing(o, own, stations);
        let read = |at: &mut Cursor<'_, '_>| {
            let mut own = Pointing {
                axis: Vector3::z_axis(),
                stations: None,
            };
            at.fill(&mut own, declare).then_some(Some(own))
        };
        let write = |own: &Option<Pointing>| own.clone().map(|own| written(own, declare));
        let expected = phrase!("an object");
        o.with(key, &mut all.pointing, expected, read, write);
    }
}

/// One of the things that have names.
struct Entry<T> {
    blank: fn(String) -> T,
    name: fn(&T) -> &String,
    /// What is not known is null.
    is_known: fn(&T) -> bool,
    declare: fn(&mut Object<'_, '_>, &mut T),
}

/// An object with one entry for each name, not written where there is none.
fn named<T: Clone>(o: &mut Object<'_, '_>, key: &'static str, all: &mut Vec<T>, entry: &Entry<T>) {
    if !o.given(key) {
        return;
    }
    let read = |at: &mut Cursor<'_, '_>| {
        at.named(|name, at| {
            let mut one = (entry.blank)(name.to_owned());
            let is_empty = matches!(&at.node.value, Value::Object(members) if members.is_empty());
            if at.node.value != Value::Null && !is_empty {
                at.expected = text!("an object");
                at.fill(&mut one, entry.declare);
            }
            one
        })
    };
    let write = |all: &Vec<T>| {
        let one = |one: &T| {
            let known = (entry.is_known)(one);
            let fields = known.then(|| written(one.clone(), entry.declare));
            Member::new((entry.name)(one), fields)
        };
        (!all.is_empty()).then(|| Value::Object(all.iter().map(one).collect()))
    };
    let expected = phrase!("an object");
    o.with(key, all, expected, read, write);
}

const POSITION: Kind<Option<Point3<f64>>> = Kind {
    expected: phrase!("an array of 3 numbers"),
    read: |at| at.numbers::<3>().map(|position| Some(position.into())),
    write: |position| position.as_ref().map(point(phrase!("")).write).into(),
};

/// Of any length but zero.
const DIRECTION: Kind<Unit<Vector3<f64>>> = Kind {
    expected: phrase!("an array of 3 numbers"),
    read: |at| {
        let unit = Unit::try_new(Vector3::from(at.numbers::<3>()?), 1e-9);
        unit.or_else(|| {
            let expected = at.expected.clone();
            at.error(text!("zero length"), expected)
        })
    },
    write: components,
};

const ATTITUDE: Kind<Option<UnitQuaternion<f64>>> = Kind {
    expected: phrase!("an array of 4 numbers: w, x, y, z"),
    read: |at| {
        let [w, x, y, z] = at.numbers::<4>()?;
        let unit = UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-9);
        let unit = unit.or_else(|| {
            let expected = at.expected.clone();
            at.error(text!("zero length"), expected)
        });
        unit.map(Some)
    },
    write: |attitude| attitude.as_ref().map(wxyz).into(),
};

const AZIMUTH: Kind<Azimuth> = Kind {
    expected: TEXT.expected,
    read: |at| {
        let all = [Azimuth::Counterclockwise, Azimuth::Clockwise];
        at.one_of(&all, Azimuth::name)
    },
    write: |azimuth| azimuth.name().into(),
};

const ANCHOR: Entry<Anchor> = Entry {
    blank: |name| Anchor {
        name,
        position_mm: None,
        offset_mm: Some(0.0),
    },
    name: |anchor| &anchor.name,
    is_known: |_| true,
    declare: |o, anchor| {
        o.usual("position_mm", &mut anchor.position_mm, &POSITION);
        o.usual_or_null("offset_mm", &mut anchor.offset_mm, &NUMBER);
    },
};

const STATION: Entry<Station> = Entry {
    blank: |name| Station {
        name,
        position_mm: None,
        attitude: None,
        azimuth: Azimuth::default(),
    },
    name: |station| &station.name,
    is_known: |_| true,
    declare: |o, station| {
        o.usual("position_mm", &mut station.position_mm, &POSITION);
        o.usual("quaternion_wxyz", &mut station.attitude, &ATTITUDE);
        o.usual("azimuth", &mut station.azimuth, &AZIMUTH);
    },
};

const PLANE: Entry<Plane> = Entry {
    blank: |name| Plane { name, stated: None },
    name: |plane| &plane.name,
    is_known: |plane| plane.stated.is_some(),
    declare: |o, plane| {
        let (mut normal, mut distance) = plane.stated.unwrap_or((Vector3::z_axis(), 0.0));
        o.required("normal", &mut normal, &DIRECTION);
        o.required("distance_mm", &mut distance, &NUMBER);
        if o.has_read_well() {
            plane.stated = Some((normal, distance));
        }
    },
};

const SOCKET: Entry<Socket> = Entry {
    blank: |name| Socket {
        name,
        position_mm: None,
    },
    name: |socket| &socket.name,
    is_known: |_| true,
    declare: |o, socket| o.usual("position_mm", &mut socket.position_mm, &POSITION),
};

const BETWEEN: Template = phrase!(
    "two different sockets of the session and their distance above 0 mm, such as [\"S1\", \"S2\", 400.0]"
);

fn distances(at: &mut Cursor<'_, '_>, sockets: &[Socket]) -> Vec<SocketDistance> {
    let read = |node: &Node| {
        let Value::List(three) = &node.value else {
            return None;
        };
        let values: Vec<&Value> = three.iter().map(|node| &node.value).collect();
        let [Value::Text(a), Value::Text(b), Value::Number(distance_mm)] = values[..] else {
            return None;
        };
        let [a, b] = [a, b].map(|name| sockets.iter().position(|s| s.name == *name));
        let (between, distance_mm) = ([a?, b?], *distance_mm);
        let sound = a != b && distance_mm.is_finite() && distance_mm > 0.0;
        sound.then_some(SocketDistance {
            between,
            distance_mm,
        })
    };
    let all = at.list_by(|at| {
        at.expected = BETWEEN.into();
        read(at.node).or_else(|| at.wrong())
    });
    all.unwrap_or_default()
}

fn pointing(o: &mut Object<'_, '_>, own: &mut Pointing, stations: &[Station]) {
    o.required("axis", &mut own.axis, &DIRECTION);
    if !o.given("stations") {
        return;
    }
    let read = |at: &mut Cursor<'_, '_>| {
        let station = |at: &mut Cursor<'_, '_>| {
            at.expected = phrase!("a station of the session").into();
            let is =
                |one: &Station| matches!(&at.node.value, Value::Text(name) if *name == one.name);
            stations.iter().position(is).or_else(|| at.wrong())
        };
        Some(Some(at.list_by(station).unwrap_or_default()))
    };
    let write = |all: &Option<Vec<usize>>| {
        let name = |index: &usize| &stations[*index].name;
        all.as_ref().map(|all| all.iter().map(name).collect())
    };
    let expected = text!("an array of names");
    o.with("stations", &mut own.stations, expected, read, write);
}
