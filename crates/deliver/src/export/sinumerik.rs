//! SINUMERIK: an archive file with the leadscrew and encoder error compensation `$AA_ENC_COMP`.
//!
//! ```text
//! $AA_ENC_COMP[enc,N,axis] = e = −c    a positive value moves the axis to smaller values
//! place of N = MIN + N · STEP
//! ```
//!
//! Linear in between, the end values held outside or, with `IS_MODULO`, repeated after a turn. One
//! value for both directions: a backlash belongs into MD32450, and a noticeable one is refused here.
//! (Tables for each direction, CEC, would be possible; their sign is not confirmed.)
//!
//! Source: SINUMERIK 840D sl / 828D, Function Manual Extended Functions, K3 "Compensations".

use crate::text::Text;
use std::fmt::Write;

use super::rules::{DECIMALS, Directions, EntryMeaning, FROM_THE_MANUAL, Rules, Spacing, decimal};
use super::sheet::Sheet;
use super::table_file::{Columns, TableFile, number};
use super::{ExportError, Format, Job};

const RULES: Rules = Rules {
    format: "sinumerik",
    meaning: EntryMeaning::Deviation,
    resolution: DECIMALS,
    units: ["deg", "mm"],
    per_outer: 1.0,
    spacing: Spacing::Equal,
    widest_step: 10.0,
    most_entries: 5000,
    limit_because: phrase!("MD38000 MM_ENC_COMP_MAX_POINTS"),
    directions: Directions::One {
        instead: phrase!(
            "use the axis' own backlash compensation and export a model without backlash, or choose a format with two columns (LinuxCNC, TwinCAT CNC, CSV)"
        ),
    },
    repeats: true,
    interpolation: "linear between two points",
    outside: "the value at MIN or at MAX is held",
    direction: "the same for both",
    full_turn: "with IS_MODULO = 1 the table repeats after a turn, with 0 its ends are held",
    label: Some(FROM_THE_MANUAL),
};

pub(super) const FORMAT: Format = TableFile::format(
    phrase!("SINUMERIK ENC_COMP archive"),
    "arc",
    &TableFile {
        rules: &RULES,
        write,
        read,
        enter,
    },
);

/// Measuring system, counted from 0.
const ENCODER: usize = 0;

/// A machine axis' name: letters and digits, a letter first.
fn axis(sheet: &Sheet) -> String {
    let kept = sheet.name.chars().filter(char::is_ascii_alphanumeric);
    let name: String = kept.map(|c| c.to_ascii_uppercase()).collect();
    if name.starts_with(|c: char| c.is_ascii_alphabetic()) {
        name
    } else {
        format!("AX{}", sheet.joint + 1)
    }
}

fn write(_: &Job, sheet: &Sheet, _: &[Text]) -> String {
    let (axis, sign) = (axis(sheet), RULES.meaning.sign());
    let [from, to] = sheet.ends();
    let last = sheet.places.len() - 1;
    let step = sheet.step.unwrap_or((to - from) / last as f64);
    let mut text = String::from("%_N_AX_EEC_INI\nCHANDATA(1)\n");
    let mut assign = |name: &str, at: &str, value: &str| {
        writeln!(text, "$AA_ENC_COMP{name}[{at},{axis}]={value}")
            .expect("writing to memory does not fail");
    };
    for (n, correction) in sheet.forward.iter().enumerate() {
        assign("", &format!("{ENCODER},{n}"), &decimal(sign * correction));
    }
    let encoder = ENCODER.to_string();
    assign("_STEP", &encoder, &decimal(step));
    assign("_MIN", &encoder, &decimal(from));
    assign("_MAX", &encoder, &decimal(to));
    assign(
        "_IS_MODULO",
        &encoder,
        if sheet.repeats { "1" } else { "0" },
    );
    text.push_str("M17\n");
    text
}

fn read(_: &Sheet, text: &str) -> Result<Columns, ExportError> {
    let wrong = |line: &str| ExportError::ReadBack(format!("the line '{line}'"));
    let (mut values, mut step, mut from, mut repeats) = (Vec::new(), None, None, false);
    for line in text.lines() {
        let Some((left, value)) = line.split_once('=') else {
            continue;
        };
        let (name, indices) = left.split_once('[').ok_or_else(|| wrong(line))?;
        let value = number(value).ok_or_else(|| wrong(line))?;
        match name {
            "$AA_ENC_COMP" => {
                let n = indices.split(',').nth(1).and_then(|n| n.parse().ok());
                if n != Some(values.len()) {
                    return Err(wrong(line));
                }
                values.push(value);
            }
            "$AA_ENC_COMP_STEP" => step = Some(value),
            "$AA_ENC_COMP_MIN" => from = Some(value),
            "$AA_ENC_COMP_IS_MODULO" => repeats = value == 1.0,
            _ => {}
        }
    }
    let grid = from
        .zip(step)
        .ok_or_else(|| wrong("$AA_ENC_COMP_MIN, _STEP"))?;
    Ok(Columns {
        places: (0..values.len())
            .map(|n| grid.0 + n as f64 * grid.1)
            .collect(),
        forward: values.clone(),
        reverse: values,
        repeats,
    })
}

/// Points of the smallest control of the family.
const SMALL_CONTROL: usize = 200;

fn enter(_: &Job, sheet: &Sheet) -> Vec<Text> {
    let mut says = vec![text!(
        "in the machine data: MD38000 MM_ENC_COMP_MAX_POINTS at least {points}, and after loading {enable}; the axis has to be called {axis}",
        points = sheet.places.len(),
        enable = format!("MD32700 ENC_COMP_ENABLE[{ENCODER}] = 1"),
        axis = axis(sheet)
    )];
    let read = super::ReadBack::of_sheet(sheet);
    let at_zero = read.map_or(0.0, |read| read.correction_outer(0.0, 0.0));
    says.push(text!(
        "switched on after referencing, the axis moves at once by the correction at the reference point, {correction} at 0",
        correction = format!("{at_zero:+.6} {}", sheet.unit())
    ));
    if sheet.places.len() > SMALL_CONTROL {
        says.push(text!(
            "the 808D holds {points} points; for it give a wider step",
            points = SMALL_CONTROL
        ));
    }
    if sheet.repeats {
        says.push(text!(
            "{key} 1 is for a modulo axis; for one that ends, set it to 0",
            key = "IS_MODULO ="
        ));
    }
    says
}
