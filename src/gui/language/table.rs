//! The messages of one language, read once.

use std::collections::BTreeMap;
use std::fmt::Display;
use std::sync::OnceLock;

use fluent_bundle::concurrent::FluentBundle;
use fluent_bundle::{FluentArgs, FluentResource, FluentValue};
use unic_langid::LanguageIdentifier;

use super::which::{LANGUAGES, Language, source};

/// See the module.
pub(super) struct Table {
    language: Language,
    bundle: FluentBundle<FluentResource>,
    keys: Vec<String>,
    /// Messages that need no argument.
    plain: BTreeMap<String, String>,
}

/// That of a language; it is read when it is asked for the first time.
pub(super) fn table(language: Language) -> &'static Table {
    static TABLES: [OnceLock<Table>; LANGUAGES.len() + 2] =
        [const { OnceLock::new() }; LANGUAGES.len() + 2];
    TABLES[language as usize].get_or_init(|| Table::of(language))
}

impl Table {
    fn of(language: Language) -> Self {
        let offered = LANGUAGES.iter().find(|(other, ..)| *other == language);
        let code = offered.map_or("en", |(_, code, _)| code);
        let code: LanguageIdentifier = code.parse().unwrap_or_default();
        let mut bundle = FluentBundle::new_concurrent(vec![code]);
        bundle.set_use_isolating(false);
        // What cannot be read is left out, and shown in English; a test reads every file.
        let text = source(language).to_owned();
        let resource = FluentResource::try_new(text).unwrap_or_else(|(read, _)| read);
        let keys = source(language)
            .lines()
            .filter_map(|line| Some(line.split_once(" =")?.0));
        let keys: Vec<&str> = keys
            .filter(|key| !key.starts_with([' ', '#', '-']))
            .collect();
        bundle.add_resource_overriding(resource);
        let mut table = Self {
            language,
            bundle,
            keys: keys.iter().map(|key| (*key).to_owned()).collect(),
            plain: BTreeMap::new(),
        };
        for id in keys {
            let mut errors = Vec::new();
            let text = table.format(id, None, &mut errors);
            if let (Some(text), true) = (text, errors.is_empty()) {
                table.plain.insert(id.to_owned(), text);
            }
        }
        table
    }

    fn format(
        &self,
        key: &str,
        arguments: Option<&FluentArgs>,
        errors: &mut Vec<fluent_bundle::FluentError>,
    ) -> Option<String> {
        let pattern = self.bundle.get_message(key)?.value()?;
        let text = self.bundle.format_pattern(pattern, arguments, errors);
        Some(match self.language {
            Language::Marked => format!("⟦{text}⟧"),
            Language::Long => format!("{text}{}", longer(&text)),
            _ => text.into_owned(),
        })
    }

    /// The key of every message.
    pub(super) fn keys(&'static self) -> impl Iterator<Item = &'static str> {
        self.keys.iter().map(String::as_str)
    }

    pub(super) fn plain(&'static self, key: &'static str) -> &'static str {
        let known = self.plain.get(key).map(String::as_str);
        known.unwrap_or_else(|| {
            debug_assert!(
                self.language != Language::English,
                "there is no message {key}"
            );
            if self.language == Language::English {
                key
            } else {
                table(Language::English).plain(key)
            }
        })
    }

    pub(super) fn named(&'static self, kind: &str, id: &str) -> Option<&'static str> {
        self.plain.get(&format!("{kind}-{id}")).map(String::as_str)
    }

    /// What is filled in is not the table's: where the table's texts are marked, it stands outside of them.
    fn outside(&self, value: FluentValue<'static>) -> FluentValue<'static> {
        match value {
            FluentValue::String(text) if self.language == Language::Marked => {
                format!("⟧{text}⟦").into()
            }
            value => value,
        }
    }

    pub(super) fn filled(&self, key: &str, arguments: &[(&'static str, &dyn Display)]) -> String {
        let values = arguments.iter().map(|(name, value)| {
            let value = argument(&value.to_string());
            (*name, self.outside(value))
        });
        let values: FluentArgs = values.collect();
        let text = self.format(key, Some(&values), &mut Vec::new());
        text.unwrap_or_else(|| {
            debug_assert!(
                self.language != Language::English,
                "there is no message {key}"
            );
            if self.language == Language::English {
                key.to_owned()
            } else {
                table(Language::English).filled(key, arguments)
            }
        })
    }
}

/// A whole number chooses the form for its count; everything is written as it comes.
fn argument(text: &str) -> FluentValue<'static> {
    let whole = !text.is_empty() && text.len() < 10 && text.bytes().all(|b| b.is_ascii_digit());
    if whole && (text == "0" || !text.starts_with('0')) {
        FluentValue::try_number(text).into_owned()
    } else {
        text.to_owned().into()
    }
}

/// What makes a text longer by a third; a word that cannot be broken grows too.
fn longer(text: &str) -> String {
    let letters = text.chars().filter(|c| c.is_alphabetic()).count();
    "~".repeat(letters.div_ceil(3).min(12))
}
