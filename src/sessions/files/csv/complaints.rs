//! What is wrong with the cells of a file, the first of each kind of it.

use crate::diagnostic::{Diagnostic, Place};
use crate::text::Text;

/// Complaints that are worth printing; the rest is counted.
pub(super) const MOST_COMPLAINTS: usize = 50;

/// Problems in cells, with their places; the first ones in full, the rest as a number.
pub(crate) struct Complaints<'a> {
    pub(super) file: &'a Place,
    pub(super) names: &'a [String],
    pub(super) list: Vec<Diagnostic>,
    more: u64,
    /// Binary: there is no point in going on.
    pub(super) hopeless: bool,
}

impl<'a> Complaints<'a> {
    pub(super) fn new(file: &'a Place, names: &'a [String]) -> Self {
        Self {
            file,
            names,
            list: Vec::new(),
            more: 0,
            hopeless: false,
        }
    }

    #[cold]
    pub(super) fn add(&mut self, place: Place, found: impl Into<Text>, expected: impl Into<Text>) {
        if self.list.len() < MOST_COMPLAINTS {
            self.list.push(Diagnostic::error(place, found, expected));
        } else {
            self.more += 1;
        }
    }

    #[cold]
    pub(crate) fn about_cell(
        &mut self,
        line: u64,
        index: usize,
        found: impl Into<Text>,
        expected: impl Into<Text>,
    ) {
        let place = self.file.clone().at_line(line).at_column(index as u64 + 1);
        self.add(place.in_field(self.names[index].as_str()), found, expected);
    }

    #[cold]
    pub(super) fn too_few_cells(&mut self, line: u64, cells: usize, headings: usize) {
        let place = self.file.clone().at_line(line).at_column(cells as u64);
        self.add(
            place,
            text!(
                one "the line ends after {count} cell",
                "the line ends after {count} cells",
                count = cells
            ),
            text!(
                one "{count} cell, one for each heading",
                "{count} cells, one for each heading",
                count = headings
            ),
        );
    }

    #[cold]
    pub(super) fn too_many_cells(&mut self, line: u64, cells: usize, headings: usize) {
        let place = self
            .file
            .clone()
            .at_line(line)
            .at_column(headings as u64 + 1);
        self.add(
            place,
            text!(one "{count} cell", "{count} cells", count = cells),
            text!(
                one "{count} cell, one for each heading; a file with decimal commas is read by \
                 `truepose import --decimal ,`",
                "{count} cells, one for each heading; a file with decimal commas is read by \
                 `truepose import --decimal ,`",
                count = headings
            ),
        );
    }

    pub(super) fn into(self, findings: &mut Vec<Diagnostic>) {
        findings.extend(self.list);
        if self.more > 0 {
            findings.push(Diagnostic::error(
                self.file.clone(),
                text!(one "{count} more problem of this kind", "{count} more problems of this kind", count = self.more),
                Text::default(),
            ));
        }
    }
}
