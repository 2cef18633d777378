//! An answer, said once for every place where a person reads it: sections of few kinds of blocks, in the language of
//! this thread. Terminal, window and report show blocks and word nothing of an answer themselves; what differs by
//! place is how much is asked for (`Detail`), and what a place adds to a section ([`Topic`]).

mod clean;
mod detail;
mod diagnosis;
mod found;
mod geometry;
mod history;
mod identification;
mod imported;
mod open;
mod parameters;
mod plan;
mod program;
mod section;
mod sight;
pub mod standards;
mod table;
pub mod verification;

pub(crate) use clean::cleaned;
pub use clean::{clean, clean_note};
#[doc(hidden)]
pub use detail::Detail;
#[doc(hidden)]
pub use diagnosis::diagnosis;
pub(crate) use diagnosis::{answer, expected, floor_from, noise, remarks};
#[doc(hidden)]
pub use history::history;
#[doc(hidden)]
pub use identification::identification;
pub(crate) use identification::{problems_of_data, remarks_on_fit};
#[doc(hidden)]
pub use imported::imported;
#[doc(hidden)]
pub use parameters::values;
#[doc(hidden)]
pub use plan::plan;
#[doc(hidden)]
pub use program::left_as_it_is;
#[doc(hidden)]
pub use program::program;
pub(crate) use section::fact;
pub use section::{Block, Fact, Section, Topic};
pub use standards::standards;
#[doc(hidden)]
pub use table::{Exported, table};
pub use verification::verification;
