//! `truepose report`: the calibration report as HTML or PDF.

use std::path::{Path, PathBuf};

use clap::Args;

use truepose::diagnosis::{DiagnoseError, Options};
use truepose::fonts::{self, Library};
use truepose::model::format_v1::{is_model, load_model};
use truepose::report::exported::sidecar_of;
use truepose::report::{self, ExportedTable, Extras, ReportError};

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
    /// Date to print; without it there is a line to fill in
    #[arg(long, value_name = "TEXT")]
    date: Option<String>,
    /// Replace the file if it exists
    #[arg(long)]
    force: bool,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Html,
    Pdf,
}

impl Report {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let kind = kind_of(&self.out)?;
        let mut inputs = vec![self.file.clone()];
        for table in &self.tables {
            inputs.extend([table.clone(), sidecar_of(table)]);
        }
        // A long diagnosis is not begun for a file that cannot be written.
        output::can_be_written(&self.out, self.force)?;
        truepose::atomic::refuse_to_replace_inputs(&self.out, &output::paths(&inputs))?;
        let tables = self.tables.iter().map(|path| ExportedTable::read(path));
        let tables = tables.collect::<Result<_, _>>();
        let extras = Extras {
            date: self.date,
            tables: tables.map_err(|error| Failure::WrongInput(error.to_string()))?,
        };
        let report = if is_model(&self.file) {
            report::Report::of_model(&load_model(&self.file)?, &extras)
        } else {
            let loaded = truepose::sessions::load(&self.file)?;
            output::messages(&loaded.findings);
            inputs.extend(loaded.files);
            truepose::atomic::refuse_to_replace_inputs(&self.out, &output::paths(&inputs))?;
            let options = Options::default();
            report::Report::of_session(&loaded.session, &options, &extras, &|_| true)?
        };
        let bytes = match kind {
            Kind::Html => report::html(&report).into_bytes(),
            Kind::Pdf => {
                let written = report::pdf_with(&report, &Library::system())
                    .map_err(|error| Failure::Failed(error.into()))?;
                if !written.unshown.is_empty() {
                    output::messages(&[fonts::cannot_be_shown(&written.unshown)]);
                }
                written.bytes
            }
        };
        output::document(&self.out, &bytes, self.force, &inputs)
    }
}

impl From<ReportError> for Failure {
    fn from(error: ReportError) -> Self {
        match error {
            ReportError::Diagnose(DiagnoseError::Cancelled) => Self::Failed(error.into()),
            _ => Self::WrongInput(error.to_string()),
        }
    }
}

fn kind_of(out: &Path) -> Result<Kind, Failure> {
    let ending = out
        .extension()
        .and_then(|e| e.to_str())
        .map(str::to_ascii_lowercase);
    match ending.as_deref() {
        Some("html" | "htm") => Ok(Kind::Html),
        Some("pdf") => Ok(Kind::Pdf),
        _ => Err(Failure::WrongInput(format!(
            "--out {}: expected a file name that ends in .html or .pdf",
            out.display()
        ))),
    }
}
