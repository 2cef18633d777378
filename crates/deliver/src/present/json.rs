//! JSON documents as they are written: a key stands once, where its value is computed, and an object
//! keeps the order of its keys.

use crate::document::Member;
pub use crate::document::Value as Json;
pub use crate::document::object;

/// A value, or nothing: the key is left out then. An empty list is nothing.
pub fn optional(value: impl Into<Json>) -> Json {
    match value.into() {
        Json::Null => Json::Absent,
        Json::List(values) if values.is_empty() => Json::Absent,
        Json::Numbers(values) if values.is_empty() => Json::Absent,
        value => value,
    }
}

/// An object with keys that are computed.
pub fn keyed(pairs: impl IntoIterator<Item = (impl Into<String>, Json)>) -> Json {
    let member = |(key, value): (_, Json)| Member::new(key, value);
    Json::Object(pairs.into_iter().map(member).collect())
}

/// A list of what is made of each.
pub fn list<T>(all: impl IntoIterator<Item = T>, each: impl Fn(T) -> Json) -> Json {
    all.into_iter().map(each).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_object_keeps_its_order_and_leaves_out_what_is_not_given() {
        let none: Option<f64> = None;
        let inner = object! { "samples": 3_usize }.with(object! { "z": f64::NAN });
        let document = object! {
            "b": [1.0, 2.5], "a": none, "left out": optional(none), "empty": optional(Vec::<f64>::new()),
            "inner": inner, "text": "x\"y",
        };
        assert_eq!(
            serde_json::to_string(&document).expect("it can be written"),
            r#"{"b":[1.0,2.5],"a":null,"inner":{"samples":3,"z":null},"text":"x\"y"}"#
        );
    }
}
