//! `truepose-plan/1`: a plan as JSON.
//!
//! ```json
//! { "format": "truepose-plan/1", "for": "session | robot", "name": "…", "sigma_mm": 0.03,
//!   "poses": [ { "q_deg": [45.0], "dir": [-1], "target": "T2", "target_mm": [270, 0, 120],
//!                "speed_deg_s": [-20], "load_kg": 3, "temperature_c": 26, "why": "…" } ],
//!   "separates": [ { "explanation": ["base-offset"], "instead": ["bearing-runout"] } ],
//!   "separation": { "between": [ { "effect": "backlash", "joint": 1 }, … ], "possible": true,
//!                   "because": null, "decided": true,
//!                   "share_left_before": [0.0, 0.0], "share_left_after": [0.7, 0.7] },
//!   "unlocks": [ { "effect": "backlash", "joint": 1, "because": "…", "do": ["…"] } ],
//!   "cannot": [ { "effect": "joint-compliance", "joint": 1, "because": "…", "do": [] } ],
//!   "will_be_seen_above": [ { "effect": "backlash", "joint": 1, "sizes": { "width_deg": 0.01 } } ],
//!   "alike": [ { "effects": ["backlash", "lost-motion"], "joints": [1, 1], "correlation": 0.97 } ],
//!   "geometry": { "parameters": 33, "before_is": "session | random poses",
//!                 "observability_mm": { "before": 40.1, "after": 60.2 },
//!                 "expected_error": { "before": { "rms_mm": 0.05, "p95_mm": 0.08 },
//!                                     "after": { "rms_mm": 0.02, "p95_mm": 0.03 } },
//!                 "enough": { "accuracy_mm": 0.05, "poses": 34 },
//!                 "curve": [ { "poses": 20, "rms_mm": 0.06, "p95_mm": 0.09 } ] } }
//! ```
//!
//! - `poses` in measuring order, with the keys of a diagnosis's `next_poses`; the values of a
//!   sliding joint are in mm and mm/s. `temperature_c` is what to aim at: write down what it was.
//! - `separates`: what the session leaves ambiguous and the poses decide. `separation` is null
//!   without `--separate`; a share is the part of an effect (squared) that the other, refitted,
//!   cannot imitate; `decided`: at the size at which each would just be seen.
//! - `unlocks`: what the session cannot show and can with the poses; `do` is what makes the
//!   difference. `cannot`: what stays untestable and why; `do` says what would help beside poses,
//!   and is empty where nothing does.
//! - `will_be_seen_above`: detection limits (95 %) once the poses are measured, for noise of
//!   `sigma_mm` on every axis. `alike`: pairs that will be hard to tell apart. Both are empty where the
//!   session has no points.
//! - `geometry` is null for a single joint and with `--separate`. `before` is with the session alone, for a
//!   robot with random poses of the same number (the mean of several sets). The observability index is that of
//!   Borm and Menq; an expected error is that of the model over the joint ranges, root mean square and 95th
//!   percentile, from the noise and the number of poses alone. `enough` is null without `--accuracy`; `curve`
//!   says the error with other numbers of poses, beside the session.

use super::diagnosis_v1::poses;
use super::json::{Json, keyed, list, object, optional};
use crate::design::{ExpectedError, Geometry, Plan, Separation, Subject, Untestable};

/// The document of a plan.
pub fn document(plan: &Plan) -> Json {
    object! {
        "format": "truepose-plan/1",
        "for": match plan.subject {
            Subject::Session => "session",
            Subject::Robot => "robot",
        },
        "name": &plan.name,
        "sigma_mm": plan.sigma_mm,
        "poses": poses(&plan.poses, &plan.robot),
        "separates": list(&plan.open, |[explanation, instead]| {
            object! { "explanation": explanation, "instead": instead }
        }),
        "separation": plan.separation.as_ref().map(separation),
        "unlocks": list(&plan.enables, untestable),
        "cannot": list(&plan.cannot, untestable),
        "will_be_seen_above": list(&plan.expected.limits, |limit| {
            let mut sizes = limit.sizes.clone();
            sizes.sort_by_key(|(name, _)| *name);
            let sizes = sizes.into_iter().map(|(name, size)| (name.to_owned(), size.into()));
            named(limit.effect, limit.joint).with(object! { "sizes": keyed(sizes) })
        }),
        "alike": list(&plan.expected.alike, |a| object! {
            "effects": [a.one.0, a.other.0],
            "joints": [a.one.1, a.other.1].map(|j| j.map(|j| j + 1)),
            "correlation": a.correlation,
        }),
        "geometry": plan.geometry.as_ref().map(|g| geometry(g, plan.subject)),
    }
}

/// An effect with its joint, which is counted from 0.
fn named(effect: &str, joint: Option<usize>) -> Json {
    object! { "effect": effect, "joint": optional(joint.map(|j| j + 1)) }
}

fn geometry(geometry: &Geometry, subject: Subject) -> Json {
    let (before, after) = (&geometry.before, &geometry.after);
    let error = |e: &ExpectedError| object! { "rms_mm": e.rms_mm, "p95_mm": e.p95_mm };
    object! {
        "parameters": geometry.parameters,
        "before_is": match subject {
            Subject::Session => "session",
            Subject::Robot => "random poses",
        },
        "observability_mm": object! { "before": before.observability, "after": after.observability },
        "expected_error": object! { "before": error(&before.error), "after": error(&after.error) },
        "enough": geometry.enough.map(|(accuracy_mm, poses)| {
            object! { "accuracy_mm": accuracy_mm, "poses": poses }
        }),
        "curve": list(&geometry.curve, |(poses, e)| object! { "poses": *poses }.with(error(e))),
    }
}

fn separation(separation: &Separation) -> Json {
    object! {
        "between": list(&separation.between, |(effect, joint)| named(effect, *joint)),
        "possible": separation.impossible.is_none(),
        "because": separation.impossible.as_ref(),
        "decided": separation.decided,
        "share_left_before": &separation.left_before[..],
        "share_left_after": &separation.left_after[..],
    }
}

fn untestable(one: &Untestable) -> Json {
    named(one.effect, one.joint).with(object! {
        "because": &one.because,
        "do": list(&one.needs, |need| need.describe().into()),
    })
}
