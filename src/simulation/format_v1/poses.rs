//! The `poses` object: a sweep, a list, or random ones.

use super::{flag, whole};
use crate::kinematics::{JointKind, Robot};
use crate::sessions::json::{Fields, Node, Path, Value, optional};
use crate::simulation::scenario::{Order, Poses, Stop, Sweep};
use crate::units::rad_from_deg;

/// A joint value in inner units.
pub(super) fn inner(kind: JointKind, outer: f64) -> f64 {
    match kind {
        JointKind::Revolute => rad_from_deg(outer),
        JointKind::Prismatic => outer,
    }
}

pub(super) fn poses(
    fields: &mut Fields<'_>,
    node: &Node,
    path: &Path<'_>,
    robot: &Robot,
) -> Option<Poses> {
    const EXPECTED: &str = "one of sweep, list or random";
    let members = fields.object(node, path, "an object with sweep, list or random")?;
    fields.unknown_keys(members, path, &["sweep", "list", "random"]);
    let given: Vec<&str> = ["sweep", "list", "random"]
        .into_iter()
        .filter(|key| optional(members, key).is_some())
        .collect();
    let [kind] = given[..] else {
        let found = match given.len() {
            0 => "no poses".to_owned(),
            _ => given.join(" and "),
        };
        fields.error(node.at, path, found, EXPECTED);
        return None;
    };
    let node = optional(members, kind)?;
    let path = &path.key(kind);
    match kind {
        "sweep" => sweep(fields, node, path, robot).map(Poses::Sweep),
        "list" => list(fields, node, path, robot).map(Poses::List),
        _ => {
            let members = fields.object(node, path, "an object with count")?;
            fields.unknown_keys(members, path, &["count"]);
            let count = fields.required(members, node.at, path, "count", "a number of poses")?;
            let count = whole(fields, count, &path.key("count"))?;
            usize::try_from(count).ok().map(Poses::Random)
        }
    }
}

fn sweep(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>, robot: &Robot) -> Option<Sweep> {
    const KNOWN: [&str; 10] = [
        "joint",
        "from_deg",
        "to_deg",
        "step_deg",
        "from_mm",
        "to_mm",
        "step_mm",
        "both_ways",
        "repeats",
        "order",
    ];
    let members = fields.object(
        node,
        path,
        "an object with joint, from_deg, to_deg and step_deg",
    )?;
    fields.unknown_keys(members, path, &KNOWN);
    let joint = match optional(members, "joint") {
        None => 1,
        Some(node) => whole(fields, node, &path.key("joint"))?,
    };
    let index = usize::try_from(joint).ok()?.checked_sub(1);
    let Some(index) = index.filter(|index| *index < robot.joints.len()) else {
        let expected = format!("a joint from 1 to {}", robot.joints.len());
        fields.error(node.at, &path.key("joint"), joint.to_string(), expected);
        return None;
    };
    let kind = robot.joints[index].kind;
    let mut value = |stem: &str| {
        let plain = format!("{stem}_mm");
        let key = match kind {
            JointKind::Prismatic if optional(members, &plain).is_some() => plain,
            _ => format!("{stem}_deg"),
        };
        fields
            .required_number(members, node.at, path, &key)
            .map(|v| inner(kind, v))
    };
    let (from, to, step) = (value("from"), value("to"), value("step"));
    let repeats = match optional(members, "repeats") {
        None => 1,
        Some(node) => usize::try_from(whole(fields, node, &path.key("repeats"))?).ok()?,
    };
    let order = match optional(members, "order").map(|node| (node, &node.value)) {
        None => Order::Sweep,
        Some((_, Value::Text(order))) if order == "sweep" => Order::Sweep,
        Some((_, Value::Text(order))) if order == "random" => Order::Random,
        Some((node, _)) => {
            fields.mismatch(node, &path.key("order"), "\"sweep\" or \"random\"");
            return None;
        }
    };
    Some(Sweep {
        joint: index,
        from: from?,
        to: to?,
        step: step?,
        both_ways: flag(fields, members, path, "both_ways"),
        repeats,
        order,
    })
}

fn list(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>, robot: &Robot) -> Option<Vec<Stop>> {
    let Value::List(list) = &node.value else {
        fields.mismatch(node, path, "an array of objects with q_deg");
        return None;
    };
    let stops: Vec<Option<Stop>> = list
        .iter()
        .enumerate()
        .map(|(index, node)| stop(fields, node, &path.index(index), robot))
        .collect();
    stops.into_iter().collect()
}

fn stop(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>, robot: &Robot) -> Option<Stop> {
    let members = fields.object(
        node,
        path,
        "an object with q_deg, and dir where it is known",
    )?;
    fields.unknown_keys(members, path, &["q_deg", "dir"]);
    let joints = robot.joints.len();
    let expected = format!("an array of {joints} numbers, one for each joint");
    let mut each = |node: &Node, key: &str| match &node.value {
        Value::Numbers(values)
            if values.len() == joints && values.iter().all(|v| v.is_finite()) =>
        {
            Some(values.clone())
        }
        _ => {
            fields.mismatch(node, &path.key(key), &expected);
            None
        }
    };
    let q = members.iter().find(|m| m.key == "q_deg");
    let dir = match optional(members, "dir") {
        None => None,
        Some(node) => Some((node, each(node, "dir")?)),
    };
    let q = q.map(|m| each(&m.node, "q_deg"));
    let Some(q) = q else {
        fields.error(node.at, path, "no key 'q_deg'", expected);
        return None;
    };
    if let Some((node, dir)) = &dir
        && dir.iter().any(|d| ![-1.0, 0.0, 1.0].contains(d))
    {
        fields.mismatch(
            node,
            &path.key("dir"),
            "1, -1 or 0 (unknown) for each joint",
        );
        return None;
    }
    let kinds = robot.joints.iter().map(|j| j.kind);
    Some(Stop {
        q: kinds.zip(q?).map(|(kind, q)| inner(kind, q)).collect(),
        dir: dir.map(|(_, dir)| dir),
    })
}
