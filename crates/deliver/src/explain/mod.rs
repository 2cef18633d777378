//! An answer, said once for every place where a person reads it: sections of few kinds of blocks, in the language of
//! this thread. Terminal, window and report show blocks and word nothing of an answer themselves; what differs by
//! place is how much is asked for (`Detail`), and what a place adds to a section ([`Topic`]).

mod clean;
mod detail;
mod diagnosis;
mod found;
mod geometry;
mod history;
#[cfg(any(feature = "cli", feature = "gui"))]
mod identification;
#[cfg(any(feature = "cli", feature = "gui"))]
mod imported;
mod open;
mod parameters;
#[cfg(feature = "cli")]
mod plan;
#[cfg(any(feature = "cli", feature = "gui"))]
mod program;
mod section;
mod sight;
mod standards;
#[cfg(any(feature = "cli", feature = "gui"))]
mod table;
#[cfg(any(feature = "cli", feature = "gui"))]
mod verification;

pub(crate) use clean::cleaned;
pub use clean::{clean, clean_note};
pub(crate) use detail::Detail;
pub(crate) use diagnosis::{answer, diagnosis, expected, floor_from, noise, remarks};
pub(crate) use history::history;
#[cfg(feature = "cli")]
pub(crate) use identification::identification;
#[cfg(feature = "gui")]
pub(crate) use identification::{problems_of_data, remarks_on_fit};
#[cfg(any(feature = "cli", feature = "gui"))]
pub(crate) use imported::imported;
pub(crate) use parameters::values;
#[cfg(feature = "cli")]
pub(crate) use plan::plan;
#[cfg(feature = "cli")]
pub(crate) use program::left_as_it_is;
#[cfg(any(feature = "cli", feature = "gui"))]
pub(crate) use program::program;
pub(crate) use section::fact;
pub use section::{Block, Fact, Section, Topic};
pub(crate) use standards::standards;
#[cfg(any(feature = "cli", feature = "gui"))]
pub(crate) use table::{Exported, table};
#[cfg(any(feature = "cli", feature = "gui"))]
pub(crate) use verification::verification;
