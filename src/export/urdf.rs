//! URDF: the chain as it was built, for simulators and planners.
//!
//! ```text
//! parent_from_child = Trans(xyz) · Rz(yaw) Ry(pitch) Rx(roll)       metres, radians
//! ```
//!
//! What the model knows of the geometry stands in the `origin` of the joint that it belongs to; a
//! zero offset is a turn about the joint's own axis there (`<calibration>` would be the element for
//! it, and readers ignore it). 15 decimals are written. What is no geometry (eccentricity, backlash,
//! sag …) has no place in a URDF and is stated with what it leaves.
//!
//! At home each link's frame is that of the base, moved to its joint; the joints keep their names.
//! Speeds and efforts of the joints are not known to a calibration: they are 0.
//!
//! Source: the XML specification at wiki.ros.org/urdf/XML.

use std::collections::BTreeSet;
use std::fmt::Write;

use nalgebra::{Matrix3, Vector3};
use serde::Serialize;

use super::corrected::{Corrected, differences};
use super::sidecar::{poses, sha256};
use super::{Document, Export, ExportError, Exporter, Format, Job};
use crate::compensation::{Compensation, Side, TableError};
use crate::effects::Term;
use crate::kinematics::{JointKind, Pose, Robot, robot_from_urdf};
use crate::lanes::dot;
use crate::model::Model;
use crate::model::format_v1::model_hash;
use crate::sessions::format_v1::layout::write_document;

pub(super) const FORMAT: Format = Format {
    id: "urdf",
    title: "URDF with corrected origins",
    extension: "urdf",
    rules: None,
    exporter: &Urdf,
};

struct Urdf;

const MM_PER_M: f64 = 1e3;
/// Less than this is nothing, mm.
const WORTH_A_NUMBER_MM: f64 = 5e-5;
/// A file that is read back leads to the same place up to this, mm.
const SAME_MM: f64 = 1e-9;
const SIGN: &str = "the numbers are the corrected geometry itself: where joints and tool really \
                    are; nothing is added to a command";

#[derive(Serialize)]
struct Sidecar {
    format: &'static str,
    table: String,
    table_format: &'static str,
    table_sha256: String,
    program_version: &'static str,
    session: String,
    samples_hash: String,
    model_hash: String,
    joint_name: &'static str,
    units: &'static str,
    sign: &'static str,
    example: Example,
    base_link: String,
    tip_link: String,
    carried: Vec<String>,
    left_out: Vec<String>,
    leaves: Leaves,
    notes: Vec<String>,
}

#[derive(Serialize)]
struct Example {
    says: String,
}

/// Distance between the model and the file's robot over the measured range, both directions.
#[derive(Serialize)]
struct Leaves {
    rms_mm: f64,
    nominal_rms_mm: f64,
}

impl Exporter for Urdf {
    fn export(&self, job: &Job) -> Result<Export, ExportError> {
        let calibration = job.calibration;
        if let Some(hash) = &calibration.compensated_by {
            return Err(TableError::AlreadyCompensated(hash.clone()).into());
        }
        if !calibration.regions.is_empty() {
            return Err(ExportError::Refused(
                "a correction by regions is no geometry; identify with the exact method for a URDF"
                    .to_owned(),
            ));
        }
        let corrected = Corrected::new(job);
        let names = Names::new(&corrected.robot);
        let text = write(job, &corrected, &names);
        let robot = read(&text, &names)?;
        let all = Compensation::new(calibration).robot;
        let known = Model::new(all.robot.clone(), corrected.carried.clone());
        let off = apart(job, &known, &robot);
        // NaN is wrong as well.
        if off.iter().any(|v| {
            dot(*v, *v)
                .sqrt()
                .partial_cmp(&SAME_MM)
                .is_none_or(std::cmp::Ordering::is_gt)
        }) {
            return Err(ExportError::ReadBack("it leads elsewhere".to_owned()));
        }
        let sidecar = sidecar(job, &corrected, &names, &robot, &text);
        let mut notes = vec![sidecar.example.says.clone()];
        notes.extend(sidecar.notes.iter().cloned());
        notes.extend(sidecar.left_out.iter().cloned());
        let mut json = Vec::new();
        write_document(&mut json, &sidecar).expect("writing to memory does not fail");
        Ok(Export {
            documents: Document::with_sidecar(job.file_name, text.into_bytes(), json),
            reads_as: None,
            robot: Some(robot),
            left: None,
            notes,
        })
    }
}

/// Model − chain over the measured range, from both sides.
fn apart(job: &Job, model: &Model, robot: &Robot) -> Vec<[f64; 3]> {
    let sides = [Side::Forward, Side::Reverse];
    let both = sides.map(|side| differences(&poses(job, side), model, robot));
    both.concat()
}

fn rms(vectors: &[[f64; 3]]) -> f64 {
    let sum: f64 = vectors.iter().map(|v| dot(*v, *v)).sum();
    (sum / vectors.len().max(1) as f64).sqrt()
}

fn sidecar(job: &Job, corrected: &Corrected, names: &Names, robot: &Robot, text: &str) -> Sidecar {
    let calibration = job.calibration;
    let all = Compensation::new(calibration).robot;
    let nominal = &calibration.model.robot;
    let name = |term: &Term| {
        let about = term.effect.about();
        let joint = if about.per_joint {
            format!(" of joint {}", term.joint + 1)
        } else {
            String::new()
        };
        format!("{}{joint}", about.id)
    };
    let leaves = |term: &Term| {
        let alone = Model::new(nominal.clone(), vec![term.clone()]);
        let mm = rms(&apart(job, &alone, nominal));
        let leaves = if mm < WORTH_A_NUMBER_MM {
            "at standstill, without load and at 20 °C it leaves nothing".to_owned()
        } else {
            format!("it leaves {mm:.4} mm")
        };
        format!("{} has no place in a URDF: {leaves}", name(term))
    };
    let (rms_mm, nominal_rms_mm) = (
        rms(&apart(job, &all, robot)),
        rms(&apart(job, &all, nominal)),
    );
    let tool = nominal.base_from_tool.translation.vector;
    let corrected_tool = robot.base_from_tool.translation.vector;
    let place = |v: Vector3<f64>| format!("({:.4}, {:.4}, {:.4}) mm", v.x, v.y, v.z);
    let mut notes = vec![format!(
        "this robot is {rms_mm:.4} mm from the model over the measured range, the nominal one \
         {nominal_rms_mm:.4} mm (root mean square)"
    )];
    if names.changed {
        notes.push(
            "names that are empty or not unique were changed: a URDF needs one for each".to_owned(),
        );
    }
    Sidecar {
        format: "truepose-table/1",
        table: job.file_name.to_owned(),
        table_format: "urdf",
        table_sha256: sha256(text.as_bytes()),
        program_version: env!("CARGO_PKG_VERSION"),
        session: calibration.session.clone(),
        samples_hash: calibration.samples_hash.clone(),
        model_hash: model_hash(calibration),
        joint_name: "all",
        units: "metres and radians",
        sign: SIGN,
        example: Example {
            says: format!(
                "at home the tool was drawn at {}, and this robot has it at {}",
                place(tool),
                place(corrected_tool)
            ),
        },
        base_link: names.links[0].clone(),
        tip_link: names.links[names.links.len() - 1].clone(),
        carried: corrected.carried.iter().map(name).collect(),
        left_out: corrected.left_out.iter().map(leaves).collect(),
        leaves: Leaves {
            rms_mm,
            nominal_rms_mm,
        },
        notes,
    }
}

/// Unique names for links and joints.
struct Names {
    robot: String,
    /// Base, one for each joint, tool.
    links: Vec<String>,
    /// One for each joint, and that of the tool.
    joints: Vec<String>,
    changed: bool,
}

impl Names {
    fn new(robot: &Robot) -> Self {
        let mut taken = BTreeSet::new();
        let mut changed = false;
        let mut joints = Vec::new();
        for (k, joint) in robot.joints.iter().enumerate() {
            let mut name = plain(&joint.name);
            if name.is_empty() || taken.contains(&name) {
                name = format!("{name}joint_{}", k + 1);
            }
            while taken.contains(&name) {
                name.push('_');
            }
            changed |= name != joint.name;
            taken.insert(name.clone());
            joints.push(name);
        }
        let mut fixed = "tool_fixed".to_owned();
        while taken.contains(&fixed) {
            fixed.push('_');
        }
        joints.push(fixed);
        let links = (0..robot.joints.len()).map(|k| format!("link_{}", k + 1));
        let links = ["base_link".to_owned()].into_iter().chain(links);
        let name = plain(&robot.name);
        Self {
            robot: if name.is_empty() {
                "robot".to_owned()
            } else {
                name
            },
            links: links.chain(["tool0".to_owned()]).collect(),
            joints,
            changed,
        }
    }
}

/// A name without what XML does not allow.
fn plain(name: &str) -> String {
    let allowed = |c: &char| !c.is_control() && !matches!(c, '\u{fffe}' | '\u{ffff}');
    name.chars().filter(allowed).collect()
}

/// Text inside an attribute.
fn escaped(text: &str) -> String {
    text.replace('&', "&amp;")
        .replace('<', "&lt;")
        .replace('>', "&gt;")
        .replace('"', "&quot;")
}

fn write(job: &Job, corrected: &Corrected, names: &Names) -> String {
    let nominal = &job.calibration.model.robot;
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
    // Frames of the links at home in the base frame: the base's own, moved to the axis.
    let frames = nominal.joints.iter().zip(&corrected.moved);
    let frames = frames.map(|(joint, moved)| moved * Pose::from(joint.axis.point_mm.coords));
    let tool = corrected.robot.base_from_tool;
    let mut parent = Pose::identity();
    for (k, frame) in frames.chain([tool]).enumerate() {
        let joint = nominal.joints.get(k);
        let kind = match joint.map(|joint| (joint.kind, joint.limits)) {
            None => "fixed",
            Some((JointKind::Revolute, None)) => "continuous",
            Some((JointKind::Revolute, Some(_))) => "revolute",
            Some((JointKind::Prismatic, _)) => "prismatic",
        };
        line(&format!(
            "  <joint name=\"{}\" type=\"{kind}\">",
            escaped(&names.joints[k])
        ));
        line(&format!("    <parent link=\"{}\"/>", names.links[k]));
        line(&format!("    <child link=\"{}\"/>", names.links[k + 1]));
        line(&format!(
            "    <origin {}/>",
            origin(&(parent.inverse() * frame))
        ));
        if let Some(joint) = joint {
            line(&format!(
                "    <axis xyz=\"{}\"/>",
                three(&joint.axis.direction)
            ));
            let metres = match joint.kind {
                JointKind::Revolute => 1.0,
                JointKind::Prismatic => MM_PER_M,
            };
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

/// Decimals that are written: 10⁻¹⁵ m or rad. What stands behind them is rounding.
const PER_UNIT: f64 = 1e15;

fn three(v: &Vector3<f64>) -> String {
    let [x, y, z] = [v.x, v.y, v.z].map(|v| (v * PER_UNIT).round() / PER_UNIT + 0.0);
    // Rust writes a number with the fewest digits that read back as the same one.
    format!("{x} {y} {z}")
}

fn origin(pose: &Pose) -> String {
    let mut text = String::new();
    let xyz = pose.translation.vector / MM_PER_M;
    let rpy = rpy(pose.rotation.to_rotation_matrix().matrix());
    let _ = write!(text, "xyz=\"{}\" rpy=\"{}\"", three(&xyz), three(&rpy));
    text
}

/// Roll, pitch and yaw of R = Rz(y) Ry(p) Rx(r). Roll is taken from what is left when yaw is undone,
/// so that near a pitch of ±90°, where either alone is uncertain, both together are not.
fn rpy(r: &Matrix3<f64>) -> Vector3<f64> {
    let pitch = (-r[(2, 0)]).atan2(r[(0, 0)].hypot(r[(1, 0)]));
    let yaw = r[(1, 0)].atan2(r[(0, 0)]);
    let (sin, cos) = yaw.sin_cos();
    let roll = (sin * r[(0, 2)] - cos * r[(1, 2)]).atan2(cos * r[(1, 1)] - sin * r[(0, 1)]);
    Vector3::new(roll, pitch, yaw)
}

fn read(text: &str, names: &Names) -> Result<Robot, ExportError> {
    let (base, tip) = (&names.links[0], &names.links[names.links.len() - 1]);
    let wrong = |error: crate::diagnostic::Rejected| ExportError::ReadBack(error.to_string());
    robot_from_urdf(text, std::path::Path::new("written.urdf"), base, tip).map_err(wrong)
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::{Rotation3, UnitQuaternion};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn roll_pitch_yaw_give_the_rotation_back_even_at_the_pole(
            axis in prop::array::uniform3(-1.0..1.0f64),
            angle in -3.0..3.0f64,
            exponent in -18.0..0.0f64,
            pole in prop::bool::ANY,
        ) {
            let near = UnitQuaternion::from_euler_angles(0.3, std::f64::consts::FRAC_PI_2, -1.1);
            let by = if pole { 10f64.powf(exponent) } else { 1.0 };
            let axis = Vector3::from(axis) + Vector3::new(1e-6, 0.0, 0.0);
            let turn = UnitQuaternion::from_scaled_axis(axis.normalize() * angle * by) * near;
            let matrix = turn.to_rotation_matrix();
            let v = rpy(matrix.matrix());
            let back = Rotation3::from_euler_angles(v.x, v.y, v.z);
            let off = (back.matrix() - matrix.matrix()).amax();
            prop_assert!(off < 1e-14, "{off}");
        }
    }
}
