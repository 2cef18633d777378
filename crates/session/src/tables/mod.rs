//! Tables as they lie in files: one reader under sessions, instruments' files and targets of programs.
//!
//! ```text
//! bytes → text (encoding) → what ends cells and lines (dialect) → one cell: where it is, its quotes (cell)
//!       → rows: places or texts (rows) → where the table begins, its header (grid) → columns
//! ```
//!
//! - Samples of a session are comma-separated and may be millions: `samples` puts them into columns in one pass.
//! - Instruments write any dialect: `grid` finds separator and header in a text (`encoding`) and
//!   `decimals` the decimal sign.
//! - Targets are changed in place: [`Rows`] says where their cells are, whatever the encoding.
//!
//! What headings mean is the affair of the reader; so is the sentence about what is wrong, for which there are
//! `complaints`.

mod cell;
mod columns;
mod complaints;
pub(crate) mod decimals;
mod dialect;
#[doc(hidden)]
pub mod encoding;
pub(crate) mod foreign;
mod grid;
mod head;
mod lines;
mod rows;
mod samples;

pub use cell::{Cell, as_cell};
pub(crate) use columns::{CellKind, Cells, Names};
pub(crate) use complaints::{Complaints, more_like_these};
pub use dialect::Separator;
pub use dialect::{Dialect, trimmed};
pub(crate) use grid::{Grid, MOST_COLUMNS, open_quote};
pub(crate) use head::Words;
pub use lines::Lines;
pub use rows::{OpenQuote, Row, Rows};
pub(crate) use rows::{TextRow, TextRows};
pub(crate) use samples::SampleTable;
