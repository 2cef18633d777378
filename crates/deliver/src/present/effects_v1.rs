//! `truepose-effects/1`: what the program knows, as JSON.

use super::json::{Json, list, object};
use crate::effects::term::parameter_names;
use crate::effects::{CATALOGUE, Effect};

/// The document of the catalogue.
pub fn document() -> Json {
    object! {
        "format": "truepose-effects/1",
        "effects": list(CATALOGUE, |effect| entry(effect)),
    }
}

fn entry(effect: &Effect) -> Json {
    let about = effect.about();
    object! {
        "effect": about.id,
        "title": about.title.english(),
        "per_joint": about.per_joint,
        "parameters": parameter_names(effect),
        "equation": about.equation,
        "source": about.source,
        "cause": about.cause.english(),
        "needs": list(about.needs, |need| need.what.into()),
        "usual_size": about.usual_size.english(),
        "confused_with": about.confused_with,
        "check": about.check.english(),
    }
}
