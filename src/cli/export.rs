//! `truepose export`: from a model to the table that a controller reads, or to a description of the
//! corrected robot.

use std::path::PathBuf;

use clap::Args;
use clap::builder::PossibleValuesParser;
use serde_json::json;

use crate::explain::{self, Detail, Exported};
use crate::export::{EXPORTERS, ExportError, Job, Motors, Options, Reference, Zeros};
use crate::fit::gap::Spread;
use crate::kinematics::DhConvention;
use crate::language::spoken;
use crate::pipeline;
use crate::sessions::Session;
use crate::text::Text;

use super::failure::Failure;
use super::{blocks, output};

/// Write the table that a controller reads, or the corrected robot (URDF, MJCF, DH rows, …)
#[derive(Debug, Args)]
pub(crate) struct Export {
    /// Model to export
    model: PathBuf,
    /// Format of the file
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
    /// Also say what the written table leaves of this session's RMS error, and refuse one that makes it worse
    #[arg(long, value_name = "SESSION")]
    session: Option<PathBuf>,
    /// Who takes the zero offsets of the joints of a corrected robot, the geometry of the file or the
    /// controller, never both; by default what the format is for [origins; lerobot: controller]
    #[arg(long, value_name = "WHO", value_parser = PossibleValuesParser::new(Zeros::ALL.map(|(name, _)| name)))]
    zeros: Option<String>,
    /// Convention of dh rows; without it the one that the robot came in, else standard
    #[arg(long, value_name = "CONVENTION", value_parser = PossibleValuesParser::new(["standard", "modified"]))]
    convention: Option<String>,
    /// Servos of a lerobot calibration
    #[arg(long, value_name = "SERVOS", default_value = "feetech", value_parser = PossibleValuesParser::new(Motors::ALL.map(|(name, _)| name)))]
    motors: String,
    /// File that the export starts from: the URDF that the robot was read from, to be changed in place with
    /// its names and meshes; the motor calibration of lerobot that was active while measuring
    #[arg(long, value_name = "FILE")]
    reference: Option<PathBuf>,
    /// Replace files that exist
    #[arg(long)]
    force: bool,
    /// Print one JSON document that says what was written
    #[arg(long)]
    json: bool,
}

/// What belongs to a name in a list.
fn named<T: Copy>(all: &[(&str, T)], name: &str) -> Option<T> {
    let found = all.iter().find(|(known, _)| *known == name);
    found.map(|(_, value)| *value)
}

/// What an export leaves of a session, in a sentence.
fn left_of(session: &Session, error: Option<Spread>) -> Text {
    match error {
        Some(error) => text!(
            "of '{session}' it leaves an RMS error of {rms} mm (largest {largest})",
            session = &session.name,
            rms = format!("{:.6}", error.rms_mm),
            largest = format!("{:.6}", error.max_mm)
        ),
        None => text!(
            "the error that it leaves on '{session}' cannot be computed: another robot, no complete sample, or measured \
             with a table active",
            session = &session.name
        ),
    }
}

impl Export {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let calibration = pipeline::load_model(&self.model)?;
        let file_name = self.out.file_name().and_then(|name| name.to_str());
        let Some(file_name) = file_name else {
            let expected = text!("expected the name of a file, in UTF-8");
            return Err(Failure::WrongAt(self.out.display().to_string(), expected));
        };
        let joints = calibration.model.robot.joints.len();
        if self.joint == 0 || self.joint > joints {
            return Err(Failure::WrongInput(text!(
                "--joint {joint}: the robot has joints 1 to {joints}",
                joint = self.joint,
                joints
            )));
        }
        let to_stdout = output::is_standard_output(Some(&self.out));
        output::one_use_of_standard_output(to_stdout, self.json, "--out -", "--json")?;
        let reference = self.read_reference()?;
        let options = self.options(
            reference
                .as_ref()
                .map(|(name, bytes)| Reference { name, bytes }),
        );
        let job = Job {
            joint: self.joint - 1,
            step: self.step,
            options,
            ..Job::new(&calibration, if to_stdout { "table" } else { file_name })
        };
        let failure = |error| match error {
            ExportError::ReadBack(_) => Failure::Failed(anyhow::Error::from(error)),
            _ => Failure::refused(error.describe()),
        };
        let mut inputs = vec![self.model.clone()];
        inputs.extend(self.reference.clone());
        let (mut of_session, mut nominal) = (None, None);
        let (export, error) = if let Some(path) = &self.session {
            let loaded = output::session(path)?;
            inputs.extend(loaded.files);
            let session = &loaded.session;
            let checked = pipeline::export_for(&self.to, &job, session).map_err(failure)?;
            let error = checked.gaps.map(|[_, after]| after);
            of_session = Some(left_of(session, error));
            nominal = pipeline::nominal_error(session);
            (checked.export, error)
        } else {
            (pipeline::export(&self.to, &job).map_err(failure)?, None)
        };
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
                crate::atomic::refuse_to_replace_inputs(place, &output::paths(&inputs))?;
            }
            for (place, document) in places.iter().zip(&export.documents) {
                output::document(place, &document.bytes, self.force, &inputs)?;
            }
        }
        if self.json {
            let notes = export.notes.iter().chain(&of_session);
            let leaves = export.left.as_ref().and_then(|left| left.leaves);
            return output::json(&json!({
                "format": "truepose-exported/1",
                "model": self.model,
                "to": self.to,
                "joint": self.joint,
                "files": places,
                "leaves_mm": leaves.map(|leaves| leaves.leaves_mm),
                "between_targets_mm": leaves.map(|leaves| leaves.between_targets_mm),
                // A document is English.
                "notes": notes.map(Text::to_string).collect::<Vec<_>>(),
            }));
        }
        if let (None, Some(says)) = (error, &of_session) {
            output::messages(&[spoken(says)]);
        }
        let exported = Exported {
            export: &export,
            error,
            nominal,
            identified_mm: None,
            remainder: None,
        };
        let says = blocks::sections(&explain::table(&exported, Detail::TERMINAL));
        if to_stdout {
            output::aside(&says);
            Ok(())
        } else {
            output::text(&says)
        }
    }

    /// Name and content of the reference.
    fn read_reference(&self) -> Result<Option<(String, Vec<u8>)>, Failure> {
        let Some(path) = &self.reference else {
            return Ok(None);
        };
        let bytes = crate::sessions::read_whole(path)?;
        Ok(Some((path.display().to_string(), bytes)))
    }

    fn options<'a>(&self, reference: Option<Reference<'a>>) -> Options<'a> {
        let zeros = self.zeros.as_deref();
        let convention = self.convention.as_deref().map(|name| match name {
            "modified" => DhConvention::Modified,
            _ => DhConvention::Standard,
        });
        Options {
            zeros: zeros.and_then(|name| named(&Zeros::ALL, name)),
            motors: named(&Motors::ALL, &self.motors).unwrap_or_default(),
            convention,
            reference,
        }
    }
}
