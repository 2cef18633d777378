//! One effect, as models and scenarios write it.

use super::curve::unexplained;
use super::exact::exact_term;
use super::read::count;
use crate::effects::{Term, UNEXPLAINED, find};
use crate::sessions::json::{Fields, Node, Path, optional};

/// One effect, as models and scenarios write it.
pub(crate) fn term(
    fields: &mut Fields<'_>,
    node: &Node,
    path: &Path<'_>,
    joints: usize,
) -> Option<Term> {
    let members = fields.object(node, path, "an object with effect and parameters")?;
    let id = fields.required_text(members, node.at, path, "effect")?;
    let last = if id == UNEXPLAINED { "curve" } else { "exact" };
    let known = [
        "effect",
        "joint",
        "setup",
        "target",
        "place",
        "parameters",
        last,
    ];
    fields.unknown_keys(members, path, &known);
    if find(&id).is_none() {
        let found = format!("no effect is called '{id}'");
        let expected = "a name that `truepose effects` lists";
        fields.error(node.at, &path.key("effect"), found, expected);
        return None;
    }
    let joint = match optional(members, "joint") {
        None => 1,
        Some(node) => count(fields, node, &path.key("joint"), "a joint, counted from 1")?,
    };
    if id == UNEXPLAINED {
        return unexplained(fields, members, node.at, path, joint, joints);
    }
    let given = optional(members, "parameters");
    let parameters = match given {
        None => Vec::new(),
        Some(node) => parameters(fields, node, &path.key("parameters"))?,
    };
    let named: Vec<(&str, f64)> = parameters.iter().map(|(n, v)| (n.as_str(), *v)).collect();
    let readable = match Term::from_parameters(&id, joint, &named, joints) {
        Ok(term) => term,
        Err(error) => {
            let at = given.map_or(node.at, |given| given.at);
            let expected = "parameters as `truepose effects` lists them";
            fields.error(at, path, error.to_string(), expected);
            return None;
        }
    };
    let mut term = match optional(members, "exact") {
        None => Some(readable),
        Some(node) => exact_term(fields, node, &path.key("exact"), readable),
    }?;
    let mut labels = ["setup", "target", "place"].into_iter();
    let label = labels.find_map(|key| optional(members, key));
    if let Some(node) = label {
        let name = fields.text(node, &path.key("setup"))?;
        term.label = Some(name.into());
    }
    Some(term)
}

fn parameters(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>) -> Option<Vec<(String, f64)>> {
    let members = fields.object(node, path, "an object with a number for each parameter")?;
    let all: Vec<Option<(String, f64)>> = members
        .iter()
        .map(|member| {
            let path = &path.key(&member.key);
            let value = fields.number(&member.node, path)?;
            if member.key.starts_with("amplitude") && value < 0.0 {
                fields.mismatch(&member.node, path, "an amplitude of 0 or more");
                return None;
            }
            Some((member.key.clone(), value))
        })
        .collect();
    all.into_iter().collect()
}
