//! The sentences of one language, read once from its catalogue: a file of gettext (PO), which translators' tools
//! read and write.

use std::collections::BTreeMap;
use std::sync::OnceLock;

use polib::po_file::parse_from_reader;

use super::english::Template;
use super::language::{LANGUAGES, Language};

/// The forms of a sentence: for one and for several, or one for all.
struct Sentence {
    forms: Vec<String>,
}

/// The translations of one language.
pub struct Catalogue {
    sentences: BTreeMap<(String, String), Sentence>,
}

/// That of a language; it is read when it is asked for the first time.
#[doc(hidden)]
pub fn catalogue(language: Language) -> &'static Catalogue {
    static CATALOGUES: [OnceLock<Catalogue>; LANGUAGES.len() + 2] =
        [const { OnceLock::new() }; LANGUAGES.len() + 2];
    CATALOGUES[language as usize].get_or_init(|| Catalogue::read(language.catalogue()))
}

impl Catalogue {
    /// What cannot be read is left out, and appears in English; a test reads every catalogue.
    fn read(po: &str) -> Self {
        let mut sentences = BTreeMap::new();
        if !po.is_empty()
            && let Ok(read) = parse_from_reader(po.as_bytes())
        {
            for message in read.messages().filter(|m| m.is_translated()) {
                let context = message.msgctxt().unwrap_or_default();
                let forms = match message.msgstr_plural() {
                    Ok(forms) => forms.clone(),
                    Err(_) => vec![message.msgstr().unwrap_or_default().to_owned()],
                };
                let key = (context.to_owned(), message.msgid().to_owned());
                sentences.insert(key, Sentence { forms });
            }
        }
        Self { sentences }
    }

    /// The sentence as this language has it, for one or for several.
    pub fn of(&'static self, template: Template, one: bool) -> Option<&'static str> {
        let (context, english) = template.key();
        let key = (context.to_owned(), english.to_owned());
        let forms = &self.sentences.get(&key)?.forms;
        let form = if one { forms.first() } else { forms.last() };
        form.map(String::as_str)
    }

    /// The translation of these words in this context.
    pub(super) fn translated_in(
        &'static self,
        context: &str,
        english: &str,
    ) -> Option<&'static str> {
        let key = (context.to_owned(), english.to_owned());
        self.sentences.get(&key)?.forms.last().map(String::as_str)
    }

    /// The English of every sentence in a context.
    pub(super) fn in_context<'a>(
        &'static self,
        context: &'a str,
    ) -> impl Iterator<Item = &'static str> + 'a {
        let first = (context.to_owned(), String::new());
        let those = self.sentences.range(first..).map(|(key, _)| key);
        those
            .take_while(move |(own, _)| own == context)
            .map(|(_, english)| english.as_str())
    }

    /// Every sentence: context, English, forms.
    pub fn all(
        &'static self,
    ) -> impl Iterator<Item = (&'static str, &'static str, &'static [String])> {
        self.sentences
            .iter()
            .map(|((context, english), said)| (context.as_str(), english.as_str(), &said.forms[..]))
    }
}
