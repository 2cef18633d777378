//! Robots from URDF files.
//!
//! A URDF file is a tree of links; each joint is at home at its `origin` in its parent link, then
//! turns or slides about `axis`. The chain from `base` to `tip` becomes a [`Robot`]: frame of the
//! base link as base frame, frame of the tip link as tool, each moving joint one axis
//!
//! ```text
//! base_from_link(k) = base_from_link(k−1) · Trans(xyz) · Rz(yaw) Ry(pitch) Rx(roll)
//! axis direction = rotation of base_from_link(k) · axis,   axis point = its origin
//! ```
//!
//! Metres become mm; fixed joints are folded into what they carry. `continuous` is a revolute joint
//! without limits. A joint's link mass is that of its child link and of everything fixed to it, tip
//! and side branches included; a side branch with a joint of its own is left out, because its pose
//! is not known. Gravity is not part of URDF, so it stays unknown.
//!
//! Source: the XML specification at wiki.ros.org/urdf/XML. No input makes this panic.

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use nalgebra::{Point3, Translation3, UnitQuaternion, Vector3};
use urdf_rs::JointType;

use super::robot::{Axis, Joint, JointKind, LinkMass, Pose, Range, Robot};
use super::urdf_document::kinematic_part;
use crate::diagnostic::{Diagnostic, Place, Rejected};

const MM_PER_M: f64 = 1e3;

/// Files larger than this, in bytes, are no robot descriptions.
const LARGEST_FILE: u64 = 64 << 20;

/// The chain from link `base` to link `tip` of the URDF file at `path`.
///
/// # Errors
/// A file that cannot be read, and all of [`robot_from_urdf`].
pub fn robot_from_urdf_file(path: &Path, base: &str, tip: &str) -> Result<Robot, Rejected> {
    let refuse = |found: String, expected: &str| {
        Rejected::because(Diagnostic::error(Place::file(path), found, expected))
    };
    // Opening a device or a pipe could wait for ever.
    let about = std::fs::metadata(path)
        .map_err(|error| refuse(error.to_string(), "a URDF file that can be read"))?;
    if !about.is_file() {
        return Err(refuse("not a regular file".to_owned(), "a URDF file"));
    }
    if about.len() > LARGEST_FILE {
        return Err(refuse(
            format!("{} bytes", about.len()),
            "a URDF file of at most 64 MiB",
        ));
    }
    let bytes = std::fs::read(path)
        .map_err(|error| refuse(error.to_string(), "a URDF file that can be read"))?;
    let text = String::from_utf8(bytes)
        .map_err(|error| refuse(error.utf8_error().to_string(), "a URDF file in UTF-8"))?;
    robot_from_urdf(&text, path, base, tip)
}

/// The chain from link `base` to link `tip` of the URDF document `text`, which came from `file`.
///
/// # Errors
/// Text that is not URDF; links that do not exist or are not connected; a joint in the chain that
/// floats, is planar or spherical, mimics another, or has an axis of zero length; a chain without a
/// moving joint. Each names the file, and the line or the joint.
pub fn robot_from_urdf(text: &str, file: &Path, base: &str, tip: &str) -> Result<Robot, Rejected> {
    let place = Place::file(file);
    let kept = kinematic_part(text).map_err(|mistake| {
        let at = place.clone().at_line(mistake.line);
        Rejected::because(Diagnostic::error(at, mistake.found, mistake.expected))
    })?;
    let document = urdf_rs::read_from_string(&kept).map_err(|error| {
        Rejected::because(Diagnostic::error(
            place.clone(),
            error.to_string(),
            "links and joints as URDF has them",
        ))
    })?;
    let tree = Tree::of(&document, &place)?;
    let chain = tree.chain(base, tip)?;
    tree.robot(&document.name, &chain, base)
}

/// The document's links and joints, by name.
struct Tree<'a> {
    place: &'a Place,
    links: BTreeMap<&'a str, &'a urdf_rs::Link>,
    above: BTreeMap<&'a str, &'a urdf_rs::Joint>,
    below: BTreeMap<&'a str, Vec<&'a urdf_rs::Joint>>,
}

impl<'a> Tree<'a> {
    fn of(document: &'a urdf_rs::Robot, place: &'a Place) -> Result<Self, Rejected> {
        let mut problems = Vec::new();
        let mut tree = Self {
            place,
            links: BTreeMap::new(),
            above: BTreeMap::new(),
            below: BTreeMap::new(),
        };
        for link in &document.links {
            if tree.links.insert(&link.name, link).is_some() {
                problems.push(Diagnostic::error(
                    place.clone(),
                    format!("two links called '{}'", link.name),
                    "a name of its own for each link",
                ));
            }
        }
        for joint in &document.joints {
            for link in [&joint.parent.link, &joint.child.link] {
                if !tree.links.contains_key(link.as_str()) {
                    problems.push(Diagnostic::error(
                        place.clone().in_field(field(joint)),
                        format!("a link '{link}' that is not in the file"),
                        "the name of a link",
                    ));
                }
            }
            tree.below
                .entry(&joint.parent.link)
                .or_default()
                .push(joint);
            if let Some(other) = tree.above.insert(&joint.child.link, joint) {
                problems.push(Diagnostic::error(
                    place.clone().in_field(field(joint)),
                    format!(
                        "the link '{}' hangs on '{}' already",
                        joint.child.link, other.name
                    ),
                    "one parent for each link",
                ));
            }
        }
        if problems.is_empty() {
            Ok(tree)
        } else {
            Err(Rejected {
                diagnostics: problems,
            })
        }
    }

    fn refuse(&self, found: impl Into<String>, expected: impl Into<String>) -> Rejected {
        Rejected::because(Diagnostic::error(self.place.clone(), found, expected))
    }

    /// The joints from `base` to `tip`, in that order.
    fn chain(&self, base: &str, tip: &str) -> Result<Vec<&'a urdf_rs::Joint>, Rejected> {
        for (role, name) in [("base", base), ("tip", tip)] {
            if !self.links.contains_key(name) {
                return Err(self.refuse(
                    format!("no link '{name}' for the {role}"),
                    format!("one of {}", listed(self.links.keys())),
                ));
            }
        }
        let mut chain = Vec::new();
        let mut link = tip;
        while link != base {
            // A loop would come back to where it began, having used every joint at most once.
            let joint = match self.above.get(link) {
                Some(joint) if chain.len() < self.above.len() => *joint,
                _ => {
                    return Err(self.refuse(
                        format!("no chain of joints from '{base}' to '{tip}'"),
                        format!("a tip below the base; above '{tip}' stand {}", {
                            let names = chain.iter().map(|j: &&urdf_rs::Joint| &j.parent.link);
                            listed(names)
                        }),
                    ));
                }
            };
            chain.push(joint);
            link = &joint.parent.link;
        }
        chain.reverse();
        Ok(chain)
    }

    fn robot(
        &self,
        name: &str,
        chain: &[&'a urdf_rs::Joint],
        base: &str,
    ) -> Result<Robot, Rejected> {
        let mut joints = Vec::new();
        let mut problems = Vec::new();
        let mut base_from_link = Pose::identity();
        // Links of the chain with the moving joint that carries each.
        let mut carried = vec![(base, base_from_link, None)];
        for urdf_joint in chain {
            base_from_link *= pose(&urdf_joint.origin);
            match moving_joint(urdf_joint, &base_from_link) {
                Ok(joint) => joints.extend(joint),
                Err((found, expected)) => {
                    let at = self.place.clone().in_field(field(urdf_joint));
                    problems.push(Diagnostic::error(at, found, expected));
                }
            }
            let carrier = joints.len().checked_sub(1);
            carried.push((&urdf_joint.child.link, base_from_link, carrier));
        }
        if !problems.is_empty() {
            return Err(Rejected {
                diagnostics: problems,
            });
        }
        if joints.is_empty() {
            return Err(self.refuse(
                "a chain without a moving joint",
                "at least one revolute, continuous or prismatic joint between base and tip",
            ));
        }
        self.add_link_masses(&mut joints, carried);
        let robot = Robot {
            name: name.to_owned(),
            joints,
            base_from_tool: base_from_link,
            gravity_m_s2: None,
        };
        let finite = |point: &Vector3<f64>| point.iter().all(|x| x.is_finite());
        let all_finite = finite(&robot.base_from_tool.translation.vector)
            && robot.joints.iter().all(|joint| {
                let link = joint.link.as_ref();
                link.is_none_or(|link| link.mass_kg.is_finite() && finite(&link.centre_mm.coords))
            });
        if all_finite {
            Ok(robot)
        } else {
            Err(self.refuse(
                "numbers that are too large to add up",
                "lengths in m and masses in kg of a robot",
            ))
        }
    }

    /// Gathers for each joint the masses of all links that are rigidly behind it.
    fn add_link_masses<'b>(
        &'b self,
        joints: &mut [Joint],
        mut carried: Vec<(&'b str, Pose, Option<usize>)>,
    ) {
        let mut seen: BTreeSet<&str> = carried.iter().map(|(link, ..)| *link).collect();
        while let Some((name, base_from_link, carrier)) = carried.pop() {
            let fixed = self.below.get(name).into_iter().flatten();
            for joint in fixed.filter(|joint| joint.joint_type == JointType::Fixed) {
                if seen.insert(&joint.child.link) {
                    let pose = base_from_link * pose(&joint.origin);
                    carried.push((&joint.child.link, pose, carrier));
                }
            }
            // What hangs on the base does not move.
            let (Some(index), Some(link)) = (carrier, self.links.get(name)) else {
                continue;
            };
            let inertial = &link.inertial;
            if inertial.mass.value > 0.0 {
                let at = base_from_link * Point3::from(pose(&inertial.origin).translation.vector);
                add_mass(&mut joints[index].link, inertial.mass.value, at);
            }
        }
    }
}

fn add_mass(link: &mut Option<LinkMass>, mass_kg: f64, centre_mm: Point3<f64>) {
    *link = Some(match *link {
        None => LinkMass { mass_kg, centre_mm },
        Some(known) => {
            let both_kg = known.mass_kg + mass_kg;
            let towards = (centre_mm - known.centre_mm) * (mass_kg / both_kg);
            LinkMass {
                mass_kg: both_kg,
                centre_mm: known.centre_mm + towards,
            }
        }
    });
}

/// The joint in the base frame; none if it is fixed; what is found and expected if it is of no use.
fn moving_joint(
    joint: &urdf_rs::Joint,
    base_from_joint: &Pose,
) -> Result<Option<Joint>, (String, String)> {
    let supported = "a revolute, continuous, prismatic or fixed joint between base and tip";
    let (kind, scale) = match joint.joint_type {
        JointType::Fixed => return Ok(None),
        JointType::Revolute | JointType::Continuous => (JointKind::Revolute, 1.0),
        JointType::Prismatic => (JointKind::Prismatic, MM_PER_M),
        JointType::Floating => return Err(("a floating joint".to_owned(), supported.to_owned())),
        JointType::Planar => return Err(("a planar joint".to_owned(), supported.to_owned())),
        JointType::Spherical => return Err(("a spherical joint".to_owned(), supported.to_owned())),
    };
    if let Some(mimic) = &joint.mimic {
        return Err((
            format!("a joint that mimics '{}'", mimic.joint),
            "joints with values of their own".to_owned(),
        ));
    }
    let axis = Axis::through(
        base_from_joint.rotation * Vector3::from(joint.axis.xyz.0),
        Point3::from(base_from_joint.translation.vector),
    )
    .map_err(|error| {
        let expected = "a finite axis of non-zero length".to_owned();
        (error.to_string(), expected)
    })?;
    let mut moving = Joint::new(&*joint.name, kind, axis);
    let limits = Range {
        from: joint.limit.lower * scale,
        to: joint.limit.upper * scale,
    };
    // No limits at all read as 0…0, and an endless one as infinite.
    let known = limits.from < limits.to && limits.from.is_finite() && limits.to.is_finite();
    if joint.joint_type != JointType::Continuous && known {
        moving.limits = Some(limits);
    }
    Ok(Some(moving))
}

fn pose(origin: &urdf_rs::Pose) -> Pose {
    let [roll, pitch, yaw] = origin.rpy.0;
    let position_mm = Vector3::from(origin.xyz.0) * MM_PER_M;
    Pose::from_parts(
        Translation3::from(position_mm),
        UnitQuaternion::from_euler_angles(roll, pitch, yaw),
    )
}

fn field(joint: &urdf_rs::Joint) -> String {
    format!("joint '{}'", joint.name)
}

/// The first few names, for a message.
fn listed<S: AsRef<str>>(names: impl Iterator<Item = S>) -> String {
    const SHOWN: usize = 12;
    let mut names: Vec<String> = names
        .take(SHOWN + 1)
        .map(|name| format!("'{}'", name.as_ref()))
        .collect();
    if names.is_empty() {
        return "no links".to_owned();
    }
    if names.len() > SHOWN {
        names.truncate(SHOWN);
        names.push("…".to_owned());
    }
    names.join(", ")
}

#[cfg(test)]
#[path = "urdf_tests.rs"]
mod tests;
