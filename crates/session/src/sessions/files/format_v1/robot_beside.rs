//! What may stand beside Denavit–Hartenberg rows, a URDF or an MJCF file, and replaces what those
//! say: the tool at home, the limits, the masses of the links, the ratios of the gears. Rows may also have a `base`: where
//! the frame before the first row stands, which carries everything behind it.

use nalgebra::Point3;

use super::robot_parts::{CENTRE, ENDS, MASS, POSE, range};
use crate::document::Value;
use crate::document::object::{Cursor, Object};
use crate::kinematics::{Joint, LinkMass, Pose, Robot, RobotSource};
use crate::text::Text;

/// Reads what stands beside `source`, one of the keys `dh`, `urdf` and `mjcf`.
pub(super) fn with(o: &mut Object<'_, '_>, robot: &mut Robot, source: &str) {
    for key in ["tool", "limits", "masses", "gear_ratios"] {
        o.know(key);
    }
    if source == "dh" {
        o.know("base");
    }
    if robot.joints.is_empty() {
        // The rows or the file were wrong.
        return;
    }
    if source == "dh" && o.is_given("base") {
        let mut base = Pose::identity();
        o.field("base", &mut base, &POSE);
        move_by(robot, base);
    }
    o.usual("tool", &mut robot.base_from_tool, &POSE);
    of_joints(o, "limits", &mut robot.joints, |joint, at| {
        if at.node.value == Value::Null {
            return true;
        }
        let ends = ENDS.read(at.fields, at.node, at.path);
        joint.limits = ends.map(|ends| range(joint.kind, ends));
        ends.is_some()
    });
    of_joints(o, "masses", &mut robot.joints, |joint, at| {
        joint.link = None;
        at.node.value == Value::Null || at.fill(&mut joint.link, mass)
    });
    gear_ratios(o, &mut robot.joints);
}

/// Moves everything, rows and all, with the frame that they stand in.
fn move_by(robot: &mut Robot, base: Pose) {
    for joint in &mut robot.joints {
        joint.axis = joint.axis.moved_by(&base);
    }
    robot.base_from_tool = base * robot.base_from_tool;
    if let RobotSource::Dh {
        base_from_first, ..
    } = &mut robot.source
    {
        *base_from_first = base;
    }
}

fn one_each(joints: &[Joint]) -> Text {
    text!(
        "an array with {joints} entries, one for each joint",
        joints = joints.len()
    )
}

/// Reads an array with one element for each joint.
fn of_joints(
    o: &mut Object<'_, '_>,
    key: &'static str,
    joints: &mut Vec<Joint>,
    take: fn(&mut Joint, &mut Cursor<'_, '_>) -> bool,
) {
    if !o.is_given(key) {
        return;
    }
    let own = joints.clone();
    let expected = one_each(joints);
    let element = text!("an object, or null");
    let read = |at: &mut Cursor<'_, '_>| at.each(own, element, take);
    o.with(key, joints, expected, read, |_| None);
}

/// Reads the ratios of the gears: a number above 0 or null, which says nothing, for each joint.
fn gear_ratios(o: &mut Object<'_, '_>, joints: &mut Vec<Joint>) {
    const KEY: &str = "gear_ratios";
    if !o.is_given(KEY) {
        return;
    }
    let expected = one_each(joints);
    let mut own = joints.clone();
    let is_one = |ratio: &f64| ratio.is_nan() || ratio.is_finite() && *ratio > 0.0;
    let read = |at: &mut Cursor<'_, '_>| match &at.node.value {
        Value::Numbers(ratios) if ratios.len() == own.len() && ratios.iter().all(is_one) => {
            for (joint, ratio) in own.iter_mut().zip(ratios) {
                joint.gear_ratio = Some(*ratio).filter(|r| !r.is_nan()).or(joint.gear_ratio);
            }
            Some(own)
        }
        // Nothing but nulls is no array of numbers, and says nothing of any joint.
        Value::List(all)
            if all.len() == own.len() && all.iter().all(|one| one.value == Value::Null) =>
        {
            Some(own)
        }
        _ => at.wrong(),
    };
    o.with(KEY, joints, expected, read, |_| None);
}

/// A mass and its centre, unless both are null.
fn mass(o: &mut Object<'_, '_>, link: &mut Option<LinkMass>) {
    let keys = ["mass_kg", "centre_mm"];
    for key in keys {
        o.know(key);
    }
    if keys.iter().any(|key| o.is_given(key)) {
        let mut own = LinkMass {
            mass_kg: 0.0,
            centre_mm: Point3::origin(),
        };
        o.required(keys[0], &mut own.mass_kg, &MASS);
        o.required(keys[1], &mut own.centre_mm, &CENTRE);
        *link = Some(own);
    }
}
