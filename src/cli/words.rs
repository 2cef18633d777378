//! What the terminal calls things: in English the ids and names that options and files have; in another language
//! their titles and words. Lines and columns are as wide as a terminal shows them.

use std::borrow::Cow;

use crate::present::names;
use crate::present::table::width;
use crate::text::{Language, Text, current};

fn is_english() -> bool {
    current() == Language::English
}

/// An effect by its id, or by its id and its joint: `backlash`, `backlash 2`.
pub(super) fn effect(name: &str) -> Cow<'_, str> {
    if is_english() {
        name.into()
    } else {
        names::title_of(name).into()
    }
}

/// Effects, with what stands between two of them.
pub(super) fn effects<T: AsRef<str>>(all: &[T], between: &str) -> String {
    let all: Vec<_> = all.iter().map(|one| effect(one.as_ref())).collect();
    all.join(between)
}

/// Words between which `or` stands: names that an option takes.
pub(super) fn any_of(names: &[&str]) -> Text {
    let (first, rest) = names.split_first().unwrap_or((&"", &[]));
    rest.iter().fold(Text::verbatim(*first), |all, next| {
        text!("{first} or {second}", first = all, second = *next)
    })
}

/// A parameter as the heading of a row.
pub(super) fn parameter(name: &str) -> Cow<'_, str> {
    if is_english() {
        return name.into();
    }
    match names::parameter(name) {
        (words, "") => words.into(),
        (words, unit) => format!("{words}, {unit}").into(),
    }
}

/// The line above an answer: whose it is, and of how many samples.
pub(super) fn headed(session: &str, samples: usize) -> String {
    let head = say!(
        one "{session}: {count} sample", "{session}: {count} samples",
        session,
        count = samples
    );
    format!("{head}\n")
}

/// Adds a line.
pub(super) fn line(text: &mut String, sentence: impl AsRef<str>) {
    text.push_str(sentence.as_ref());
    text.push('\n');
}

/// Text with blanks behind it up to this width.
pub(super) fn padded(text: &str, wide: usize) -> String {
    let blanks = wide.saturating_sub(width(text));
    format!("{text}{}", " ".repeat(blanks))
}

/// A label and what belongs to it.
pub(super) type Labelled = (&'static str, String);

/// How wide the labels of these lines are, with two blanks behind the widest.
pub(super) fn wide_of<'l>(lines: impl IntoIterator<Item = &'l Labelled>) -> usize {
    let labels = lines.into_iter().map(|(label, _)| width(label) + 2);
    labels.max().unwrap_or(0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::choose;

    #[test]
    fn english_has_the_names_that_options_take_and_other_languages_words() {
        let said = || {
            (
                effect("backlash 2").into_owned(),
                parameter("width_deg").into_owned(),
            )
        };
        let english = ("backlash 2".to_owned(), "width_deg".to_owned());
        assert_eq!(said(), english);
        choose(Language::German);
        let german = said();
        choose(Language::English);
        assert_eq!(german.0, "Umkehrspiel, Gelenk 2");
        assert_eq!(german.1, "Breite, °");
    }

    #[test]
    fn letters_that_are_wide_count_twice() {
        let lines = [("误差", "1".to_owned()), ("ab", "2".to_owned())];
        assert_eq!(wide_of(&lines), 6);
        assert_eq!(padded("误差", 6), "误差  ");
    }
}
