//! The neutral table: `commanded_deg,correction_forward_deg,correction_reverse_deg`, with line
//! feeds, decimal points and the fewest digits that read back as the same number; everything else
//! there is to know stands in `FILE.meta.json` beside it. A sliding joint has mm in place of
//! degrees.

use crate::text::Text;
use std::fmt::Write;

use super::rules::{Directions, EntryMeaning, Rules, Spacing};
use super::sheet::Sheet;
use super::table_file::{Columns, TableFile, number};
use super::{ExportError, Format, Job};

pub(super) const RULES: Rules = Rules {
    format: "csv",
    meaning: EntryMeaning::Correction,
    resolution: None,
    units: ["deg", "mm"],
    per_outer: 1.0,
    spacing: Spacing::Equal,
    widest_step: 1.0,
    most_entries: usize::MAX,
    limit_because: phrase!("it has no limit"),
    directions: Directions::Both,
    repeats: false,
    interpolation: "linear between two rows",
    outside: "the first or the last row is held",
    direction: "the forward column while the joint moves to larger values, the reverse column while \
                it moves to smaller ones; at rest the one of the last move",
    full_turn: "the table does not repeat: what is beyond its ends gets the end's value",
    label: None,
};

pub(super) const FORMAT: Format = TableFile::format(
    phrase!("CSV table with JSON metadata"),
    "csv",
    &TableFile {
        rules: &RULES,
        write,
        read,
        enter: |_, _| Vec::new(),
    },
);

fn write(_: &Job, sheet: &Sheet, _: &[Text]) -> String {
    let unit = sheet.unit();
    let mut text =
        format!("commanded_{unit},correction_forward_{unit},correction_reverse_{unit}\n");
    let columns = sheet.forward.iter().zip(&sheet.reverse);
    for (commanded, (forward, reverse)) in sheet.places.iter().zip(columns) {
        // Rust writes a number with the fewest digits that read back as the same one.
        writeln!(text, "{commanded},{forward},{reverse}").expect("writing to memory does not fail");
    }
    text
}

/// Reads the text back as its readers will.
fn read(_: &Sheet, text: &str) -> Result<Columns, ExportError> {
    let wrong = |line: usize| ExportError::ReadBack(format!("line {} is no row", line + 1));
    let mut columns: [Vec<f64>; 3] = Default::default();
    for (index, line) in text.lines().enumerate().skip(1) {
        let cells: Option<Vec<f64>> = line.split(',').map(number).collect();
        let cells = cells.filter(|c| c.len() == 3);
        let cells = cells.ok_or_else(|| wrong(index))?;
        for (column, cell) in columns.iter_mut().zip(cells) {
            column.push(cell);
        }
    }
    let [places, forward, reverse] = columns;
    Ok(Columns {
        places,
        forward,
        reverse,
        repeats: false,
    })
}
