//! Every sentence of all crates beside the catalogues. They hold those of the window too, so only a build with it can
//! compare them.

use std::collections::BTreeSet;

use crate::text::{Language, TEMPLATES, Template, catalogue, parts};

/// What only a build without the window says.
const WITHOUT_WINDOW: &str = "this build has no window; the main job in the terminal is: {job}";
const TRANSLATED: [Language; 2] = [Language::German, Language::Chinese];

fn arguments(text: &str) -> BTreeSet<&str> {
    parts(text).filter_map(Result::err).collect()
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
            *english != WITHOUT_WINDOW && !said.contains(&(*context, *english))
        });
        let stale: Vec<_> = stale
            .map(|(context, english, _)| (context, english))
            .collect();
        assert!(stale.is_empty(), "{language:?}: {stale:#?}");
    }
}
