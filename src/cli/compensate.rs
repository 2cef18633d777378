//! `truepose compensate`: the targets of a table or a robot program, corrected in place.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::PossibleValuesParser;

use crate::kinematics::{Pose, Robot, pose_from_parts};
use crate::pipeline;
use crate::present::compensation_v1::{self, Summary};
use crate::present::json::Json;
use crate::programs::{
    Answer, CompensateError, LANGUAGES, Language, ModelTool, Request, find, language_of,
};
use crate::sessions::read_whole;

use super::failure::Failure;
use super::output;

/// Correct the targets of a table or a robot program, so that the real tool goes where the nominal
/// robot would
///
/// Everything but the numbers of targets comes out byte for byte. A target that is singular, beyond the
/// limits or ambiguous is named and left as it is; the exit status is then 1.
#[derive(Debug, Args)]
pub(crate) struct Compensate {
    /// Model of the robot
    model: PathBuf,
    /// Table of joint values or poses, or robot program
    targets: PathBuf,
    /// Write the corrected file here, what was changed to FILE.meta.json; - is standard output
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Language of the file [default: by its ending, else by what it looks like]
    #[arg(long = "as", value_name = "LANGUAGE", value_parser = PossibleValuesParser::new(LANGUAGES.iter().map(|l| l.id)))]
    language: Option<String>,
    /// Load at the tool's origin where the file says none, kg
    #[arg(
        long,
        value_name = "KG",
        default_value_t = 0.0,
        allow_negative_numbers = true
    )]
    load: f64,
    /// Frame in which the file gives its poses where it declares none itself, in the robot's base frame:
    /// mm, and a quaternion for a turned one
    #[arg(
        long,
        value_name = "X,Y,Z[,QW,QX,QY,QZ]",
        value_delimiter = ',',
        allow_negative_numbers = true
    )]
    frame: Option<Vec<f64>>,
    /// The program's tool that is the model's: its name, or where the model's tool sits on the flange
    /// [default: the only one]
    #[arg(
        long,
        value_name = "NAME|X,Y,Z,QW,QX,QY,QZ",
        allow_hyphen_values = true
    )]
    tool: Option<String>,
    /// Take the frame in which the session was measured, brought into the base, for the robot's base
    /// [default: the base is where the first axis is]
    #[arg(long)]
    measured_frame: bool,
    /// Joint values before the first target, degrees or mm: which configuration the first pose has,
    /// and from which side its joints come
    #[arg(
        long,
        value_name = "Q1,Q2,…",
        value_delimiter = ',',
        allow_negative_numbers = true
    )]
    start: Option<Vec<f64>>,
    /// Replace files that exist
    #[arg(long)]
    force: bool,
    /// Print JSON (truepose-compensation/1)
    #[arg(long)]
    json: bool,
}

impl From<CompensateError> for Failure {
    fn from(error: CompensateError) -> Self {
        match error {
            CompensateError::ReadBack(_) => Self::Failed(error.into()),
            _ => Self::WrongInput(error.to_string()),
        }
    }
}

impl Compensate {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let to_stdout = output::is_standard_output(Some(&self.out));
        output::one_use_of_standard_output(self.json, to_stdout, "--json", "--out -")?;
        if !self.load.is_finite() || self.load < 0.0 {
            return Err(Failure::WrongInput(format!(
                "--load {}: expected a mass in kg, zero or more",
                self.load
            )));
        }
        let frame = self
            .frame
            .as_deref()
            .map(|n| pose("--frame", n))
            .transpose()?;
        let tool = self.tool.as_deref().map(tool).transpose()?;
        let calibration = pipeline::load_model(&self.model)?;
        let bytes = read_whole(&self.targets)?;
        let language = self.language(&bytes)?;
        let robot = &calibration.model.robot;
        let answer = pipeline::compensate(&Request {
            calibration: &calibration,
            bytes: &bytes,
            language,
            file: Some(&self.targets),
            load_kg: self.load,
            start: self.start.as_deref().map(|start| inner(robot, start)),
            frame,
            tool,
            measured_frame: self.measured_frame,
        })?;
        let names = [&self.model, &self.targets].map(|path| path.to_string_lossy().into_owned());
        let names = [names[0].as_str(), names[1].as_str()];
        let document = compensation_v1::document(
            &answer,
            robot,
            names,
            language.id,
            &frame.unwrap_or_else(Pose::identity),
        );
        self.write(&answer, &document, to_stdout)?;
        if self.json {
            output::json(&document)?;
        } else if !to_stdout {
            output::text(&in_words(&answer, &self.targets))?;
        }
        complain(&answer, &self.targets)
    }

    fn language(&self, bytes: &[u8]) -> Result<&'static Language, Failure> {
        let found = match &self.language {
            Some(id) => find(id),
            None => language_of(&self.targets, bytes),
        };
        found.ok_or_else(|| {
            let all: Vec<&str> = LANGUAGES.iter().map(|l| l.id).collect();
            Failure::WrongInput(format!(
                "{}: neither its ending nor its content tells the language; expected --as {}",
                self.targets.display(),
                all.join(" or ")
            ))
        })
    }

    fn write(&self, answer: &Answer, document: &Json, to_stdout: bool) -> Result<(), Failure> {
        let inputs = [self.model.clone(), self.targets.clone()];
        if to_stdout {
            return output::document(&self.out, &answer.bytes, self.force, &inputs);
        }
        let mut sidecar = self.out.clone().into_os_string();
        sidecar.push(".meta.json");
        let sidecar = PathBuf::from(sidecar);
        // Nothing is written when something cannot be.
        for place in [&self.out, &sidecar] {
            output::can_be_written(place, self.force)?;
            crate::atomic::refuse_to_replace_inputs(place, &output::paths(&inputs))?;
        }
        let mut text = serde_json::to_string_pretty(document).map_err(anyhow::Error::from)?;
        text.push('\n');
        output::document(&self.out, &answer.bytes, self.force, &inputs)?;
        output::document(&sidecar, text.as_bytes(), self.force, &inputs)
    }
}

fn pose(option: &str, numbers: &[f64]) -> Result<Pose, Failure> {
    let wrong = |what: String| {
        Failure::WrongInput(format!(
            "{option}: {what}; expected X,Y,Z or X,Y,Z,QW,QX,QY,QZ"
        ))
    };
    match *numbers {
        [x, y, z] => pose_from_parts([x, y, z], [1.0, 0.0, 0.0, 0.0]),
        [x, y, z, qw, qx, qy, qz] => pose_from_parts([x, y, z], [qw, qx, qy, qz]),
        _ => return Err(wrong(format!("{} numbers", numbers.len()))),
    }
    .map_err(|error| wrong(error.to_string()))
}

/// A name, or numbers between commas.
fn tool(text: &str) -> Result<ModelTool, Failure> {
    let numbers: Result<Vec<f64>, _> = text.split(',').map(|n| n.trim().parse()).collect();
    match numbers {
        Ok(numbers) => pose("--tool", &numbers).map(ModelTool::OnFlange),
        Err(_) => Ok(ModelTool::Named(text.to_owned())),
    }
}

/// Values in degrees or mm in rad or mm; too many or too few are told apart later.
fn inner(robot: &Robot, start: &[f64]) -> Vec<f64> {
    let kinds = robot.joints.iter().map(|joint| Some(joint.kind));
    let kinds = kinds.chain(std::iter::repeat(None));
    start
        .iter()
        .zip(kinds)
        .map(|(value, kind)| kind.map_or(*value, |kind| kind.inner(*value)))
        .collect()
}

fn in_words(answer: &Answer, file: &Path) -> String {
    let summary = Summary::new(answer);
    let mut text = String::new();
    let _ = writeln!(
        text,
        "{}: {} of {} targets corrected",
        file.display(),
        summary.corrected,
        summary.targets
    );
    if summary.corrected > 0 {
        let _ = writeln!(
            text,
            "RMS position error, as the model predicts it: {:.4} mm (largest {:.4}) before, {:.4} mm (largest \
             {:.4}) corrected",
            summary.before_mm, summary.max_before_mm, summary.after_mm, summary.max_after_mm
        );
    }
    for (line, column, says) in &answer.at_run_time {
        let _ = writeln!(text, "not corrected: line {line}, column {column}: {says}");
    }
    for (line, column, says) in &answer.remarks {
        let _ = writeln!(text, "note: line {line}, column {column}: {says}");
    }
    for note in &answer.notes {
        let _ = writeln!(text, "note: {note}");
    }
    text
}

/// Names every target that was left as it is; the status says so as well.
fn complain(answer: &Answer, file: &Path) -> Result<(), Failure> {
    for target in &answer.targets {
        if let Err(left) = &target.result {
            let (line, column) = target.place;
            output::messages(&[format!(
                "{}, line {line}, column {column}: {} is left as it is ({}): {}",
                file.display(),
                target.name,
                left.reason.name(),
                left.says
            )]);
        }
    }
    match answer.left() {
        0 => Ok(()),
        left => Err(Failure::Failed(anyhow::anyhow!(
            "{left} of {} targets were left as they are",
            answer.targets.len()
        ))),
    }
}
