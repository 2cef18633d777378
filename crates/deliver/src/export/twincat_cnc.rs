//! TwinCAT CNC and other controllers with the ISG kernel: a list of compensation values
//! `achskw*.lis`, leadscrew error compensation `kw.ssfk`.
//!
//! ```text
//! pos, neg = actual − setpoint = e = −c        whole numbers of 0.0001° or 0.1 µm
//! ```
//!
//! One value for each direction (`bilateral 1`), positions given one by one (`interval 0`), linear
//! in between, 1500 entries unless the controller was started with more (P-COMP-00059). With `modulo
//! 1` the table repeats after a turn, and its first and last positions are the same one. What happens
//! beyond the ends is not said, so the table spans the joint's whole travel.
//!
//! Source: Beckhoff Information System, TF5200 "Axis compensation", P-COMP-00018 to 00025 and the
//! example of a bilateral list, where 19856.5 µm measured at 19866.7 µm programmed is entered as −102.

use crate::text::Text;
use std::fmt::Write;

use super::rules::{Directions, EntryMeaning, FROM_THE_MANUAL, Rules, Spacing};
use super::sheet::Sheet;
use super::table_file::{Columns, TableFile};
use super::{ExportError, Format, Job};

const RULES: Rules = Rules {
    format: "twincat-cnc",
    meaning: EntryMeaning::Deviation,
    resolution: Some(1.0 / PER_OUTER),
    units: ["0.0001°", "0.1 µm"],
    per_outer: PER_OUTER,
    spacing: Spacing::Free,
    widest_step: 10.0,
    most_entries: 1500,
    limit_because: phrase!("P-COMP-00059 where it was not raised"),
    directions: Directions::Both,
    repeats: true,
    interpolation: "linear between two entries",
    outside: "not said in the manual; the table spans the joint's whole travel",
    direction: "pos while the joint moves to larger values, neg while it moves to smaller ones",
    full_turn: "with modulo 1 the table repeats after a turn, with 0 it does not",
    label: Some(FROM_THE_MANUAL),
};

/// Whole numbers in a degree or a mm.
const PER_OUTER: f64 = 1e4;

pub(super) const FORMAT: Format = TableFile::format(
    phrase!("TwinCAT CNC (ISG) list"),
    "lis",
    &TableFile {
        rules: &RULES,
        write,
        read,
        enter,
    },
);

/// A value in the file's whole numbers.
fn whole(value: f64) -> String {
    format!("{:.0}", (value * PER_OUTER).round() + 0.0)
}

/// A name of letters, digits and underscores.
fn axis_name(sheet: &Sheet) -> String {
    let name = sheet.word().map(|name| name.to_ascii_uppercase());
    name.unwrap_or_else(|| format!("AXIS_{}", sheet.joint + 1))
}

fn write(_: &Job, sheet: &Sheet, _: &[Text]) -> String {
    let mut text = String::new();
    let mut entry = |key: &str, value: &str| {
        writeln!(text, "{key:<32} {value}").expect("writing to memory does not fail");
    };
    entry("kopf.achs_nr", &(sheet.joint + 1).to_string());
    entry("kopf.log_achs_name", &axis_name(sheet));
    entry("kw.ssfk.unit", "1");
    entry("kw.ssfk.interval", "0");
    entry("kw.ssfk.kw_nr_max", &sheet.places.len().to_string());
    entry("kw.ssfk.bilateral", "1");
    entry("kw.ssfk.modulo", if sheet.repeats { "1" } else { "0" });
    let sign = RULES.meaning.sign();
    for (key, column, sign) in [
        ("setpoint", &sheet.places, 1.0),
        ("pos", &sheet.forward, sign),
        ("neg", &sheet.reverse, sign),
    ] {
        for (k, value) in column.iter().enumerate() {
            entry(&format!("kw.ssfk.table[{k}].{key}"), &whole(sign * value));
        }
    }
    text
}

fn read(_: &Sheet, text: &str) -> Result<Columns, ExportError> {
    let wrong = |line: &str| ExportError::ReadBack(format!("the line '{line}'"));
    let mut columns = Columns::default();
    for line in text.lines() {
        let (key, value) = line.split_once(' ').ok_or_else(|| wrong(line))?;
        let value = value.trim();
        if key == "kw.ssfk.modulo" {
            columns.repeats = value == "1";
        }
        let Some((index, which)) = key
            .strip_prefix("kw.ssfk.table[")
            .and_then(|rest| rest.split_once("]."))
        else {
            continue;
        };
        let column = match which {
            "setpoint" => &mut columns.places,
            "pos" => &mut columns.forward,
            "neg" => &mut columns.reverse,
            _ => return Err(wrong(line)),
        };
        // 32 bits is what the kernel holds.
        let value: i32 = value.parse().map_err(|_| wrong(line))?;
        if index.parse() != Ok(column.len()) {
            return Err(wrong(line));
        }
        column.push(f64::from(value) / PER_OUTER);
    }
    Ok(columns)
}

/// More than older builds hold.
const SIXTEEN_BITS: f64 = 32767.0;

fn enter(_: &Job, sheet: &Sheet) -> Vec<Text> {
    let mut says = vec![text!(
        "in the axis list: {number} and the name {name} have to be those of the axis; no other backlash compensation beside it",
        number = format!("lr_param.ssfk 1; kopf.achs_nr {}", sheet.joint + 1),
        name = axis_name(sheet)
    )];
    if sheet.repeats {
        says.push(text!(
            "{key} 1 is for a modulo axis; for one that ends, set it to 0",
            key = "modulo"
        ));
    }
    let all = sheet.forward.iter().chain(&sheet.reverse);
    let largest = all.fold(0.0_f64, |a, c| a.max(c.abs())) * PER_OUTER;
    if largest > SIXTEEN_BITS {
        says.push(text!(
            "the largest value, {largest}, needs a build with values of 32 bits; older ones hold 16",
            largest = format!("{largest:.0}")
        ));
    }
    says
}
