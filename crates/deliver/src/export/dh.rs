//! Denavit–Hartenberg rows of the robot as it was built, in the convention that it came in.
//!
//! ```text
//! base_from_tool = base · row_1 · … · row_n · tool
//! ```
//!
//! The file is a robot as sessions have it: `dh`, `base` (the frame before the first row, where it
//! is not the base frame itself) and `tool`. The nominal rows are the start, the corrected chain is
//! what they are fitted to. What of it no row can say is in base and tool: how the first axis stands
//! in the base, and everything behind the last. Four numbers between two axes are what a line needs,
//! so that nothing is missing, except between parallel axes: there d says nothing and a turn about
//! y has no number (Hayati's β). d is held there, the rest takes over what it can, and what remains
//! is stated in mm.
//!
//! Sources: Denavit & Hartenberg 1955; Hayati & Mirmirani 1985.

use super::chain::Chain;
use super::description::{Written, finish, frames};
use super::dh_rows::{nominal_rows, parallel};
use super::steps::{Step, fit, motion, ranges};
use crate::text::length;

use super::exporter::several_joints;
use super::options::{Asked, Zeros};
use super::{Export, ExportError, Exporter, Format, Job};
use crate::document::kinds::{TEXT, VECTOR};
use crate::document::object::written;
use crate::document::{Value, degrees, text_of};
use crate::kinematics::{DhConvention, DhRow, JointKind, Pose, Robot, RobotSource};
use crate::sessions::files::format_v1::robot::to_display;
use crate::sessions::files::format_v1::robot_parts::POSE;
use crate::sessions::files::format_v1::robot_source::DH_ROWS;
use crate::sessions::parse_robot;
use crate::text::Text;
use crate::units::rad_from_deg;

pub(super) const FORMAT: Format = Format {
    id: "dh",
    title: phrase!("Denavit–Hartenberg rows"),
    extension: "json",
    rules: None,
    suits: several_joints,
    exporter: &Dh,
};

struct Dh;

/// Rows that lead to the same place up to this say everything, mm.
const FOUND_MM: f64 = 1e-7;

/// Rows and what stands before and behind them.
struct Rows {
    base: Pose,
    rows: Vec<DhRow>,
    /// In the frame behind the last row.
    tool: Pose,
}

impl Exporter for Dh {
    fn asks(&self, robot: &Robot) -> Asked {
        Asked {
            zeros: Some(Zeros::default()),
            convention: Some(came_in(robot)),
            ..Asked::default()
        }
    }

    fn export(&self, job: &Job) -> Result<Export, ExportError> {
        let nominal = &job.calibration.model.robot;
        let chain = Chain::new(job, job.options.zeros.unwrap_or_default())?;
        let convention = job.options.convention.unwrap_or_else(|| came_in(nominal));
        let found = fitted(job, &chain, convention);
        let text = write(job, &found);
        let robot = read(&text)?;
        let parallels = parallels(nominal);
        let mut cannot_say = Vec::new();
        let far_mm = chain.farthest(job, &robot);
        if far_mm > FOUND_MM {
            let far = length(far_mm, 4);
            cannot_say.push(if parallels.is_empty() {
                text!(
                    "no DH rows describe this robot completely: {far} remain at most over the measured range",
                    far
                )
            } else {
                text!(
                    "the rows cannot describe how parallel axes are turned against each other about y (joints {joints}): {far} remain at most over the measured range",
                    joints = Text::listed(parallels, ", "),
                    far
                )
            });
        }
        let off_base = found.base.inverse() * nominal_rows(nominal, convention).0;
        if off_base.translation.vector.norm() > 1e-9 || off_base.rotation.angle() > 1e-12 {
            cannot_say.push(text!(
                "the rows cannot describe where the first axis is in the base: enter base as well"
            ));
        }
        let are = "base: the frame before the first row in the base frame; tool: the tool in the \
                   frame behind the last row";
        let written = Written {
            units: "mm and degrees",
            frames: Some(frames(&found.base, &found.tool, are)),
            cannot_say,
            notes: vec![text!(
                "rows in the {convention} convention",
                convention = match convention {
                    DhConvention::Standard => "standard",
                    DhConvention::Modified => "modified",
                }
            )],
            ..Written::of(FORMAT.id, text, robot)
        };
        finish(job, &chain, written)
    }
}

/// Neighbouring joints whose axes are parallel, counted from 1.
fn parallels(robot: &Robot) -> Vec<Text> {
    let pairs = robot.joints.windows(2).enumerate();
    pairs
        .filter(|(_, pair)| parallel(&pair[0].axis, &pair[1].axis))
        .map(|(k, _)| text!("{a} and {b}", a = k + 1, b = k + 2))
        .collect()
}

fn came_in(robot: &Robot) -> DhConvention {
    match &robot.source {
        RobotSource::Dh { rows, .. } => rows
            .first()
            .map_or(DhConvention::Standard, |row| row.convention),
        _ => DhConvention::Standard,
    }
}

fn fitted(job: &Job, chain: &Chain, convention: DhConvention) -> Rows {
    let nominal = &job.calibration.model.robot;
    let (base, mut rows) = nominal_rows(nominal, convention);
    for (k, row) in rows.iter_mut().enumerate() {
        let own = chain.offsets[k] - chain.taken[k];
        match row.kind {
            JointKind::Revolute => row.theta_rad += own,
            JointKind::Prismatic => row.d_mm += own,
        }
    }
    let nominal_chain = rows_motion(&nominal_rows(nominal, convention).1);
    let tool = (base * nominal_chain).inverse() * nominal.base_from_tool;
    // What stands before the first axis, the four numbers of where that is, and back again.
    let lead = link_before(&rows[0]);
    let mut steps = vec![Step::Fixed(base * lead)];
    let across = steps.len();
    steps.extend([0, 1].map(|axis| Step::shift(axis, 0.0, true)));
    steps.extend([0, 1].map(|axis| Step::turn(axis, 0.0, true)));
    steps.push(Step::Fixed(lead.inverse()));
    let first = steps.len();
    let count = rows.len();
    for (k, row) in rows.iter().enumerate() {
        let next = nominal.joints.get(k + 1);
        let said = next.is_some_and(|next| !parallel(&nominal.joints[k].axis, &next.axis));
        // Behind the last axis everything is the tool's.
        let turn = Step::turn(2, row.theta_rad, k + 1 < count);
        let slide = Step::shift(2, row.d_mm, said);
        let [turn, slide] = match row.kind {
            JointKind::Revolute => [turn.with_joint(k), slide],
            JointKind::Prismatic => [turn, slide.with_joint(k)],
        };
        let link_is_free = match convention {
            DhConvention::Standard => k + 1 < count,
            DhConvention::Modified => k > 0,
        };
        let length = Step::shift(0, row.a_mm, link_is_free);
        let twist = Step::turn(0, row.alpha_rad, link_is_free);
        steps.extend(match convention {
            DhConvention::Standard => [turn, slide, length, twist],
            DhConvention::Modified => [twist, length, turn, slide],
        });
    }
    let behind = steps.len();
    steps.push(Step::Fixed(tool));
    steps.extend(Step::any_motion());
    let ranges = ranges(nominal, &job.calibration.measured);
    fit(&mut steps, &chain.robot, &ranges);
    for (row, steps) in rows.iter_mut().zip(steps[first..behind].chunks_exact(4)) {
        let values = [0, 1, 2, 3].map(|k: usize| steps[k].value());
        [row.theta_rad, row.d_mm, row.a_mm, row.alpha_rad] = match convention {
            DhConvention::Standard => values,
            DhConvention::Modified => [values[2], values[3], values[1], values[0]],
        };
        // As the file will have it.
        row.theta_rad = rad_from_deg(degrees(row.theta_rad));
        row.alpha_rad = rad_from_deg(degrees(row.alpha_rad));
    }
    let home = vec![0.0; count];
    Rows {
        base: motion(&steps[..across], &home)
            * motion(&steps[across..first - 1], &home)
            * lead.inverse(),
        rows,
        tool: motion(&steps[behind..], &home),
    }
}

/// What a modified row has before its joint.
fn link_before(row: &DhRow) -> Pose {
    match row.convention {
        DhConvention::Standard => Pose::identity(),
        DhConvention::Modified => {
            let steps = [
                Step::turn(0, row.alpha_rad, false),
                Step::shift(0, row.a_mm, false),
            ];
            motion(&steps, &[])
        }
    }
}

/// The motion of rows at home.
fn rows_motion(rows: &[DhRow]) -> Pose {
    crate::kinematics::robot_from_dh("", rows)
        .map_or(Pose::identity(), |robot| robot.base_from_tool)
}

fn write(job: &Job, found: &Rows) -> String {
    let mut nominal = job.calibration.model.robot.clone();
    let limits = nominal.joints.iter().map(|joint| {
        let ends = joint.limits.map(|range| [range.from, range.to]);
        ends.map(|ends| ends.map(|end| to_display(joint.kind, end)))
    });
    let limits: Value = limits.collect();
    // At home, in the base frame.
    let tool = found.base * rows_motion(&found.rows) * found.tool;
    text_of(&written(&mut nominal, |o, robot| {
        o.required("name", &mut robot.name, &TEXT);
        o.field("dh", &mut found.rows.clone(), &DH_ROWS);
        o.field("base", &mut found.base.clone(), &POSE);
        o.field("tool", &mut tool.clone(), &POSE);
        o.with("limits", &mut (), phrase!(""), |_| None, |()| Some(limits));
        o.optional("gravity_m_s2", &mut robot.gravity_m_s2, &VECTOR);
    }))
}

fn read(text: &str) -> Result<Robot, ExportError> {
    match parse_robot(text.as_bytes()) {
        Ok(read) => Ok(read.robot),
        Err(rejected) => Err(ExportError::ReadBack(rejected.to_string())),
    }
}
