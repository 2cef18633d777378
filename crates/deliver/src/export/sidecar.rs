//! What a table cannot say of itself: `FILE.meta.json`, `truepose-table/1`.

use sha2::{Digest, Sha256};

use super::Job;
use super::poses::measured_poses;
use super::residual_error::ResidualError;
use super::rules::{EntryMeaning, Rules};
use super::sheet::Sheet;
use crate::compensation::conditions::Side;
use crate::compensation::inverse::{closest_commands, places};
use crate::compensation::{Compensation, Remainder};
use crate::document::number::hexadecimal;
use crate::document::{Value, object, text_of};
use crate::model::format_v1::model_hash;
use crate::text::Text;
use crate::text::length;

pub(super) struct Sidecar<'a> {
    pub(super) job: &'a Job<'a>,
    pub(super) sheet: &'a Sheet,
    pub(super) rules: &'a Rules,
    pub(super) left: &'a ResidualError,
    /// What to enter besides the table.
    pub(super) in_the_controller: Vec<Text>,
}

/// What the metadata of every format begins with: the file, its hash, and what it was made of.
pub(super) fn head(job: &Job, format: &str, file: &[u8]) -> Value {
    let calibration = job.calibration;
    object! {
        "format": "truepose-table/1",
        "table": job.file_name,
        "table_format": format,
        "table_sha256": hexadecimal(&Sha256::digest(file)),
        "program_version": env!("CARGO_PKG_VERSION"),
        "session": &calibration.session,
        "samples_hash": &calibration.samples_hash,
        "model_hash": model_hash(calibration),
    }
}

pub(super) fn texts(texts: &[Text]) -> Value {
    texts.iter().collect()
}

impl Sidecar<'_> {
    fn stays(&self) -> Remainder {
        Remainder::new(self.job.calibration, &measured_poses(self.job))
    }

    /// The document beside a table of these bytes.
    pub(super) fn to_json(&self, table: &[u8]) -> Vec<u8> {
        let Self {
            job,
            sheet,
            rules,
            left,
            ..
        } = self;
        let remainder = self.stays();
        let [from, to] = sheet.ends();
        let measured = [sheet.measured.from, sheet.measured.to].map(|end| sheet.to_display(end));
        let example = WorkedExample::new(job, sheet, rules);
        let document = head(job, rules.format, table).with(object! {
            "joint": sheet.joint + 1,
            "joint_name": &sheet.name,
            "unit": sheet.unit(),
            "unit_of_the_numbers": rules.unit(sheet.kind),
            "sign": rules.meaning.sentence(),
            // How much of what was identified it carries.
            "level": "effects-of-a-joint",
            "level_in_words": "everything that this joint can correct, its zero offset included",
            "example": object! {
                "commanded": example.commanded,
                "robot_reaches": example.robot_reaches,
                "table_says": example.table_says,
                "command_to_send": example.command_to_send,
                "says": &example.says,
            },
            "in_the_controller": texts(&self.in_the_controller),
            "tried": rules.label,
            "grid": object! {
                "from": from,
                "to": to,
                // Null where the entries stand where they are needed.
                "step": sheet.step,
                "rows": sheet.places.len(),
                "most_rows": (rules.most_entries < usize::MAX).then_some(rules.most_entries),
            },
            "interpolation": rules.interpolation,
            "outside_the_table": rules.outside,
            "direction": rules.direction,
            "full_turn": rules.full_turn,
            "repeats_after_a_turn": sheet.repeats,
            "measured_range": measured,
            "outside_the_measured_range": "the correction at the end of the measured range is held",
            "conditions": object! {
                "speed_per_s": sheet.to_display(sheet.conditions.speed),
                "load_kg": sheet.conditions.load_kg,
                "temperature_c": sheet.conditions.temperature_c,
            },
            // What the controller leaves with this table: by samples that no fit has seen, and beside the model alone.
            "leaves": object! {
                "leaves_mm": left.leaves.map(|leaves| leaves.leaves_mm),
                "between_targets_mm": left.leaves.map(|leaves| leaves.between_targets_mm),
                "gap_mm": left.gap_mm.map(|gap| gap[0]),
                "gap_of_an_exact_correction_mm": left.gap_mm.map(|gap| gap[1]),
                "added_rms_mm": left.added_rms_mm,
                "added_max_mm": left.added_max_mm,
                "allowed_mm": left.allowance.mm,
                "allowed_is": left.allowance.is.to_string(),
                "within": left.met(),
            },
            // What no joint removes, over the measured range.
            "stays": object! {
                "rms_mm": remainder.rms_mm,
                "max_mm": remainder.max_mm,
                "says": texts(&remainder.describe()),
            },
            "notes": texts(&sheet.notes),
        });
        text_of(&document).into_bytes()
    }

    /// What the numbers mean: their sign, the example, what to enter, how sure it is, the table's notes.
    pub(super) fn meaning(&self) -> Vec<Text> {
        let example = WorkedExample::new(self.job, self.sheet, self.rules).says;
        let mut meaning = vec![self.rules.meaning.sentence().into(), example];
        meaning.extend(self.in_the_controller.iter().cloned());
        meaning.extend(self.rules.label.map(Text::from));
        meaning.extend(self.sheet.notes.iter().cloned());
        meaning
    }

    /// What a user should hear besides the file: the example, what to enter, the table's notes,
    /// what stays.
    pub(super) fn notes(&self, stays: &[Text]) -> Vec<Text> {
        let meaning = self.meaning().into_iter().skip(1);
        meaning.chain(stays.iter().cloned()).collect()
    }

    /// What no joint removes over the measured range.
    pub(super) fn stays_in_words(&self) -> Vec<Text> {
        let remainder = self.stays();
        let mut says = vec![text!(
            "no joint removes {size} (root mean square over the measured range)",
            size = length(remainder.rms_mm, 4)
        )];
        says.extend(remainder.describe());
        says
    }
}

struct WorkedExample {
    commanded: f64,
    robot_reaches: f64,
    table_says: f64,
    command_to_send: f64,
    says: Text,
}

impl WorkedExample {
    /// The entry with the largest correction, forward, in the measured range where there is one.
    fn new(job: &Job, sheet: &Sheet, rules: &Rules) -> Self {
        let size = |k: &usize| {
            let q = sheet.to_base_units(sheet.places[*k]);
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
        let reached = sheet.to_display(reached(job, sheet, commanded, correction));
        let unit = sheet.kind.sign();
        let says = rules.meaning.sign() * correction * rules.per_outer + 0.0;
        let digits = 6;
        let number = if rules.per_outer == 1.0 {
            Text::verbatim(format!("{says:+.digits$}"))
        } else {
            text!(
                "{number} (in {unit})",
                number = format!("{says:+.0}"),
                unit = rules.unit(sheet.kind)
            )
        };
        let sent = commanded + correction;
        let send = format!("{sent:.digits$}{unit}");
        // The data's range may end at any digit.
        let at = format!("{}{unit}", (commanded * 1e6).round() / 1e6);
        let reached_there = format!("{reached:.digits$}{unit}");
        let in_words = match rules.meaning {
            EntryMeaning::Correction => text!(
                "commanded {commanded}, robot reached {reached}, table says {number}: send {sent}",
                commanded = at,
                reached = reached_there,
                number,
                sent = send
            ),
            EntryMeaning::Deviation => text!(
                "commanded {commanded}, robot reached {reached}, table says {number}: the controller sends {sent}",
                commanded = at,
                reached = reached_there,
                number,
                sent = send
            ),
        };
        Self {
            commanded,
            robot_reaches: reached,
            table_says: says,
            command_to_send: sent,
            says: in_words,
        }
    }
}

/// Where an uncorrected joint really stands, forward: the value at which the nominal robot would
/// come closest.
fn reached(job: &Job, sheet: &Sheet, commanded: f64, correction: f64) -> f64 {
    let compensation = Compensation::new(job.calibration);
    let joints = job.calibration.model.robot.joints.len();
    let command = sheet.to_base_units(commanded);
    if joints > 1 || compensation.regional.is_some() {
        // To first order, which is all that a regional correction knows.
        return command - sheet.to_base_units(correction);
    }
    let homes = compensation.reflectors_at_home.clone();
    let inputs = sheet
        .conditions
        .inputs(vec![vec![command]], Side::Forward, homes);
    let real = places(&compensation.robot, &inputs);
    closest_commands(&compensation.nominal, &inputs, &real, &[0])[0][0]
}
