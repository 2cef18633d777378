//! `truepose-compensation/1`: what became of the targets of a file, as JSON.
//!
//! ```json
//! { "format": "truepose-compensation/1", "model": "cell.model.json", "file": "p.mod", "as": "rapid",
//!   "frame": { "position_mm": [0, 0, 0], "quaternion_wxyz": [1, 0, 0, 0] },
//!   "summary": { "targets": 12, "corrected": 11, "left": 1, "at_run_time": 2,
//!                "before_mm": 1.31, "max_before_mm": 2.02, "after_mm": 0.0, "max_after_mm": 0.0,
//!                "orientation_in_part": 1, "max_after_mrad": 0.8 },
//!   "targets": [ { "name": "p10", "line": 4, "column": 26, "kind": "pose", "corrected": true,
//!                  "because": null, "says": null, "q_deg": [], "change_deg": [], "dir": [], "load_kg": 0,
//!                  "before_mm": 1.2, "after_mm": 0.0, "before_mrad": 2.1, "after_mrad": 0.0 } ],
//!   "at_run_time": [ { "line": 9, "column": 5, "says": "…" } ],
//!   "remarks": [ { "line": 2, "column": 1, "says": "…" } ], "notes": ["…"] }
//! ```
//!
//! - `frame`: where the poses of the file are given for which it declares no frame, in the robot's base
//!   frame.
//! - `before_mm`, `after_mm`: how far the real tool, as the model knows it, is from the target without and
//!   with the correction; in the summary the root mean square over the corrected targets.
//! - `because`: `singular`, `unreachable`, `ambiguous`, `relative`, `frame` (its frame, its tool or its mode is not
//!   known), `unused` (no motion goes to it), `changed` (at run time) or `external` (an axis that the model does not
//!   have carries the robot) for a target that was left as it is.
//! - `after_mrad`: what of the orientation is left: where a turn would take a large move of the joints (near
//!   a singular wrist) it is corrected in part; `orientation_in_part` counts these targets.
//! - `q_deg`, `change_deg`: the commands that the target means and what was added; mm for a sliding joint.
//! - `at_run_time`: what the program computes or takes from elsewhere; it is not corrected.

use crate::text::Text;
use serde::{Serialize, Serializer};

use super::displayed;
use super::json::{Json, list, object};
use super::parts::pose;
use crate::kinematics::{Pose, Robot};
use crate::programs::{Answer, Outcome, Written};

/// How many targets were corrected, and how far off they were and are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Summary {
    /// Targets of the file.
    pub targets: usize,
    /// Those that were corrected.
    pub corrected: usize,
    /// Those that were left as they are.
    pub left: usize,
    /// What is computed at run time.
    pub at_run_time: usize,
    /// Root mean square of the position error without correction, mm.
    pub before_mm: f64,
    /// The largest.
    pub max_before_mm: f64,
    /// With it.
    pub after_mm: f64,
    /// The largest.
    pub max_after_mm: f64,
    /// Corrected targets of which a part of the orientation is left.
    pub turned: usize,
    /// The largest orientation error that is left, rad.
    pub max_after_rad: f64,
}

/// Of a corrected target an orientation error above this is said, rad.
pub const SAID_RAD: f64 = 1e-6;

/// mrad in a rad.
const MRAD: f64 = 1e3;

/// The document of an answer. What it says of a target is worked out as it is written: of a large program
/// there is never a whole tree of it in memory.
#[derive(Debug, Serialize)]
pub struct Document<'a> {
    format: &'static str,
    model: &'a str,
    file: &'a str,
    #[serde(rename = "as")]
    language: &'a str,
    frame: Json,
    summary: Json,
    targets: Targets<'a>,
    at_run_time: Json,
    remarks: Json,
    notes: Json,
}

/// The document of an answer; `model` and `file` are the names of the inputs.
pub fn document<'a>(
    answer: &'a Answer,
    robot: &'a Robot,
    [model, file]: [&'a str; 2],
    language: &'a str,
    frame: &Pose,
) -> Document<'a> {
    let s = Summary::new(answer);
    Document {
        format: "truepose-compensation/1",
        model,
        file,
        language,
        frame: pose(frame),
        summary: object! {
            "targets": s.targets,
            "corrected": s.corrected,
            "left": s.left,
            "at_run_time": s.at_run_time,
            "before_mm": s.before_mm,
            "max_before_mm": s.max_before_mm,
            "after_mm": s.after_mm,
            "max_after_mm": s.max_after_mm,
            "orientation_in_part": s.turned,
            "max_after_mrad": MRAD * s.max_after_rad,
        },
        targets: Targets(&answer.targets, robot),
        at_run_time: placed(&answer.at_run_time),
        remarks: placed(&answer.remarks),
        notes: (&answer.notes).into(),
    }
}

/// The targets of a document.
#[derive(Debug)]
struct Targets<'a>(&'a [Outcome], &'a Robot);

impl Serialize for Targets<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_seq(self.0.iter().map(|target| entry(target, self.1)))
    }
}

impl Summary {
    /// Over the targets of an answer.
    pub fn new(answer: &Answer) -> Self {
        let corrected: Vec<_> = answer.targets.iter().flat_map(|t| &t.result).collect();
        let n = corrected.len().max(1) as f64;
        let rms = |k: usize| {
            let squares = corrected.iter().map(|w| w.position_mm[k].powi(2));
            (squares.sum::<f64>() / n).sqrt()
        };
        let most = |k: usize| {
            corrected
                .iter()
                .map(|w| w.position_mm[k])
                .fold(0.0, f64::max)
        };
        Self {
            targets: answer.targets.len(),
            corrected: corrected.len(),
            left: answer.left(),
            at_run_time: answer.at_run_time.len(),
            before_mm: rms(0),
            max_before_mm: most(0),
            after_mm: rms(1),
            max_after_mm: most(1),
            turned: corrected
                .iter()
                .filter(|w| w.rotation_rad[1] > SAID_RAD)
                .count(),
            max_after_rad: corrected
                .iter()
                .map(|w| w.rotation_rad[1])
                .fold(0.0, f64::max),
        }
    }
}

fn entry(outcome: &Outcome, robot: &Robot) -> Json {
    let (line, column) = outcome.place;
    let written = outcome.result.as_ref().ok();
    let left = outcome.result.as_ref().err();
    let change = |w: &Written| {
        let pairs = w.corrected.iter().zip(&w.commanded);
        displayed(
            robot,
            &pairs.map(|(to, from)| to - from).collect::<Vec<_>>(),
        )
    };
    object! {
        "name": &outcome.name,
        "line": line,
        "column": column,
        "kind": if outcome.is_pose { "pose" } else { "joints" },
        "corrected": written.is_some(),
        "because": left.map(|l| l.reason.name()),
        "says": left.map(|l| l.explanation.to_string()),
        "q_deg": written.map(|w| displayed(robot, &w.commanded)),
        "change_deg": written.map(change),
        "dir": written.map(|w| w.dir.iter().map(|dir| f64::from(*dir)).collect::<Vec<_>>()),
        "load_kg": written.map(|w| w.load_kg),
        "before_mm": written.map(|w| w.position_mm[0]),
        "after_mm": written.map(|w| w.position_mm[1]),
        "before_mrad": written.map(|w| MRAD * w.rotation_rad[0]),
        "after_mrad": written.map(|w| MRAD * w.rotation_rad[1]),
    }
}

fn placed(all: &[(u64, u64, Text)]) -> Json {
    list(all, |(line, column, says)| {
        object! { "line": *line, "column": *column, "says": says.to_string() }
    })
}
