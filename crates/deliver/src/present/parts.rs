//! Parts that several JSON documents have.

use super::json::{Json, list, object, optional};
use crate::fit::{Estimate, NotIdentifiable, Outlier};
use crate::kinematics::Pose;
use crate::set_up_errors::DataProblem;
use crate::standards::grouping::gathered;

/// Set-up errors.
pub(super) fn problems(all: &[DataProblem]) -> Json {
    list(all, |p| {
        object! {
            "what": p.what.to_string(),
            "evidence": p.evidence.to_string(),
            "proposal": p.proposal.to_string(),
        }
    })
}

/// What the samples do not determine.
pub(super) fn not_identifiable(all: &[NotIdentifiable]) -> Json {
    list(all, |n| {
        object! { "combination": &n.combination, "because": &n.because }
    })
}

/// Outliers; samples are counted from 1 where people and other programs read them.
pub(super) fn outliers(all: &[Outlier]) -> Json {
    list(all, |o| {
        object! { "sample": o.sample + 1, "deviation_mm": o.deviation_mm }
    })
}

/// Which parameter it is.
pub(super) fn which(one: &Estimate) -> Json {
    object! { "effect": one.effect, "joint": one.joint }.with(object! {
        "setup": optional(one.setup.as_ref()),
        "target": optional(one.target.as_ref()),
        "place": optional(one.place.as_ref()),
        "name": one.name,
    })
}

/// A parameter's name, value and interval.
pub(super) fn value(one: &Estimate) -> Json {
    object! { "name": one.name, "value": one.value, "ci95": one.ci95 }
}

/// Parameters, those of one effect in one place together.
pub(super) fn parameters_by_effect(estimates: &[Estimate]) -> Json {
    let place = |e: &Estimate| {
        (
            e.effect,
            e.joint,
            e.setup.clone(),
            e.target.clone(),
            e.place.clone(),
        )
    };
    let groups = gathered(estimates.iter().map(|one| (place(one), one)));
    list(groups, |(_, group)| {
        let one = group[0];
        object! {
            "effect": one.effect,
            "joint": optional(one.joint),
            "setup": optional(one.setup.as_ref()),
            "target": optional(one.target.as_ref()),
            "place": optional(one.place.as_ref()),
            "parameters": list(group, value),
        }
    })
}

/// A place and a rotation.
pub(super) fn pose(pose: &Pose) -> Json {
    let place: [f64; 3] = pose.translation.vector.into();
    let q = pose.rotation.quaternion();
    object! { "position_mm": place, "quaternion_wxyz": [q.w, q.i, q.j, q.k] }
}
