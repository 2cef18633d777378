//! The language that this thread speaks. It is chosen once: by the window for every frame, by a command for its
//! whole work. Windows of tests that run side by side have languages of their own, and a job takes that of the
//! window that starts it.

use std::borrow::Cow;
use std::cell::Cell;
use std::collections::BTreeMap;
use std::fmt::Display;
use std::sync::Mutex;

use super::catalogue::catalogue;
use super::english::{Template, parts};
use super::language::Language;

thread_local! {
    static CURRENT: Cell<Language> = const { Cell::new(Language::English) };
}

/// Speaks this language on this thread from now on.
#[doc(hidden)]
pub fn choose(language: Language) {
    CURRENT.set(language);
}

thread_local! {
    static BY_TITLES: Cell<bool> = const { Cell::new(false) };
}

/// While this lives, English on this thread has titles for what files and commands have ids for: in the window and on
/// paper no id means anything.
#[doc(hidden)]
pub struct ByTitles(bool);

impl ByTitles {
    pub fn begin() -> Self {
        Self(BY_TITLES.replace(true))
    }
}

impl Drop for ByTitles {
    fn drop(&mut self) {
        BY_TITLES.set(self.0);
    }
}

/// Whether English has titles on this thread.
#[doc(hidden)]
pub fn by_titles() -> bool {
    BY_TITLES.get()
}

/// English has titles, or ids, on this thread from now on.
#[doc(hidden)]
pub fn name_by_titles(titles: bool) {
    BY_TITLES.set(titles);
}

/// With a capital letter, as a heading or a label begins.
#[doc(hidden)]
pub fn capital(said: &str) -> String {
    let mut characters = said.chars();
    let first = characters.next().into_iter().flat_map(char::to_uppercase);
    first.chain(characters).collect()
}

/// The language of this thread.
#[doc(hidden)]
pub fn current() -> Language {
    CURRENT.get()
}

/// A sentence without arguments, in the language of this thread.
#[doc(hidden)]
pub fn spoken(template: Template) -> &'static str {
    match current() {
        Language::English => template.english(),
        language @ (Language::Marked | Language::Long) => kept(language, template),
        language => in_language(language, template, true),
    }
}

/// A sentence with its arguments, in the language of this thread.
#[doc(hidden)]
pub fn filled(template: Template, arguments: &[(&str, &dyn Display)]) -> String {
    filled_in(current(), template, arguments)
}

/// The same in any language. The argument `count` chooses between one and several.
pub(super) fn filled_in(
    language: Language,
    template: Template,
    arguments: &[(&str, &dyn Display)],
) -> String {
    let value = |name| arguments.iter().find(|(own, _)| *own == name);
    let one = value("count").is_none_or(|(_, count)| count.to_string() == "1");
    filled_pattern(language, in_language(language, template, one), arguments)
}

fn filled_pattern(language: Language, pattern: &str, arguments: &[(&str, &dyn Display)]) -> String {
    let value = |name| arguments.iter().find(|(own, _)| *own == name);
    let marked = language == Language::Marked;
    let mut text = String::with_capacity(pattern.len() + 16 * arguments.len());
    for part in parts(pattern) {
        match part {
            Ok(part) => text.push_str(part),
            Err(name) => {
                let value = value(name).map_or_else(|| name.to_owned(), |(_, v)| v.to_string());
                // What is filled in is not the sentence's: where sentences are marked, it is outside of them.
                let [before, behind] = if marked { ["⟧", "⟦"] } else { ["", ""] };
                text.extend([before, &value, behind]);
            }
        }
    }
    shaped(language, text)
}

fn in_language(language: Language, template: Template, one: bool) -> &'static str {
    match language {
        Language::English | Language::Marked | Language::Long => None,
        language => catalogue(language).of(template, one),
    }
    .unwrap_or_else(|| template.english_for(one))
}

/// The languages of the tests: marked, and longer.
fn shaped(language: Language, said: String) -> String {
    match language {
        // The headings of a table are one sentence, and separate.
        Language::Marked => {
            format!("⟦{}⟧", said.replace(" | ", "⟧ | ⟦").replace("⟦>", ">⟦"))
        }
        Language::Long => format!("{said}{}", longer(&said)),
        _ => said,
    }
}

/// What makes a text longer by a third; a word that cannot be broken grows too.
fn longer(text: &str) -> String {
    let letters = text.chars().filter(|c| c.is_alphabetic()).count();
    "~".repeat(letters.div_ceil(3).min(12))
}

/// A sentence of the languages of the tests: each is made once and lives as long as the program.
fn kept(language: Language, template: Template) -> &'static str {
    static KEPT: Mutex<BTreeMap<(Language, Template), &'static str>> = Mutex::new(BTreeMap::new());
    let mut kept = KEPT
        .lock()
        .unwrap_or_else(std::sync::PoisonError::into_inner);
    kept.entry((language, template))
        .or_insert_with(|| shaped(language, template.english().to_owned()).leak())
}

/// What a catalogue has in this context for these words, which no template of the code has.
#[doc(hidden)]
pub fn known_in(
    language: Language,
    context: &str,
    english: &str,
    arguments: &[(&str, &dyn Display)],
) -> Option<String> {
    match language {
        Language::English => None,
        Language::Marked | Language::Long => {
            phrases_in(context).find(|known| *known == english)?;
            Some(filled_pattern(language, english, arguments))
        }
        language => {
            let pattern = catalogue(language).translated_in(context, english)?;
            Some(filled_pattern(language, pattern, arguments))
        }
    }
}

/// What the catalogues have in this context, in English.
#[doc(hidden)]
fn phrases_in(context: &str) -> impl Iterator<Item = &'static str> {
    catalogue(Language::German).in_context(context)
}

/// The largest width of the texts of one row, relative to English.
#[doc(hidden)]
pub fn stretch() -> f32 {
    match current() {
        Language::English | Language::Marked | Language::Chinese => 1.0,
        Language::German => 1.1,
        Language::Long => 1.35,
    }
}

/// A name within a sentence: English begins it with a small letter.
#[doc(hidden)]
pub fn within(name: &str) -> Cow<'_, str> {
    match current() {
        Language::English | Language::Long => name.to_lowercase().into(),
        Language::Marked | Language::German | Language::Chinese => name.into(),
    }
}

/// The characters of a language's sentences that no bundled font has: those of East Asian scripts.
#[doc(hidden)]
pub fn characters(language: Language) -> impl Iterator<Item = char> {
    language.catalogue().chars().filter(|c| *c >= '\u{2e80}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn threads_have_languages_of_their_own_and_counts_their_forms() {
        choose(Language::German);
        let there = std::thread::spawn(current).join().expect("it ends");
        assert_eq!((there, current()), (Language::English, Language::German));
        let samples = |count: &str| say!(one "{count} sample", "{count} samples", count);
        assert_eq!(samples("1"), "1 Messpunkt");
        assert_eq!(samples("1\u{202f}200"), "1\u{202f}200 Messpunkte");
        choose(Language::English);
        assert_eq!(samples("1"), "1 sample");
        assert_eq!(samples("0"), "0 samples");
    }
}
