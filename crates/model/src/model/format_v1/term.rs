//! One effect, as models and scenarios write it.

use super::curve::{self, unexplained};
use super::exact::exact_term;
use super::rest;
use crate::document::kinds::count;
use crate::document::number::quoted;
use crate::document::object::{Cursor, Kind, written};
use crate::document::{Fields, Member, Node, Path, Value, optional};
use crate::effects::term::names_on;
use crate::effects::{Setting, Term, UNEXPLAINED, UNNAMED, find};
use crate::kinematics::{JointKind, Robot};
use crate::text::Text;

const JOINT: Kind<usize> = count(phrase!("a joint, counted from 1"));

/// Reads an effect of a robot.
pub(crate) fn term(at: &mut Cursor<'_, '_>, robot: &Robot) -> Option<Term> {
    let joints = robot.joints.len();
    let (fields, node, path) = (&mut *at.fields, at.node, at.path);
    let members = fields.object(node, path, text!("an object with effect and parameters"))?;
    let id = fields.required_text(members, node.at, path, "effect")?;
    let last = match id.as_str() {
        UNEXPLAINED => "curve",
        UNNAMED => "rest",
        _ => "exact",
    };
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
        let found = text!("no effect is called '{id}'", id);
        let expected = text!("a name that `truepose effects` lists");
        fields.error(node.at, &path.key("effect"), found, expected);
        return None;
    }
    let joint = match optional(members, "joint") {
        None => 1,
        Some(node) => JOINT.read(fields, node, &path.key("joint"))?,
    };
    if id == UNEXPLAINED {
        return unexplained(at, members, joint, joints);
    }
    if id == UNNAMED {
        return rest::unnamed(at, members, joint, joints);
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
            let expected = text!("parameters as `truepose effects` lists them");
            fields.error(at, path, Text::verbatim(error.to_string()), expected);
            return None;
        }
    };
    if let Some((name, expected)) = of_another_kind(&readable, robot, &named) {
        let at = given.map_or(node.at, |given| given.at);
        let path = path.key("parameters");
        fields.error(at, &path.key(name), Text::verbatim(quoted(name)), expected);
        return None;
    }
    let mut term = readable;
    if let Some(node) = optional(members, "exact") {
        let mut at = Cursor {
            fields,
            node,
            path: &path.key("exact"),
            expected: phrase!("an object with setting and coefficients").into(),
        };
        at.fill(&mut term, exact_term).then_some(())?;
    }
    let mut labels = ["setup", "target", "place"].into_iter();
    let label = labels.find_map(|key| optional(members, key));
    if let Some(node) = label {
        let name = fields.text(node, &path.key("setup"))?;
        term.label = Some(name.into());
    }
    Some(term)
}

/// A parameter that has the unit of another kind of joint: an offset in mm on one that turns would be taken for as
/// many radians. With what is expected in its place.
fn of_another_kind<'n>(
    term: &Term,
    robot: &Robot,
    parameters: &[(&'n str, f64)],
) -> Option<(&'n str, Text)> {
    let kind = robot.joints.get(term.joint)?.kind;
    let (other, says) = match kind {
        JointKind::Revolute => (JointKind::Prismatic, phrase!(in "joint", "turns")),
        JointKind::Prismatic => (JointKind::Revolute, phrase!(in "joint", "slides")),
    };
    let own = names_on(term.effect, kind);
    let others = names_on(term.effect, other);
    let is_others = |name: &str| others.contains(&name) && !own.contains(&name);
    let (name, _) = parameters.iter().find(|(name, _)| is_others(name))?;
    let expected = text!(
        "{parameters}: joint {joint} {turns}",
        parameters = own.join(", "),
        joint = term.joint + 1,
        turns = says
    );
    Some((name, expected))
}

fn parameters(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>) -> Option<Vec<(String, f64)>> {
    let members = fields.object(
        node,
        path,
        text!("an object with a number for each parameter"),
    )?;
    let all: Vec<Option<(String, f64)>> = members
        .iter()
        .map(|member| {
            let path = &path.key(&member.key);
            let value = fields.number(&member.node, path)?;
            if member.key.starts_with("amplitude") && value < 0.0 {
                fields.mismatch(&member.node, path, text!("an amplitude of 0 or more"));
                return None;
            }
            Some((member.key.clone(), value))
        })
        .collect();
    all.into_iter().collect()
}

/// What is written of an effect of this robot. Parameters stand in the order of the catalogue.
pub(super) fn term_written(term: &Term, robot: &Robot) -> Value {
    let about = term.effect.about();
    let own = robot.joints.get(term.joint);
    let kind = own.map_or(JointKind::Revolute, |joint| joint.kind);
    let mut all = vec![Member::new("effect", about.id)];
    if about.per_joint {
        all.push(Member::new("joint", term.joint + 1));
    }
    let labels = [
        ("setup", Setting::Setup),
        ("target", Setting::Target),
        ("place", Setting::Place),
    ];
    let label = labels.iter().find(|(_, setting)| *setting == about.setting);
    if let (Some((key, _)), Some(label)) = (label, &term.label) {
        all.push(Member::new(*key, &**label));
    }
    let curve = term.curve();
    let parameters = match curve {
        Some(curve) => curve::parameters(curve, kind),
        None => term.parameters_on(kind),
    };
    let parameters = parameters.iter().map(|p| Member::new(p.name, p.value));
    all.push(Member::new(
        "parameters",
        Value::Object(parameters.collect()),
    ));
    all.push(match (curve, term.rest()) {
        (Some(curve), _) => Member::new("curve", curve::written_curve(curve)),
        (None, Some(rest)) => Member::new("rest", rest::written_rest(rest)),
        (None, None) => Member::new("exact", written(term.clone(), exact_term)),
    });
    Value::Object(all)
}
