//! The rows of a table while they are read, and what is wrong with their cells.

use crate::diagnostic::{Diagnostic, Place};
use crate::tables::columns::Cells;
use crate::tables::complaints::Complaints;
use crate::tables::lines::Lines;
use crate::text::Text;

/// The rows so far.
pub(super) struct Rows<'a> {
    pub(super) columns: Vec<Cells>,
    pub(super) line: Lines,
    pub(super) next_line: u64,
    pub(super) complaints: CellComplaints<'a>,
}

/// Complaints that are worth printing; the rest is counted.
pub(super) const MOST_COMPLAINTS: usize = 50;

/// Problems in cells, with their places.
pub(super) struct CellComplaints<'a> {
    file: &'a Place,
    names: &'a [String],
    all: Complaints,
    /// Binary: there is no point in going on.
    pub(super) hopeless: bool,
}

impl<'a> CellComplaints<'a> {
    pub(super) fn new(file: &'a Place, names: &'a [String]) -> Self {
        Self {
            file,
            names,
            all: Complaints::of_at_most(MOST_COMPLAINTS),
            hopeless: false,
        }
    }

    #[cold]
    pub(super) fn about_cell(
        &mut self,
        line: u64,
        index: usize,
        found: impl Into<Text>,
        expected: impl Into<Text>,
    ) {
        let place = self.place(line, index + 1);
        let place = place.in_field(self.names[index].as_str());
        self.all.add(|| Diagnostic::error(place, found, expected));
    }

    #[cold]
    pub(super) fn too_few_cells(&mut self, line: u64, cells: usize, headings: usize) {
        let (found, expected) = (counted(cells), one_each(headings));
        let place = self.place(line, cells);
        self.all.add(|| Diagnostic::error(place, found, expected));
    }

    #[cold]
    pub(super) fn too_many_cells(&mut self, line: u64, cells: usize, headings: usize) {
        let found = counted(cells);
        let expected = text!(
            "{first}; {next}",
            first = one_each(headings),
            next =
                text!("a decimal point; decimal commas are read by `truepose import --decimal ,`")
        );
        let place = self.place(line, headings + 1);
        self.all.add(|| Diagnostic::error(place, found, expected));
    }

    fn place(&self, line: u64, column: usize) -> Place {
        self.file.clone().at_line(line).at_column(column as u64)
    }

    pub(super) fn into(self, findings: &mut Vec<Diagnostic>) {
        self.all.into(self.file, findings);
    }
}

fn counted(cells: usize) -> Text {
    text!(one "{count} cell", "{count} cells", count = cells)
}

fn one_each(headings: usize) -> Text {
    text!(
        one "{count} cell, one for each heading",
        "{count} cells, one for each heading",
        count = headings
    )
}
