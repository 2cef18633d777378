//! The bytes of a file, and where in it a byte is.

use std::path::Path;

use crate::diagnostic::{Diagnostic, Place, Rejected};

use super::target::Problem;
use crate::tables::encoding::{Mark, mark};

/// A program as bytes, with its lines. Programs are read as bytes: what is not ASCII stands in comments, strings and
/// names only, so that any encoding with ASCII in it comes back as it was.
#[derive(Debug, Clone)]
pub struct Text<'a> {
    /// The whole file.
    pub bytes: &'a [u8],
    line_starts: Vec<usize>,
}

impl<'a> Text<'a> {
    /// A file; lines end with LF, CR LF or CR.
    pub fn new(bytes: &'a [u8]) -> Self {
        let mut line_starts = vec![0];
        for (i, byte) in bytes.iter().enumerate() {
            let ends = *byte == b'\n' || (*byte == b'\r' && bytes.get(i + 1) != Some(&b'\n'));
            if ends {
                line_starts.push(i + 1);
            }
        }
        Self { bytes, line_starts }
    }

    /// Where the content begins, behind a byte-order mark.
    pub fn start(&self) -> usize {
        match mark(self.bytes) {
            Some((Mark::Utf8, length)) => length,
            _ => 0,
        }
    }

    /// Line and column of a byte, from 1; beyond the last those of the end.
    pub fn place(&self, at: usize) -> (u64, u64) {
        let at = at.min(self.bytes.len());
        let line = self.line_starts.partition_point(|start| *start <= at);
        let start = self.line_starts[line.saturating_sub(1)].max(self.start().min(at));
        (line as u64, (at - start + 1) as u64)
    }

    /// Every line without its end, by the places of its bytes.
    pub fn lines(&self) -> impl ExactSizeIterator<Item = std::ops::Range<usize>> + '_ {
        (0..self.line_starts.len()).map(|k| {
            let start = self.line_starts[k].max(self.start());
            let next = self.line_starts.get(k + 1);
            let mut end = next.copied().unwrap_or(self.bytes.len());
            while end > start && matches!(self.bytes[end - 1], b'\n' | b'\r') {
                end -= 1;
            }
            start..end
        })
    }

    /// What keeps the file from being read at all.
    pub(super) fn unreadable(&self) -> Option<Problem> {
        let wide = matches!(mark(self.bytes), Some((Mark::Utf16Le | Mark::Utf16Be, _)));
        let (at, found) = if wide {
            (0, text!("UTF-16 text"))
        } else {
            let zero = self.bytes.iter().position(|b| *b == 0)?;
            (zero, text!("a zero byte"))
        };
        let expected = text!("text in UTF-8 or another encoding with ASCII in it");
        Some(Problem::new(at, found, expected))
    }

    /// The bytes at a range, as far as there are any and they are UTF-8.
    pub fn shown(&self, range: std::ops::Range<usize>) -> String {
        let end = range.end.min(self.bytes.len());
        let bytes = self.bytes.get(range.start..end).unwrap_or_default();
        String::from_utf8_lossy(bytes).into_owned()
    }

    pub(super) fn rejected(&self, problems: Vec<Problem>, file: Option<&Path>) -> Rejected {
        let diagnostic = |problem: Problem| {
            let (line, column) = self.place(problem.at);
            let place = file.map_or_else(Place::default, Place::file);
            Diagnostic::error(
                place.at_line(line).at_column(column),
                problem.found,
                problem.expected,
            )
        };
        Rejected::of(problems.into_iter().map(diagnostic).collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn places_count_from_one_with_every_line_end_and_a_mark() {
        let text = Text::new(b"\xef\xbb\xbfab\r\ncd\ref\n");
        assert_eq!(text.place(3), (1, 1));
        assert_eq!(text.place(7), (2, 1));
        assert_eq!(text.place(11), (3, 2));
        let lines: Vec<String> = text.lines().map(|r| text.shown(r)).collect();
        assert_eq!(lines, ["ab", "cd", "ef", ""]);
    }
}
