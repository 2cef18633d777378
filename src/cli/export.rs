//! `truepose export`: from a model to the table that a controller reads.

use std::path::PathBuf;

use clap::Args;
use clap::builder::PossibleValuesParser;

use truepose::export::{DEFAULT_STEP, EXPORTERS, ExportError, Job, find};
use truepose::model::format_v1::load_model;

use super::failure::Failure;
use super::output;

/// Write the table that a controller reads
#[derive(Debug, Args)]
pub(crate) struct Export {
    /// Model to export
    model: PathBuf,
    /// Format of the table
    #[arg(long, value_name = "FORMAT", value_parser = PossibleValuesParser::new(EXPORTERS.iter().map(|f| f.id)))]
    to: String,
    /// Write the table to this file, what it means to files beside it; - is standard output
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Joint of the table, counted from 1
    #[arg(long, default_value_t = 1)]
    joint: usize,
    /// Step of the table in degrees or mm
    #[arg(long, default_value_t = DEFAULT_STEP, value_name = "DEG")]
    step: f64,
    /// Replace files that exist
    #[arg(long)]
    force: bool,
}

impl Export {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let calibration = load_model(&self.model)?;
        let file_name = self.out.file_name().and_then(|name| name.to_str());
        let Some(file_name) = file_name else {
            return Err(Failure::WrongInput(format!(
                "{}: expected the name of a file, in UTF-8",
                self.out.display()
            )));
        };
        let joints = calibration.model.robot.joints.len();
        if self.joint == 0 || self.joint > joints {
            return Err(Failure::WrongInput(format!(
                "--joint {}: the robot has joints 1 to {joints}",
                self.joint
            )));
        }
        let to_stdout = output::is_standard_output(Some(&self.out));
        let job = Job {
            joint: self.joint - 1,
            step: self.step,
            ..Job::new(&calibration, if to_stdout { "table" } else { file_name })
        };
        let Some(format) = find(&self.to) else {
            return Err(Failure::WrongInput(format!(
                "no format is called '{}'",
                self.to
            )));
        };
        let export = format.exporter.export(&job).map_err(|error| match error {
            ExportError::Table(_) | ExportError::Refused(_) => {
                Failure::WrongInput(error.to_string())
            }
            ExportError::ReadBack(_) => Failure::Failed(error.into()),
        })?;
        let inputs = [self.model.clone()];
        let beside = self.out.parent().map(PathBuf::from).unwrap_or_default();
        let places = export.documents.iter().enumerate().map(|(k, document)| {
            if k == 0 {
                self.out.clone()
            } else {
                beside.join(&document.name)
            }
        });
        let places: Vec<PathBuf> = places.collect();
        if to_stdout {
            output::document(&self.out, &export.documents[0].bytes, self.force, &inputs)?;
        } else {
            // Nothing is written when something cannot be.
            for place in &places {
                output::can_be_written(place, self.force)?;
                truepose::atomic::refuse_to_replace_inputs(place, &output::paths(&inputs))?;
            }
            for (place, document) in places.iter().zip(&export.documents) {
                output::document(place, &document.bytes, self.force, &inputs)?;
            }
        }
        output::messages(&export.notes);
        Ok(())
    }
}
