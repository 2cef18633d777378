//! `truepose-diagnosis/1`: the answer as JSON. Samples count from 1, angles are in degrees.

use crate::diagnosis::{
    Correction, Detectability, Diagnosis, FloorFrom, FoundEffect, Gaps, Limit, NextPose,
    Unexplained,
};
use crate::document::degrees;
use crate::fit::noise::Noise;
use crate::kinematics::{JointKind, Robot};
use crate::model::shapes::Where;
use crate::paper::RegionalStart;
use crate::sessions::Session;
use crate::units::deg_from_rad;

use super::displayed;
use super::json::{Json, keyed, list, object, optional};
use super::kinds;
use super::parts::{not_identifiable, outliers, parameters_by_effect, problems};

/// The document of a diagnosis; `start`: the regional model that it started from, where asked for.
pub fn document(d: &Diagnosis, session: &Session, start: Option<&RegionalStart>) -> Json {
    object! {
        "format": "truepose-diagnosis/1",
        "session": &d.session,
        "samples": d.samples,
        "verdict": d.verdict.name(),
        "stopped": optional(d.stopped.map(crate::diagnosis::Stopped::name)),
        "data_problems": problems(&d.data_problems),
        "floor": object! {
            "mm": d.floor.mm,
            "from": match d.floor.from {
                FloorFrom::Repeats => "repeats",
                FloorFrom::Instrument => "instrument",
                FloorFrom::Estimated => "estimated",
            },
        },
        "gap": gap(Some(d.gap)),
        "held_out": object! { "how": &d.held_out.how, "samples": d.held_out.samples }
            .with(gap(d.held_out.gaps)),
        "identified": parameters_by_effect(&d.identified),
        "not_identifiable": not_identifiable(&d.identification.not_identifiable),
        "found": list(&d.found, found),
        "equivalent": list(&d.equivalent, |e| object! {
            "explanation": &e.explanation,
            "instead": &e.instead,
            "odds": e.odds,
            "separate_by": &e.separate_by,
            "orders": list(&e.orders, |order| Json::from(*order)),
        }),
        "unexplained": unexplained(&d.unexplained),
        "unnamed": d.unnamed.as_ref().map(|u| object! {
            "rms_mm": u.rms_mm,
            "held_out_before_mm": u.held_out_mm[0],
            "held_out_after_mm": u.held_out_mm[1],
            "over": &u.over,
            "says": u.describe(),
            "curve": optional(u.curve.as_ref().and_then(|c| curve(c, session))),
        }),
        "expected_error": super::identification_v1::expected(&d.identification),
        "not_testable": list(&d.not_testable, |n| object! {
            "effect": n.effect,
            "joint": optional(n.joint.map(|j| j + 1)),
            "because": &n.because,
        }),
        "not_found": list(&d.not_found, not_found),
        "outliers": outliers(&d.outliers),
        "excluded": list(&d.identification.excluded(), |sample| Json::from(sample + 1)),
        "next_poses": poses(&d.next_poses, &session.robot),
        "noise": noise(&d.noise),
        "kinds": optional(kinds::rows(&d.identification.kinds)),
        "start": optional(start.map(regional)),
    }
}

fn gap(gaps: Option<Gaps>) -> Json {
    object! {
        "start_mm": gaps.map(|g| g.start_mm),
        "identified_mm": gaps.map(|g| g.identified_mm),
        "end_mm": gaps.map(|g| g.end_mm),
    }
}

fn found(f: &FoundEffect) -> Json {
    let figures = f.figures.iter().map(|(name, value)| {
        object! { "name": *name, "value": *value, "ci95": Json::Null }
    });
    let parameters = f.parameters.iter().map(super::parts::value);
    object! {
        "effect": f.effect,
        "joint": optional(f.joint),
        "parameters": parameters.chain(figures).collect::<Json>(),
        "p_family": f.p_familywise.p,
        "p_family_is_a_bound": f.p_familywise.bound,
        "share": f.share,
        "gap_before_mm": f.gap_mm[0],
        "gap_after_mm": f.gap_mm[1],
        "held_out_before_mm": f.held_out_mm.map(|h| h[0]),
        "held_out_after_mm": f.held_out_mm.map(|h| h[1]),
        "odds_over_next": f.odds_over_next,
        "next": f.next.as_ref(),
        "within_s": f.within_s.map_or(Json::Null, |[from, to]| [from, to].into_iter().collect()),
        "says": &f.explanation,
        "check": f.check,
    }
}

fn unexplained(left: &Unexplained) -> Json {
    object! {
        "present": left.present,
        "p": left.p,
        "rms_mm": left.rms_mm,
        "where": left.place.as_ref().map(|place| match place {
            Where::Range { variable, from, to } => {
                object! { "variable": variable, "from": *from, "to": *to }
            }
            Where::Cycles { variable, cycles_per_turn } => {
                object! { "variable": variable, "cycles_per_turn": *cycles_per_turn }
            }
        }),
        "resembles": &left.resembles,
        "says": &left.description,
        "noise": optional(left.noise.map(|n| {
            object! { "stated_mm": n.stated_mm, "found_mm": n.found_mm }
        })),
    }
}

/// What repeats over the only joint.
fn curve(c: &Correction, session: &Session) -> Option<Json> {
    let knots = c.curve()?.knots();
    let joint = c.term.joint;
    let turns = session.robot.joints[joint].kind == JointKind::Revolute;
    let range = [knots.from, knots.to];
    Some(object! {
        "joint": joint + 1,
        "runs_held_out_mm": optional(c.runs_held_out_mm),
        "values_held_out_mm": optional(c.values_held_out_mm),
        "held_out": &c.how,
        "knots": knots.count,
        "range_deg": optional(turns.then(|| range.map(deg_from_rad))),
        "range_mm": optional((!turns).then_some(range)),
        "period_deg": optional(knots.period.filter(|_| turns).map(deg_from_rad)),
    })
}

/// A parameter that these poses do not show at any size has no limit.
fn not_found(limit: &Limit) -> Json {
    let is_shown = |size: f64| Detectability::of(size) != Detectability::AtNoSize;
    let (mut shown, hidden): (Vec<_>, Vec<_>) = limit
        .sizes
        .iter()
        .map(|(name, size)| (*name, *size))
        .partition(|(_, size)| is_shown(*size));
    shown.sort_by_key(|(name, _)| *name);
    let pairs = shown
        .into_iter()
        .map(|(name, size)| (name.to_owned(), size.into()));
    object! {
        "effect": limit.effect,
        "joint": optional(limit.joint.map(|j| j + 1)),
        "would_have_been_seen_above": keyed(pairs),
        "not_shown_at_any_size": optional(list(hidden, |(name, _)| name.into())),
    }
}

fn noise(noise: &Noise) -> Json {
    object! {
        "sigma_mm": noise.sigma_mm,
        "axes_differ": noise.unequal,
        "slow": noise.slow.map(|slow| object! {
            "rms_mm": slow.rms_mm,
            "time_constant_s": slow.time_constant_s,
            "says": slow.describe().to_string(),
        }),
        "robot_mm": noise.robot_mm,
    }
}

/// Poses to measure next, in the units of the file.
pub(super) fn poses(poses: &[NextPose], robot: &Robot) -> Json {
    let outer = |values: &Vec<f64>| displayed(robot, values);
    list(poses, |p| {
        object! {
            "q_deg": outer(&p.q),
            "dir": &p.dir,
            "target": optional(p.target.as_ref()),
            "target_mm": optional(p.target_mm),
            "speed_deg_s": optional(p.speed.as_ref().map(outer)),
            "load_kg": optional(p.load_kg),
            "temperature_c": optional(p.temperature_c),
            "why": &p.why,
        }
    })
}

/// The paper's regional model, held against the answer.
fn regional(start: &RegionalStart) -> Json {
    let pair = |(theta_rad, l1_mm): (f64, f64)| object! { "theta_rad": theta_rad, "l1_mm": l1_mm };
    let gap = &start.regional.gap;
    let regions = start.regional.regions.iter().zip(&start.of_one_error);
    object! {
        "method": start.regional.method,
        "gap_before_mm": gap.before.rms_mm,
        "gap_mm": gap.after.rms_mm,
        "largest_mm": gap.after.max_mm,
        "turn_deg_per_deg": start.turn,
        "one_correction": pair(start.one_correction),
        "regions": list(regions, |(region, one)| {
            let c = &region.correction;
            object! {
                "name": &c.name,
                "from_deg": degrees(c.from_rad),
                "to_deg": degrees(c.to_rad),
                "samples": c.samples,
                "correction": pair((c.theta_rad, c.l1_mm)),
                "of_one_error": pair(*one),
                "rms_before_mm": region.rms_before_mm,
                "rms_after_mm": region.rms_after_mm,
            }
        }),
        "apart_mm": start.apart_mm,
        "says": &start.summary,
    }
}
