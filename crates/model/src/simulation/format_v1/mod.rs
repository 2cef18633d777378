//! `truepose-scenario/1` on disk.
//!
//! Beyond the keys of the contract a scenario may have `name`, `note`, `tolerance_mm` and `regions`
//! (they go into the session), `planar` (z is not measured), `poses.random.count` and
//! `noise.resolution_mm`. `measure` is how the samples are measured, in turn: `["point"]` by default, or any of point,
//! pose, distance, bearing, pointing, socket, touch. What they refer to is in `anchors`, `stations`, `planes`,
//! `sockets`, `socket_distances_mm` and `pointing` as in a session, with where it really is; `unknown` lists which of
//! anchors, stations, planes, sockets the session does not state. Their noise is what the instrument states
//! (`sigma_mrad`, `sigma_distance_mm`, `sigma_direction_urad`, `sigma_touch_mm`; of a tracker `sigma_range_mm` and
//! `sigma_angle_urad`), that of points and sockets `noise.sigma_mm`. A condition may be one number instead of a list.
//! For a prismatic joint the numbers under `from_deg`, `to_deg`, `step_deg`, `q_deg` and `speed_deg_s` are mm;
//! `from_mm` and so on state the same more plainly.

use std::path::{Path as FilePath, PathBuf};

mod conditions;
mod poses;
mod values;

use conditions::conditions;
use poses::poses;

use super::scenario::{Measure, Noise, NoiseKind, Outliers, Poses, Scenario};
use crate::diagnostic::{Diagnostic, Place, Rejected, Severity};
use crate::document::kinds::{NUMBER, TEXT};
use crate::document::object::{Cursor, Kind, Object, written};
use crate::document::{Fields, Node, Path, Value, ranges};
use crate::effects::PlaceKind;
use crate::kinematics::Robot;
use crate::model::format_v1::term;
use crate::sessions::default_targets;
use crate::sessions::files::format_v1::head::{INSTRUMENT, REGIONS, TARGETS, TOLERANCE_MM};
use crate::sessions::files::format_v1::references::references;
use crate::sessions::files::format_v1::robot::{ROBOT, blank};
use crate::sessions::files::open;
use crate::sessions::validation;
use values::{FLAG, WHOLE};

/// The value of the key `format`.
pub(crate) const FORMAT: &str = "truepose-scenario/1";

/// A scenario and the notes and warnings that came up on the way.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadedScenario {
    /// The scenario in the file.
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
    let bytes = open::read_document(path)?;
    let place = Place::file(path);
    let text = open::as_text(&bytes, &place)?;
    read(text, place)
}

/// Reads a scenario that is in memory.
///
/// # Errors
/// As [`load_scenario`].
pub fn parse_scenario(document: &[u8]) -> Result<LoadedScenario, Rejected> {
    let text = open::as_text(document, &Place::default())?;
    read(text, Place::default())
}

fn read(text: &str, place: Place) -> Result<LoadedScenario, Rejected> {
    let (mut fields, root) = Fields::open(place, text)?;
    let scenario = document(&mut fields, &root);
    let mut findings = std::mem::take(&mut fields.findings);
    let sound = |findings: &[Diagnostic]| findings.iter().all(|f| f.severity != Severity::Error);
    let Some(scenario) = scenario.filter(|_| sound(&findings)) else {
        return Err(Rejected::of(findings));
    };
    for mut problem in scenario.problems() {
        // Its field is the place; the key that it begins with has the line.
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
        Err(Rejected::of(findings))
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

fn document(fields: &mut Fields<'_>, root: &Node) -> Option<Scenario> {
    let expected = text!("a scenario: an object with the key \"format\"");
    let mut at = fields.of_format(root, FORMAT, expected)?;
    if let Value::Object(members) = &root.value {
        for member in members.iter().filter(|member| member.key != "robot") {
            ranges::check(at.fields, &member.node, &Path::Root.key(&member.key));
        }
    }
    let mut scenario = Scenario::new("simulated session", blank(), Poses::List(Vec::new()));
    scenario.targets = default_targets();
    at.object(scenario, declare)
}

/// No scenario is written: this only reads.
fn nothing<T>(_: &T) -> Option<Value> {
    None
}

fn declare(o: &mut Object<'_, '_>, own: &mut Scenario) {
    o.describe("format", FORMAT);
    if o.needs("robot", ROBOT.expected) {
        o.with("robot", &mut own.robot, ROBOT.expected, robot_of, nothing);
    }
    o.end_if_wrong();
    let (robot, expected) = (&own.robot, text!("an object with sweep, list or random"));
    if o.needs("poses", &expected) {
        let read = |at: &mut Cursor<'_, '_>| poses(at, robot);
        o.with("poses", &mut own.poses, expected, read, nothing);
    }
    o.usual("name", &mut own.name, &TEXT);
    o.usual("note", &mut own.note, &TEXT);
    o.usual("targets", &mut own.targets, &TARGETS);
    o.usual("instrument", &mut own.instrument, &INSTRUMENT);
    references(o, &mut own.instrument.references);
    o.usual("measure", &mut own.measure, &MEASURE);
    o.usual("unknown", &mut own.unknown, &UNKNOWN);
    o.optional("tolerance_mm", &mut own.tolerance_mm, &TOLERANCE_MM);
    o.usual("regions", &mut own.regions, &REGIONS);
    o.usual("planar", &mut own.planar, &FLAG);
    if o.given("conditions") {
        let read = |at: &mut Cursor<'_, '_>| conditions(at, robot);
        let (expected, all) = (
            text!("an object with the conditions"),
            &mut own.circumstances,
        );
        o.with("conditions", all, expected, read, nothing);
    }
    if o.given("effects") {
        let read = |at: &mut Cursor<'_, '_>| at.list_by(|at| term(at, robot));
        let expected = phrase!("an array of effects");
        o.with("effects", &mut own.effects, expected, read, nothing);
    }
    if o.given("noise") {
        let expected = phrase!("an object with sigma_mm and kind");
        o.part("noise", own, expected, noise);
    }
    o.optional("outliers", &mut own.outliers, &OUTLIERS);
    o.usual("seed", &mut own.seed, &WHOLE);
}

const MEASURE: Kind<Vec<Measure>> = Kind {
    expected: phrase!(""),
    read: |at| names(at, &Measure::ALL, Measure::name),
    write: |all| all.iter().map(|one| one.name()).collect(),
};

const UNKNOWN: Kind<Vec<PlaceKind>> = Kind {
    expected: phrase!(""),
    read: |at| {
        let all = [
            PlaceKind::Anchor,
            PlaceKind::Station,
            PlaceKind::Plane,
            PlaceKind::Socket,
        ];
        names(at, &all, places)
    },
    write: |all| all.iter().map(|one| places(*one)).collect(),
};

fn places(kind: PlaceKind) -> &'static str {
    match kind {
        PlaceKind::Anchor => "anchors",
        PlaceKind::Station => "stations",
        PlaceKind::Plane => "planes",
        PlaceKind::Socket => "sockets",
    }
}

/// A list of names of these.
fn names<T: Copy>(
    at: &mut Cursor<'_, '_>,
    all: &[T],
    name: fn(T) -> &'static str,
) -> Option<Vec<T>> {
    let known: Vec<&str> = all.iter().map(|one| name(*one)).collect();
    let expected = text!("an array of some of {known}", known = known.join(", "));
    at.expected = expected.clone();
    at.list_by(|at| {
        at.expected = expected.clone();
        at.one_of(all, name)
    })
}

const NOISE_KIND: Kind<NoiseKind> = Kind {
    expected: phrase!("\"gauss\", \"t4\" or \"ar1\""),
    read: |at| at.one_of(&NoiseKind::ALL, NoiseKind::name),
    write: |kind| kind.name().into(),
};

fn noise(o: &mut Object<'_, '_>, own: &mut Scenario) {
    let mut noise = Noise {
        sigma_mm: 0.0,
        kind: NoiseKind::Gauss,
    };
    o.required("sigma_mm", &mut noise.sigma_mm, &NUMBER);
    o.usual("kind", &mut noise.kind, &NOISE_KIND);
    o.optional("resolution_mm", &mut own.resolution_mm, &TOLERANCE_MM);
    own.noise = Some(noise);
}

const OUTLIERS: Kind<Outliers> = Kind {
    expected: phrase!("an object with share and mm"),
    read: |at| at.object(Outliers::default(), outliers),
    write: |own| written(*own, outliers),
};

fn outliers(o: &mut Object<'_, '_>, own: &mut Outliers) {
    o.required("share", &mut own.share, &NUMBER);
    o.required("mm", &mut own.mm, &NUMBER);
}

/// A robot that can be simulated.
fn robot_of(at: &mut Cursor<'_, '_>) -> Option<Robot> {
    let robot = ROBOT.read(at.fields, at.node, at.path)?;
    let place = at.fields.place(at.node.at, at.path);
    validation::robot(&robot, &place, &mut at.fields.findings);
    Some(robot)
}
