//! A table of samples as it was read, column by column, before anyone asks what it means.
//!
//! Both ways to give samples (a CSV file, arrays inside the JSON) end here; [`super::files::assemble`]
//! makes [`Samples`](super::Samples) of it.

use crate::sessions::layout::Layout;
use crate::tables::{Cells, Lines};

/// Samples before they are understood.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Table {
    /// What the headings say.
    pub(crate) layout: Layout,
    /// The headings themselves.
    pub(crate) names: Vec<String>,
    /// One for each heading, all of the same length.
    pub(crate) columns: Vec<Cells>,
    /// Line of each row in its file; empty when the table was inside a JSON document.
    pub(crate) line: Lines,
}

impl Table {
    pub(crate) fn rows(&self) -> usize {
        self.columns.first().map_or(0, Cells::len)
    }
}
