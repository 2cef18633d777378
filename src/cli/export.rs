//! `truepose export`: from a model to the table that a controller reads.

use std::path::PathBuf;

use clap::Args;
use clap::builder::PossibleValuesParser;

use truepose::export::{EXPORTERS, ExportError, Job, find, gap_after_export};
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
    /// Step of the table in degrees or mm; without it the step is chosen
    #[arg(long, value_name = "DEG")]
    step: Option<f64>,
    /// Also say what the written table leaves of this session's gap
    #[arg(long, value_name = "SESSION")]
    session: Option<PathBuf>,
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
        let mut notes = export.notes.clone();
        let mut inputs = vec![self.model.clone()];
        if let Some(path) = &self.session {
            let loaded = truepose::sessions::load(path)?;
            output::messages(&loaded.findings);
            inputs.extend(loaded.files);
            let session = loaded.session;
            notes.push(match gap_after_export(&calibration, &session, &export) {
                Some(gap) => format!(
                    "of '{}' it leaves a gap of {:.6} mm (largest {:.6})",
                    session.name, gap.rms_mm, gap.max_mm
                ),
                None => format!(
                    "what it leaves of '{}' cannot be said: another robot, no complete sample, or \
                     measured with a table active",
                    session.name
                ),
            });
        }
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
        output::messages(&notes);
        Ok(())
    }
}
