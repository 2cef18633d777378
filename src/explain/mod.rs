//! An answer, said once for every place where a person reads it: sections of few kinds of blocks, in the language of
//! this thread. Terminal, window and report show blocks and word nothing of an answer themselves; what differs by
//! place is how much is asked for (`Detail`), and what a place adds to a section ([`Topic`]).

mod clean;
mod detail;
mod diagnosis;
mod found;
#[cfg(any(feature = "cli", feature = "gui"))]
mod identification;
mod open;
mod parameters;
mod section;
mod sight;
mod standards;
#[cfg(any(feature = "cli", feature = "gui"))]
mod verification;

pub(crate) use clean::cleaned;
pub use clean::{clean, clean_note};
pub(crate) use detail::Detail;
pub(crate) use diagnosis::{answer, diagnosis, expected, floor_from, noise, remarks};
#[cfg(any(feature = "cli", feature = "gui"))]
pub(crate) use identification::remarks_on_fit;
#[cfg(feature = "cli")]
pub(crate) use open::data_problems;
pub(crate) use parameters::{implausible, parameters};
pub(crate) use section::fact;
pub use section::{Block, Fact, Section, Topic};
pub(crate) use standards::standards;
#[cfg(any(feature = "cli", feature = "gui"))]
pub(crate) use verification::verification;
