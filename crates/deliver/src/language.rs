//! What the core says, in the language of this thread.

use crate::diagnostic::Diagnostic;
use crate::text::{Text, by_titles, current};

/// A sentence of the core, in the language of this thread.
pub fn spoken(text: impl Into<Text>) -> String {
    text.into().spoken_with(current(), by_titles())
}

/// A finding, with where it is and what was expected.
pub fn finding(finding: &Diagnostic) -> String {
    spoken(finding.describe())
}
