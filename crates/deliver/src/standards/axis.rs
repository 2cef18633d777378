//! Tests of single axes in a session: the series of samples in which one joint visits positions
//! while all others stand, and the axis' deviation in each of them.
//!
//! A joint that turns: the angle about its axis from where the reflector should be to where it is,
//!
//! ```text
//! x = atan2(a · (r₀ × r), r₀ · r),   r₀, r: from the axis to the points, across the axis
//! ```
//!
//! exact, whatever the size of the error. The axis is where the nominal robot has it: what an
//! offset of the base does to the angle is part of the deviation. A joint that slides:
//! x = a · (measured − commanded).

use crate::kinematics::JointKind;
use crate::text::Text;

use super::grouping::{Keys, once_per_stay, stays};
use super::points::Points;
use super::positioning::{Position, Positioning};
use super::sweep::Sweep;
use super::table_curve::TableCurve;

/// Approaches from each side that ISO 230-2 asks for.
pub(crate) const STANDARD_RUNS: usize = 5;
/// Series that are listed for an axis, best first.
const MOST_SERIES: usize = 12;

/// What was held fixed in a series.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Fixed {
    /// The reflector, where the session has several.
    pub target: Option<String>,
    /// Load, kg.
    pub load_kg: Option<f64>,
    /// Size of the joint's speed, degrees or mm per second.
    pub speed: Option<f64>,
    /// The measuring frame.
    pub setup: Option<String>,
    /// The other joints' values, degrees or mm; empty for a single joint.
    pub others: Vec<f64>,
}

impl Fixed {
    /// In words, for the axis that moved.
    pub fn in_words(&self, axis: &AxisTest) -> Text {
        let mut parts: Vec<Text> = Vec::new();
        parts.extend(
            self.target
                .iter()
                .map(|t| text!("reflector {name}", name = t)),
        );
        parts.extend(self.load_kg.map(|kg| text!("load {load} kg", load = kg)));
        if let Some(speed) = self.speed.filter(|v| *v != 0.0) {
            parts.push(text!(
                "measured at {speed}",
                speed = format!("{speed} {}/s", axis.position_unit)
            ));
        }
        parts.extend(self.setup.iter().map(|s| text!("setup {setup}", setup = s)));
        if !self.others.is_empty() {
            let others: Vec<String> = self.others.iter().map(f64::to_string).collect();
            parts.push(text!(
                "other joints at {values}",
                values = others.join(", ")
            ));
        }
        if parts.is_empty() {
            parts.push(text!("all samples alike"));
        }
        Text::listed(parts, ", ")
    }
}

/// One axis under one set of conditions.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// What was held fixed.
    pub fixed: Fixed,
    /// As measured.
    pub before: Positioning,
    /// As it would be with corrected commands.
    pub after: Option<Positioning>,
    /// The deviations behind the figures, approach by approach.
    pub deviations: Vec<Position>,
    /// The same with corrected commands.
    pub corrected: Option<Vec<Position>>,
    /// What the table corrects.
    pub curve: Option<TableCurve>,
    /// What the standard asks for and the session does not have.
    pub missing: Vec<Text>,
}

/// One axis.
#[derive(Debug, Clone, PartialEq)]
pub struct AxisTest {
    /// Joint, counted from 0.
    pub joint: usize,
    /// Its name.
    pub name: String,
    /// How it moves.
    pub kind: JointKind,
    /// Unit of all figures: `arcsec` or `mm`.
    pub unit: &'static str,
    /// Unit of the positions: `deg` or `mm`.
    pub position_unit: &'static str,
    /// The series, best first.
    pub series: Vec<Series>,
    /// Number of further series that are not listed.
    pub more: usize,
    /// Why there is no series at all.
    pub missing: Option<Text>,
}

impl AxisTest {
    pub(super) fn new(points: &Points<'_>, joint: usize) -> Self {
        let about = &points.robot.joints[joint];
        let (unit, position_unit) = match about.kind {
            JointKind::Revolute => ("arcsec", "deg"),
            JointKind::Prismatic => ("mm", "mm"),
        };
        let mut test = Self {
            joint,
            name: about.name.clone(),
            kind: about.kind,
            unit,
            position_unit,
            series: Vec::new(),
            more: 0,
            missing: None,
        };
        let Some(dir) = &points.inputs.dir[joint] else {
            test.missing = Some(text!(
                "the side from which the joint came is not known: column {column} is missing",
                column = format!("dir{}", joint + 1)
            ));
            return test;
        };
        let mut keys = Keys::of_conditions(points);
        for (other, q) in points.inputs.q.iter().enumerate() {
            if other != joint {
                keys = keys.and(q);
            }
        }
        let counts = |i: usize| points.usable[i] && dir[i] != 0.0;
        let stays = stays(points);
        let groups = keys.groups(points.inputs.len(), counts);
        let mut series: Vec<Series> = groups
            .iter()
            .filter_map(|group| Sweep::new(points, joint, &once_per_stay(group, &stays)))
            .filter_map(Sweep::series)
            .collect();
        let size = |s: &Series| {
            let [up, down] = s.before.fewest_runs();
            (up.min(down).min(2), s.before.positions.len(), up + down)
        };
        series.sort_by_key(|s| std::cmp::Reverse(size(s)));
        test.more = series.len().saturating_sub(MOST_SERIES);
        series.truncate(MOST_SERIES);
        if series.is_empty() {
            test.missing = Some(text!(
                "no two positions of the joint were measured with everything else alike (other joints, reflector, load, speed) and a reflector off the axis"
            ));
        }
        test.series = series;
        test
    }
}

impl Sweep<'_, '_> {
    fn series(mut self) -> Option<Series> {
        let mut missing = Vec::new();
        let all = self.positions.len();
        self.keep_the_most_useful();
        let left_out = all - self.positions.len();
        if left_out > 0 {
            missing.push(text!(
                one "{count} of {all} positions has fewer approaches than the others and is excluded", "{count} of {all} positions have fewer approaches than the others and are excluded",
                count = left_out,
                all
            ));
        }
        let deviations = self.deviations(false)?;
        let corrected = if self.points.compensated() {
            Some(self.deviations(true)?)
        } else {
            None
        };
        let before = Positioning::new(&deviations);
        self.shortcomings(&before, &mut missing);
        Some(Series {
            fixed: self.fixed(),
            before,
            after: corrected.as_deref().map(Positioning::new),
            curve: TableCurve::of(&self),
            deviations,
            corrected,
            missing,
        })
    }

    fn fixed(&self) -> Fixed {
        let Points {
            session, inputs, ..
        } = self.points;
        let i = self.first;
        let outer =
            |joint: usize, value: f64| self.points.robot.joints[joint].kind.to_display(value);
        let others = (0..inputs.q.len()).filter(|j| *j != self.joint);
        Fixed {
            target: inputs
                .target
                .as_ref()
                .and_then(|t| session.targets.get(t[i] as usize))
                .map(|t| t.name.clone()),
            load_kg: inputs.load_kg.as_ref().map(|l| l[i]),
            speed: inputs.speed[self.joint]
                .as_ref()
                .map(|v| outer(self.joint, v[i].abs())),
            setup: session
                .samples
                .setups
                .as_ref()
                .and_then(|s| s.names.get(s.index[i] as usize).cloned()),
            others: others.map(|j| outer(j, inputs.q[j][i])).collect(),
        }
    }

    fn shortcomings(&self, figures: &Positioning, missing: &mut Vec<Text>) {
        let [up, down] = figures.fewest_runs();
        missing.extend(match up.min(down) {
            0 => Some(text!(
                "not every position was approached from both sides: no figure of the side that is missing, and no reversal"
            )),
            1 => Some(text!(
                "a position was approached once from one side: no standard deviation, so no repeatability and no accuracy"
            )),
            _ => None,
        });
        if up.min(down) >= 2 && up.min(down) < STANDARD_RUNS {
            missing.push(text!(
                "{approaches} approaches from each side; the standard asks for {standard}",
                approaches = up.min(down),
                standard = STANDARD_RUNS
            ));
        }
        let (Some(first), Some(last)) = (figures.positions.first(), figures.positions.last())
        else {
            return;
        };
        let travel = last.commanded - first.commanded;
        let wanted = match self.points.robot.joints[self.joint].kind {
            JointKind::Revolute if travel <= 90.0 => 3,
            JointKind::Revolute if travel <= 180.0 => 5,
            JointKind::Revolute => 8,
            JointKind::Prismatic => 5,
        };
        if figures.positions.len() < wanted {
            let unit = match self.points.robot.joints[self.joint].kind {
                JointKind::Revolute => "degrees",
                JointKind::Prismatic => "mm",
            };
            missing.push(text!(
                "{positions} positions over {travel}; the standard asks for {standard}",
                positions = figures.positions.len(),
                travel = format!("{travel} {unit}"),
                standard = wanted
            ));
        }
    }
}
