//! A sentence as a value.

use std::fmt;

use super::english::Template;
use super::language::Language;
use super::speech::{current, filled_in};

/// A sentence with its arguments, to be spoken in any language; `Display` is English. Or words that are nobody's to
/// translate: a name in a file, what a library or the system reported.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Text(Kind);

#[derive(Debug, Clone, PartialEq, Eq)]
enum Kind {
    Verbatim(String),
    Sentence(Template, Vec<(&'static str, Argument)>),
}

/// What is filled into a sentence.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Argument {
    /// Another sentence, or words as they are.
    Text(Text),
    /// So many: it chooses between the forms for one and for several.
    Count(usize),
}

impl Text {
    pub(crate) fn of(template: Template, arguments: Vec<(&'static str, Argument)>) -> Self {
        Self(Kind::Sentence(template, arguments))
    }

    /// In the language of this thread.
    pub(crate) fn spoken(&self) -> String {
        self.spoken_in(current())
    }

    /// In this language.
    pub fn spoken_in(&self, language: Language) -> String {
        match &self.0 {
            Kind::Verbatim(text) => text.clone(),
            Kind::Sentence(template, arguments) => {
                let said: Vec<(&str, String)> = arguments
                    .iter()
                    .map(|(name, value)| (*name, value.spoken_in(language)))
                    .collect();
                let said: Vec<(&str, &dyn fmt::Display)> = said
                    .iter()
                    .map(|(name, value)| (*name, value as _))
                    .collect();
                filled_in(language, *template, &said)
            }
        }
    }

    /// Whether nothing is said.
    pub fn is_empty(&self) -> bool {
        matches!(&self.0, Kind::Verbatim(text) if text.is_empty())
    }
}

impl Argument {
    fn spoken_in(&self, language: Language) -> String {
        match self {
            Self::Text(text) => text.spoken_in(language),
            Self::Count(count) => count.to_string(),
        }
    }
}

impl fmt::Display for Text {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            Kind::Verbatim(text) => f.pad(text),
            Kind::Sentence(..) => f.pad(&self.spoken_in(Language::English)),
        }
    }
}

impl From<String> for Text {
    fn from(words: String) -> Self {
        Self(Kind::Verbatim(words))
    }
}

impl From<&str> for Text {
    fn from(words: &str) -> Self {
        words.to_owned().into()
    }
}

impl From<&String> for Text {
    fn from(words: &String) -> Self {
        words.clone().into()
    }
}

impl From<Template> for Text {
    fn from(template: Template) -> Self {
        Self::of(template, Vec::new())
    }
}

impl From<usize> for Argument {
    fn from(count: usize) -> Self {
        Self::Count(count)
    }
}

impl<T: Into<Text>> From<T> for Argument {
    fn from(text: T) -> Self {
        Self::Text(text.into())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sentence_is_english_until_it_is_spoken() {
        let unit = text!("in {unit}", unit = text!("degrees"));
        assert_eq!(unit.to_string(), "in degrees");
        assert_eq!(unit.spoken_in(Language::Marked), "⟦in ⟧⟦degrees⟧⟦⟧");
        assert_eq!(Text::from("x_mm").spoken_in(Language::German), "x_mm");
    }
}
