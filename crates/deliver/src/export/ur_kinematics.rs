//! The `kinematics` of `ur_description`: where Universal Robots' own description keeps the
//! calibration of one robot, `kinematics_params.yaml`.
//!
//! ```text
//! parent_from_link = Trans(x, y, z) · Rz(yaw) Ry(pitch) Rx(roll),   metres, radians
//! ```
//!
//! for shoulder, `upper_arm`, forearm, `wrist_1`, `wrist_2` and `wrist_3`; each joint turns about z
//! of its link. The first is told in the controller's base frame (`base`, not `base_link`). The tool
//! of the description is the frame of `wrist_3`: what the tool itself is off has to be entered as
//! the TCP. Link frames are the ones of the robot's description where z is along the joint there,
//! else those of its Denavit–Hartenberg rows, which are the maker's.
//!
//! Source: `urdf/ur_macro.xacro` and `config/ur5e/default_kinematics.yaml` of `ur_description`.

use nalgebra::{Point3, Translation3, UnitQuaternion, Vector3};

use super::chain::Chain;
use super::description::{Written, finish, frames};
use super::dh_rows::nominal_rows;
use super::euler::Frame;
use super::euler::{rpy, tidy};
use super::options::{Asked, Zeros};

use super::{Export, ExportError, Exporter, Format, Job};
use crate::kinematics::{Axis, DhConvention, Joint, JointKind, Pose, Robot, RobotSource};
use crate::model::format_v1::model_hash;
use crate::text::entered;

pub(super) const FORMAT: Format = Format {
    id: "ur-kinematics",
    title: phrase!("Kinematics of ur_description"),
    extension: "yaml",
    rules: None,
    suits: six_that_turn,
    exporter: &UrKinematics,
};

struct UrKinematics;

const LINKS: [&str; 6] = [
    "shoulder",
    "upper_arm",
    "forearm",
    "wrist_1",
    "wrist_2",
    "wrist_3",
];
const KEYS: [&str; 6] = ["x", "y", "z", "roll", "pitch", "yaw"];
const MM_PER_M: f64 = 1e3;

fn six_that_turn(robot: &Robot) -> bool {
    let turns = |joint: &Joint| joint.kind == JointKind::Revolute;
    robot.joints.len() == LINKS.len() && robot.joints.iter().all(turns)
}

impl Exporter for UrKinematics {
    fn asks(&self, _robot: &Robot) -> Asked {
        Asked {
            zeros: Some(Zeros::default()),
            ..Asked::default()
        }
    }

    fn export(&self, job: &Job) -> Result<Export, ExportError> {
        let nominal = &job.calibration.model.robot;
        if !six_that_turn(nominal) {
            return Err(ExportError::Refused(text!(
                "the kinematics of ur_description has six turning joints, and this robot has {joints}; use urdf",
                joints = nominal.joints.len()
            )));
        }
        let chain = Chain::new(job, job.options.zeros.unwrap_or_default())?;
        let links = link_frames(nominal, &chain);
        let text = write(job, &links);
        let read = read(&text)?;
        let last = links[links.len() - 1];
        let tool = last.inverse() * chain.robot.base_from_tool;
        let robot = robot(&read, &tool)?;
        chain.check(job, &robot)?;
        let tcp = frames(
            &Pose::identity(),
            &tool,
            "base: the frame that the first link is told in; tool: the TCP in the frame of wrist_3",
        );
        let flange = Frame::of(&tool);
        let [rx, ry, rz] = flange.ur_rotation_vector_rad;
        let enter = text!(
            "set the TCP to {place} with the rotation vector {turn}: the tool is not part of this file",
            place = entered(flange.position_mm),
            turn = format!("({rx:.6}, {ry:.6}, {rz:.6}) rad")
        );
        let written = Written {
            frames: Some(tcp),
            in_the_controller: vec![enter],
            notes: vec![text!(
                "for the launch argument kinematics_params_file; the driver compares its hash with the controller's own calibration and warns that they differ"
            )],
            ..Written::of(FORMAT.id, text, robot)
        };
        finish(job, &chain, written)
    }
}

/// The frames of the links at home, z along the joints.
fn link_frames(nominal: &Robot, chain: &Chain) -> Vec<Pose> {
    let along_z = |axis: &Vector3<f64>| (axis - Vector3::z()).norm() < 1e-9;
    if chain.axes.iter().all(along_z) {
        return chain.frames.clone();
    }
    let (base, rows) = nominal_rows(nominal, DhConvention::Standard);
    let described = Robot {
        source: RobotSource::Dh {
            base_from_first: base,
            rows,
        },
        ..nominal.clone()
    };
    let own = nominal.link_frames();
    let frames = described
        .link_frames()
        .into_iter()
        .zip(own)
        .zip(&chain.frames);
    // As each frame stands to the one that the chain moves.
    frames
        .map(|((frame, own), moved)| moved * (own.inverse() * frame))
        .collect()
}

fn write(job: &Job, links: &[Pose]) -> String {
    let mut text = "kinematics:\n".to_owned();
    let mut parent = Pose::identity();
    for (name, link) in LINKS.iter().zip(links) {
        let step = parent.inverse() * link;
        let place = (step.translation.vector / MM_PER_M).map(tidy);
        let turns = rpy(step.rotation.to_rotation_matrix().matrix()).map(tidy);
        text.push_str(&format!("  {name}:\n"));
        for (key, value) in KEYS.iter().zip(place.iter().chain(turns.iter())) {
            text.push_str(&format!("    {key}: {}\n", super::rules::decimal(*value)));
        }
        parent = *link;
    }
    let hash = model_hash(job.calibration);
    text.push_str(&format!("  hash: truepose_{}\n", &hash[..16]));
    text
}

/// The steps from link to link of a file.
fn read(text: &str) -> Result<Vec<Pose>, ExportError> {
    let wrong = |what: &str| ExportError::ReadBack(what.to_owned());
    let mut steps: Vec<(String, [Option<f64>; 6])> = Vec::new();
    for line in text.lines().skip(1) {
        let (key, value) = line.split_once(':').ok_or_else(|| wrong(line))?;
        let (key, value) = (key.trim(), value.trim());
        if value.is_empty() {
            steps.push((key.to_owned(), [None; 6]));
        } else if let Some(place) = KEYS.iter().position(|known| *known == key) {
            let (_, values) = steps.last_mut().ok_or_else(|| wrong(line))?;
            values[place] = Some(value.parse().map_err(|_| wrong(line))?);
        }
    }
    if steps.iter().map(|(name, _)| name.as_str()).ne(LINKS) {
        return Err(wrong("the links"));
    }
    let pose = |(name, values): &(String, [Option<f64>; 6])| {
        let mut numbers = [0.0; 6];
        for (number, value) in numbers.iter_mut().zip(values) {
            *number = value.ok_or_else(|| wrong(name))?;
        }
        let [x, y, z, roll, pitch, yaw] = numbers;
        let place = Vector3::new(x, y, z) * MM_PER_M;
        let turn = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
        Ok(Pose::from_parts(Translation3::from(place), turn))
    };
    steps.iter().map(pose).collect()
}

/// The robot of these steps, with this tool in the last link.
fn robot(steps: &[Pose], tool: &Pose) -> Result<Robot, ExportError> {
    let mut link = Pose::identity();
    let mut joints = Vec::new();
    for (name, step) in LINKS.iter().zip(steps) {
        link *= step;
        let origin = Point3::from(link.translation.vector);
        let axis = Axis::through(link.rotation * Vector3::z(), origin)
            .map_err(|error| ExportError::ReadBack(error.to_string()))?;
        joints.push(Joint::new(*name, JointKind::Revolute, axis));
    }
    Ok(Robot {
        name: String::new(),
        joints,
        base_from_tool: link * tool,
        gravity_m_s2: None,
        source: RobotSource::Axes,
    })
}
