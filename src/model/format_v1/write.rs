//! The document as serde writes it.

use std::collections::BTreeMap;

use serde::Serialize;
use serde::ser::{SerializeMap, Serializer};
use sha2::{Digest, Sha256};

use super::FORMAT;
use super::curve::{self, CurveTwin};
use crate::effects::{Parameter, Setting, Term};
use crate::kinematics::{Range, Robot};
use crate::model::{Calibration, GapStep, RegionalCorrection};
use crate::sessions::format_v1::degrees::degrees;
use crate::sessions::format_v1::layout::write_document;
use crate::sessions::format_v1::write::{RobotTwin, TargetsTwin};

#[derive(Serialize)]
struct ModelTwin<'a> {
    format: &'static str,
    program_version: &'a str,
    session: &'a str,
    samples_hash: &'a str,
    robot: RobotTwin,
    robot_exact: RobotExactTwin,
    targets: TargetsTwin<'a>,
    effects: Vec<TermTwin<'a>>,
    covariance: Option<Vec<Vec<f64>>>,
    regions: Vec<RegionTwin<'a>>,
    measured: Vec<RangeTwin>,
    tolerance_mm: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    compensated_by: Option<&'a str>,
    history: Vec<StepTwin<'a>>,
}

/// What of a robot the session's form may round or normalise.
#[derive(Serialize)]
struct RobotExactTwin {
    joints: Vec<JointExactTwin>,
    tool_quaternion_wxyz: [f64; 4],
}

#[derive(Serialize)]
struct JointExactTwin {
    axis: [f64; 3],
    /// rad or mm.
    limits_inner: Option<[f64; 2]>,
}

#[derive(Serialize)]
struct TermTwin<'a> {
    effect: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    joint: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    setup: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    target: Option<&'a str>,
    #[serde(skip_serializing_if = "Option::is_none")]
    place: Option<&'a str>,
    parameters: ParametersTwin,
    #[serde(skip_serializing_if = "Option::is_none")]
    curve: Option<CurveTwin<'a>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    exact: Option<ExactTwin<'a>>,
}

/// In the order of the catalogue, which a map would lose.
struct ParametersTwin(Vec<Parameter>);

impl Serialize for ParametersTwin {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for parameter in &self.0 {
            map.serialize_entry(parameter.name, &parameter.value)?;
        }
        map.end()
    }
}

#[derive(Serialize)]
struct ExactTwin<'a> {
    setting: f64,
    coefficients: &'a [f64],
}

#[derive(Serialize)]
struct RegionTwin<'a> {
    name: &'a str,
    from_deg: f64,
    to_deg: f64,
    samples: usize,
    correction: CorrectionTwin,
    exact: BTreeMap<&'static str, f64>,
}

#[derive(Serialize)]
struct CorrectionTwin {
    theta_rad: f64,
    l1_mm: f64,
}

/// rad or mm.
#[derive(Serialize)]
struct RangeTwin {
    from_inner: f64,
    to_inner: f64,
}

#[derive(Serialize)]
struct StepTwin<'a> {
    what: &'a str,
    gap_mm: f64,
    held_out_mm: Option<f64>,
}

/// The model as the text of its file.
///
/// # Panics
/// Never: writing to memory does not fail.
pub fn write_model(calibration: &Calibration) -> String {
    let robot = &calibration.model.robot;
    let terms = calibration.model.terms().iter();
    let twin = ModelTwin {
        format: FORMAT,
        program_version: &calibration.program_version,
        session: &calibration.session,
        samples_hash: &calibration.samples_hash,
        robot: RobotTwin::of(robot),
        robot_exact: RobotExactTwin::of(robot),
        targets: TargetsTwin(&calibration.targets),
        effects: terms.map(|term| TermTwin::of(term, robot)).collect(),
        covariance: calibration.covariance.as_ref().map(|c| {
            let rows = c.row_iter();
            rows.map(|row| row.iter().copied().collect()).collect()
        }),
        regions: calibration.regions.iter().map(RegionTwin::of).collect(),
        measured: calibration.measured.iter().map(RangeTwin::of).collect(),
        tolerance_mm: calibration.tolerance_mm,
        compensated_by: calibration.compensated_by.as_deref(),
        history: calibration.history.iter().map(StepTwin::of).collect(),
    };
    let mut text = Vec::new();
    write_document(&mut text, &twin).expect("writing to memory does not fail");
    String::from_utf8(text).expect("JSON is UTF-8")
}

/// SHA-256 of the model's file as the program writes it: 64 hexadecimal digits. A session says
/// with it which model's table was active while it was measured (`compensated_by`).
pub fn model_hash(calibration: &Calibration) -> String {
    let mut hash = String::with_capacity(64);
    for byte in Sha256::digest(write_model(calibration)) {
        for digit in [byte >> 4, byte & 15] {
            hash.push(char::from(b"0123456789abcdef"[usize::from(digit)]));
        }
    }
    hash
}

impl RobotExactTwin {
    fn of(robot: &Robot) -> Self {
        let joint = |joint: &crate::kinematics::Joint| JointExactTwin {
            axis: joint.axis.direction.into_inner().into(),
            limits_inner: joint.limits.map(|limits| [limits.from, limits.to]),
        };
        let turn = robot.base_from_tool.rotation.quaternion();
        Self {
            joints: robot.joints.iter().map(joint).collect(),
            tool_quaternion_wxyz: [turn.w, turn.i, turn.j, turn.k],
        }
    }
}

impl<'a> TermTwin<'a> {
    fn of(term: &'a Term, robot: &Robot) -> Self {
        let about = term.effect.about();
        let kind = robot.joints[term.joint].kind;
        let label = |of: Setting| {
            (about.setting == of)
                .then_some(term.label.as_deref())
                .flatten()
        };
        let parameters = match term.curve() {
            Some(curve) => curve::parameters(curve, kind),
            None => term.parameters_on(kind),
        };
        Self {
            effect: about.id,
            joint: about.per_joint.then_some(term.joint + 1),
            setup: label(Setting::Setup),
            target: label(Setting::Target),
            place: label(Setting::Place),
            parameters: ParametersTwin(parameters),
            curve: term.curve().map(CurveTwin::of),
            exact: term.curve.is_none().then_some(ExactTwin {
                setting: term.setting,
                coefficients: &term.coefficients,
            }),
        }
    }
}

impl<'a> RegionTwin<'a> {
    fn of(region: &'a RegionalCorrection) -> Self {
        Self {
            name: &region.name,
            from_deg: degrees(region.from_rad),
            to_deg: degrees(region.to_rad),
            samples: region.samples,
            correction: CorrectionTwin {
                theta_rad: region.theta_rad,
                l1_mm: region.l1_mm,
            },
            exact: BTreeMap::from([("from_rad", region.from_rad), ("to_rad", region.to_rad)]),
        }
    }
}

impl RangeTwin {
    fn of(range: &Range) -> Self {
        Self {
            from_inner: range.from,
            to_inner: range.to,
        }
    }
}

impl<'a> StepTwin<'a> {
    fn of(step: &'a GapStep) -> Self {
        Self {
            what: &step.what,
            gap_mm: step.gap_mm,
            held_out_mm: step.held_out_mm,
        }
    }
}
