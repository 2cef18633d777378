//! The `robot` object: joints and tool, or Denavit–Hartenberg rows, a URDF or an MJCF file.
//!
//! Whatever a robot was given as, it is written as joints and tool: that is what the program computes
//! with.

use crate::text::{Template, Text};
use nalgebra::{Point3, Unit, Vector3};

use super::robot_parts::{CENTRE, ENDS, JOINT_KIND, MASS, POSE, range};
use super::{robot_beside, robot_source, unit};
use crate::diagnostic::Diagnostic;
use crate::document::kinds::{NUMBER, TEXT, VECTOR, components, count, point};
use crate::document::object::{Cursor, Kind, Object, written};
use crate::document::{Value, degrees, ranges};
use crate::kinematics::{
    Axis, DescriptionFormat, Follows, Joint, JointKind, LinkMass, MOST_JOINTS, Pose, Robot,
    RobotSource,
};

/// A robot. A file that it names is looked for beside the document.
pub const ROBOT: Kind<Robot> = Kind {
    expected: phrase!("an object"),
    read: |at| {
        ranges::check(at.fields, at.node, at.path);
        at.object(blank(), robot)
    },
    write: |own| written(own.clone(), robot),
};

/// A robot of which nothing is known yet.
pub fn blank() -> Robot {
    Robot {
        name: String::new(),
        joints: Vec::new(),
        base_from_tool: Pose::identity(),
        gravity_m_s2: None,
        source: RobotSource::Axes,
    }
}

fn robot(o: &mut Object<'_, '_>, own: &mut Robot) {
    const EXPECTED: Template = phrase!("one of joints (with tool), dh, urdf or mjcf");
    let mut name = own.name.clone();
    o.required("name", &mut name, &TEXT);
    let mut given = vec!["joints"];
    if o.is_read() {
        given = vec!["joints", "dh", "urdf", "mjcf"];
        given.retain(|key| o.is_given(key));
    }
    match given[..] {
        ["joints"] => {
            o.required("joints", &mut own.joints, &JOINTS);
            o.required("tool", &mut own.base_from_tool, &POSE);
        }
        // The robot of rows or of a file has a name of its own, or none.
        ["dh"] => o.with("dh", own, phrase!(""), robot_source::from_dh, |_| None),
        [key @ ("urdf" | "mjcf")] => {
            let format = match key {
                "urdf" => DescriptionFormat::Urdf,
                _ => DescriptionFormat::Mjcf,
            };
            let read = |at: &mut Cursor<'_, '_>| robot_source::from_file(at, format);
            o.with(key, own, robot_source::FILE, read, |_| None);
        }
        _ => {
            let sources = ["joints", "dh", "urdf", "mjcf"];
            let beside = ["tool", "base", "limits", "masses", "gear_ratios", "source"];
            sources
                .into_iter()
                .chain(beside)
                .for_each(|key| o.know(key));
            let found = match given[..] {
                [] => text!("a robot without joints"),
                _ => Text::verbatim(given.join(" and ")),
            };
            o.error(found, EXPECTED);
        }
    }
    own.name = name;
    o.optional("gravity_m_s2", &mut own.gravity_m_s2, &GRAVITY);
    match given[..] {
        ["joints"] => robot_source::source(o, own),
        [source] => robot_beside::with(o, own, source),
        _ => {}
    }
}

/// Beyond any planet where robots are calibrated: the unit may be wrong.
const GRAVITY: Kind<Vector3<f64>> = Kind {
    read: |at| {
        let gravity = (VECTOR.read)(at)?;
        let size = gravity.norm();
        if size != 0.0 && !(9.0..=10.5).contains(&size) {
            let place = at.fields.place(at.node.at, at.path);
            let found = Text::verbatim(format!("{size} m/s²"));
            let warning = Diagnostic::warning(place, found, Text::verbatim("9.81 m/s²"));
            at.fields.findings.push(warning);
        }
        Some(gravity)
    },
    ..VECTOR
};

const JOINTS: Kind<Vec<Joint>> = Kind {
    expected: phrase!("an array with an object for each joint"),
    read: |at| match &at.node.value {
        Value::List(all) if all.len() > MOST_JOINTS => {
            let expected = text!("at most {most} joints", most = MOST_JOINTS);
            at.error(text!("{joints} joints", joints = all.len()), expected)
        }
        _ => at.some(&JOINT),
    },
    write: |all| all.iter().map(JOINT.write).collect(),
};

const JOINT: Kind<Joint> = Kind {
    expected: phrase!("an object"),
    read: |at| {
        let blank = Joint {
            name: String::new(),
            kind: JointKind::Revolute,
            axis: Axis {
                direction: Vector3::z_axis(),
                point_mm: Point3::origin(),
            },
            limits: None,
            link: None,
            follows: None,
            gear_ratio: None,
        };
        at.object(blank, joint)
    },
    write: |own| written(own.clone(), joint),
};

fn joint(o: &mut Object<'_, '_>, own: &mut Joint) {
    o.required("name", &mut own.name, &TEXT);
    o.required("kind", &mut own.kind, &JOINT_KIND);
    o.required("axis", &mut own.axis.direction, &AXIS);
    o.required("point_mm", &mut own.axis.point_mm, &point(VECTOR.expected));
    let (kind, limits) = (own.kind, own.limits);
    let mut ends = limits.map(|limits| [limits.from, limits.to].map(|end| to_display(kind, end)));
    o.optional("limits", &mut ends, &ENDS);
    own.limits = ends.map(|ends| range(kind, ends));
    for key in ["mass_kg", "centre_mm"] {
        o.know(key);
    }
    if own.link.is_some() || o.is_read() && (o.is_given("mass_kg") || o.is_given("centre_mm")) {
        let mut link = own.link.unwrap_or(LinkMass {
            mass_kg: 0.0,
            centre_mm: Point3::origin(),
        });
        o.required("mass_kg", &mut link.mass_kg, &MASS);
        o.required("centre_mm", &mut link.centre_mm, &CENTRE);
        own.link = Some(link);
    }
    o.optional("follows", &mut own.follows, &FOLLOWS);
    o.optional("gear_ratio", &mut own.gear_ratio, &GEAR_RATIO);
}

/// Turns of the motor for one of a joint.
const GEAR_RATIO: Kind<f64> = Kind {
    expected: phrase!("a number above 0"),
    read: |at| {
        let ratio = NUMBER.read(at.fields, at.node, at.path)?;
        Some(ratio)
            .filter(|ratio| *ratio > 0.0)
            .or_else(|| at.wrong())
    },
    write: NUMBER.write,
};

const FOLLOWS: Kind<Follows> = Kind {
    expected: phrase!("an object"),
    read: |at| {
        let blank = Follows {
            of: 0,
            ratio: 1.0,
            offset: 0.0,
        };
        at.object(blank, follows)
    },
    write: |own| written(*own, follows),
};

/// The joint counts from 1; ratio and offset are in rad and mm, as the geometry is.
fn follows(o: &mut Object<'_, '_>, own: &mut Follows) {
    let mut joint = own.of + 1;
    o.required(
        "joint",
        &mut joint,
        &count(phrase!("the number of a joint, from 1 on")),
    );
    own.of = joint.saturating_sub(1);
    o.required("ratio", &mut own.ratio, &NUMBER);
    o.required("offset", &mut own.offset, &NUMBER);
}

/// A value of a joint as a file says it: degrees that are read as the same angle, or mm.
pub fn to_display(kind: JointKind, inner: f64) -> f64 {
    match kind {
        JointKind::Revolute => degrees(inner),
        JointKind::Prismatic => inner,
    }
}

const AXIS: Kind<Unit<Vector3<f64>>> = Kind {
    expected: VECTOR.expected,
    read: |at| {
        let direction = unit(at.numbers::<3>()?).map(|d| Unit::new_unchecked(d.into()));
        direction.or_else(|| at.error(text!("zero length"), Text::verbatim("[0, 0, 1]")))
    },
    write: components,
};
