//! Reads the model document; every complaint carries line, column and path.

use std::path::Path as FilePath;

use nalgebra::{DMatrix, Quaternion, Unit, UnitQuaternion, Vector3};

use super::FORMAT;
use crate::diagnostic::{Place, Rejected};
use crate::effects::{Term, find};
use crate::kinematics::{Range, Robot};
use crate::model::{Calibration, GapStep, Model, RegionalCorrection};
use crate::sessions::files;
use crate::sessions::format_v1::read::{default_targets, positive, targets};
use crate::sessions::format_v1::robot;
use crate::sessions::json::{self, Fields, Member, Node, Path, Source, Value, optional};
use crate::sessions::validation;
use crate::units::rad_from_deg;

/// Exact and readable numbers may differ by this part through conversion, not by more.
const AGREES: f64 = 1e-9;
const DISAGREES: &str = "the value that the readable keys give: edit both, or remove the exact one";

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

/// Reads a model that is in memory.
///
/// # Errors
/// As [`load_model`].
pub fn read_model(text: &str) -> Result<Calibration, Rejected> {
    read(text, Place::default(), None)
}

fn read(text: &str, place: Place, folder: Option<&FilePath>) -> Result<Calibration, Rejected> {
    let source = Source {
        file: place.file,
        text,
    };
    let root = json::parse(&source)?;
    let mut fields = Fields::new(source);
    let calibration = document(&mut fields, &root, folder);
    match calibration {
        Some(calibration) if !fields.has_errors() => Ok(calibration),
        _ => Err(Rejected {
            diagnostics: fields.findings,
        }),
    }
}

const KNOWN: [&str; 13] = [
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
    if let (false, Some(node), true) = (
        regions.is_empty(),
        optional(members, "regions"),
        model.robot.joints.len() != 1,
    ) {
        let found = format!(
            "regions of a robot with {} joints",
            model.robot.joints.len()
        );
        fields.error(
            node.at,
            &path.key("regions"),
            found,
            "regions of a single joint",
        );
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

fn agrees(exact: f64, readable: f64) -> bool {
    (exact - readable).abs() <= AGREES * readable.abs().max(1e-3)
}

/// The robot, with the exact numbers in place of the readable ones.
fn robot_of(
    fields: &mut Fields<'_>,
    members: &[Member],
    at: usize,
    folder: Option<&FilePath>,
) -> Option<Robot> {
    let path = &Path::Root;
    let expected = "an object that describes the robot";
    let node = fields.required(members, at, path, "robot", expected)?;
    let mut robot = robot::read(fields, node, &path.key("robot"), folder)?;
    let place = fields.place(node.at, &path.key("robot"));
    validation::robot(&robot, &place, &mut fields.findings);
    if fields.has_errors() {
        return None;
    }
    let Some(exact) = optional(members, "robot_exact") else {
        return Some(robot);
    };
    let path = &path.key("robot_exact");
    let members = fields.object(
        exact,
        path,
        "an object with joints and tool_quaternion_wxyz",
    )?;
    let joints = fields.required(members, exact.at, path, "joints", "an array")?;
    let list = match &joints.value {
        Value::List(list) if list.len() == robot.joints.len() => list,
        _ => {
            let expected = format!("an array of {} objects", robot.joints.len());
            fields.mismatch(joints, &path.key("joints"), &expected);
            return None;
        }
    };
    for (index, (joint, node)) in robot.joints.iter_mut().zip(list).enumerate() {
        let joints = path.key("joints");
        let path = &joints.index(index);
        let members = fields.object(node, path, "an object with axis and limits_inner")?;
        let axis = fields.required_numbers::<3>(members, node.at, path, "axis", "3 numbers")?;
        let readable = joint.axis.direction.into_inner();
        if !axis.iter().zip(&readable).all(|(a, b)| agrees(*a, *b)) {
            fields.error(node.at, &path.key("axis"), format!("{axis:?}"), DISAGREES);
        }
        joint.axis.direction = Unit::new_unchecked(Vector3::from(axis));
        let limits = match optional(members, "limits_inner") {
            None => None,
            Some(node) => {
                Some(fields.numbers::<2>(node, &path.key("limits_inner"), "2 numbers")?)
            }
        };
        let same = match (limits, joint.limits) {
            (None, None) => true,
            (Some([from, to]), Some(l)) => agrees(from, l.from) && agrees(to, l.to) && from < to,
            _ => false,
        };
        if !same {
            let found = format!("{limits:?}");
            fields.error(node.at, &path.key("limits_inner"), found, DISAGREES);
        }
        joint.limits = limits.map(|[from, to]| Range { from, to });
    }
    let key = "tool_quaternion_wxyz";
    let exact_turn = fields.required_numbers::<4>(members, exact.at, path, key, "4 numbers")?;
    let readable = robot.base_from_tool.rotation.quaternion();
    let readable = [readable.w, readable.i, readable.j, readable.k];
    if !exact_turn
        .iter()
        .zip(&readable)
        .all(|(a, b)| agrees(*a, *b))
    {
        fields.error(
            exact.at,
            &path.key(key),
            format!("{exact_turn:?}"),
            DISAGREES,
        );
    }
    let [w, x, y, z] = exact_turn;
    robot.base_from_tool.rotation = UnitQuaternion::new_unchecked(Quaternion::new(w, x, y, z));
    Some(robot)
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

/// One effect, as models and scenarios write it.
pub(crate) fn term(
    fields: &mut Fields<'_>,
    node: &Node,
    path: &Path<'_>,
    joints: usize,
) -> Option<Term> {
    let members = fields.object(node, path, "an object with effect and parameters")?;
    fields.unknown_keys(members, path, &["effect", "joint", "parameters", "exact"]);
    let id = fields.required_text(members, node.at, path, "effect")?;
    if find(&id).is_none() {
        let found = format!("no effect is called '{id}'");
        let expected = "a name that `truepose effects` lists";
        fields.error(node.at, &path.key("effect"), found, expected);
        return None;
    }
    let joint = match optional(members, "joint") {
        None => 1,
        Some(node) => count(fields, node, &path.key("joint"), "a joint, counted from 1")?,
    };
    let given = optional(members, "parameters");
    let parameters = match given {
        None => Vec::new(),
        Some(node) => parameters(fields, node, &path.key("parameters"))?,
    };
    let named: Vec<(&str, f64)> = parameters.iter().map(|(n, v)| (n.as_str(), *v)).collect();
    let readable = match Term::from_parameters(&id, joint, &named, joints) {
        Ok(term) => term,
        Err(error) => {
            let at = given.map_or(node.at, |given| given.at);
            let expected = "parameters as `truepose effects` lists them";
            fields.error(at, path, error.to_string(), expected);
            return None;
        }
    };
    match optional(members, "exact") {
        None => Some(readable),
        Some(node) => exact_term(fields, node, &path.key("exact"), readable),
    }
}

fn parameters(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>) -> Option<Vec<(String, f64)>> {
    let members = fields.object(node, path, "an object with a number for each parameter")?;
    let all: Vec<Option<(String, f64)>> = members
        .iter()
        .map(|member| {
            let path = &path.key(&member.key);
            let value = fields.number(&member.node, path)?;
            if member.key.starts_with("amplitude") && value < 0.0 {
                fields.mismatch(&member.node, path, "an amplitude of 0 or more");
                return None;
            }
            Some((member.key.clone(), value))
        })
        .collect();
    all.into_iter().collect()
}

fn exact_term(
    fields: &mut Fields<'_>,
    node: &Node,
    path: &Path<'_>,
    mut term: Term,
) -> Option<Term> {
    let members = fields.object(node, path, "an object with setting and coefficients")?;
    let setting = fields.required_number(members, node.at, path, "setting")?;
    let shown = crate::effects::term::setting_quantity(term.effect.about().setting);
    if shown.is_some() && !agrees(setting, term.setting) {
        fields.error(
            node.at,
            &path.key("setting"),
            setting.to_string(),
            DISAGREES,
        );
        return None;
    }
    let key = "coefficients";
    let wanted = term.coefficients.len();
    let expected = format!("an array of {wanted} numbers");
    let list = fields.required(members, node.at, path, key, &expected)?;
    let coefficients = match &list.value {
        Value::Numbers(values)
            if values.len() == wanted && values.iter().all(|v| v.is_finite()) =>
        {
            values
        }
        _ => {
            fields.mismatch(list, &path.key(key), &expected);
            return None;
        }
    };
    let scale = term
        .coefficients
        .iter()
        .fold(0.0_f64, |m, v| m.max(v.abs()));
    let near =
        |(exact, readable): (&f64, &f64)| (exact - readable).abs() <= AGREES * scale.max(1e-9);
    if !coefficients.iter().zip(&term.coefficients).all(near) {
        fields.error(
            list.at,
            &path.key(key),
            format!("{coefficients:?}"),
            DISAGREES,
        );
        return None;
    }
    term.setting = setting;
    term.coefficients.clone_from(coefficients);
    Some(term)
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
fn count(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>, expected: &str) -> Option<usize> {
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
