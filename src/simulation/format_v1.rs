//! `truepose-scenario/1` on disk.
//!
//! Beyond the keys of the contract a scenario may have `name`, `note`, `tolerance_mm` and `regions`
//! (they go into the session), `planar` (z is not measured), `poses.random.count` and
//! `noise.resolution_mm`. A condition may be one number instead of a list. For a sliding joint the
//! numbers under `from_deg`, `to_deg`, `step_deg`, `q_deg` and `speed_deg_s` are mm; `from_mm` and
//! so on say the same more plainly.

use std::path::{Path as FilePath, PathBuf};

use super::scenario::{
    Circumstances, Noise, NoiseKind, Order, Outliers, Poses, Scenario, Stop, Sweep, Temperature,
};
use crate::diagnostic::{Diagnostic, Place, Rejected, Severity};
use crate::kinematics::{JointKind, Robot};
use crate::model::format_v1::term;
use crate::sessions::format_v1::read::{default_targets, instrument, positive, regions, targets};
use crate::sessions::format_v1::robot;
use crate::sessions::json::{self, Fields, Member, Node, Path, Source, Value, optional};
use crate::sessions::{files, validation};
use crate::units::rad_from_deg;

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
    let source = Source {
        file: place.file,
        text,
    };
    let root = json::parse(&source)?;
    let mut fields = Fields::new(source);
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
    let known: Vec<&str> = KNOWN.into_iter().chain(["seed"]).collect();
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

fn inner(kind: JointKind, outer: f64) -> f64 {
    match kind {
        JointKind::Revolute => rad_from_deg(outer),
        JointKind::Prismatic => outer,
    }
}

fn poses(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>, robot: &Robot) -> Option<Poses> {
    const EXPECTED: &str = "one of sweep, list or random";
    let members = fields.object(node, path, "an object with sweep, list or random")?;
    fields.unknown_keys(members, path, &["sweep", "list", "random"]);
    let given: Vec<&str> = ["sweep", "list", "random"]
        .into_iter()
        .filter(|key| optional(members, key).is_some())
        .collect();
    let [kind] = given[..] else {
        let found = match given.len() {
            0 => "no poses".to_owned(),
            _ => given.join(" and "),
        };
        fields.error(node.at, path, found, EXPECTED);
        return None;
    };
    let node = optional(members, kind)?;
    let path = &path.key(kind);
    match kind {
        "sweep" => sweep(fields, node, path, robot).map(Poses::Sweep),
        "list" => list(fields, node, path, robot).map(Poses::List),
        _ => {
            let members = fields.object(node, path, "an object with count")?;
            fields.unknown_keys(members, path, &["count"]);
            let count = fields.required(members, node.at, path, "count", "a number of poses")?;
            let count = whole(fields, count, &path.key("count"))?;
            usize::try_from(count).ok().map(Poses::Random)
        }
    }
}

fn sweep(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>, robot: &Robot) -> Option<Sweep> {
    const KNOWN: [&str; 10] = [
        "joint",
        "from_deg",
        "to_deg",
        "step_deg",
        "from_mm",
        "to_mm",
        "step_mm",
        "both_ways",
        "repeats",
        "order",
    ];
    let members = fields.object(
        node,
        path,
        "an object with joint, from_deg, to_deg and step_deg",
    )?;
    fields.unknown_keys(members, path, &KNOWN);
    let joint = match optional(members, "joint") {
        None => 1,
        Some(node) => whole(fields, node, &path.key("joint"))?,
    };
    let index = usize::try_from(joint).ok()?.checked_sub(1);
    let Some(index) = index.filter(|index| *index < robot.joints.len()) else {
        let expected = format!("a joint from 1 to {}", robot.joints.len());
        fields.error(node.at, &path.key("joint"), joint.to_string(), expected);
        return None;
    };
    let kind = robot.joints[index].kind;
    let mut value = |stem: &str| {
        let plain = format!("{stem}_mm");
        let key = match kind {
            JointKind::Prismatic if optional(members, &plain).is_some() => plain,
            _ => format!("{stem}_deg"),
        };
        fields
            .required_number(members, node.at, path, &key)
            .map(|v| inner(kind, v))
    };
    let (from, to, step) = (value("from"), value("to"), value("step"));
    let repeats = match optional(members, "repeats") {
        None => 1,
        Some(node) => usize::try_from(whole(fields, node, &path.key("repeats"))?).ok()?,
    };
    let order = match optional(members, "order").map(|node| (node, &node.value)) {
        None => Order::Sweep,
        Some((_, Value::Text(order))) if order == "sweep" => Order::Sweep,
        Some((_, Value::Text(order))) if order == "random" => Order::Random,
        Some((node, _)) => {
            fields.mismatch(node, &path.key("order"), "\"sweep\" or \"random\"");
            return None;
        }
    };
    Some(Sweep {
        joint: index,
        from: from?,
        to: to?,
        step: step?,
        both_ways: flag(fields, members, path, "both_ways"),
        repeats,
        order,
    })
}

fn list(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>, robot: &Robot) -> Option<Vec<Stop>> {
    let Value::List(list) = &node.value else {
        fields.mismatch(node, path, "an array of objects with q_deg");
        return None;
    };
    let stops: Vec<Option<Stop>> = list
        .iter()
        .enumerate()
        .map(|(index, node)| stop(fields, node, &path.index(index), robot))
        .collect();
    stops.into_iter().collect()
}

fn stop(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>, robot: &Robot) -> Option<Stop> {
    let members = fields.object(
        node,
        path,
        "an object with q_deg, and dir where it is known",
    )?;
    fields.unknown_keys(members, path, &["q_deg", "dir"]);
    let joints = robot.joints.len();
    let expected = format!("an array of {joints} numbers, one for each joint");
    let mut each = |node: &Node, key: &str| match &node.value {
        Value::Numbers(values)
            if values.len() == joints && values.iter().all(|v| v.is_finite()) =>
        {
            Some(values.clone())
        }
        _ => {
            fields.mismatch(node, &path.key(key), &expected);
            None
        }
    };
    let q = members.iter().find(|m| m.key == "q_deg");
    let dir = match optional(members, "dir") {
        None => None,
        Some(node) => Some((node, each(node, "dir")?)),
    };
    let q = q.map(|m| each(&m.node, "q_deg"));
    let Some(q) = q else {
        fields.error(node.at, path, "no key 'q_deg'", expected);
        return None;
    };
    if let Some((node, dir)) = &dir
        && dir.iter().any(|d| ![-1.0, 0.0, 1.0].contains(d))
    {
        fields.mismatch(
            node,
            &path.key("dir"),
            "1, -1 or 0 (unknown) for each joint",
        );
        return None;
    }
    let kinds = robot.joints.iter().map(|j| j.kind);
    Some(Stop {
        q: kinds.zip(q?).map(|(kind, q)| inner(kind, q)).collect(),
        dir: dir.map(|(_, dir)| dir),
    })
}

/// One number or several.
fn values(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>) -> Option<Vec<f64>> {
    match &node.value {
        Value::Number(value) if value.is_finite() => Some(vec![*value]),
        Value::Numbers(values) if values.iter().all(|v| v.is_finite()) => Some(values.clone()),
        _ => {
            fields.mismatch(node, path, "a number, or an array of numbers");
            None
        }
    }
}

fn conditions(
    fields: &mut Fields<'_>,
    node: &Node,
    path: &Path<'_>,
    robot: &Robot,
) -> Option<Circumstances> {
    const KNOWN: [&str; 5] = [
        "speed_deg_s",
        "speed_mm_s",
        "load_kg",
        "temperature_c",
        "seconds_per_pose",
    ];
    let members = fields.object(node, path, "an object with the conditions")?;
    fields.unknown_keys(members, path, &KNOWN);
    let mut circumstances = Circumstances::default();
    let slides = robot.joints.iter().all(|j| j.kind == JointKind::Prismatic);
    let kind = if slides {
        JointKind::Prismatic
    } else {
        JointKind::Revolute
    };
    for key in ["speed_deg_s", "speed_mm_s"] {
        if let Some(node) = optional(members, key) {
            let speeds = values(fields, node, &path.key(key))?;
            circumstances.speeds = speeds.into_iter().map(|v| inner(kind, v)).collect();
        }
    }
    if let Some(node) = optional(members, "load_kg") {
        circumstances.loads_kg = values(fields, node, &path.key("load_kg"))?;
    }
    if let Some(node) = optional(members, "temperature_c") {
        let path = &path.key("temperature_c");
        circumstances.temperature = Some(if let Value::Object(members) = &node.value {
            fields.unknown_keys(members, path, &["from", "to", "time_constant_s"]);
            let mut number = |key: &str| fields.required_number(members, node.at, path, key);
            let (from, to, tau) = (number("from"), number("to"), number("time_constant_s"));
            Temperature::WarmUp {
                from_c: from?,
                to_c: to?,
                time_constant_s: tau?,
            }
        } else {
            Temperature::Values(values(fields, node, path)?)
        });
    }
    if let Some(node) = optional(members, "seconds_per_pose") {
        let path = &path.key("seconds_per_pose");
        circumstances.seconds_per_pose = Some(positive(fields, node, path, "a time above 0 s")?);
    }
    Some(circumstances)
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
