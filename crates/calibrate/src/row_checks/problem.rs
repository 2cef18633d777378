//! Problems of rows, in words.

use crate::answers::diagnosis::DataProblem;
use crate::text::Text;

/// A problem that is about all samples and is said only.
pub(super) fn without_correction(what: Text, evidence: Text, proposal: Text) -> DataProblem {
    DataProblem {
        what,
        evidence,
        proposal,
        mend: None,
        samples: Vec::new(),
    }
}

/// Rows for reading, counted from 1: "rows 3–12, 40 and 7 more".
pub(super) fn listed(rows: &[usize]) -> Text {
    let mut runs: Vec<(usize, usize)> = Vec::new();
    for &row in rows {
        match runs.last_mut() {
            Some(run) if run.1 + 1 == row => run.1 = row,
            _ => runs.push((row, row)),
        }
    }
    let shown = runs.iter().take(4).map(|(first, last)| {
        if first == last {
            format!("{}", first + 1)
        } else {
            format!("{}–{}", first + 1, last + 1)
        }
    });
    let text = shown.collect::<Vec<_>>().join(", ");
    let more: usize = runs
        .iter()
        .skip(4)
        .map(|(first, last)| last - first + 1)
        .sum();
    match (rows.len(), more) {
        (1, _) => text!("row {rows}", rows = text),
        (_, 0) => text!("rows {rows}", rows = text),
        _ => text!("rows {rows} and {more} more", rows = text, more),
    }
}
