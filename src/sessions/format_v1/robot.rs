//! Reads the `robot` object: joints and tool, or Denavit–Hartenberg rows, a URDF or an MJCF file.

use std::path::Path as FilePath;

use nalgebra::{Point3, Quaternion, Translation3, Unit, UnitQuaternion, Vector3};

use super::{robot_beside, robot_source, unit};
use crate::kinematics::{
    Axis, DescriptionFormat, Joint, JointKind, LinkMass, Pose, Range, Robot, RobotSource,
};
use crate::sessions::json::{Fields, Member, Node, Path, Value, optional};
use crate::units::rad_from_deg;

/// Joints from base to tool, the tool at home, and how they were given.
pub(super) struct Chain {
    pub(super) joints: Vec<Joint>,
    pub(super) base_from_tool: Pose,
    pub(super) source: RobotSource,
}

impl Chain {
    pub(super) fn of(robot: Robot) -> Self {
        Self {
            joints: robot.joints,
            base_from_tool: robot.base_from_tool,
            source: robot.source,
        }
    }

    /// Moves everything, rows and all, with the frame that they stand in.
    pub(super) fn move_by(&mut self, base: Pose) {
        for joint in &mut self.joints {
            joint.axis = joint.axis.moved_by(&base);
        }
        self.base_from_tool = base * self.base_from_tool;
        if let RobotSource::Dh {
            base_from_first, ..
        } = &mut self.source
        {
            *base_from_first = base;
        }
    }
}

const THREE_NUMBERS: &str = "an array of 3 numbers";

/// Reads a robot; `None` when anything in it is wrong. A file that it names is looked for in `folder`.
pub(crate) fn read(
    fields: &mut Fields<'_>,
    node: &Node,
    path: &Path<'_>,
    folder: Option<&FilePath>,
) -> Option<Robot> {
    let members = fields.object(node, path, "an object that describes the robot")?;
    let name = fields.required_text(members, node.at, path, "name");
    let gravity = optional(members, "gravity_m_s2").map(|node| {
        let path = &path.key("gravity_m_s2");
        let gravity = fields.numbers::<3>(node, path, THREE_NUMBERS)?;
        check_gravity(fields, node, path, Vector3::from(gravity));
        Some(Vector3::from(gravity))
    });
    let chain = chain(fields, node, members, path, folder);
    let chain = chain?;
    Some(Robot {
        name: name?,
        joints: chain.joints,
        base_from_tool: chain.base_from_tool,
        gravity_m_s2: match gravity {
            None => None,
            Some(gravity) => Some(gravity?),
        },
        source: chain.source,
    })
}

/// Nobody calibrates robots on Jupiter: the unit may be wrong.
fn check_gravity(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>, gravity: Vector3<f64>) {
    let size = gravity.norm();
    if size != 0.0 && !(9.0..=10.5).contains(&size) {
        let place = fields.place(node.at, path);
        fields.findings.push(crate::diagnostic::Diagnostic::warning(
            place,
            format!("gravity of {size} m/s²"),
            "about 9.81 m/s²",
        ));
    }
}

fn chain(
    fields: &mut Fields<'_>,
    node: &Node,
    members: &[Member],
    path: &Path<'_>,
    folder: Option<&FilePath>,
) -> Option<Chain> {
    const SOURCES: [&str; 4] = ["joints", "dh", "urdf", "mjcf"];
    const EXPECTED: &str = "one of joints (with tool), dh, urdf or mjcf";
    let given: Vec<&str> = SOURCES
        .into_iter()
        .filter(|key| optional(members, key).is_some())
        .collect();
    let [source] = given[..] else {
        let found = match given.len() {
            0 => "a robot without joints".to_owned(),
            _ => given.join(" and "),
        };
        fields.error(node.at, path, found, EXPECTED);
        return None;
    };
    let source_node = optional(members, source)?;
    let source_path = &path.key(source);
    if source == "joints" {
        let known = ["name", "joints", "tool", "gravity_m_s2", "source"];
        fields.unknown_keys(members, path, &known);
        let joints = joints(fields, source_node, source_path);
        let expected = "the pose of the tool at home";
        let tool = fields
            .required(members, node.at, path, "tool", expected)
            .and_then(|node| pose(fields, node, &path.key("tool")));
        let joints = joints?;
        let source = robot_source::source(fields, members, path, joints.len());
        return Some(Chain {
            joints,
            base_from_tool: tool?,
            source: source?,
        });
    }
    let mut known = vec!["name", source, "gravity_m_s2"];
    known.extend(robot_beside::KEYS);
    if source == "dh" {
        known.push("base");
    }
    fields.unknown_keys(members, path, &known);
    let format = match source {
        "mjcf" => DescriptionFormat::Mjcf,
        _ => DescriptionFormat::Urdf,
    };
    let chain = match source {
        "dh" => robot_source::from_dh(fields, source_node, source_path),
        _ => robot_source::from_file(fields, source_node, source_path, folder, format),
    };
    robot_beside::with(fields, members, path, chain?)
}

/// The elements of an array that has at least one.
pub(super) fn elements<'n>(
    fields: &mut Fields<'_>,
    node: &'n Node,
    path: &Path<'_>,
    expected: &str,
) -> Option<&'n [Node]> {
    match &node.value {
        Value::List(list) if !list.is_empty() => Some(list),
        _ => {
            fields.mismatch(node, path, expected);
            None
        }
    }
}

fn joints(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>) -> Option<Vec<Joint>> {
    let list = elements(fields, node, path, "an array with an object for each joint")?;
    let joints: Vec<Option<Joint>> = list
        .iter()
        .enumerate()
        .map(|(index, node)| joint(fields, node, &path.index(index)))
        .collect();
    joints.into_iter().collect()
}

fn joint(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>) -> Option<Joint> {
    const KNOWN: [&str; 7] = [
        "name",
        "kind",
        "axis",
        "point_mm",
        "limits",
        "mass_kg",
        "centre_mm",
    ];
    let members = fields.object(node, path, "an object that describes a joint")?;
    fields.unknown_keys(members, path, &KNOWN);
    let name = fields.required_text(members, node.at, path, "name");
    let kind = kind(fields, members, node.at, path);
    let axis = fields
        .required(members, node.at, path, "axis", THREE_NUMBERS)
        .and_then(|axis| direction(fields, axis, &path.key("axis")));
    let point = fields.required_numbers::<3>(members, node.at, path, "point_mm", THREE_NUMBERS);
    let limits = limits(fields, members, path, kind);
    let link = link(fields, members, node.at, path);
    Some(Joint {
        name: name?,
        kind: kind?,
        axis: Axis {
            direction: axis?,
            point_mm: Point3::from(point?),
        },
        limits: limits.ok()?,
        link: link.ok()?,
    })
}

fn kind(
    fields: &mut Fields<'_>,
    members: &[Member],
    at: usize,
    path: &Path<'_>,
) -> Option<JointKind> {
    const KINDS: &str = "\"revolute\" or \"prismatic\"";
    let node = fields.required(members, at, path, "kind", KINDS)?;
    match &node.value {
        Value::Text(kind) if kind == "revolute" => Some(JointKind::Revolute),
        Value::Text(kind) if kind == "prismatic" => Some(JointKind::Prismatic),
        _ => {
            fields.mismatch(node, &path.key("kind"), KINDS);
            None
        }
    }
}

fn direction(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>) -> Option<Unit<Vector3<f64>>> {
    let direction = fields.numbers::<3>(node, path, THREE_NUMBERS)?;
    if let Some(direction) = unit(direction) {
        return Some(Unit::new_unchecked(Vector3::from(direction)));
    }
    fields.error(
        node.at,
        path,
        "an axis of zero length",
        "a direction such as [0, 0, 1]",
    );
    None
}

/// The error was reported.
struct Reported;

/// The travel in inner units, where it is given.
fn limits(
    fields: &mut Fields<'_>,
    members: &[Member],
    path: &Path<'_>,
    kind: Option<JointKind>,
) -> Result<Option<Range>, Reported> {
    let Some(node) = optional(members, "limits") else {
        return Ok(None);
    };
    let [from, to] = ends(fields, node, &path.key("limits")).ok_or(Reported)?;
    let convert = |value| match kind {
        Some(JointKind::Prismatic) => value,
        _ => rad_from_deg(value),
    };
    Ok(Some(Range {
        from: convert(from),
        to: convert(to),
    }))
}

/// Two numbers, the smaller first.
pub(super) fn ends(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>) -> Option<[f64; 2]> {
    let [from, to] = fields.numbers::<2>(node, path, "an array of 2 numbers")?;
    if from >= to {
        let found = format!("limits from {from} to {to}");
        let expected = "limits from the smaller to the larger value";
        fields.error(node.at, path, found, expected);
        return None;
    }
    Some([from, to])
}

/// Mass and centre of the link behind a joint; where they are given.
fn link(
    fields: &mut Fields<'_>,
    members: &[Member],
    at: usize,
    path: &Path<'_>,
) -> Result<Option<LinkMass>, Reported> {
    let mass = optional(members, "mass_kg");
    let centre = optional(members, "centre_mm");
    if mass.is_none() && centre.is_none() {
        return Ok(None);
    }
    let mass = fields
        .required(
            members,
            at,
            path,
            "mass_kg",
            "the mass of the link, as centre_mm is given",
        )
        .and_then(|node| {
            let path = &path.key("mass_kg");
            let mass = fields.number(node, path)?;
            if mass < 0.0 {
                fields.mismatch(node, path, "a mass of 0 kg or more");
                return None;
            }
            Some(mass)
        });
    let centre = fields.required_numbers::<3>(
        members,
        at,
        path,
        "centre_mm",
        "the centre of the link at home (3 numbers), as mass_kg is given",
    );
    Ok(Some(LinkMass {
        mass_kg: mass.ok_or(Reported)?,
        centre_mm: Point3::from(centre.ok_or(Reported)?),
    }))
}

/// A pose at home, in the base frame.
pub(super) fn pose(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>) -> Option<Pose> {
    let members = fields.object(node, path, "an object with position_mm and quaternion_wxyz")?;
    fields.unknown_keys(members, path, &["position_mm", "quaternion_wxyz"]);
    let position = fields.required_numbers(members, node.at, path, "position_mm", THREE_NUMBERS);
    let key = "quaternion_wxyz";
    let four = "an array of 4 numbers: w, x, y, z";
    let rotation = fields
        .required(members, node.at, path, key, four)
        .and_then(|node| {
            let quaternion = fields.numbers::<4>(node, &path.key(key), four)?;
            let unit = unit(quaternion);
            if unit.is_none() {
                let expected = "a quaternion such as [1, 0, 0, 0]";
                fields.error(
                    node.at,
                    &path.key(key),
                    "a quaternion of zero length",
                    expected,
                );
            }
            unit
        });
    let position: [f64; 3] = position?;
    let [w, x, y, z] = rotation?;
    Some(Pose::from_parts(
        Translation3::from(Vector3::from(position)),
        UnitQuaternion::new_unchecked(Quaternion::new(w, x, y, z)),
    ))
}
