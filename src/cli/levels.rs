//! What each level of correction would bring, and how sure the model is where the robot works, as
//! `identify` states them.

use std::fmt::Write as _;

use serde::Serialize;

use truepose::fit::Identification;
use truepose::fit::expected::Expected;
use truepose::fit::levels::{Errors, Level};
use truepose::kinematics::{JointKind, Robot};
use truepose::units::deg_from_rad;

/// One of `levels`.
#[derive(Serialize)]
pub(super) struct Row {
    level: &'static str,
    parameters: usize,
    rms_mm: f64,
    cross_validated: Option<ErrorsRow>,
}

#[derive(Serialize)]
struct ErrorsRow {
    mean_mm: f64,
    rms_mm: f64,
    p95_mm: f64,
    max_mm: f64,
}

/// `expected_error`.
#[derive(Serialize)]
pub(super) struct ExpectedRow {
    rms_mm: f64,
    max_mm: f64,
    worst_q_deg: Vec<f64>,
    at_measured_poses_mm: f64,
    poorly_observed: bool,
}

pub(super) fn rows(answer: &Identification) -> Vec<Row> {
    let errors = |e: Errors| ErrorsRow {
        mean_mm: e.mean_mm,
        rms_mm: e.rms_mm,
        p95_mm: e.p95_mm,
        max_mm: e.max_mm,
    };
    let row = |level: &Level| Row {
        level: level.what,
        parameters: level.parameters,
        rms_mm: level.rms_mm,
        cross_validated: level.cross_validated.map(errors),
    };
    answer.levels.iter().map(row).collect()
}

pub(super) fn expected_row(answer: &Identification) -> Option<ExpectedRow> {
    answer.expected.as_ref().map(|e| ExpectedRow {
        rms_mm: e.rms_mm,
        max_mm: e.max_mm,
        worst_q_deg: in_file_units(e, &answer.model.robot),
        at_measured_poses_mm: e.measured_rms_mm,
        poorly_observed: e.extrapolates(),
    })
}

/// Joint values as a session's file has them.
fn in_file_units(expected: &Expected, robot: &Robot) -> Vec<f64> {
    let unit = |(q, joint): (&f64, &truepose::kinematics::Joint)| match joint.kind {
        JointKind::Revolute => deg_from_rad(*q),
        JointKind::Prismatic => *q,
    };
    expected
        .worst_q
        .iter()
        .zip(&robot.joints)
        .map(unit)
        .collect()
}

/// Both in words; empty where there is nothing to say.
pub(super) fn in_words(answer: &Identification) -> String {
    let mut text = String::new();
    if !answer.levels.is_empty() {
        let _ = writeln!(
            text,
            "\n{:<48} {:>10} {:>9}   cross-validated, mm\n{:<48} {:>10} {:>9} {:>9} {:>9} {:>9} {:>9}",
            "level of correction",
            "parameters",
            "RMS, mm",
            "",
            "",
            "",
            "mean",
            "RMS",
            "95 %",
            "largest"
        );
    }
    for level in &answer.levels {
        let _ = write!(
            text,
            "{:<48} {:>10} {:>9.4}",
            level.what, level.parameters, level.rms_mm
        );
        if let Some(e) = &level.cross_validated {
            let _ = write!(
                text,
                " {:>9.4} {:>9.4} {:>9.4} {:>9.4}",
                e.mean_mm, e.rms_mm, e.p95_mm, e.max_mm
            );
        }
        text.push('\n');
    }
    if let Some(e) = &answer.expected {
        let _ = writeln!(
            text,
            "expected error of the model over the joint ranges: RMS {:.4} mm, largest {:.4} mm; at the measured poses {:.4} mm",
            e.rms_mm, e.max_mm, e.measured_rms_mm
        );
        if e.extrapolates() {
            let q = in_file_units(e, &answer.model.robot);
            let q: Vec<String> = q.iter().map(|v| format!("{v:.0}")).collect();
            let _ = writeln!(
                text,
                "poorly observed: the measured poses show little of the joint ranges; measure near {} as well (`truepose plan` proposes poses)",
                q.join(", ")
            );
        }
    }
    text
}
