//! The language that this thread speaks, and the messages of its table.

use std::borrow::Cow;
use std::cell::Cell;
use std::fmt::Display;

use super::table::table;
use super::which::Language;

thread_local! {
    static CURRENT: Cell<Language> = const { Cell::new(Language::English) };
}

/// Speaks this language on this thread from now on.
pub(crate) fn choose(language: Language) {
    CURRENT.set(language);
}

/// The language of this thread.
pub(crate) fn current() -> Language {
    CURRENT.get()
}

/// A message without arguments.
pub(crate) fn text(key: &'static str) -> &'static str {
    table(current()).plain(key)
}

/// A message with arguments. Those that are whole numbers choose the form for their count.
pub(crate) fn said(key: &'static str, arguments: &[(&'static str, &dyn Display)]) -> String {
    table(current()).filled(key, arguments)
}

/// What the core calls `english`, of this kind and with this id: an effect, a column. Where the
/// language has no word for it, it stays English.
pub(crate) fn named(kind: &str, id: &str, english: &'static str) -> &'static str {
    known(kind, id).unwrap_or(english)
}

/// The word for what has this id, among things of this kind, where the language has one.
pub(crate) fn known(kind: &str, id: &str) -> Option<&'static str> {
    table(current()).named(kind, id)
}

/// What the core says in these words, among those of this kind, where the language has it. The id is
/// the words themselves: `value, 95 % interval` is `value-95-interval`.
pub(crate) fn known_words(kind: &str, english: &str) -> Option<&'static str> {
    let words = english.split(|c: char| !c.is_ascii_alphanumeric());
    let words: Vec<&str> = words.filter(|word| !word.is_empty()).collect();
    known(kind, &words.join("-").to_lowercase())
}

/// How much wider than in English what stands in one row may be, at most.
pub(crate) fn stretch() -> f32 {
    match current() {
        Language::English | Language::Marked | Language::Chinese => 1.0,
        Language::German => 1.1,
        Language::Long => 1.35,
    }
}

/// A name as it stands within a sentence: English begins it with a small letter.
pub(crate) fn within(name: &str) -> Cow<'_, str> {
    match current() {
        Language::English | Language::Long => name.to_lowercase().into(),
        Language::Marked | Language::German | Language::Chinese => name.into(),
    }
}
