//! `truepose-diagnosis/1`: the answer as JSON. Samples count from 1, angles are in degrees.

use serde::Serialize;

use crate::effects::{Inputs, JointValues};
use crate::fit::Estimate;
use crate::kinematics::{JointKind, Robot};
use crate::sessions::Session;
use crate::units::deg_from_rad;

use super::kinds::{self, KindRow};
use crate::diagnosis::{Diagnosis, FloorFrom, Gaps, Limit, NextPose, Sight, Verdict};
use crate::model::shapes::Where;

mod correction;
mod start;

/// The document.
#[derive(Debug, Serialize)]
pub struct Document {
    format: &'static str,
    session: String,
    samples: usize,
    verdict: &'static str,
    data_problems: Vec<Problem>,
    floor: Floor,
    gap: Gap,
    held_out: HeldOut,
    identified: Vec<Identified>,
    not_identifiable: Vec<NotIdentifiable>,
    found: Vec<Found>,
    equivalent: Vec<Equivalent>,
    unexplained: Unexplained,
    not_testable: Vec<NotTestable>,
    not_found: Vec<NotFound>,
    outliers: Vec<Outlier>,
    next_poses: Vec<Pose>,
    noise: Noise,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    kinds: Vec<KindRow>,
    #[serde(skip_serializing_if = "Option::is_none")]
    start: Option<start::Start>,
}

#[derive(Debug, Serialize)]
struct Problem {
    what: String,
    evidence: String,
    proposal: String,
}

#[derive(Debug, Serialize)]
struct Floor {
    mm: f64,
    from: &'static str,
}

#[derive(Debug, Serialize)]
struct Gap {
    start_mm: Option<f64>,
    identified_mm: Option<f64>,
    end_mm: Option<f64>,
}

#[derive(Debug, Serialize)]
struct HeldOut {
    how: String,
    samples: usize,
    #[serde(flatten)]
    gap: Gap,
}

#[derive(Debug, Serialize)]
struct Parameter {
    name: &'static str,
    value: Option<f64>,
    ci95: Option<[f64; 2]>,
}

#[derive(Debug, Serialize)]
struct Identified {
    effect: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    joint: Option<usize>,
    #[serde(skip_serializing_if = "Option::is_none")]
    setup: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    target: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    place: Option<String>,
    parameters: Vec<Parameter>,
}

#[derive(Debug, Serialize)]
struct NotIdentifiable {
    combination: String,
    because: String,
}

#[derive(Debug, Serialize)]
struct Found {
    effect: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    joint: Option<usize>,
    parameters: Vec<Parameter>,
    p_family: f64,
    p_family_is_a_bound: bool,
    share: f64,
    gap_before_mm: f64,
    gap_after_mm: f64,
    held_out_before_mm: Option<f64>,
    held_out_after_mm: Option<f64>,
    odds_over_next: f64,
    next: Option<String>,
    says: String,
    check: &'static str,
}

#[derive(Debug, Serialize)]
struct Equivalent {
    explanation: Vec<String>,
    instead: Vec<String>,
    odds: f64,
    separate_by: String,
}

#[derive(Debug, Serialize)]
#[serde(untagged)]
enum Place {
    Range {
        variable: String,
        from: f64,
        to: f64,
    },
    Cycles {
        variable: String,
        cycles_per_turn: f64,
    },
}

#[derive(Debug, Serialize)]
struct Unexplained {
    present: bool,
    p: f64,
    rms_mm: f64,
    #[serde(rename = "where")]
    place: Option<Place>,
    resembles: Vec<String>,
    says: String,
    #[serde(skip_serializing_if = "Option::is_none")]
    noise: Option<StatedNoise>,
    /// Only where it was asked for; null where there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    correction: Option<correction::Answer>,
    /// Why there is none.
    #[serde(skip_serializing_if = "Option::is_none")]
    no_correction_because: Option<String>,
}

#[derive(Debug, Serialize)]
struct StatedNoise {
    stated_mm: f64,
    found_mm: f64,
}

#[derive(Debug, Serialize)]
struct NotTestable {
    effect: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    joint: Option<usize>,
    because: String,
}

#[derive(Debug, Serialize)]
struct NotFound {
    effect: &'static str,
    #[serde(skip_serializing_if = "Option::is_none")]
    joint: Option<usize>,
    /// A parameter that these poses do not show at any size has no limit, and is not in here.
    would_have_been_seen_above: serde_json::Map<String, serde_json::Value>,
    #[serde(skip_serializing_if = "Vec::is_empty")]
    not_shown_at_any_size: Vec<&'static str>,
}

impl NotFound {
    fn of(limit: &Limit) -> Self {
        let is_shown = |size: f64| Sight::of(size) != Sight::AtNoSize;
        let (shown, hidden): (Vec<_>, Vec<_>) =
            limit.sizes.iter().partition(|(_, size)| is_shown(*size));
        Self {
            effect: limit.effect,
            joint: limit.joint.map(|j| j + 1),
            would_have_been_seen_above: shown
                .into_iter()
                .map(|(name, size)| (name.to_owned(), size.into()))
                .collect(),
            not_shown_at_any_size: hidden.into_iter().map(|(name, _)| name).collect(),
        }
    }
}

#[derive(Debug, Serialize)]
struct Outlier {
    sample: usize,
    deviation_mm: f64,
}

/// A pose of `next_poses`.
#[derive(Debug, Serialize)]
pub struct Pose {
    q_deg: Vec<f64>,
    dir: Vec<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    target: Option<String>,
    #[serde(skip_serializing_if = "Option::is_none")]
    target_mm: Option<[f64; 3]>,
    #[serde(skip_serializing_if = "Option::is_none")]
    speed_deg_s: Option<Vec<f64>>,
    #[serde(skip_serializing_if = "Option::is_none")]
    load_kg: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    temperature_c: Option<f64>,
    why: String,
}

#[derive(Debug, Serialize)]
struct Noise {
    sigma_mm: [f64; 3],
    axes_differ: bool,
    slow: Option<Slow>,
}

#[derive(Debug, Serialize)]
struct Slow {
    rms_mm: [f64; 3],
    time_constant_s: f64,
    says: String,
}

impl Document {
    /// The document of a diagnosis.
    pub fn new(diagnosis: &Diagnosis, session: &Session) -> Self {
        let d = diagnosis;
        let inputs = Inputs::new(session, JointValues::Commanded);
        Self {
            format: "truepose-diagnosis/1",
            session: d.session.clone(),
            samples: d.samples,
            verdict: match d.verdict {
                Verdict::Noise => "noise",
                Verdict::Explained => "explained",
                Verdict::PartlyExplained => "partly-explained",
                Verdict::Unexplained => "unexplained",
            },
            data_problems: d
                .data_problems
                .iter()
                .map(|p| Problem {
                    what: p.what.clone(),
                    evidence: p.evidence.clone(),
                    proposal: p.proposal.clone(),
                })
                .collect(),
            floor: Floor {
                mm: d.floor.mm,
                from: match d.floor.from {
                    FloorFrom::Repeats => "repeats",
                    FloorFrom::Instrument => "instrument",
                    FloorFrom::Estimated => "estimated",
                },
            },
            gap: gap(Some(d.gap)),
            held_out: HeldOut {
                how: d.held_out.how.clone(),
                samples: d.held_out.samples,
                gap: gap(d.held_out.gaps),
            },
            identified: grouped(&d.identified),
            not_identifiable: d
                .identification
                .not_identifiable
                .iter()
                .map(|n| NotIdentifiable {
                    combination: n.combination.clone(),
                    because: n.because.clone(),
                })
                .collect(),
            found: d.found.iter().map(|f| found(f, d, &inputs)).collect(),
            equivalent: d
                .equivalent
                .iter()
                .map(|e| Equivalent {
                    explanation: e.explanation.clone(),
                    instead: e.instead.clone(),
                    odds: e.odds,
                    separate_by: e.separate_by.clone(),
                })
                .collect(),
            unexplained: Unexplained {
                present: d.unexplained.present,
                p: d.unexplained.p,
                rms_mm: d.unexplained.rms_mm,
                place: d.unexplained.place.clone().map(place),
                resembles: d.unexplained.resembles.clone(),
                says: d.unexplained.says.clone(),
                noise: d.unexplained.noise.map(|n| StatedNoise {
                    stated_mm: n.stated_mm,
                    found_mm: n.found_mm,
                }),
                correction: correction::Answer::of(&d.unexplained, session),
                no_correction_because: match &d.unexplained.correction {
                    Some(Err(because)) => Some(because.clone()),
                    _ => None,
                },
            },
            not_testable: d
                .not_testable
                .iter()
                .map(|n| NotTestable {
                    effect: n.effect,
                    joint: n.joint.map(|j| j + 1),
                    because: n.because.clone(),
                })
                .collect(),
            not_found: d.not_found.iter().map(NotFound::of).collect(),
            outliers: d
                .outliers
                .iter()
                .map(|o| Outlier {
                    sample: o.sample + 1,
                    deviation_mm: o.deviation_mm,
                })
                .collect(),
            next_poses: poses(&d.next_poses, &session.robot),
            noise: noise(&d.noise),
            kinds: kinds::rows(&d.identification.kinds),
            start: None,
        }
    }
}

fn noise(noise: &crate::fit::noise::Noise) -> Noise {
    Noise {
        sigma_mm: noise.sigma_mm,
        axes_differ: noise.unequal,
        slow: noise.slow.map(|slow| Slow {
            rms_mm: slow.rms_mm,
            time_constant_s: slow.time_constant_s,
            says: slow.says(),
        }),
    }
}

/// Poses in the units of the file.
pub fn poses(poses: &[NextPose], robot: &Robot) -> Vec<Pose> {
    let unit = |(joint, v): (usize, &f64)| match robot.joints[joint].kind {
        JointKind::Revolute => deg_from_rad(*v),
        JointKind::Prismatic => *v,
    };
    poses
        .iter()
        .map(|p| Pose {
            q_deg: p.q.iter().enumerate().map(unit).collect(),
            dir: p.dir.clone(),
            target: p.target.clone(),
            target_mm: p.target_mm,
            speed_deg_s: p
                .speed
                .as_ref()
                .map(|s| s.iter().enumerate().map(unit).collect()),
            load_kg: p.load_kg,
            temperature_c: p.temperature_c,
            why: p.why.clone(),
        })
        .collect()
}

fn gap(gaps: Option<Gaps>) -> Gap {
    Gap {
        start_mm: gaps.map(|g| g.start_mm),
        identified_mm: gaps.map(|g| g.identified_mm),
        end_mm: gaps.map(|g| g.end_mm),
    }
}

fn parameter(estimate: &Estimate) -> Parameter {
    Parameter {
        name: estimate.name,
        value: Some(estimate.value),
        ci95: estimate.ci95,
    }
}

fn grouped(estimates: &[Estimate]) -> Vec<Identified> {
    let mut all: Vec<Identified> = Vec::new();
    for estimate in estimates {
        let place = (&estimate.setup, &estimate.target, &estimate.place);
        let same = |i: &&mut Identified| {
            i.effect == estimate.effect
                && i.joint == estimate.joint
                && (&i.setup, &i.target, &i.place) == place
        };
        match all.iter_mut().find(same) {
            Some(one) => one.parameters.push(parameter(estimate)),
            None => all.push(Identified {
                effect: estimate.effect,
                joint: estimate.joint,
                setup: estimate.setup.clone(),
                target: estimate.target.clone(),
                place: estimate.place.clone(),
                parameters: vec![parameter(estimate)],
            }),
        }
    }
    all
}

fn found(f: &crate::diagnosis::Found, d: &Diagnosis, inputs: &Inputs) -> Found {
    let joint = f.joint.map_or(0, |joint| joint - 1);
    let figures = d.model.figures_of(f.effect, joint, inputs).into_iter();
    let figures = figures.map(|(name, value)| Parameter {
        name,
        value,
        ci95: None,
    });
    Found {
        effect: f.effect,
        joint: f.joint,
        parameters: f.parameters.iter().map(parameter).chain(figures).collect(),
        p_family: f.p_family.p,
        p_family_is_a_bound: f.p_family.bound,
        share: f.share,
        gap_before_mm: f.gap_mm[0],
        gap_after_mm: f.gap_mm[1],
        held_out_before_mm: f.held_out_mm.map(|h| h[0]),
        held_out_after_mm: f.held_out_mm.map(|h| h[1]),
        odds_over_next: f.odds_over_next,
        next: f.next.clone(),
        says: f.says.clone(),
        check: f.check,
    }
}

fn place(place: Where) -> Place {
    match place {
        Where::Range { variable, from, to } => Place::Range { variable, from, to },
        Where::Cycles {
            variable,
            cycles_per_turn,
        } => Place::Cycles {
            variable,
            cycles_per_turn,
        },
    }
}
