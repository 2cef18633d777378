//! Reads the session document.

use std::path::Path as FilePath;

use nalgebra::Point3;

use super::{DEFAULT_TARGET, FORMAT, references, robot};
use crate::kinematics::Robot;
use crate::sessions::domain::{Instrument, Region, Sigma, TARGETS_SIGMA_MM, Target, Tracker};
use crate::sessions::json::{Fields, Member, Node, Path, Value, optional};
use crate::sessions::number::quoted;
use crate::sessions::references::References;
use crate::units::rad_from_deg;

/// Where the samples are.
pub(crate) enum SamplesAt {
    /// In a file with this name; the byte is where the document says so.
    File(String, usize),
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
    pub(crate) samples: Option<SamplesAt>,
}

const KNOWN: [&str; 10] = [
    "format",
    "name",
    "note",
    "robot",
    "targets",
    "instrument",
    "tolerance_mm",
    "regions",
    "compensated_by",
    "samples",
];

/// Reads the document; `None` when it is no session at all.
pub(crate) fn head(fields: &mut Fields<'_>, root: Node, folder: Option<&FilePath>) -> Option<Head> {
    let path = &Path::Root;
    let at = root.at;
    let Value::Object(mut members) = root.value else {
        fields.mismatch(&root, path, "a session: an object with the key \"format\"");
        return None;
    };
    format_tag(fields, &members, at)?;
    let known = [&KNOWN[..], &references::KEYS].concat();
    fields.unknown_keys(&members, path, &known);
    // Taken out of the tree: a million samples are not copied.
    let samples = members.iter().position(|member| member.key == "samples");
    let samples = samples.map(|index| members.remove(index));
    let name = fields
        .required_text(&members, at, path, "name")
        .unwrap_or_default();
    let note = optional(&members, "note").and_then(|node| fields.text(node, &path.key("note")));
    let robot = fields
        .required(
            &members,
            at,
            path,
            "robot",
            "an object that describes the robot",
        )
        .and_then(|node| robot::read(fields, node, &path.key("robot"), folder));
    let targets = optional(&members, "targets")
        .and_then(|node| targets(fields, node, &path.key("targets")))
        .unwrap_or_else(default_targets);
    let mut instrument = optional(&members, "instrument")
        .and_then(|node| instrument(fields, node, &path.key("instrument")))
        .unwrap_or_default();
    instrument.references = references::references(fields, &members, path);
    let tolerance_mm = optional(&members, "tolerance_mm").and_then(|node| {
        positive(
            fields,
            node,
            &path.key("tolerance_mm"),
            "a length above 0 mm",
        )
    });
    let regions = optional(&members, "regions")
        .and_then(|node| regions(fields, node, &path.key("regions")))
        .unwrap_or_default();
    let compensated_by = optional(&members, "compensated_by")
        .and_then(|node| fields.text(node, &path.key("compensated_by")));
    let samples = samples_at(fields, samples, at);
    Some(Head {
        name,
        note: note.unwrap_or_default(),
        robot,
        targets,
        instrument,
        tolerance_mm,
        regions,
        compensated_by,
        samples,
    })
}

/// A session without `targets` has one, at the tool's origin.
pub(crate) fn default_targets() -> Vec<Target> {
    vec![Target {
        name: DEFAULT_TARGET.to_owned(),
        position_mm: Point3::origin(),
    }]
}

fn format_tag(fields: &mut Fields<'_>, members: &[Member], at: usize) -> Option<()> {
    let expected = format!("\"{FORMAT}\"");
    let node = fields.required(members, at, &Path::Root, "format", &expected)?;
    if let Value::Text(tag) = &node.value
        && tag == FORMAT
    {
        return Some(());
    }
    let newer = matches!(&node.value, Value::Text(tag) if tag.starts_with("truepose-session/"));
    let expected = if newer {
        format!("{expected}; another version of truepose may have written this file")
    } else {
        expected
    };
    fields.mismatch(node, &Path::Root.key("format"), &expected);
    None
}

pub(crate) fn positive(
    fields: &mut Fields<'_>,
    node: &Node,
    path: &Path<'_>,
    expected: &str,
) -> Option<f64> {
    match node.value {
        Value::Number(value) if value.is_finite() && value > 0.0 => Some(value),
        _ => {
            fields.mismatch(node, path, expected);
            None
        }
    }
}

pub(crate) fn targets(
    fields: &mut Fields<'_>,
    node: &Node,
    path: &Path<'_>,
) -> Option<Vec<Target>> {
    let members = fields.object(node, path, "an object with a position for each name")?;
    let mut targets = Vec::new();
    for member in members {
        let expected = "an array of 3 numbers: the position in the tool frame, mm";
        let key = &path.key(&member.key);
        if member.key.trim() != member.key || member.key.is_empty() {
            fields.error(
                member.key_at,
                key,
                quoted(&member.key),
                "a name without spaces around it",
            );
        }
        if let Some(position) = fields.numbers::<3>(&member.node, key, expected) {
            targets.push(Target {
                name: member.key.clone(),
                position_mm: Point3::from(position),
            });
        }
    }
    // A declaration that failed must not make every cell that names it fail too.
    if targets.is_empty() && members.is_empty() {
        return None;
    }
    if targets.len() < members.len() {
        let failed = members
            .iter()
            .filter(|member| targets.iter().all(|target| target.name != member.key));
        let failed: Vec<Target> = failed
            .map(|member| Target {
                name: member.key.clone(),
                position_mm: Point3::origin(),
            })
            .collect();
        targets.extend(failed);
    }
    Some(targets)
}

pub(crate) fn instrument(
    fields: &mut Fields<'_>,
    node: &Node,
    path: &Path<'_>,
) -> Option<Instrument> {
    const SIGMA: &str = "a positive number, or an array of 3 positive numbers";
    let members = fields.object(node, path, "an object with name and sigma_mm")?;
    fields.unknown_keys(members, path, &INSTRUMENT);
    let name = fields
        .required_text(members, node.at, path, "name")
        .unwrap_or_default();
    let sigma_mm = optional(members, "sigma_mm").and_then(|node| {
        let path = &path.key("sigma_mm");
        let usable = |value: f64| value.is_finite() && value > 0.0;
        match &node.value {
            Value::Number(value) if usable(*value) => return Some(Sigma::Overall(*value)),
            Value::Numbers(values) => {
                if let Ok(each) = <[f64; 3]>::try_from(values.as_slice())
                    && each.into_iter().all(usable)
                {
                    return Some(Sigma::PerAxis(each));
                }
            }
            _ => {}
        }
        fields.mismatch(node, path, SIGMA);
        None
    });
    // Null says that they are not known, which is another thing than to say nothing.
    let targets = members.iter().find(|m| m.key == "targets_sigma_mm");
    let targets_sigma_mm = match targets {
        None => Some(TARGETS_SIGMA_MM),
        Some(member) if member.node.value == Value::Null => None,
        Some(member) => positive(
            fields,
            &member.node,
            &path.key("targets_sigma_mm"),
            "a length above 0 mm, or null",
        ),
    };
    let mut sigma = |key: &str, inner: f64| {
        let node = optional(members, key)?;
        let expected = "a number above 0, or null";
        positive(fields, node, &path.key(key), expected).map(|sigma| sigma * inner)
    };
    let (range, angle) = (
        sigma("sigma_range_mm", 1.0),
        sigma("sigma_angle_urad", 1e-6),
    );
    Some(Instrument {
        sigma_orientation: sigma("sigma_mrad", 1e-3),
        sigma_distance_mm: sigma("sigma_distance_mm", 1.0),
        sigma_direction: sigma("sigma_direction_urad", 1e-6),
        sigma_touch_mm: sigma("sigma_touch_mm", 1.0),
        tracker: tracker(fields, members, node.at, path, range.zip(angle)),
        name,
        sigma_mm,
        targets_sigma_mm,
        references: References::default(),
    })
}

const INSTRUMENT: [&str; 10] = [
    "name",
    "sigma_mm",
    "targets_sigma_mm",
    "sigma_range_mm",
    "sigma_angle_urad",
    "position_mm",
    "sigma_mrad",
    "sigma_distance_mm",
    "sigma_direction_urad",
    "sigma_touch_mm",
];

/// What a tracker says of itself: all of its three keys or none.
fn tracker(
    fields: &mut Fields<'_>,
    members: &[Member],
    at: usize,
    path: &Path<'_>,
    sigma: Option<(f64, f64)>,
) -> Option<Tracker> {
    let keys = ["sigma_range_mm", "sigma_angle_urad", "position_mm"];
    let given: Vec<&str> = keys
        .into_iter()
        .filter(|key| optional(members, key).is_some())
        .collect();
    if given.is_empty() {
        return None;
    }
    if given.len() < keys.len() {
        let expected = "all of sigma_range_mm, sigma_angle_urad and position_mm, or none";
        fields.error(at, path, format!("only {}", given.join(" and ")), expected);
        return None;
    }
    let expected = "an array of 3 numbers: where the tracker stands, mm";
    let node = optional(members, "position_mm")?;
    let position = fields.numbers::<3>(node, &path.key("position_mm"), expected)?;
    let (sigma_range_mm, sigma_angle) = sigma?;
    Some(Tracker {
        sigma_range_mm,
        sigma_angle,
        position_mm: Point3::from(position),
    })
}

pub(crate) fn regions(
    fields: &mut Fields<'_>,
    node: &Node,
    path: &Path<'_>,
) -> Option<Vec<Region>> {
    let Value::List(list) = &node.value else {
        fields.mismatch(node, path, "an array of regions");
        return None;
    };
    let regions = list.iter().enumerate().filter_map(|(index, node)| {
        let path = &path.index(index);
        let members = fields.object(node, path, "an object with name, from_deg and to_deg")?;
        fields.unknown_keys(members, path, &["name", "from_deg", "to_deg"]);
        let name = fields.required_text(members, node.at, path, "name");
        let from = fields.required_number(members, node.at, path, "from_deg");
        let to = fields.required_number(members, node.at, path, "to_deg");
        let (name, from, to) = (name?, from?, to?);
        if from >= to {
            let found = format!("a region from {from} to {to}");
            fields.error(
                node.at,
                path,
                found,
                "a region from the smaller to the larger value",
            );
            return None;
        }
        Some(Region {
            name,
            from_rad: rad_from_deg(from),
            to_rad: rad_from_deg(to),
        })
    });
    Some(regions.collect())
}

fn samples_at(fields: &mut Fields<'_>, member: Option<Member>, at: usize) -> Option<SamplesAt> {
    const EXPECTED: &str = "an object with \"file\" or with \"columns\"";
    let path = &Path::Root.key("samples");
    let Some(Member { node, .. }) = member else {
        fields.error(at, &Path::Root, "no key 'samples'", EXPECTED);
        return None;
    };
    let node_at = node.at;
    let Value::Object(members) = node.value else {
        fields.mismatch(&node, path, EXPECTED);
        return None;
    };
    fields.unknown_keys(&members, path, &["file", "columns"]);
    let mut file = None;
    let mut columns = None;
    for member in members {
        match member.key.as_str() {
            "file" if member.node.value != Value::Null => file = Some(member.node),
            "columns" if member.node.value != Value::Null => columns = Some(member.node),
            _ => {}
        }
    }
    match (file, columns) {
        (Some(file), None) => {
            let name = fields.text(&file, &path.key("file"))?;
            Some(SamplesAt::File(name, file.at))
        }
        (None, Some(columns)) => Some(SamplesAt::Inline(columns)),
        (None, None) => {
            fields.error(node_at, path, "neither a file nor columns", EXPECTED);
            None
        }
        (Some(_), Some(_)) => {
            fields.error(node_at, path, "both a file and columns", "one of the two");
            None
        }
    }
}
