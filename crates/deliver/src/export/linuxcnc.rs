//! LinuxCNC, `COMP_FILE` with `COMP_FILE_TYPE = 1`.
//!
//! ```text
//! nominal forward reverse        one line for each entry, corrections c in machine units
//! motor = command + forward(command)   while the commanded velocity is above 0, reverse below
//! ```
//!
//! Linear in between, the end values held outside, at most 256 entries, strictly ascending. Nothing
//! else may stand in the file: reading ends at the first line that is not three numbers, silently.
//! It does not repeat after a turn, so the entries span the joint's whole travel. `BACKLASH` is
//! ignored while there is a file: the two columns carry it.
//!
//! Source: LinuxCNC 2.9, `src/emc/motion/{usrmotintf.cc, command.c, control.c}`; run against the
//! program itself by `tests/reference/linuxcnc_comp.py`.

use std::fmt::Write;

use super::rules::{DECIMALS, Directions, EntryMeaning, Rules, Spacing};
use super::sheet::Sheet;
use super::table_file::{Columns, TableFile, number};
use super::{ExportError, Format, Job};
use crate::kinematics::JointKind;
use crate::text::Text;

const RULES: Rules = Rules {
    format: "linuxcnc",
    meaning: EntryMeaning::Correction,
    resolution: DECIMALS,
    units: ["deg", "mm"],
    per_outer: 1.0,
    spacing: Spacing::Free,
    widest_step: 10.0,
    most_entries: 256,
    limit_because: phrase!("the size of its table"),
    directions: Directions::Both,
    repeats: false,
    interpolation: "linear between two lines",
    outside: "the first or the last line is held",
    direction: "the forward column while the commanded velocity is above 0, the reverse column while \
                it is below; at rest the one of the last move",
    full_turn: "the table does not repeat: it spans the joint's whole travel, and what is beyond \
                gets the end's value",
    label: None,
};

pub(super) const FORMAT: Format = TableFile::format(
    phrase!("LinuxCNC COMP_FILE"),
    "comp",
    &TableFile {
        rules: &RULES,
        write,
        read,
        enter,
    },
);

fn write(_: &Job, sheet: &Sheet, _: &[Text]) -> String {
    let mut text = String::new();
    let columns = sheet.forward.iter().zip(&sheet.reverse);
    for (place, (forward, reverse)) in sheet.places.iter().zip(columns) {
        let [place, forward, reverse] = [place, forward, reverse].map(|v| v + 0.0);
        writeln!(text, "{place:.9} {forward:.9} {reverse:.9}")
            .expect("writing to memory does not fail");
    }
    text
}

/// As LinuxCNC does: up to the first line that is not three numbers.
fn read(_: &Sheet, text: &str) -> Result<Columns, ExportError> {
    let mut columns = Columns::default();
    for line in text.lines() {
        let cells: Option<Vec<f64>> = line.split_whitespace().map(number).collect();
        let Some(&[place, forward, reverse]) = cells.as_deref() else {
            break;
        };
        columns.places.push(place);
        columns.forward.push(forward);
        columns.reverse.push(reverse);
    }
    if columns.places.is_empty() {
        return Err(ExportError::ReadBack(
            "its first line is no entry".to_owned(),
        ));
    }
    Ok(columns)
}

fn enter(job: &Job, sheet: &Sheet) -> Vec<Text> {
    let unit = match sheet.kind {
        JointKind::Revolute => "TYPE = ANGULAR and [TRAJ] ANGULAR_UNITS = degree",
        JointKind::Prismatic => "TYPE = LINEAR and [TRAJ] LINEAR_UNITS = mm",
    };
    vec![
        text!(
            "in the INI file: {lines}; the joint has {unit}",
            lines = format!(
                "[JOINT_{}] COMP_FILE = {}, COMP_FILE_TYPE = 1",
                sheet.joint, job.file_name
            ),
            unit
        ),
        text!("BACKLASH is ignored while COMP_FILE is set: the two columns carry it"),
    ]
}
