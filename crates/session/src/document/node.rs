//! A document as a tree: every value with its place.

use crate::text::Text;

use super::number;

/// A value and the byte of the document at which it starts.
#[derive(Debug, Clone, PartialEq)]
pub struct Node {
    pub at: usize,
    pub value: Value,
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
    pub key: String,
    pub(crate) key_at: usize,
    pub node: Node,
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
                text!("a number that overflows")
            }
            Self::Numbers(values) if values.iter().any(|value| value.is_nan()) => {
                text!("an array with null in it")
            }
            Self::Numbers(values) => array_of(values.len()),
            Self::List(list) => array_of(list.len()),
            Self::Object(_) => text!("an object"),
        }
    }
}

fn array_of(count: usize) -> Text {
    text!(one "an array of {count} value", "an array of {count} values", count)
}
