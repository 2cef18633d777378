//! `truepose-standards/1`: the figures as JSON, under the standards' symbols.
//!
//! `iso_230_2`: per joint (counted from 1) and series of like conditions, `before` and `after` hold
//! `B`, `B_mean`, `R_up`, `R_down`, `R`, `E_up`, `E_down`, `E`, `M`, `A_up`, `A_down`, `A` in the
//! joint's `unit` (`arcsec` or `mm`) and the `positions` they come from. `iso_9283`: `poses` with
//! `AP…` and `RP…`, `variations` with `vAP_p_mm`, `paths` with `AT…` and `RT…` (`first_samples`: where
//! each cycle begins, from 1), and the `largest` of each. A figure that the
//! session cannot give is null, and `missing` says why. `after` is null without a model.

use super::json::{Json, keyed, list, object};
use crate::standards::axis::{AxisTest, STANDARD_RUNS, Series};
use crate::standards::path::{PathAttained, PathFigures};
use crate::standards::pose::{Largest, PoseFigures, PoseTest, STANDARD_CYCLES};
use crate::standards::positioning::{AtPosition, Positioning};
use crate::standards::{Attained, Standards, Turned};

/// The document of some figures.
pub fn document(s: &Standards) -> Json {
    object! {
        "format": "truepose-standards/1",
        "session": &s.session,
        "samples": s.samples,
        "left_out": s.left_out,
        "iso_230_2": object! { "standard_runs": STANDARD_RUNS, "axes": list(&s.axes, axis) },
        "iso_9283": poses(&s.poses, s.compensated),
        "notes": &s.notes,
    }
}

fn axis(axis: &AxisTest) -> Json {
    object! {
        "joint": axis.joint + 1,
        "name": &axis.name,
        "kind": axis.kind.name(),
        "unit": axis.unit,
        "position_unit": axis.position_unit,
        "series": list(&axis.series, series),
        "series_not_listed": axis.more,
        "missing": axis.missing.as_ref(),
    }
}

fn series(series: &Series) -> Json {
    let fixed = &series.fixed;
    object! {
        "conditions": object! {
            "target": fixed.target.as_ref(),
            "load_kg": fixed.load_kg,
            "speed_per_s": fixed.speed,
            "setup": fixed.setup.as_ref(),
            "other_joints": &fixed.others,
        },
        "runs": series.before.fewest_runs(),
        "before": figures(&series.before),
        "after": series.after.as_ref().map(figures),
        "missing": &series.missing,
    }
}

fn figures(p: &Positioning) -> Json {
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
        "positions": list(&p.positions, position),
    }
}

fn position(p: &AtPosition) -> Json {
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

fn poses(test: &PoseTest, compensated: bool) -> Json {
    let largest = |l: Largest| {
        object! {
            "AP_p_mm": l.accuracy,
            "RP_l_mm": l.repeatability,
            "vAP_p_mm": l.variation,
            "AT_p_mm": l.path_accuracy,
            "RT_p_mm": l.path_repeatability,
        }
    };
    object! {
        "standard_cycles": STANDARD_CYCLES,
        "largest": object! {
            "before": largest(test.largest(false)),
            "after": compensated.then(|| largest(test.largest(true))),
        },
        "poses": list(&test.poses, pose),
        "variations": list(&test.variations, |v| object! {
            "q": &v.q,
            "target": v.target.as_ref(),
            "directions": v.directions,
            "vAP_p_before_mm": v.before,
            "vAP_p_after_mm": v.after,
        }),
        "paths": list(&test.paths, path),
        "missing": &test.missing,
    }
}

fn pose(pose: &PoseFigures) -> Json {
    object! {
        "q": &pose.q,
        "dir": &pose.dir,
        "target": pose.target.as_ref(),
        "load_kg": pose.load_kg,
        "cycles": pose.cycles,
        "before": attained(&pose.before),
        "after": pose.after.as_ref().map(attained),
        "orientation": pose.orientation.as_ref().map(|t| turned("P", t)),
    }
}

fn path(path: &PathFigures) -> Json {
    let attained = |a: &PathAttained| object! { "AT_p_mm": a.accuracy, "RT_p_mm": a.repeatability };
    let starts: Vec<usize> = path.starts.iter().map(|i| i + 1).collect();
    object! {
        "first_samples": starts,
        "cycles": path.starts.len(),
        "points": path.points,
        "length_mm": path.length_mm,
        "load_kg": path.load_kg,
        "before": attained(&path.before),
        "after": path.after.as_ref().map(attained),
        "orientation": path.orientation.as_ref().map(|t| turned("T", t)),
    }
}

fn attained(a: &Attained) -> Json {
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

/// Angles at poses (`P`) or on paths (`T`), degrees.
fn turned(of: &str, t: &Turned) -> Json {
    let figures = [("A", t.accuracy), ("R", t.repeatability)];
    let pairs = figures.into_iter().flat_map(|(figure, values)| {
        let axes = ["a", "b", "c"].into_iter().zip(values);
        axes.map(move |(axis, value)| (format!("{figure}{of}_{axis}_deg"), value.into()))
    });
    keyed(pairs)
}
