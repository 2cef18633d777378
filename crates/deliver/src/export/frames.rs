//! Zero offsets, base and tool frame, for controllers that take no other geometry, in the makers'
//! conventions of orientation.
//!
//! ```text
//! base · nominal chain(q + zeros) · tool  →  the model, least squares over the joints' ranges
//! ```
//!
//! With the links as they are drawn, these are the values that come nearest to the robot that was
//! built; they take over what they can of what the links are off. The first joint's zero belongs to
//! the base and the last one's to the tool, except for what was identified of them.

use super::chain::Chain;
use super::description::{Level, Written, finish};
use super::euler::Frame;
use super::exporter::several_joints;
use super::options::Zeros;
use super::steps::{Step, fit, motion, ranges};
use super::{Export, ExportError, Exporter, Format, Job};
use crate::kinematics::{JointKind, Pose, Robot, RobotSource};

pub(super) const FORMAT: Format = Format {
    id: "frames",
    title: phrase!("Zeros, base and tool frame"),
    extension: "csv",
    rules: None,
    suits: several_joints,
    exporter: &FramesExport,
};

struct FramesExport;

const HEADING: &str = "what,convention,x_mm,y_mm,z_mm,a,b,c,d,unit";

/// What the controller takes.
struct ControllerFrames {
    base: Pose,
    zeros: Vec<f64>,
    /// Behind the nominal tool.
    tool: Pose,
}

impl Exporter for FramesExport {
    fn export(&self, job: &Job) -> Result<Export, ExportError> {
        let mut found = None;
        let plain = Chain::new(job, Zeros::Origins)?;
        let mut chain = Chain::taking(job, Zeros::Controller, |offsets| {
            let fitted = fitted(job, &plain, offsets);
            let zeros = fitted.zeros.clone();
            found = Some(fitted);
            Ok(zeros)
        })?;
        let Some(found) = found else {
            return Err(ExportError::ReadBack("no frames".to_owned()));
        };
        // They take over what they can of the links, so that none of them is in a geometry.
        chain.offsets.clone_from(&chain.taken);
        let text = write(job, &found);
        // The nominal links between the two frames; its zeros are the controller's.
        let nominal = &job.calibration.model.robot;
        let mut robot = nominal.clone();
        for joint in &mut robot.joints {
            joint.axis = joint.axis.moved_by(&found.base);
        }
        robot.base_from_tool = found.base * nominal.base_from_tool * found.tool;
        robot.source = RobotSource::Axes;
        let written = Written {
            level: Level::ZerosAndFrames,
            units: "mm; degrees or radians as each row says",
            sign: phrase!(
                "base: where the robot really stands, in the base frame; tool: the real tool in the frame of the nominal one (new tool data = present tool data times this); zeros: how far each joint stands beyond its command"
            ),
            frames: Some(super::description::frames(
                &found.base,
                &found.tool,
                "base: the robot's base in the base frame; tool: the real tool in the frame of the \
                 nominal one",
            )),
            zeros: Some(text!(
                "the zero offsets in this file are the controller's to take: it has to show as much more as each joint stands beyond its command"
            )),
            cannot_say: vec![text!(
                "the geometry of the links is not in these numbers: Denavit–Hartenberg rows, URDF and MJCF carry it"
            )],
            ..Written::of(FORMAT.id, text, robot)
        };
        finish(job, &chain, written)
    }
}

fn fitted(job: &Job, corrected: &Chain, offsets: &[f64]) -> ControllerFrames {
    let nominal: &Robot = &job.calibration.model.robot;
    let count = nominal.joints.len();
    let mut steps = Step::any_motion();
    let first = steps.len();
    let mut parent = Pose::identity();
    for (k, joint) in nominal.joints.iter().enumerate() {
        let frame = Pose::from(joint.axis.point_mm.coords);
        steps.push(Step::Fixed(parent.inverse() * frame));
        steps.push(Step::Move {
            turns: joint.kind == JointKind::Revolute,
            axis: joint.axis.direction.into_inner(),
            value: offsets[k],
            joint: Some(k),
            // Those at the ends cannot be told from base and tool.
            free: k > 0 && k + 1 < count,
        });
        parent = frame;
    }
    let last = steps.len();
    steps.push(Step::Fixed(parent.inverse() * nominal.base_from_tool));
    let tool = steps.len();
    steps.extend(Step::any_motion());
    let ranges = ranges(nominal, &job.calibration.measured);
    fit(&mut steps, &corrected.robot, &ranges);
    ControllerFrames {
        base: motion(&steps[..first], &[]),
        zeros: steps[first..last]
            .iter()
            .skip(1)
            .step_by(2)
            .map(Step::value)
            .collect(),
        tool: motion(&steps[tool..], &[]),
    }
}

fn write(job: &Job, found: &ControllerFrames) -> String {
    let nominal = &job.calibration.model.robot;
    let mut text = format!("{HEADING}\n");
    let mut frame = |what: &str, pose: &Pose| {
        let frame = Frame::of(pose);
        let [x, y, z] = frame.position_mm;
        for (convention, numbers, unit) in frame.rows() {
            let mut cells: Vec<String> = numbers.iter().map(f64::to_string).collect();
            cells.resize(4, String::new());
            let cells = cells.join(",");
            text.push_str(&format!("{what},{convention},{x},{y},{z},{cells},{unit}\n"));
        }
    };
    frame("base", &found.base);
    frame("tool behind the present tool", &found.tool);
    if let RobotSource::Dh { rows, .. } = &nominal.source
        && rows.len() == nominal.joints.len()
        && let Some(flange) = nominal.link_frames().last()
    {
        let present = flange.inverse() * nominal.base_from_tool;
        frame(
            "tool behind the last joint's frame",
            &(present * found.tool),
        );
    }
    for (k, (joint, zero)) in nominal.joints.iter().zip(&found.zeros).enumerate() {
        let (value, unit) = (joint.kind.to_display(*zero), joint.kind.unit());
        text.push_str(&format!("zero of joint {},,,,,{value},,,,{unit}\n", k + 1));
    }
    text
}
