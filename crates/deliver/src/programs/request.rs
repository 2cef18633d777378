//! What is asked of a compensation, and why there is none.

use std::path::Path;

use crate::compensation::{TableError, VerifiedCalibration};
use crate::diagnostic::Rejected;
use crate::effects::{Role, Term};
use crate::kinematics::Pose;
use crate::model::Calibration;
use crate::text::Text as Sentence;
use crate::units::{LARGEST_LENGTH_MM, LARGEST_NUMBER};

use super::Language;
use super::program_frames::{Differences, ModelTool, Precedence, ProgramFrames};

/// What is to be corrected, and with what.
#[derive(Debug, Clone)]
pub struct Request<'a> {
    /// The model.
    pub calibration: &'a VerifiedCalibration,
    /// The file.
    pub bytes: &'a [u8],
    /// How to read it.
    pub language: &'static Language,
    /// Its name, for messages.
    pub file: Option<&'a Path>,
    /// Files that are read with it: what is declared, set and gone to there holds.
    pub beside: Vec<Beside<'a>>,
    /// Load at the tool's origin where the file says none, kg.
    pub load_kg: f64,
    /// Joint values before the first target, rad or mm.
    pub start: Option<Vec<f64>>,
    /// The frame in which the file gives its poses, in the robot's base frame, where it declares none
    /// itself; `None`: the base.
    pub frame: Option<Pose>,
    /// Which of the program's tools is the model's; `None`: the only one.
    pub tool: Option<ModelTool>,
    /// What holds where the program's tool, frame or load is not the model's.
    pub frames: ProgramFrames,
    /// Whether the frame in which the session was measured, brought into the base, is the robot's base,
    /// so that what the first joint shares with it is corrected too.
    pub measured_frame: bool,
}

/// A file that is read with the one that is corrected, and not corrected itself.
#[derive(Debug, Clone, Copy)]
pub struct Beside<'a> {
    /// Its name, for messages.
    pub path: &'a Path,
    /// Its content.
    pub bytes: &'a [u8],
    /// Whether the caller named it: what is wrong with it is reported. A file that merely lies there, as a `.dat`
    /// does beside its `.src`, is then not read.
    pub named: bool,
}

/// Why nothing was corrected.
#[derive(Debug)]
pub enum CompensateError {
    /// The file cannot be read.
    Rejected(Rejected),
    /// The model makes no corrections.
    Model(TableError),
    /// The request does not suit the model.
    Refused(Sentence),
    /// The program's tool, frame or load is not the model's, and which holds is not settled.
    Differs(Differences),
    /// One tool or frame is given, and the program has several.
    Several {
        /// Whether it is the tool, else the frame.
        is_tool: bool,
        /// Those of the program.
        names: String,
    },
    /// The program has no such tool.
    Tool {
        /// The name.
        found: String,
        /// Tools that the program uses.
        expected: String,
    },
    /// What was written does not read back as it was meant.
    ReadBack(String),
}

impl CompensateError {
    /// In words.
    pub fn describe(&self) -> Sentence {
        match self {
            Self::Rejected(inner) => inner.describe(),
            Self::Model(inner) => inner.describe(),
            Self::Refused(says) => says.clone(),
            Self::Differs(differences) => differences.describe(),
            Self::Several { is_tool, names } => text!(
                "{option} gives one and the program has several ({names}): --as-programmed takes each as the program declares it",
                option = if *is_tool { "--tool" } else { "--frame" },
                names
            ),
            Self::Tool { found, expected } => text!(
                "--tool {found}: the program has no such tool; expected one of its own ({expected}), or X,Y,Z,QW,QX,QY,QZ",
                found,
                expected
            ),
            Self::ReadBack(what) => text!("what was written reads back differently: {what}", what),
        }
    }
}

displays_what_it_says!(CompensateError);

impl std::error::Error for CompensateError {}

impl From<Rejected> for CompensateError {
    fn from(error: Rejected) -> Self {
        Self::Rejected(error)
    }
}

impl From<TableError> for CompensateError {
    fn from(error: TableError) -> Self {
        Self::Model(error)
    }
}

impl Request<'_> {
    /// What of it is not finite, or beyond any robot's range.
    pub(super) fn no_number(&self) -> Option<&'static str> {
        let length = |mm: &f64| mm.abs() <= LARGEST_LENGTH_MM;
        let pose = |pose: &Pose| {
            let turn = &pose.rotation.coords;
            pose.translation.vector.iter().all(length) && (turn.norm() - 1.0).abs() <= 1e-6
        };
        let load = |kg: f64| kg.abs() <= LARGEST_NUMBER;
        let start = self.start.iter().flatten();
        let on_flange = match &self.tool {
            Some(ModelTool::OnFlange(tool)) => pose(tool),
            _ => true,
        };
        let given = |holds: &Precedence<Pose>| match holds {
            Precedence::Given(own) => pose(own),
            _ => true,
        };
        let given_load = match self.frames.load {
            Precedence::Given(kg) => load(kg),
            _ => true,
        };
        let all = [
            (
                start.into_iter().all(|q| q.abs() <= LARGEST_NUMBER),
                "the start",
            ),
            (load(self.load_kg) && given_load, "the load"),
            (
                self.frame.as_ref().is_none_or(pose) && given(&self.frames.frame),
                "the frame",
            ),
            (on_flange && given(&self.frames.tool), "the tool"),
        ];
        let wrong = all.into_iter().find(|(fits, _)| !fits);
        wrong.map(|(_, what)| what)
    }
}

/// The measuring frame of a session that was brought into the robot's base.
pub(super) fn measured_frame(calibration: &Calibration) -> Option<&Term> {
    let mut terms = calibration.model.terms().iter();
    terms.find(|t| t.effect.about().role == Role::FreeFrame && t.label.is_none())
}
