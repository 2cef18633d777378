//! The messages that are of use: joint values, poses, points and transforms, in CDR or in JSON.
//!
//! Joint values are in rad (sliding joints: m), positions in m, quaternions as x, y, z, w. A time
//! is that of the message's header, ns.

use serde::Deserialize;

use crate::document::number::quoted;
use crate::text::Text;

pub(super) use super::cdr::not_whole;
use super::cdr::{Cdr, Wrong};

/// Joints or transforms of one message are fewer.
const MOST: usize = 4096;

named! {
    /// A type of message, whatever package and version its name says it is from.
    #[derive(Debug, Clone, Copy, PartialEq, Eq)]
    pub(super) enum Type {
        JointState = "sensor_msgs/JointState",
        PoseStamped = "geometry_msgs/PoseStamped",
        PointStamped = "geometry_msgs/PointStamped",
        TransformStamped = "geometry_msgs/TransformStamped",
        TfMessage = "tf2_msgs/TFMessage",
    }
    /// Its name in ROS.
    pub(super) fn name;
    /// All of them.
    const ALL;
}

impl Type {
    /// By the last part of a schema's name.
    pub(super) fn of(name: &str) -> Option<Self> {
        let last = |name: &str| name.rsplit(['/', '.', ':']).next().map(str::to_owned);
        let is_it = |one: &Self| last(one.name()) == last(name);
        Self::ALL.into_iter().find(is_it)
    }
}

/// Time and frame of a message; a time of zero says nothing.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Header {
    pub(super) time_ns: i64,
    pub(super) frame: String,
}

/// Something that was measured in a frame.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Measured {
    pub(super) header: Header,
    /// The frame that a transform leads to; empty for poses and points.
    pub(super) child: String,
    pub(super) position_m: [f64; 3],
    pub(super) orientation_xyzw: Option<[f64; 4]>,
}

/// What a message says.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Content {
    /// Joints by name.
    Joints {
        header: Header,
        names: Vec<String>,
        /// rad or m; as many as names.
        values: Vec<f64>,
    },
    Measured(Vec<Measured>),
}

/// Reads a message of this type.
///
/// # Errors
/// What is wrong with it, in words.
pub(super) fn read(type_: Type, encoding: &str, data: &[u8]) -> Result<Content, Wrong> {
    match encoding {
        "cdr" => from_cdr(type_, &mut Cdr::new(data)?),
        "json" => from_json(type_, data),
        other => Err(Text::verbatim(quoted(other))),
    }
}

fn from_cdr(type_: Type, cdr: &mut Cdr<'_>) -> Result<Content, Wrong> {
    if type_ == Type::JointState {
        let header = header(cdr)?;
        let count = few(cdr.count(4)?)?;
        let names = (0..count).map(|_| cdr.text()).collect::<Result<_, _>>()?;
        return joints(header, names, cdr.numbers()?);
    }
    let count = match type_ {
        Type::TfMessage => few(cdr.count(8)?)?,
        _ => 1,
    };
    let measured = (0..count).map(|_| {
        let header = header(cdr)?;
        let is_transform = matches!(type_, Type::TfMessage | Type::TransformStamped);
        let child = if is_transform {
            cdr.text()?
        } else {
            String::new()
        };
        let position_m = [cdr.f64()?, cdr.f64()?, cdr.f64()?];
        let orientation_xyzw = match type_ {
            Type::PointStamped => None,
            _ => Some([cdr.f64()?, cdr.f64()?, cdr.f64()?, cdr.f64()?]),
        };
        Ok(Measured {
            header,
            child,
            position_m,
            orientation_xyzw,
        })
    });
    Ok(Content::Measured(measured.collect::<Result<_, Wrong>>()?))
}

fn few(count: usize) -> Result<usize, Wrong> {
    if count > MOST {
        return Err(not_whole());
    }
    Ok(count)
}

fn header(cdr: &mut Cdr<'_>) -> Result<Header, Wrong> {
    let (seconds, nanoseconds) = (cdr.i32()?, cdr.u32()?);
    Ok(Header {
        time_ns: i64::from(seconds) * 1_000_000_000 + i64::from(nanoseconds),
        frame: cdr.text()?,
    })
}

fn joints(header: Header, mut names: Vec<String>, values: Vec<f64>) -> Result<Content, Wrong> {
    // Any of the lists may be empty where it says nothing: a controller of forces has no positions.
    if values.is_empty() {
        names.clear();
    }
    if names.len() != values.len() {
        return Err(not_whole());
    }
    Ok(Content::Joints {
        header,
        names,
        values,
    })
}

#[derive(Deserialize, Default)]
#[serde(default)]
struct JsonStamp {
    #[serde(alias = "secs")]
    sec: i32,
    #[serde(alias = "nsec", alias = "nsecs")]
    nanosec: u32,
}

#[derive(Deserialize, Default)]
#[serde(default)]
struct JsonHeader {
    stamp: JsonStamp,
    frame_id: String,
}

impl From<JsonHeader> for Header {
    fn from(header: JsonHeader) -> Self {
        let JsonStamp { sec, nanosec } = header.stamp;
        Self {
            time_ns: i64::from(sec) * 1_000_000_000 + i64::from(nanosec),
            frame: header.frame_id,
        }
    }
}

#[derive(Deserialize)]
struct JsonJoints {
    #[serde(default)]
    header: JsonHeader,
    name: Vec<String>,
    #[serde(default)]
    position: Vec<f64>,
}

#[derive(Deserialize)]
struct JsonVector {
    x: f64,
    y: f64,
    z: f64,
}

#[derive(Deserialize)]
struct JsonQuaternion {
    x: f64,
    y: f64,
    z: f64,
    w: f64,
}

#[derive(Deserialize)]
struct JsonPlace {
    #[serde(alias = "translation")]
    position: JsonVector,
    #[serde(alias = "rotation")]
    orientation: JsonQuaternion,
}

/// A pose, a point or a transform, whichever it has.
#[derive(Deserialize)]
struct JsonMeasured {
    #[serde(default)]
    header: JsonHeader,
    #[serde(default)]
    child_frame_id: String,
    #[serde(alias = "transform")]
    pose: Option<JsonPlace>,
    point: Option<JsonVector>,
}

#[derive(Deserialize)]
struct JsonTransforms {
    transforms: Vec<JsonMeasured>,
}

fn from_json(type_: Type, data: &[u8]) -> Result<Content, Wrong> {
    let wrong = |error: serde_json::Error| Text::verbatim(error.to_string());
    let measured = match type_ {
        Type::JointState => {
            let read: JsonJoints = serde_json::from_slice(data).map_err(wrong)?;
            return joints(read.header.into(), read.name, read.position);
        }
        Type::TfMessage => {
            let read: JsonTransforms = serde_json::from_slice(data).map_err(wrong)?;
            read.transforms
        }
        _ => vec![serde_json::from_slice(data).map_err(wrong)?],
    };
    let measured = measured.into_iter().map(|read: JsonMeasured| {
        let (position, orientation) = match (read.pose, read.point) {
            (Some(place), _) => (place.position, Some(place.orientation)),
            (None, Some(point)) => (point, None),
            (None, None) => {
                return Err(not_whole());
            }
        };
        Ok(Measured {
            header: read.header.into(),
            child: read.child_frame_id,
            position_m: [position.x, position.y, position.z],
            orientation_xyzw: orientation.map(|q| [q.x, q.y, q.z, q.w]),
        })
    });
    Ok(Content::Measured(measured.collect::<Result<_, Wrong>>()?))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn types_are_known_whatever_the_version_of_their_name() {
        for name in [
            "sensor_msgs/msg/JointState",
            "sensor_msgs/JointState",
            "JointState",
        ] {
            assert_eq!(Type::of(name), Some(Type::JointState));
        }
        assert_eq!(Type::of("sensor_msgs/msg/JointStates"), None);
    }

    #[test]
    fn json_says_the_same_as_cdr() {
        let json = br#"{"header":{"stamp":{"sec":2,"nanosec":5},"frame_id":"f"},"point":{"x":1.5,"y":-1,"z":0}}"#;
        let mut cdr = b"\0\x01\0\0\x02\0\0\0\x05\0\0\0\x02\0\0\0f\0\0\0\0\0\0\0".to_vec();
        cdr.truncate(4 + 14);
        cdr.resize(4 + 16, 0);
        for value in [1.5_f64, -1.0, 0.0] {
            cdr.extend(value.to_le_bytes());
        }
        let point = read(Type::PointStamped, "json", json).unwrap();
        assert_eq!(read(Type::PointStamped, "cdr", &cdr).unwrap(), point);
        let Content::Measured(list) = point else {
            panic!("a point is measured");
        };
        assert_eq!(list[0].header.time_ns, 2_000_000_005);
    }

    #[test]
    fn what_is_no_such_message_is_refused_in_words() {
        for (type_, encoding, data, says) in [
            (Type::PoseStamped, "ros1", &b""[..], "'ros1'"),
            (Type::PoseStamped, "json", b"{}", "fields that are not"),
            (Type::PoseStamped, "json", b"[", "EOF"),
            (
                Type::JointState,
                "json",
                br#"{"name":["a"],"position":[1,2]}"#,
                "fields that are not",
            ),
            (
                Type::TfMessage,
                "cdr",
                b"\0\x01\0\0\xff\xff\0\0",
                "fields that are not",
            ),
        ] {
            let wrong = read(type_, encoding, data).unwrap_err();
            assert!(wrong.contains(says), "{wrong}");
        }
    }
}
