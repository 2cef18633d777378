//! Rows in their order, and in words.

use crate::sessions::measuring_order::measuring_order;
use crate::sessions::{Samples, in_rows};
use crate::text::Text;

/// The rows in the order in which they were measured.
pub(crate) fn in_order(samples: &Samples) -> Vec<usize> {
    let order = measuring_order(samples.time_s.as_deref());
    order.unwrap_or_else(|| (0..samples.len()).collect())
}

/// Rows for reading, counted from 1: "rows 3–12, 40 and 7 more".
pub(crate) fn listed(rows: &[usize]) -> Text {
    let runs = in_rows::ranges(rows);
    let shown = runs.iter().take(4).map(|(first, end)| {
        if first + 1 == *end {
            format!("{end}")
        } else {
            format!("{}–{end}", first + 1)
        }
    });
    let text = shown.collect::<Vec<_>>().join(", ");
    let more = runs.iter().skip(4).map(|(first, end)| end - first);
    match (rows.len(), more.sum::<usize>()) {
        (1, _) => text!("row {rows}", rows = text),
        (_, 0) => text!("rows {rows}", rows = text),
        (_, more) => text!("rows {rows} and {more} more", rows = text, more),
    }
}
