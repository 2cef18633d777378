//! What the core says, in the language of this thread.

#[cfg(any(feature = "cli", feature = "gui"))]
use crate::diagnostic::Diagnostic;
use crate::text::{Text, by_titles, current};
#[cfg(feature = "gui")]
use crate::text::{known_in, phrases_in};

/// A sentence of the core, in the language of this thread.
pub(crate) fn spoken(text: impl Into<Text>) -> String {
    text.into().spoken_with(current(), by_titles())
}

/// A finding, with where it is and what was expected.
#[cfg(any(feature = "cli", feature = "gui"))]
pub(crate) fn finding(finding: &Diagnostic) -> String {
    spoken(finding.describe())
}

/// What the core says in these words, among those of this kind, where the language has it.
#[cfg(feature = "gui")]
pub(crate) fn known_words(kind: &str, english: &str) -> Option<String> {
    let as_written = |one: &&str| one.eq_ignore_ascii_case(english);
    let english = phrases_in(kind).find(as_written).unwrap_or(english);
    known_in(current(), kind, english, &[])
}
