//! `truepose-history/1`: what became of the robots of a folder, as JSON.

use super::identification_v1::parameter;
use super::json::{Json, list, object};
use super::parts::which;
use crate::history::{Change, Entry, History};

/// The document of a history.
pub fn document(history: &History) -> Json {
    object! {
        "format": "truepose-history/1",
        "robots": list(&history.robots, |robot| object! {
            "robot": &robot.robot,
            "ordered_by": robot.ordered_by.in_words(),
            "entries": list(&robot.entries, row),
        }),
        "not_read": list(&history.not_read, |file| {
            object! { "file": &file.file, "because": &file.because }
        }),
    }
}

fn row(entry: &Entry) -> Json {
    let difference = |change: &Change| {
        let now = &entry.parameters[change.parameter];
        which(now).with(object! {
            "since": &change.since,
            "from": change.from,
            "to": now.value,
            "difference": change.difference,
            "ci95": change.ci95,
            "significant": change.is_significant(),
        })
    };
    object! {
        "file": &entry.file,
        "kind": entry.source.name(),
        "session": &entry.session,
        "samples": entry.samples,
        "samples_hash": &entry.samples_hash,
        "compensated_by": entry.compensated_by.as_ref(),
        "gap": object! {
            "before_mm": entry.before_mm,
            "after_mm": entry.after_mm,
            "with_first_mm": entry.with_first_mm,
        },
        "parameters": list(&entry.parameters, parameter),
        "changes": list(&entry.changes, difference),
    }
}
