//! TwinCAT 3 NC: structured text with the table of `MC_TableBasedPositionCompensation`.
//!
//! ```text
//! aC : ARRAY[0..N] OF ST_PositionCompensationTableElement :=
//!     [(Position := 0.0, Compensation := -0.001), …];
//! ```
//!
//! Corrections c in axis units, LREAL, at equal steps, ascending. One table serves both directions:
//! `Direction` restricts a table to one of them, but the manual does not say what two tables for one
//! axis do, so a backlash is refused. `Modulo` repeats the table after a turn. What happens beyond
//! the ends is not said, so the table spans the joint's whole travel.
//!
//! Source: Beckhoff Information System, `Tc2_MC2`, `MC_TableBasedPositionCompensation` and
//! `ST_PositionCompensationTableParameter`.

use crate::text::Text;
use std::fmt::Write;

use super::rules::{DECIMALS, Directions, EntryMeaning, FROM_THE_MANUAL, Rules, Spacing, decimal};
use super::sheet::Sheet;
use super::table_file::{Columns, TableFile, in_a_comment, number};
use super::{ExportError, Format, Job};

const RULES: Rules = Rules {
    format: "twincat-nc",
    meaning: EntryMeaning::Correction,
    resolution: DECIMALS,
    units: ["deg", "mm"],
    per_outer: 1.0,
    spacing: Spacing::Equal,
    widest_step: 10.0,
    most_entries: usize::MAX,
    limit_because: phrase!("it is limited only by memory"),
    directions: Directions::One {
        instead: phrase!(
            "use the axis' own backlash compensation and export a model without \
                  backlash, or choose a format with two columns (LinuxCNC, TwinCAT CNC, CSV)"
        ),
    },
    repeats: true,
    interpolation: "linear between two elements",
    outside: "not said in the manual; the table spans the joint's whole travel",
    direction: "the same for both (WorkDirectionBoth)",
    full_turn: "with Modulo := TRUE the table repeats after the modulo period, with FALSE it does \
                not",
    label: Some(FROM_THE_MANUAL),
};

pub(super) const FORMAT: Format = TableFile::format(
    phrase!("TwinCAT NC structured text"),
    "st",
    &TableFile {
        rules: &RULES,
        write,
        read,
        enter,
    },
);

fn write(_: &Job, sheet: &Sheet, notes: &[Text]) -> String {
    let heading = text!(
        "Correction of joint {joint} in {unit}",
        joint = sheet.joint + 1,
        unit = sheet.unit()
    );
    let mut text = String::new();
    for note in [&heading].into_iter().chain(notes) {
        let _ = writeln!(text, "// {}", in_a_comment(note));
    }
    let [from, to] = sheet.ends().map(decimal);
    let count = sheet.places.len();
    let columns = sheet.places.iter().zip(&sheet.forward);
    let elements = columns.map(|(place, correction)| {
        let (place, correction) = (decimal(*place), decimal(*correction));
        format!("        (Position := {place}, Compensation := {correction})")
    });
    let elements: Vec<String> = elements.collect();
    let _ = writeln!(
        text,
        "VAR_GLOBAL\n    aC : ARRAY[0..{last}] OF ST_PositionCompensationTableElement := [\n{elements}\n    ];\n    \
         stC : ST_PositionCompensationTableParameter := (MinPosition := {from}, MaxPosition := {to}, \
         NoOfTableElements := {count}, Modulo := {modulo});\nEND_VAR",
        last = count - 1,
        elements = elements.join(",\n"),
        modulo = if sheet.repeats { "TRUE" } else { "FALSE" },
    );
    text
}

fn read(_: &Sheet, text: &str) -> Result<Columns, ExportError> {
    let wrong = |what: &str| ExportError::ReadBack(what.to_owned());
    let code: Vec<&str> = text
        .lines()
        .filter(|line| !line.starts_with("//"))
        .collect();
    let code = code.join(" ");
    let table = code
        .split_once(":= [")
        .and_then(|(_, rest)| rest.split_once("];"));
    let (table, rest) = table.ok_or_else(|| wrong("there is no table"))?;
    let (mut places, mut corrections) = (Vec::new(), Vec::new());
    for element in table.split('(').skip(1) {
        let inside = element.split_once(')').map(|(inside, _)| inside);
        let pair = inside.and_then(|inside| {
            let (place, correction) = inside.split_once(',')?;
            let place = place.trim().strip_prefix("Position :=")?;
            let correction = correction.trim().strip_prefix("Compensation :=")?;
            Some((number(place)?, number(correction)?))
        });
        let (place, correction) = pair.ok_or_else(|| wrong("an element"))?;
        places.push(place);
        corrections.push(correction);
    }
    Ok(Columns {
        places,
        forward: corrections.clone(),
        reverse: corrections,
        repeats: rest.contains("Modulo := TRUE"),
    })
}

fn enter(_: &Job, sheet: &Sheet) -> Vec<Text> {
    let (call, unit) = (
        "MC_TableBasedPositionCompensation with pTable := ADR(aC), TableSize := SIZEOF(aC), TableParameter := stC",
        sheet.unit(),
    );
    vec![if sheet.repeats {
        text!(
            "in the PLC: {call}; the axis counts in {unit}; the axis is a modulo axis of 360, else Modulo is FALSE",
            call,
            unit
        )
    } else {
        text!("in the PLC: {call}; the axis counts in {unit}", call, unit)
    }]
}
