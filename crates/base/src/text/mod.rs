//! Text for people: sentences as values, and their languages.
//!
//! The English sentence is written where it is used, and is the key of the catalogues of the other languages
//! (`assets/languages/*.po`, as in gettext): English has no table, and what a catalogue lacks appears in English.
//! Every sentence is written with one of three macros:
//!
//! | | gives | for |
//! | --- | --- | --- |
//! | `text!` | a [`Text`]: the sentence with its arguments, not spoken yet | what the core finds and keeps |
//! | `say!` | the sentence in the language of this thread | what is shown at once |
//! | `phrase!` | a [`Template`] | a constant: a name in a table, a label of an action |
//!
//! Arguments have names (`text!("joint {joint} turns", joint = 3)`, or `joint` alone where a variable is called so)
//! that are checked while compiling, as languages have different orders. The same English of two meanings is
//! distinguished by a context (`text!(in "table", "from")`), and what is counted has a form for one (`say!(one
//! "{count} sample", "{count} samples", count = n)`).
//!
//! Every template is listed in a build for development, and a test fails for one that a catalogue lacks.

/// The value of an argument; without one, the variable of its name.
#[doc(hidden)]
#[macro_export]
macro_rules! argument {
    ($name:ident) => {
        $name
    };
    ($name:ident, $value:expr) => {
        $value
    };
}

/// A sentence as a value; see the module.
#[doc(hidden)]
#[macro_export]
macro_rules! text {
    (in $context:literal, $english:literal $(, $name:ident $(= $value:expr)?)* $(,)?) => {
        $crate::text::Text::of(
            $crate::template!($context, $english, ""; $($name)*),
            vec![$((stringify!($name), $crate::text::Argument::from($crate::argument!($name $(, $value)?)))),*],
        )
    };
    (one $one:literal, $many:literal, $($name:ident $(= $value:expr)?),+ $(,)?) => {
        $crate::text::Text::of(
            $crate::template!("", $one, $many; $($name)*),
            vec![$((stringify!($name), $crate::text::Argument::from($crate::argument!($name $(, $value)?)))),+],
        )
    };
    ($english:literal $($arguments:tt)*) => {
        $crate::text!(in "", $english $($arguments)*)
    };
}

/// A sentence in the language of this thread: text that lives as long as the program, or, with arguments, a
/// `String`.
#[doc(hidden)]
#[macro_export]
macro_rules! say {
    (in $context:literal, $english:literal $(,)?) => {
        $crate::text::spoken($crate::template!($context, $english, "";))
    };
    (in $context:literal, $english:literal, $($name:ident $(= $value:expr)?),+ $(,)?) => {
        $crate::text::filled(
            $crate::template!($context, $english, ""; $($name)*),
            &[$((stringify!($name), &$crate::argument!($name $(, $value)?) as &dyn ::std::fmt::Display)),+],
        )
    };
    (one $one:literal, $many:literal, $($name:ident $(= $value:expr)?),+ $(,)?) => {
        $crate::text::filled(
            $crate::template!("", $one, $many; $($name)*),
            &[$((stringify!($name), &$crate::argument!($name $(, $value)?) as &dyn ::std::fmt::Display)),+],
        )
    };
    ($english:literal $($arguments:tt)*) => {
        $crate::say!(in "", $english $($arguments)*)
    };
}

/// A sentence as a constant, to be spoken where it is shown. One with arguments names them behind a semicolon.
#[doc(hidden)]
#[macro_export]
macro_rules! phrase {
    (in $context:literal, $english:literal) => {
        $crate::template!($context, $english, "";)
    };
    ($english:literal $(; $($name:ident),+)?) => {
        $crate::template!("", $english, ""; $($($name)+)?)
    };
}

/// `Display` in English, as documents and users of the library have it.
#[doc(hidden)]
#[macro_export]
macro_rules! displays_what_it_says {
    ($what:ty) => {
        impl ::std::fmt::Display for $what {
            fn fmt(&self, f: &mut ::std::fmt::Formatter<'_>) -> ::std::fmt::Result {
                ::std::fmt::Display::fmt(&self.describe(), f)
            }
        }
    };
}

/// The template of a sentence: its arguments are checked while compiling, and in a build for development it is listed.
#[doc(hidden)]
#[macro_export]
macro_rules! template {
    ($context:literal, $one:literal, $many:literal; $($name:ident)*) => {{
        const TEMPLATE: $crate::text::Template = $crate::text::Template::new($context, $one, $many);
        const _: () = assert!(
            TEMPLATE.takes(&[$(stringify!($name)),*]),
            "the names in braces are not those of the arguments"
        );
        // A list that the linker makes needs a separate section, which counts as unsafe; no release has it.
        #[cfg(debug_assertions)]
        #[allow(unsafe_code, reason = "a section of the test program that linkme reads")]
        #[$crate::linkme::distributed_slice($crate::text::TEMPLATES)]
        #[linkme(crate = $crate::linkme)]
        static LISTED: $crate::text::Template = TEMPLATE;
        TEMPLATE
    }};
}

mod catalogue;
mod english;
mod language;
mod quantity;
mod sentence;
mod speech;

pub use english::Template;
pub use language::Language;
pub use sentence::{Argument, Text};

pub use catalogue::catalogue;
pub use english::parts;
pub use language::LANGUAGES;
pub use quantity::{InUnits, current_units};
pub use sentence::{angle, components, entered, length, lengths, small_angle};
pub use speech::{
    ByTitles, by_titles, capital, characters, choose, current, filled, known_in, name_by_titles,
    spoken, stretch, within,
};

/// Every template of the program: a list only where debug assertions are on.
#[cfg(debug_assertions)]
#[doc(hidden)]
#[allow(unsafe_code, reason = "as above")]
#[linkme::distributed_slice]
pub static TEMPLATES: [Template];
