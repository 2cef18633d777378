//! The text of a document, and where in it a byte is.

use crate::diagnostic::Place;
use std::cell::OnceCell;
use std::path::PathBuf;

/// The text of a document and its name.
#[derive(Debug, Clone)]
pub struct Source<'a> {
    pub file: Option<PathBuf>,
    pub(crate) text: &'a str,
    /// Where each line starts, once a place was asked for: a file can be wrong in many places.
    lines: OnceCell<Vec<usize>>,
}

impl<'a> Source<'a> {
    pub(crate) fn new(file: Option<PathBuf>, text: &'a str) -> Self {
        let lines = OnceCell::new();
        Self { file, text, lines }
    }

    /// Line and column (in bytes) of a byte of the document.
    pub fn place(&self, at: usize) -> Place {
        let at = at.min(self.text.len());
        let lines = self.lines.get_or_init(|| {
            let feeds = memchr::memchr_iter(b'\n', self.text.as_bytes());
            std::iter::once(0).chain(feeds.map(|at| at + 1)).collect()
        });
        let line = lines.partition_point(|start| *start <= at).max(1);
        Place {
            file: self.file.clone(),
            ..Place::default()
        }
        .at_line(line as u64)
        .at_column((at - lines[line - 1]) as u64 + 1)
    }
}
