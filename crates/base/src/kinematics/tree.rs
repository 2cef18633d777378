//! A tree of rigid bodies with joints between, as descriptions of robots have it, and a chain of it.
//!
//! ```text
//! base_from_body = base_from_parent · parent_from_body · J_1(q_1 − r_1) · … · J_k(q_k − r_k)
//! ```
//!
//! J is the motion of a joint about or along its own axis, r the value at which the description draws it. The home
//! pose is q = 0, so that a joint that is drawn at r is −r from there. The chain from a base to a tip becomes a
//! [`Robot`]: the base's frame is the base frame, the tip's the tool, each moving joint one axis at home. What is
//! fixed to a link is part of it; a side branch with its own joint is left out, because its pose is not known.

use nalgebra::{Point3, Unit, Vector3};

use crate::diagnostic::{Diagnostic, Place, Rejected};
use crate::text::Text;
use crate::units::{LARGEST_NUMBER, MM_PER_M};

use super::joint_kind::JointKind;
use super::pose::Pose;
use super::robot::{Axis, Follows, Joint, LinkMass, MOST_JOINTS, Range, Robot, RobotSource};
use super::screw::joint_motion;

/// What a joint does.
#[derive(Debug, Clone)]
pub(super) enum Motion {
    /// It turns or slides.
    Moves(JointKind),
    /// Something that no chain can have: what was found, and what was expected.
    Other(Text, Text),
}

/// A joint between a body and its parent, in the body's frame as it is drawn.
#[derive(Debug, Clone)]
pub(super) struct BodyJoint {
    pub(super) name: String,
    pub(super) motion: Motion,
    pub(super) axis: Vector3<f64>,
    pub(super) point_mm: Point3<f64>,
    /// The value at which it is drawn, rad or mm.
    pub(super) reference: f64,
    pub(super) limits: Option<Range>,
    /// Turns of the motor for one of the joint, where they are stated.
    pub(super) gear_ratio: Option<f64>,
    /// The joint that it copies, where it has no value.
    pub(super) mimic: Option<Mimic>,
    pub(super) place: Place,
}

/// The joint that another one copies, in the form of the description: value = ratio · of + offset, in the units of the
/// description (rad and m).
#[derive(Debug, Clone)]
pub(super) struct Mimic {
    pub(super) of: String,
    pub(super) ratio: f64,
    pub(super) offset: f64,
}

/// What is known of a body's mass.
#[derive(Debug, Clone, Copy)]
pub(super) enum Mass {
    /// It has none.
    None,
    /// Mass, kg, and centre in the body's frame.
    Known(f64, Point3<f64>),
    /// It has some, of unknown size.
    Unknown,
}

/// What a description calls the bodies between joints.
#[derive(Debug, Clone, Copy)]
pub(super) enum BodyName {
    Link,
    BodyOrSite,
}

impl BodyName {
    /// That there is none of this name, for the base or for the tip.
    fn lacking(self, name: &str, is_base: bool) -> Text {
        match (self, is_base) {
            (Self::Link, true) => text!("no link '{name}' for the base", name),
            (Self::Link, false) => text!("no link '{name}' for the tip", name),
            (Self::BodyOrSite, true) => text!("no body or site '{name}' for the base", name),
            (Self::BodyOrSite, false) => text!("no body or site '{name}' for the tip", name),
        }
    }
}

/// A body, or a place that is fixed to one.
#[derive(Debug, Clone)]
pub(super) struct Body {
    pub(super) name: String,
    /// Its parent's place in the list.
    pub(super) parent: Option<usize>,
    pub(super) parent_from_body: Pose,
    pub(super) joints: Vec<BodyJoint>,
    pub(super) mass: Mass,
}

#[derive(Debug)]
pub(super) struct Tree {
    pub(super) place: Place,
    pub(super) name: String,
    pub(super) bodies: Vec<Body>,
    /// What the description calls its bodies, for messages: link or body.
    pub(super) called: BodyName,
}

/// A body of the chain at home.
#[derive(Clone, Copy)]
struct Carried {
    body: usize,
    base_from_body: Pose,
    /// The last moving joint before it.
    carrier: Option<usize>,
}

impl Tree {
    /// The chain from `base` to `tip`.
    ///
    /// # Errors
    /// Names that are not there or not connected, joints that no chain can have, a chain without a
    /// moving joint, numbers too large to add up.
    pub(super) fn robot(&self, base: &str, tip: &str) -> Result<Robot, Rejected> {
        let chain = self.chain(base, tip)?;
        let mut robot = Robot {
            name: self.name.clone(),
            joints: Vec::new(),
            base_from_tool: Pose::identity(),
            gravity_m_s2: None,
            source: RobotSource::Axes,
        };
        let mut frames = Vec::new();
        let mut mimics: Vec<(usize, &BodyJoint, &Mimic)> = Vec::new();
        let mut problems = Vec::new();
        let mut base_from_body = Pose::identity();
        let mut carried = vec![Carried {
            body: chain[0],
            base_from_body,
            carrier: None,
        }];
        for &index in &chain[1..] {
            let body = &self.bodies[index];
            base_from_body *= body.parent_from_body;
            for joint in &body.joints {
                match at_home(joint, &base_from_body) {
                    Ok((moving, motion)) => {
                        let point = moving.axis.point_mm.coords;
                        base_from_body *= motion;
                        frames.push(Pose::from_parts(point.into(), base_from_body.rotation));
                        if let Some(mimic) = &joint.mimic {
                            mimics.push((robot.joints.len(), joint, mimic));
                        }
                        robot.joints.push(moving);
                        if robot.joints.len() > MOST_JOINTS {
                            let place = joint.place.clone();
                            let found = text!(
                                "more than {most} joints from base to tip",
                                most = MOST_JOINTS
                            );
                            let expected = text!("at most {most} joints", most = MOST_JOINTS);
                            return Err(Rejected::because(Diagnostic::error(
                                place, found, expected,
                            )));
                        }
                    }
                    Err((found, expected)) => {
                        let field = format!("joint '{}'", joint.name);
                        let place = joint.place.clone().in_field(field);
                        problems.push(Diagnostic::error(place, found, expected));
                    }
                }
            }
            carried.push(Carried {
                body: index,
                base_from_body,
                carrier: robot.joints.len().checked_sub(1),
            });
        }
        problems.extend(followed(&mut robot.joints, &mimics));
        if !problems.is_empty() {
            return Err(Rejected::of(problems));
        }
        if robot.joints.is_empty() {
            return Err(self.refuse(
                text!("a chain without a moving joint"),
                text!("at least one joint that turns or slides between base and tip"),
            ));
        }
        robot.base_from_tool = base_from_body;
        robot.source = RobotSource::Links(frames);
        self.add_masses(&mut robot.joints, carried);
        if robot.out_of_range(&self.place).is_empty() {
            Ok(robot)
        } else {
            Err(self.refuse(
                text!("numbers that are too large to add up"),
                text!("lengths in m and masses in kg of a robot"),
            ))
        }
    }

    fn refuse(&self, found: impl Into<Text>, expected: impl Into<Text>) -> Rejected {
        Rejected::because(Diagnostic::error(self.place.clone(), found, expected))
    }

    /// The bodies from `base` to `tip`, both included.
    fn chain(&self, base: &str, tip: &str) -> Result<Vec<usize>, Rejected> {
        let [base_at, tip_at] = [(true, base), (false, tip)].map(|(is_base, name)| {
            let called = |body: &Body| !name.is_empty() && body.name == name;
            let found = self.bodies.iter().position(called);
            found.ok_or_else(|| {
                let names = self.bodies.iter().map(|body| body.name.as_str());
                let named = names.filter(|name| !name.is_empty());
                self.refuse(
                    self.called.lacking(name, is_base),
                    text!("one of {names}", names = listed(named)),
                )
            })
        });
        let (base_at, mut at) = (base_at?, tip_at?);
        let mut chain = vec![at];
        while at != base_at {
            // A loop would come back to where it began, having used every body at most once.
            match self.bodies[at].parent {
                Some(parent) if chain.len() <= self.bodies.len() => at = parent,
                _ => {
                    let above = chain.iter().skip(1).map(|k| self.bodies[*k].name.as_str());
                    let above = listed(above.filter(|name| !name.is_empty()));
                    return Err(self.refuse(
                        text!("no chain of joints from '{base}' to '{tip}'", base, tip),
                        text!("a tip below the base; above '{tip}': {above}", tip, above),
                    ));
                }
            }
            chain.push(at);
        }
        chain.reverse();
        Ok(chain)
    }

    /// Gathers for each joint the masses of all that is rigidly behind it.
    fn add_masses(&self, joints: &mut [Joint], mut carried: Vec<Carried>) {
        let mut below: Vec<Vec<usize>> = vec![Vec::new(); self.bodies.len()];
        for (index, body) in self.bodies.iter().enumerate() {
            if let Some(parent) = body.parent {
                below[parent].push(index);
            }
        }
        let mut seen = vec![false; self.bodies.len()];
        for body in &carried {
            seen[body.body] = true;
        }
        let mut unknown = vec![false; joints.len()];
        while let Some(next) = carried.pop() {
            for &fixed in &below[next.body] {
                if self.bodies[fixed].joints.is_empty() && !seen[fixed] {
                    seen[fixed] = true;
                    carried.push(Carried {
                        body: fixed,
                        base_from_body: next.base_from_body * self.bodies[fixed].parent_from_body,
                        carrier: next.carrier,
                    });
                }
            }
            // What hangs on the base does not move.
            let Some(joint) = next.carrier else {
                continue;
            };
            match self.bodies[next.body].mass {
                Mass::Known(kg, centre) if kg > 0.0 => {
                    add_mass(&mut joints[joint].link, kg, next.base_from_body * centre);
                }
                Mass::Unknown => unknown[joint] = true,
                Mass::None | Mass::Known(..) => {}
            }
        }
        for (joint, unknown) in joints.iter_mut().zip(unknown) {
            if unknown {
                joint.link = None;
            }
        }
    }
}

/// Lets joints that copy others follow those; one that copies a copy follows what that copies.
fn followed(joints: &mut [Joint], mimics: &[(usize, &BodyJoint, &Mimic)]) -> Vec<Diagnostic> {
    let scale = |kind| match kind {
        JointKind::Revolute => 1.0,
        JointKind::Prismatic => MM_PER_M,
    };
    let mut problems = Vec::new();
    for &(joint, body, mimic) in mimics {
        let mut refuse = |found: Text, expected: Text| {
            let place = body
                .place
                .clone()
                .in_field(format!("joint '{}'", body.name));
            problems.push(Diagnostic::error(place, found, expected));
        };
        let (mut of, mut ratio, mut offset) = (mimic.of.as_str(), mimic.ratio, mimic.offset);
        let mut passed = 0;
        let leader = loop {
            let Some(leader) = joints.iter().position(|joint| joint.name == of) else {
                refuse(
                    text!(
                        "a joint that mimics '{of}', which is not between base and tip",
                        of
                    ),
                    text!(
                        "a base and a tip with both joints between, or a joint of type fixed in place of this one"
                    ),
                );
                break None;
            };
            let Some((_, _, next)) = mimics.iter().find(|(copy, ..)| *copy == leader) else {
                break Some(leader);
            };
            passed += 1;
            if passed > mimics.len() {
                refuse(
                    text!(
                        "a joint that mimics '{of}', which mimics it",
                        of = &mimic.of
                    ),
                    text!("a joint that has a value of its own"),
                );
                break None;
            }
            offset += ratio * next.offset;
            ratio *= next.ratio;
            of = next.of.as_str();
        };
        if let Some(leader) = leader {
            let own = scale(joints[joint].kind);
            joints[joint].follows = Some(Follows {
                of: leader,
                ratio: ratio * own / scale(joints[leader].kind),
                offset: offset * own,
            });
        }
    }
    problems
}

/// A joint at home in the base frame, and its motion from where it is drawn to home, in the frame
/// of its body.
fn at_home(joint: &BodyJoint, base_from_drawn: &Pose) -> Result<(Joint, Pose), (Text, Text)> {
    let kind = match &joint.motion {
        Motion::Moves(kind) => *kind,
        Motion::Other(found, expected) => return Err((found.clone(), expected.clone())),
    };
    let useless = |error: super::KinematicsError| {
        let expected = text!("a finite axis of non-zero length");
        (Text::verbatim(error.to_string()), expected)
    };
    let local = Axis::through(joint.axis, joint.point_mm).map_err(useless)?;
    let mut axis = local.moved_by(base_from_drawn);
    // Turning keeps the length up to rounding, which would add up.
    axis.direction = Unit::new_normalize(axis.direction.into_inner());
    let motion = joint_motion(&local, kind, -joint.reference);
    if kind == JointKind::Prismatic {
        axis.point_mm -= axis.direction.into_inner() * joint.reference;
    }
    let mut moving = Joint::new(&*joint.name, kind, axis);
    moving.limits = joint.limits;
    moving.gear_ratio = joint.gear_ratio;
    Ok((moving, motion))
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

/// Limits where both ends are stated.
pub(super) fn limits(from: f64, to: f64) -> Option<Range> {
    // Some programs write 1e16 for a joint without limits.
    let within = |end: f64| end.abs() <= LARGEST_NUMBER;
    let known = from < to && within(from) && within(to);
    known.then_some(Range { from, to })
}

/// The first few names, for a message.
fn listed<'a>(names: impl Iterator<Item = &'a str>) -> String {
    const SHOWN: usize = 12;
    let mut names: Vec<String> = names
        .take(SHOWN + 1)
        .map(|name| format!("'{name}'"))
        .collect();
    if names.is_empty() {
        return "nothing".to_owned();
    }
    if names.len() > SHOWN {
        names.truncate(SHOWN);
        names.push("…".to_owned());
    }
    names.join(", ")
}
