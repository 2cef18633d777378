//! Robots from MJCF files, the format of `MuJoCo`.
//!
//! A model is a tree of bodies in `worldbody`. A body has its `pos` and its orientation in its parent; its joints,
//! hinges or slides, follow one another in the order of the file, each about its own `pos` and `axis` in the body's
//! frame. A joint value is q − `ref` away from where the file draws the body. Base and tip are bodies or sites
//! (`world` is the outermost body; where a body and a site have one name, the body is meant).
//!
//! Read are `compiler` (angle, eulerseq, autolimits), default classes and `childclass`, `frame`, orientations of every
//! kind, and files that are included from the folder of the model or below it. Angles are degrees unless the compiler
//! states radians; metres become mm. Masses come from `inertial` alone: a body whose mass the simulator would make up
//! from shapes has an unknown one. Gravity is not taken from the file. Copies (`replicate`) and `attach`ed models are
//! not read.
//!
//! Source: the XML reference at mujoco.readthedocs.io. No input makes this panic.

mod defaults;
mod orientation;

use std::collections::BTreeMap;
use std::path::Path;
use std::rc::Rc;

use nalgebra::{Point3, Translation3, Vector3};

use super::joint_kind::JointKind;
use super::pose::Pose;
use super::robot::Robot;
use super::tree::{Body, BodyJoint, BodyName, Mass, Motion, Tree, limits};
use super::xml::{Document, Include, ROOT};
use crate::diagnostic::{Place, Rejected};
use crate::units::MM_PER_M;
use defaults::Defaults;
use orientation::Angles;

/// The chain from `base` to `tip` (bodies or sites) of the MJCF document `text`, which came from
/// `file` and includes no other.
///
/// # Errors
/// Text that is not MJCF; names that do not exist or are not connected; a ball or free joint in the
/// chain, one that an equality ties to another, or an axis of zero length; a chain without a moving
/// joint. Each names the file, the line and the column.
pub fn robot_from_mjcf(text: &str, file: &Path, base: &str, tip: &str) -> Result<Robot, Rejected> {
    let alone = |name: &str| {
        let found = text!("the included file '{name}'", name);
        Err((found, text!("a document that needs no other file")))
    };
    let mut document = Document::parse(text, file)?;
    tree(&mut document, file, &alone)?.robot(base, tip)
}

/// The bodies and sites of a document, with what it includes.
pub(super) fn tree(
    document: &mut Document,
    file: &Path,
    include: Include<'_>,
) -> Result<Tree, Rejected> {
    let root = ROOT;
    if document.name(root) != "mujoco" {
        let found = text!("<{root}>", root = document.name(root));
        return Err(document.refuse(root, found, text!("<mujoco>, as an MJCF file begins")));
    }
    document.follow_includes(include)?;
    let mut reader = Reader {
        document,
        compiler: Compiler::read(document, root)?,
        defaults: Defaults::read(document, root)?,
        bodies: vec![Body {
            name: "world".to_owned(),
            parent: None,
            parent_from_body: Pose::identity(),
            joints: Vec::new(),
            mass: Mass::None,
        }],
        sites: Vec::new(),
        joints: 0,
    };
    reader.world(root)?;
    let Reader {
        mut bodies,
        sites,
        document,
        ..
    } = reader;
    // Behind the bodies, so that a body is found first where both have one name.
    bodies.extend(sites);
    tie(document, root, &mut bodies);
    Ok(Tree {
        place: Place::file(file),
        name: document
            .attribute(root, "model")
            .unwrap_or_default()
            .to_owned(),
        bodies,
        called: BodyName::BodyOrSite,
    })
}

/// The attributes of `compiler`.
struct Compiler {
    angles: Angles,
    limited_by_range: bool,
    /// Whether masses are those of `inertial`.
    masses_stand: bool,
}

impl Compiler {
    fn read(document: &Document, root: usize) -> Result<Self, Rejected> {
        let mut all = Self {
            angles: Angles::default(),
            limited_by_range: true,
            masses_stand: true,
        };
        for compiler in document.children(root, "compiler") {
            all.angles.read(document, compiler)?;
            if let Some(value) = truth(document, compiler, "autolimits")? {
                all.limited_by_range = value;
            }
            if document.attribute(compiler, "coordinate") == Some("global") {
                let expected = text!("local coordinates, as today's models have them");
                return Err(document.refuse_value(compiler, "coordinate", expected));
            }
            let total_kg = document.number(compiler, "settotalmass")?;
            let from_shapes = document.attribute(compiler, "inertiafromgeom") == Some("true");
            if from_shapes || total_kg.is_some_and(|kg| kg > 0.0) {
                all.masses_stand = false;
            }
        }
        Ok(all)
    }
}

/// `true` or `false`, where it is stated; `auto` states nothing.
fn truth(document: &Document, element: usize, name: &str) -> Result<Option<bool>, Rejected> {
    match document.attribute(element, name) {
        None | Some("auto") => Ok(None),
        Some("true") => Ok(Some(true)),
        Some("false") => Ok(Some(false)),
        Some(_) => Err(document.refuse_value(element, name, text!("true or false"))),
    }
}

struct Reader<'d> {
    document: &'d Document,
    compiler: Compiler,
    defaults: Defaults,
    bodies: Vec<Body>,
    sites: Vec<Body>,
    joints: usize,
}

/// An element that is still to be read.
struct Open {
    element: usize,
    /// The body that contains it.
    body: usize,
    /// The frames between the body and the element.
    body_from_frame: Pose,
    /// The default class of elements without one; shared, as every element within it has it.
    class: Option<Rc<str>>,
}

/// The body that contains the elements within an element, its frame in that body, and its default class.
type Surrounding = (usize, Pose, Option<Rc<str>>);

impl Reader<'_> {
    /// Reads every `worldbody`, in the order of the file.
    fn world(&mut self, root: usize) -> Result<(), Rejected> {
        let worlds = self.document.children(root, "worldbody");
        let mut open: Vec<Open> = worlds
            .map(|element| Open {
                element,
                body: 0,
                body_from_frame: Pose::identity(),
                class: None,
            })
            .collect();
        open.reverse();
        while let Some(next) = open.pop() {
            let Some((body, body_from_frame, class)) = self.read(&next)? else {
                continue;
            };
            let inside = self.document.inside(next.element).iter();
            open.extend(inside.rev().map(|&element| Open {
                element,
                body,
                body_from_frame,
                class: class.clone(),
            }));
        }
        Ok(())
    }

    /// Reads an element; where it contains others, their body, frame and default class.
    fn read(&mut self, me: &Open) -> Result<Option<Surrounding>, Rejected> {
        let document = self.document;
        let class = document.attribute(me.element, "childclass");
        let class = class.map(Rc::from).or_else(|| me.class.clone());
        match document.name(me.element) {
            "worldbody" => return Ok(Some((0, Pose::identity(), class))),
            "frame" => {
                let frame = me.body_from_frame * self.pose(&[me.element])?;
                return Ok(Some((me.body, frame, class)));
            }
            "body" => {
                let body = Body {
                    name: self.name(me.element),
                    parent: Some(me.body),
                    parent_from_body: me.body_from_frame * self.pose(&[me.element])?,
                    joints: Vec::new(),
                    mass: self.mass(me.element, class.as_deref())?,
                };
                self.bodies.push(body);
                return Ok(Some((self.bodies.len() - 1, Pose::identity(), class)));
            }
            "joint" | "freejoint" => {
                let joint = self.joint(me)?;
                self.bodies[me.body].joints.push(joint);
            }
            "site" => {
                let levels = self.levels("site", me.element, me.class.as_deref())?;
                let site = Body {
                    name: self.name(me.element),
                    parent: Some(me.body),
                    parent_from_body: me.body_from_frame * self.pose(&levels)?,
                    joints: Vec::new(),
                    mass: Mass::None,
                };
                self.sites.push(site);
            }
            _ => {}
        }
        Ok(None)
    }

    fn name(&self, element: usize) -> String {
        let name = self.document.attribute(element, "name");
        name.unwrap_or_default().to_owned()
    }

    /// Where to look for an attribute: the element itself, then its class, then what that is made of.
    fn levels(
        &self,
        kind: &'static str,
        element: usize,
        class: Option<&str>,
    ) -> Result<Vec<usize>, Rejected> {
        let own = self.document.attribute(element, "class");
        let mut levels = vec![element];
        if let Some(name) = own.or(class) {
            let of_class = self.defaults.of(kind, name).ok_or_else(|| {
                let found = text!("a default class '{name}' that is not in the file", name);
                self.document
                    .refuse(element, found, text!("the name of a class"))
            })?;
            levels.extend(of_class);
        } else {
            levels.extend(self.defaults.main(kind));
        }
        Ok(levels)
    }

    /// The first of these elements that has the attribute.
    fn having(&self, levels: &[usize], name: &str) -> Option<usize> {
        let has = |element: &&usize| self.document.attribute(**element, name).is_some();
        levels.iter().find(has).copied()
    }

    fn numbers<const N: usize>(
        &self,
        levels: &[usize],
        name: &str,
    ) -> Result<Option<[f64; N]>, Rejected> {
        match self.having(levels, name) {
            Some(element) => self.document.numbers(element, name),
            None => Ok(None),
        }
    }

    fn pose(&self, levels: &[usize]) -> Result<Pose, Rejected> {
        let pos = self.numbers::<3>(levels, "pos")?.unwrap_or_default();
        let rotation = self.compiler.angles.rotation(self.document, levels)?;
        let position_mm = Vector3::from(pos) * MM_PER_M;
        Ok(Pose::from_parts(Translation3::from(position_mm), rotation))
    }

    fn joint(&mut self, me: &Open) -> Result<BodyJoint, Rejected> {
        let element = me.element;
        let levels = self.levels("joint", element, me.class.as_deref())?;
        self.joints += 1;
        let free = self.document.name(element) == "freejoint";
        let kind = self.having(&levels, "type").map(|level| {
            let kind = self.document.attribute(level, "type");
            (level, kind.unwrap_or_default())
        });
        let other = |kind: &str| {
            let expected = text!("hinge or slide joints between base and tip");
            Motion::Other(text!("a {kind} joint", kind), expected)
        };
        let motion = match kind {
            _ if free => other("free"),
            None | Some((_, "hinge")) => Motion::Moves(JointKind::Revolute),
            Some((_, "slide")) => Motion::Moves(JointKind::Prismatic),
            Some((_, kind @ ("ball" | "free"))) => other(kind),
            Some((level, _)) => {
                let expected = text!("hinge, slide, ball or free");
                return Err(self.document.refuse_value(level, "type", expected));
            }
        };
        // Rad and mm of the joint in the file's unit.
        let unit = match motion {
            Motion::Moves(JointKind::Prismatic) => MM_PER_M,
            _ => self.compiler.angles.unit(),
        };
        let limited = match self.having(&levels, "limited") {
            Some(level) => truth(self.document, level, "limited")?,
            None => None,
        };
        let range = self.numbers::<2>(&levels, "range")?;
        let range = range.filter(|_| limited.unwrap_or(self.compiler.limited_by_range));
        let [reference] = self.numbers::<1>(&levels, "ref")?.unwrap_or_default();
        let axis = self
            .numbers::<3>(&levels, "axis")?
            .unwrap_or([0.0, 0.0, 1.0]);
        let point = self.numbers::<3>(&levels, "pos")?.unwrap_or_default();
        let name = self.name(element);
        Ok(BodyJoint {
            gear_ratio: None,
            name: if name.is_empty() {
                format!("joint {}", self.joints)
            } else {
                name
            },
            motion,
            axis: me.body_from_frame.rotation * Vector3::from(axis),
            point_mm: me.body_from_frame * Point3::from(Vector3::from(point) * MM_PER_M),
            reference: reference * unit,
            limits: range.and_then(|[from, to]| limits(from * unit, to * unit)),
            mimic: None,
            place: self.document.place(element),
        })
    }

    fn mass(&self, body: usize, class: Option<&str>) -> Result<Mass, Rejected> {
        let mut inertial = self.document.children(body, "inertial");
        if let (Some(inertial), true) = (inertial.next(), self.compiler.masses_stand) {
            let pos = self.document.numbers::<3>(inertial, "pos")?;
            let pos = Vector3::from(pos.unwrap_or_default()) * MM_PER_M;
            let mass = self.document.number(inertial, "mass")?.unwrap_or(0.0);
            return Ok(Mass::Known(mass, Point3::from(pos)));
        }
        let shapes = self.document.children(body, "geom").map(|geom| {
            let levels = self.levels("geom", geom, class)?;
            let weightless = self.numbers::<1>(&levels, "mass")? == Some([0.0]);
            Ok(!weightless)
        });
        let shapes: Result<Vec<bool>, Rejected> = shapes.collect();
        let has_shapes = shapes?.contains(&true) || !self.compiler.masses_stand;
        Ok(if has_shapes {
            Mass::Unknown
        } else {
            Mass::None
        })
    }
}

/// Joints that an equality makes follow another have no value of their own.
fn tie(document: &Document, root: usize, bodies: &mut [Body]) {
    // What each tied joint follows, by the last equality that names it.
    let mut followed: BTreeMap<&str, Option<&str>> = BTreeMap::new();
    for equality in document.children(root, "equality") {
        for tie in document.children(equality, "joint") {
            if document.attribute(tie, "active") == Some("false") {
                continue;
            }
            if let Some(follows) = document.attribute(tie, "joint1") {
                let of = document.attribute(tie, "joint2");
                followed.insert(follows, of);
            }
        }
    }
    if followed.is_empty() {
        return;
    }
    for joint in bodies.iter_mut().flat_map(|body| &mut body.joints) {
        if let Some(of) = followed.get(joint.name.as_str()) {
            let expected = text!("joints with values of their own");
            let found = match of {
                Some(of) => text!("a joint that follows {of}", of),
                None => text!("a joint that follows a constant"),
            };
            joint.motion = Motion::Other(found, expected);
        }
    }
}

#[cfg(test)]
mod tests;
