//! `truepose compensate`: the targets of a table or a robot program, corrected in place.

use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::PossibleValuesParser;

use crate::explain::{self, Detail};
use crate::kinematics::Pose;
use crate::pipeline;
use crate::present::compensation_v1::{self, Document};
use crate::programs::{
    Answer, Beside, CompensateError, ExternalAxes, LANGUAGES, Language, ModelTool, Outcome,
    Precedence, ProgramFrames, Reason, Request, beside, find, language_of,
};
use crate::sessions::read_whole;

use super::failure::Failure;
use super::words::any_of;
use super::{blocks, output};

/// Correct the targets of a table or a robot program, so that the real tool goes where the nominal
/// robot would
///
/// Everything but the numbers of targets comes out byte for byte. A target whose position cannot be
/// corrected is named and left as it is; the exit status is then 1. Where the program's own numbers of a
/// tool, a base or a load are not the model's, nothing is written (2) until --tool, --frame, --load,
/// --as-programmed or --as-modelled says which holds; so where an external axis differs between targets, until
/// --external does.
#[derive(Debug, Args)]
#[allow(
    clippy::struct_excessive_bools,
    reason = "each is a switch of the command line"
)]
pub(crate) struct Compensate {
    /// Model of the robot
    model: PathBuf,
    /// Table of joint values or poses, or robot program
    targets: PathBuf,
    /// File of the controller that declares what the program uses: tools, frames, loads, points (a KUKA's
    /// $config.dat, a RAPID module, a FANUC's SYSFRAME.VA). It is read and not corrected; may be repeated
    #[arg(long, value_name = "FILE")]
    with: Vec<PathBuf>,
    /// Write the corrected file here, what was changed to FILE.meta.json; - is standard output
    #[arg(long, value_name = "FILE")]
    out: PathBuf,
    /// Language of the file [default: by its ending, else by what it looks like]
    #[arg(long = "as", value_name = "LANGUAGE", value_parser = PossibleValuesParser::new(LANGUAGES.iter().map(|l| l.id)))]
    language: Option<String>,
    /// Load at the tool's origin, kg: whatever a program states, and of a table where it says none
    /// [default: the program's, where the session of the model has such loads; else 0]
    #[arg(long, value_name = "KG", allow_negative_numbers = true)]
    load: Option<f64>,
    /// Frame (work object, base, user frame) in which the file gives its poses, in the robot's base frame:
    /// mm, and a quaternion or the three angles of the language for a turned one (KRL, RAPID, CSV: A,B,C about
    /// z, y, x in degrees; FANUC: W,P,R in degrees; `URScript`: rotation vector in rad)
    #[arg(
        long,
        value_name = "X,Y,Z[,A,B,C|,QW,QX,QY,QZ]",
        value_delimiter = ',',
        allow_negative_numbers = true
    )]
    frame: Option<Vec<f64>>,
    /// Tool (TCP) of the program on the flange, written like --frame: the targets are corrected for it;
    /// or the name of the program's tool that is the model's
    #[arg(
        long,
        value_name = "X,Y,Z[,A,B,C|,QW,QX,QY,QZ]|NAME",
        allow_hyphen_values = true
    )]
    tool: Option<String>,
    /// Where the model's own tool is on the flange, written like --frame [default: as Denavit-Hartenberg rows
    /// have it, else the tool's frame is taken for the flange]
    #[arg(
        long,
        value_name = "X,Y,Z[,A,B,C|,QW,QX,QY,QZ]",
        value_delimiter = ',',
        allow_negative_numbers = true
    )]
    model_tool: Option<Vec<f64>>,
    /// Take tool, base and load as the program writes them, where no option gives them
    #[arg(long, conflicts_with = "as_modelled")]
    as_programmed: bool,
    /// Take tool, base and load for the model's, whatever the program says, where no option gives them
    #[arg(long)]
    as_modelled: bool,
    /// What an external axis moves that differs between targets and that the model does not have: the robot
    /// (a rail; its poses are left, and the model has to have the axis), or something else [default: it is asked]
    #[arg(long, value_name = "carries-robot|other", value_parser = PossibleValuesParser::new(["carries-robot", "other"]))]
    external: Option<String>,
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
            CompensateError::Rejected(rejected) => rejected.into(),
            other => Self::refused(other.describe()),
        }
    }
}

impl Compensate {
    pub(crate) fn run(self) -> Result<(), Failure> {
        let to_stdout = output::is_standard_output(Some(&self.out));
        output::one_use_of_standard_output(self.json, to_stdout, "--json", "--out -")?;
        if let Some(load) = self.load
            && !(load.is_finite() && load >= 0.0)
        {
            return Err(Failure::WrongInput(text!(
                "{option} {given}: expected {expected}",
                option = "--load",
                given = load,
                expected = text!("a mass of 0 kg or more")
            )));
        }
        let calibration = pipeline::load_model(&self.model)?;
        let bytes = read_whole(&self.targets)?;
        let language = self.language(&bytes)?;
        let robot = &calibration.model.robot;
        let (tool, frames) = self.frames(language)?;
        let frame = match frames.frame {
            Precedence::Given(pose) => Some(pose),
            _ => None,
        };
        let lies_there = beside(&self.targets, language).filter(|path| !self.with.contains(path));
        let named = self.with.iter().map(|path| (path.clone(), true));
        let beside = lies_there
            .map(|path| (path, false))
            .into_iter()
            .chain(named);
        let beside: Vec<(PathBuf, Vec<u8>, bool)> = beside
            .map(|(path, named)| read_whole(&path).map(|bytes| (path, bytes, named)))
            .collect::<Result<_, _>>()?;
        let answer = pipeline::compensate(&Request {
            calibration: &calibration,
            bytes: &bytes,
            language,
            file: Some(&self.targets),
            beside: (beside.iter())
                .map(|(path, bytes, named)| Beside {
                    path,
                    bytes,
                    named: *named,
                })
                .collect(),
            load_kg: self.load.unwrap_or_default(),
            start: self
                .start
                .as_deref()
                .map(|start| robot.in_base_units(start)),
            frame,
            tool,
            frames,
            measured_frame: self.measured_frame,
        })
        .map_err(|error| match error {
            CompensateError::Differs(differences) => {
                Failure::WrongAt(self.targets.display().to_string(), differences.describe())
            }
            other => other.into(),
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
        let mut inputs = vec![self.model.clone(), self.targets.clone()];
        inputs.extend(beside.into_iter().map(|(path, ..)| path));
        self.write(&answer, &document, to_stdout, &inputs)?;
        if self.json {
            output::json(&document)?;
        } else if !to_stdout {
            // A robot with fewer joints never keeps the orientation.
            let orientation = robot.mobility() == 6;
            let sections = explain::program(&answer, orientation, usize::MAX, Detail::TERMINAL);
            output::text(&blocks::sections(&sections))?;
        }
        complain(&answer, &self.targets)
    }

    /// Which tool is the model's, and what holds where the program differs from it.
    fn frames(&self, language: &Language) -> Result<(Option<ModelTool>, ProgramFrames), Failure> {
        let mut frames = if self.as_programmed {
            ProgramFrames::as_programmed()
        } else if self.as_modelled {
            ProgramFrames::as_modelled()
        } else {
            ProgramFrames::default()
        };
        let pose = |option: &str, numbers: &[f64]| {
            let pose = language.orientation.stated(option, numbers);
            pose.map_err(Failure::WrongInput)
        };
        let mut tool = None;
        if let Some(numbers) = self.model_tool.as_deref() {
            tool = Some(ModelTool::OnFlange(pose("--model-tool", numbers)?));
        }
        if let Some(text) = self.tool.as_deref() {
            let numbers: Result<Vec<f64>, _> = text.split(',').map(|n| n.trim().parse()).collect();
            match numbers {
                Ok(numbers) => frames.tool = Precedence::Given(pose("--tool", &numbers)?),
                Err(_) => tool = Some(ModelTool::Named(text.to_owned())),
            }
        }
        if let Some(numbers) = self.frame.as_deref() {
            frames.frame = Precedence::Given(pose("--frame", numbers)?);
        }
        frames.external = match self.external.as_deref() {
            Some("carries-robot") => ExternalAxes::CarryRobot,
            Some(_) => ExternalAxes::Other,
            None => ExternalAxes::Asked,
        };
        if let Some(kg) = self.load {
            frames.load = Precedence::Given(kg);
        }
        Ok((tool, frames))
    }

    fn language(&self, bytes: &[u8]) -> Result<&'static Language, Failure> {
        let found = match &self.language {
            Some(id) => find(id),
            None => language_of(&self.targets, bytes),
        };
        found.ok_or_else(|| {
            let all: Vec<&str> = LANGUAGES.iter().map(|l| l.id).collect();
            let options = text!(
                "neither its ending nor its content tells the language; expected --as {languages}",
                languages = any_of(&all)
            );
            Failure::WrongAt(self.targets.display().to_string(), options)
        })
    }

    fn write(
        &self,
        answer: &Answer,
        document: &Document,
        to_stdout: bool,
        inputs: &[PathBuf],
    ) -> Result<(), Failure> {
        if to_stdout {
            return output::document(&self.out, &answer.bytes, self.force, inputs);
        }
        let mut sidecar = self.out.clone().into_os_string();
        sidecar.push(".meta.json");
        let sidecar = PathBuf::from(sidecar);
        // Nothing is written when something cannot be.
        for place in [&self.out, &sidecar] {
            output::can_be_written(place, self.force)?;
            crate::atomic::refuse_to_replace_inputs(place, &output::paths(inputs))?;
        }
        output::document(&self.out, &answer.bytes, self.force, inputs)?;
        // Written as it is made: it is larger than the program.
        Ok(crate::atomic::write_atomically(
            &sidecar,
            self.force,
            |file| {
                serde_json::to_writer_pretty(&mut *file, document)?;
                file.write_all(b"\n")
            },
        )?)
    }
}

/// Names every target that was left as it is; the status says so as well.
fn complain(answer: &Answer, file: &Path) -> Result<(), Failure> {
    for says in explain::left_as_they_are(answer) {
        output::messages(&[format!("{}, {says}", file.display())]);
    }
    let declared_elsewhere = |target: &Outcome| {
        let left = target.result.as_ref().err();
        left.is_some_and(|left| left.reason == Reason::Frame)
    };
    if answer.targets.iter().any(declared_elsewhere) {
        output::messages(&[text!(
            "where tools and frames are declared in another file of the controller ($config.dat, a module, SYSFRAME.VA), --with FILE reads it"
        )]);
    }
    match answer.left() {
        0 => Ok(()),
        left => Err(Failure::Failed(anyhow::Error::msg(text!(
            one "{count} of {all} targets was left as it is", "{count} of {all} targets were left as they are",
            count = left,
            all = answer.targets.len()
        )))),
    }
}
