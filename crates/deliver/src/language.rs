//! What the core says, in the language of this thread.

use crate::diagnostic::Diagnostic;
use crate::text::{Text, by_titles, current};
use crate::text::{known_in, phrases_in};

/// A sentence of the core, in the language of this thread.
pub fn spoken(text: impl Into<Text>) -> String {
    text.into().spoken_with(current(), by_titles())
}

/// A finding, with where it is and what was expected.
pub fn finding(finding: &Diagnostic) -> String {
    spoken(finding.describe())
}

/// What the core says in these words, among those of this kind, where the language has it.
pub fn known_words(kind: &str, english: &str) -> Option<String> {
    let as_written = |one: &&str| one.eq_ignore_ascii_case(english);
    let english = phrases_in(kind).find(as_written).unwrap_or(english);
    known_in(current(), kind, english, &[])
}
