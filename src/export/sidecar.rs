//! What a table cannot say of itself: `FILE.meta.json`, `truepose-table/1`.

use serde::Serialize;
use sha2::{Digest, Sha256};

use super::Job;
use super::left::Left;
use super::rules::{Rules, Says};
use super::sheet::Sheet;
use crate::compensation::conditions::Side;
use crate::compensation::inverse::{closest_commands, places};
use crate::compensation::{Compensation, Remainder};
use crate::document::write_document;
use crate::effects::Inputs;
use crate::kinematics::Range;
use crate::model::format_v1::model_hash;

/// See the module.
#[derive(Debug, Serialize)]
pub(super) struct Sidecar {
    format: &'static str,
    table: String,
    table_format: &'static str,
    table_sha256: String,
    program_version: &'static str,
    session: String,
    samples_hash: String,
    model_hash: String,
    joint: usize,
    joint_name: String,
    unit: &'static str,
    unit_of_the_numbers: &'static str,
    sign: &'static str,
    /// How much of what was identified it carries.
    level: &'static str,
    level_in_words: &'static str,
    example: Example,
    in_the_controller: Vec<String>,
    tried: Option<&'static str>,
    grid: Grid,
    interpolation: &'static str,
    outside_the_table: &'static str,
    direction: &'static str,
    full_turn: &'static str,
    repeats_after_a_turn: bool,
    measured_range: [f64; 2],
    outside_the_measured_range: &'static str,
    conditions: ConditionsTwin,
    leaves: Leaves,
    stays: Stays,
    notes: Vec<String>,
}

#[derive(Debug, Serialize)]
struct Example {
    commanded: f64,
    robot_reaches: f64,
    table_says: f64,
    command_to_send: f64,
    says: String,
}

#[derive(Debug, Serialize)]
struct Grid {
    from: f64,
    to: f64,
    /// None where the entries stand where they are needed.
    step: Option<f64>,
    rows: usize,
    most_rows: Option<usize>,
}

#[derive(Debug, Serialize)]
struct ConditionsTwin {
    speed_per_s: f64,
    load_kg: f64,
    temperature_c: f64,
}

/// What the controller leaves with this table, over the measured range.
#[derive(Debug, Serialize)]
struct Leaves {
    gap_mm: Option<f64>,
    gap_of_an_exact_correction_mm: Option<f64>,
    added_rms_mm: f64,
    added_max_mm: f64,
    allowed_mm: f64,
    allowed_is: &'static str,
    within: bool,
}

/// What no joint removes, over the measured range.
#[derive(Debug, Serialize)]
struct Stays {
    rms_mm: f64,
    max_mm: f64,
    says: Vec<String>,
}

/// Poses over which what stays is stated, per joint.
const POSES: usize = 181;

impl Sidecar {
    pub(super) fn new(
        job: &Job,
        sheet: &Sheet,
        rules: &Rules,
        left: &Left,
        in_the_controller: Vec<String>,
    ) -> Self {
        let calibration = job.calibration;
        let remainder = Remainder::new(calibration, &measured_poses(job));
        let [from, to] = sheet.ends();
        Self {
            format: "truepose-table/1",
            table: job.file_name.to_owned(),
            table_format: rules.format,
            table_sha256: String::new(),
            program_version: env!("CARGO_PKG_VERSION"),
            session: calibration.session.clone(),
            samples_hash: calibration.samples_hash.clone(),
            model_hash: model_hash(calibration),
            joint: sheet.joint + 1,
            joint_name: sheet.name.clone(),
            unit: sheet.unit(),
            unit_of_the_numbers: rules.unit(sheet.kind),
            sign: rules.says.sentence(),
            level: "effects-of-a-joint",
            level_in_words: "everything that this joint can correct, its zero offset included",
            example: Example::new(job, sheet, rules),
            in_the_controller,
            tried: rules.label,
            grid: Grid {
                from,
                to,
                step: sheet.step,
                rows: sheet.places.len(),
                most_rows: (rules.most_entries < usize::MAX).then_some(rules.most_entries),
            },
            interpolation: rules.interpolation,
            outside_the_table: rules.outside,
            direction: rules.direction,
            full_turn: rules.full_turn,
            repeats_after_a_turn: sheet.repeats,
            measured_range: [
                sheet.outer(sheet.measured.from),
                sheet.outer(sheet.measured.to),
            ],
            outside_the_measured_range: "the correction at the end of the measured range is held",
            conditions: ConditionsTwin {
                speed_per_s: sheet.outer(sheet.conditions.speed),
                load_kg: sheet.conditions.load_kg,
                temperature_c: sheet.conditions.temperature_c,
            },
            leaves: Leaves {
                gap_mm: left.gap_mm.map(|gap| gap[0]),
                gap_of_an_exact_correction_mm: left.gap_mm.map(|gap| gap[1]),
                added_rms_mm: left.added_rms_mm,
                added_max_mm: left.added_max_mm,
                allowed_mm: left.allowance.mm,
                allowed_is: left.allowance.is,
                within: left.met(),
            },
            stays: Stays {
                rms_mm: remainder.rms_mm,
                max_mm: remainder.max_mm,
                says: remainder.says(),
            },
            notes: sheet.notes.clone(),
        }
    }

    /// What a user should hear besides the file: the example, what to enter, the table's notes,
    /// what stays.
    pub(super) fn notes(&self) -> Vec<String> {
        let mut notes = vec![self.example.says.clone()];
        notes.extend(self.in_the_controller.iter().cloned());
        notes.extend(self.tried.map(str::to_owned));
        notes.extend(self.notes.iter().cloned());
        notes.push(format!(
            "no joint removes {:.4} mm (root mean square over the measured range)",
            self.stays.rms_mm
        ));
        notes.extend(self.stays.says.iter().cloned());
        notes
    }

    /// Binds the sidecar to the bytes of its table.
    pub(super) fn fingerprint(&mut self, table: &[u8]) {
        self.table_sha256 = sha256(table);
    }

    pub(super) fn to_json(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        write_document(&mut bytes, self).expect("writing to memory does not fail");
        bytes
    }
}

/// SHA-256 as 64 hexadecimal digits.
pub(super) fn sha256(bytes: &[u8]) -> String {
    let digits = |byte: &u8| [byte >> 4, byte & 15];
    let all = Sha256::digest(bytes);
    let digits = all.iter().flat_map(digits);
    digits
        .map(|d| char::from(b"0123456789abcdef"[usize::from(d)]))
        .collect()
}

impl Example {
    /// The entry with the largest correction, forward, in the measured range where there is one.
    fn new(job: &Job, sheet: &Sheet, rules: &Rules) -> Self {
        let size = |k: &usize| {
            let q = sheet.inner(sheet.places[*k]);
            let measured = q >= sheet.measured.from - 1e-9 && q <= sheet.measured.to + 1e-9;
            (measured, sheet.forward[*k].abs())
        };
        let rows = 0..sheet.forward.len();
        let largest = rows
            .max_by(|a, b| {
                size(a)
                    .partial_cmp(&size(b))
                    .unwrap_or(std::cmp::Ordering::Equal)
            })
            .unwrap_or(0);
        let commanded = sheet.places[largest];
        let correction = sheet.forward[largest] + 0.0;
        let reached = sheet.outer(reached(job, sheet, commanded, correction));
        let unit = sheet.kind.sign();
        let says = rules.says.sign() * correction * rules.per_outer + 0.0;
        let digits = 6;
        let number = if rules.per_outer == 1.0 {
            format!("{says:+.digits$}")
        } else {
            format!("{says:+.0} (in {})", rules.unit(sheet.kind))
        };
        let sent = commanded + correction;
        let then = match rules.says {
            Says::Correction => format!("send {sent:.digits$}{unit}"),
            Says::Deviation => format!("the controller sends {sent:.digits$}{unit}"),
        };
        Self {
            commanded,
            robot_reaches: reached,
            table_says: says,
            command_to_send: sent,
            says: format!(
                "commanded {commanded}{unit}, robot reached {reached:.digits$}{unit}, table says \
                 {number}: {then}"
            ),
        }
    }
}

/// Where an uncorrected joint really stands, forward: the value at which the nominal robot would
/// come closest.
fn reached(job: &Job, sheet: &Sheet, commanded: f64, correction: f64) -> f64 {
    let compensation = Compensation::new(job.calibration);
    let joints = job.calibration.model.robot.joints.len();
    let command = sheet.inner(commanded);
    if joints > 1 || compensation.regional.is_some() {
        // To first order, which is all that a regional correction knows.
        return command - sheet.inner(correction);
    }
    let homes = compensation.reflectors_at_home.clone();
    let inputs = sheet
        .conditions
        .inputs(vec![vec![command]], Side::Forward, homes);
    let real = places(&compensation.robot, &inputs);
    closest_commands(&compensation.nominal, &inputs, &real, &[0])[0][0]
}

/// Poses that fill the measured range, once for each reflector: evenly for one joint; for several, points of a lattice that
/// fills the box evenly (Korobov; the golden ratio's powers, Roberts 2018).
pub(crate) fn measured_poses(job: &Job) -> Inputs<'static> {
    poses(job, Side::Forward)
}

/// The same poses, every joint coming from this side.
pub(super) fn poses(job: &Job, side: Side) -> Inputs<'static> {
    let compensation = Compensation::new(job.calibration);
    let measured = &job.calibration.measured;
    let joints = measured.len();
    let share = |joint: usize, k: usize| {
        if joints == 1 {
            k as f64 / (POSES - 1) as f64
        } else {
            let stride = ratio(joints).powf(-(joint as f64 + 1.0));
            (0.5 + (k as f64 + 1.0) * stride).fract()
        }
    };
    let column = |(joint, range): (usize, &Range)| -> Vec<f64> {
        let at = |k: usize| range.from + (range.to - range.from) * share(joint, k);
        (0..POSES).map(at).collect()
    };
    let homes = compensation.reflectors_at_home;
    let columns = measured.iter().enumerate().map(column);
    let q = columns.map(|column| column.repeat(homes.len())).collect();
    let targets = (0..homes.len()).flat_map(|target| {
        let target = u32::try_from(target).expect("a session has few reflectors");
        std::iter::repeat_n(target, POSES)
    });
    let targets: Vec<u32> = targets.collect();
    let mut inputs = job.conditions.inputs(q, side, homes);
    inputs.target = Some(targets.into());
    inputs
}

/// The positive root of x^(d+1) = x + 1.
fn ratio(dimensions: usize) -> f64 {
    let mut x = 1.5_f64;
    for _ in 0..60 {
        x = (1.0 + x).powf(1.0 / (dimensions as f64 + 1.0));
    }
    x
}
