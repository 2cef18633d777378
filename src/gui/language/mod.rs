//! The language of the window: every text that it shows is a message of a table, one file of Fluent
//! per language ([Project Fluent](https://projectfluent.org)), and is looked up by its key when it is
//! shown. English is complete; what another language lacks is shown in English.
//!
//! The language is chosen once per frame, for the thread: windows of tests that run side by side have
//! languages of their own, and a job takes that of the window that starts it. Numbers come written, by
//! [`crate::present`]: no language changes them.

mod core;
pub(crate) mod names;
mod speech;
mod table;
mod titles;
mod which;

pub(crate) use core::{finding, of_core};
pub(crate) use speech::{choose, current, known_words, named, said, stretch, text, within};
pub(crate) use which::LANGUAGES;
pub use which::Language;

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
