//! What the core says, in the language of this thread: its sentences and the names of its effects and parameters.

mod core;
pub(crate) mod names;
mod titles;

pub(crate) use core::{finding, known_words, of_core, spoken};
