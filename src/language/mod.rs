//! What the core says, in the language of this thread: its sentences and the names of its effects and parameters.

mod core;
pub(crate) mod names;

#[cfg(any(feature = "cli", feature = "gui"))]
pub(crate) use core::finding;
#[cfg(feature = "gui")]
pub(crate) use core::known_words;
pub(crate) use core::spoken;
