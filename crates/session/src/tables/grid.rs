//! Finds the table in a text: the separator, the lines before it, the header, and the decimal sign.
//!
//! The separator is the one that cuts most of the first lines into the same number of cells of which
//! most are numbers. The table starts with the first such line; the header is the last line before
//! it that has as many cells and no numbers. A line of units below the header belongs to it.

use crate::diagnostic::{Diagnostic, Place};
use crate::document::number::quoted;
use crate::progress::ProgressSpan;

use super::complaints::Complaints;
use super::decimals::Votes;
use super::dialect::{Dialect, Separator};
use super::head::{
    Head, LOOKED_AT, Words, header_in_comments, numbers_in, rows_below_header, take_header,
    with_unit_in_cell, with_units_in_comments,
};
use super::rows::{OpenQuote, TextRow, TextRows};

/// Columns that a table may have.
pub(crate) const MOST_COLUMNS: usize = 1024;
/// Lines before the table that are kept, the last ones.
const SHOWN: usize = 20;

/// A table that was found in a text.
#[derive(Clone)]
pub(crate) struct Grid<'a> {
    pub(crate) separator: Separator,
    /// Lines before the table, but for the header.
    pub(crate) preamble: Vec<Vec<String>>,
    /// Comments before the table, without their signs.
    pub(crate) comments: Vec<String>,
    /// Headings and their line, if there are any; a line of units is already joined in.
    pub(crate) header: Option<(u64, Vec<String>)>,
    /// What a comment says above a header.
    pub(crate) said_before: Option<Vec<String>>,
    /// Number of cells in a row.
    pub(crate) width: usize,
    /// Stands before the first row.
    body: TextRows<'a>,
    /// The work that going through all rows belongs to.
    part: Option<ProgressSpan<'a>>,
}

/// The complaint about an open quote.
pub(crate) fn open_quote(file: &Place, quote: OpenQuote) -> Diagnostic {
    let place = file.clone().at_line(quote.line);
    let found = text!("a quote that is not closed");
    Diagnostic::error(place, found, text!("a closing quote"))
}

impl<'a> Grid<'a> {
    /// Finds the table.
    pub(crate) fn find(
        text: &'a str,
        separator: Option<Separator>,
        header: Option<u64>,
        words: &Words,
        file: &Place,
    ) -> Result<Self, Box<Diagnostic>> {
        let candidates = match separator {
            Some(separator) => vec![separator],
            None => Separator::ALL.to_vec(),
        };
        let mut best: Option<(f64, Separator, usize, usize)> = None;
        let mut quote = None;
        for separator in candidates {
            let head = Head::read(text, separator);
            quote = quote.or(head.open_quote);
            if let Some((quality, width, numbers)) = head.quality()
                && best.is_none_or(|(other, ..)| quality > other)
            {
                best = Some((quality, separator, width, numbers));
            }
        }
        // A single column has no separator; a tabulator cuts nothing that may be in it.
        let single = || Head::read(text, Separator::Tab).is_single();
        if best.is_none() && separator.is_none() && quote.is_none() && single() {
            best = Some((0.0, Separator::Tab, 1, 1));
        }
        let Some((_, separator, width, numbers)) = best else {
            if let Some(quote) = quote {
                return Err(Box::new(open_quote(file, quote)));
            }
            let is_comment =
                |line: &str| line.starts_with('#') && line.contains(|c: char| c.is_ascii_digit());
            let with_unit = with_unit_in_cell(text, words);
            let found = if let Some(cell) = with_unit {
                text!(
                    "no table: numbers with their units in the cells, such as {cell}",
                    cell = quoted(cell)
                )
            } else if text.lines().any(is_comment) {
                text!(
                    "no table: lines that begin with # are comments, and no other is one of cells of which one is a number"
                )
            } else {
                text!("no table: no line of cells of which one is a number")
            };
            let expected = match with_unit {
                Some(_) => text!("numbers alone, and the units in the headings"),
                None => text!("rows of cells between tabs, semicolons, commas or spaces"),
            };
            return Err(Box::new(Diagnostic::error(file.clone(), found, expected)));
        };
        if width > MOST_COLUMNS {
            let found = text!(one "{count} column", "{count} columns", count = width);
            let expected = text!("a table of at most {most} columns", most = MOST_COLUMNS);
            return Err(Box::new(Diagnostic::error(file.clone(), found, expected)));
        }
        let found = Self::with(text, separator, (width, numbers), words)
            .map_err(|quote| Box::new(open_quote(file, quote)))?;
        match header {
            None => Ok(found),
            Some(0) => Ok(Self {
                header: None,
                ..found
            }),
            Some(line) => found.below(text, line, file),
        }
    }

    /// The same table with its header in this line, and everything below it as rows.
    fn below(self, text: &'a str, line: u64, file: &Place) -> Result<Self, Box<Diagnostic>> {
        let mut rows = TextRows::new(text, Dialect::of_instruments(self.separator));
        let mut row = TextRow::default();
        let mut before: Vec<Vec<String>> = Vec::new();
        loop {
            match rows.next(&mut row) {
                Ok(true) if row.line < line => {
                    before.push(row.owned());
                    if before.len() > 2 * SHOWN {
                        before.drain(..SHOWN);
                    }
                }
                Ok(true) if row.line == line => break,
                Ok(_) => {
                    let place = file.clone().at_line(line);
                    let found = text!("no line of cells to be the header");
                    let expected = text!("the number of a line that is not blank and no comment");
                    return Err(Box::new(Diagnostic::error(place, found, expected)));
                }
                Err(quote) => return Err(Box::new(open_quote(file, quote))),
            }
        }
        before.drain(..before.len().saturating_sub(SHOWN));
        let mut names: Vec<String> = row.owned();
        names.resize(names.len().max(self.width), String::new());
        Ok(Self {
            preamble: before,
            header: Some((line, names)),
            body: rows,
            ..self
        })
    }

    /// Finds the start of a table with so many cells in a row and so many numbers among them.
    fn with(
        text: &'a str,
        separator: Separator,
        (width, numbers): (usize, usize),
        words: &Words,
    ) -> Result<Self, OpenQuote> {
        let enough = numbers.div_ceil(2).max(1);
        let mut rows = TextRows::new(text, Dialect::of_instruments(separator));
        let mut row = TextRow::default();
        let mut before: Vec<(u64, Vec<String>)> = Vec::new();
        // Where lines before the table start, which may be rows that lack values.
        let mut starts: Vec<TextRows<'a>> = Vec::new();
        let mut body = loop {
            let start = rows.clone();
            if !rows.next(&mut row)? {
                break start;
            }
            if row.cells.len() == width && numbers_in(&row) >= enough {
                break start;
            }
            before.push((row.line, row.owned()));
            starts.push(start);
            // Only the last lines can be a header.
            if before.len() > LOOKED_AT {
                before.drain(..LOOKED_AT / 2);
                starts.drain(..LOOKED_AT / 2);
            }
        };
        if let Some(first) = rows_below_header(&before, width, words) {
            before.truncate(first);
            body = starts.swap_remove(first);
        }
        let comments = rows.comments();
        let commented = header_in_comments(&comments, separator, &row, words);
        let (header, said_before) = match take_header(&mut before, width, words) {
            Some(header) => (Some(header), commented.map(|(_, cells)| cells)),
            None => (commented, None),
        };
        let header =
            header.map(|header| with_units_in_comments(header, &comments, separator, words));
        before.drain(..before.len().saturating_sub(SHOWN));
        Ok(Self {
            separator,
            preamble: before.into_iter().map(|(_, cells)| cells).collect(),
            comments: comments
                .iter()
                .map(|(_, comment)| (*comment).to_owned())
                .collect(),
            header,
            said_before,
            width,
            body,
            part: None,
        })
    }

    /// Its headings; none without a header.
    pub(crate) fn headings(&self) -> &[String] {
        self.header.as_ref().map_or(&[], |(_, names)| names)
    }

    /// Going through all rows is told as a pass of this part of the work.
    pub(crate) fn watched(self, part: ProgressSpan<'a>) -> Self {
        let part = Some(part);
        Self { part, ..self }
    }

    /// Goes through the rows; `each` gets the row, already checked for its width. Rows that are too
    /// long or too short are complained about, and passed over.
    pub(crate) fn each_row(
        &self,
        file: &Place,
        complaints: &mut Complaints,
        mut each: impl FnMut(&TextRow<'a>, &mut Complaints),
    ) {
        let mut rows = self.body.clone();
        if let Some(part) = self.part {
            rows = rows.in_pass_of(part);
        }
        let mut row = TextRow::default();
        loop {
            match rows.next(&mut row) {
                Ok(true) => {}
                Ok(false) => return,
                Err(quote) => {
                    complaints.findings.push(open_quote(file, quote));
                    return;
                }
            }
            // Cells that a program puts behind the last one are empty.
            if row.cells.len() >= self.width && row.filled() <= self.width {
                each(&row, complaints);
            } else {
                let found = match row.cells.len() {
                    1 => text!("1 cell, {cells}", cells = quoted(&row.cells[0])),
                    count => text!(one "{count} cell", "{count} cells", count),
                };
                let expected = text!(
                    "{width} between {separator}, as in the rows before",
                    width = self.width,
                    separator = self.separator.name()
                );
                complaints
                    .add(|| Diagnostic::error(file.clone().at_line(row.line), found, expected));
            }
        }
    }

    /// The first rows as they stand.
    pub(crate) fn first_rows(&self, count: usize) -> Vec<Vec<String>> {
        self.body.first(count)
    }

    /// What the cells of the number columns say about the decimal sign.
    pub(crate) fn votes(&self, is_number: &dyn Fn(usize) -> bool, file: &Place) -> Votes {
        let mut votes = Votes::default();
        // What is wrong with rows is said when they are read.
        self.each_row(file, &mut Complaints::default(), |row, _| {
            for (index, cell) in row.cells.iter().take(self.width).enumerate() {
                if is_number(index) && cell.bytes().any(|byte| byte == b',' || byte == b'.') {
                    votes.add(cell, row.line, index + 1);
                }
            }
        });
        votes
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const WORDS: Words = Words {
        is_heading: |cell| matches!(cell.split('[').next(), Some("name" | "x" | "y" | "z")),
        is_unit: |cell| matches!(cell, "mm" | "m" | "in"),
    };

    fn find(text: &str) -> Grid<'_> {
        Grid::find(text, None, None, &WORDS, &Place::default()).expect("there is a table")
    }

    fn header(text: &str) -> String {
        find(text).header.expect("there is a header").1.join("|")
    }

    #[test]
    fn the_separator_is_the_one_that_makes_a_table() {
        for (text, separator, width) in [
            ("a;b;c\n1,5;2,5;3,5\n1;2;3\n", Separator::Semicolon, 3),
            ("a,b,c\n1.5,2.5,3.5\n", Separator::Comma, 3),
            (
                "P1, 1.0, 2.0, 3.0\nP2, 1.0, 2.0, 3.0\n",
                Separator::Comma,
                4,
            ),
            ("P1\t1,5\t2,5\t3,5\n", Separator::Tab, 4),
            ("P1  1,5  2,5  3,5\nP2 1 2 3\n", Separator::Spaces, 4),
            ("P 1,1.0,2.0,3.0\n", Separator::Comma, 4),
            ("P1 1,234 5,678 9,012\n", Separator::Spaces, 4),
            ("x y; z\n1 2\n3 4\n5 6\n", Separator::Spaces, 2),
        ] {
            let grid = find(text);
            assert_eq!((grid.separator, grid.width), (separator, width), "{text}");
        }
    }

    #[test]
    fn the_header_is_found_behind_a_preamble() {
        let preamble = "Report;12\nDate;2024-05-01\nOperator;A. B.\n\n";
        assert_eq!(header(&format!("{preamble}n;x;y;z\nP1;1;2;3\n")), "n|x|y|z");
        assert_eq!(
            header(&format!("{preamble}n;x;y;z\n;mm;[mm];mm\nP1;1;2;3\n")),
            "n|x [mm]|y [mm]|z [mm]"
        );
        assert_eq!(header("# name x y z\nP1 1 2 3\nP2 1 2 3\n"), "name|x|y|z");
        assert_eq!(header("#a, x, y, z\n1 2 3 4\n"), "a|x|y|z");
        assert_eq!(header("// x, y, z\nP1 1 2 3\nP2 1 2 3\n"), "name|x|y|z");
        assert_eq!(header("# x [mm] y [m]\n1 2\n"), "x[mm]|y[m]");
        assert_eq!(header("x,y\n# mm, m\n1,2\n"), "x [mm]|y [m]");
        assert_eq!(header("n,x,y,z,\nP1,1,2,3,\n"), "n|x|y|z|");
        let grid = find("# made by hand\nP1 1 2 3\n");
        assert_eq!(grid.header, None);
    }

    #[test]
    fn a_text_without_a_table_is_no_table() {
        for text in ["hello\nworld\n", "1\nx\ny\n", "a,b\nc,d\n", "1,\"2\n"] {
            assert!(
                Grid::find(text, None, None, &WORDS, &Place::default()).is_err(),
                "{text}"
            );
        }
    }

    #[test]
    fn rows_of_another_width_are_named() {
        let grid = find("x,y\n1,2\n3,4,,\n5\n6,7,8\n9,1\n");
        let mut complaints = Complaints::default();
        let mut rows = 0;
        grid.each_row(&Place::default(), &mut complaints, |_, _| rows += 1);
        assert_eq!(rows, 3);
        let lines: Vec<_> = complaints.findings.iter().map(|d| d.place.line).collect();
        assert_eq!(lines, [Some(4), Some(5)]);
    }
}
