//! Errors by kind of measurement: `kinds` in JSON, and as a table.

use super::json::{Json, list, object};
use super::numbers::plain;
use super::table::{Cell, Table};
use crate::observations::figures::{Errors, KindFigures};
use crate::observations::kind_in_words;
use crate::text::{by_titles, current};

/// One row for each kind; numbers are in its `unit`, mm or mrad.
pub(crate) fn rows(kinds: &[KindFigures]) -> Json {
    let errors = |e: &Errors| {
        object! {
            "samples": e.count,
            "before": e.before_rms,
            "after": e.after_rms,
            "max_before": e.before_max,
            "max_after": e.after_max,
        }
    };
    list(kinds, |own| {
        object! { "kind": own.kind, "unit": own.unit }
            .with(own.fitted.as_ref().map_or(Json::Absent, errors))
            .with(object! {
                "outliers": own.outliers,
                "stated_sigma": own.stated_sigma,
                "found_sigma": own.found_sigma,
                "held_out": own.held_out.as_ref().map(errors),
                "unseen_rms": own.unseen_rms,
            })
    })
}

/// What a kind is called, in the language of this thread.
fn name_of(own: &KindFigures) -> String {
    kind_in_words(own.kind).spoken_with(current(), by_titles())
}

/// Errors by kind, root mean square, of what was fitted and of what is held out.
pub(crate) fn table(kinds: &[KindFigures]) -> Table {
    let mut table = Table::headed(say!(
        "Kind | >Number | Unit | >Nominal | >Model | >Cross-validated | >Largest | >σ stated | >σ found"
    ));
    let number = |value| Cell::number(value, plain);
    for own in kinds {
        let fitted = own
            .fitted
            .as_ref()
            .map(|errors| (name_of(own), errors, own));
        let open = KindFigures {
            unseen_rms: None,
            stated_sigma: None,
            found_sigma: None,
            ..own.clone()
        };
        let held_out = own.held_out.as_ref();
        let held_out = held_out.map(|errors| {
            let name = say!("{kind}, held out", kind = name_of(own));
            (name, errors, &open)
        });
        for (name, errors, more) in fitted.into_iter().chain(held_out) {
            table.row([
                name.into(),
                errors.count.into(),
                own.unit.into(),
                number(Some(errors.before_rms)),
                number(Some(errors.after_rms)),
                number(more.unseen_rms),
                number(Some(errors.after_max)),
                number(more.stated_sigma),
                number(more.found_sigma),
            ]);
        }
    }
    table
}
