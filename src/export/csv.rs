//! The neutral table: `commanded_deg,correction_forward_deg,correction_reverse_deg`, with line
//! feeds, decimal points and the fewest digits that read back as the same number; everything else
//! there is to know stands in `FILE.meta.json` beside it. A sliding joint has mm in place of
//! degrees.

use std::fmt::Write;

use super::sidecar::{Rules, Sidecar};
use super::{Document, Export, ExportError, Exporter, Format, Job, ReadBack};
use crate::compensation::JointTable;

/// See the module.
pub(super) struct Csv;

pub(super) const FORMAT: Format = Format {
    id: "csv",
    title: "CSV table with JSON metadata",
    extension: "csv",
    exporter: &Csv,
};

impl Exporter for Csv {
    fn export(&self, job: &Job) -> Result<Export, ExportError> {
        let table = job.table()?;
        let text = write(&table);
        let reads_as = read(&table, &text)?;
        let rules = Rules {
            format: "csv",
            interpolation: "linear between two rows",
            outside: "the first or the last row is held",
            direction: "the forward column while the joint moves to larger values, the reverse \
                        column while it moves to smaller ones; at rest the one of the last move",
        };
        let sidecar = Sidecar::new(job, &table, &rules);
        let notes = sidecar.notes();
        Ok(Export {
            documents: vec![
                Document {
                    name: job.file_name.to_owned(),
                    bytes: text.into_bytes(),
                },
                Document {
                    name: format!("{}.meta.json", job.file_name),
                    bytes: sidecar.to_json(),
                },
            ],
            reads_as: Some(reads_as),
            notes,
        })
    }
}

fn write(table: &JointTable) -> String {
    let unit = table.unit();
    let mut text =
        format!("commanded_{unit},correction_forward_{unit},correction_reverse_{unit}\n");
    let columns = table.forward.iter().zip(&table.reverse);
    for (commanded, (forward, reverse)) in table.commanded_outer.iter().zip(columns) {
        let (forward, reverse) = (table.outer(*forward) + 0.0, table.outer(*reverse) + 0.0);
        // Rust writes a number with the fewest digits that read back as the same one.
        writeln!(text, "{commanded},{forward},{reverse}").expect("writing to memory does not fail");
    }
    text
}

/// Reads the text back as its readers will.
fn read(table: &JointTable, text: &str) -> Result<ReadBack, ExportError> {
    let wrong = |line: usize| ExportError::ReadBack(format!("line {} is no row", line + 1));
    let mut columns: [Vec<f64>; 3] = Default::default();
    for (index, line) in text.lines().enumerate().skip(1) {
        let cells: Option<Vec<f64>> = line.split(',').map(|cell| cell.parse().ok()).collect();
        let cells = cells.filter(|c| c.len() == 3 && c.iter().all(|v| v.is_finite()));
        let cells = cells.ok_or_else(|| wrong(index))?;
        for (column, cell) in columns.iter_mut().zip(cells) {
            column.push(cell);
        }
    }
    let [commanded, forward, reverse] = columns;
    ReadBack::new(table.joint, table.kind, &commanded, forward, reverse)
        .ok_or_else(|| ExportError::ReadBack("the rows do not ascend".to_owned()))
}
