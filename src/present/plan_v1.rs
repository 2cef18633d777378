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

use serde::Serialize;

use super::diagnosis_v1::{Pose, poses};
use crate::design::geometry::Geometry;
use crate::design::needs::Untestable;
use crate::design::outlook::ExpectedError;
use crate::design::pair_separation::Separation;
use crate::design::plan::{Plan, Subject};

/// The document.
#[derive(Debug, Serialize)]
pub struct Document {
    format: &'static str,
    #[serde(rename = "for")]
    subject: &'static str,
    name: String,
    sigma_mm: f64,
    poses: Vec<Pose>,
    separates: Vec<Open>,
    separation: Option<Between>,
    unlocks: Vec<UntestableEntry>,
    cannot: Vec<UntestableEntry>,
    will_be_seen_above: Vec<Seen>,
    alike: Vec<Alike>,
    geometry: Option<OfGeometry>,
}

#[derive(Debug, Serialize)]
struct OfGeometry {
    parameters: usize,
    before_is: &'static str,
    observability_mm: BeforeAfter<f64>,
    expected_error: BeforeAfter<Error>,
    enough: Option<Enough>,
    curve: Vec<AtPoses>,
}

#[derive(Debug, Serialize)]
struct BeforeAfter<T> {
    before: T,
    after: T,
}

#[derive(Debug, Serialize)]
struct Error {
    rms_mm: f64,
    p95_mm: f64,
}

#[derive(Debug, Serialize)]
struct Enough {
    accuracy_mm: f64,
    poses: usize,
}

#[derive(Debug, Serialize)]
struct AtPoses {
    poses: usize,
    #[serde(flatten)]
    error: Error,
}

#[derive(Debug, Serialize)]
struct Open {
    explanation: Vec<String>,
    instead: Vec<String>,
}

#[derive(Debug, Serialize)]
struct Named {
    effect: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    joint: Option<usize>,
}

#[derive(Debug, Serialize)]
struct Between {
    between: Vec<Named>,
    possible: bool,
    because: Option<String>,
    decided: bool,
    share_left_before: [f64; 2],
    share_left_after: [f64; 2],
}

#[derive(Debug, Serialize)]
struct UntestableEntry {
    #[serde(flatten)]
    named: Named,
    because: String,
    #[serde(rename = "do")]
    needs: Vec<&'static str>,
}

#[derive(Debug, Serialize)]
struct Seen {
    #[serde(flatten)]
    named: Named,
    sizes: serde_json::Map<String, serde_json::Value>,
}

#[derive(Debug, Serialize)]
struct Alike {
    effects: [&'static str; 2],
    joints: [Option<usize>; 2],
    correlation: f64,
}

impl Document {
    /// The document of a plan.
    pub fn new(plan: &Plan) -> Self {
        Self {
            format: "truepose-plan/1",
            subject: match plan.subject {
                Subject::Session => "session",
                Subject::Robot => "robot",
            },
            name: plan.name.clone(),
            sigma_mm: plan.sigma_mm,
            poses: poses(&plan.poses, &plan.robot),
            separates: plan
                .open
                .iter()
                .map(|[explanation, instead]| Open {
                    explanation: explanation.clone(),
                    instead: instead.clone(),
                })
                .collect(),
            separation: plan.separation.as_ref().map(between),
            unlocks: plan.enables.iter().map(untestable_entry).collect(),
            cannot: plan.cannot.iter().map(untestable_entry).collect(),
            will_be_seen_above: seen(plan),
            alike: plan
                .expected
                .alike
                .iter()
                .map(|a| Alike {
                    effects: [a.one.0, a.other.0],
                    joints: [a.one.1, a.other.1].map(|j| j.map(|j| j + 1)),
                    correlation: a.correlation,
                })
                .collect(),
            geometry: plan.geometry.as_ref().map(|g| of_geometry(g, plan.subject)),
        }
    }
}

fn of_geometry(geometry: &Geometry, subject: Subject) -> OfGeometry {
    let (before, after) = (&geometry.before, &geometry.after);
    let error = |e: &ExpectedError| Error {
        rms_mm: e.rms_mm,
        p95_mm: e.p95_mm,
    };
    let curve = geometry.curve.iter();
    OfGeometry {
        parameters: geometry.parameters,
        before_is: match subject {
            Subject::Session => "session",
            Subject::Robot => "random poses",
        },
        observability_mm: BeforeAfter {
            before: before.observability,
            after: after.observability,
        },
        expected_error: BeforeAfter {
            before: error(&before.error),
            after: error(&after.error),
        },
        enough: geometry
            .enough
            .map(|(accuracy_mm, poses)| Enough { accuracy_mm, poses }),
        curve: curve
            .map(|(poses, e)| AtPoses {
                poses: *poses,
                error: error(e),
            })
            .collect(),
    }
}

fn between(separation: &Separation) -> Between {
    let named = |n: &crate::design::pair_separation::Named| Named {
        effect: n.id,
        joint: n.per_joint().then_some(n.joint + 1),
    };
    Between {
        between: separation.between.iter().map(named).collect(),
        possible: separation.impossible.is_none(),
        because: separation.impossible.clone(),
        decided: separation.decided,
        share_left_before: separation.left_before,
        share_left_after: separation.left_after,
    }
}

fn untestable_entry(untestable: &Untestable) -> UntestableEntry {
    UntestableEntry {
        named: Named {
            effect: untestable.effect,
            joint: untestable.joint.map(|j| j + 1),
        },
        because: untestable.because.clone(),
        needs: untestable.needs.iter().map(|n| n.says()).collect(),
    }
}

fn seen(plan: &Plan) -> Vec<Seen> {
    let one = |limit: crate::design::plan::SeenAbove| Seen {
        named: Named {
            effect: limit.effect,
            joint: limit.joint,
        },
        sizes: limit
            .sizes
            .into_iter()
            .map(|(name, size)| (name.to_owned(), size.into()))
            .collect(),
    };
    plan.seen_above().into_iter().map(one).collect()
}
