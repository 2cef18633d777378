//! A CSV file of samples, in one pass.
//!
//! Dialect: UTF-8 (a byte order mark is skipped), comma, decimal point, LF or CRLF, `"` around
//! cells that need it (RFC 4180), headings in the first line. Blank lines are skipped. Other
//! dialects go through `truepose import`.

use std::borrow::Cow;

use crate::diagnostic::{Diagnostic, Place};
use crate::document::number::{NotANumber, any_decimal, quoted};
use crate::progress::{Cancelled, ProgressSpan};
use crate::text::{Template, Text};

use super::cell::{Cell, Quotes};
use super::columns::{CellKind, Cells};
use super::complaints::Complaints;
use super::dialect::SAMPLES;
use super::encoding::{LONGEST_LINE, Mark, mark, too_long};
use super::lines::Lines;
use super::rows::{AT_ONCE, Row, Rows};

/// A session has fewer columns, with every quantity of a hundred joints.
const MOST_COLUMNS: usize = 10_000;

/// Complaints that are worth printing; the rest is counted.
const MOST_COMPLAINTS: usize = 50;

/// Bytes that show whether a file is text.
const START: usize = 1 << 18;

const CSV: Template = phrase!("a CSV file: headings and one line per sample");
const UTF_8: Template =
    phrase!("UTF-8 text; `truepose import FILE --as csv` reads other encodings");
const POINT: Template =
    phrase!("a decimal point; decimal commas are read by `truepose import --decimal ,`");

/// A table whose headings were read.
pub(crate) struct SampleTable<'a> {
    /// The headings.
    pub(crate) names: Vec<String>,
    bytes: &'a [u8],
    /// Behind the line of the headings.
    rows: Rows<'a>,
}

impl<'a> SampleTable<'a> {
    /// Reads the headings; `None`, with the reason in `findings`, when the file is something else.
    pub(crate) fn open(
        bytes: &'a [u8],
        file: &Place,
        findings: &mut Vec<Diagnostic>,
    ) -> Option<Self> {
        let table = Self::headed(bytes, &file.clone().at_line(1));
        table.map_err(|wrong| findings.push(*wrong)).ok()
    }

    fn headed(bytes: &'a [u8], first: &Place) -> Result<Self, Box<Diagnostic>> {
        let wrong_at = |place: Place, found: Text, expected: Template| {
            Err(Box::new(Diagnostic::error(place, found, expected)))
        };
        let wrong = |found, expected| wrong_at(first.clone(), found, expected);
        let at = match mark(bytes) {
            Some((Mark::Utf8, length)) => length,
            None => 0,
            Some((Mark::Utf32, _)) => {
                return wrong(text!("a file in {encoding}", encoding = "UTF-32"), UTF_8);
            }
            Some(_) => return wrong(text!("a file in {encoding}", encoding = "UTF-16"), UTF_8),
        };
        if bytes[at..].trim_ascii().is_empty() {
            return wrong(text!("an empty file"), CSV);
        }
        // What is no text shows it at once.
        let start = &bytes[at..bytes.len().min(at + START)];
        if let Some(zero) = memchr::memchr(0, start) {
            let letters = start.len() > 3 && start[(zero + 1) % 2].is_ascii_graphic();
            return match zero {
                0 | 1 if letters => {
                    wrong(text!("a file in {encoding}", encoding = "UTF-16"), UTF_8)
                }
                _ => wrong(text!("a zero byte"), CSV),
            };
        }
        if too_long(&bytes[at..]).is_some() {
            let found = text!(
                "a line of more than {longest_line} bytes",
                longest_line = LONGEST_LINE
            );
            return wrong(found, CSV);
        }
        let mut rows = Rows::new(bytes, at, SAMPLES);
        let mut row = Row::default();
        let open = rows.next(&mut row).is_err();
        if row.cells.len() > MOST_COLUMNS {
            let found = text!(one "{count} column", "{count} columns", count = row.cells.len());
            let expected = text!("a table of at most {most} columns", most = MOST_COLUMNS);
            let wrong = Diagnostic::error(first.clone(), found, expected);
            return Err(Box::new(wrong));
        }
        let mut names = Vec::new();
        for (cell, number) in row.cells.iter().zip(1..) {
            match content(*cell, bytes) {
                Ok(text) if !text.trim().contains('\n') => names.push(text.trim().to_owned()),
                Ok(text) => {
                    let found = Text::verbatim(quoted(&text));
                    let place = first.clone().at_column(number);
                    return wrong_at(place, found, phrase!("a heading on one line"));
                }
                Err((found, expected)) => {
                    return wrong_at(first.clone().at_column(number), found, expected);
                }
            }
        }
        if open {
            let (found, expected) = not_closed();
            let place = first.clone().at_column(names.len() as u64 + 1);
            return wrong_at(place, found, expected);
        }
        match wrong_dialect(&names) {
            Some((found, expected)) => wrong(found, expected),
            None => Ok(Self { names, bytes, rows }),
        }
    }

    /// Reads the rows, told as `part` of something: a column for each of the kinds, which are those of the headings,
    /// and the line of each row. They are whole only if `findings` got no error.
    ///
    /// # Errors
    /// That it was cancelled.
    pub(crate) fn rows(
        &self,
        kinds: impl Iterator<Item = CellKind>,
        file: &Place,
        findings: &mut Vec<Diagnostic>,
        part: ProgressSpan<'_>,
    ) -> Result<(Vec<Cells>, Lines), Cancelled> {
        let (bytes, names, mut tell_at) = (self.bytes, &self.names, 0);
        // A row has a byte for each of its cells.
        let feeds = memchr::memchr_iter(b'\n', bytes).count() + 1;
        let expected = feeds.min(bytes.len() / names.len().max(1) + 1);
        let mut columns: Vec<Cells> = kinds.map(|kind| Cells::of(kind, expected)).collect();
        let mut lines = Lines::default();
        let mut complaints = Complaints::of_at_most(MOST_COMPLAINTS);
        let place = |line: u64, column: usize| {
            let place = file.clone().at_line(line).at_column(column as u64 + 1);
            match names.get(column) {
                Some(name) => place.in_field(name.as_str()),
                None => place,
            }
        };
        let (mut rows, mut row) = (self.rows.clone(), Row::default());
        loop {
            let is_open = match rows.next(&mut row) {
                Ok(true) => false,
                Ok(false) => break,
                Err(_) => true,
            };
            if row.start >= tell_at {
                part.counted(row.start, bytes.len())?;
                tell_at = row.start + AT_ONCE;
            }
            lines.add(row.line, 1);
            let count = row.cells.len();
            for (index, column) in columns.iter_mut().enumerate() {
                let stored = row.cells.get(index).map(|cell| store(*cell, bytes, column));
                if let Some(Err((found, expected))) = stored {
                    complaints.add(|| Diagnostic::error(place(row.line, index), found, expected));
                }
                if column.len() < lines.len() {
                    column.push_missing();
                }
            }
            if is_open {
                let (found, expected) = not_closed();
                complaints.add(|| Diagnostic::error(place(row.line, count), found, expected));
            } else if count != names.len() {
                let found = text!(one "{count} cell", "{count} cells", count);
                let expected = text!(
                    one "{count} cell, one for each heading",
                    "{count} cells, one for each heading",
                    count = names.len()
                );
                let expected = if count > names.len() {
                    text!("{first}; {next}", first = expected, next = POINT)
                } else {
                    expected
                };
                let place = file.clone().at_line(row.line);
                let place = place.at_column(count.min(names.len() + 1) as u64);
                complaints.add(|| Diagnostic::error(place, found, expected));
            }
        }
        complaints.into(file, findings);
        Ok((columns, lines))
    }
}

/// Appends a cell to its column; otherwise what is wrong with it.
fn store(cell: Cell, bytes: &[u8], column: &mut Cells) -> Result<(), (Text, Template)> {
    if let Cells::Numbers(values) = column
        && let Ok(Ok(value)) = std::str::from_utf8(&bytes[cell.start..cell.end]).map(str::parse)
        && f64::is_finite(value)
    {
        values.push(value);
        return Ok(());
    }
    let text = content(cell, bytes)?;
    // A cell without quotes may have spaces around it.
    let plain = match cell.quotes {
        Quotes::None => text.trim_matches([' ', '\t']),
        _ => &text,
    };
    match column {
        Cells::Text(cells) => cells.push(text.into_owned()),
        Cells::Names(names) => names.push(plain),
        Cells::Numbers(values) if plain.is_empty() => values.push(f64::NAN),
        Cells::Numbers(values) => {
            let value = any_decimal(plain).map_err(|problem| {
                let expected = match problem {
                    NotANumber::DecimalComma => POINT,
                    other => other.expected(),
                };
                (Text::verbatim(quoted(plain)), expected)
            })?;
            values.push(value);
        }
    }
    Ok(())
}

/// A cell as text, or what to say about it.
fn content(cell: Cell, bytes: &[u8]) -> Result<Cow<'_, str>, (Text, Template)> {
    if !cell.behind_quote(bytes).is_empty() {
        let found = text!("something after the closing quote");
        return Err((found, phrase!("a comma or the end of the line")));
    }
    let content = cell.content(bytes);
    if content.contains(&0) {
        return Err((text!("a zero byte"), CSV));
    }
    let text = match content {
        Cow::Borrowed(content) => std::str::from_utf8(content).ok().map(Cow::Borrowed),
        Cow::Owned(content) => String::from_utf8(content).ok().map(Cow::Owned),
    };
    text.ok_or((
        text!("bytes that are not {encoding}", encoding = "UTF-8"),
        UTF_8,
    ))
}

fn not_closed() -> (Text, Template) {
    (
        text!("a quote that is not closed"),
        phrase!("a closing quote"),
    )
}

/// What is wrong with headings that are separated otherwise, or are none.
fn wrong_dialect(names: &[String]) -> Option<(Text, Template)> {
    if let [only] = names
        && let Some((_, called)) = [(';', "semicolons"), ('\t', "tabs")]
            .into_iter()
            .find(|(separator, _)| only.contains(*separator))
    {
        return Some((
            text!(
                "headings separated by {called}: {only}",
                called,
                only = quoted(only)
            ),
            phrase!(
                "commas (and decimal points); `truepose import FILE --as csv` reads other separators and decimal commas"
            ),
        ));
    }
    let are_numbers = names.iter().all(|name| any_decimal(name).is_ok());
    are_numbers.then(|| {
        (
            text!(
                "numbers in the first line: {names}",
                names = quoted(&names.join(","))
            ),
            phrase!(
                "headings such as q1_deg,x_mm,y_mm,z_mm; `truepose import FILE --as tracker` reads files without headings"
            ),
        )
    })
}

#[cfg(test)]
mod tests;
