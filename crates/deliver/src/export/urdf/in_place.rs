//! The corrected robot in the file that it came from: the origins of its joints change, and nothing else.
//!
//! ```text
//! M_k = moved motion of what is behind joint k, at home, base frame
//! parent_from_joint' = (M_parent · base_from_parent)⁻¹ · M_k · base_from_joint
//! ```
//!
//! A joint's frame moves with its joint, so that its axis, the visuals and the inertials of its link keep
//! their numbers. The tool's own correction goes into the fixed joint before the tip, if there is one;
//! else a link is added for it, and no link of the file is moved.

use std::path::Path;

use super::super::chain::Chain;
use super::super::description::Written;
use super::super::names::escaped;
use super::super::{ExportError, Job, Reference};
use super::origin::origin;
use crate::diagnostic::Rejected;
use crate::kinematics::{Pose, UrdfChain, robot_from_urdf, urdf_chain_of, urdf_with};

/// A pose that changes by less is left as it is written: mm and rad.
const SAME: f64 = 1e-12;

/// The file with the chain in it.
pub(super) fn write(
    job: &Job,
    chain: &Chain,
    reference: Reference,
    format: &'static str,
) -> Result<Written, ExportError> {
    let refused = |error: Rejected| ExportError::Refused(error.describe());
    let text = std::str::from_utf8(reference.bytes).map_err(|_| {
        ExportError::Refused(text!(
            "{file}: expected a URDF file in UTF-8",
            file = reference.name
        ))
    })?;
    let file = Path::new(reference.name);
    let nominal = &job.calibration.model.robot;
    let own = urdf_chain_of(text, file, nominal).map_err(refused)?;
    let (origins, tool) = origins(chain, &own, &nominal.link_frames());
    let name = free_name(text);
    let added: Vec<(String, String, Pose)> = tool
        .map(|tool| (escaped(&own.tip), name.clone(), tool))
        .into_iter()
        .collect();
    let written = urdf_with(text, file, &origins, &added, origin).map_err(refused)?;
    let tip = if added.is_empty() {
        own.tip.clone()
    } else {
        name
    };
    let read_back = |error: Rejected| ExportError::ReadBack(error.to_string());
    let robot = robot_from_urdf(&written, file, &own.base, &tip).map_err(read_back)?;
    chain.check(job, &robot)?;
    let mut notes = vec![text!(
        "the file is {file} with the origins of {joints} joints changed; everything else in it is as it was",
        file = reference.name,
        joints = origins.len()
    )];
    if !added.is_empty() {
        notes.push(text!(
            "the corrected tool is the added link {tip}: no link of the file can be moved for it",
            tip = &tip
        ));
    }
    Ok(Written {
        ends: Some([own.base, tip]),
        notes,
        ..Written::of(format, written, robot)
    })
}

/// The new origins of the joints that change, and the tool in the tip where no joint can take it.
fn origins(
    chain: &Chain,
    own: &UrdfChain,
    nominal: &[Pose],
) -> (Vec<(String, Pose)>, Option<Pose>) {
    let mut changed = Vec::new();
    let (mut before, mut after) = (Pose::identity(), Pose::identity());
    let mut moving = 0;
    let last = own.joints.len().checked_sub(1);
    let mut tool_taken = false;
    for (index, joint) in own.joints.iter().enumerate() {
        before *= joint.parent_from_joint;
        let wanted = if joint.moves {
            let motion = chain.frames[moving] * nominal[moving].inverse();
            moving += 1;
            Some(motion * before)
        } else if Some(index) == last && own.ends_in_tool {
            tool_taken = true;
            Some(chain.robot.base_from_tool)
        } else {
            None
        };
        let Some(wanted) = wanted else {
            after *= joint.parent_from_joint;
            continue;
        };
        let origin = after.inverse() * wanted;
        if differs(&origin, &joint.parent_from_joint) {
            changed.push((joint.name.clone(), origin));
            after = wanted;
        } else {
            after *= joint.parent_from_joint;
        }
    }
    let tool = after.inverse() * chain.robot.base_from_tool;
    let needed = !tool_taken && (!own.ends_in_tool || differs(&tool, &Pose::identity()));
    (changed, needed.then_some(tool))
}

fn differs(one: &Pose, other: &Pose) -> bool {
    let apart = one.translation.vector - other.translation.vector;
    apart.norm() > SAME || one.rotation.angle_to(&other.rotation) > SAME
}

/// A name for a link that the file does not have.
fn free_name(text: &str) -> String {
    let mut name = "calibrated_tool".to_owned();
    while text.contains(&name) {
        name.push('_');
    }
    name
}
