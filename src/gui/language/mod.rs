//! The language of the window: every text that it shows is a message of a table, one file of Fluent
//! per language ([Project Fluent](https://projectfluent.org)), and is looked up by its key when it is
//! shown. English is complete; what another language lacks is shown in English.
//!
//! The language is chosen once per frame, for the thread: windows of tests that run side by side have
//! languages of their own, and a job takes that of the window that starts it. Numbers come written, by
//! [`crate::present`]: no language changes them.

mod core;
pub(crate) mod names;
mod table;
mod which;

use std::borrow::Cow;
use std::cell::Cell;
use std::fmt::Display;

pub(crate) use core::{finding, of_core};
use table::table;
pub(crate) use which::LANGUAGES;
pub use which::Language;

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

/// The message of a key in the language of the window: text that lives as long as the program, or,
/// with arguments, a `String`.
macro_rules! say {
    ($key:expr) => {
        $crate::gui::language::text($key)
    };
    ($key:expr, $($name:ident = $value:expr),+ $(,)?) => {
        $crate::gui::language::said($key, &[$((stringify!($name), &$value as &dyn std::fmt::Display)),+])
    };
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_language_of_the_system_is_taken_where_it_is_offered() {
        for (locale, language) in [
            ("de_AT.UTF-8", Language::German),
            ("zh_CN", Language::Chinese),
            ("en_GB.UTF-8", Language::English),
            ("C", Language::English),
            ("fr_FR", Language::English),
        ] {
            assert_eq!(Language::of_locale(locale), language, "{locale}");
        }
    }

    #[test]
    fn threads_have_languages_of_their_own_and_counts_their_forms() {
        choose(Language::German);
        let there = std::thread::spawn(current).join().expect("it ends");
        assert_eq!((there, current()), (Language::English, Language::German));
        assert_eq!(say!("samples", count = 1), "1 Messpunkt");
        assert_eq!(
            say!("samples", count = "1\u{202f}200"),
            "1\u{202f}200 Messpunkte"
        );
        choose(Language::English);
        assert_eq!(say!("samples", count = 1), "1 sample");
    }
}
