//! `truepose-identification/1`: what an identification answers as JSON. Samples count from 1.

use super::displayed;
use super::json::{Json, list, object, optional};
use super::kinds;
use super::parts::{not_identifiable, outliers, problems, which};
use crate::fit::expected::Expected;
use crate::fit::levels::Level;
use crate::fit::{Estimate, Gap, Identification, RegionResult};
use crate::kinematics::Robot;
use crate::set_up_errors::DataProblem;
use crate::units::deg_from_rad;

/// The document of an identification, with the set-up errors that were noticed.
pub fn document(answer: &Identification, data_problems: &[DataProblem]) -> Json {
    let quality = &answer.quality;
    object! {
        "format": "truepose-identification/1",
        "session": &answer.session,
        "method": answer.method,
        "samples": answer.samples,
        "regions": optional(list(&answer.regions, region)),
        "parameters": if answer.method == "exact" {
            list(&answer.parameters, parameter)
        } else {
            Json::Absent
        },
        "not_identifiable": not_identifiable(&answer.not_identifiable),
        "data_problems": problems(data_problems),
        "gap": gap(&answer.gap),
        "kinds": optional(kinds::rows(&answer.kinds)),
        "held_out": optional(answer.held_out.as_ref().map(|held_out| {
            object! { "samples": held_out.samples }.with(gap(held_out))
        })),
        // What each level of correction would bring, and the error to be expected over the joint ranges;
        // of several joints.
        "levels": optional(list(&answer.levels, level)),
        "expected_error": expected(answer),
        "outliers": outliers(&answer.outliers),
        "left_out": list(&answer.left_out, |l| {
            object! { "sample": l.sample + 1, "because": l.because.describe() }
        }),
        "noise_mm": answer.noise_mm,
        "solver": object! {
            "converged": quality.converged,
            "stopped": quality.stopped,
            "passes": quality.passes,
            "coefficients": quality.coefficients,
            "rank": quality.rank,
            "condition": quality.condition,
        },
        "notes": &answer.notes,
    }
}

/// A parameter with its interval.
pub fn parameter(one: &Estimate) -> Json {
    which(one).with(object! {
        "value": one.value,
        "ci95": one.ci95,
        "implausible": optional(one.implausible().map(|says| says.to_string())),
    })
}

fn region(r: &RegionResult) -> Json {
    let c = &r.correction;
    object! {
        "name": &c.name,
        "from_deg": degrees(c.from_rad),
        "to_deg": degrees(c.to_rad),
        "samples": c.samples,
        "correction": object! { "theta_rad": c.theta_rad, "l1_mm": c.l1_mm },
        "ci95": object! { "theta_rad": r.theta_ci95, "l1_mm": r.l1_ci95 },
        "rms_before_mm": r.rms_before_mm,
        "rms_after_mm": r.rms_after_mm,
    }
}

fn gap(gap: &Gap) -> Json {
    object! {
        "before_mm": gap.before.rms_mm,
        "after_mm": gap.after.rms_mm,
        "max_before_mm": gap.before.max_mm,
        "max_after_mm": gap.after.max_mm,
    }
}

fn level(level: &Level) -> Json {
    object! {
        "level": level.what,
        "parameters": level.parameters,
        "rms_mm": level.rms_mm,
        "cross_validated": level.cross_validated.map(|e| object! {
            "mean_mm": e.mean_mm,
            "rms_mm": e.rms_mm,
            "p95_mm": e.p95_mm,
            "max_mm": e.max_mm,
        }),
    }
}

/// The error to be expected over the joint ranges; nothing where it is not known.
pub(super) fn expected(answer: &Identification) -> Json {
    optional(answer.expected.as_ref().map(|e| {
        object! {
            "rms_mm": e.rms_mm,
            "max_mm": e.max_mm,
            "worst_q_deg": worst_pose(e, &answer.model.robot),
            "at_measured_poses_mm": e.measured_rms_mm,
            "poorly_observed": e.extrapolates(),
        }
    }))
}

/// The joint values where the largest error is expected, as a session's file has them.
pub fn worst_pose(expected: &Expected, robot: &Robot) -> Vec<f64> {
    displayed(robot, &expected.worst_q)
}

/// Degrees as a person wrote them: the conversion to radians and back can cost the last bit.
pub fn degrees(rad: f64) -> f64 {
    (deg_from_rad(rad) * 1e9).round() / 1e9
}
