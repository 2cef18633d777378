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
#[doc(hidden)]
pub mod standards;
mod table;
#[doc(hidden)]
pub mod verification;

pub(crate) use clean::cleaned;
pub use clean::{clean, clean_note};
pub use detail::Detail;
pub(crate) use diagnosis::{answer, expected, floor_from, noise, remarks};
pub use diagnosis::{diagnosis, found_effect};
pub use history::history;
pub use identification::{corrections, identification};
pub use identification::{problems_of_data, remarks_on_fit};
pub use imported::imported;
pub use parameters::values;
pub use plan::plan;
pub use program::left_as_they_are;
pub use program::program;
pub(crate) use section::fact;
pub use section::{Block, Fact, Section, Topic};
pub use standards::standards;
pub(crate) use table::not_correctable;
pub use table::{Exported, table};
pub use verification::verification;
