//! `truepose-standards/1`: the figures as JSON, under the standards' symbols.
//!
//! `iso_230_2`: per joint (counted from 1) and series of like conditions, `before` and `after` hold
//! `B`, `B_mean`, `R_up`, `R_down`, `R`, `E_up`, `E_down`, `E`, `M`, `A_up`, `A_down`, `A` in the
//! joint's `unit` (`arcsec` or `mm`) and the `positions` they come from. `iso_9283`: `poses` with
//! `AP…` and `RP…`, `variations` with `vAP_p_mm`, `paths` with `AT…` and `RT…` (`first_samples`: where
//! each cycle begins, from 1), and the `largest` of each. A figure that the
//! session cannot give is null, and `missing` says why. `after` is null without a model.

use serde::Serialize;

use super::axis::{AxisTest, Fixed, Series};
use super::path::{PathAttained, PathFigures};
use super::pose::{Attained, PoseFigures, PoseTest, Turned, Variation};
use super::positioning::{AtPosition, Positioning};
use super::{Standards, axis, pose};

/// The document.
#[derive(Debug, Serialize)]
pub struct Document<'a> {
    format: &'static str,
    session: &'a str,
    samples: usize,
    left_out: usize,
    iso_230_2: Axes<'a>,
    iso_9283: Poses<'a>,
    notes: &'a [String],
}

#[derive(Debug, Serialize)]
struct Axes<'a> {
    standard_runs: usize,
    axes: Vec<AxisTwin<'a>>,
}

#[derive(Debug, Serialize)]
struct AxisTwin<'a> {
    joint: usize,
    name: &'a str,
    kind: &'static str,
    unit: &'static str,
    position_unit: &'static str,
    series: Vec<SeriesTwin<'a>>,
    series_not_listed: usize,
    missing: Option<&'a str>,
}

#[derive(Debug, Serialize)]
struct SeriesTwin<'a> {
    conditions: Conditions<'a>,
    runs: [usize; 2],
    before: Figures,
    after: Option<Figures>,
    missing: &'a [String],
}

#[derive(Debug, Serialize)]
struct Conditions<'a> {
    target: Option<&'a str>,
    load_kg: Option<f64>,
    speed_per_s: Option<f64>,
    setup: Option<&'a str>,
    other_joints: &'a [f64],
}

#[derive(Debug, Serialize)]
#[allow(non_snake_case, reason = "the standard's symbols")]
struct Figures {
    B: Option<f64>,
    B_mean: Option<f64>,
    R_up: Option<f64>,
    R_down: Option<f64>,
    R: Option<f64>,
    E_up: Option<f64>,
    E_down: Option<f64>,
    E: Option<f64>,
    M: Option<f64>,
    A_up: Option<f64>,
    A_down: Option<f64>,
    A: Option<f64>,
    positions: Vec<PositionTwin>,
}

#[derive(Debug, Serialize)]
#[allow(non_snake_case, reason = "the standard's symbols")]
struct PositionTwin {
    commanded: f64,
    runs: [usize; 2],
    mean_up: Option<f64>,
    mean_down: Option<f64>,
    s_up: Option<f64>,
    s_down: Option<f64>,
    R_up: Option<f64>,
    R_down: Option<f64>,
    mean: Option<f64>,
    B: Option<f64>,
    R: Option<f64>,
}

#[derive(Debug, Serialize)]
struct Poses<'a> {
    standard_cycles: usize,
    largest: Largest,
    poses: Vec<PoseTwin<'a>>,
    variations: Vec<VariationTwin<'a>>,
    paths: Vec<PathTwin>,
    missing: &'a [String],
}

#[derive(Debug, Serialize)]
#[allow(non_snake_case, reason = "the standard's symbols")]
struct Largest {
    before: LargestTwin,
    after: Option<LargestTwin>,
}

#[derive(Debug, Serialize)]
#[allow(non_snake_case, reason = "the standard's symbols")]
struct LargestTwin {
    AP_p_mm: Option<f64>,
    RP_l_mm: Option<f64>,
    vAP_p_mm: Option<f64>,
    AT_p_mm: Option<f64>,
    RT_p_mm: Option<f64>,
}

#[derive(Debug, Serialize)]
struct PathTwin {
    first_samples: Vec<usize>,
    cycles: usize,
    points: usize,
    length_mm: f64,
    load_kg: Option<f64>,
    before: PathAttainedTwin,
    after: Option<PathAttainedTwin>,
    orientation: Option<PathTurnedTwin>,
}

#[derive(Debug, Serialize)]
#[allow(non_snake_case, reason = "the standard's symbols")]
struct PathAttainedTwin {
    AT_p_mm: f64,
    RT_p_mm: f64,
}

#[derive(Debug, Serialize)]
#[allow(non_snake_case, reason = "the standard's symbols")]
struct PathTurnedTwin {
    AT_a_deg: f64,
    AT_b_deg: f64,
    AT_c_deg: f64,
    RT_a_deg: f64,
    RT_b_deg: f64,
    RT_c_deg: f64,
}

#[derive(Debug, Serialize)]
struct PoseTwin<'a> {
    q: &'a [f64],
    dir: &'a [f64],
    target: Option<&'a str>,
    load_kg: Option<f64>,
    cycles: usize,
    before: AttainedTwin,
    after: Option<AttainedTwin>,
    orientation: Option<TurnedTwin>,
}

#[derive(Debug, Serialize)]
#[allow(non_snake_case, reason = "the standard's symbols")]
struct AttainedTwin {
    AP_p_mm: f64,
    AP_x_mm: f64,
    AP_y_mm: f64,
    AP_z_mm: f64,
    RP_l_mm: f64,
    mean_l_mm: f64,
    S_l_mm: f64,
}

#[derive(Debug, Serialize)]
#[allow(non_snake_case, reason = "the standard's symbols")]
struct TurnedTwin {
    AP_a_deg: f64,
    AP_b_deg: f64,
    AP_c_deg: f64,
    RP_a_deg: f64,
    RP_b_deg: f64,
    RP_c_deg: f64,
}

#[derive(Debug, Serialize)]
#[allow(non_snake_case, reason = "the standard's symbols")]
struct VariationTwin<'a> {
    q: &'a [f64],
    target: Option<&'a str>,
    directions: usize,
    vAP_p_before_mm: f64,
    vAP_p_after_mm: Option<f64>,
}

impl<'a> Document<'a> {
    /// The document of some figures.
    pub fn new(standards: &'a Standards) -> Self {
        let s = standards;
        Self {
            format: "truepose-standards/1",
            session: &s.session,
            samples: s.samples,
            left_out: s.left_out,
            iso_230_2: Axes {
                standard_runs: axis::STANDARD_RUNS,
                axes: s.axes.iter().map(axis_twin).collect(),
            },
            iso_9283: poses(&s.poses, s.compensated),
            notes: &s.notes,
        }
    }
}

fn axis_twin(axis: &AxisTest) -> AxisTwin<'_> {
    AxisTwin {
        joint: axis.joint + 1,
        name: &axis.name,
        kind: axis.kind.name(),
        unit: axis.unit,
        position_unit: axis.position_unit,
        series: axis.series.iter().map(series).collect(),
        series_not_listed: axis.more,
        missing: axis.missing.as_deref(),
    }
}

fn series(series: &Series) -> SeriesTwin<'_> {
    SeriesTwin {
        conditions: conditions(&series.fixed),
        runs: series.before.fewest_runs(),
        before: figures(&series.before),
        after: series.after.as_ref().map(figures),
        missing: &series.missing,
    }
}

fn conditions(fixed: &Fixed) -> Conditions<'_> {
    Conditions {
        target: fixed.target.as_deref(),
        load_kg: fixed.load_kg,
        speed_per_s: fixed.speed,
        setup: fixed.setup.as_deref(),
        other_joints: &fixed.others,
    }
}

fn figures(p: &Positioning) -> Figures {
    Figures {
        B: p.reversal,
        B_mean: p.mean_reversal,
        R_up: p.repeatability[0],
        R_down: p.repeatability[1],
        R: p.repeatability_of_both,
        E_up: p.systematic[0],
        E_down: p.systematic[1],
        E: p.systematic_of_both,
        M: p.mean_range,
        A_up: p.accuracy[0],
        A_down: p.accuracy[1],
        A: p.accuracy_of_both,
        positions: p.positions.iter().map(position).collect(),
    }
}

fn position(p: &AtPosition) -> PositionTwin {
    PositionTwin {
        commanded: p.commanded,
        runs: p.runs,
        mean_up: p.mean[0],
        mean_down: p.mean[1],
        s_up: p.deviation[0],
        s_down: p.deviation[1],
        R_up: p.repeatability[0],
        R_down: p.repeatability[1],
        mean: p.mean_of_both,
        B: p.reversal,
        R: p.repeatability_of_both,
    }
}

fn poses(test: &PoseTest, compensated: bool) -> Poses<'_> {
    let twin = |largest: pose::Largest| LargestTwin {
        AP_p_mm: largest.accuracy,
        RP_l_mm: largest.repeatability,
        vAP_p_mm: largest.variation,
        AT_p_mm: largest.path_accuracy,
        RT_p_mm: largest.path_repeatability,
    };
    Poses {
        standard_cycles: pose::STANDARD_CYCLES,
        largest: Largest {
            before: twin(test.largest(false)),
            after: compensated.then(|| twin(test.largest(true))),
        },
        poses: test.poses.iter().map(pose_twin).collect(),
        variations: test.variations.iter().map(variation).collect(),
        paths: test.paths.iter().map(path).collect(),
        missing: &test.missing,
    }
}

fn pose_twin(pose: &PoseFigures) -> PoseTwin<'_> {
    PoseTwin {
        q: &pose.q,
        dir: &pose.dir,
        target: pose.target.as_deref(),
        load_kg: pose.load_kg,
        cycles: pose.cycles,
        before: attained(&pose.before),
        after: pose.after.as_ref().map(attained),
        orientation: pose.orientation.as_ref().map(turned),
    }
}

fn path(path: &PathFigures) -> PathTwin {
    let attained = |a: &PathAttained| PathAttainedTwin {
        AT_p_mm: a.accuracy,
        RT_p_mm: a.repeatability,
    };
    let turned = |t: &Turned| {
        let ([a, b, c], [ra, rb, rc]) = (t.accuracy, t.repeatability);
        PathTurnedTwin {
            AT_a_deg: a,
            AT_b_deg: b,
            AT_c_deg: c,
            RT_a_deg: ra,
            RT_b_deg: rb,
            RT_c_deg: rc,
        }
    };
    PathTwin {
        first_samples: path.starts.iter().map(|i| i + 1).collect(),
        cycles: path.starts.len(),
        points: path.points,
        length_mm: path.length_mm,
        load_kg: path.load_kg,
        before: attained(&path.before),
        after: path.after.as_ref().map(attained),
        orientation: path.orientation.as_ref().map(turned),
    }
}

fn attained(a: &Attained) -> AttainedTwin {
    let [x, y, z] = a.accuracy_axes;
    AttainedTwin {
        AP_p_mm: a.accuracy,
        AP_x_mm: x,
        AP_y_mm: y,
        AP_z_mm: z,
        RP_l_mm: a.repeatability,
        mean_l_mm: a.mean_distance,
        S_l_mm: a.deviation,
    }
}

fn turned(t: &Turned) -> TurnedTwin {
    let ([a, b, c], [ra, rb, rc]) = (t.accuracy, t.repeatability);
    TurnedTwin {
        AP_a_deg: a,
        AP_b_deg: b,
        AP_c_deg: c,
        RP_a_deg: ra,
        RP_b_deg: rb,
        RP_c_deg: rc,
    }
}

fn variation(v: &Variation) -> VariationTwin<'_> {
    VariationTwin {
        q: &v.q,
        target: v.target.as_deref(),
        directions: v.directions,
        vAP_p_before_mm: v.before,
        vAP_p_after_mm: v.after,
    }
}
