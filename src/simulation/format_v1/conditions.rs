//! The `conditions` object: speeds, loads, temperature, time.

use super::poses::inner;
use crate::kinematics::{JointKind, Robot};
use crate::sessions::format_v1::read::positive;
use crate::sessions::json::{Fields, Node, Path, Value, optional};
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
    const KNOWN: [&str; 5] = [
        "speed_deg_s",
        "speed_mm_s",
        "load_kg",
        "temperature_c",
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
            fields.unknown_keys(members, path, &["from", "to", "time_constant_s"]);
            let mut number = |key: &str| fields.required_number(members, node.at, path, key);
            let (from, to, tau) = (number("from"), number("to"), number("time_constant_s"));
            Temperature::WarmUp {
                from_c: from?,
                to_c: to?,
                time_constant_s: tau?,
            }
        } else {
            Temperature::Values(values(fields, node, path)?)
        });
    }
    if let Some(node) = optional(members, "seconds_per_pose") {
        let path = &path.key("seconds_per_pose");
        circumstances.seconds_per_pose = Some(positive(fields, node, path, "a time above 0 s")?);
    }
    Some(circumstances)
}
