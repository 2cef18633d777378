//! What a table cannot say of itself: `FILE.meta.json`, `truepose-table/1`.

use serde::Serialize;

use super::Job;
use crate::compensation::conditions::Side;
use crate::compensation::inverse::{closest_commands, places};
use crate::compensation::{Compensation, JointTable, Remainder};
use crate::effects::Inputs;
use crate::kinematics::{JointKind, Range};
use crate::model::format_v1::model_hash;
use crate::sessions::format_v1::layout::write_document;

/// How a reader has to use the table.
pub(super) struct Rules {
    pub(super) format: &'static str,
    pub(super) interpolation: &'static str,
    pub(super) outside: &'static str,
    pub(super) direction: &'static str,
}

/// See the module.
#[derive(Debug, Serialize)]
pub(super) struct Sidecar {
    format: &'static str,
    table: String,
    table_format: &'static str,
    program_version: &'static str,
    session: String,
    samples_hash: String,
    model_hash: String,
    joint: usize,
    joint_name: String,
    unit: &'static str,
    sign: String,
    example: Example,
    grid: Grid,
    interpolation: &'static str,
    outside_the_table: &'static str,
    direction: &'static str,
    measured_range: [f64; 2],
    outside_the_measured_range: &'static str,
    conditions: ConditionsTwin,
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
    step: f64,
    rows: usize,
}

#[derive(Debug, Serialize)]
struct ConditionsTwin {
    speed_per_s: f64,
    load_kg: f64,
    temperature_c: f64,
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
    pub(super) fn new(job: &Job, table: &JointTable, rules: &Rules) -> Self {
        let calibration = job.calibration;
        let unit = table.unit();
        let remainder = Remainder::new(calibration, &measured_poses(job));
        let ends = table
            .commanded_outer
            .first()
            .zip(table.commanded_outer.last());
        let (from, to) = ends.map_or((0.0, 0.0), |(a, b)| (*a, *b));
        Self {
            format: "truepose-table/1",
            table: job.file_name.to_owned(),
            table_format: rules.format,
            program_version: env!("CARGO_PKG_VERSION"),
            session: calibration.session.clone(),
            samples_hash: calibration.samples_hash.clone(),
            model_hash: model_hash(calibration),
            joint: table.joint + 1,
            joint_name: table.name.clone(),
            unit,
            sign:
                "the numbers are corrections: add them to the command, so that the robot ends up \
                   where it was commanded (the deviation measured − commanded has the other sign)"
                    .to_owned(),
            example: Example::new(job, table),
            grid: Grid {
                from,
                to,
                step: table.step_outer,
                rows: table.commanded_outer.len(),
            },
            interpolation: rules.interpolation,
            outside_the_table: rules.outside,
            direction: rules.direction,
            measured_range: [
                table.outer(table.measured.from),
                table.outer(table.measured.to),
            ],
            outside_the_measured_range: "the correction at the end of the measured range is held",
            conditions: ConditionsTwin {
                speed_per_s: table.outer(table.conditions.speed),
                load_kg: table.conditions.load_kg,
                temperature_c: table.conditions.temperature_c,
            },
            stays: Stays {
                rms_mm: remainder.rms_mm,
                max_mm: remainder.max_mm,
                says: remainder.says(),
            },
            notes: table.notes.clone(),
        }
    }

    /// What a user should hear besides the file: the example, the table's notes, what stays.
    pub(super) fn notes(&self) -> Vec<String> {
        let mut notes = vec![self.example.says.clone()];
        notes.extend(self.notes.iter().cloned());
        notes.push(format!(
            "no joint removes {:.4} mm (root mean square over the measured range)",
            self.stays.rms_mm
        ));
        notes.extend(self.stays.says.iter().cloned());
        notes
    }

    pub(super) fn to_json(&self) -> Vec<u8> {
        let mut bytes = Vec::new();
        write_document(&mut bytes, self).expect("writing to memory does not fail");
        bytes
    }
}

impl Example {
    /// The entry with the largest correction, forward, in the measured range where there is one.
    fn new(job: &Job, table: &JointTable) -> Self {
        let inner = |outer: f64| match table.kind {
            JointKind::Revolute => crate::units::rad_from_deg(outer),
            JointKind::Prismatic => outer,
        };
        let size = |k: &usize| {
            let q = inner(table.commanded_outer[*k]);
            let measured = q >= table.measured.from - 1e-9 && q <= table.measured.to + 1e-9;
            (measured, table.forward[*k].abs())
        };
        let rows = 0..table.forward.len();
        let largest = rows
            .max_by(|a, b| {
                size(a)
                    .partial_cmp(&size(b))
                    .unwrap_or(std::cmp::Ordering::Equal)
            })
            .unwrap_or(0);
        let commanded = table.commanded_outer[largest];
        let correction = table.outer(table.forward[largest]) + 0.0;
        let reached = table.outer(reached(job, table, inner(commanded)));
        let unit = if table.kind == JointKind::Revolute {
            "°"
        } else {
            " mm"
        };
        let digits = 6;
        Self {
            commanded,
            robot_reaches: reached,
            table_says: correction,
            command_to_send: commanded + correction,
            says: format!(
                "commanded {commanded}{unit}, robot reached {reached:.digits$}{unit}, table says \
                 {correction:+.digits$}: send {:.digits$}{unit}",
                commanded + correction
            ),
        }
    }
}

/// Where an uncorrected joint really stands, forward: the value at which the nominal robot would
/// come closest.
fn reached(job: &Job, table: &JointTable, command: f64) -> f64 {
    let compensation = Compensation::new(job.calibration);
    let joints = job.calibration.model.robot.joints.len();
    if joints > 1 || compensation.regional.is_some() {
        // To first order, which is all that a regional correction knows.
        return command - table.lookup(Side::Forward).at(command);
    }
    let homes = compensation.reflectors_at_home.clone();
    let inputs = table
        .conditions
        .inputs(vec![vec![command]], Side::Forward, homes);
    let real = places(&compensation.robot, &inputs);
    closest_commands(&compensation.nominal, &inputs, &real, &[0])[0][0]
}

/// Poses that fill the measured range: evenly for one joint; for several, points of a lattice that
/// fills the box evenly (Korobov; the golden ratio's powers, Roberts 2018).
pub(crate) fn measured_poses(job: &Job) -> Inputs<'static> {
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
    let q = measured.iter().enumerate().map(column).collect();
    let homes = compensation.reflectors_at_home;
    job.conditions.inputs(q, Side::Forward, homes)
}

/// The positive root of x^(d+1) = x + 1.
fn ratio(dimensions: usize) -> f64 {
    let mut x = 1.5_f64;
    for _ in 0..60 {
        x = (1.0 + x).powf(1.0 / (dimensions as f64 + 1.0));
    }
    x
}
