//! `truepose-standards/1`: the figures as JSON, under the standards' symbols.
//!
//! `iso_230_2`: per joint (counted from 1) and series of like conditions, `before` and `after` hold
//! `B`, `B_mean`, `R_up`, `R_down`, `R`, `E_up`, `E_down`, `E`, `M`, `A_up`, `A_down`, `A` in the
//! joint's `unit` (`arcsec` or `mm`) and the `positions` they come from. `iso_9283`: `poses` with
//! `AP…` and `RP…`, `variations` with `vAP_p_mm`, `paths` with `AT…` and `RT…` (`first_samples`: where
//! each cycle begins, from 1), and the `largest` of each. A figure that the
//! session cannot give is null, and `missing` says why. `after` is null without a model.

use serde::Serialize;

use super::axis::{AxisTest, Series};
use super::path::{PathAttained, PathFigures};
use super::pose::{Attained, Largest, PoseFigures, PoseTest, Turned, Variation};
use super::positioning::{AtPosition, Positioning};
use super::{Standards, axis, pose};
use crate::document::{Value, object};

/// The document.
#[derive(Debug, Serialize)]
#[serde(transparent)]
pub struct Document(Value);

impl Document {
    /// The document of some figures.
    pub fn new(s: &Standards) -> Self {
        Self(object! {
            "format": "truepose-standards/1",
            "session": &s.session,
            "samples": s.samples,
            "left_out": s.left_out,
            "iso_230_2": object! {
                "standard_runs": axis::STANDARD_RUNS,
                "axes": all(&s.axes, axis_test),
            },
            "iso_9283": poses(&s.poses, s.compensated),
            "notes": all(&s.notes, Value::from),
        })
    }
}

fn all<'a, T>(list: &'a [T], one: impl Fn(&'a T) -> Value) -> Value {
    list.iter().map(one).collect()
}

fn axis_test(axis: &AxisTest) -> Value {
    object! {
        "joint": axis.joint + 1,
        "name": &axis.name,
        "kind": axis.kind.name(),
        "unit": axis.unit,
        "position_unit": axis.position_unit,
        "series": all(&axis.series, series),
        "series_not_listed": axis.more,
        "missing": axis.missing.as_ref(),
    }
}

fn series(series: &Series) -> Value {
    let fixed = &series.fixed;
    object! {
        "conditions": object! {
            "target": fixed.target.as_ref(),
            "load_kg": fixed.load_kg,
            "speed_per_s": fixed.speed,
            "setup": fixed.setup.as_ref(),
            "other_joints": fixed.others.as_slice(),
        },
        "runs": series.before.fewest_runs(),
        "before": figures(&series.before),
        "after": series.after.as_ref().map(figures),
        "missing": all(&series.missing, Value::from),
    }
}

fn figures(p: &Positioning) -> Value {
    object! {
        "B": p.reversal,
        "B_mean": p.mean_reversal,
        "R_up": p.repeatability[0],
        "R_down": p.repeatability[1],
        "R": p.repeatability_of_both,
        "E_up": p.systematic[0],
        "E_down": p.systematic[1],
        "E": p.systematic_of_both,
        "M": p.mean_range,
        "A_up": p.accuracy[0],
        "A_down": p.accuracy[1],
        "A": p.accuracy_of_both,
        "positions": all(&p.positions, position),
    }
}

fn position(p: &AtPosition) -> Value {
    object! {
        "commanded": p.commanded,
        "runs": p.runs,
        "mean_up": p.mean[0],
        "mean_down": p.mean[1],
        "s_up": p.deviation[0],
        "s_down": p.deviation[1],
        "R_up": p.repeatability[0],
        "R_down": p.repeatability[1],
        "mean": p.mean_of_both,
        "B": p.reversal,
        "R": p.repeatability_of_both,
    }
}

fn poses(test: &PoseTest, compensated: bool) -> Value {
    object! {
        "standard_cycles": pose::STANDARD_CYCLES,
        "largest": object! {
            "before": largest(&test.largest(false)),
            "after": compensated.then(|| largest(&test.largest(true))),
        },
        "poses": all(&test.poses, pose_figures),
        "variations": all(&test.variations, variation),
        "paths": all(&test.paths, path),
        "missing": all(&test.missing, Value::from),
    }
}

fn largest(largest: &Largest) -> Value {
    object! {
        "AP_p_mm": largest.accuracy,
        "RP_l_mm": largest.repeatability,
        "vAP_p_mm": largest.variation,
        "AT_p_mm": largest.path_accuracy,
        "RT_p_mm": largest.path_repeatability,
    }
}

fn pose_figures(pose: &PoseFigures) -> Value {
    let turned = |t: &Turned| {
        let ([a, b, c], [ra, rb, rc]) = (t.accuracy, t.repeatability);
        object! {
            "AP_a_deg": a, "AP_b_deg": b, "AP_c_deg": c,
            "RP_a_deg": ra, "RP_b_deg": rb, "RP_c_deg": rc,
        }
    };
    object! {
        "q": pose.q.as_slice(),
        "dir": pose.dir.as_slice(),
        "target": pose.target.as_ref(),
        "load_kg": pose.load_kg,
        "cycles": pose.cycles,
        "before": attained(&pose.before),
        "after": pose.after.as_ref().map(attained),
        "orientation": pose.orientation.as_ref().map(turned),
    }
}

fn path(path: &PathFigures) -> Value {
    let attained = |a: &PathAttained| object! { "AT_p_mm": a.accuracy, "RT_p_mm": a.repeatability };
    let turned = |t: &Turned| {
        let ([a, b, c], [ra, rb, rc]) = (t.accuracy, t.repeatability);
        object! {
            "AT_a_deg": a, "AT_b_deg": b, "AT_c_deg": c,
            "RT_a_deg": ra, "RT_b_deg": rb, "RT_c_deg": rc,
        }
    };
    object! {
        "first_samples": path.starts.iter().map(|i| i + 1).collect::<Value>(),
        "cycles": path.starts.len(),
        "points": path.points,
        "length_mm": path.length_mm,
        "load_kg": path.load_kg,
        "before": attained(&path.before),
        "after": path.after.as_ref().map(attained),
        "orientation": path.orientation.as_ref().map(turned),
    }
}

fn attained(a: &Attained) -> Value {
    let [x, y, z] = a.accuracy_axes;
    object! {
        "AP_p_mm": a.accuracy,
        "AP_x_mm": x,
        "AP_y_mm": y,
        "AP_z_mm": z,
        "RP_l_mm": a.repeatability,
        "mean_l_mm": a.mean_distance,
        "S_l_mm": a.deviation,
    }
}

fn variation(v: &Variation) -> Value {
    object! {
        "q": v.q.as_slice(),
        "target": v.target.as_ref(),
        "directions": v.directions,
        "vAP_p_before_mm": v.before,
        "vAP_p_after_mm": v.after,
    }
}
