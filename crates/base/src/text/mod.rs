//! What a person reads: sentences as values, and the languages they are spoken in.
//!
//! The English sentence stands where it is said, and is the key of the catalogues of the other languages
//! (`assets/languages/*.po`, as in gettext): English has no table, and what a catalogue lacks is spoken in English.
//! Three macros are all that writes a sentence:
//!
//! | | gives | for |
//! | --- | --- | --- |
//! | `text!` | a [`Text`]: the sentence with its arguments, not spoken yet | what the core finds and keeps |
//! | `say!` | the sentence in the language of this thread | what is shown at once |
//! | `phrase!` | a [`Template`] | a constant: a name in a table, a label of an action |
//!
//! Arguments have names (`text!("joint {joint} turns", joint = 3)`, or `joint` alone where a variable is called so) that
//! are checked while compiling, as languages have orders of their own. The same English of two meanings is told apart by a context (`text!(in "table", "from")`),
//! and what is counted has a form for one (`say!(one "{count} sample", "{count} samples", count = n)`).
//!
//! Every template is listed where the tests are built, and a test fails for one that a catalogue lacks.

/// The value of an argument; without one, the variable of its name.
macro_rules! argument {
    ($name:ident) => {
        $name
    };
    ($name:ident, $value:expr) => {
        $value
    };
}

/// A sentence as a value; see the module.
macro_rules! text {
    (in $context:literal, $english:literal $(, $name:ident $(= $value:expr)?)* $(,)?) => {
        $crate::text::Text::of(
            template!($context, $english, ""; $($name)*),
            vec![$((stringify!($name), $crate::text::Argument::from(argument!($name $(, $value)?)))),*],
        )
    };
    (one $one:literal, $many:literal, $($name:ident $(= $value:expr)?),+ $(,)?) => {
        $crate::text::Text::of(
            template!("", $one, $many; $($name)*),
            vec![$((stringify!($name), $crate::text::Argument::from(argument!($name $(, $value)?)))),+],
        )
    };
    ($english:literal $($arguments:tt)*) => {
        text!(in "", $english $($arguments)*)
    };
}

/// A sentence in the language of this thread: text that lives as long as the program, or, with arguments, a
/// `String`.
macro_rules! say {
    (in $context:literal, $english:literal $(,)?) => {
        $crate::text::spoken(template!($context, $english, "";))
    };
    (in $context:literal, $english:literal, $($name:ident $(= $value:expr)?),+ $(,)?) => {
        $crate::text::filled(
            template!($context, $english, ""; $($name)*),
            &[$((stringify!($name), &argument!($name $(, $value)?) as &dyn ::std::fmt::Display)),+],
        )
    };
    (one $one:literal, $many:literal, $($name:ident $(= $value:expr)?),+ $(,)?) => {
        $crate::text::filled(
            template!("", $one, $many; $($name)*),
            &[$((stringify!($name), &argument!($name $(, $value)?) as &dyn ::std::fmt::Display)),+],
        )
    };
    ($english:literal $($arguments:tt)*) => {
        say!(in "", $english $($arguments)*)
    };
}

/// A sentence as a constant, to be spoken where it is shown. One with arguments names them behind a semicolon.
macro_rules! phrase {
    (in $context:literal, $english:literal) => {
        template!($context, $english, "";)
    };
    ($english:literal $(; $($name:ident),+)?) => {
        template!("", $english, ""; $($($name)+)?)
    };
}

/// `Display` of what says itself: in English, as documents and users of the library have it.
macro_rules! displays_what_it_says {
    ($what:ty) => {
        impl ::std::fmt::Display for $what {
            fn fmt(&self, f: &mut ::std::fmt::Formatter<'_>) -> ::std::fmt::Result {
                ::std::fmt::Display::fmt(&self.describe(), f)
            }
        }
    };
}

/// The template of a sentence: its arguments are checked while compiling, and where tests are built it is listed.
macro_rules! template {
    ($context:literal, $one:literal, $many:literal; $($name:ident)*) => {{
        const TEMPLATE: $crate::text::Template = $crate::text::Template::new($context, $one, $many);
        const _: () = assert!(
            TEMPLATE.takes(&[$(stringify!($name)),*]),
            "the names in braces are not those of the arguments"
        );
        // A list that the linker makes needs a section of its own, which counts as unsafe; only tests have it.
        #[cfg(test)]
        #[allow(unsafe_code, reason = "a section of the test program that linkme reads")]
        #[linkme::distributed_slice($crate::text::TEMPLATES)]
        #[linkme(crate = linkme)]
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

#[cfg(feature = "gui")]
pub(crate) use language::LANGUAGES;
pub(crate) use quantity::{InUnits, current_units};
pub(crate) use sentence::{angle, components, entered, length, lengths, small_angle};
#[cfg(any(test, feature = "cli", feature = "gui"))]
pub(crate) use speech::choose;
#[cfg(feature = "gui")]
pub(crate) use speech::phrases_in;
pub(crate) use speech::{ByTitles, by_titles};
#[cfg(feature = "gui")]
pub(crate) use speech::{characters, name_by_titles, stretch};
pub(crate) use speech::{current, filled, known_in, spoken, within};

/// Every template of the program.
#[cfg(test)]
#[allow(unsafe_code, reason = "as above")]
#[linkme::distributed_slice]
pub(crate) static TEMPLATES: [Template];
