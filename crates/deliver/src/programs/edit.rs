//! Bytes to be replaced.

use std::ops::Range;

/// New bytes for a range of a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Edit {
    pub(super) range: Range<usize>,
    pub(super) text: String,
}

impl Edit {
    pub(super) fn new((range, text): (Range<usize>, &str)) -> Self {
        let text = text.to_owned();
        Self { range, text }
    }
}
