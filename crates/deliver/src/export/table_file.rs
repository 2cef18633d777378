//! The way from a model to the file of a table format, the same for all of them:
//!
//! 1. the exact correction, closely spaced; formats for one direction refuse a backlash here;
//! 2. the entries ([`grid`](super::grid));
//! 3. written, and read back by the format's own reader, which has to give the same;
//! 4. what the controller will make of it ([`residual_error`](super::residual_error)), and the sidecar that says so.

use super::exporter::any_robot;
use super::residual_error::{Allowance, Exact, ResidualError};
use super::rules::Rules;
use super::sheet::Sheet;
use super::sidecar::Sidecar;
use super::{Document, Export, ExportError, Exporter, Format, Job, ReadBack, grid};
use crate::text::{InUnits, Template, Text, current};

/// A comment in a file: a person reads it, in the language of this thread and the units of documents.
pub(super) fn in_a_comment(text: &Text) -> String {
    let _units = InUnits::of_documents();
    text.spoken_with(current(), false)
        .replace(['\n', '\r'], " ")
}

/// What tells one table format from another.
pub(super) struct TableFile {
    pub(super) rules: &'static Rules,
    /// The file; the lines are what could stand in a comment.
    pub(super) write: fn(&Job, &Sheet, &[Text]) -> String,
    /// The numbers of the file.
    pub(super) read: fn(&Sheet, &str) -> Result<Columns, ExportError>,
    /// What has to be entered in the controller.
    pub(super) enter: fn(&Job, &Sheet) -> Vec<Text>,
}

/// Places are counted from the first one in some formats, which costs last bits; degrees or mm.
const PLACES: f64 = 1e-9;

/// The numbers of a file in degrees or mm, with the file's own sign.
#[derive(Default)]
pub(super) struct Columns {
    pub(super) places: Vec<f64>,
    pub(super) forward: Vec<f64>,
    pub(super) reverse: Vec<f64>,
    pub(super) repeats: bool,
}

impl Exporter for TableFile {
    fn export(&self, job: &Job) -> Result<Export, ExportError> {
        let rules = self.rules;
        let exact = Exact::new(job)?;
        let allowance = Allowance::of(job.calibration);
        let one_sided = grid::directions(rules, &exact, &allowance)?;
        let (mut sheet, allowance) = grid::choose(job, rules, &exact, allowance)?;
        sheet.notes.extend(one_sided);
        let reads_as = self.read_back(&sheet, &(self.write)(job, &sheet, &[]))?;
        let left = ResidualError::new(job, &exact, &reads_as, allowance);
        sheet
            .notes
            .push(left.describe(rules, &sheet, job.step.is_some()));
        let sidecar = Sidecar {
            job,
            sheet: &sheet,
            rules,
            left: &left,
            in_the_controller: (self.enter)(job, &sheet),
        };
        let stays = sidecar.stays_in_words();
        let notes = sidecar.notes(&stays);
        let text = (self.write)(job, &sheet, &notes);
        if self.read_back(&sheet, &text)? != reads_as {
            return Err(ExportError::ReadBack("comments change it".to_owned()));
        }
        let sidecar_document = sidecar.to_json(text.as_bytes());
        Ok(Export {
            documents: Document::with_sidecar(job.file_name, text.into_bytes(), sidecar_document),
            reads_as: Some(reads_as),
            robot: None,
            meaning: sidecar.meaning(),
            notes,
            stays,
            left: Some(left),
        })
    }
}

impl TableFile {
    /// The entry of the list of formats for a table, whose rules hold its name.
    pub(super) const fn format(
        title: Template,
        extension: &'static str,
        table: &'static Self,
    ) -> Format {
        Format {
            id: table.rules.format,
            title,
            extension,
            rules: Some(table.rules),
            suits: any_robot,
            exporter: table,
        }
    }

    /// What the controller makes of a file; it has to be what was meant.
    fn read_back(&self, sheet: &Sheet, text: &str) -> Result<ReadBack, ExportError> {
        let wrong = |what: &str| ExportError::ReadBack(what.to_owned());
        let columns = (self.read)(sheet, text)?;
        let sign = self.rules.meaning.sign();
        let corrections =
            |values: Vec<f64>| -> Vec<f64> { values.iter().map(|v| sign * v + 0.0).collect() };
        let (forward, reverse) = (corrections(columns.forward), corrections(columns.reverse));
        let last_digit = self.rules.resolution.unwrap_or(0.0);
        let near = |a: &[f64], b: &[f64], slack: f64| {
            let pairs = a.iter().zip(b);
            a.len() == b.len()
                && pairs
                    .into_iter()
                    .all(|(a, b)| (a - b).abs() <= slack + 1e-12 * b.abs())
        };
        // Positions that are counted in steps from the first one may differ in the last digit.
        if !near(&columns.places, &sheet.places, last_digit.max(PLACES)) {
            return Err(wrong("the positions"));
        }
        let same = |a: &[f64], b: &[f64]| near(a, b, 0.5 * last_digit);
        if !same(&forward, &sheet.forward) || !same(&reverse, &sheet.reverse) {
            return Err(wrong("the corrections"));
        }
        if columns.repeats != sheet.repeats {
            return Err(wrong("whether it repeats"));
        }
        let read = ReadBack::new(sheet.joint, sheet.kind, &columns.places, forward, reverse);
        let read = read.ok_or_else(|| wrong("the positions do not ascend"))?;
        Ok(read.repeating(columns.repeats))
    }
}

/// A finite number; anything else is none.
pub(super) fn number(text: &str) -> Option<f64> {
    let value: f64 = text.trim().parse().ok()?;
    value.is_finite().then_some(value)
}
