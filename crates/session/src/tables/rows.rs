//! Rows of a table, one after the other: where their cells are, or what they say.
//!
//! Blank lines, comments and rows of separators only are passed over. Whoever changes a file in place asks
//! [`Rows`] where its cells are, in any encoding with ASCII in it; a reader asks [`TextRows`] for their text.

use std::borrow::Cow;

use crate::progress::ProgressSpan;

use super::cell::{Cell, Quotes};
use super::dialect::{Dialect, trimmed};

/// One row by the places of its cells.
#[derive(Debug, Clone, Default)]
pub struct Row {
    /// Where it starts, counted from 1.
    pub(crate) line: u64,
    /// Its first byte.
    pub start: usize,
    /// How many lines that are not blank begin up to here, this one included.
    pub number: usize,
    /// Without the blanks around them.
    pub cells: Vec<Cell>,
}

/// A quote that nothing closes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OpenQuote {
    pub(crate) line: u64,
    /// Its byte.
    pub at: usize,
}

/// Bytes between two looks at the watcher.
pub(super) const AT_ONCE: usize = 1 << 18;

/// Comments that are kept to be looked at.
const MOST_COMMENTS: usize = 20;

/// Goes through a table row by row.
#[derive(Clone)]
pub struct Rows<'a> {
    bytes: &'a [u8],
    at: usize,
    line: u64,
    number: usize,
    dialect: Dialect,
    /// The last comments that were passed over, by their lines and their bytes without their signs.
    comments: Vec<(u64, usize, usize)>,
    pass: Option<ProgressSpan<'a>>,
    /// Where the watcher is told next.
    tell_at: usize,
}

impl<'a> Rows<'a> {
    /// The rows from this byte on, which is in the first line.
    pub fn new(bytes: &'a [u8], at: usize, dialect: Dialect) -> Self {
        Self {
            bytes,
            at,
            line: 1,
            number: 0,
            dialect,
            comments: Vec::new(),
            pass: None,
            tell_at: usize::MAX,
        }
    }

    /// Tells how far it is; whether it was cancelled.
    fn is_cancelled(&mut self) -> bool {
        self.tell_at = self.at + AT_ONCE;
        let told = self
            .pass
            .map(|pass| pass.counted(self.at, self.bytes.len()));
        told.is_some_and(|told| told.is_err())
    }

    /// Reads the next row into `row`; false at the end. Behind an open quote it goes on where the dialect lets no cell
    /// go over a line end.
    pub fn next(&mut self, row: &mut Row) -> Result<bool, OpenQuote> {
        while self.at < self.bytes.len() {
            if self.at >= self.tell_at && self.is_cancelled() {
                self.at = self.bytes.len();
                return Ok(false);
            }
            if self.pass_over() {
                continue;
            }
            self.number += 1;
            (row.line, row.start, row.number) = (self.line, self.at, self.number);
            row.cells.clear();
            self.take_cells(&mut row.cells)?;
            if self.dialect.keeps_blanks || row.cells.iter().any(|cell| !cell.is_empty(self.bytes))
            {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Goes behind the line that begins here if it is blank or a comment.
    fn pass_over(&mut self) -> bool {
        let rest = &self.bytes[self.at..];
        if self.dialect.keeps_blanks {
            let blank = matches!(rest, [b'\n', ..] | [b'\r', b'\n', ..]);
            if blank {
                self.end_line();
            }
            return blank;
        }
        let is_blank = |byte: &u8| matches!(byte, b' ' | b'\t');
        let first = rest.iter().position(|byte| !is_blank(byte));
        let first = first.map_or(&[][..], |first| &rest[first..]);
        let begins_a_row = first.first().is_some_and(u8::is_ascii_graphic);
        if begins_a_row && self.comment_sign(first).is_none() {
            return false;
        }
        let end = self.dialect.line_end(self.bytes, self.at);
        let plain = trimmed(self.bytes, self.at..end);
        if let Some(sign) = self.comment_sign(&self.bytes[plain.clone()]) {
            let comment = trimmed(self.bytes, plain.start + sign..plain.end);
            if self.comments.len() == MOST_COMMENTS {
                self.comments.remove(0);
            }
            self.comments.push((self.line, comment.start, comment.end));
        } else if !plain.is_empty() {
            return false;
        }
        self.at = end;
        self.end_line();
        true
    }

    /// How long the sign is with which this line is a comment.
    fn comment_sign(&self, line: &[u8]) -> Option<usize> {
        let mut signs = self.dialect.comments.iter();
        let sign = signs.find(|sign| line.starts_with(sign.as_bytes()))?;
        (!is_error(line)).then_some(sign.len())
    }

    /// Reads the cells from here to the line end, and goes behind that.
    fn take_cells(&mut self, cells: &mut Vec<Cell>) -> Result<(), OpenQuote> {
        let (bytes, dialect) = (self.bytes, self.dialect);
        loop {
            let mut cell = Cell::read(bytes, self.at, dialect);
            match cell.quotes {
                Quotes::None if dialect.keeps_blanks => {
                    let returns = bytes[cell.start..cell.end].ends_with(b"\r");
                    cell.end -= usize::from(returns && dialect.ends_line(bytes, cell.stop));
                }
                Quotes::None => cell = cell.trimmed(bytes),
                Quotes::Around | Quotes::Doubled => {
                    self.line += dialect.line_ends(&bytes[cell.start..cell.end]);
                }
                Quotes::Open => {
                    let (line, at) = (self.line, cell.start - 1);
                    self.at = cell.stop;
                    self.end_line();
                    return Err(OpenQuote { line, at });
                }
            }
            self.at = cell.stop;
            let ends = dialect.ends_line(bytes, self.at);
            // Spaces at the end of a line separate nothing.
            if !(ends && dialect.is_of_spaces() && cell.is_empty(bytes)) {
                cells.push(cell);
            }
            if ends {
                self.end_line();
                return Ok(());
            }
            self.at += 1;
        }
    }

    /// Goes behind a line end, if there is one here.
    fn end_line(&mut self) {
        let rest = &self.bytes[self.at..];
        self.at += match rest {
            [b'\r', b'\n', ..] => 2,
            [b'\r' | b'\n', ..] => 1,
            _ => 0,
        };
        self.line += u64::from(!rest.is_empty());
    }
}

/// One row by the text of its cells.
#[derive(Debug, Clone, Default)]
pub(crate) struct TextRow<'a> {
    /// Where it starts, counted from 1.
    pub(crate) line: u64,
    /// Without the blanks around them.
    pub(crate) cells: Vec<Cow<'a, str>>,
    places: Row,
}

impl TextRow<'_> {
    /// The number of cells without the empty ones at the end.
    pub(crate) fn filled(&self) -> usize {
        let last = self.cells.iter().rposition(|cell| !cell.is_empty());
        last.map_or(0, |last| last + 1)
    }

    /// The cells by themselves.
    pub(crate) fn owned(&self) -> Vec<String> {
        self.cells.iter().map(ToString::to_string).collect()
    }
}

/// Goes through the table of a text row by row.
#[derive(Clone)]
pub(crate) struct TextRows<'a> {
    text: &'a str,
    rows: Rows<'a>,
}

/// Whether a line begins with what a spreadsheet writes in place of a number: `#N/A`, `#REF!`, `#NAME?`.
fn is_error(line: &[u8]) -> bool {
    let ends = |byte: &u8| matches!(byte, b',' | b';' | b'\t' | b'\r' | b'\n');
    let word = &line[..line.iter().position(ends).unwrap_or(0)];
    let capitals = |byte: &u8| byte.is_ascii_uppercase() || matches!(byte, b'0' | b'/');
    match word {
        [b'#', word @ .., b'!' | b'?'] => word.len() > 1 && word.iter().all(capitals),
        word => matches!(word, b"#N/A" | b"#NV"),
    }
}

impl<'a> TextRows<'a> {
    pub(crate) fn new(text: &'a str, dialect: Dialect) -> Self {
        let rows = Rows::new(text.as_bytes(), 0, dialect);
        Self { text, rows }
    }

    /// Goes through what is left as the next pass of this part of the work: tells how far it is,
    /// and is at its end where it was cancelled.
    pub(crate) fn in_pass_of(mut self, part: ProgressSpan<'a>) -> Self {
        self.rows.pass = Some(part.next_pass());
        self.rows.tell_at = self.rows.at;
        self
    }

    /// Reads the next row into `row`; false at the end.
    pub(crate) fn next(&mut self, row: &mut TextRow<'a>) -> Result<bool, OpenQuote> {
        let is_there = self.rows.next(&mut row.places)?;
        if is_there {
            row.line = row.places.line;
            row.cells.clear();
            let cells = row.places.cells.iter();
            row.cells.extend(cells.map(|cell| cell.text(self.text)));
        }
        Ok(is_there)
    }

    /// The next rows as they stand.
    pub(crate) fn first(&self, count: usize) -> Vec<Vec<String>> {
        let mut rows = self.clone();
        let mut row = TextRow::default();
        let mut first = Vec::new();
        while first.len() < count && rows.next(&mut row) == Ok(true) {
            first.push(row.owned());
        }
        first
    }

    /// The last comments that were passed over, with their lines and without their signs.
    pub(crate) fn comments(&self) -> Vec<(u64, &'a str)> {
        let comments = self.rows.comments.iter();
        comments
            .map(|(line, start, end)| (*line, &self.text[*start..*end]))
            .collect()
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::super::dialect::Separator;
    use super::*;

    fn read(text: &str, separator: Separator) -> Vec<(u64, Vec<String>)> {
        let mut rows = TextRows::new(text, Dialect::of_instruments(separator));
        let mut row = TextRow::default();
        let mut all = Vec::new();
        while rows.next(&mut row).expect("quotes are closed") {
            let cells = row.cells.iter().map(ToString::to_string).collect();
            all.push((row.line, cells));
        }
        all
    }

    fn rows(expected: &[(u64, &[&str])]) -> Vec<(u64, Vec<String>)> {
        let cells = |cells: &[&str]| cells.iter().map(|&cell| cell.to_owned()).collect();
        expected
            .iter()
            .map(|(line, row)| (*line, cells(row)))
            .collect()
    }

    #[test]
    fn rows_know_their_lines_whatever_ends_them() {
        let expected = rows(&[(1, &["a", "b"]), (3, &["1", ""]), (5, &["2", "3"])]);
        for end in ["\n", "\r\n", "\r"] {
            let text = ["a ; b", "", "1;", ";;", "2;3"].join(end);
            assert_eq!(read(&text, Separator::Semicolon), expected, "{end:?}");
        }
    }

    #[test]
    fn spaces_run_and_quotes_hold_together() {
        let text =
            "# comment\n  P1   1.5\t-2 \n\"P 2\" 3 4\n// more\n\"P\"\"3\" \"5\n6\" 7\n8 9 1\n";
        assert_eq!(
            read(text, Separator::Spaces),
            rows(&[
                (2, &["P1", "1.5", "-2"]),
                (3, &["P 2", "3", "4"]),
                (5, &["P\"3", "5\n6", "7"]),
                (7, &["8", "9", "1"]),
            ])
        );
        assert_eq!(
            read("12\",\"a, b\" ,\n\"x\" y,1,\"\"\n", Separator::Comma),
            rows(&[(1, &["12\"", "a, b", ""]), (2, &["x y", "1", ""])])
        );
    }

    #[test]
    fn an_open_quote_is_found_where_it_opens() {
        let text = format!("a,b\n1,\"{}", "x,\n".repeat(100_000));
        let mut rows = TextRows::new(&text, Dialect::of_instruments(Separator::Comma));
        let mut row = TextRow::default();
        assert_eq!(rows.next(&mut row), Ok(true));
        assert_eq!(rows.next(&mut row), Err(OpenQuote { line: 2, at: 6 }));
    }

    #[test]
    fn where_every_line_is_a_row_an_open_quote_takes_no_other_line_with_it() {
        let text = b"a,b\n# 1,\"x\n2,\"y\n\xb5 3,\"z\"\n";
        let mut rows = Rows::new(text, 0, Dialect::of_lines(Separator::Comma));
        let mut row = Row::default();
        let mut found = Vec::new();
        loop {
            match rows.next(&mut row) {
                Ok(true) => found.push(Ok((row.line, row.number, row.start, row.cells.len()))),
                Ok(false) => break,
                Err(quote) => found.push(Err((quote.line, quote.at))),
            }
        }
        let expected = [
            Ok((1, 1, 0, 2)),
            Err((2, 8)),
            Err((3, 13)),
            Ok((4, 4, 16, 2)),
        ];
        assert_eq!(found, expected);
    }

    proptest! {
        #[test]
        fn any_text_has_rows(text in "[\"ab1 ,;\t\r\n#/é]{0,40}", which in 0..4usize) {
            let mut rows = TextRows::new(&text, Dialect::of_instruments(Separator::ALL[which]));
            let mut row = TextRow::default();
            let mut count = 0;
            while rows.next(&mut row) == Ok(true) {
                count += 1;
                prop_assert!(count <= text.len());
            }
        }
    }
}
