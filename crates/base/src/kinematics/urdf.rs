//! Robots from URDF files.
//!
//! A URDF file is a tree of links; each joint is drawn at its `origin` in its parent link, then
//! turns or slides about `axis`:
//!
//! ```text
//! base_from_link(k) = base_from_link(k−1) · Trans(xyz) · Rz(yaw) Ry(pitch) Rx(roll)
//! ```
//!
//! Metres become mm; fixed joints are merged into the links behind them. `continuous` is a revolute joint without
//! limits. Gear ratios are those of `<transmission>` elements. Gravity is not part of URDF, so it stays unknown. Only
//! what matters to kinematics is checked here: meshes, materials, plug-ins of simulators, and mistakes in them, are
//! not.
//!
//! Source: the XML specification at wiki.ros.org/urdf/XML. No input makes this panic.

use std::collections::BTreeMap;
use std::path::Path;

use nalgebra::{Point3, Quaternion, Translation3, UnitQuaternion, Vector3};

use super::joint_kind::JointKind;
use super::pose::Pose;
use super::robot::Robot;
use super::tree::{Body, BodyJoint, BodyName, Mass, Mimic, Motion, Tree, limits};
use super::xml::{Document, ROOT};
use crate::diagnostic::{Place, Rejected};
use crate::text::Template;
use crate::units::MM_PER_M;

/// The chain from link `base` to link `tip` of the URDF document `text`, which came from `file`.
///
/// # Errors
/// Text that is not URDF; links that do not exist or are not connected; a joint in the chain that
/// floats, is planar or spherical, mimics one outside the chain, or has an axis of zero length; a chain without a
/// moving joint. Each names the file, the line and the column.
pub fn robot_from_urdf(text: &str, file: &Path, base: &str, tip: &str) -> Result<Robot, Rejected> {
    tree(&Document::parse(text, file)?, file)?.robot(base, tip)
}

/// The links and joints of a document.
pub(super) fn tree(document: &Document, file: &Path) -> Result<Tree, Rejected> {
    let root = ROOT;
    if document.name(root) != "robot" {
        let found = text!("<{root}>", root = document.name(root));
        return Err(document.refuse(root, found, text!("<robot>, as a URDF file begins")));
    }
    let mut tree = Tree {
        place: Place::file(file),
        name: document
            .attribute(root, "name")
            .unwrap_or_default()
            .to_owned(),
        bodies: Vec::new(),
        called: BodyName::Link,
    };
    let mut link_of: BTreeMap<String, usize> = BTreeMap::new();
    for link in document.children(root, "link") {
        let name = document.required(link, "name")?.to_owned();
        if link_of.insert(name.clone(), tree.bodies.len()).is_some() {
            let found = text!("two links called '{name}'", name);
            return Err(document.refuse(link, found, text!("a unique name for each link")));
        }
        tree.bodies.push(Body {
            name,
            parent: None,
            parent_from_body: Pose::identity(),
            joints: Vec::new(),
            mass: mass(document, link)?,
        });
    }
    for joint in document.children(root, "joint") {
        hang(document, joint, &mut tree, &link_of)?;
    }
    let ratios = gear_ratios(document);
    for joint in tree.bodies.iter_mut().flat_map(|body| &mut body.joints) {
        // Of a slide it is turns for a length, which is another quantity.
        let turns = matches!(joint.motion, Motion::Moves(JointKind::Revolute));
        joint.gear_ratio = ratios.get(joint.name.as_str()).copied().filter(|_| turns);
    }
    Ok(tree)
}

/// Gear ratios by the names of the joints: of `<transmission>` elements with one joint, at the actuator, the joint or
/// the transmission itself, as ROS 1 (`mechanicalReduction`) and ROS 2 (`mechanical_reduction`) write them. A direct
/// drive (1), which simulators state by default, is no statement; neither is what is no number.
fn gear_ratios(document: &Document) -> BTreeMap<&str, f64> {
    let stated = |element: usize| {
        let names = ["mechanicalReduction", "mechanical_reduction"];
        let all = names
            .iter()
            .flat_map(|name| document.children(element, name));
        let mut ratios = all.filter_map(|one| document.content(one)?.parse::<f64>().ok());
        ratios
            .next()
            .map(f64::abs)
            .filter(|ratio| ratio.is_finite() && *ratio > 1.0)
    };
    let mut ratios = BTreeMap::new();
    for transmission in document.children(ROOT, "transmission") {
        let mut joints = document.children(transmission, "joint");
        let (Some(joint), None) = (joints.next(), joints.next()) else {
            continue;
        };
        let actuators = document.children(transmission, "actuator");
        let ratio = actuators.chain([joint, transmission]).find_map(stated);
        if let (Some(name), Some(ratio)) = (document.attribute(joint, "name"), ratio) {
            ratios.insert(name, ratio);
        }
    }
    ratios
}

/// Hangs the child link of a joint on its parent.
fn hang(
    document: &Document,
    joint: usize,
    tree: &mut Tree,
    link_of: &BTreeMap<String, usize>,
) -> Result<(), Rejected> {
    let end = |which: &'static str| -> Result<usize, Rejected> {
        let Some(element) = document.children(joint, which).next() else {
            let found = text!("a joint without <{element}>", element = which);
            return Err(document.refuse(joint, found, text!("<parent> and <child> in each joint")));
        };
        let link = document.required(element, "link")?;
        link_of.get(link).copied().ok_or_else(|| {
            let found = text!("a link '{link}' that is not in the file", link);
            document.refuse(element, found, text!("the name of a link"))
        })
    };
    let (parent, child) = (end("parent")?, end("child")?);
    if let Some(other) = tree.bodies[child].parent {
        let (child, other) = (&tree.bodies[child].name, &tree.bodies[other].name);
        let found = text!(
            "the link '{child}' hangs on '{other}' already",
            child,
            other
        );
        return Err(document.refuse(joint, found, text!("one parent for each link")));
    }
    let body = &mut tree.bodies[child];
    body.parent = Some(parent);
    body.parent_from_body = origin(document, joint)?;
    body.joints.extend(moving(document, joint)?);
    Ok(())
}

/// What a joint does; none if it is fixed.
fn moving(document: &Document, joint: usize) -> Result<Option<BodyJoint>, Rejected> {
    const SUPPORTED: Template =
        phrase!("a revolute, continuous, prismatic or fixed joint between base and tip");
    let kind = document.required(joint, "type")?;
    let motion = match kind {
        "fixed" => return Ok(None),
        "revolute" | "continuous" => Motion::Moves(JointKind::Revolute),
        "prismatic" => Motion::Moves(JointKind::Prismatic),
        "floating" | "planar" | "spherical" => {
            Motion::Other(text!("a {kind} joint", kind), SUPPORTED.into())
        }
        _ => return Err(document.refuse_value(joint, "type", SUPPORTED)),
    };
    let mut mimics = None;
    if let Some(mimic) = document.children(joint, "mimic").next() {
        mimics = Some(Mimic {
            of: document.required(mimic, "joint")?.to_owned(),
            ratio: document.number(mimic, "multiplier")?.unwrap_or(1.0),
            offset: document.number(mimic, "offset")?.unwrap_or(0.0),
        });
    }
    let scale = match motion {
        Motion::Moves(JointKind::Prismatic) => MM_PER_M,
        _ => 1.0,
    };
    let axis = match document.children(joint, "axis").next() {
        Some(axis) => document.numbers::<3>(axis, "xyz")?,
        None => None,
    };
    let mut ends = [0.0; 2];
    if let Some(limit) = document.children(joint, "limit").next() {
        // No limit is written as an infinite one by some programs.
        let end = |name| document.numbers_within::<1>(limit, name, |x| !x.is_nan());
        for (place, name) in ends.iter_mut().zip(["lower", "upper"]) {
            *place = end(name)?.map_or(0.0, |[end]| end * scale);
        }
    }
    Ok(Some(BodyJoint {
        name: document.required(joint, "name")?.to_owned(),
        motion,
        axis: Vector3::from(axis.unwrap_or([1.0, 0.0, 0.0])),
        point_mm: Point3::origin(),
        reference: 0.0,
        limits: (kind != "continuous")
            .then(|| limits(ends[0], ends[1]))
            .flatten(),
        gear_ratio: None,
        mimic: mimics,
        place: document.place(joint),
    }))
}

fn mass(document: &Document, link: usize) -> Result<Mass, Rejected> {
    let Some(inertial) = document.children(link, "inertial").next() else {
        return Ok(Mass::None);
    };
    let Some(element) = document.children(inertial, "mass").next() else {
        return Ok(Mass::None);
    };
    let mass = document.number(element, "value")?.unwrap_or(0.0);
    let centre = origin(document, inertial)?.translation.vector;
    Ok(Mass::Known(mass, Point3::from(centre)))
}

/// The `origin` in an element; none is the identity.
pub(super) fn origin(document: &Document, element: usize) -> Result<Pose, Rejected> {
    let Some(origin) = document.children(element, "origin").next() else {
        return Ok(Pose::identity());
    };
    let xyz = document.numbers::<3>(origin, "xyz")?.unwrap_or_default();
    let rotation = if let Some([x, y, z, w]) = document.numbers::<4>(origin, "quat_xyzw")? {
        let quaternion = Quaternion::new(w, x, y, z);
        UnitQuaternion::try_new(quaternion, 1e-12).ok_or_else(|| {
            document.refuse_value(
                origin,
                "quat_xyzw",
                text!("a quaternion of non-zero length"),
            )
        })?
    } else {
        let [roll, pitch, yaw] = document.numbers::<3>(origin, "rpy")?.unwrap_or_default();
        UnitQuaternion::from_euler_angles(roll, pitch, yaw)
    };
    let position_mm = Vector3::from(xyz) * MM_PER_M;
    Ok(Pose::from_parts(Translation3::from(position_mm), rotation))
}

#[cfg(test)]
#[path = "urdf_tests.rs"]
mod tests;
