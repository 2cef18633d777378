//! URDF: the chain as it was built, for simulators and planners.
//!
//! ```text
//! parent_from_child = Trans(xyz) · Rz(yaw) Ry(pitch) Rx(roll)       metres, radians
//! ```
//!
//! What the model knows of the geometry stands in the `origin` of the joint that it belongs to; a
//! zero offset is a turn about the joint's own axis there (`<calibration>` would be the element for
//! it, and readers ignore it), unless the controller takes it. 15 decimals are written. What is no
//! geometry (eccentricity, backlash, sag …) has no place in a URDF and is stated with what it leaves.
//!
//! At home each link's frame is the one that the robot's description had, moved to where it really
//! is; where it came as joint axes, that of the base, moved to its joint. The joints keep their
//! names. With the file that the robot came from as reference, that file is changed in place instead
//! (`in_place`). Speeds and efforts of the joints are not known to a calibration: they are 0.
//!
//! Source: the XML specification at wiki.ros.org/urdf/XML.

mod in_place;
mod origin;

use super::chain::Chain;
use super::description::{Written, finish};
use super::euler::three;
use super::exporter::any_robot;
use super::names::{Names, escaped};
use super::options::{Asked, Zeros};
use super::{Export, ExportError, Exporter, Format, Job};
use crate::kinematics::{JointKind, Pose, Robot, RobotSource, robot_from_urdf};
use crate::text::Text;
use origin::{MM_PER_M, origin};

pub(super) const FORMAT: Format = Format {
    id: "urdf",
    title: phrase!("URDF with corrected origins"),
    extension: "urdf",
    rules: None,
    suits: any_robot,
    exporter: &Urdf,
};

struct Urdf;

impl Exporter for Urdf {
    fn asks(&self, _robot: &Robot) -> Asked {
        Asked {
            zeros: Some(Zeros::default()),
            reference: true,
            ..Asked::default()
        }
    }

    fn export(&self, job: &Job) -> Result<Export, ExportError> {
        let chain = Chain::new(job, job.options.zeros.unwrap_or_default())?;
        if let Some(reference) = job.options.reference {
            let written = in_place::write(job, &chain, reference, FORMAT.id)?;
            return finish(job, &chain, written);
        }
        let names = Names::new(&chain.robot);
        let text = write(job, &chain, &names);
        let robot = read(&text, &names)?;
        chain.check(job, &robot)?;
        let written = Written {
            ends: Some(names.ends()),
            notes: [names.notes(), came_from_a_file(job)].concat(),
            ..Written::of(FORMAT.id, text, robot)
        };
        finish(job, &chain, written)
    }
}

/// That the file which the robot came from can be changed in place.
fn came_from_a_file(job: &Job) -> Vec<Text> {
    let from_links = matches!(job.calibration.model.robot.source, RobotSource::Links(_));
    let says = text!(
        "links have names of their own here, and no meshes: --reference with the URDF that the robot was read from changes the origins in that file, and nothing else in it"
    );
    from_links.then_some(says).into_iter().collect()
}

/// The file.
pub(super) fn write(job: &Job, chain: &Chain, names: &Names) -> String {
    let mut text = String::new();
    let mut line = |line: &str| {
        text.push_str(line);
        text.push('\n');
    };
    line("<?xml version=\"1.0\" encoding=\"UTF-8\"?>");
    line(&format!("<robot name=\"{}\">", escaped(&names.robot)));
    for link in &names.links {
        line(&format!("  <link name=\"{link}\"/>"));
    }
    let frames = chain.frames.iter().copied();
    let mut parent = Pose::identity();
    for (k, frame) in frames.chain([chain.robot.base_from_tool]).enumerate() {
        let joint = chain.robot.joints.get(k);
        let kind = match joint.map(|joint| (joint.kind, joint.limits)) {
            None => "fixed",
            Some((JointKind::Revolute, None)) => "continuous",
            Some((JointKind::Revolute, Some(_))) => "revolute",
            Some((JointKind::Prismatic, _)) => "prismatic",
        };
        let name = escaped(&names.joints[k]);
        line(&format!("  <joint name=\"{name}\" type=\"{kind}\">"));
        line(&format!("    <parent link=\"{}\"/>", names.links[k]));
        line(&format!("    <child link=\"{}\"/>", names.links[k + 1]));
        let origin = origin(&(parent.inverse() * frame));
        line(&format!("    <origin {origin}/>"));
        if let Some(joint) = joint {
            line(&format!("    <axis xyz=\"{}\"/>", three(&chain.axes[k])));
            let metres = match joint.kind {
                JointKind::Revolute => 1.0,
                JointKind::Prismatic => MM_PER_M,
            };
            if let Some(follows) = joint.follows {
                let leading = &chain.robot.joints[follows.of];
                let per = |kind| match kind {
                    JointKind::Revolute => 1.0,
                    JointKind::Prismatic => MM_PER_M,
                };
                line(&format!(
                    "    <mimic joint=\"{}\" multiplier=\"{}\" offset=\"{}\"/>",
                    escaped(&names.joints[follows.of]),
                    follows.ratio * per(leading.kind) / per(joint.kind),
                    follows.offset / per(joint.kind) + 0.0
                ));
            }
            // A sliding joint must have limits; without any, what was measured has to do.
            let sliding = joint.kind == JointKind::Prismatic;
            let measured = job.calibration.measured.get(k).copied().filter(|_| sliding);
            if let Some(limits) = joint.limits.or(measured) {
                line(&format!(
                    "    <limit lower=\"{}\" upper=\"{}\" effort=\"0\" velocity=\"0\"/>",
                    limits.from / metres + 0.0,
                    limits.to / metres + 0.0
                ));
            }
        }
        line("  </joint>");
        parent = frame;
    }
    line("</robot>");
    text
}

/// The chain that a file describes.
pub(super) fn read(text: &str, names: &Names) -> Result<Robot, ExportError> {
    let [base, tip] = names.ends();
    let wrong = |error: crate::diagnostic::Rejected| ExportError::ReadBack(error.to_string());
    robot_from_urdf(text, std::path::Path::new("written.urdf"), &base, &tip).map_err(wrong)
}
