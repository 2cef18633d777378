//! The `conditions` object: speeds, loads, temperature, time.

use super::poses::inner;
use crate::kinematics::{JointKind, Robot};
use crate::sessions::format_v1::read::positive;
use crate::sessions::json::{Fields, Member, Node, Path, Value, optional};
use crate::simulation::scenario::{Circumstances, Temperature};

/// One number or several.
fn values(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>) -> Option<Vec<f64>> {
    match &node.value {
        Value::Number(value) if value.is_finite() => Some(vec![*value]),
        Value::Numbers(values) if values.iter().all(|v| v.is_finite()) => Some(values.clone()),
        _ => {
            fields.mismatch(node, path, "a number, or an array of numbers");
            None
        }
    }
}

pub(super) fn conditions(
    fields: &mut Fields<'_>,
    node: &Node,
    path: &Path<'_>,
    robot: &Robot,
) -> Option<Circumstances> {
    const KNOWN: [&str; 7] = [
        "speed_deg_s",
        "speed_mm_s",
        "load_kg",
        "temperature_c",
        "joint_temperatures_c",
        "torques",
        "seconds_per_pose",
    ];
    let members = fields.object(node, path, "an object with the conditions")?;
    fields.unknown_keys(members, path, &KNOWN);
    let mut circumstances = Circumstances::default();
    let slides = robot.joints.iter().all(|j| j.kind == JointKind::Prismatic);
    let kind = if slides {
        JointKind::Prismatic
    } else {
        JointKind::Revolute
    };
    for key in ["speed_deg_s", "speed_mm_s"] {
        if let Some(node) = optional(members, key) {
            let speeds = values(fields, node, &path.key(key))?;
            circumstances.speeds = speeds.into_iter().map(|v| inner(kind, v)).collect();
        }
    }
    if let Some(node) = optional(members, "load_kg") {
        circumstances.loads_kg = values(fields, node, &path.key("load_kg"))?;
    }
    if let Some(node) = optional(members, "temperature_c") {
        let path = &path.key("temperature_c");
        circumstances.temperature = Some(if let Value::Object(members) = &node.value {
            warm_up(fields, members, node.at, path)?
        } else {
            Temperature::Values(values(fields, node, path)?)
        });
    }
    if let Some(node) = optional(members, "joint_temperatures_c") {
        let path = &path.key("joint_temperatures_c");
        circumstances.joint_temperatures = of_joints(fields, node, path, robot)?;
    }
    if let Some(node) = optional(members, "torques") {
        let path = &path.key("torques");
        let Value::Bool(torques) = node.value else {
            fields.mismatch(node, path, "true or false");
            return None;
        };
        circumstances.torques = torques;
    }
    if let Some(node) = optional(members, "seconds_per_pose") {
        let path = &path.key("seconds_per_pose");
        circumstances.seconds_per_pose = Some(positive(fields, node, path, "a time above 0 s")?);
    }
    Some(circumstances)
}

/// `{ from, to, time_constant_s }`.
fn warm_up(
    fields: &mut Fields<'_>,
    members: &[Member],
    at: usize,
    path: &Path<'_>,
) -> Option<Temperature> {
    fields.unknown_keys(members, path, &["from", "to", "time_constant_s"]);
    let mut number = |key: &str| fields.required_number(members, at, path, key);
    let (from, to, tau) = (number("from"), number("to"), number("time_constant_s"));
    Some(Temperature::WarmUp {
        from_c: from?,
        to_c: to?,
        time_constant_s: tau?,
    })
}

/// One warm-up or null for each joint, from the first on.
fn of_joints(
    fields: &mut Fields<'_>,
    node: &Node,
    path: &Path<'_>,
    robot: &Robot,
) -> Option<Vec<Option<Temperature>>> {
    const EXPECTED: &str = "an array with { from, to, time_constant_s } or null for each joint";
    let entries = match &node.value {
        Value::List(entries) if entries.len() <= robot.joints.len() => entries,
        _ => {
            fields.mismatch(node, path, EXPECTED);
            return None;
        }
    };
    let mut all = Vec::new();
    for (k, entry) in entries.iter().enumerate() {
        let path = &path.index(k);
        all.push(match &entry.value {
            Value::Null => None,
            Value::Object(members) => Some(warm_up(fields, members, entry.at, path)?),
            _ => {
                fields.mismatch(entry, path, EXPECTED);
                return None;
            }
        });
    }
    Some(all)
}
