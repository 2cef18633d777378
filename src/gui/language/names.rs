//! Names of effects, as [`crate::present::names`] has them, in the language of the window. Where a
//! language has no name for an effect, it is shown in English.

use std::borrow::Cow;

use super::{named, of_core, said, within};
use crate::diagnosis::Limit;
use crate::effects::find;
use crate::present::names as present;

/// The title of an effect; what is no effect stays as it is.
pub(crate) fn title(id: &str) -> &str {
    find(id).map_or(id, |effect| named("effect", id, effect.about().title))
}

/// The title with the joint, counted from 1, where the robot has several.
pub(crate) fn title_on(id: &str, joint: Option<usize>, joints: usize) -> String {
    match joint.filter(|_| joints > 1) {
        Some(joint) => on_joint(id, &joint.to_string()),
        None => title(id).to_owned(),
    }
}

/// The titles of what are ids of effects, each with its joint or without, or of coefficients that stand together;
/// anything else stays as it is.
pub(super) fn of_effects(text: &str) -> String {
    let is_id = |id: &str| find(id).is_some();
    let is_name = |name: &str| match name.split_once(' ') {
        Some((id, joint)) => is_id(id) && joint.bytes().all(|b| b.is_ascii_digit()),
        None => is_id(name),
    };
    for between in [", ", " + "] {
        if text.split(between).all(is_name) {
            let titles = text
                .split(between)
                .map(|name| within(&title_of(name)).into_owned());
            return titles.collect::<Vec<_>>().join(between);
        }
    }
    match text.split_once(": ") {
        Some((whose, _)) if whose.split(' ').next().is_some_and(is_id) => combination(text),
        _ => text.to_owned(),
    }
}

/// A parameter in words, and its unit as it is written behind a number.
pub(crate) fn parameter(name: &str) -> (String, &'static str) {
    let (name, unit) = present::parameter(name);
    (of_core(&name).into_owned(), unit)
}

/// What ends with the name of a parameter behind a colon.
pub(crate) fn with_parameter(text: &str) -> String {
    match text.rsplit_once(": ") {
        Some((whose, parameter)) => format!("{whose}: {}", of_core(parameter)),
        None => text.to_owned(),
    }
}

/// Coefficients of a model that stand together, by their names in files: `link-geometry of joint 2: x_mm with
/// measuring-frame: z_mm`.
pub(crate) fn combination(text: &str) -> String {
    let one = |name: &str| {
        let (whose, coefficient) = name.split_once(": ")?;
        let (id, of) = whose.split_once(" of ").unwrap_or((whose, ""));
        let title = title(id).to_owned();
        let title = match of.strip_prefix("joint ") {
            Some(joint) => on_joint(id, joint),
            None if of.is_empty() => title,
            None => format!("{title}, {}", of_core(of)),
        };
        Some(format!("{title}: {}", parameter(coefficient).0))
    };
    let all = text
        .split(" with ")
        .map(|name| one(name).unwrap_or_else(|| of_core(name).into_owned()));
    all.collect::<Vec<_>>()
        .join(&format!(" {} ", of_core("with")))
}

/// A figure that is no parameter, in words.
pub(crate) fn figure(one: (&str, Option<f64>)) -> String {
    named_values(&present::figure(one))
}

/// From which size an effect would have been seen, parameter by parameter.
pub(crate) fn detection_limit(limit: &Limit) -> String {
    named_values(&present::detection_limit(limit))
}

/// Sentences and values behind their names, with commas between them.
fn named_values(text: &str) -> String {
    let one = |part: &str| {
        let value = part.find(|c: char| c.is_ascii_digit());
        match value.filter(|at| *at > 0 && !part.contains(": ")) {
            Some(at) => format!("{} {}", of_core(part[..at].trim_end()), &part[at..]),
            None => of_core(part).into_owned(),
        }
    };
    text.split(", ").map(one).collect::<Vec<_>>().join(", ")
}

/// The usual size of an effect, as its file has it.
pub(crate) fn usual_size(size: &str) -> Cow<'_, str> {
    let known = of_core(size);
    match size.split_once(" to ").filter(|_| known == size) {
        Some((from, to)) => said("text-size-from-to", &[("from", &from), ("to", &to)]).into(),
        None => known,
    }
}

/// The title of a name that may end with its joint, `id joint`.
pub(crate) fn title_of(name: &str) -> String {
    match name.split_once(' ') {
        Some((id, joint)) => on_joint(id, joint),
        None => title(name).to_owned(),
    }
}

fn on_joint(id: &str, joint: &str) -> String {
    said(
        "effect-on-joint",
        &[("effect", &title(id)), ("joint", &joint)],
    )
}
