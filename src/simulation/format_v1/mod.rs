//! `truepose-scenario/1` on disk.
//!
//! Beyond the keys of the contract a scenario may have `name`, `note`, `tolerance_mm` and `regions`
//! (they go into the session), `planar` (z is not measured), `poses.random.count` and
//! `noise.resolution_mm`. `measure` is how the samples are measured, in turn: `["point"]` where nothing is
//! said, or any of point, pose, distance, bearing, pointing, socket, touch. What they refer to stands
//! in `anchors`, `stations`, `planes`, `sockets`, `socket_distances_mm` and `pointing` as in a session,
//! with where it really is; `unknown` lists which of anchors, stations, planes, sockets the session does
//! not say. Their noise is what the instrument states (`sigma_mrad`, `sigma_distance_mm`,
//! `sigma_direction_urad`, `sigma_touch_mm`; of a tracker `sigma_range_mm` and `sigma_angle_urad`), that
//! of points and sockets `noise.sigma_mm`. A condition may be one number instead of a list. For a sliding joint the
//! numbers under `from_deg`, `to_deg`, `step_deg`, `q_deg` and `speed_deg_s` are mm; `from_mm` and
//! so on say the same more plainly.

use std::path::{Path as FilePath, PathBuf};

mod conditions;
mod poses;

use conditions::conditions;
use poses::poses;

use super::scenario::{Measure, Noise, NoiseKind, Outliers, Poses, Scenario};
use crate::diagnostic::{Diagnostic, Place, Rejected, Severity};
use crate::effects::places::PlaceKind;
use crate::kinematics::Robot;
use crate::model::format_v1::term;
use crate::sessions::format_v1::read::{default_targets, instrument, positive, regions, targets};
use crate::sessions::format_v1::{references, robot};
use crate::sessions::json::{Fields, Member, Node, Path, Value, optional};
use crate::sessions::{files, validation};

/// What the key `format` says.
pub const FORMAT: &str = "truepose-scenario/1";

/// A scenario and the notes and warnings that came up on the way.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadedScenario {
    /// What the file says.
    pub scenario: Scenario,
    /// Notes and warnings; no errors.
    pub findings: Vec<Diagnostic>,
    /// Every file that was read: the document, the robot's URDF. No output may replace them.
    pub files: Vec<PathBuf>,
}

/// Reads the scenario at `path`.
///
/// # Errors
/// [`Rejected`] with every problem that was found, each with file, line, column and what was
/// expected.
pub fn load_scenario(path: impl AsRef<FilePath>) -> Result<LoadedScenario, Rejected> {
    let path = path.as_ref();
    let bytes = files::read_document(path)?;
    let place = Place::file(path);
    let text = files::as_text(&bytes, &place)?;
    read(text, place, Some(files::folder_of(path)))
}

/// Reads a scenario that is in memory.
///
/// # Errors
/// As [`load_scenario`].
pub fn parse_scenario(document: &[u8]) -> Result<LoadedScenario, Rejected> {
    let text = files::as_text(document, &Place::default())?;
    read(text, Place::default(), None)
}

fn read(text: &str, place: Place, folder: Option<&FilePath>) -> Result<LoadedScenario, Rejected> {
    let (mut fields, root) = Fields::open(place, text)?;
    let scenario = document(&mut fields, &root, folder);
    let mut findings = std::mem::take(&mut fields.findings);
    let sound = |findings: &[Diagnostic]| findings.iter().all(|f| f.severity != Severity::Error);
    let Some(scenario) = scenario.filter(|_| sound(&findings)) else {
        return Err(Rejected {
            diagnostics: findings,
        });
    };
    for mut problem in scenario.problems() {
        // Its field says where; the key that it begins with says on which line.
        let path = problem.place.field.clone().unwrap_or_default();
        let at = offset_of(&root, &path);
        problem.place = fields.source.place(at).in_field(path);
        findings.push(problem);
    }
    if sound(&findings) {
        let document = fields.source.file.clone();
        let files = document.into_iter().chain(fields.also_read).collect();
        Ok(LoadedScenario {
            scenario,
            findings,
            files,
        })
    } else {
        Err(Rejected {
            diagnostics: findings,
        })
    }
}

/// Where the deepest part of a path such as `poses.list[3]` that the document has is.
fn offset_of(root: &Node, path: &str) -> usize {
    let mut node = root;
    for key in path.split(['.', '[']) {
        let next = match &node.value {
            Value::Object(members) => members.iter().find(|m| m.key == key).map(|m| &m.node),
            Value::List(list) => {
                let index: Option<usize> = key.trim_end_matches(']').parse().ok();
                index.and_then(|index| list.get(index))
            }
            _ => None,
        };
        match next {
            Some(next) => node = next,
            None => break,
        }
    }
    node.at
}

const KNOWN: [&str; 14] = [
    "format",
    "name",
    "note",
    "robot",
    "targets",
    "instrument",
    "tolerance_mm",
    "regions",
    "planar",
    "poses",
    "conditions",
    "effects",
    "noise",
    "outliers",
];

fn document(fields: &mut Fields<'_>, root: &Node, folder: Option<&FilePath>) -> Option<Scenario> {
    let path = &Path::Root;
    let members = fields.object(root, path, "a scenario: an object with the key \"format\"")?;
    format_tag(fields, members, root.at)?;
    let more = ["seed", "measure", "unknown"];
    let known = [&KNOWN[..], &more, &references::KEYS].concat();
    fields.unknown_keys(members, path, &known);
    let expected = "an object that describes the robot";
    let robot = fields
        .required(members, root.at, path, "robot", expected)
        .and_then(|node| {
            let path = &path.key("robot");
            let robot = robot::read(fields, node, path, folder)?;
            let place = fields.place(node.at, path);
            validation::robot(&robot, &place, &mut fields.findings);
            Some(robot)
        })?;
    let poses = fields
        .required(
            members,
            root.at,
            path,
            "poses",
            "an object with sweep, list or random",
        )
        .and_then(|node| poses(fields, node, &path.key("poses"), &robot));
    let mut scenario = Scenario::new("simulated session", robot, Poses::List(Vec::new()));
    if let Some(node) = optional(members, "name") {
        scenario.name = fields.text(node, &path.key("name")).unwrap_or_default();
    }
    if let Some(node) = optional(members, "note") {
        scenario.note = fields.text(node, &path.key("note")).unwrap_or_default();
    }
    scenario.targets = optional(members, "targets")
        .and_then(|node| targets(fields, node, &path.key("targets")))
        .unwrap_or_else(default_targets);
    scenario.instrument = optional(members, "instrument")
        .and_then(|node| instrument(fields, node, &path.key("instrument")))
        .unwrap_or_default();
    scenario.instrument.references = references::references(fields, members, path);
    if let Some(node) = optional(members, "measure") {
        scenario.measure = names(
            fields,
            node,
            &path.key("measure"),
            &Measure::ALL,
            Measure::name,
        )?;
    }
    if let Some(node) = optional(members, "unknown") {
        let all = [
            PlaceKind::Anchor,
            PlaceKind::Station,
            PlaceKind::Plane,
            PlaceKind::Socket,
        ];
        scenario.unknown = names(
            fields,
            node,
            &path.key("unknown"),
            &all,
            |kind| match kind {
                PlaceKind::Anchor => "anchors",
                PlaceKind::Station => "stations",
                PlaceKind::Plane => "planes",
                PlaceKind::Socket => "sockets",
            },
        )?;
    }
    scenario.tolerance_mm = optional(members, "tolerance_mm").and_then(|node| {
        let path = &path.key("tolerance_mm");
        positive(fields, node, path, "a length above 0 mm")
    });
    scenario.regions = optional(members, "regions")
        .and_then(|node| regions(fields, node, &path.key("regions")))
        .unwrap_or_default();
    scenario.planar = flag(fields, members, path, "planar");
    if let Some(node) = optional(members, "conditions") {
        let robot = &scenario.robot;
        scenario.circumstances = conditions(fields, node, &path.key("conditions"), robot)?;
    }
    if let Some(node) = optional(members, "effects") {
        scenario.effects = effects(fields, node, &path.key("effects"), &scenario.robot)?;
    }
    if let Some(node) = optional(members, "noise") {
        noise(fields, node, &path.key("noise"), &mut scenario)?;
    }
    if let Some(node) = optional(members, "outliers") {
        scenario.outliers = Some(outliers(fields, node, &path.key("outliers"))?);
    }
    if let Some(node) = optional(members, "seed") {
        scenario.seed = whole(fields, node, &path.key("seed"))?;
    }
    scenario.poses = poses?;
    Some(scenario)
}

/// A list of names of these.
fn names<T: Copy>(
    fields: &mut Fields<'_>,
    node: &Node,
    path: &Path<'_>,
    all: &[T],
    name: fn(T) -> &'static str,
) -> Option<Vec<T>> {
    let known: Vec<&str> = all.iter().map(|one| name(*one)).collect();
    let expected = format!("an array of some of {}", known.join(", "));
    let Value::List(list) = &node.value else {
        fields.mismatch(node, path, &expected);
        return None;
    };
    let mut read = Vec::new();
    for (index, node) in list.iter().enumerate() {
        let one = all
            .iter()
            .find(|one| matches!(&node.value, Value::Text(text) if text == name(**one)));
        match one {
            Some(one) => read.push(*one),
            None => fields.mismatch(node, &path.index(index), &expected),
        }
    }
    (read.len() == list.len()).then_some(read)
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

fn flag(fields: &mut Fields<'_>, members: &[Member], path: &Path<'_>, key: &str) -> bool {
    match optional(members, key) {
        None => false,
        Some(Node {
            value: Value::Bool(value),
            ..
        }) => *value,
        Some(node) => {
            fields.mismatch(node, &path.key(key), "true or false");
            false
        }
    }
}

/// A whole number from 0 on that a double holds exactly.
fn whole(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>) -> Option<u64> {
    match node.value {
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a whole number in the range of the type"
        )]
        Value::Number(v) if v.fract() == 0.0 && (0.0..=9007199254740992.0).contains(&v) => {
            Some(v as u64)
        }
        _ => {
            fields.mismatch(node, path, "a whole number from 0 on");
            None
        }
    }
}

fn effects(
    fields: &mut Fields<'_>,
    node: &Node,
    path: &Path<'_>,
    robot: &Robot,
) -> Option<Vec<crate::effects::Term>> {
    let Value::List(list) = &node.value else {
        fields.mismatch(node, path, "an array of effects");
        return None;
    };
    let joints = robot.joints.len();
    let terms: Vec<Option<_>> = list
        .iter()
        .enumerate()
        .map(|(index, node)| term(fields, node, &path.index(index), joints))
        .collect();
    terms.into_iter().collect()
}

fn noise(
    fields: &mut Fields<'_>,
    node: &Node,
    path: &Path<'_>,
    scenario: &mut Scenario,
) -> Option<()> {
    let members = fields.object(node, path, "an object with sigma_mm and kind")?;
    fields.unknown_keys(members, path, &["sigma_mm", "kind", "resolution_mm"]);
    let sigma_mm = fields.required_number(members, node.at, path, "sigma_mm")?;
    let kinds = [NoiseKind::Gauss, NoiseKind::T4, NoiseKind::Ar1];
    let kind = match optional(members, "kind") {
        None => NoiseKind::Gauss,
        Some(node) => {
            let named = kinds
                .into_iter()
                .find(|kind| matches!(&node.value, Value::Text(name) if name == kind.name()));
            if named.is_none() {
                fields.mismatch(node, &path.key("kind"), "\"gauss\", \"t4\" or \"ar1\"");
            }
            named?
        }
    };
    if let Some(node) = optional(members, "resolution_mm") {
        let path = &path.key("resolution_mm");
        scenario.resolution_mm = Some(positive(fields, node, path, "a length above 0 mm")?);
    }
    scenario.noise = Some(Noise { sigma_mm, kind });
    Some(())
}

fn outliers(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>) -> Option<Outliers> {
    let members = fields.object(node, path, "an object with share and mm")?;
    fields.unknown_keys(members, path, &["share", "mm"]);
    let share = fields.required_number(members, node.at, path, "share");
    let mm = fields.required_number(members, node.at, path, "mm");
    Some(Outliers {
        share: share?,
        mm: mm?,
    })
}
