//! A sentence as a value.

use std::borrow::{Borrow, Cow};
use std::fmt;
use std::sync::Arc;

use super::english::Template;
use super::language::Language;
use super::quantity::{Dimension, InUnits, Quantity, Several, current_units};
use super::speech::filled_in;

/// A sentence with its arguments, to be spoken in any language; `Display` is English. Or words that are not to
/// translate: a name in a file, what a library or the system reported.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Text(Kind);

#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
enum Kind {
    Verbatim(String),
    /// Clauses one after the other.
    Joined(Vec<Text>),
    Quantity(Quantity),
    /// What has an id in files and commands, which is also the English word, and its names in other languages.
    Named(Box<(String, Text)>),
    /// In a box: findings travel in results, which should be small.
    Sentence(Box<(Template, Vec<(&'static str, Argument)>)>),
}

/// What is filled into a sentence.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub enum Argument {
    /// Another sentence, or words as they are.
    Text(Text),
    /// So many: it chooses between the forms for one and for several.
    Count(usize),
}

impl Text {
    #[doc(hidden)]
    pub fn of(template: Template, arguments: Vec<(&'static str, Argument)>) -> Self {
        Self(Kind::Sentence(Box::new((template, arguments))))
    }

    /// Words that are not translated: a name in a file, what a library or the system reported.
    pub fn verbatim(words: impl Into<String>) -> Self {
        Self(Kind::Verbatim(words.into()))
    }

    /// What files and commands have an id for: English has the id where files and commands are near, and these words
    /// in the window and on paper; another language always has the words.
    #[doc(hidden)]
    pub fn named(id: impl Into<String>, words: impl Into<Self>) -> Self {
        Self(Kind::Named(Box::new((id.into(), words.into()))))
    }

    /// One after the other, with this between them.
    pub fn listed(all: impl IntoIterator<Item = impl Into<Self>>, between: &str) -> Self {
        let mut clauses = Vec::new();
        for one in all {
            if !clauses.is_empty() {
                clauses.push(Self::verbatim(between));
            }
            clauses.push(one.into());
        }
        Self(Kind::Joined(clauses))
    }

    /// In this language; words that no template made stay as they are.
    pub fn spoken_in(&self, language: Language) -> String {
        self.spoken_with(language, false)
    }

    /// In this language, and whether English has words for what has an id.
    #[doc(hidden)]
    pub fn spoken_with(&self, language: Language, by_titles: bool) -> String {
        match &self.0 {
            Kind::Verbatim(text) => text.clone(),
            Kind::Joined(clauses) => {
                let clauses = clauses.iter();
                clauses
                    .map(|one| one.spoken_with(language, by_titles))
                    .collect()
            }
            Kind::Quantity(quantity) => quantity.spoken(current_units()),
            Kind::Named(named) if language == Language::English && !by_titles => named.0.clone(),
            Kind::Named(named) => named.1.spoken_with(language, by_titles),
            Kind::Sentence(sentence) => {
                let (template, arguments) = &**sentence;
                let said: Vec<(&str, String)> = arguments
                    .iter()
                    .map(|(name, value)| (*name, value.spoken_with(language, by_titles)))
                    .collect();
                let said: Vec<(&str, &dyn fmt::Display)> = said
                    .iter()
                    .map(|(name, value)| (*name, value as _))
                    .collect();
                filled_in(language, *template, &said)
            }
        }
    }

    /// Whether its English has this in it.
    pub fn contains(&self, part: &str) -> bool {
        self.to_string().contains(part)
    }

    /// Whether it is empty.
    pub fn is_empty(&self) -> bool {
        match &self.0 {
            Kind::Verbatim(text) => text.is_empty(),
            Kind::Joined(clauses) => clauses.iter().all(Self::is_empty),
            Kind::Quantity(_) | Kind::Named(_) | Kind::Sentence(_) => false,
        }
    }
}

/// A length with so many digits behind the point in mm, as the argument of a sentence.
#[doc(hidden)]
pub fn length(mm: impl Borrow<f64>, decimals: usize) -> Text {
    quantity(
        Dimension::Length,
        (&[*mm.borrow()], Several::Change),
        decimals,
    )
}

/// How a length changes: `0.1350 → 0.0540 mm`.
#[doc(hidden)]
pub fn lengths(mm: [f64; 2], decimals: usize) -> Text {
    quantity(Dimension::Length, (&mm, Several::Change), decimals)
}

/// The components of a vector: `1.00, 2.00, 3.00 mm`.
#[doc(hidden)]
pub fn components(mm: [f64; 3], decimals: usize) -> Text {
    quantity(Dimension::Length, (&mm, Several::Components), decimals)
}

/// A length, or the components of a vector, as it is entered in a machine: in every unit as fine as 0.0001 mm.
#[doc(hidden)]
pub fn entered(mm: impl AsRef<[f64]>) -> Text {
    let values = (mm.as_ref(), Several::Components);
    Text(Kind::Quantity(
        Quantity::new(Dimension::Length, values, 4).entered(),
    ))
}

/// An angle with so many digits behind the point in degrees.
#[doc(hidden)]
pub fn angle(rad: impl Borrow<f64>, decimals: usize) -> Text {
    quantity(
        Dimension::Angle,
        (&[*rad.borrow()], Several::Change),
        decimals,
    )
}

/// An error of an orientation with so many digits behind the point in mrad.
#[doc(hidden)]
pub fn small_angle(rad: impl Borrow<f64>, decimals: usize) -> Text {
    quantity(
        Dimension::SmallAngle,
        (&[*rad.borrow()], Several::Change),
        decimals,
    )
}

fn quantity(dimension: Dimension, values: (&[f64], Several), decimals: usize) -> Text {
    Text(Kind::Quantity(Quantity::new(dimension, values, decimals)))
}

impl Argument {
    fn spoken_with(&self, language: Language, by_titles: bool) -> String {
        match self {
            Self::Text(text) => text.spoken_with(language, by_titles),
            Self::Count(count) => count.to_string(),
        }
    }
}

impl fmt::Display for Text {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match &self.0 {
            Kind::Verbatim(text) => f.pad(text),
            Kind::Joined(_) | Kind::Quantity(_) | Kind::Named(_) | Kind::Sentence(_) => {
                // Documents have their units whatever the reader of this thread chose.
                let _units = InUnits::of_documents();
                f.pad(&self.spoken_in(Language::English))
            }
        }
    }
}

impl serde::Serialize for Text {
    /// Documents are English.
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl From<&Text> for Text {
    fn from(text: &Text) -> Self {
        text.clone()
    }
}

impl From<&Template> for Text {
    fn from(template: &Template) -> Self {
        Self::of(*template, Vec::new())
    }
}

impl From<Template> for Text {
    fn from(template: Template) -> Self {
        Self::of(template, Vec::new())
    }
}

impl std::ops::AddAssign for Text {
    /// Another clause behind it.
    fn add_assign(&mut self, clause: Self) {
        let before = std::mem::take(self);
        *self = match before.0 {
            Kind::Joined(mut clauses) => {
                clauses.push(clause);
                Self(Kind::Joined(clauses))
            }
            own => Self(Kind::Joined(vec![Self(own), clause])),
        };
    }
}

impl Default for Text {
    /// Nothing.
    fn default() -> Self {
        Self::verbatim("")
    }
}

impl From<usize> for Argument {
    fn from(count: usize) -> Self {
        Self::Count(count)
    }
}

impl From<&usize> for Argument {
    fn from(count: &usize) -> Self {
        Self::Count(*count)
    }
}

impl From<Text> for Argument {
    fn from(text: Text) -> Self {
        Self::Text(text)
    }
}

impl From<&Text> for Argument {
    fn from(text: &Text) -> Self {
        Self::Text(text.clone())
    }
}

impl From<&Template> for Argument {
    fn from(phrase: &Template) -> Self {
        Self::Text(phrase.into())
    }
}

impl From<Template> for Argument {
    fn from(phrase: Template) -> Self {
        Self::Text(phrase.into())
    }
}

macro_rules! words {
    ($($type:ty),*) => {
        $(impl From<$type> for Argument {
            fn from(words: $type) -> Self {
                Self::Text(Text::verbatim(words.to_string()))
            }
        })*
    };
}

words! { String, &String, &str, &&str, Cow<'_, str>, Arc<str>, &Arc<str>, char, i32, i64, u8, u16, u32, u64, f64, &f64, &u64 }

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sentence_is_english_until_it_is_spoken() {
        let folder = text!("the session's folder");
        let expected = text!("a file in {folder} or below it", folder);
        let english = "a file in the session's folder or below it";
        assert_eq!(expected.to_string(), english);
        let marked = "⟦a file in ⟧⟦the session's folder⟧⟦ or below it⟧";
        assert_eq!(expected.spoken_in(Language::Marked), marked);
        assert_eq!(Text::verbatim("x_mm").spoken_in(Language::German), "x_mm");
    }
}
