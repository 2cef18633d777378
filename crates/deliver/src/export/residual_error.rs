//! What a table leaves: the file is read back, the controller's rules are applied to it, and the
//! result is compared with the exact correction.
//!
//! ```text
//! added = lever · | c_file(q, side) − c(q, side) |      root mean square over q and both sides
//! ```
//!
//! with c the exact correction at closely spaced q over the measured range, and the lever how far
//! the reflectors move with the joint (root mean square, mm per rad or mm per mm). By the triangle
//! inequality the gap that a session shows grows by no more than that.
//!
//! A table may add 1 % of the tolerance. Where no tolerance is given, the model's own gap stands in
//! for it, or 0.01 mm where that is smaller.

use super::poses::poses;
use super::rules::{Directions, Rules};
use super::sheet::Sheet;
use super::{ExportError, Job, ReadBack};
use crate::compensation::inverse::places;
use crate::compensation::{Compensation, JointTable, Side};
use crate::kinematics::JointKind;
use crate::lanes::{dot, minus};
use crate::model::Calibration;
use crate::text::{Argument, Text, length};

/// What a table may add.
const SHARE: f64 = 0.01;
/// The least that stands in for a tolerance, mm.
const LEAST_STAND_IN_MM: f64 = 0.01;
/// Closely spaced points: per degree or mm, and within these bounds.
const PER_UNIT: f64 = 16.0;
const POINTS: [f64; 2] = [2000.0, 20_000.0];
/// Neighbours predict a target where what they leave is noise: √2 is as much again.
const TOO_FAR_APART: f64 = std::f64::consts::SQRT_2;
/// The share of what a model leaves of its samples that a table with its entries at the measured targets may add: the model
/// itself is off by a fifth of that and more, beside which it is a hundredth.
const AT_THE_TARGETS: f64 = 0.03;
/// Half a difference quotient, rad (mm: a thousand times as much).
const STEP: f64 = 1e-4;

/// How much a table may add.
#[derive(Debug, Clone, PartialEq)]
pub struct Allowance {
    /// In mm.
    pub mm: f64,
    /// Of what it is a share.
    pub is: Text,
}

impl Allowance {
    pub(super) fn of(calibration: &Calibration) -> Self {
        if let Some(tolerance) = calibration.tolerance_mm {
            return Self {
                mm: SHARE * tolerance,
                is: share(SHARE, text!("the tolerance")),
            };
        }
        let gap = calibration.history.last().map_or(0.0, |step| step.gap_mm);
        let known = gap.is_finite() && gap > LEAST_STAND_IN_MM;
        Self {
            mm: SHARE * if known { gap } else { LEAST_STAND_IN_MM },
            is: if known {
                share(SHARE, text!("the model's RMS error"))
            } else {
                share(SHARE, length(LEAST_STAND_IN_MM, 2))
            },
        }
    }

    /// Of a table with its entries at the measured targets: what is little beside what the model itself is off by.
    pub(super) fn at_the_targets(self, calibration: &Calibration) -> Self {
        let gap_mm = calibration.history.last().map_or(0.0, |step| step.gap_mm);
        let mm = AT_THE_TARGETS * gap_mm;
        if mm.is_nan() || mm <= self.mm {
            return self;
        }
        Self {
            mm,
            is: share(AT_THE_TARGETS, text!("the model's RMS error")),
        }
    }

    /// What remains of it beside a part that is independent.
    pub(super) fn without_independent(&self, mm: f64) -> f64 {
        (self.mm * self.mm - mm * mm).max(0.0).sqrt()
    }
}

fn share(of_one: f64, what: impl Into<Argument>) -> Text {
    let what: Argument = what.into();
    text!(
        "{share} % of {length}",
        share = 100.0 * of_one,
        length = what
    )
}

/// The exact correction at closely spaced places.
pub(super) struct Exact {
    pub(super) table: JointTable,
    /// How far the reflectors move with the joint, mm per degree or mm per mm.
    pub(super) lever_outer_mm: f64,
}

impl Exact {
    pub(super) fn new(job: &Job) -> Result<Self, ExportError> {
        let joint = job.calibration.model.robot.joints.get(job.joint);
        let wide = joint.and_then(|joint| joint.limits);
        let wide = wide.or_else(|| job.calibration.measured.get(job.joint).copied());
        let span = wide.map_or(1.0, |range| range.to - range.from);
        let span = joint.map_or(span, |joint| joint.kind.to_display(span));
        let points = (PER_UNIT * span).ceil().clamp(POINTS[0], POINTS[1]);
        // What is wrong with the joint or its range is said by the table.
        let step = span / points;
        let usable = step.is_finite() && step > 0.0;
        let table = job.table(if usable { step } else { 1.0 })?;
        let lever = lever(job);
        let lever_outer_mm = table.kind.to_base_units(lever);
        Ok(Self {
            table,
            lever_outer_mm,
        })
    }

    pub(super) fn span(&self) -> f64 {
        let places = &self.table.commanded_outer;
        places[places.len() - 1] - places[0]
    }

    /// Points in the measured range, or all where it holds none.
    fn points(&self) -> Vec<usize> {
        let table = &self.table;
        let [from, to] = [
            table.to_display(table.measured.from),
            table.to_display(table.measured.to),
        ];
        let all = 0..table.commanded_outer.len();
        let inside = |k: &usize| {
            let q = table.commanded_outer[*k];
            q >= from - 1e-9 && q <= to + 1e-9
        };
        let measured: Vec<usize> = all.clone().filter(inside).collect();
        if measured.is_empty() {
            all.collect()
        } else {
            measured
        }
    }

    /// What a table on this sheet adds, root mean square, mm. A format for one direction is held
    /// against the mean of both.
    pub(super) fn added_by(&self, sheet: &Sheet, rules: &Rules) -> f64 {
        let Some(read) = ReadBack::of_sheet(sheet) else {
            return f64::INFINITY;
        };
        let one = rules.directions != Directions::Both;
        self.added(&read, one)[0]
    }

    /// Root mean square and largest, mm.
    fn added(&self, read: &ReadBack, against_the_mean: bool) -> [f64; 2] {
        let table = &self.table;
        let (mut sum, mut largest, mut count) = (0.0, 0.0_f64, 0.0);
        for k in self.points() {
            let q = table.commanded_outer[k];
            let (forward, reverse) = (
                table.to_display(table.forward[k]),
                table.to_display(table.reverse[k]),
            );
            let mean = 0.5 * (forward + reverse);
            for (side, exact) in [(1.0, forward), (-1.0, reverse)] {
                let exact = if against_the_mean { mean } else { exact };
                let off = self.lever_outer_mm * (read.correction_outer(q, side) - exact).abs();
                sum += off * off;
                largest = largest.max(off);
                count += 1.0;
            }
        }
        [(sum / count).sqrt(), largest]
    }

    /// How far the two directions lie apart at most, degrees or mm.
    pub(super) fn apart_outer(&self) -> f64 {
        let table = &self.table;
        let both = table.forward.iter().zip(&table.reverse);
        table.to_display(both.map(|(f, r)| (f - r).abs()).fold(0.0, f64::max))
    }

    /// What the mean of both directions leaves of each, root mean square, mm; none where the format
    /// has a column for each.
    pub(super) fn between_sides_mm(&self, rules: &Rules) -> f64 {
        if rules.directions == Directions::Both {
            return 0.0;
        }
        let table = &self.table;
        let points = self.points();
        let squares = points.iter().map(|k| {
            let half = 0.5 * (table.forward[*k] - table.reverse[*k]);
            table.to_display(half).powi(2)
        });
        self.lever_outer_mm * (squares.sum::<f64>() / points.len() as f64).sqrt()
    }
}

/// How far the reflectors move per rad or mm, root mean square over the measured range.
fn lever(job: &Job) -> f64 {
    let nominal = Compensation::new(job.calibration).nominal;
    let joint = job.joint;
    let unit = match nominal.robot.joints.get(joint).map(|joint| joint.kind) {
        Some(JointKind::Revolute) => 1.0,
        Some(JointKind::Prismatic) => 1000.0,
        None => return 0.0,
    };
    let beside = |way: f64| {
        let mut inputs = poses(job, Side::Forward);
        for q in inputs.q[joint].to_mut() {
            *q += way * STEP * unit;
        }
        places(&nominal, &inputs)
    };
    let (below, above) = (beside(-1.0), beside(1.0));
    let (mut sum, mut count) = (0.0, 0.0);
    for (below, above) in below.iter().zip(&above) {
        for i in 0..below.x_mm.len() {
            let moved = minus(above.get(i), below.get(i)).map(|d| d / (2.0 * STEP * unit));
            sum += dot(moved, moved);
            count += 1.0;
        }
    }
    (sum / f64::max(count, 1.0)).sqrt()
}

/// RMS error in mm that a table leaves, from the written file as the controller applies it.
#[derive(Debug, Clone, PartialEq)]
pub struct ResidualError {
    /// What the table adds to the exact correction, root mean square, mm.
    pub added_rms_mm: f64,
    /// The same at the worst place, mm.
    pub added_max_mm: f64,
    /// The gap that is left over the measured range with the table, and with the exact correction,
    /// root mean square, mm; for a robot with a single joint.
    pub gap_mm: Option<[f64; 2]>,
    /// What the controller leaves with the table, by samples that no fit has seen; for a robot with a single joint.
    pub leaves: Option<Leaves>,
    /// What it may add.
    pub allowance: Allowance,
}

/// What a controller leaves with a table: what samples that no fit has seen are off the model, and what the table,
/// with its interpolation and its digits, leaves of the model,
///
/// ```text
/// leaves² = e² + t²
/// ```
///
/// e over runs that were held out where there are several, else over held-out values of the joint; between the
/// targets e over held-out values, which their neighbours predict.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Leaves {
    /// At the targets, in another run, mm.
    pub leaves_mm: f64,
    /// Between the targets, mm.
    pub between_targets_mm: f64,
}

impl Leaves {
    fn of(calibration: &Calibration, table_mm: f64) -> Option<Self> {
        let last = calibration.history.last()?;
        let seen_mm = last.held_out_mm.unwrap_or(last.gap_mm);
        let at_targets_mm = last.runs_held_out_mm.unwrap_or(seen_mm);
        let between_mm = last.values_held_out_mm.unwrap_or(seen_mm);
        Some(Self {
            leaves_mm: at_targets_mm.hypot(table_mm),
            between_targets_mm: between_mm.hypot(table_mm),
        })
    }

    /// Whether neighbours do not predict a target.
    pub fn are_targets_too_far_apart(&self) -> bool {
        self.between_targets_mm > TOO_FAR_APART * self.leaves_mm
    }
}

impl ResidualError {
    pub(super) fn new(job: &Job, exact: &Exact, read: &ReadBack, allowance: Allowance) -> Self {
        let [added_rms_mm, added_max_mm] = exact.added(read, false);
        let single = job.calibration.model.robot.joints.len() == 1;
        let gap_mm = single.then(|| gaps(job, read));
        Self {
            added_rms_mm,
            added_max_mm,
            leaves: gap_mm.and_then(|[with, _]| Leaves::of(job.calibration, with)),
            gap_mm,
            allowance,
        }
    }

    /// Whether it adds no more than it may.
    pub fn met(&self) -> bool {
        self.added_rms_mm <= self.allowance.mm
    }

    /// In words.
    pub fn describe(&self, rules: &Rules, sheet: &Sheet, asked: bool) -> Text {
        let (entries, allowed) = (sheet.places.len(), &self.allowance.is);
        let added = length(self.added_rms_mm, 5);
        let limit = length(self.allowance.mm, 5);
        let mut adds = text!(
            "its {entries} entries add {added}; {allowed} is {limit}",
            entries,
            added,
            allowed,
            limit
        );
        if !self.met() {
            let why = if asked {
                text!("the step is wide")
            } else {
                let step = rules.resolution.unwrap_or(0.0);
                text!(
                    "{format} takes at most {most} entries in steps of {step}",
                    format = rules.title(),
                    most = rules.most_entries,
                    step = format!("{step}{}", sheet.kind.sign())
                )
            };
            adds = text!("{found}: {name}", found = adds, name = why);
        }
        let Some(leaves) = self.leaves else {
            // A model whose samples are not known.
            return match self.gap_mm {
                Some([with, exact]) => text!(
                    "with this table the controller leaves {with} over the measured range, where an exact correction leaves {exact}; {adds}",
                    with = length(with, 4),
                    exact = length(exact, 4),
                    adds
                ),
                None => adds,
            };
        };
        let (at, between) = (
            length(leaves.leaves_mm, 4),
            length(leaves.between_targets_mm, 4),
        );
        let leaves_so = text!(
            "with this table the controller leaves {at}, and {between} between the measured positions, by samples that the fit has not seen; {adds}",
            at,
            between,
            adds
        );
        if leaves.are_targets_too_far_apart() {
            text!(
                "{first}; {next}",
                first = leaves_so,
                next = text!("neighbours do not predict a position, measure in smaller steps")
            )
        } else {
            leaves_so
        }
    }
}

/// The gap with the table and with the exact correction.
fn gaps(job: &Job, read: &ReadBack) -> [f64; 2] {
    let compensation = Compensation::new(job.calibration);
    let (mut sums, mut count) = ([0.0; 2], 0.0);
    for side in [Side::Forward, Side::Reverse] {
        let inputs = poses(job, side);
        let q = &inputs.q[0];
        let by_table = q.iter().map(|q| read.correction(*q, side.sign()));
        let by_table: Vec<f64> = by_table.collect();
        let by_model = compensation.joint_corrections(&inputs);
        let nominal = compensation.nominal.predict(&inputs);
        for (sum, corrections) in sums.iter_mut().zip([vec![by_table], by_model]) {
            let reached = compensation.reached(&inputs, &corrections);
            for i in 0..inputs.len() {
                let off = compensation.deviation(reached.get(i), nominal.get(i));
                *sum += dot(off, off);
            }
        }
        count += inputs.len() as f64;
    }
    sums.map(|sum| (sum / f64::max(count, 1.0)).sqrt())
}
