//! The session document but its samples.

use crate::text::{Template, Text};
use nalgebra::Point3;

use super::FORMAT;
use super::references::references;
use super::robot::ROBOT;
use crate::document::kinds::{DEGREES, TEXT, point, positive};
use crate::document::number::quoted;
use crate::document::object::{Kind, Object, written};
use crate::document::{Fields, Member, Node, Path, Value, degrees, ranges};
use crate::kinematics::Robot;
use crate::sessions::domain::{
    Instrument, Region, Session, Sigma, TARGETS_SIGMA_MM, Target, Tracker, default_targets,
};

/// Where the samples are.
pub(crate) enum SamplesAt {
    /// In a file with this name; the byte is where the document says so. With its hash, where the
    /// document holds it.
    File(String, usize, Option<String>),
    /// In the document itself.
    Inline(Node),
}

/// All of a session but its samples. Parts that are wrong are missing or empty, and the findings
/// have said so.
pub(crate) struct Head {
    pub(crate) name: String,
    pub(crate) note: String,
    pub(crate) robot: Option<Robot>,
    pub(crate) targets: Vec<Target>,
    pub(crate) instrument: Instrument,
    pub(crate) tolerance_mm: Option<f64>,
    pub(crate) regions: Vec<Region>,
    pub(crate) compensated_by: Option<String>,
}

fn head(o: &mut Object<'_, '_>, own: &mut Head) {
    o.describe("format", FORMAT);
    o.required("name", &mut own.name, &TEXT);
    o.usual_if(!own.note.is_empty(), "note", &mut own.note, &TEXT);
    if o.needs("robot", ROBOT.expected) {
        o.some("robot", &mut own.robot, &ROBOT);
    }
    let says = own.targets != default_targets();
    o.usual_if(says, "targets", &mut own.targets, &TARGETS);
    let plain = Instrument {
        references: own.instrument.references.clone(),
        ..Instrument::default()
    };
    let says = own.instrument != plain;
    o.usual_if(says, "instrument", &mut own.instrument, &INSTRUMENT);
    references(o, &mut own.instrument.references);
    o.optional("tolerance_mm", &mut own.tolerance_mm, &TOLERANCE_MM);
    let says = !own.regions.is_empty();
    o.usual_if(says, "regions", &mut own.regions, &REGIONS);
    o.usual_or_null("compensated_by", &mut own.compensated_by, &TEXT);
}

/// Reads the document; `None` when it is no session at all.
pub(crate) fn read(fields: &mut Fields<'_>, mut root: Node) -> Option<(Head, Option<SamplesAt>)> {
    let expected = text!("a session: an object with the key \"format\"");
    fields.of_format(&root, FORMAT, &expected)?;
    // Taken out of the tree: a million samples are not copied.
    let samples = match &mut root.value {
        Value::Object(members) => members
            .iter()
            .position(|member| member.key == "samples")
            .map(|index| members.remove(index)),
        _ => None,
    };
    if let Value::Object(members) = &root.value {
        // The robot's numbers are checked where robots are read, the samples' with their columns.
        for member in members.iter().filter(|member| member.key != "robot") {
            let path = Path::Root.key(&member.key);
            ranges::check(fields, &member.node, &path);
        }
    }
    let mut own = Head {
        name: String::new(),
        note: String::new(),
        robot: None,
        targets: default_targets(),
        instrument: Instrument::default(),
        tolerance_mm: None,
        regions: Vec::new(),
        compensated_by: None,
    };
    fields.at(&root, &Path::Root, expected).fill(&mut own, head);
    let samples = samples_at(fields, samples, root.at);
    Some((own, samples))
}

/// What is written of a session but its samples.
pub(crate) fn write(session: &Session) -> Value {
    let own = Head {
        name: session.name.clone(),
        note: session.note.clone(),
        robot: Some(session.robot.clone()),
        targets: session.targets.clone(),
        instrument: session.instrument.clone(),
        tolerance_mm: session.tolerance_mm,
        regions: session.regions.clone(),
        compensated_by: session.compensated_by.clone(),
    };
    written(own, head)
}

/// How far off a tool may be.
pub const TOLERANCE_MM: Kind<f64> = positive(phrase!("a number above 0"));

/// Names of targets, and where they are in the tool frame.
pub const TARGETS: Kind<Vec<Target>> = Kind {
    expected: phrase!("an object"),
    read: |at| {
        let targets = at.named(|name, at| {
            at.expected = phrase!("an array of 3 numbers").into();
            let position = at.numbers::<3>().map(Point3::from);
            Target {
                name: name.to_owned(),
                // A declaration that failed must not make every cell that names it fail too.
                position_mm: position.unwrap_or_default(),
            }
        })?;
        Some(if targets.is_empty() {
            default_targets()
        } else {
            targets
        })
    },
    write: |targets| {
        let one = |target: &Target| {
            Member::new(&target.name, <[f64; 3]>::from(target.position_mm.coords))
        };
        Value::Object(targets.iter().map(one).collect())
    },
};

/// The measuring instrument.
pub const INSTRUMENT: Kind<Instrument> = Kind {
    expected: phrase!("an object"),
    read: |at| at.object(Instrument::default(), instrument),
    write: |own| written(own.clone(), instrument),
};

fn instrument(o: &mut Object<'_, '_>, own: &mut Instrument) {
    o.required("name", &mut own.name, &TEXT);
    o.optional("sigma_mm", &mut own.sigma_mm, &SIGMA);
    // Null says that they are not known, which is another thing than to say nothing.
    if o.is_read() || own.targets_sigma_mm != Some(TARGETS_SIGMA_MM) {
        let kind = positive(phrase!("a number above 0"));
        o.usual_or_null("targets_sigma_mm", &mut own.targets_sigma_mm, &kind);
    }
    let says = !own.free_targets.is_empty();
    o.usual_if(says, "free_targets", &mut own.free_targets, &NAMES);
    tracker(o, &mut own.tracker);
    o.optional("sigma_mrad", &mut own.sigma_orientation, &MILLI);
    o.optional("sigma_distance_mm", &mut own.sigma_distance_mm, &ABOVE_0);
    o.optional("sigma_direction_urad", &mut own.sigma_direction, &MICRO);
    o.optional("sigma_touch_mm", &mut own.sigma_touch_mm, &ABOVE_0);
}

/// What a tracker says of itself: all of its three keys or none.
fn tracker(o: &mut Object<'_, '_>, own: &mut Option<Tracker>) {
    let keys = ["sigma_range_mm", "sigma_angle_urad", "position_mm"];
    let given = keys.into_iter().filter(|key| o.is_given(key));
    let given: Vec<&str> = given.collect();
    let mut range = own.map(|own| own.sigma_range_mm);
    let mut angle = own.map(|own| own.sigma_angle);
    let mut position = own.map(|own| own.position_mm);
    o.optional(keys[0], &mut range, &ABOVE_0);
    o.optional(keys[1], &mut angle, &MICRO);
    if !given.is_empty() && given.len() < keys.len() {
        o.know(keys[2]);
        let expected = Text::verbatim(keys.join(", "));
        return o.error(Text::verbatim(given.join(", ")), expected);
    }
    let stands = point(phrase!("an array of 3 numbers"));
    o.optional(keys[2], &mut position, &stands);
    if let (Some(sigma_range_mm), Some(sigma_angle), Some(position_mm)) = (range, angle, position) {
        *own = Some(Tracker {
            sigma_range_mm,
            sigma_angle,
            position_mm,
        });
    }
}

const NAMES: Kind<Vec<String>> = Kind {
    expected: phrase!("an array of names"),
    read: |at| at.list(&TEXT),
    write: |all| all.iter().map(TEXT.write).collect(),
};

const SIGMA: Kind<Sigma> = Kind {
    expected: phrase!("a positive number, or an array of 3 positive numbers"),
    read: |at| {
        let usable = |value: &f64| value.is_finite() && *value > 0.0;
        match &at.node.value {
            Value::Number(value) if usable(value) => return Some(Sigma::Overall(*value)),
            Value::Numbers(values) if values.iter().all(usable) => {
                if let Ok(each) = <[f64; 3]>::try_from(values.as_slice()) {
                    return Some(Sigma::PerAxis(each));
                }
            }
            _ => {}
        }
        at.wrong()
    },
    write: |sigma| match sigma {
        Sigma::Overall(sigma) => (*sigma).into(),
        Sigma::PerAxis(each) => (*each).into(),
    },
};

const ABOVE_0: Kind<f64> = positive(phrase!("a number above 0"));

/// Thousandths.
const MILLI: Kind<f64> = Kind {
    read: |at| Some((ABOVE_0.read)(at)? * 1e-3),
    write: |value| as_written(*value, 1e3, 1e-3).into(),
    ..ABOVE_0
};

/// Millionths.
const MICRO: Kind<f64> = Kind {
    read: |at| Some((ABOVE_0.read)(at)? * 1e-6),
    write: |value| as_written(*value, 1e6, 1e-6).into(),
    ..ABOVE_0
};

/// The number that the reader, who multiplies by `inner`, makes this very value of, where there is one.
fn as_written(value: f64, outer: f64, inner: f64) -> f64 {
    let near = value * outer;
    let candidates = [near, near.next_down(), near.next_up(), value / inner];
    let same = candidates.into_iter().find(|c| c * inner == value);
    same.unwrap_or(near)
}

/// Regions of the first joint.
pub const REGIONS: Kind<Vec<Region>> = Kind {
    expected: phrase!("an array"),
    read: |at| at.list(&REGION),
    write: |all| all.iter().map(REGION.write).collect(),
};

const REGION: Kind<Region> = Kind {
    expected: phrase!("an object"),
    read: |at| at.object(Region::default(), region),
    write: |own| written(own.clone(), region),
};

fn region(o: &mut Object<'_, '_>, own: &mut Region) {
    o.required("name", &mut own.name, &TEXT);
    o.required("from_deg", &mut own.from_rad, &DEGREES);
    o.required("to_deg", &mut own.to_rad, &DEGREES);
    if o.has_read_well() && own.from_rad >= own.to_rad {
        let (from, to) = (degrees(own.from_rad), degrees(own.to_rad));
        let expected = text!("a range from the smaller to the larger value");
        o.error(text!("a region from {from} to {to}", from, to), expected);
    }
}

fn samples_at(fields: &mut Fields<'_>, member: Option<Member>, at: usize) -> Option<SamplesAt> {
    const EXPECTED: Template = phrase!("an object with \"file\" or with \"columns\"");
    let path = &Path::Root.key("samples");
    let Some(Member { node, .. }) = member else {
        let found = text!("no key {key}", key = quoted("samples"));
        fields.error(at, &Path::Root, found, EXPECTED);
        return None;
    };
    let node_at = node.at;
    let Value::Object(members) = node.value else {
        fields.mismatch(&node, path, EXPECTED);
        return None;
    };
    let keys = ["file", "columns", "sha256"];
    fields.unknown_keys(&members, path, &keys);
    let mut given = [const { None }; 3];
    for Member { key, node, .. } in members {
        if let Some(place) = keys.iter().position(|own| *own == key)
            && node.value != Value::Null
        {
            given[place] = Some(node);
        }
    }
    let [file, columns, sha256] = given;
    let sha256 = match sha256 {
        Some(node) => Some(SHA256.read(fields, &node, &path.key("sha256"))?),
        None => None,
    };
    match (file, columns) {
        (Some(file), None) => {
            let name = TEXT.read(fields, &file, &path.key("file"))?;
            Some(SamplesAt::File(name, file.at, sha256))
        }
        (None, Some(columns)) => Some(SamplesAt::Inline(columns)),
        (None, None) => {
            fields.error(
                node_at,
                path,
                Value::Object(Vec::new()).describe(),
                EXPECTED,
            );
            None
        }
        (Some(_), Some(_)) => {
            fields.error(
                node_at,
                path,
                Text::verbatim("\"file\", \"columns\""),
                phrase!("one of the two"),
            );
            None
        }
    }
}

const SHA256: Kind<String> = Kind {
    read: |at| {
        let text = (TEXT.read)(at)?;
        if text.len() == 64 && text.bytes().all(|b| b.is_ascii_hexdigit()) {
            return Some(text.to_ascii_lowercase());
        }
        at.error(
            Text::verbatim(quoted(&text)),
            text!("64 hexadecimal digits"),
        )
    },
    ..TEXT
};
