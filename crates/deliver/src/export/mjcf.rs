//! MJCF: the chain as it was built, for `MuJoCo`.
//!
//! Bodies nested from base to tool, one joint each; metres, radians, quaternions (w, x, y, z). A
//! joint stands at its body's origin, the tool is the site `tool0`. What the model knows of the
//! geometry stands in the `pos` and `quat` of the body that it belongs to, zero offsets included,
//! unless the controller takes them. Frames are those of the URDF of the same robot. Masses are left
//! to the simulator: a calibration knows no inertia, and `boundmass` keeps it going without.
//!
//! Source: the XML reference at mujoco.readthedocs.io.

use nalgebra::Vector3;

use super::chain::Chain;
use super::description::{Written, finish};
use super::euler::{three, tidy};
use super::names::{Names, escaped};
use super::options::{Asked, Zeros};

use super::exporter::several_joints;
use super::{Export, ExportError, Exporter, Format, Job};
use crate::kinematics::{JointKind, Pose, Robot, robot_from_mjcf};

pub(super) const FORMAT: Format = Format {
    id: "mjcf",
    title: phrase!("MJCF with corrected bodies"),
    extension: "xml",
    rules: None,
    suits: several_joints,
    exporter: &Mjcf,
};

struct Mjcf;

const MM_PER_M: f64 = 1e3;

impl Exporter for Mjcf {
    fn asks(&self, _robot: &Robot) -> Asked {
        Asked {
            zeros: Some(Zeros::default()),
            ..Asked::default()
        }
    }

    fn export(&self, job: &Job) -> Result<Export, ExportError> {
        let chain = Chain::new(job, job.options.zeros.unwrap_or_default())?;
        let names = Names::new(&chain.robot);
        let text = write(&chain, &names);
        let [base, tip] = names.ends();
        let file = std::path::Path::new("written.xml");
        let robot: Robot = robot_from_mjcf(&text, file, &base, &tip)
            .map_err(|error| ExportError::ReadBack(error.to_string()))?;
        chain.check(job, &robot)?;
        let mut notes = names.notes();
        notes.push(text!(
            "masses are not written: a calibration does not know the inertia of a link"
        ));
        let written = Written {
            ends: Some([base, tip]),
            notes,
            ..Written::of(FORMAT.id, text, robot)
        };
        finish(job, &chain, written)
    }
}

fn write(chain: &Chain, names: &Names) -> String {
    let mut text = String::new();
    let mut line = |depth: usize, line: &str| {
        text.push_str(&"  ".repeat(depth));
        text.push_str(line);
        text.push('\n');
    };
    line(0, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>");
    line(0, &format!("<mujoco model=\"{}\">", escaped(&names.robot)));
    line(
        1,
        "<compiler angle=\"radian\" autolimits=\"true\" boundmass=\"1e-6\" boundinertia=\"1e-9\"/>",
    );
    line(1, "<worldbody>");
    line(2, &format!("<body name=\"{}\">", names.links[0]));
    let mut parent = Pose::identity();
    for (k, joint) in chain.robot.joints.iter().enumerate() {
        let frame = chain.frames[k];
        let body = &names.links[k + 1];
        let place = place(&(parent.inverse() * frame));
        line(k + 3, &format!("<body name=\"{body}\" {place}>"));
        let (kind, metres) = match joint.kind {
            JointKind::Revolute => ("hinge", 1.0),
            JointKind::Prismatic => ("slide", MM_PER_M),
        };
        let range = joint.limits.map_or(String::new(), |limits| {
            let [from, to] = [limits.from, limits.to].map(|end| end / metres + 0.0);
            format!(" range=\"{from} {to}\"")
        });
        let name = escaped(&names.joints[k]);
        let axis = three(&chain.axes[k]);
        line(
            k + 4,
            &format!("<joint name=\"{name}\" type=\"{kind}\" axis=\"{axis}\"{range}/>"),
        );
        parent = frame;
    }
    let depth = chain.robot.joints.len() + 3;
    let tool = place(&(parent.inverse() * chain.robot.base_from_tool));
    line(
        depth,
        &format!("<site name=\"{}\" {tool}/>", names.ends()[1]),
    );
    for depth in (2..depth).rev() {
        line(depth, "</body>");
    }
    line(1, "</worldbody>");
    line(0, "</mujoco>");
    text
}

fn place(pose: &Pose) -> String {
    let position: Vector3<f64> = (pose.translation.vector / MM_PER_M).map(tidy);
    let q = pose.rotation.quaternion();
    let [w, x, y, z] = [q.w, q.i, q.j, q.k].map(|part| part + 0.0);
    format!("pos=\"{}\" quat=\"{w} {x} {y} {z}\"", three(&position))
}
