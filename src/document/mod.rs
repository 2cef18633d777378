//! JSON documents: a tree that knows where everything stands, and the fields of an object, declared
//! once ([`object`]), which reads and writes them.
//!
//! A calibration session is written by hand as often as by a program, and a complaint such as
//! "robot.joints[0].axis: 2 numbers; expected 3" is only worth something with its line. So every
//! value keeps the byte at which it starts, numbers keep being correctly rounded doubles, and an
//! array of numbers goes straight into a `Vec<f64>`: 10⁶ inline samples are no trees of nodes.
//!
//! RFC 8259, strictly; besides, a key may occur only once in an object, and nesting ends at
//! 64 levels. A number that overflows is infinite here and refused where it is used.

mod at;
mod degrees;
mod fields;
pub(crate) mod kinds;
mod layout;
pub(crate) mod number;
pub(crate) mod object;
mod parser;
pub(crate) mod ranges;
mod value;

pub(crate) use degrees::degrees;
pub(crate) use fields::{Fields, Path, optional};
pub(crate) use layout::{text_of, write_document, write_number};
pub(crate) use parser::{element_offset, parse};
pub(crate) use value::object;

use std::cell::OnceCell;
use std::path::PathBuf;

use crate::diagnostic::Place;
use crate::text::Text;

/// A value and the byte of the document at which it starts.
#[derive(Debug, Clone, PartialEq)]
pub struct Node {
    pub(crate) at: usize,
    pub(crate) value: Value,
}

/// A JSON value.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// No value: its key is left out; only in documents that are written.
    Absent,
    /// `null`.
    Null,
    /// `true` or `false`.
    Bool(bool),
    /// A number; what is not finite is written as `null`.
    Number(f64),
    /// A whole number; only in documents that are written.
    Whole(u64),
    /// Text.
    Text(String),
    /// An array of nothing but numbers and nulls (NaN), not empty.
    Numbers(Vec<f64>),
    /// Any other array.
    List(Vec<Node>),
    /// Keys with their values, in order.
    Object(Vec<Member>),
}

/// A key and its value.
#[derive(Debug, Clone, PartialEq)]
pub struct Member {
    pub(crate) key: String,
    pub(crate) key_at: usize,
    pub(crate) node: Node,
}

impl Value {
    /// What it is, for a message.
    pub(crate) fn describe(&self) -> Text {
        match self {
            Self::Absent | Self::Null => Text::verbatim("null"),
            Self::Bool(value) => Text::verbatim(value.to_string()),
            Self::Number(value) if value.is_infinite() => text!("a number that overflows"),
            Self::Number(value) => Text::verbatim(value.to_string()),
            Self::Whole(value) => Text::verbatim(value.to_string()),
            Self::Text(text) => Text::verbatim(number::quoted(text)),
            Self::Numbers(values) if values.iter().any(|value| value.is_infinite()) => {
                text!("an array with a number that overflows")
            }
            Self::Numbers(values) if values.iter().any(|value| value.is_nan()) => {
                text!("an array with null in it")
            }
            Self::Numbers(values) => text!("an array of {count} numbers", count = values.len()),
            Self::List(list) if list.is_empty() => text!("an empty array"),
            Self::List(list) => text!("an array of {count} values", count = list.len()),
            Self::Object(_) => text!("an object"),
        }
    }
}

/// The text of a document and its name.
#[derive(Debug, Clone)]
pub(crate) struct Source<'a> {
    pub(crate) file: Option<PathBuf>,
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
    pub(crate) fn place(&self, at: usize) -> Place {
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

#[cfg(test)]
mod tests;
