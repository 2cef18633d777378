//! A CSV file of samples, in one pass.
//!
//! Numbers are read where they stand; everything else, quotes and every complaint included, goes by the cell, in
//! [`cells`].
//!
//! Dialect: UTF-8 (a byte order mark is skipped), comma, decimal point, LF or CRLF, `"` around
//! cells that need it (RFC 4180), headings in the first line. Blank lines are skipped. Other
//! dialects go through `truepose import`.

mod cells;
mod header;
mod rows;

use crate::diagnostic::{Diagnostic, Place};
use crate::progress::{Cancelled, ProgressSpan};

use super::columns::{CellKind, Cells};
use super::lines::Lines;
use cells::{Sample, Stop};
use rows::{CellComplaints, Rows};

/// A table whose headings were read.
pub(crate) struct SampleTable<'a> {
    /// The headings.
    pub(crate) names: Vec<String>,
    bytes: &'a [u8],
    /// Where the line after the headings begins.
    at: usize,
}

/// Bytes between two looks at the watcher.
const AT_ONCE: usize = 1 << 18;

impl<'a> SampleTable<'a> {
    /// Reads the headings; `None`, with the reason in `findings`, when the file is something else.
    pub(crate) fn open(
        bytes: &'a [u8],
        file: &Place,
        findings: &mut Vec<Diagnostic>,
    ) -> Option<Self> {
        let (names, at) = header::read(bytes, file, findings)?;
        Some(Self { names, bytes, at })
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
        let (bytes, mut at, mut tell_at) = (self.bytes, self.at, 0);
        // A row has a byte for each of its cells.
        let lines = memchr::memchr_iter(b'\n', bytes).count() + 1;
        let expected = lines.min(bytes.len() / self.names.len().max(1) + 1);
        let mut rows = Rows {
            columns: kinds.map(|kind| Cells::of(kind, expected)).collect(),
            line: Lines::default(),
            next_line: 2,
            complaints: CellComplaints::new(file, &self.names),
        };
        while at < bytes.len() && !rows.complaints.hopeless {
            if at >= tell_at {
                part.counted(at, bytes.len())?;
                tell_at = at + AT_ONCE;
            }
            at = rows.take_line(bytes, at);
        }
        rows.complaints.into(findings);
        Ok((rows.columns, rows.line))
    }
}

impl Rows<'_> {
    /// Takes a row or a blank line and returns where the next one starts.
    fn take_line(&mut self, bytes: &[u8], at: usize) -> usize {
        let line_end = match bytes[at..] {
            [b'\n', ..] => 1,
            [b'\r', b'\n', ..] => 2,
            _ => return self.take_row(bytes, at),
        };
        self.next_line += 1;
        at + line_end
    }

    /// Takes one row and returns where the next one starts.
    fn take_row(&mut self, bytes: &[u8], start: usize) -> usize {
        let first_line = self.next_line;
        let mut at = start;
        let mut stop = Stop::Comma;
        let count = self.columns.len();
        for (index, column) in self.columns.iter_mut().enumerate() {
            if stop == Stop::Line {
                self.complaints.too_few_cells(self.next_line, index, count);
                for column in &mut self.columns[index..] {
                    column.push_missing();
                }
                break;
            }
            if let Cells::Numbers(values) = column
                && let Some((value, after, ended_by)) = number_cell(bytes, at)
            {
                values.push(value);
                (at, stop) = (after, ended_by);
                continue;
            }
            let cell = Sample::read(bytes, at);
            cell.store(column, &mut self.complaints, self.next_line, index);
            at = cell.after;
            stop = cell.stop;
            self.next_line += cell.line_feeds;
        }
        if stop == Stop::Comma {
            let (after, cells) = cells::skip_line(bytes, at);
            self.complaints
                .too_many_cells(self.next_line, count + cells, count);
            at = after;
        }
        self.line.add(first_line, 1);
        self.next_line += 1;
        at
    }
}

/// The cell at `at` if it is nothing but a finite number, where the next one starts, and what ends it.
fn number_cell(bytes: &[u8], at: usize) -> Option<(f64, usize, Stop)> {
    let end = at + memchr::memchr2(b',', b'\n', &bytes[at..])?;
    let (mut cell, mut stop) = (&bytes[at..end], Stop::Comma);
    if bytes[end] == b'\n' {
        (cell, stop) = (cell.strip_suffix(b"\r").unwrap_or(cell), Stop::Line);
    }
    let value: f64 = std::str::from_utf8(cell).ok()?.parse().ok()?;
    value.is_finite().then_some((value, end + 1, stop))
}

#[cfg(test)]
mod tests;
