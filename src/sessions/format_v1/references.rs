//! `anchors`, `stations`, `planes`, `sockets`, `socket_distances_mm`, `pointing`: what measurements
//! other than points refer to, read and written.

use nalgebra::{Point3, Quaternion, Unit, UnitQuaternion, Vector3};
use serde::Serialize;
use serde::ser::{SerializeMap, Serializer};

use crate::sessions::json::{Fields, Member, Node, Path, Value, optional};
use crate::sessions::number::quoted;
use crate::sessions::references::{
    Anchor, Azimuth, Plane, Pointing, References, Socket, SocketDistance, Station,
};

/// The keys of a session, or a scenario, that are read here.
pub(crate) const KEYS: [&str; 6] = [
    "anchors",
    "stations",
    "planes",
    "sockets",
    "socket_distances_mm",
    "pointing",
];

const POSITION: &str = "an array of 3 numbers: the position in the measuring frame, mm; or null";

/// Reads all of them; what is wrong is in the findings.
pub(crate) fn references(
    fields: &mut Fields<'_>,
    members: &[Member],
    path: &Path<'_>,
) -> References {
    let anchors = named(fields, members, path, "anchors", anchor);
    let stations = named(fields, members, path, "stations", station);
    let planes = named(fields, members, path, "planes", plane);
    let sockets = named(fields, members, path, "sockets", socket);
    let socket_distances = optional(members, "socket_distances_mm").map(|node| {
        let path = &path.key("socket_distances_mm");
        socket_distances(fields, node, path, &sockets)
    });
    let pointing = optional(members, "pointing")
        .and_then(|node| pointing(fields, node, &path.key("pointing"), &stations));
    References {
        anchors,
        stations,
        planes,
        sockets,
        socket_distances: socket_distances.unwrap_or_default(),
        pointing,
    }
}

/// An object with one entry for each name.
fn named<T>(
    fields: &mut Fields<'_>,
    members: &[Member],
    path: &Path<'_>,
    key: &str,
    read: fn(&mut Fields<'_>, &str, &Node, &Path<'_>) -> T,
) -> Vec<T> {
    let Some(node) = optional(members, key) else {
        return Vec::new();
    };
    let path = &path.key(key);
    let entries = fields.object(node, path, "an object with an entry for each name");
    let mut all = Vec::new();
    for entry in entries.unwrap_or_default() {
        let path = &path.key(&entry.key);
        if entry.key.trim() != entry.key || entry.key.is_empty() {
            let expected = "a name without spaces around it";
            fields.error(entry.key_at, path, quoted(&entry.key), expected);
        }
        all.push(read(fields, &entry.key, &entry.node, path));
    }
    all
}

/// The members of an entry, which may be null where nothing is known.
fn entry<'n>(
    fields: &mut Fields<'_>,
    node: &'n Node,
    path: &Path<'_>,
    known: &[&str],
) -> &'n [Member] {
    if node.value == Value::Null {
        return &[];
    }
    let expected = format!("an object with {}, or null", known.join(", "));
    let members = fields.object(node, path, &expected).unwrap_or_default();
    fields.unknown_keys(members, path, known);
    members
}

fn position(fields: &mut Fields<'_>, members: &[Member], path: &Path<'_>) -> Option<Point3<f64>> {
    let node = optional(members, "position_mm")?;
    let position = fields.numbers::<3>(node, &path.key("position_mm"), POSITION);
    position.map(Point3::from)
}

fn anchor(fields: &mut Fields<'_>, name: &str, node: &Node, path: &Path<'_>) -> Anchor {
    let members = entry(fields, node, path, &["position_mm", "offset_mm"]);
    let offset = members.iter().find(|m| m.key == "offset_mm");
    let offset_mm = match offset {
        None => Some(0.0),
        Some(member) if member.node.value == Value::Null => None,
        Some(member) => {
            // What failed was reported; it must not become unknown besides.
            let read = fields.number(&member.node, &path.key("offset_mm"));
            Some(read.unwrap_or(0.0))
        }
    };
    Anchor {
        name: name.to_owned(),
        position_mm: position(fields, members, path),
        offset_mm,
    }
}

fn station(fields: &mut Fields<'_>, name: &str, node: &Node, path: &Path<'_>) -> Station {
    let known = ["position_mm", "quaternion_wxyz", "azimuth"];
    let members = entry(fields, node, path, &known);
    let azimuth = match optional(members, "azimuth").map(|node| (node, &node.value)) {
        None => Azimuth::Counterclockwise,
        Some((node, value)) => {
            let all = [Azimuth::Counterclockwise, Azimuth::Clockwise];
            let read = all
                .into_iter()
                .find(|a| matches!(value, Value::Text(text) if text == a.name()));
            if read.is_none() {
                let expected = "\"counterclockwise\" or \"clockwise\"";
                fields.mismatch(node, &path.key("azimuth"), expected);
            }
            read.unwrap_or_default()
        }
    };
    let attitude = optional(members, "quaternion_wxyz").and_then(|node| {
        let path = &path.key("quaternion_wxyz");
        let expected =
            "an array of 4 numbers: w, x, y, z of a quaternion that is not zero; or null";
        let [w, x, y, z] = fields.numbers::<4>(node, path, expected)?;
        let unit = UnitQuaternion::try_new(Quaternion::new(w, x, y, z), 1e-9);
        if unit.is_none() {
            fields.error(node.at, path, "a quaternion of zero length", expected);
        }
        unit
    });
    Station {
        name: name.to_owned(),
        position_mm: position(fields, members, path),
        attitude,
        azimuth,
    }
}

/// A direction of any length but zero.
fn direction(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>) -> Option<Unit<Vector3<f64>>> {
    let expected = "an array of 3 numbers: a direction that is not zero";
    let direction = Vector3::from(fields.numbers::<3>(node, path, expected)?);
    let unit = Unit::try_new(direction, 1e-9);
    if unit.is_none() {
        fields.error(node.at, path, "a direction of zero length", expected);
    }
    unit
}

fn plane(fields: &mut Fields<'_>, name: &str, node: &Node, path: &Path<'_>) -> Plane {
    let members = entry(fields, node, path, &["normal", "distance_mm"]);
    let known = (!members.is_empty()).then(|| {
        let expected = "a direction across the plane";
        let normal = fields.required(members, node.at, path, "normal", expected);
        let normal = normal.and_then(|node| direction(fields, node, &path.key("normal")));
        let distance = fields.required_number(members, node.at, path, "distance_mm");
        normal.zip(distance)
    });
    Plane {
        name: name.to_owned(),
        known: known.flatten(),
    }
}

fn socket(fields: &mut Fields<'_>, name: &str, node: &Node, path: &Path<'_>) -> Socket {
    let members = entry(fields, node, path, &["position_mm"]);
    Socket {
        name: name.to_owned(),
        position_mm: position(fields, members, path),
    }
}

fn socket_distances(
    fields: &mut Fields<'_>,
    node: &Node,
    path: &Path<'_>,
    sockets: &[Socket],
) -> Vec<SocketDistance> {
    const EXPECTED: &str = "two different sockets of the session and their distance above 0 mm, \
                            such as [\"S1\", \"S2\", 400.0]";
    let list = match &node.value {
        Value::List(list) => list.as_slice(),
        // An empty array has no kind.
        Value::Numbers(numbers) if numbers.is_empty() => &[],
        _ => {
            fields.mismatch(node, path, "an array of [\"S1\", \"S2\", 400.0]");
            &[]
        }
    };
    let mut all = Vec::new();
    for (index, node) in list.iter().enumerate() {
        let path = &path.index(index);
        let place = |value: &Value| match value {
            Value::Text(name) => sockets.iter().position(|s| s.name == *name),
            _ => None,
        };
        let read = match &node.value {
            Value::List(three) => match three.as_slice() {
                [a, b, distance] => match (place(&a.value), place(&b.value), &distance.value) {
                    (Some(a), Some(b), Value::Number(mm))
                        if a != b && mm.is_finite() && *mm > 0.0 =>
                    {
                        Some(SocketDistance {
                            between: [a, b],
                            distance_mm: *mm,
                        })
                    }
                    _ => None,
                },
                _ => None,
            },
            _ => None,
        };
        match read {
            Some(distance) => all.push(distance),
            None => fields.mismatch(node, path, EXPECTED),
        }
    }
    all
}

fn pointing(
    fields: &mut Fields<'_>,
    node: &Node,
    path: &Path<'_>,
    stations: &[Station],
) -> Option<Pointing> {
    let members = fields.object(node, path, "an object with axis")?;
    fields.unknown_keys(members, path, &["axis", "stations"]);
    let expected = "the direction in the tool frame that points";
    let axis = fields.required(members, node.at, path, "axis", expected)?;
    let axis = direction(fields, axis, &path.key("axis"))?;
    let listed = optional(members, "stations").map(|node| {
        let path = &path.key("stations");
        let expected = "an array of names of stations";
        let Value::List(list) = &node.value else {
            fields.mismatch(node, path, expected);
            return Vec::new();
        };
        let mut all = Vec::new();
        for (index, node) in list.iter().enumerate() {
            let place = match &node.value {
                Value::Text(name) => stations.iter().position(|s| s.name == *name),
                _ => None,
            };
            match place {
                Some(place) => all.push(place),
                None => fields.mismatch(node, &path.index(index), "a station of the session"),
            }
        }
        all
    });
    Some(Pointing {
        axis,
        stations: listed,
    })
}

/// One entry for each name.
#[derive(Debug)]
pub(crate) struct Named<T>(Vec<(String, T)>);

impl<T> Named<T> {
    pub(crate) fn is_empty(&self) -> bool {
        self.0.is_empty()
    }
}

impl<T: Serialize> Serialize for Named<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for (name, entry) in &self.0 {
            map.serialize_entry(name, entry)?;
        }
        map.end()
    }
}

/// The keys as serde writes them into a session.
#[derive(Debug, Serialize)]
pub(crate) struct ReferencesTwin {
    #[serde(skip_serializing_if = "Named::is_empty")]
    anchors: Named<AnchorTwin>,
    #[serde(skip_serializing_if = "Named::is_empty")]
    stations: Named<StationTwin>,
    #[serde(skip_serializing_if = "Named::is_empty")]
    planes: Named<Option<PlaneTwin>>,
    #[serde(skip_serializing_if = "Named::is_empty")]
    sockets: Named<SocketTwin>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    socket_distances_mm: Vec<(String, String, f64)>,
    #[serde(skip_serializing_if = "Option::is_none")]
    pointing: Option<PointingTwin>,
}

#[derive(Debug, Serialize)]
struct AnchorTwin {
    position_mm: Option<[f64; 3]>,
    offset_mm: Option<f64>,
}

#[derive(Debug, Serialize)]
struct StationTwin {
    position_mm: Option<[f64; 3]>,
    quaternion_wxyz: Option<[f64; 4]>,
    azimuth: &'static str,
}

#[derive(Debug, Serialize)]
struct PlaneTwin {
    normal: [f64; 3],
    distance_mm: f64,
}

#[derive(Debug, Serialize)]
struct SocketTwin {
    position_mm: Option<[f64; 3]>,
}

#[derive(Debug, Serialize)]
struct PointingTwin {
    axis: [f64; 3],
    #[serde(skip_serializing_if = "Option::is_none")]
    stations: Option<Vec<String>>,
}

impl ReferencesTwin {
    pub(crate) fn of(all: &References) -> Self {
        let point = |p: Option<Point3<f64>>| p.map(|p| <[f64; 3]>::from(p.coords));
        let anchor = |a: &Anchor| AnchorTwin {
            position_mm: point(a.position_mm),
            offset_mm: a.offset_mm,
        };
        let station = |s: &Station| StationTwin {
            position_mm: point(s.position_mm),
            quaternion_wxyz: s.attitude.map(|q| [q.w, q.i, q.j, q.k]),
            azimuth: s.azimuth.name(),
        };
        let plane = |p: &Plane| {
            p.known.map(|(normal, distance_mm)| PlaneTwin {
                normal: normal.into_inner().into(),
                distance_mm,
            })
        };
        let socket_name = |i: usize| all.sockets[i].name.clone();
        let distance = |d: &SocketDistance| {
            let [a, b] = d.between;
            (socket_name(a), socket_name(b), d.distance_mm)
        };
        let pointing = |p: &Pointing| PointingTwin {
            axis: p.axis.into_inner().into(),
            stations: p.stations.as_ref().map(|list| {
                let name = |i: &usize| all.stations[*i].name.clone();
                list.iter().map(name).collect()
            }),
        };
        let sockets = all.sockets.iter().map(|s| {
            let position_mm = point(s.position_mm);
            (s.name.clone(), SocketTwin { position_mm })
        });
        Self {
            anchors: Named(
                all.anchors
                    .iter()
                    .map(|a| (a.name.clone(), anchor(a)))
                    .collect(),
            ),
            stations: Named(
                all.stations
                    .iter()
                    .map(|s| (s.name.clone(), station(s)))
                    .collect(),
            ),
            planes: Named(
                all.planes
                    .iter()
                    .map(|p| (p.name.clone(), plane(p)))
                    .collect(),
            ),
            sockets: Named(sockets.collect()),
            socket_distances_mm: all.socket_distances.iter().map(distance).collect(),
            pointing: all.pointing.as_ref().map(pointing),
        }
    }
}
