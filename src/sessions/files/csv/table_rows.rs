//! The rows of a table while they are read.

use crate::sessions::files::csv::starts::Starts;
use crate::sessions::lines::Lines;
use crate::sessions::table::Cells;

use super::complaints::Complaints;

/// The rows so far.
pub(super) struct Rows<'a> {
    pub(super) columns: Vec<Cells>,
    pub(super) line: Lines,
    pub(super) next_line: u64,
    pub(super) starts: Starts,
    pub(super) complaints: Complaints<'a>,
}
