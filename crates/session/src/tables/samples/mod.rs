//! A CSV file of samples, in one pass and large blocks.
//!
//! The file is never mapped (a mapped file that shrinks kills the program) and never held whole:
//! a block is read, its complete rows go straight into their columns, and what is left of the last
//! row moves to the front of the next block. Regular rows go column by column, a [`stretch`] at a
//! time; the others row by row and cell by cell. Numbers take the exact short cut of
//! [`number`](crate::document::number); everything else, quotes and every complaint included, is off the hot
//! path in [`cells`].
//!
//! Dialect: UTF-8 (a byte order mark is skipped), comma, decimal point, LF or CRLF, `"` around
//! cells that need it (RFC 4180), headings in the first line. Blank lines are skipped. Other
//! dialects go through `truepose import`.

mod blocks;
mod cells;
mod header;
#[cfg(target_arch = "x86_64")]
mod lanes;
mod rows;
mod starts;
mod stretch;

use std::io::{self, Read};

use crate::diagnostic::{Diagnostic, Place};
use crate::document::number::{plain_decimal, short_cell, short_decimal};
use crate::progress::ProgressSpan;

use super::columns::{CellKind, Cells};
use super::lines::Lines;
use blocks::Blocks;
use cells::{Sample, Stop};
use rows::{CellComplaints, Rows};
use starts::{Mark, Starts};
use stretch::{Decimal, Tools};

/// A table whose headings were read.
pub(crate) struct SampleTable<R> {
    /// The headings.
    pub(crate) names: Vec<String>,
    blocks: Blocks<R>,
}

impl<R: Read> SampleTable<R> {
    /// Reads the headings; `None`, with the reason in `findings`, when the file is something else.
    ///
    /// # Errors
    /// What reading from `input` says.
    pub(crate) fn open(
        input: R,
        file: &Place,
        findings: &mut Vec<Diagnostic>,
    ) -> io::Result<Option<Self>> {
        let mut blocks = Blocks::new(input);
        let names = header::read(&mut blocks, file, findings)?;
        Ok(names.map(|names| Self { names, blocks }))
    }

    /// Reads the rows, told as `part` of something: a column for each of the kinds, which are those of the headings,
    /// and the line of each row. `bytes` is the length of the input where it is known. They are whole only if
    /// `findings` got no error.
    ///
    /// # Errors
    /// What reading from the input says, or that it was cancelled.
    pub(crate) fn rows(
        &mut self,
        kinds: impl Iterator<Item = CellKind>,
        bytes: Option<u64>,
        file: &Place,
        findings: &mut Vec<Diagnostic>,
        part: ProgressSpan<'_>,
    ) -> io::Result<(Vec<Cells>, Lines)> {
        let Self { names, blocks } = self;
        let expected = blocks.rows_to_expect(bytes);
        let mut rows = Rows {
            columns: kinds.map(|kind| Cells::of(kind, expected)).collect(),
            line: Lines::default(),
            next_line: 2,
            starts: Starts::new(),
            complaints: CellComplaints::new(file, names),
        };
        let mut done = 0;
        while let Some(block) = blocks.next_rows()? {
            let used = rows.take(block.bytes, block.end, block.last);
            blocks.consume(used);
            done += used as u64;
            part.reached(done as f64 / bytes.unwrap_or(0).max(done) as f64)?;
            if rows.complaints.hopeless {
                break;
            }
        }
        if let Some(line) = blocks.endless_line(rows.next_line) {
            let found = text!(
                "a line of more than {blocks} MiB",
                blocks = blocks::LONGEST_LINE >> 20
            );
            let place = file.clone().at_line(line);
            findings.push(Diagnostic::error(
                place,
                found,
                text!("one sample per line"),
            ));
        }
        rows.complaints.into(findings);
        Ok((rows.columns, rows.line))
    }
}

impl Rows<'_> {
    /// Takes every complete row of `bytes[..end]`, which ends with a line feed; beyond it there is
    /// padding. Returns how many bytes it used: less than `end` only when a quoted cell goes on in
    /// the next block.
    fn take(&mut self, bytes: &[u8], end: usize, last_block: bool) -> usize {
        #[cfg(target_arch = "x86_64")]
        if let Some(used) = lanes::take(self, bytes, end, last_block) {
            return used;
        }
        self.take_with(bytes, end, last_block, &stretch::PORTABLE)
    }

    /// As [`Rows::take`], with these tools.
    #[inline(always)]
    #[allow(
        clippy::inline_always,
        reason = "as in wide::Loop: lanes compiles it for wide registers"
    )]
    fn take_with(
        &mut self,
        bytes: &[u8],
        end: usize,
        last_block: bool,
        tools: &Tools<impl Mark, impl Decimal>,
    ) -> usize {
        let mut at = 0;
        while at < end {
            let until = end.min(at + starts::LONGEST);
            if let Some(next) = self.take_stretch(bytes, at, until, tools) {
                at = next;
                continue;
            }
            while at < until {
                match self.take_line(bytes, at, end, last_block) {
                    Some(next) => at = next,
                    None => return at,
                }
            }
        }
        at
    }

    /// Takes a row or a blank line and returns where the next one starts; `None` if its end is in
    /// the next block.
    fn take_line(&mut self, bytes: &[u8], at: usize, end: usize, last: bool) -> Option<usize> {
        let line_end = match bytes[at..] {
            [b'\n', ..] => 1,
            [b'\r', b'\n', ..] => 2,
            _ => return self.take_row(bytes, at, end, last),
        };
        self.next_line += 1;
        Some(at + line_end)
    }

    /// Takes one row and returns where the next one starts; `None` if its end is in the next block.
    #[inline]
    fn take_row(&mut self, bytes: &[u8], start: usize, end: usize, last: bool) -> Option<usize> {
        let rows = self.line.len();
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
            let expected = if index + 1 < count { b',' } else { b'\n' };
            if let Cells::Numbers(values) = column
                && let Some((value, after)) = number_cell(bytes, at, expected)
            {
                values.push(value);
                at = after;
                stop = if expected == b',' {
                    Stop::Comma
                } else {
                    Stop::Line
                };
                continue;
            }
            let cell = Sample::read(bytes, at, end);
            if cell.is_open() && !last {
                for column in &mut self.columns {
                    column.truncate(rows);
                }
                self.next_line = first_line;
                return None;
            }
            cell.store(column, &mut self.complaints, self.next_line, index);
            at = cell.after;
            stop = cell.stop;
            self.next_line += cell.line_feeds;
        }
        if stop == Stop::Comma {
            let (after, cells) = cells::skip_line(bytes, at, end);
            self.complaints
                .too_many_cells(self.next_line, count + cells, count);
            at = after;
        }
        self.line.add(first_line, 1);
        self.next_line += 1;
        Some(at)
    }
}

/// A plain number that is ended as expected, and where the next cell starts. `None` is no verdict.
#[inline]
fn number_cell(bytes: &[u8], at: usize, expected: u8) -> Option<(f64, usize)> {
    let (value, end) = match short_cell(bytes, at) {
        Some(length) => (short_decimal(bytes, at, length)?, at + length),
        None => plain_decimal(bytes, at)?,
    };
    match bytes.get(end) {
        Some(&byte) if byte == expected => Some((value, end + 1)),
        Some(b'\r') if expected == b'\n' && bytes.get(end + 1) == Some(&b'\n') => {
            Some((value, end + 2))
        }
        _ => None,
    }
}

#[cfg(test)]
mod tests;
