//! The `poses` object: a sweep, a list, or random ones.

use super::values::{FLAG, WHOLE};
use crate::document::kinds::NUMBER;
use crate::document::object::{Cursor, Kind};
use crate::document::{Fields, Node, Path, Value, optional};
use crate::kinematics::{JointKind, Robot};
use crate::simulation::scenario::{Order, Poses, Stop, Sweep};
use crate::text::{Template, Text};

pub(super) fn poses(
    fields: &mut Fields<'_>,
    node: &Node,
    path: &Path<'_>,
    robot: &Robot,
) -> Option<Poses> {
    const EXPECTED: Template = phrase!("one of sweep, list or random");
    let members = fields.object(node, path, text!("an object with sweep, list or random"))?;
    fields.unknown_keys(members, path, &["sweep", "list", "random"]);
    let given: Vec<&str> = ["sweep", "list", "random"]
        .into_iter()
        .filter(|key| optional(members, key).is_some())
        .collect();
    let [kind] = given[..] else {
        let found = match given.len() {
            0 => text!("no poses"),
            _ => Text::verbatim(given.join(" and ")),
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
            let mut at = Cursor {
                fields,
                node,
                path,
                expected: phrase!("an object with count").into(),
            };
            let count = at.object(0, |o, count| {
                if o.needs("count", phrase!("a number of poses")) {
                    o.field("count", count, &WHOLE);
                }
            })?;
            usize::try_from(count).ok().map(Poses::Random)
        }
    }
}

fn sweep(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>, robot: &Robot) -> Option<Sweep> {
    let mut at = Cursor {
        fields,
        node,
        path,
        expected: phrase!("an object with joint, from_deg, to_deg and step_deg").into(),
    };
    let mut sweep = Sweep {
        joint: 0,
        from: 0.0,
        to: 0.0,
        step: 0.0,
        both_ways: false,
        repeats: 1,
        order: Order::Sweep,
    };
    let good = at.fill(&mut sweep, |o, own| {
        let (mut joint, mut repeats) = (1, 1);
        o.usual("joint", &mut joint, &WHOLE);
        let index = usize::try_from(joint).ok().and_then(|j| j.checked_sub(1));
        let found = index.and_then(|index| robot.joints.get(index));
        if found.is_none() {
            let expected = text!("a joint from 1 to {joints}", joints = robot.joints.len());
            o.error_in("joint", Text::verbatim(joint.to_string()), expected);
        }
        o.end_if_wrong();
        own.joint = index.unwrap_or_default();
        let kind = found.map_or(JointKind::Revolute, |found| found.kind);
        let values = [
            (["from_deg", "from_mm"], &mut own.from),
            (["to_deg", "to_mm"], &mut own.to),
            (["step_deg", "step_mm"], &mut own.step),
        ];
        for ([deg, mm], value) in values {
            o.know(deg);
            o.know(mm);
            let slides = kind == JointKind::Prismatic;
            let key = if slides && o.is_given(mm) { mm } else { deg };
            o.required(key, value, &NUMBER);
            *value = kind.to_base_units(*value);
        }
        o.usual("both_ways", &mut own.both_ways, &FLAG);
        o.usual("repeats", &mut repeats, &WHOLE);
        own.repeats = usize::try_from(repeats).unwrap_or(usize::MAX);
        o.usual("order", &mut own.order, &ORDER);
    });
    good.then_some(sweep)
}

const ORDER: Kind<Order> = Kind {
    expected: phrase!("\"sweep\" or \"random\""),
    read: |at| at.one_of(&[Order::Sweep, Order::Random], order),
    write: |own| order(*own).into(),
};

fn order(own: Order) -> &'static str {
    match own {
        Order::Sweep => "sweep",
        Order::Random => "random",
    }
}

fn list(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>, robot: &Robot) -> Option<Vec<Stop>> {
    let Value::List(list) = &node.value else {
        fields.mismatch(node, path, text!("an array of objects with q_deg"));
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
        text!("an object with q_deg, and dir where it is known"),
    )?;
    fields.unknown_keys(members, path, &["q_deg", "dir"]);
    let joints = robot.joints.len();
    let expected = text!("an array of {joints} numbers, one for each joint", joints);
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
        fields.error(node.at, path, text!("no key 'q_deg'"), expected);
        return None;
    };
    if let Some((node, dir)) = &dir
        && dir.iter().any(|d| ![-1.0, 0.0, 1.0].contains(d))
    {
        fields.mismatch(
            node,
            &path.key("dir"),
            text!("1, -1 or 0 (unknown) for each joint"),
        );
        return None;
    }
    let kinds = robot.joints.iter().map(|j| j.kind);
    Some(Stop {
        q: kinds
            .zip(q?)
            .map(|(kind, q)| kind.to_base_units(q))
            .collect(),
        dir: dir.map(|(_, dir)| dir),
    })
}
