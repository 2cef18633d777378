//! One effect, as models and scenarios write it.

use super::curve::{self, unexplained};
use super::exact::{LARGEST, exact_term};
use super::rest;
use crate::document::kinds::{NUMBER, TEXT, count};
use crate::document::number::quoted;
use crate::document::object::{Cursor, Kind, written};
use crate::document::{Member, Value, optional};
use crate::effects::term::names_on;
use crate::effects::{Setting, Term, UNEXPLAINED, UNNAMED, find};
use crate::kinematics::{JointKind, Robot};
use crate::text::Text;

const JOINT: Kind<usize> = count(phrase!("a joint, counted from 1"));

/// Reads an effect of a robot.
pub(crate) fn term(at: &mut Cursor<'_, '_>, robot: &Robot) -> Option<Term> {
    let joints = robot.joints.len();
    at.expected = text!("an object with effect and parameters");
    let members = at.members()?;
    let id = at.under(members, "effect", TEXT.expected, TEXT.read)?;
    let last = match id.as_str() {
        UNEXPLAINED => "curve",
        UNNAMED => "rest",
        _ => "exact",
    };
    let labels = ["setup", "target", "place"];
    let known = [&["effect", "joint", "parameters", last], &labels[..]].concat();
    at.fields.unknown_keys(members, at.path, &known);
    let (start, path) = (at.node.at, at.path);
    if find(&id).is_none() {
        let found = text!("no effect is called '{id}'", id);
        let expected = text!("a name that `truepose effects` lists");
        at.fields.error(start, &path.key("effect"), found, expected);
        return None;
    }
    let joint = at.under_if(members, "joint", JOINT.expected, JOINT.read)?;
    let joint = joint.unwrap_or(1);
    if last != "exact" && !(1..=joints).contains(&joint) {
        let found = Text::verbatim(joint.to_string());
        let expected = text!("a joint from 1 to {joints}", joints);
        at.fields.error(start, &path.key("joint"), found, expected);
        return None;
    }
    match last {
        "curve" => return unexplained(at, members, joint),
        "rest" => return rest::unnamed(at, members, joint, joints),
        _ => {}
    }
    let key = "parameters";
    let expected = phrase!("an object with a number for each parameter");
    let given = at.under(members, key, expected, parameters)?;
    let start = optional(members, key).map_or(start, |given| given.at);
    let named: Vec<(&str, f64)> = given.iter().map(|(n, v)| (n.as_str(), *v)).collect();
    let mut term = match Term::from_parameters(&id, joint, &named, joints) {
        Ok(term) => term,
        Err(error) => {
            let found = Text::verbatim(error.to_string());
            let expected = text!("parameters as `truepose effects` lists them");
            at.fields.error(start, path, found, expected);
            return None;
        }
    };
    if let Some((name, expected)) = of_another_kind(&term, robot, &named) {
        let found = Text::verbatim(quoted(name));
        let path = path.key(key);
        at.fields.error(start, &path.key(name), found, expected);
        return None;
    }
    let expected = phrase!("an object with setting and coefficients");
    at.under_if(members, "exact", expected, |at| {
        at.fill(&mut term, exact_term).then_some(())
    })?;
    let label = labels.iter().find(|key| optional(members, key).is_some());
    if let Some(key) = label {
        term.label = Some(at.under(members, key, TEXT.expected, TEXT.read)?.into());
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

fn parameters(at: &mut Cursor<'_, '_>) -> Option<Vec<(String, f64)>> {
    let members = at.members()?;
    let read = |member: &Member| {
        let path = &at.path.key(&member.key);
        let value = NUMBER.read(at.fields, &member.node, path)?;
        if member.key.starts_with("amplitude") && value < 0.0 {
            let expected = text!("an amplitude of 0 or more");
            at.fields.mismatch(&member.node, path, expected);
            return None;
        }
        if value.abs() > LARGEST {
            let expected = text!("a number of at most {most}", most = LARGEST);
            at.fields.mismatch(&member.node, path, expected);
            return None;
        }
        Some((member.key.clone(), value))
    };
    let all: Vec<Option<_>> = members.iter().map(read).collect();
    all.into_iter().collect()
}

/// An effect of this robot as it is written. Parameters are in the order of the catalogue.
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
