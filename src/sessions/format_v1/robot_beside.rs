//! What may stand beside Denavit–Hartenberg rows, a URDF or an MJCF file, and replaces what those
//! say: the tool at home, the limits, the masses of the links. Rows may also have a `base`: where
//! the frame before the first row stands, which carries everything behind it.

use nalgebra::Point3;

use super::robot::{Chain, ends, pose};
use crate::kinematics::{LinkMass, Range, RobotSource};
use crate::sessions::json::{Fields, Member, Node, Path, Value, optional};

/// The keys.
pub(super) const KEYS: [&str; 3] = ["tool", "limits", "masses"];

/// The chain with what stands beside it; `None` when any of that is wrong.
pub(super) fn with(
    fields: &mut Fields<'_>,
    members: &[Member],
    path: &Path<'_>,
    mut chain: Chain,
) -> Option<Chain> {
    let mut good = true;
    if let (RobotSource::Dh { .. }, Some(node)) = (&chain.source, optional(members, "base")) {
        match pose(fields, node, &path.key("base")) {
            Some(base) => chain.move_by(base),
            None => good = false,
        }
    }
    if let Some(node) = optional(members, "tool") {
        match pose(fields, node, &path.key("tool")) {
            Some(tool) => chain.base_from_tool = tool,
            None => good = false,
        }
    }
    if let Some(node) = optional(members, "limits") {
        let path = &path.key("limits");
        let nodes = one_each(fields, node, path, chain.joints.len(), "pair of limits");
        good &= nodes.is_some();
        for (index, node) in nodes.into_iter().flatten().enumerate() {
            let Some(node) = node else {
                continue;
            };
            let joint = &mut chain.joints[index];
            match ends(fields, node, &path.index(index)) {
                Some([from, to]) => {
                    let [from, to] = [from, to].map(|end| joint.kind.inner(end));
                    joint.limits = Some(Range { from, to });
                }
                None => good = false,
            }
        }
    }
    if let Some(node) = optional(members, "masses") {
        let path = &path.key("masses");
        let nodes = one_each(fields, node, path, chain.joints.len(), "mass, or null,");
        good &= nodes.is_some();
        for (index, node) in nodes.into_iter().flatten().enumerate() {
            let read = node.map(|node| mass(fields, node, &path.index(index)));
            match read {
                None => chain.joints[index].link = None,
                Some(Some(link)) => chain.joints[index].link = link,
                Some(None) => good = false,
            }
        }
    }
    good.then_some(chain)
}

/// One element for each joint; null is none.
fn one_each<'n>(
    fields: &mut Fields<'_>,
    node: &'n Node,
    path: &Path<'_>,
    joints: usize,
    what: &str,
) -> Option<Vec<Option<&'n Node>>> {
    let each: Option<Vec<Option<&Node>>> = match &node.value {
        Value::List(list) => {
            let given = |node| Some(node).filter(|node: &&Node| node.value != Value::Null);
            Some(list.iter().map(given).collect())
        }
        // An array of nothing but nulls.
        Value::Numbers(values) if values.iter().all(|value| value.is_nan()) => {
            Some(vec![None; values.len()])
        }
        _ => None,
    };
    let each = each.filter(|each| each.len() == joints);
    if each.is_none() {
        let expected = format!("an array with one {what} for each of {joints} joints");
        fields.mismatch(node, path, &expected);
    }
    each
}

/// A mass and its centre; `Some(None)` where both are null.
#[allow(
    clippy::option_option,
    reason = "wrong, unknown and known are three answers"
)]
fn mass(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>) -> Option<Option<LinkMass>> {
    const KNOWN: [&str; 2] = ["mass_kg", "centre_mm"];
    let members = fields.object(node, path, "an object with mass_kg and centre_mm, or null")?;
    fields.unknown_keys(members, path, &KNOWN);
    if KNOWN.iter().all(|key| optional(members, key).is_none()) {
        return Some(None);
    }
    let kg = fields.required_number(members, node.at, path, KNOWN[0])?;
    if kg < 0.0 {
        let found = format!("{kg} kg");
        fields.error(
            node.at,
            &path.key(KNOWN[0]),
            found,
            "a mass of 0 kg or more",
        );
        return None;
    }
    let three = "an array of 3 numbers: the centre at home, in the base frame";
    let centre = fields.required_numbers::<3>(members, node.at, path, KNOWN[1], three)?;
    Some(Some(LinkMass {
        mass_kg: kg,
        centre_mm: Point3::from(centre),
    }))
}
