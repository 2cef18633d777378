//! Names, as [`crate::present::names`] has them, in the language of this thread.

use std::borrow::Cow;

use super::core::of_core;
pub(crate) use super::core::{combination, parameter};
pub(crate) use super::titles::{title, title_of, title_on};
use crate::diagnosis::Limit;
use crate::present::names as present;

/// What ends with the name of a parameter behind a colon.
pub(crate) fn with_parameter(text: &str) -> String {
    match text.rsplit_once(": ") {
        Some((whose, parameter)) => format!("{whose}: {}", of_core(parameter)),
        None => text.to_owned(),
    }
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
        Some((from, to)) => say!("{from} to {to}", from = from, to = to).into(),
        None => known,
    }
}
