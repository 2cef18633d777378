//! A URDF file whose joints are moved in its own text: everything else in it (links, visuals, meshes,
//! inertials, comments, other joints) stays as it is, to the byte.

use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::ops::Range;
use std::path::Path;

use roxmltree::Node;

use super::pose::Pose;
use super::robot::Robot;
use super::urdf;
use super::xml::{Document, ROOT};
use crate::diagnostic::{Diagnostic, Place, Rejected};
use crate::rounding;
use crate::text::Text;

/// A joint of a chain, as the file has it.
#[derive(Debug, Clone, PartialEq)]
pub struct UrdfJoint {
    /// Its name.
    pub name: String,
    /// Its `origin`.
    pub parent_from_joint: Pose,
    /// Whether it turns or slides.
    pub moves: bool,
}

/// A chain that was found in a file.
#[derive(Debug, Clone, PartialEq)]
pub struct UrdfChain {
    /// The link at its base.
    pub base: String,
    /// The link at its tip.
    pub tip: String,
    /// The joints between, from base to tip, fixed ones included.
    pub joints: Vec<UrdfJoint>,
    /// Whether the robot's tool is the tip; else the tip is the link behind the last joint, and the tool was stated
    /// apart from the file.
    pub ends_in_tool: bool,
}

/// The chain of a file that is this robot: its joints by their names, their axes and, if there is a
/// link for it, the tool.
///
/// # Errors
/// Text that is not URDF, and a file in which the robot is not, with what differs first.
pub fn urdf_chain_of(text: &str, file: &Path, robot: &Robot) -> Result<UrdfChain, Rejected> {
    let document = Document::parse(text, file)?;
    let tree = urdf::tree(&document, file)?;
    let refuse = |found: Text| {
        let expected = text!("the file that the robot was read from, unchanged");
        Err(Rejected::because(Diagnostic::error(
            Place::file(file),
            found,
            expected,
        )))
    };
    let mut joints: BTreeMap<&str, UrdfLink<'_>> = BTreeMap::new();
    for index in document.children(ROOT, "joint") {
        let (Some(name), Some(parent), Some(child)) = (
            document.attribute(index, "name"),
            end(&document, index, "parent"),
            end(&document, index, "child"),
        ) else {
            continue;
        };
        let joint = UrdfLink {
            index,
            parent,
            child,
            moves: document.attribute(index, "type") != Some("fixed"),
        };
        joints.insert(name, joint);
    }
    let (first, last) = (
        &robot.joints[0].name,
        &robot.joints[robot.joints.len() - 1].name,
    );
    let (Some(start), Some(stop)) = (joints.get(first.as_str()), joints.get(last.as_str())) else {
        let missing = robot
            .joints
            .iter()
            .find(|joint| !joints.contains_key(joint.name.as_str()));
        let name = missing.map_or(first, |joint| &joint.name);
        return refuse(text!("no joint '{name}' in it", name));
    };
    // Links that are fixed to where the chain begins and ends; a loop uses each joint once at most.
    let mut bases = vec![start.parent];
    while let Some(up) = joints
        .values()
        .find(|joint| joint.child == bases[bases.len() - 1])
        && !up.moves
        && bases.len() <= joints.len()
    {
        bases.push(up.parent);
    }
    let mut tips = vec![stop.child];
    let mut at = 0;
    while at < tips.len() && tips.len() <= joints.len() {
        let here = tips[at];
        let below = joints
            .values()
            .filter(|joint| !joint.moves && joint.parent == here);
        tips.extend(below.map(|joint| joint.child));
        at += 1;
    }
    let mut differs = Text::default();
    for &base in &bases {
        let Ok(found) = tree.robot(base, stop.child) else {
            continue;
        };
        if let Some(what) = difference(&found, robot) {
            differs = what;
            continue;
        }
        let is_tool = |tip: &&&str| {
            let tool = tree.robot(base, tip).map(|found| found.base_from_tool);
            tool.is_ok_and(|tool| same(&tool, &robot.base_from_tool))
        };
        let tool = tips.iter().find(is_tool);
        let tip = tool.copied().unwrap_or(stop.child);
        return Ok(UrdfChain {
            base: base.to_owned(),
            tip: tip.to_owned(),
            joints: between(&document, &joints, base, tip)?,
            ends_in_tool: tool.is_some(),
        });
    }
    refuse(differs)
}

struct UrdfLink<'d> {
    index: usize,
    parent: &'d str,
    child: &'d str,
    moves: bool,
}

fn end<'d>(document: &'d Document, joint: usize, which: &'static str) -> Option<&'d str> {
    document.attribute(document.children(joint, which).next()?, "link")
}

/// The joints from a link up to another, from base to tip.
fn between(
    document: &Document,
    joints: &BTreeMap<&str, UrdfLink<'_>>,
    base: &str,
    tip: &str,
) -> Result<Vec<UrdfJoint>, Rejected> {
    let (mut chain, mut at) = (Vec::new(), tip);
    while at != base && chain.len() <= joints.len() {
        let Some((name, joint)) = joints.iter().find(|(_, joint)| joint.child == at) else {
            break;
        };
        chain.push(UrdfJoint {
            name: (*name).to_owned(),
            parent_from_joint: urdf::origin(document, joint.index)?,
            moves: joint.moves,
        });
        at = joint.parent;
    }
    chain.reverse();
    Ok(chain)
}

fn same(one: &Pose, other: &Pose) -> bool {
    let apart = one.translation.vector - other.translation.vector;
    apart.norm() < rounding::WRITTEN && one.rotation.angle_to(&other.rotation) < rounding::WRITTEN
}

/// What differs first between the joints of two robots.
fn difference(found: &Robot, robot: &Robot) -> Option<Text> {
    if found.joints.len() != robot.joints.len() {
        return Some(text!(
            "a chain of {found} joints in it, where the robot has {joints}",
            found = found.joints.len(),
            joints = robot.joints.len()
        ));
    }
    let differs = |(own, other): (&super::robot::Joint, &super::robot::Joint)| {
        let direction = own.axis.direction.into_inner() - other.axis.direction.into_inner();
        let off = own.axis.point_mm - other.axis.point_mm;
        let across = off - other.axis.direction.into_inner() * off.dot(&other.axis.direction);
        let elsewhere =
            own.kind == super::joint_kind::JointKind::Revolute && across.norm() > rounding::WRITTEN;
        (own.name != other.name
            || own.kind != other.kind
            || direction.norm() > rounding::COMPUTED
            || elsewhere)
            .then(|| text!("the joint '{name}' is elsewhere in it", name = &other.name))
    };
    found.joints.iter().zip(&robot.joints).find_map(differs)
}

/// The text with these joints at these origins, and links added behind others: name of the parent, of
/// the new link, and its pose in the parent. `origin` writes the attributes of a pose.
///
/// # Errors
/// Text that is not XML, and joints that are not in it.
pub fn urdf_with(
    text: &str,
    file: &Path,
    origins: &[(String, Pose)],
    added: &[(String, String, Pose)],
    origin: impl Fn(&Pose) -> String,
) -> Result<String, Rejected> {
    let text = text.strip_prefix('\u{feff}').unwrap_or(text);
    // The same rules as for reading it, and the same complaints.
    Document::parse(text, file)?;
    let options = roxmltree::ParsingOptions {
        allow_dtd: true,
        ..roxmltree::ParsingOptions::default()
    };
    let wrong = |found: Text| {
        let expected = text!("a URDF file");
        Rejected::because(Diagnostic::error(Place::file(file), found, expected))
    };
    let tree = roxmltree::Document::parse_with_options(text, options)
        .map_err(|error| wrong(Text::verbatim(error.to_string())))?;
    let mut edits: Vec<(Range<usize>, String)> = Vec::new();
    for (name, pose) in origins {
        let is = |node: &Node<'_, '_>| {
            node.has_tag_name("joint") && node.attribute("name") == Some(name.as_str())
        };
        let joint = tree.root_element().children().find(is);
        let joint = joint.ok_or_else(|| wrong(text!("no joint '{name}'", name)))?;
        let element = format!("<origin {}/>", origin(pose));
        let old = joint.children().find(|node| node.has_tag_name("origin"));
        let first = joint.children().find(Node::is_element);
        match (old, first) {
            (Some(old), _) => edits.push((old.range(), element)),
            (None, Some(first)) => {
                let at = first.range().start;
                edits.push((at..at, format!("{element}{}", indent_before(text, at))));
            }
            (None, None) => return Err(wrong(text!("an empty joint '{name}'", name))),
        }
    }
    if !added.is_empty() {
        let end = text
            .rfind("</")
            .ok_or_else(|| wrong(text!("an empty robot")))?;
        let mut links = String::new();
        for (parent, name, pose) in added {
            let _ = writeln!(
                links,
                "  <link name=\"{name}\"/>\n  <joint name=\"{name}_fixed\" type=\"fixed\">\n    <parent link=\"{parent}\"/>\n    \
                 <child link=\"{name}\"/>\n    <origin {}/>\n  </joint>",
                origin(pose)
            );
        }
        edits.push((end..end, links));
    }
    edits.sort_by_key(|(range, _)| range.start);
    let (mut written, mut at) = (String::with_capacity(text.len() + 1024), 0);
    for (range, new) in edits {
        written.push_str(&text[at..range.start]);
        written.push_str(&new);
        at = range.end;
    }
    written.push_str(&text[at..]);
    Ok(written)
}

/// A line end and the indentation of the text at `at`, where that begins a line.
fn indent_before(text: &str, at: usize) -> String {
    let start = text[..at].rfind('\n').map_or(0, |line| line + 1);
    let before = &text[start..at];
    if before.chars().all(char::is_whitespace) && start > 0 {
        format!("\n{before}")
    } else {
        String::new()
    }
}
