//! Reads the model document; every complaint carries line, column and path.

use std::path::Path as FilePath;
use std::{fmt, io};

use nalgebra::DMatrix;
use serde::Deserializer as _;
use serde::de::{IgnoredAny, MapAccess, Visitor};

use super::FORMAT;
use super::exact::{DISAGREES, agrees, robot_of};
use super::term::term;
use crate::diagnostic::{Place, Rejected};
use crate::effects::Term;
use crate::kinematics::{JointKind, Range};
use crate::model::{Calibration, GapStep, Model, RegionalCorrection};
use crate::sessions::files;
use crate::sessions::format_v1::read::{default_targets, positive, targets};
use crate::sessions::json::{Fields, Member, Node, Path, Value, optional};
use crate::units::rad_from_deg;

/// Reads the model at `path`.
///
/// # Errors
/// [`Rejected`] with every problem that was found, each with file, line, column and what was
/// expected.
pub fn load_model(path: impl AsRef<FilePath>) -> Result<Calibration, Rejected> {
    let path = path.as_ref();
    let bytes = files::read_document(path)?;
    let place = Place::file(path);
    let text = files::as_text(&bytes, &place)?;
    read(text, place, Some(files::folder_of(path)))
}

/// What every version of the model's format begins with.
const MODEL: &str = "truepose-model/";

/// Whether a file calls itself a model. What cannot be read is left to the reader of sessions,
/// which says why.
pub fn is_model(path: &FilePath) -> bool {
    let Ok((file, _)) = files::open_regular(path) else {
        return false;
    };
    let mut tag = Tag(None);
    let reader = io::BufReader::new(file);
    // Where it ends does not matter.
    let _ = serde_json::Deserializer::from_reader(reader).deserialize_map(&mut tag);
    match tag.0 {
        Some(format) => format.starts_with(MODEL),
        // Broken, but it may still say what it was meant to be.
        None => files::read_document(path)
            .is_ok_and(|bytes| memchr::memmem::find(&bytes, MODEL.as_bytes()).is_some()),
    }
}

/// The value of a document's key `format`. Reading ends with it: behind it there may be a million
/// samples.
struct Tag(Option<String>);

impl<'de> Visitor<'de> for &mut Tag {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a document with a key format")
    }

    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        while let Some(key) = map.next_key::<String>()? {
            if key == "format" {
                self.0 = Some(map.next_value()?);
                return Ok(());
            }
            map.next_value::<IgnoredAny>()?;
        }
        Ok(())
    }
}

/// Reads a model that is in memory.
///
/// # Errors
/// As [`load_model`].
pub fn read_model(text: &str) -> Result<Calibration, Rejected> {
    read(text, Place::default(), None)
}

fn read(text: &str, place: Place, folder: Option<&FilePath>) -> Result<Calibration, Rejected> {
    let (mut fields, root) = Fields::open(place, text)?;
    let calibration = document(&mut fields, &root, folder);
    match calibration {
        Some(calibration) if !fields.has_errors() => Ok(calibration),
        _ => Err(Rejected {
            diagnostics: fields.findings,
        }),
    }
}

const KNOWN: [&str; 14] = [
    "format",
    "program_version",
    "session",
    "samples_hash",
    "robot",
    "robot_exact",
    "targets",
    "effects",
    "covariance",
    "regions",
    "measured",
    "tolerance_mm",
    "compensated_by",
    "history",
];

fn document(
    fields: &mut Fields<'_>,
    root: &Node,
    folder: Option<&FilePath>,
) -> Option<Calibration> {
    let path = &Path::Root;
    let members = fields.object(root, path, "a model: an object with the key \"format\"")?;
    format_tag(fields, members, root.at)?;
    fields.unknown_keys(members, path, &KNOWN);
    let text =
        |fields: &mut Fields<'_>, key: &str| fields.required_text(members, root.at, path, key);
    let program_version = text(fields, "program_version");
    let session = text(fields, "session");
    let samples_hash = text(fields, "samples_hash");
    let robot = robot_of(fields, members, root.at, folder)?;
    let targets = optional(members, "targets")
        .and_then(|node| targets(fields, node, &path.key("targets")))
        .unwrap_or_else(default_targets);
    let terms = terms(fields, members, root.at, robot.joints.len())?;
    let model = Model::new(robot, terms);
    let covariance = optional(members, "covariance")
        .map(|node| covariance(fields, node, model.coefficient_count()));
    let regions = each(fields, members, root.at, "regions", region)?;
    let joints = &model.robot.joints;
    let one_that_turns = joints.len() == 1 && joints[0].kind == JointKind::Revolute;
    if let Some(node) = optional(members, "regions").filter(|_| !regions.is_empty())
        && !one_that_turns
    {
        let found = "regions of another robot than one with a single turning joint";
        let path = &path.key("regions");
        fields.error(node.at, path, found, "no regions for this robot");
    }
    let measured = each(fields, members, root.at, "measured", range)?;
    if let (Some(node), true) = (
        optional(members, "measured"),
        measured.len() != model.robot.joints.len(),
    ) {
        let expected = format!("one range for each of {} joints", model.robot.joints.len());
        let found = format!("{} ranges", measured.len());
        fields.error(node.at, &path.key("measured"), found, expected);
    }
    let tolerance_mm = optional(members, "tolerance_mm").and_then(|node| {
        let path = &path.key("tolerance_mm");
        positive(fields, node, path, "a length above 0 mm")
    });
    let compensated_by = optional(members, "compensated_by")
        .and_then(|node| fields.text(node, &path.key("compensated_by")));
    let history = each(fields, members, root.at, "history", step)?;
    Some(Calibration {
        session: session?,
        model,
        covariance: match covariance {
            None => None,
            Some(covariance) => Some(covariance?),
        },
        regions,
        targets,
        measured,
        tolerance_mm,
        compensated_by,
        history,
        samples_hash: samples_hash?,
        program_version: program_version?,
    })
}

fn format_tag(fields: &mut Fields<'_>, members: &[Member], at: usize) -> Option<()> {
    let expected = format!("\"{FORMAT}\"");
    let node = fields.required(members, at, &Path::Root, "format", &expected)?;
    if let Value::Text(tag) = &node.value
        && tag == FORMAT
    {
        return Some(());
    }
    fields.mismatch(node, &Path::Root.key("format"), &expected);
    None
}

/// The elements of an array that has to be there; `None` when one of them is wrong.
fn each<T>(
    fields: &mut Fields<'_>,
    members: &[Member],
    at: usize,
    key: &str,
    read: impl Fn(&mut Fields<'_>, &Node, &Path<'_>) -> Option<T>,
) -> Option<Vec<T>> {
    let node = fields.required(members, at, &Path::Root, key, "an array")?;
    let path = &Path::Root.key(key);
    let Value::List(list) = &node.value else {
        fields.mismatch(node, path, "an array of objects");
        return None;
    };
    let all: Vec<Option<T>> = list
        .iter()
        .enumerate()
        .map(|(index, node)| read(fields, node, &path.index(index)))
        .collect();
    all.into_iter().collect()
}

fn terms(
    fields: &mut Fields<'_>,
    members: &[Member],
    at: usize,
    joints: usize,
) -> Option<Vec<Term>> {
    each(fields, members, at, "effects", |fields, node, path| {
        term(fields, node, path, joints)
    })
}

fn covariance(fields: &mut Fields<'_>, node: &Node, size: usize) -> Option<DMatrix<f64>> {
    let path = &Path::Root.key("covariance");
    let expected = format!("{size} arrays of {size} numbers, one for each coefficient");
    let rows: Option<Vec<&[f64]>> = match &node.value {
        Value::List(rows) if rows.len() == size => rows
            .iter()
            .map(|row| match &row.value {
                // A number that could not be written is null there and NaN here.
                Value::Numbers(row) if row.len() == size => Some(row.as_slice()),
                _ => None,
            })
            .collect(),
        _ => None,
    };
    let Some(rows) = rows else {
        fields.mismatch(node, path, &expected);
        return None;
    };
    Some(DMatrix::from_fn(size, size, |row, column| {
        rows[row][column]
    }))
}

fn region(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>) -> Option<RegionalCorrection> {
    let members = fields.object(node, path, "an object that describes a region")?;
    let known = [
        "name",
        "from_deg",
        "to_deg",
        "samples",
        "correction",
        "exact",
    ];
    fields.unknown_keys(members, path, &known);
    let name = fields.required_text(members, node.at, path, "name");
    let from = fields.required_number(members, node.at, path, "from_deg");
    let to = fields.required_number(members, node.at, path, "to_deg");
    let samples = fields.required(members, node.at, path, "samples", "a number of samples");
    let samples =
        samples.and_then(|n| count(fields, n, &path.key("samples"), "a number of samples"));
    let expected = "an object with theta_rad and l1_mm";
    let correction = fields.required(members, node.at, path, "correction", expected)?;
    let inside = &path.key("correction");
    let values = fields.object(correction, inside, expected)?;
    let theta_rad = fields.required_number(values, correction.at, inside, "theta_rad");
    let l1_mm = fields.required_number(values, correction.at, inside, "l1_mm");
    let (mut from_rad, mut to_rad) = (rad_from_deg(from?), rad_from_deg(to?));
    if let Some(exact) = optional(members, "exact") {
        let inside = &path.key("exact");
        let values = fields.object(exact, inside, "an object with from_rad and to_rad")?;
        for (key, own) in [("from_rad", &mut from_rad), ("to_rad", &mut to_rad)] {
            let value = fields.required_number(values, exact.at, inside, key)?;
            if !agrees(value, *own) {
                fields.error(exact.at, &inside.key(key), value.to_string(), DISAGREES);
            }
            *own = value;
        }
    }
    if from_rad >= to_rad {
        let found = format!("a region from {from_rad} to {to_rad} rad");
        fields.error(
            node.at,
            path,
            found,
            "a region from the smaller to the larger value",
        );
    }
    Some(RegionalCorrection {
        name: name?,
        from_rad,
        to_rad,
        samples: samples?,
        theta_rad: theta_rad?,
        l1_mm: l1_mm?,
    })
}

fn range(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>) -> Option<Range> {
    let members = fields.object(node, path, "an object with from_inner and to_inner")?;
    let from = fields.required_number(members, node.at, path, "from_inner");
    let to = fields.required_number(members, node.at, path, "to_inner");
    let (from, to) = (from?, to?);
    if from > to {
        let found = format!("a range from {from} to {to}");
        fields.error(
            node.at,
            path,
            found,
            "a range from the smaller to the larger value",
        );
    }
    Some(Range { from, to })
}

fn step(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>) -> Option<GapStep> {
    let members = fields.object(node, path, "an object with what and gap_mm")?;
    let what = fields.required_text(members, node.at, path, "what");
    let mut length = |key: &str| {
        let node = optional(members, key)?;
        fields.number(node, &path.key(key))
    };
    let (gap_mm, held_out_mm) = (length("gap_mm"), length("held_out_mm"));
    Some(GapStep {
        what: what?,
        gap_mm: gap_mm.unwrap_or(f64::NAN),
        held_out_mm,
    })
}

/// A whole number from 0 on.
pub(super) fn count(
    fields: &mut Fields<'_>,
    node: &Node,
    path: &Path<'_>,
    expected: &str,
) -> Option<usize> {
    match node.value {
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a whole number in the range of the type"
        )]
        Value::Number(value) if value.fract() == 0.0 && (0.0..=1e15).contains(&value) => {
            Some(value as usize)
        }
        _ => {
            fields.mismatch(node, path, expected);
            None
        }
    }
}
