//! `truepose report`: the calibration report as HTML or PDF.

use std::path::PathBuf;

use clap::Args;
use serde_json::json;

use crate::diagnosis::{DiagnoseError, Options};
use crate::fonts;
use crate::language::spoken;
use crate::pipeline;
use crate::report::exported::sidecar_of;
use crate::report::{Details, ExportedTable, Extras, Kind, ReportError};

use super::failure::Failure;
use super::output;

/// Write the calibration report of a session or of a model
#[derive(Debug, Args)]
pub(crate) struct Report {
    /// Session, which is diagnosed, or model
    file: PathBuf,
    /// Write the report to this file, which ends in .html or .pdf
    #[arg(long, value_name = "REPORT")]
    out: PathBuf,
    /// Name a table that was exported, with its hash; may be given several times
    #[arg(long = "table", value_name = "FILE")]
    tables: Vec<PathBuf>,
    /// Customer, serial numbers, tolerance, decision rule and so on, a truepose-details/1 document;
    /// what it lacks is a line to fill in
    #[arg(long, value_name = "DETAILS.json")]
    details: Option<PathBuf>,
    /// Date to print, in place of the one of the details
    #[arg(long, value_name = "TEXT")]
    date: Option<String>,
    /// Replace the file if it exists
    #[arg(long)]
    force: bool,
    /// Print one JSON document that says what was written
    #[arg(long)]
    json: bool,
}

impl Report {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let kind = Kind::of(&self.out).map_err(|expected| {
            let option = format!("--out {}", self.out.display());
            Failure::WrongAt(option, expected.into())
        })?;
        let mut inputs = vec![self.file.clone()];
        inputs.extend(self.details.clone());
        for table in &self.tables {
            inputs.extend([table.clone(), sidecar_of(table)]);
        }
        // A long diagnosis is not begun for a file that cannot be written.
        output::can_be_written(&self.out, self.force)?;
        crate::atomic::refuse_to_replace_inputs(&self.out, &output::paths(&inputs))?;
        let mut details = match &self.details {
            Some(path) => Details::load(path)?,
            None => Details::default(),
        };
        if let Some(date) = self.date {
            details.date = date;
        }
        inputs.extend(details.logo.as_ref().map(|logo| logo.path.clone()));
        let tables = self.tables.iter().map(|path| ExportedTable::read(path));
        let tables = tables.collect::<Result<_, _>>();
        let extras = Extras {
            details,
            tables: tables.map_err(|error| Failure::refused(error.describe()))?,
        };
        let report = if pipeline::is_model(&self.file) {
            pipeline::report_of_model(&pipeline::load_model(&self.file)?, &extras)
        } else {
            let loaded = output::session(&self.file)?;
            inputs.extend(loaded.files);
            crate::atomic::refuse_to_replace_inputs(&self.out, &output::paths(&inputs))?;
            pipeline::report(&loaded.session, &Options::default(), &extras, &|_| true)?
        };
        let written =
            pipeline::write_report(&report, kind).map_err(|error| Failure::Failed(error.into()))?;
        if !written.unshown.is_empty() {
            output::messages(&[spoken(fonts::cannot_be_shown(&written.unshown))]);
        }
        output::document(&self.out, &written.bytes, self.force, &inputs)?;
        if self.json {
            return output::json(&json!({
                "format": "truepose-reported/1",
                "of": self.file,
                "file": self.out,
                "bytes": written.bytes.len(),
                "letters_without_a_font": written.unshown.iter().collect::<String>(),
            }));
        }
        Ok(())
    }
}

impl From<ReportError> for Failure {
    fn from(error: ReportError) -> Self {
        match error {
            ReportError::Diagnose(DiagnoseError::Cancelled) => Self::Failed(error.into()),
            ReportError::Diagnose(error) => error.into(),
            ReportError::Verify(error) => error.into(),
            other @ ReportError::NotHandedOut(_) => Self::refused(other.describe()),
        }
    }
}
