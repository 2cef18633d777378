//! Rows and cells of a text, for any separator.
//!
//! Lines end with LF, CRLF or CR. Blank lines and comments (`#`, `//`, `%`, `!`, and `;` where it
//! separates nothing) are passed over. A cell that starts with a quote goes to the closing one, over
//! line ends if need be, and `""` in it is a quote; a quote anywhere else is a character, because an
//! inch is written so.

use crate::text::Template;
use std::borrow::Cow;
use std::fmt;

use crate::progress::ProgressSpan;

/// What stands between two cells.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Separator {
    /// A tabulator.
    Tab,
    /// ;
    Semicolon,
    /// ,
    Comma,
    /// One or more spaces or tabulators.
    Spaces,
}

impl Separator {
    /// All of them; the earlier one is taken where two fit alike.
    pub const ALL: [Self; 4] = [Self::Tab, Self::Semicolon, Self::Comma, Self::Spaces];

    fn is(self, c: char) -> bool {
        match self {
            Self::Tab => c == '\t',
            Self::Semicolon => c == ';',
            Self::Comma => c == ',',
            Self::Spaces => c == ' ' || c == '\t',
        }
    }
}

impl Separator {
    /// What it is called.
    pub fn name(self) -> Template {
        match self {
            Self::Tab => phrase!("tabs"),
            Self::Semicolon => phrase!("semicolons"),
            Self::Comma => phrase!("commas"),
            Self::Spaces => phrase!("spaces"),
        }
    }
}

impl fmt::Display for Separator {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(&self.name(), f)
    }
}

/// One row; its cells without the spaces around them.
#[derive(Debug, Clone, Default)]
pub(crate) struct Row<'a> {
    /// Where it starts, counted from 1.
    pub(crate) line: u64,
    pub(crate) cells: Vec<Cow<'a, str>>,
}

impl Row<'_> {
    /// The number of cells without the empty ones at the end.
    pub(crate) fn filled(&self) -> usize {
        let last = self.cells.iter().rposition(|cell| !cell.is_empty());
        last.map_or(0, |last| last + 1)
    }
}

/// A quote that nothing closes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct OpenQuote {
    pub(crate) line: u64,
}

/// Bytes between two looks at the watcher.
const AT_ONCE: usize = 1 << 18;

/// A quoted cell is no longer than this: an open quote must not swallow the file.
const LONGEST_QUOTE: usize = 1 << 16;

/// Goes through a text row by row.
#[derive(Clone)]
pub(crate) struct Rows<'a> {
    text: &'a str,
    at: usize,
    line: u64,
    separator: Separator,
    /// The last comment that was passed over, without its sign.
    pub(crate) comment: Option<(u64, &'a str)>,
    pass: Option<ProgressSpan<'a>>,
    /// Where the watcher is told next.
    tell_at: usize,
}

impl<'a> Rows<'a> {
    pub(crate) fn new(text: &'a str, separator: Separator) -> Self {
        Self {
            text,
            at: 0,
            line: 1,
            separator,
            comment: None,
            pass: None,
            tell_at: usize::MAX,
        }
    }

    /// Goes through what is left as the next pass of this part of the work: tells how far it is,
    /// and is at its end where it was cancelled.
    pub(crate) fn in_pass_of(mut self, part: ProgressSpan<'a>) -> Self {
        self.pass = Some(part.next_pass());
        self.tell_at = self.at;
        self
    }

    /// Tells how far it is; whether it was cancelled.
    fn is_cancelled(&mut self) -> bool {
        self.tell_at = self.at + AT_ONCE;
        let told = self.pass.map(|pass| pass.counted(self.at, self.text.len()));
        told.is_some_and(|told| told.is_err())
    }

    /// Reads the next row into `row`; false at the end.
    pub(crate) fn next(&mut self, row: &mut Row<'a>) -> Result<bool, OpenQuote> {
        while self.at < self.text.len() {
            if self.at >= self.tell_at && self.is_cancelled() {
                self.at = self.text.len();
                return Ok(false);
            }
            let rest = &self.text[self.at..];
            let line = &rest[..line_end(rest)];
            let plain = line.trim();
            if let Some(comment) = self.comment_in(plain) {
                self.comment = Some((self.line, comment));
                self.skip(line);
                continue;
            }
            if plain.is_empty() {
                self.skip(line);
                continue;
            }
            row.line = self.line;
            row.cells.clear();
            if line.contains('"') {
                self.quoted(row)?;
            } else {
                self.split(line, row);
                self.skip(line);
            }
            // A row of separators only is as blank as a blank line.
            if row.cells.iter().any(|cell| !cell.is_empty()) {
                return Ok(true);
            }
        }
        Ok(false)
    }

    fn comment_in(&self, line: &'a str) -> Option<&'a str> {
        let signs: &[&str] = match self.separator {
            Separator::Semicolon => &["#", "//", "%", "!"],
            _ => &["#", "//", "%", "!", ";"],
        };
        let sign = signs.iter().find(|sign| line.starts_with(**sign))?;
        Some(line[sign.len()..].trim())
    }

    /// Goes behind a line without quotes and its end.
    fn skip(&mut self, line: &str) {
        self.at += line.len();
        self.end_line();
    }

    /// Goes behind a line end, if there is one here.
    fn end_line(&mut self) {
        let rest = &self.text.as_bytes()[self.at..];
        self.at += match rest {
            [b'\r', b'\n', ..] => 2,
            [b'\r' | b'\n', ..] => 1,
            _ => 0,
        };
        self.line += u64::from(!rest.is_empty());
    }

    fn split(&self, line: &'a str, row: &mut Row<'a>) {
        let cells = &mut row.cells;
        match self.separator {
            Separator::Spaces => {
                let words = line.split([' ', '\t']).filter(|cell| !cell.is_empty());
                cells.extend(words.map(Cow::Borrowed));
            }
            Separator::Tab => cells.extend(line.split('\t').map(|c| Cow::Borrowed(c.trim()))),
            Separator::Semicolon => {
                cells.extend(line.split(';').map(|c| Cow::Borrowed(c.trim())));
            }
            Separator::Comma => cells.extend(line.split(',').map(|c| Cow::Borrowed(c.trim()))),
        }
    }

    /// Reads a row cell by cell and goes behind its end.
    fn quoted(&mut self, row: &mut Row<'a>) -> Result<(), OpenQuote> {
        let separator = self.separator;
        loop {
            let rest = &self.text[self.at..];
            let indented = |c: char| c == ' ' || separator == Separator::Spaces && c == '\t';
            let start = rest.len() - rest.trim_start_matches(indented).len();
            let cell = if rest[start..].starts_with('"') {
                self.at += start + 1;
                self.within_quotes()?
            } else {
                let end = self.before_separator();
                Cow::Borrowed(end.trim())
            };
            let rest = &self.text[self.at..];
            let ends = rest.is_empty() || rest.starts_with(['\r', '\n']);
            // Spaces at the end of a line separate nothing.
            if !(separator == Separator::Spaces && ends && cell.is_empty()) {
                row.cells.push(cell);
            }
            if ends {
                self.end_line();
                return Ok(());
            }
            // The separator: one byte, for spaces the first of the run.
            self.at += 1;
        }
    }

    /// Goes to the next separator or line end and gives what stands before it.
    fn before_separator(&mut self) -> &'a str {
        let rest = &self.text[self.at..];
        let rest = match self.separator {
            Separator::Spaces => {
                let words = rest.trim_start_matches([' ', '\t']);
                self.at += rest.len() - words.len();
                words
            }
            _ => rest,
        };
        let stop = |c: char| c == '\n' || c == '\r' || self.separator.is(c);
        let end = rest.find(stop).unwrap_or(rest.len());
        self.at += end;
        &rest[..end]
    }

    /// Goes behind the closing quote and to the next separator.
    fn within_quotes(&mut self) -> Result<Cow<'a, str>, OpenQuote> {
        let start = self.at;
        let line = self.line;
        let mut text = Cow::Borrowed("");
        loop {
            let rest = &self.text[self.at..];
            let Some(length) = rest.find('"').filter(|_| self.at - start < LONGEST_QUOTE) else {
                return Err(OpenQuote { line });
            };
            let part = &rest[..length];
            self.line += line_ends(part);
            self.at += length + 1;
            add(&mut text, part);
            if self.text[self.at..].starts_with('"') {
                add(&mut text, "\"");
                self.at += 1;
            } else {
                break;
            }
        }
        let rest = &self.text[self.at..];
        let stop = |c: char| c == '\n' || c == '\r' || self.separator.is(c);
        let end = rest.find(stop).unwrap_or(rest.len());
        self.at += end;
        add(&mut text, rest[..end].trim_end());
        Ok(text)
    }
}

fn add<'a>(text: &mut Cow<'a, str>, part: &'a str) {
    if text.is_empty() {
        *text = Cow::Borrowed(part);
    } else if !part.is_empty() {
        text.to_mut().push_str(part);
    }
}

fn line_end(text: &str) -> usize {
    memchr::memchr2(b'\n', b'\r', text.as_bytes()).unwrap_or(text.len())
}

/// Line ends in a quoted text; CRLF is one.
fn line_ends(text: &str) -> u64 {
    let bytes = text.as_bytes();
    let ends = memchr::memchr2_iter(b'\n', b'\r', bytes)
        .filter(|&at| bytes[at] == b'\n' || bytes.get(at + 1) != Some(&b'\n'));
    ends.count() as u64
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn read(text: &str, separator: Separator) -> Vec<(u64, Vec<String>)> {
        let mut rows = Rows::new(text, separator);
        let mut row = Row::default();
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
        let mut rows = Rows::new(&text, Separator::Comma);
        let mut row = Row::default();
        assert_eq!(rows.next(&mut row), Ok(true));
        assert_eq!(rows.next(&mut row), Err(OpenQuote { line: 2 }));
    }

    proptest! {
        #[test]
        fn any_text_has_rows(text in "[\"ab1 ,;\t\r\n#/é]{0,40}", which in 0..4usize) {
            let mut rows = Rows::new(&text, Separator::ALL[which]);
            let mut row = Row::default();
            let mut count = 0;
            while rows.next(&mut row) == Ok(true) {
                count += 1;
                prop_assert!(count <= text.len());
            }
        }
    }
}
