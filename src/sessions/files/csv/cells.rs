//! One cell, off the hot path: quotes, spaces, text, and everything that is wrong with it.

use crate::text::{Template, Text};
use std::borrow::Cow;

use crate::document::number::{NotANumber, any_decimal, quoted};
use crate::sessions::files::csv::Complaints;
use crate::sessions::table::Cells;

/// What ends a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Stop {
    Comma,
    Line,
}

/// A cell and what stands after it.
pub(crate) struct Cell<'a> {
    /// Without its quotes.
    content: Cow<'a, [u8]>,
    /// Quoted cells are taken as they are; others may have spaces around them.
    in_quotes: bool,
    /// Something stands between the closing quote and the end of the cell.
    after_quote: bool,
    /// The quote never closes.
    pub(crate) unclosed: bool,
    /// Where the next cell or row starts.
    pub(crate) after: usize,
    pub(crate) stop: Stop,
    /// Line feeds inside the quotes.
    pub(crate) line_feeds: u64,
}

impl<'a> Cell<'a> {
    /// Reads the cell from `at`; `bytes[..end]` ends with a line feed.
    pub(crate) fn read(bytes: &'a [u8], at: usize, end: usize) -> Self {
        let bytes = &bytes[..end];
        let rest = bytes.get(at..).unwrap_or_default();
        let spaces = rest.iter().take_while(|&&byte| byte == b' ').count();
        if rest.get(spaces) == Some(&b'"') {
            return Self::read_quoted(bytes, at + spaces + 1);
        }
        let (length, stop) = to_the_end(rest);
        let content = &rest[..length];
        let content = match stop {
            Stop::Line => content.strip_suffix(b"\r").unwrap_or(content),
            Stop::Comma => content,
        };
        Self {
            content: Cow::Borrowed(content),
            in_quotes: false,
            after_quote: false,
            unclosed: false,
            after: (at + length + 1).min(end),
            stop,
            line_feeds: 0,
        }
    }

    /// Reads a quoted cell whose content starts at `at`.
    fn read_quoted(bytes: &'a [u8], mut at: usize) -> Self {
        let start = at;
        let mut unescaped: Option<Vec<u8>> = None;
        let mut part = at;
        let content_end = loop {
            let Some(quote) = memchr::memchr(b'"', &bytes[at..]).map(|offset| at + offset) else {
                return Self {
                    content: Cow::Borrowed(&bytes[start..]),
                    in_quotes: true,
                    after_quote: false,
                    unclosed: true,
                    after: bytes.len(),
                    stop: Stop::Line,
                    line_feeds: 0,
                };
            };
            if bytes.get(quote + 1) != Some(&b'"') {
                break quote;
            }
            unescaped
                .get_or_insert_default()
                .extend_from_slice(&bytes[part..=quote]);
            at = quote + 2;
            part = at;
        };
        let content = match unescaped {
            None => Cow::Borrowed(&bytes[start..content_end]),
            Some(mut content) => {
                content.extend_from_slice(&bytes[part..content_end]);
                Cow::Owned(content)
            }
        };
        let rest = &bytes[content_end + 1..];
        let (length, stop) = to_the_end(rest);
        Self {
            line_feeds: memchr::memchr_iter(b'\n', &bytes[start..content_end]).count() as u64,
            content,
            in_quotes: true,
            after_quote: !rest[..length].trim_ascii().is_empty(),
            unclosed: false,
            after: (content_end + 1 + length + 1).min(bytes.len()),
            stop,
        }
    }

    /// The cell as text, or what to say about it.
    pub(crate) fn text(&self) -> Result<&str, (Text, Template)> {
        if self.unclosed {
            return Err((
                text!("a quote that is not closed"),
                phrase!("a closing quote"),
            ));
        }
        if self.after_quote {
            let found = text!("something after the closing quote");
            return Err((found, phrase!("a comma or the end of the line")));
        }
        if self.content.contains(&0) {
            return Err((text!("a NUL byte"), phrase!("text; this is a binary file")));
        }
        match std::str::from_utf8(&self.content) {
            Ok(text) => Ok(text),
            Err(_) => Err((
                text!(
                    "bytes that are not UTF-8: {content}",
                    content = quoted(&String::from_utf8_lossy(&self.content))
                ),
                phrase!("UTF-8 text; another encoding is read by `truepose import`"),
            )),
        }
    }

    /// The text without the spaces around it; those in quotes belong to it.
    fn plain<'t>(&self, text: &'t str) -> &'t str {
        if self.in_quotes { text } else { trimmed(text) }
    }

    /// Appends the cell to its column of names or text; false, and nothing done, if there is
    /// anything to say about it.
    pub(crate) fn store_text(&self, column: &mut Cells) -> bool {
        let Ok(text) = self.text() else { return false };
        match column {
            Cells::Text(cells) => cells.push(text.to_owned()),
            Cells::Names(names) => names.push(self.plain(text)),
            Cells::Numbers(_) => return false,
        }
        true
    }

    /// Appends the cell to its column.
    pub(crate) fn store(
        &self,
        column: &mut Cells,
        complaints: &mut Complaints<'_>,
        line: u64,
        index: usize,
    ) {
        let text = match self.text() {
            Ok(text) => text,
            Err((found, expected)) => {
                complaints.hopeless |= self.content.contains(&0);
                complaints.about_cell(line, index, found, expected);
                column.push_missing();
                return;
            }
        };
        let plain = self.plain(text);
        match column {
            Cells::Text(cells) => cells.push(text.to_owned()),
            Cells::Names(names) => names.push(plain),
            Cells::Numbers(values) if plain.is_empty() => values.push(f64::NAN),
            Cells::Numbers(values) => match any_decimal(plain) {
                Ok(value) => values.push(value),
                Err(problem) => {
                    values.push(f64::NAN);
                    let expected = match problem {
                        NotANumber::NotFinite => {
                            text!("a finite number; a missing value is an empty cell")
                        }
                        NotANumber::Overflow => {
                            text!("a number that a double can hold (below 1.8e308)")
                        }
                        NotANumber::DecimalComma => {
                            text!(
                                "a decimal point; decimal commas are read by `truepose import --decimal ,`"
                            )
                        }
                        NotANumber::Garbage => text!("a number"),
                    };
                    complaints.about_cell(line, index, Text::verbatim(quoted(plain)), expected);
                }
            },
        }
    }
}

/// A cell without quotes may have spaces around it.
pub(crate) fn trimmed(cell: &str) -> &str {
    cell.trim_matches([' ', '\t'])
}

/// Length of a cell without quotes and what ends it.
fn to_the_end(rest: &[u8]) -> (usize, Stop) {
    match memchr::memchr2(b',', b'\n', rest) {
        Some(at) if rest[at] == b',' => (at, Stop::Comma),
        Some(at) => (at, Stop::Line),
        None => (rest.len(), Stop::Line),
    }
}

/// Where the line after this one starts and how many cells are left in this one.
pub(crate) fn skip_line(bytes: &[u8], mut at: usize, end: usize) -> (usize, usize) {
    let mut cells = 0;
    loop {
        let cell = Cell::read(bytes, at, end);
        cells += 1;
        at = cell.after;
        if cell.stop == Stop::Line {
            return (at, cells);
        }
    }
}
