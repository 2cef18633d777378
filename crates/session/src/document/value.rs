//! Values on their way out: what a document says becomes the same tree that reading makes, and serde
//! writes that.

use crate::text::{Template, Text};
use serde::ser::{Serialize, SerializeMap, Serializer};

use super::{Member, Node, Value};

/// An object with these keys, in this order. A value is anything that [`Value`] is made from.
#[doc(hidden)]
#[macro_export]
macro_rules! object {
    ($($key:literal : $value:expr),* $(,)?) => {
        $crate::document::Value::Object(vec![
            $($crate::document::Member::new($key, $value)),*
        ])
    };
}

impl Member {
    /// A key and its value in a document that is being written.
    pub fn new(key: impl Into<String>, value: impl Into<Value>) -> Self {
        let value = value.into();
        let node = Node { at: 0, value };
        Self {
            key: key.into(),
            key_at: 0,
            node,
        }
    }
}

impl Value {
    /// An object with the keys of another one behind its own.
    #[must_use]
    pub fn with(self, more: Self) -> Self {
        match (self, more) {
            (Self::Object(mut pairs), Self::Object(more)) => {
                pairs.extend(more);
                Self::Object(pairs)
            }
            (own, _) => own,
        }
    }
}

impl Serialize for Value {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Absent | Self::Null => serializer.serialize_unit(),
            Self::Bool(value) => value.serialize(serializer),
            Self::Number(value) => value.serialize(serializer),
            Self::Whole(value) => value.serialize(serializer),
            Self::Text(text) => text.serialize(serializer),
            Self::Numbers(values) => values.serialize(serializer),
            Self::List(list) => serializer.collect_seq(list.iter().map(|node| &node.value)),
            Self::Object(members) => {
                let mut map = serializer.serialize_map(None)?;
                for member in members.iter().filter(|m| m.node.value != Self::Absent) {
                    map.serialize_entry(&member.key, &member.node.value)?;
                }
                map.end()
            }
        }
    }
}

/// `Value::Number` of a double, and so on.
macro_rules! values {
    ($($of:ty: $value:ident => $made:expr),* $(,)?) => {
        $(impl From<$of> for Value {
            fn from($value: $of) -> Self {
                $made
            }
        })*
    };
}

values! {
    bool: value => Self::Bool(value),
    f64: value => Self::Number(value),
    usize: value => Self::Whole(value as u64),
    u64: value => Self::Whole(value),
    &str: text => Self::Text(text.to_owned()),
    String: text => Self::Text(text),
    &String: text => Self::Text(text.clone()),
    Text: text => Self::Text(text.to_string()),
    &Text: text => Self::Text(text.to_string()),
    Template: text => Self::Text(text.english().to_owned()),
    &[f64]: values => Self::Numbers(values.to_vec()),
}

impl<T: Into<Value>> From<Option<T>> for Value {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Null, Into::into)
    }
}

impl<T: Into<Value>, const N: usize> From<[T; N]> for Value {
    fn from(values: [T; N]) -> Self {
        values.into_iter().collect()
    }
}

impl<T: Into<Value>> From<Vec<T>> for Value {
    fn from(values: Vec<T>) -> Self {
        values.into_iter().collect()
    }
}

impl<T: Clone + Into<Value>> From<&Vec<T>> for Value {
    fn from(values: &Vec<T>) -> Self {
        values.iter().cloned().collect()
    }
}

impl<T: Into<Value>> FromIterator<T> for Value {
    fn from_iter<I: IntoIterator<Item = T>>(values: I) -> Self {
        let node = |value: T| Node {
            at: 0,
            value: value.into(),
        };
        Self::List(values.into_iter().map(node).collect())
    }
}
