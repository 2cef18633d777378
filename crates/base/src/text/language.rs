//! The languages that the program speaks: one line here and one catalogue each.

use serde::{Deserialize, Serialize};

macro_rules! languages {
    ($($name:ident, $code:literal, $own:literal, $catalogue:expr;)*) => {
        /// A language that the program speaks.
        #[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
        pub enum Language {
            $(
                #[doc = $own]
                #[serde(rename = $code)]
                $name,
            )*
            /// English with every sentence in ⟦ ⟧, to find texts that are none.
            #[serde(skip)]
            Marked,
            /// English with every sentence made longer by a third, to find what would be cut.
            #[serde(skip)]
            Long,
        }

        /// The languages that are offered: each with the code of ISO 639 and its own name.
        #[doc(hidden)]
        pub const LANGUAGES: &[(Language, &str, &str)] = &[$((Language::$name, $code, $own)),*];

        impl Language {
            /// The catalogue of its sentences; English needs none.
            #[doc(hidden)]
            pub const fn catalogue(self) -> &'static str {
                match self {
                    $(Self::$name => $catalogue,)*
                    Self::Marked | Self::Long => "",
                }
            }
        }
    };
}

languages! {
    English, "en", "English", "";
    German, "de", "Deutsch", include_str!("../../assets/languages/de.po");
    Chinese, "zh", "中文", include_str!("../../assets/languages/zh.po");
}

impl Language {
    /// That of the system, by the environment variables of POSIX; English where it is not offered.
    pub fn of_system() -> Self {
        let set = |name| std::env::var(name).ok().filter(|value| !value.is_empty());
        let locale = ["LC_ALL", "LC_MESSAGES", "LANG"].into_iter().find_map(set);
        locale.map_or(Self::English, |locale| Self::of_locale(&locale))
    }

    fn of_locale(locale: &str) -> Self {
        let code = locale.split(['_', '-', '.', '@']).next();
        Self::of_code(code.unwrap_or_default()).unwrap_or(Self::English)
    }

    /// That with this code of ISO 639.
    pub fn of_code(code: &str) -> Option<Self> {
        let code = code.to_ascii_lowercase();
        let offered = LANGUAGES.iter().find(|(_, offered, _)| *offered == code);
        offered.map(|(language, ..)| *language)
    }

    /// Its code of ISO 639; English for the languages of the tests.
    pub fn code(self) -> &'static str {
        let offered = LANGUAGES.iter().find(|(language, ..)| *language == self);
        offered.map_or("en", |(_, code, _)| code)
    }

    /// Its own name.
    pub fn own_name(self) -> &'static str {
        let offered = LANGUAGES.iter().find(|(language, ..)| *language == self);
        offered.map_or("", |(_, _, own)| own)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_language_of_the_system_is_taken_where_it_is_offered() {
        for (locale, language) in [
            ("de_AT.UTF-8", Language::German),
            ("zh_CN", Language::Chinese),
            ("en_GB.UTF-8", Language::English),
            ("C", Language::English),
            ("fr_FR", Language::English),
        ] {
            assert_eq!(Language::of_locale(locale), language, "{locale}");
        }
    }
}
