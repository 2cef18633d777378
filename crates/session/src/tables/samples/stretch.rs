//! Regular rows, many at once and column by column.
//!
//! Nearly every row of a long file is regular: as many cells as there are headings, no quotes,
//! numbers where numbers belong. For a stretch of such rows all commas and line feeds are found
//! first, 64 bytes at a time; then each column takes its cells, whose ends are known. So the loop
//! over the cells of a column holds nothing but numbers, and the stretch is small enough to stay
//! in the processor's first cache until all columns have been through it.
//!
//! A stretch with anything else in it is given back untouched, and its rows are taken one by one:
//! only there is anything complained about, in the order of the file.

use crate::document::number::{any_decimal, plain_decimal, short_decimal};
use crate::tables::columns::Cells;

use super::cells::{Sample, trimmed};
use super::rows::Rows;
use super::starts::Mark;

/// The value of a cell of this length, at most fifteen, at the start of these bytes, if it is a
/// plain number: `[-]digits[.digits]`.
pub(super) trait Decimal: Fn(&[u8; SHORT], usize) -> Option<f64> {}
impl<F: Fn(&[u8; SHORT], usize) -> Option<f64>> Decimal for F {}

/// A sign and fifteen bytes more, and what ends them.
pub(super) const SHORT: usize = 17;

/// What the processor at hand does with many bytes at once.
pub(super) struct Tools<M, D> {
    pub(super) mark: M,
    pub(super) decimal: D,
}

impl Rows<'_> {
    /// Takes the rows that are complete in `bytes[at..until]` if all of them are regular, and
    /// returns where the next one starts. `None` leaves everything as it was.
    #[inline(always)]
    #[allow(clippy::inline_always, reason = "see Rows::take_with")]
    pub(super) fn take_stretch(
        &mut self,
        bytes: &[u8],
        at: usize,
        until: usize,
        tools: &Tools<impl Mark, impl Decimal>,
    ) -> Option<usize> {
        let width = self.columns.len();
        let regular = self.starts.find(&bytes[at..until], &tools.mark);
        let count = (self.starts.count - 1) / width;
        // In a single column an empty cell cannot be told from a blank line.
        if !regular || count == 0 || width < 2 {
            return None;
        }
        // One more row than there is, for the ends of the last row's cells.
        let starts = self.starts.list.get(..(count + 1) * width)?;
        let next = at + starts[count * width] as usize;
        let bytes = &bytes[at..];
        let before = self.line.len();
        for (index, column) in self.columns.iter_mut().enumerate() {
            let ended_by = if index + 1 < width { b',' } else { b'\n' };
            let spans = starts[index..index + count * width].chunks_exact(width);
            let spans = spans.map(|row| (row[0] as usize, row[1] as usize - 1));
            if !take_column(column, bytes, spans, ended_by, &tools.decimal) {
                for column in &mut self.columns[..=index] {
                    column.truncate(before);
                }
                return None;
            }
        }
        self.line.add(self.next_line, count);
        self.next_line += count as u64;
        Some(next)
    }
}

/// Appends cells, each from its start to its end, which has to be this byte; false at the first one
/// that is not what belongs in this column.
#[inline(always)]
#[allow(clippy::inline_always, reason = "see Rows::take_with")]
fn take_column(
    column: &mut Cells,
    bytes: &[u8],
    mut spans: impl ExactSizeIterator<Item = (usize, usize)>,
    ended_by: u8,
    decimal: &impl Decimal,
) -> bool {
    let Cells::Numbers(values) = column else {
        return spans.all(|(start, end)| {
            bytes[end] == ended_by && Sample::read(bytes, start, end + 1).store_text(column)
        });
    };
    let before = values.len();
    values.resize(before + spans.len(), f64::NAN);
    for (value, (start, end)) in values[before..].iter_mut().zip(spans) {
        let length = end.wrapping_sub(start);
        if let Some(cell) = bytes.get(start..).and_then(|rest| rest.first_chunk())
            && length < 16
            && cell[length] == ended_by
            && let Some(number) = decimal(cell, length)
        {
            *value = number;
            continue;
        }
        match any_number(bytes, start, end, ended_by) {
            Some(number) => *value = number,
            None => return false,
        }
    }
    true
}

/// A number that is not plain or not short; NaN where the cell is empty.
#[cold]
#[inline(never)]
fn any_number(bytes: &[u8], start: usize, end: usize, ended_by: u8) -> Option<f64> {
    let cell = bytes.get(start..end)?;
    let cell = match cell {
        _ if bytes[end] != ended_by => return None,
        [cell @ .., b'\r'] if ended_by == b'\n' => cell,
        cell => cell,
    };
    if let Some((value, plain_end)) = plain_decimal(bytes, start)
        && plain_end == start + cell.len()
    {
        return Some(value);
    }
    match trimmed(std::str::from_utf8(cell).ok()?) {
        "" => Some(f64::NAN),
        number => any_decimal(number).ok(),
    }
}

/// Words of eight bytes, as every processor has them.
type Portable = Tools<fn(&[u8; 64]) -> (u64, u64), fn(&[u8; SHORT], usize) -> Option<f64>>;
pub(super) const PORTABLE: Portable = Tools { mark, decimal };

fn mark(bytes: &[u8; 64]) -> (u64, u64) {
    const LOW_BITS: u64 = 0x7f7f_7f7f_7f7f_7f7f;
    // The high bit of every byte that equals this one, and no other.
    let equal = |word: u64, byte: u8| {
        let zero_where_equal = word ^ (u64::from(byte) * 0x0101_0101_0101_0101);
        !(((zero_where_equal & LOW_BITS) + LOW_BITS) | zero_where_equal | LOW_BITS)
    };
    // One bit for each byte, the first one lowest: no two products meet in the highest byte.
    let bits = |marked: u64| (marked >> 7).wrapping_mul(0x0102_0408_1020_4080) >> 56;
    let (words, _) = bytes.as_chunks::<8>();
    let (mut ends, mut quotes) = (0, 0);
    for (word, place) in words.iter().zip((0..).step_by(8)) {
        let word = u64::from_le_bytes(*word);
        ends |= bits(equal(word, b',') | equal(word, b'\n')) << place;
        quotes |= equal(word, b'"');
    }
    (ends, quotes)
}

fn decimal(cell: &[u8; SHORT], length: usize) -> Option<f64> {
    if length == 0 {
        return None;
    }
    short_decimal(cell, 0, length)
}
