//! One cell, off the hot path: quotes, spaces, text, and everything that is wrong with it.

use std::borrow::Cow;

use crate::document::number::{NotANumber, any_decimal, quoted};
use crate::text::{Template, Text};

use super::rows::CellComplaints;
use crate::tables::cell::{Cell, Quotes};
use crate::tables::columns::Cells;
use crate::tables::dialect::SAMPLES;

pub(super) const UTF_8: Template =
    phrase!("UTF-8 text; `truepose import FILE --as csv` reads other encodings");

/// What ends a cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Stop {
    Comma,
    Line,
}

/// A cell and what stands after it.
pub(super) struct Sample<'a> {
    /// Without its quotes.
    content: Cow<'a, [u8]>,
    quotes: Quotes,
    /// Something stands between the closing quote and the end of the cell.
    after_quote: bool,
    /// Where the next cell or row starts.
    pub(super) after: usize,
    pub(super) stop: Stop,
    /// Line feeds inside the quotes.
    pub(super) line_feeds: u64,
}

impl<'a> Sample<'a> {
    /// Reads the cell from `at`.
    pub(super) fn read(bytes: &'a [u8], at: usize) -> Self {
        let cell = Cell::read(bytes, at, SAMPLES);
        let stop = match bytes.get(cell.stop) {
            Some(b',') => Stop::Comma,
            _ => Stop::Line,
        };
        let mut content = cell.content(bytes);
        let (mut after_quote, mut line_feeds) = (false, 0);
        match (cell.quotes, &content) {
            (Quotes::None, Cow::Borrowed(plain)) if stop == Stop::Line => {
                content = Cow::Borrowed(plain.strip_suffix(b"\r").unwrap_or(plain));
            }
            (Quotes::Around | Quotes::Doubled, content) => {
                after_quote = !bytes[cell.end + 1..cell.stop].trim_ascii().is_empty();
                line_feeds = memchr::memchr_iter(b'\n', content).count() as u64;
            }
            _ => {}
        }
        Self {
            content,
            quotes: cell.quotes,
            after_quote,
            after: (cell.stop + 1).min(bytes.len()),
            stop,
            line_feeds,
        }
    }

    /// The cell as text, or what to say about it.
    pub(super) fn text(&self) -> Result<&str, (Text, Template)> {
        if self.quotes == Quotes::Open {
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
            return Err((
                text!("a zero byte"),
                phrase!("a CSV file: headings and one line per sample"),
            ));
        }
        match std::str::from_utf8(&self.content) {
            Ok(text) => Ok(text),
            Err(_) => Err((
                text!("bytes that are not {encoding}", encoding = "UTF-8"),
                UTF_8,
            )),
        }
    }

    /// The text without the spaces around it; those in quotes belong to it.
    fn plain<'t>(&self, text: &'t str) -> &'t str {
        match self.quotes {
            Quotes::None => trimmed(text),
            _ => text,
        }
    }

    /// Appends the cell to its column.
    pub(super) fn store(
        &self,
        column: &mut Cells,
        complaints: &mut CellComplaints<'_>,
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
                        NotANumber::DecimalComma => {
                            phrase!(
                                "a decimal point; decimal commas are read by `truepose import --decimal ,`"
                            )
                        }
                        other => other.expected(),
                    };
                    complaints.about_cell(line, index, Text::verbatim(quoted(plain)), expected);
                }
            },
        }
    }
}

/// A cell without quotes may have spaces around it.
fn trimmed(cell: &str) -> &str {
    cell.trim_matches([' ', '\t'])
}

/// Where the line after this one starts and how many cells are left in this one.
pub(super) fn skip_line(bytes: &[u8], mut at: usize) -> (usize, usize) {
    let mut cells = 0;
    loop {
        let cell = Sample::read(bytes, at);
        cells += 1;
        at = cell.after;
        if cell.stop == Stop::Line {
            return (at, cells);
        }
    }
}
