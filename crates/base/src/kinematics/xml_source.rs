//! The text of an XML document, and parts of it by their positions: an element, a name and a value of it are a few
//! bytes each instead of a copy.

use std::ops::Range;
use std::path::{Path, PathBuf};

use crate::diagnostic::Place;

/// A name or a value: bytes of a [`Source`].
#[derive(Debug, Clone, Copy)]
pub(super) struct Piece {
    start: u32,
    end: u32,
}

impl Piece {
    /// No text.
    pub(super) const EMPTY: Self = Self { start: 0, end: 0 };
}

/// A file.
#[derive(Debug)]
pub(super) struct Source {
    pub(super) file: PathBuf,
    /// The text, and behind it what its entities were written out to.
    text: String,
    length: usize,
    /// Where each line starts: a place is asked for each joint, and the text is long.
    lines: Vec<u32>,
}

/// A position in a text; texts are far shorter than what it can hold.
fn place(at: usize) -> u32 {
    u32::try_from(at).unwrap_or(u32::MAX)
}

impl Source {
    pub(super) fn new(text: &str, file: &Path) -> Self {
        let feeds = || memchr::memchr_iter(b'\n', text.as_bytes());
        let mut lines = Vec::with_capacity(1 + feeds().count());
        lines.push(0);
        lines.extend(feeds().map(|at| place(at + 1)));
        Self {
            file: file.to_path_buf(),
            text: text.to_owned(),
            length: text.len(),
            lines,
        }
    }

    /// Bytes of the file.
    pub(super) fn length(&self) -> usize {
        self.length
    }

    pub(super) fn place(&self, at: usize) -> Place {
        let at = at.min(self.length);
        let line = self.lines.partition_point(|start| *start as usize <= at);
        let start = self.lines[line.max(1) - 1] as usize;
        Place::file(&self.file)
            .at_line(line as u64)
            .at_column((at - start) as u64 + 1)
    }

    /// A text at `expected` unless an entity or an escape was written out in it.
    pub(super) fn piece(&mut self, value: &str, expected: Range<usize>) -> Piece {
        let range = if self.text.get(expected.clone()) == Some(value) {
            expected
        } else {
            let start = self.text.len();
            self.text.push_str(value);
            start..self.text.len()
        };
        Piece {
            start: place(range.start),
            end: place(range.end),
        }
    }

    pub(super) fn text(&self, piece: Piece) -> &str {
        let range = piece.start as usize..piece.end as usize;
        self.text.get(range).unwrap_or_default()
    }
}
