//! What the core says, in the language of this thread.
//!
//! The core speaks English and knows no language: checks of a machine, reasons, findings. Here its sentences are
//! recognised by those of the English table: messages whose key begins with `core-`, with `$a`, `$b`, … for what
//! is filled in. What is filled in may be such a sentence itself, or the name of an effect. What is not recognised
//! is shown as it is.

use std::borrow::Cow;
use std::cell::RefCell;
use std::collections::BTreeMap;
use std::fmt::Display;
use std::sync::OnceLock;

use crate::diagnostic::Diagnostic;
use crate::effects::find;
use crate::present::names::{on_joint, parameter, title, title_of};
use crate::text::{Language, Text, current, known, known_in, within};

const CONTEXT: &str = "core";
/// What may be filled in, by name, and what stands for it where a sentence is taken apart.
const HOLES: [(&str, char); 6] = [
    ("a", '\u{e000}'),
    ("b", '\u{e001}'),
    ("c", '\u{e002}'),
    ("d", '\u{e003}'),
    ("e", '\u{e004}'),
    ("f", '\u{e005}'),
];
/// How deep a sentence is looked for in what is filled in.
const DEEPEST: u32 = 4;
/// Sentences that are kept; beyond that all are looked up anew.
const MOST_KEPT: usize = 2000;

thread_local! {
    static KNOWN: RefCell<(Language, BTreeMap<String, String>)> =
        const { RefCell::new((Language::English, BTreeMap::new())) };
}

/// What the core says, in the language of this thread.
pub(crate) fn of_core(english: &str) -> Cow<'_, str> {
    let language = current();
    if language == Language::English {
        return Cow::Borrowed(english);
    }
    let known = KNOWN.with_borrow_mut(|(of, known)| {
        if *of != language || known.len() > MOST_KEPT {
            (*of, *known) = (language, BTreeMap::new());
        }
        known.get(english).cloned()
    });
    let said = known.unwrap_or_else(|| {
        let said = translated(english, DEEPEST).unwrap_or_else(|| english.to_owned());
        KNOWN.with_borrow_mut(|(_, known)| known.insert(english.to_owned(), said.clone()));
        said
    });
    Cow::Owned(said)
}

/// A sentence of the core, in the language of this thread. Words in it that no template made, as those of an error,
/// are looked for among the patterns.
pub(crate) fn spoken(text: &Text) -> String {
    text.spoken_by(current(), &|words| of_core(words).into_owned())
}

/// A finding, with where it is and what was expected.
pub(crate) fn finding(finding: &Diagnostic) -> String {
    let place = finding.place.to_string();
    let found = spoken(&finding.found);
    let found = if finding.expected.is_empty() {
        found
    } else {
        let expected = spoken(&finding.expected);
        say!(
            "{found}; expected {expected}",
            found = found,
            expected = expected
        )
    };
    if place.is_empty() {
        found
    } else {
        say!("{place}: {found}", place = of_core(&place), found = found)
    }
}

/// Coefficients of a model that stand together, by their names in files: `link-geometry of joint 2: x_mm with
/// measuring-frame: z_mm`.
pub(crate) fn combination(text: &str) -> String {
    let one = |name: &str| {
        let (whose, coefficient) = name.split_once(": ")?;
        let (id, of) = whose.split_once(" of ").unwrap_or((whose, ""));
        let title = title(id).to_owned();
        let title = match of.strip_prefix("joint ") {
            Some(joint) => on_joint(id, joint),
            None if of.is_empty() => title,
            None => format!("{title}, {}", of_core(of)),
        };
        Some(format!("{title}: {}", parameter(coefficient).0))
    };
    let all = text
        .split(" with ")
        .map(|name| one(name).unwrap_or_else(|| of_core(name).into_owned()));
    all.collect::<Vec<_>>()
        .join(&format!(" {} ", of_core("with")))
}

fn translated(english: &str, deep: u32) -> Option<String> {
    // What effects say of themselves stands among the sentences of the code.
    if let Some(said) = known_in(current(), "", english, &[]) {
        return Some(said);
    }
    let patterns = patterns();
    let first = english.chars().next()?;
    let fitting = patterns.iter().filter(|pattern| pattern.may_begin(first));
    let found = fitting.filter_map(|pattern| Some((pattern, pattern.filled_in(english)?)));
    let (pattern, filled_in) = found.max_by_key(|(pattern, _)| pattern.weight())?;
    let inner = |text: &&str| match deep {
        0 => (*text).to_owned(),
        _ => translated(text, deep - 1).unwrap_or_else(|| of_effects(text)),
    };
    let filled_in: Vec<String> = filled_in.iter().map(inner).collect();
    let arguments: Vec<(&'static str, &dyn Display)> = HOLES
        .iter()
        .zip(&filled_in)
        .map(|((name, _), text)| (*name, text as &dyn Display))
        .collect();
    known_in(current(), CONTEXT, pattern.english, &arguments)
}

/// What the core says in these words, among those of this kind, where the language has it.
#[cfg(feature = "gui")]
pub(crate) fn known_words(kind: &str, english: &str) -> Option<String> {
    let as_written = |one: &&str| one.eq_ignore_ascii_case(english);
    let english = known(kind).find(as_written).unwrap_or(english);
    known_in(current(), kind, english, &[])
}

/// The titles of what are ids of effects, each with its joint or without, or of coefficients that stand together;
/// anything else stays as it is.
fn of_effects(text: &str) -> String {
    let is_id = |id: &str| find(id).is_some();
    let is_name = |name: &str| match name.split_once(' ') {
        Some((id, joint)) => is_id(id) && joint.bytes().all(|b| b.is_ascii_digit()),
        None => is_id(name),
    };
    for between in [", ", " + "] {
        if text.split(between).all(is_name) {
            let titles = text
                .split(between)
                .map(|name| within(&title_of(name)).into_owned());
            return titles.collect::<Vec<_>>().join(between);
        }
    }
    match text.split_once(": ") {
        Some((whose, _)) if whose.split(' ').next().is_some_and(is_id) => combination(text),
        _ => text.to_owned(),
    }
}

/// An English sentence with what is filled in left out.
struct Pattern {
    english: &'static str,
    /// What stands before, between and behind, and which comes first, second, …: the place in [`HOLES`].
    around: Vec<String>,
    holes: Vec<usize>,
}

fn patterns() -> &'static [Pattern] {
    static PATTERNS: OnceLock<Vec<Pattern>> = OnceLock::new();
    PATTERNS.get_or_init(|| known(CONTEXT).map(Pattern::of).collect())
}

impl Pattern {
    fn of(english: &'static str) -> Self {
        let marked = HOLES.iter().fold(english.to_owned(), |text, (name, mark)| {
            text.replace(&format!("{{{name}}}"), &mark.to_string())
        });
        let hole = |c: char| HOLES.iter().position(|(_, mark)| *mark == c);
        Self {
            english,
            around: marked
                .split(|c| hole(c).is_some())
                .map(str::to_owned)
                .collect(),
            holes: marked.chars().filter_map(hole).collect(),
        }
    }

    fn may_begin(&self, first: char) -> bool {
        self.around[0].chars().next().is_none_or(|own| own == first)
    }

    /// The more of a sentence is given, the better it is recognised.
    fn weight(&self) -> (usize, usize) {
        let given = self.around.iter().map(String::len).sum();
        (given, usize::MAX - self.holes.len())
    }

    /// What is filled in, in the order of [`HOLES`]; `None` where the text is another sentence.
    fn filled_in<'t>(&self, text: &'t str) -> Option<Vec<&'t str>> {
        let (first, rest) = self.around.split_first()?;
        let mut text = text.strip_prefix(first.as_str())?;
        let Some((last, between)) = rest.split_last() else {
            return text.is_empty().then(Vec::new);
        };
        let mut found = vec![""; self.holes.len()];
        for (literal, hole) in between.iter().zip(&self.holes) {
            let at = text.find(literal.as_str())?;
            *found.get_mut(*hole)? = &text[..at];
            text = &text[at + literal.len()..];
        }
        *found.get_mut(*self.holes.last()?)? = text.strip_suffix(last.as_str())?;
        found.iter().all(|part| !part.is_empty()).then_some(found)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::text::choose;

    fn pattern(text: &'static str) -> Pattern {
        Pattern::of(text)
    }

    #[test]
    fn what_is_filled_in_stands_between_what_is_given() {
        let turned = pattern("{b} of {a}, at most");
        assert_eq!(
            turned.filled_in("3 mm of 5 mm, at most"),
            Some(vec!["5 mm", "3 mm"])
        );
        assert_eq!(turned.filled_in("3 mm of 5 mm"), None);
        assert_eq!(pattern("as it is").filled_in("as it is"), Some(Vec::new()));
        assert_eq!(pattern("as it is").filled_in("as it is not"), None);
        assert_eq!(pattern("up to {a}").filled_in("up to "), None);
    }

    #[test]
    fn what_is_not_recognised_and_what_is_english_stays_as_it_is() {
        assert_eq!(of_core("survey the base again"), "survey the base again");
        choose(Language::German);
        assert_eq!(of_core("an unknown sentence"), "an unknown sentence");
        assert_eq!(of_core("survey the base again"), "den Sockel neu einmessen");
        choose(Language::English);
        assert_eq!(of_core("survey the base again"), "survey the base again");
    }

    #[test]
    fn what_is_filled_in_is_translated_as_well() {
        choose(Language::German);
        let says = "joint-scale of joint 2 leaves 0.1 mm: needs a mechanical repair: the tool data in the controller";
        let german = "Maßstabsfehler des Gelenks von Gelenk 2 lässt 0.1 mm übrig: braucht eine mechanische Reparatur: \
                      die Werkzeugdaten in der Steuerung";
        assert_eq!(of_core(says), german);
        choose(Language::English);
    }
}
