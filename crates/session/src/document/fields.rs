//! Reads objects field by field and collects every problem on the way.
//!
//! A wrong field yields a diagnostic and `None`; its siblings are still read, so that a file is
//! mended once and not ten times.

use crate::text::Text;
use std::path::{Path as FilePath, PathBuf};

use std::fmt;

use super::{Member, Node, Source, Value, element_offset};
use crate::atomic::folder_of;
use crate::diagnostic::{Diagnostic, Place, Rejected, Severity};
use crate::document::number::quoted;
use crate::progress::{Progress, ProgressSpan, ReadError, unwatched};

/// The way from the document to a value, such as `robot.joints[0].axis`.
#[derive(Debug, Clone, Copy)]
pub enum Path<'a> {
    Root,
    Key(&'a Path<'a>, &'a str),
    Index(&'a Path<'a>, usize),
}

impl Path<'_> {
    pub fn key<'b>(&'b self, key: &'b str) -> Path<'b> {
        Path::Key(self, key)
    }

    pub fn index(&self, index: usize) -> Path<'_> {
        Path::Index(self, index)
    }
}

impl fmt::Display for Path<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Path::Root => Ok(()),
            Path::Key(Path::Root, key) => write!(f, "{key}"),
            Path::Key(parent, key) => write!(f, "{parent}.{key}"),
            Path::Index(parent, index) => write!(f, "{parent}[{index}]"),
        }
    }
}

/// A document that is being read, and what was found so far.
pub struct Fields<'a> {
    pub source: Source<'a>,
    pub findings: Vec<Diagnostic>,
    /// Other files that were read on the way: no output may replace them.
    pub also_read: Vec<PathBuf>,
}

impl<'a> Fields<'a> {
    /// A document as it was read, and its outermost value; what is no JSON is refused whole.
    pub fn open(place: Place, text: &'a str) -> Result<(Self, Node), Rejected> {
        let progress = Progress::new(&unwatched);
        Self::open_in(place, text, progress.whole()).map_err(ReadError::rejected)
    }

    /// As [`Fields::open`], told as this part of something.
    pub(crate) fn open_in(
        place: Place,
        text: &'a str,
        part: ProgressSpan<'_>,
    ) -> Result<(Self, Node), ReadError> {
        let source = Source::new(place.file, text);
        let root = super::parse(&source, part)?;
        let fields = Self {
            source,
            findings: Vec::new(),
            also_read: Vec::new(),
        };
        Ok((fields, root))
    }

    /// What was read, if nothing makes the document unusable.
    pub fn finish<T>(self, read: Option<T>) -> Result<T, Rejected> {
        let read = read.filter(|_| !self.has_errors());
        read.ok_or_else(|| Rejected::of(self.findings))
    }

    /// Whether anything so far makes the document unusable.
    pub fn has_errors(&self) -> bool {
        self.findings
            .iter()
            .any(|finding| finding.severity == Severity::Error)
    }

    /// The folder in which the files that a document names are looked for; none for one in memory.
    pub fn folder(&self) -> Option<&FilePath> {
        self.source.file.as_deref().map(folder_of)
    }

    /// The place of a byte, under its path.
    pub fn place(&self, at: usize, path: &Path<'_>) -> Place {
        let place = self.source.place(at);
        match path {
            Path::Root => place,
            _ => place.in_field(path.to_string()),
        }
    }

    /// Complains of an element of an array that starts at this byte.
    pub(crate) fn element_error(
        &mut self,
        array_at: usize,
        path: &Path<'_>,
        index: usize,
        found: impl Into<Text>,
        expected: impl Into<Text>,
    ) {
        let at = element_offset(&self.source, array_at, index);
        self.error(at, &path.index(index), found, expected);
    }

    pub fn error(
        &mut self,
        at: usize,
        path: &Path<'_>,
        found: impl Into<Text>,
        expected: impl Into<Text>,
    ) {
        let place = self.place(at, path);
        self.findings
            .push(Diagnostic::error(place, found, expected));
    }

    /// Complains that a value is something else.
    pub fn mismatch(&mut self, node: &Node, path: &Path<'_>, expected: impl Into<Text>) {
        self.error(node.at, path, node.value.describe(), expected);
    }

    /// Reports keys that are not read.
    pub fn unknown_keys(&mut self, members: &[Member], path: &Path<'_>, known: &[&str]) {
        let notes = self.notes_of_unknown(members, path, known);
        self.findings.extend(notes);
    }

    /// A note for each key that is not read, and one for all beyond the first few.
    pub(crate) fn notes_of_unknown(
        &self,
        members: &[Member],
        path: &Path<'_>,
        accepted: &[&str],
    ) -> Vec<Diagnostic> {
        const NAMED: usize = 20;
        let is_unknown = |member: &&Member| !accepted.contains(&member.key.as_str());
        let unknown = members.iter().filter(is_unknown);
        let mut notes: Vec<Diagnostic> = unknown
            .clone()
            .take(NAMED)
            .map(|member| {
                let place = self.place(member.key_at, &path.key(&member.key));
                let found = text!("key {key} is not known: ignored", key = quoted(&member.key));
                Diagnostic::note(place, found)
            })
            .collect();
        let mut more = unknown.skip(NAMED);
        if let Some(first) = more.next() {
            let place = self.place(first.key_at, path);
            let found = text!(
                one "{count} more key is not known: ignored", "{count} more keys are not known: ignored",
                count = more.count() + 1
            );
            notes.push(Diagnostic::note(place, found));
        }
        notes
    }
}

/// What stands under a key.
pub(super) fn member<'n>(members: &'n [Member], key: &str) -> Option<&'n Node> {
    let member = members.iter().find(|member| member.key == key);
    member.map(|member| &member.node)
}

/// A member that may be missing or null.
pub fn optional<'n>(members: &'n [Member], key: &str) -> Option<&'n Node> {
    member(members, key).filter(|node| node.value != Value::Null)
}
