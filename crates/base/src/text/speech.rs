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
pub(crate) fn choose(language: Language) {
    CURRENT.set(language);
}

thread_local! {
    static BY_TITLES: Cell<bool> = const { Cell::new(false) };
}

/// While this lives, English on this thread has titles for what files and commands have ids for: in the window and on
/// paper no id means anything.
pub(crate) struct ByTitles(bool);

impl ByTitles {
    pub(crate) fn begin() -> Self {
        Self(BY_TITLES.replace(true))
    }
}

impl Drop for ByTitles {
    fn drop(&mut self) {
        BY_TITLES.set(self.0);
    }
}

/// Whether English has titles on this thread.
pub(crate) fn by_titles() -> bool {
    BY_TITLES.get()
}

/// English has titles, or ids, on this thread from now on.
#[cfg(feature = "gui")]
pub(crate) fn name_by_titles(titles: bool) {
    BY_TITLES.set(titles);
}

/// The language of this thread.
pub(crate) fn current() -> Language {
    CURRENT.get()
}

/// A sentence without arguments, in the language of this thread.
pub(crate) fn spoken(template: Template) -> &'static str {
    match current() {
        Language::English => template.english(),
        language @ (Language::Marked | Language::Long) => kept(language, template),
        language => in_language(language, template, true),
    }
}

/// A sentence with its arguments, in the language of this thread.
pub(crate) fn filled(template: Template, arguments: &[(&str, &dyn Display)]) -> String {
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
                // What is filled in is not the sentence's: where sentences are marked, it stands outside of them.
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
        Language::Marked => format!("⟦{said}⟧"),
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
pub(crate) fn known_in(
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
            let pattern = catalogue(language).said_in(context, english)?;
            Some(filled_pattern(language, pattern, arguments))
        }
    }
}

/// What the catalogues have in this context, in English.
pub(crate) fn phrases_in(context: &str) -> impl Iterator<Item = &'static str> {
    catalogue(Language::German).in_context(context)
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

/// The characters of a language's sentences that no bundled font has: those of East Asian scripts.
pub(crate) fn characters(language: Language) -> impl Iterator<Item = char> {
    language.catalogue().chars().filter(|c| *c >= '\u{2e80}')
}

// The catalogues hold the sentences of the window too, so only a build with it can compare them.
#[cfg(all(test, feature = "gui"))]
mod tests {
    use super::super::TEMPLATES;
    use super::*;
    use std::collections::BTreeSet;

    /// The context of what is looked up by its words.
    const LOOKED_UP: &str = "plot";
    /// What only a build without the window says.
    const WITHOUT_WINDOW: &str = "this build has no window; the main job in the terminal is: {job}";
    const TRANSLATED: [Language; 2] = [Language::German, Language::Chinese];

    fn arguments(text: &str) -> BTreeSet<&str> {
        parts(text).filter_map(Result::err).collect()
    }

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

    fn is_a_word(text: &str) -> bool {
        text.chars().any(char::is_alphabetic)
    }

    #[test]
    fn every_sentence_is_in_every_catalogue_with_its_arguments() {
        let mut wrong = Vec::new();
        for language in TRANSLATED {
            for template in TEMPLATES {
                let english = template.english();
                match catalogue(language).of(*template, true) {
                    None if !parts(english).flatten().any(is_a_word) => {}
                    None => wrong.push(format!("{language:?} lacks {template:?}")),
                    Some(_) => {}
                }
            }
            for (context, english, forms) in catalogue(language).all() {
                for form in forms {
                    let (own, there) = (arguments(form), arguments(english));
                    if own != there {
                        wrong.push(format!("{language:?}: {context} {english} | {form}"));
                    }
                }
            }
        }
        assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    }

    /// The context of what stands behind a number in a field.
    const BEHIND_A_NUMBER: &str = "unit";

    #[test]
    fn no_template_begins_or_ends_within_a_sentence() {
        let marks = [' ', ',', ';', '·', '(', ')'];
        let is_part = |template: &&Template| {
            let (context, english) = template.key();
            context != BEHIND_A_NUMBER
                && parts(english).flatten().any(is_a_word)
                && !english.starts_with(". ")
                && (english.starts_with(marks) || english.ends_with(&marks[..5]))
        };
        let found: Vec<_> = TEMPLATES.iter().filter(is_part).collect();
        assert!(found.is_empty(), "{found:#?}");
    }

    /// Arguments of these names are clauses: a language may need another order, or another case, where they stand
    /// in the middle of a sentence. Names, quantities and kinds are called by what they are: `effect`, `axes`.
    const CLAUSES: &[&str] = &[
        "against", "because", "done", "hint", "how", "instead", "reason", "remedy", "rest", "rule",
        "said", "says", "this", "what", "which", "whose", "why",
    ];

    /// Whether a clause that stands between these is apart from the rest of the sentence.
    fn stands_apart(before: Option<&str>, behind: Option<&str>) -> bool {
        let begins = [": ", "; ", "(", ", ", "· ", ". "];
        let ends = [":", ";", ")", ",", ".", " ·"];
        before.is_none_or(|text| begins.iter().any(|mark| text.ends_with(mark)))
            && behind.is_none_or(|text| ends.iter().any(|mark| text.starts_with(mark)))
    }

    #[test]
    fn a_clause_that_is_filled_in_stands_apart_from_its_sentence() {
        assert!(stands_apart(None, Some("; and more")) && stands_apart(Some("not sent: "), None));
        assert!(!stands_apart(Some("could not be "), None));
        let mut found = Vec::new();
        for template in TEMPLATES {
            let all: Vec<_> = parts(template.english()).collect();
            for (k, part) in all.iter().enumerate() {
                let text = |k: usize| all.get(k).map(|part| part.unwrap_or(""));
                let before = k.checked_sub(1).and_then(text);
                if let Err(name) = part
                    && CLAUSES.contains(name)
                    && !stands_apart(before, text(k + 1))
                {
                    found.push((*name, template.english()));
                }
            }
        }
        assert!(found.is_empty(), "{found:#?}");
    }

    /// Only one of two entries of a sentence is read: correcting the other would have no effect.
    #[test]
    fn no_catalogue_has_a_sentence_twice() {
        for language in TRANSLATED {
            let mut seen = BTreeSet::new();
            for entry in language.catalogue().split("\n\n") {
                let lines = entry.lines().filter(|line| !line.starts_with('#'));
                let key: Vec<_> = lines.take_while(|l| !l.starts_with("msgstr")).collect();
                assert!(seen.insert(key.clone()), "{language:?}: {key:#?}");
            }
        }
    }

    #[test]
    fn no_catalogue_has_what_nothing_says() {
        let said: BTreeSet<_> = TEMPLATES.iter().map(|template| template.key()).collect();
        for language in TRANSLATED {
            let all = catalogue(language).all();
            let stale = all.filter(|(context, english, _)| {
                *context != LOOKED_UP
                    && *english != WITHOUT_WINDOW
                    && !said.contains(&(*context, *english))
            });
            let stale: Vec<_> = stale
                .map(|(context, english, _)| (context, english))
                .collect();
            assert!(stale.is_empty(), "{language:?}: {stale:#?}");
        }
    }
}
