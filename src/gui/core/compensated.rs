//! The targets of a table or of a robot program, corrected by a model: what became of them, and the lines
//! that changed.

use crate::language::spoken;
use std::path::{Path, PathBuf};

use crate::compensation::VerifiedCalibration;
use crate::kinematics::Pose;
use crate::pipeline;
use crate::present::compensation_v1::{Summary, document};
use crate::programs::{
    Answer, Beside, CompensateError, DifferingNumber, ExternalAxes, LANGUAGES, ModelTool,
    Precedence, ProgramFrames, Request, beside, language_of,
};
use crate::sessions::files::open::read_document;

/// No robot carries more, kg.
pub(crate) const MOST_KG: f64 = 10_000.0;

/// What is to be corrected, and how.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct CompensationRequest {
    pub(crate) path: PathBuf,
    /// Files of the controller that declare what it uses: tools, frames, loads, points.
    pub(crate) with: Vec<PathBuf>,
    /// Load at the tool's origin where the file says none, kg.
    pub(crate) load_kg: f64,
    /// Whether the frame in which the session was measured is the robot's base.
    pub(crate) measured_frame: bool,
    /// Whose tool holds.
    pub(crate) tool: Precedence<Pose>,
    /// Whose frame (work object, base, user frame) holds.
    pub(crate) frame: Precedence<Pose>,
    pub(crate) typed: Typed,
    /// What external axes move that differ between targets.
    pub(crate) external: ExternalAxes,
}

impl CompensationRequest {
    /// Without a load, in the base frame; a tool or frame that differs is asked for.
    pub(crate) fn new(path: PathBuf) -> Self {
        Self {
            path,
            with: Vec::new(),
            load_kg: 0.0,
            measured_frame: false,
            tool: Precedence::Unsettled,
            frame: Precedence::Unsettled,
            typed: Typed::default(),
            external: ExternalAxes::Asked,
        }
    }
}

/// What is typed as in the terminal; empty where nothing is stated.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct Typed {
    /// The program's frame.
    pub(crate) frame: String,
    /// The program's tool, or the name of the tool that is the model's.
    pub(crate) tool: String,
    /// The model's tool on the flange.
    pub(crate) on_flange: String,
    /// The joint values before the first target.
    pub(crate) start: String,
}

impl Typed {
    /// What each is called, how it is written, and what was typed.
    pub(crate) fn fields(&mut self) -> [(&'static str, &'static str, &mut String); 4] {
        let pose = "X,Y,Z[,A,B,C|,QW,QX,QY,QZ]";
        let tool = "X,Y,Z[,A,B,C|,QW,QX,QY,QZ]|NAME";
        [
            (say!("Frame of the program"), pose, &mut self.frame),
            (say!("Tool of the program"), tool, &mut self.tool),
            (
                say!("Tool of the model on the flange"),
                pose,
                &mut self.on_flange,
            ),
            (
                say!("Joint values before the first target"),
                "Q1,Q2,…",
                &mut self.start,
            ),
        ]
    }
}

/// Why nothing was corrected.
#[derive(Debug, Clone, Default)]
pub(crate) struct NotCorrected {
    /// A line for each problem.
    pub(crate) problems: Vec<String>,
    /// What is to be settled: whose tool, whose frame.
    pub(crate) differs: Vec<DifferingNumber>,
}

/// A file of targets, and what became of it.
#[derive(Debug, Clone)]
pub(crate) struct Compensated {
    pub(crate) wanted: CompensationRequest,
    /// What was made of it, or why nothing was.
    pub(crate) result: Result<Corrected, NotCorrected>,
}

/// A corrected file.
#[derive(Debug, Clone)]
pub(crate) struct Corrected {
    /// The language, as people call it.
    pub(crate) language: &'static str,
    pub(crate) answer: Answer,
    pub(crate) summary: Summary,
    /// The lines that differ.
    pub(crate) changed: Vec<Changed>,
    /// What is written beside it: `truepose-compensation/1`.
    pub(crate) sidecar: Vec<u8>,
}

/// A line that differs.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Changed {
    /// From 1.
    pub(crate) line: usize,
    pub(crate) before: String,
    pub(crate) after: String,
}

impl Compensated {
    /// Reads and corrects a file, or says why the model is not handed out; `model` is what the model's file is called.
    pub(crate) fn of(
        calibration: Result<&VerifiedCalibration, String>,
        model: &str,
        wanted: CompensationRequest,
    ) -> Self {
        let result = match calibration {
            Ok(calibration) => corrected(calibration, model, &wanted),
            Err(says) => Err(NotCorrected {
                problems: vec![says],
                differs: Vec::new(),
            }),
        };
        Self { wanted, result }
    }

    /// Where the corrected file is saved unless the user says otherwise.
    pub(crate) fn proposed_path(&self) -> PathBuf {
        let path = &self.wanted.path;
        let stem = path.file_stem().unwrap_or_default();
        let mut name = stem.to_os_string();
        name.push("-compensated");
        if let Some(extension) = path.extension() {
            name.push(".");
            name.push(extension);
        }
        path.with_file_name(name)
    }
}

fn corrected(
    calibration: &VerifiedCalibration,
    model: &str,
    wanted: &CompensationRequest,
) -> Result<Corrected, NotCorrected> {
    let path: &Path = &wanted.path;
    let lines = |says: &str| NotCorrected {
        problems: says.lines().map(str::to_owned).collect(),
        differs: Vec::new(),
    };
    let read = |path: &Path| {
        let bytes = read_document(path);
        bytes.map_err(|error| lines(&spoken(error.describe())))
    };
    let bytes = read(path)?;
    let language = language_of(path, &bytes).ok_or_else(|| {
        let all: Vec<&str> = LANGUAGES.iter().map(|l| l.title).collect();
        lines(&say!(
            "{path}: neither its ending nor its content says what it is; expected {all}",
            path = path.display(),
            all = all.join(", ")
        ))
    })?;
    let lies_there = beside(path, language).filter(|other| !wanted.with.contains(other));
    let lies_there = lies_there.and_then(|path| Some((read_document(&path).ok()?, path, false)));
    let mut beside = Vec::from_iter(lies_there);
    for named in &wanted.with {
        beside.push((read(named)?, named.clone(), true));
    }
    let robot = &calibration.model.robot;
    let numbers = |text: &str| -> Vec<f64> {
        let cells = text.split(',').map(|cell| cell.trim().parse());
        cells.map(|cell| cell.unwrap_or(f64::NAN)).collect()
    };
    let pose = |called: &str, typed: &str| {
        let typed = (!typed.is_empty()).then(|| numbers(typed));
        let stated = typed.map(|typed| language.orientation.stated(called, &typed));
        stated.transpose().map_err(|says| lines(&spoken(says)))
    };
    let typed = &wanted.typed;
    let named = typed.tool.starts_with(char::is_alphabetic);
    let tool = if named { "" } else { &typed.tool };
    let tool = pose(say!("Tool of the program"), tool)?;
    let frame = pose(say!("Frame of the program"), &typed.frame)?;
    let on_flange = pose(say!("Tool of the model on the flange"), &typed.on_flange)?;
    let answer = pipeline::compensate(&Request {
        calibration,
        bytes: &bytes,
        language,
        file: Some(path),
        beside: (beside.iter())
            .map(|(bytes, path, named)| Beside {
                path,
                bytes,
                named: *named,
            })
            .collect(),
        load_kg: wanted.load_kg,
        start: (!typed.start.is_empty()).then(|| robot.in_base_units(&numbers(&typed.start))),
        frame,
        tool: if named {
            Some(ModelTool::Named(typed.tool.clone()))
        } else {
            on_flange.map(ModelTool::OnFlange)
        },
        frames: ProgramFrames {
            tool: tool.map_or(wanted.tool, Precedence::Given),
            frame: frame.map_or(wanted.frame, Precedence::Given),
            load: Precedence::Given(wanted.load_kg),
            external: wanted.external,
        },
        measured_frame: wanted.measured_frame,
    })
    .map_err(|error| {
        let CompensateError::Differs(differences) = &error else {
            return lines(&spoken(error.describe()));
        };
        // How to settle it is asked for above them: options of the terminal are no help here.
        let differences = differences.0.iter();
        NotCorrected {
            problems: differences
                .clone()
                .map(|one| spoken(one.describe()))
                .collect(),
            differs: differences.map(|one| one.what).collect(),
        }
    })?;
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let frame = frame.unwrap_or_else(Pose::identity);
    let json = document(&answer, robot, [model, &name], language.id, &frame);
    let mut sidecar =
        serde_json::to_vec_pretty(&json).map_err(|error| lines(&error.to_string()))?;
    sidecar.push(b'\n');
    Ok(Corrected {
        language: language.title,
        summary: Summary::new(&answer),
        changed: changed(&bytes, &answer.bytes),
        answer,
        sidecar,
    })
}

/// The lines that differ; a correction changes numbers within lines and adds none.
fn changed(before: &[u8], after: &[u8]) -> Vec<Changed> {
    let lines = |bytes: &[u8]| -> Vec<String> {
        let text = String::from_utf8_lossy(bytes);
        text.lines().map(|line| line.trim().to_owned()).collect()
    };
    let pairs = lines(before).into_iter().zip(lines(after)).enumerate();
    pairs
        .filter(|(_, (before, after))| before != after)
        .map(|(index, (before, after))| Changed {
            line: index + 1,
            before,
            after,
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_lines_that_differ_are_shown_with_their_numbers() {
        let before = b"MODULE A\r\n  p1 := 1;\r\n  p2 := 2;\r\nENDMODULE\r\n";
        let after = b"MODULE A\r\n  p1 := 1;\r\n  p2 := 2.5;\r\nENDMODULE\r\n";
        let expected = Changed {
            line: 3,
            before: "p2 := 2;".to_owned(),
            after: "p2 := 2.5;".to_owned(),
        };
        assert_eq!(changed(before, after), [expected]);
        assert!(changed(before, before).is_empty());
    }
}
