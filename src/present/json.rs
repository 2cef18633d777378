//! JSON documents as they are written: a key stands once, where its value is computed, and an object
//! keeps the order of its keys.

use serde::ser::{Serialize, SerializeMap, Serializer};

/// A value of a document.
#[derive(Debug, Clone, PartialEq)]
pub enum Json {
    /// No value; in an object its key is left out.
    Absent,
    /// `null`.
    Null,
    /// `true` or `false`.
    Bool(bool),
    /// A whole number.
    Count(u64),
    /// A number; what is not finite is written as `null`.
    Number(f64),
    /// Text.
    Text(String),
    /// A list.
    List(Vec<Json>),
    /// Keys with their values.
    Object(Vec<(String, Json)>),
}

impl Serialize for Json {
    fn serialize<S: Serializer>(&self, to: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Absent | Self::Null => to.serialize_unit(),
            Self::Bool(value) => to.serialize_bool(*value),
            Self::Count(value) => to.serialize_u64(*value),
            Self::Number(value) => to.serialize_f64(*value),
            Self::Text(value) => to.serialize_str(value),
            Self::List(values) => to.collect_seq(values),
            Self::Object(pairs) => {
                let mut map = to.serialize_map(None)?;
                for (key, value) in pairs.iter().filter(|(_, v)| *v != Self::Absent) {
                    map.serialize_entry(key, value)?;
                }
                map.end()
            }
        }
    }
}

/// A value, or nothing: the key is left out then. An empty list is nothing.
pub fn given(value: impl Into<Json>) -> Json {
    match value.into() {
        Json::Null => Json::Absent,
        Json::List(values) if values.is_empty() => Json::Absent,
        value => value,
    }
}

/// A list of what is made of each.
pub fn list<T>(all: impl IntoIterator<Item = T>, each: impl Fn(T) -> Json) -> Json {
    Json::List(all.into_iter().map(each).collect())
}

impl Json {
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

/// An object: `object! { "key": value, … }`.
macro_rules! object {
    ($($key:literal: $value:expr),* $(,)?) => {
        $crate::present::json::Json::Object(vec![
            $(($key.to_owned(), $crate::present::json::Json::from($value))),*
        ])
    };
}

pub(crate) use object;

impl From<bool> for Json {
    fn from(value: bool) -> Self {
        Self::Bool(value)
    }
}

impl From<u64> for Json {
    fn from(value: u64) -> Self {
        Self::Count(value)
    }
}

impl From<usize> for Json {
    fn from(value: usize) -> Self {
        Self::Count(value as u64)
    }
}

impl From<f64> for Json {
    fn from(value: f64) -> Self {
        Self::Number(value)
    }
}

impl From<&str> for Json {
    fn from(value: &str) -> Self {
        Self::Text(value.to_owned())
    }
}

impl From<&String> for Json {
    fn from(value: &String) -> Self {
        Self::Text(value.clone())
    }
}

impl From<String> for Json {
    fn from(value: String) -> Self {
        Self::Text(value)
    }
}

impl<T: Into<Self>> From<Option<T>> for Json {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Null, Into::into)
    }
}

impl<T: Clone + Into<Self>, const N: usize> From<[T; N]> for Json {
    fn from(values: [T; N]) -> Self {
        list(values, Into::into)
    }
}

impl<T: Clone + Into<Self>> From<&[T]> for Json {
    fn from(values: &[T]) -> Self {
        list(values.iter().cloned(), Into::into)
    }
}

impl<T: Clone + Into<Self>> From<&Vec<T>> for Json {
    fn from(values: &Vec<T>) -> Self {
        values.as_slice().into()
    }
}

impl<T: Into<Self>> From<Vec<T>> for Json {
    fn from(values: Vec<T>) -> Self {
        list(values, Into::into)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_object_keeps_its_order_and_leaves_out_what_is_not_given() {
        let none: Option<f64> = None;
        let inner = object! { "samples": 3_usize }.with(object! { "z": f64::NAN });
        let document = object! {
            "b": [1.0, 2.5], "a": none, "left out": given(none), "empty": given(Vec::<f64>::new()),
            "inner": inner, "text": "x\"y",
        };
        assert_eq!(
            serde_json::to_string(&document).expect("it can be written"),
            r#"{"b":[1.0,2.5],"a":null,"inner":{"samples":3,"z":null},"text":"x\"y"}"#
        );
    }
}
