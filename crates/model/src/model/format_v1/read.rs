//! The model document; every complaint has line, column and path.

use crate::diagnostic::{Place, Rejected};
use crate::document::kinds::{DEGREES, NUMBER, TEXT, count};
use crate::document::number::hexadecimal;
use crate::document::object::{Cursor, Kind, Object, written};
use crate::document::{Fields, Node, Value, ranges, text_of};
use crate::effects::Term;
use crate::kinematics::{JointKind, Range};
use crate::model::{Calibration, Conditions, Model, RegionalCorrection, ResidualStep, SetUp};
use crate::sessions::default_targets;
use crate::sessions::files::format_v1::head::{TARGETS, TOLERANCE_MM};
use crate::sessions::files::format_v1::robot::{ROBOT, blank};
use crate::sessions::files::open;
use nalgebra::DMatrix;
use serde::Deserializer as _;
use serde::de::{IgnoredAny, MapAccess, Visitor};
use sha2::{Digest, Sha256};
use std::fmt;
use std::io::{self, Read as _};
use std::path::Path as FilePath;

use super::exact::{exact, exact_robot, robot_of};
use super::set_up::{SET_UP, VALUES};
use super::term::{term, term_written};

/// Reads the model at `path`.
///
/// # Errors
/// [`Rejected`] with every problem that was found, each with file, line, column and what was
/// expected.
pub fn load_model(path: impl AsRef<FilePath>) -> Result<Calibration, Rejected> {
    let path = path.as_ref();
    let bytes = open::read_document(path)?;
    let place = Place::file(path);
    let text = open::as_text(&bytes, &place)?;
    read(text, place)
}

/// What every version of the model's format begins with.
const MODEL: &str = "truepose-model/";
/// Bytes in which a broken document has to name its format. A file of another kind may be of any length.
const BEGINNING: u64 = 1 << 16;

/// Whether a file calls itself a model. What cannot be read is left to the reader of sessions, which reports why.
pub fn is_model(path: &FilePath) -> bool {
    let Ok((file, _)) = open::open_regular(path) else {
        return false;
    };
    let mut tag = Tag(None);
    let reader = io::BufReader::new(file);
    // Where it ends does not matter.
    let _ = serde_json::Deserializer::from_reader(reader).deserialize_map(&mut tag);
    match tag.0 {
        Some(format) => format.starts_with(MODEL),
        // Broken, but its beginning may still name its format.
        None => open::open_regular(path).is_ok_and(|(file, _)| {
            let mut start = Vec::new();
            let read = file.take(BEGINNING).read_to_end(&mut start);
            read.is_ok() && memchr::memmem::find(&start, MODEL.as_bytes()).is_some()
        }),
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
    read(text, Place::default())
}

fn read(text: &str, place: Place) -> Result<Calibration, Rejected> {
    let (mut fields, root) = Fields::open(place, text)?;
    let calibration = document(&mut fields, &root);
    fields.finish(calibration)
}

fn document(fields: &mut Fields<'_>, root: &Node) -> Option<Calibration> {
    let expected = text!("a model: an object with the key \"format\"");
    let mut at = fields.of_format(root, FORMAT, expected)?;
    let blank = Calibration {
        session: String::new(),
        model: Model::nominal(blank()),
        covariance: None,
        regions: Vec::new(),
        targets: default_targets(),
        measured_targets: None,
        measured: Vec::new(),
        measured_steps: None,
        load_kg: None,
        tolerance_mm: None,
        compensated_by: None,
        set_up: SetUp::default(),
        conditions: Conditions::default(),
        set_aside: None,
        history: Vec::new(),
        samples_hash: String::new(),
        program_version: String::new(),
    };
    at.object(blank, calibration)
}

/// The model as the text of its file: the gate (`compensation::VerifiedCalibration`) is its only way out.
pub fn write_model(calibration: &Calibration) -> String {
    text_of(&written(calibration.clone(), self::calibration))
}

/// SHA-256 of the model's file as the program writes it: 64 hexadecimal digits. A session states with it which model's
/// table was active while it was measured (`compensated_by`).
pub fn model_hash(calibration: &Calibration) -> String {
    hexadecimal(&Sha256::digest(write_model(calibration)))
}

fn calibration(o: &mut Object<'_, '_>, own: &mut Calibration) {
    o.describe("format", FORMAT);
    o.required("program_version", &mut own.program_version, &TEXT);
    o.required("session", &mut own.session, &TEXT);
    o.required("samples_hash", &mut own.samples_hash, &TEXT);
    let mut robot = own.model.robot.clone();
    if o.needs("robot", ROBOT.expected) {
        let write = |robot: &_| Some((ROBOT.write)(robot));
        o.with("robot", &mut robot, ROBOT.expected, robot_of, write);
    }
    o.end_if_wrong();
    if o.given("robot_exact") {
        let expected = text!("an object with joints and tool_quaternion_wxyz");
        o.part("robot_exact", &mut robot, expected, exact_robot);
    }
    o.end_if_wrong();
    let targets = Kind {
        read: |at| {
            ranges::check(at.fields, at.node, at.path);
            (TARGETS.read)(at)
        },
        ..TARGETS
    };
    o.usual("targets", &mut own.targets, &targets);
    let mut terms = own.model.terms().to_vec();
    let joints = robot.joints.len();
    if o.needs("effects", phrase!("an array")) {
        let read = |at: &mut Cursor<'_, '_>| at.list_by(|at| term(at, &robot));
        let one = |own: &Term| term_written(own, &robot);
        let write = |all: &Vec<Term>| Some(all.iter().map(one).collect());
        let expected = phrase!("an array of objects");
        o.with("effects", &mut terms, expected, read, write);
    }
    o.end_if_wrong();
    if o.is_read() {
        own.model = Model::new(robot, terms);
    }
    covariance(o, own);
    let array = phrase!("an array");
    o.required_as("regions", array, &mut own.regions, &REGIONS);
    let kinds = own.model.robot.joints.iter().map(|joint| joint.kind);
    if !own.regions.is_empty() && !kinds.eq([JointKind::Revolute]) {
        let found = text!("regions of another robot than one with a single turning joint");
        o.error_in("regions", found, text!("no regions for this robot"));
    }
    o.required_as("measured", array, &mut own.measured, &RANGES);
    if o.has_read_well() && own.measured.len() != joints {
        let found = text!(one "{count} range", "{count} ranges", count = own.measured.len());
        let expected = text!("one range for each of {joints} joints", joints);
        o.error_in("measured", found, expected);
    }
    let steps = &mut own.measured_steps;
    o.optional("measured_steps", steps, &VALUES);
    if let Some(count) = steps
        .as_ref()
        .map(Vec::len)
        .filter(|count| *count != joints)
    {
        let found = text!(one "{count} number", "{count} numbers", count);
        o.error_in(
            "measured_steps",
            found,
            text!("one number for each of {joints} joints", joints),
        );
    }
    o.optional("load_kg", &mut own.load_kg, &LOADS);
    o.usual_or_null("tolerance_mm", &mut own.tolerance_mm, &TOLERANCE_MM);
    o.optional("compensated_by", &mut own.compensated_by, &TEXT);
    o.usual("set_up", &mut own.set_up, &SET_UP);
    let targets = &mut own.measured_targets;
    o.optional("measured_targets", targets, &MEASURED_TARGETS);
    o.optional("set_aside", &mut own.set_aside, &SAMPLES);
    if o.given("conditions") {
        let expected = text!("an object with load_kg and temperature_c");
        o.part("conditions", &mut own.conditions, expected, conditions);
    }
    o.required_as("history", array, &mut own.history, &STEPS);
}

fn covariance(o: &mut Object<'_, '_>, own: &mut Calibration) {
    let size = own.model.coefficient_count();
    let expected = text!(
        "{size} arrays of {size} numbers, one for each coefficient",
        size
    );
    let read = |at: &mut Cursor<'_, '_>| {
        // A number that could not be written is null there and NaN here.
        let row = |row: &Node| match &row.value {
            Value::Numbers(row) if row.len() == size => Some(row.clone()),
            _ => None,
        };
        match &at.node.value {
            Value::Null => Some(None),
            Value::List(rows) if rows.len() == size => {
                let rows: Option<Vec<Vec<f64>>> = rows.iter().map(row).collect();
                let matrix = rows.map(|rows| DMatrix::from_fn(size, size, |i, j| rows[i][j]));
                matrix.map(Some).or_else(|| at.wrong())
            }
            _ => at.wrong(),
        }
    };
    let write = |covariance: &Option<DMatrix<f64>>| {
        let rows = covariance.as_ref().map(|covariance| {
            let row = |row: usize| -> Vec<f64> { covariance.row(row).iter().copied().collect() };
            let rows = (0..covariance.nrows()).map(row);
            rows.collect::<Value>()
        });
        Some(rows.into())
    };
    o.with("covariance", &mut own.covariance, expected, read, write);
}

const REGIONS: Kind<Vec<RegionalCorrection>> = Kind {
    expected: phrase!("an array of objects"),
    read: |at| at.list(&REGION),
    write: |all| all.iter().map(REGION.write).collect(),
};

const REGION: Kind<RegionalCorrection> = Kind {
    expected: phrase!("an object that describes a region"),
    read: |at| at.object(RegionalCorrection::default(), region),
    write: |own| written(own.clone(), region),
};

fn region(o: &mut Object<'_, '_>, own: &mut RegionalCorrection) {
    o.required("name", &mut own.name, &TEXT);
    o.required("from_deg", &mut own.from_rad, &DEGREES);
    o.required("to_deg", &mut own.to_rad, &DEGREES);
    let samples = count(phrase!("a number of samples"));
    o.required("samples", &mut own.samples, &samples);
    let expected = phrase!("an object with theta_rad and l1_mm");
    o.part("correction", own, expected, |o, own| {
        o.required("theta_rad", &mut own.theta_rad, &NUMBER);
        o.required("l1_mm", &mut own.l1_mm, &NUMBER);
    });
    o.end_if_wrong();
    if o.given("exact") {
        let expected = phrase!("an object with from_rad and to_rad");
        o.part("exact", own, expected, |o, own| {
            exact(o, "from_rad", &mut own.from_rad);
            exact(o, "to_rad", &mut own.to_rad);
        });
    }
    let (from, to) = (own.from_rad, own.to_rad);
    if o.has_read_well() && from >= to {
        let expected = text!("a range from the smaller to the larger value");
        let found = text!("a region from {from} to {to} rad", from, to);
        o.error(found, expected);
    }
}

const RANGES: Kind<Vec<Range>> = Kind {
    expected: phrase!("an array of objects"),
    read: |at| at.list(&RANGE),
    write: |all| all.iter().map(RANGE.write).collect(),
};

/// Least and largest, kg; below zero where the session had it so, which is reported when that is read.
const LOADS: Kind<[f64; 2]> = Kind {
    expected: phrase!("two numbers, the least load and the largest"),
    read: |at| {
        let [least, most] = at.numbers::<2>()?;
        if least > most {
            let found = text!("loads from {least} to {most} kg", least, most);
            return at.error(found, text!("the least load and the largest"));
        }
        Some([least, most])
    },
    write: |own| (*own).into(),
};

/// rad or mm.
const RANGE: Kind<Range> = Kind {
    expected: phrase!("an object with from_inner and to_inner"),
    read: |at| at.object(Range::default(), range),
    write: |own| written(*own, range),
};

fn range(o: &mut Object<'_, '_>, own: &mut Range) {
    o.required("from_inner", &mut own.from, &NUMBER);
    o.required("to_inner", &mut own.to, &NUMBER);
    let (from, to) = (own.from, own.to);
    if o.has_read_well() && from > to {
        let expected = text!("a range from the smaller to the larger value");
        o.error(text!("a range from {from} to {to}", from, to), expected);
    }
}

/// The same of targets.
const MEASURED_TARGETS: Kind<Vec<usize>> = Kind {
    expected: phrase!("an array of numbers of targets, counted from 1"),
    ..SAMPLES
};

/// Samples, counted from 1 in the file.
const SAMPLES: Kind<Vec<usize>> = Kind {
    expected: phrase!("an array of numbers of samples, counted from 1"),
    read: |at| {
        let whole = |v: &f64| v.fract() == 0.0 && (1.0..=1e15).contains(v);
        let all = at.column().filter(|all| all.iter().all(whole));
        let all = all.or_else(|| at.wrong())?;
        #[allow(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a whole number in the range of the type"
        )]
        let samples = all.iter().map(|v| *v as usize - 1);
        Some(samples.collect())
    },
    write: |all| {
        let all: Vec<f64> = all.iter().map(|sample| *sample as f64 + 1.0).collect();
        all.as_slice().into()
    },
};

fn conditions(o: &mut Object<'_, '_>, own: &mut Conditions) {
    o.usual_or_null("load_kg", &mut own.load_kg, &FROM_TO);
    o.usual_or_null("temperature_c", &mut own.temperature_c, &FROM_TO);
}

/// From the smaller to the larger value.
const FROM_TO: Kind<Range> = Kind {
    expected: phrase!("2 numbers, the smaller first"),
    read: |at| match at.numbers::<2>()? {
        [from, to] if from <= to => Some(Range { from, to }),
        _ => at.wrong(),
    },
    write: |range| [range.from, range.to].into(),
};

const STEPS: Kind<Vec<ResidualStep>> = Kind {
    expected: phrase!("an array of objects"),
    read: |at| at.list(&STEP),
    write: |all| all.iter().map(STEP.write).collect(),
};

const STEP: Kind<ResidualStep> = Kind {
    expected: phrase!("an object with what and gap_mm"),
    read: |at| {
        let blank = ResidualStep {
            what: String::new(),
            gap_mm: f64::NAN,
            held_out_mm: None,
            runs_held_out_mm: None,
            values_held_out_mm: None,
        };
        at.object(blank, step)
    },
    write: |own| written(own.clone(), step),
};

fn step(o: &mut Object<'_, '_>, own: &mut ResidualStep) {
    o.required("what", &mut own.what, &TEXT);
    o.usual("gap_mm", &mut own.gap_mm, &NUMBER);
    o.usual_or_null("held_out_mm", &mut own.held_out_mm, &NUMBER);
    o.optional("runs_held_out_mm", &mut own.runs_held_out_mm, &NUMBER);
    o.optional("values_held_out_mm", &mut own.values_held_out_mm, &NUMBER);
}

/// The value of the key `format`.
pub(crate) const FORMAT: &str = "truepose-model/1";
