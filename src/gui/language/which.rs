//! The languages of the window: one line here and one file of messages each.

use serde::{Deserialize, Serialize};

macro_rules! languages {
    ($($name:ident, $code:literal, $own:literal;)*) => {
        /// A language of the window.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
        pub enum Language {
            $(
                #[doc = $own]
                #[serde(rename = $code)]
                $name,
            )*
            /// English with every message in ⟦ ⟧, to find texts that are in no table.
            #[serde(skip)]
            Marked,
            /// English with every message made longer by a third, to find what would be cut.
            #[serde(skip)]
            Long,
        }

        /// The languages that are offered: each with the code of ISO 639, its own name and its file.
        pub(crate) const LANGUAGES: &[(Language, &str, &str)] = &[$((Language::$name, $code, $own)),*];

        /// The text of its file.
        pub(super) fn source(language: Language) -> &'static str {
            match language {
                $(Language::$name => include_str!(concat!("../../../assets/languages/", $code, ".ftl")),)*
                Language::Marked | Language::Long => source(Language::English),
            }
        }
    };
}

languages! {
    English, "en", "English";
    German, "de", "Deutsch";
    Chinese, "zh", "中文";
}

impl Language {
    /// That of the system, by the environment variables of POSIX; English where it is not offered.
    pub(crate) fn of_system() -> Self {
        let set = |name| std::env::var(name).ok().filter(|value| !value.is_empty());
        let locale = ["LC_ALL", "LC_MESSAGES", "LANG"].into_iter().find_map(set);
        locale.map_or(Self::English, |locale| Self::of_locale(&locale))
    }

    pub(super) fn of_locale(locale: &str) -> Self {
        let code = locale
            .split(['_', '-', '.', '@'])
            .next()
            .unwrap_or_default();
        let code = code.to_ascii_lowercase();
        let offered = LANGUAGES.iter().find(|(_, offered, _)| *offered == code);
        offered.map_or(Self::English, |(language, ..)| *language)
    }

    /// Its own name.
    pub(crate) fn own_name(self) -> &'static str {
        let offered = LANGUAGES.iter().find(|(language, ..)| *language == self);
        offered.map_or("", |(_, _, own)| own)
    }

    /// The characters of its messages that no bundled font has: those of East Asian scripts.
    pub(crate) fn letters(self) -> impl Iterator<Item = char> {
        source(self).chars().filter(|c| *c >= '\u{2e80}')
    }
}
