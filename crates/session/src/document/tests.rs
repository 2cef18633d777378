use proptest::prelude::*;

use super::*;
use crate::progress::{Progress, ReadError, unwatched};

fn whole(source: &Source<'_>) -> Result<Node, ReadError> {
    parse(source, Progress::new(&unwatched).whole())
}

fn read(text: &str) -> Result<Node, String> {
    let source = Source::new(None, text);
    whole(&source).map_err(|diagnostic| diagnostic.to_string())
}

#[test]
fn numbers_go_straight_into_a_column() {
    let node = read("[1, -2.5, null, 3e2]").unwrap();
    let Value::Numbers(values) = node.value else {
        panic!("{node:?}")
    };
    assert_eq!((values[0], values[1], values[3]), (1.0, -2.5, 300.0));
    assert!(values[2].is_nan());
}

#[test]
fn values_know_where_they_start() {
    let text = "{\n  \"a\": [true, \"x\"],\n  \"b\": [1, 22,\n 333]\n}";
    let source = Source::new(None, text);
    let Value::Object(members) = whole(&source).unwrap().value else {
        panic!()
    };
    assert_eq!(
        source.place(members[0].node.at).to_string(),
        "line 2, column 8"
    );
    let third = element_offset(&source, members[1].node.at, 2);
    assert_eq!(source.place(third).to_string(), "line 4, column 2");
}

#[test]
fn a_syntax_error_says_where_what_and_what_instead() {
    for (text, says) in [
        (
            "",
            "line 1, column 1: the end of the file; expected a JSON value",
        ),
        (
            "{\"a\": 1",
            "line 1, column 8: the end of the file; expected ',' or '}'",
        ),
        (
            "{\"a\" 1}",
            "line 1, column 6: '1'; expected ':' after the key",
        ),
        (
            "{\"a\" ",
            "line 1, column 6: the end of the file; expected ':' after the key",
        ),
        ("[1, 2,]", "line 1, column 7: ']'; expected a JSON value"),
        ("[1 2]", "line 1, column 4: '2'; expected ',' or ']'"),
        (
            "{a: 1}",
            "line 1, column 2: 'a'; expected a key in double quotes",
        ),
        ("[NaN]", "line 1, column 2: 'NaN'; expected a JSON value"),
        ("01", "line 1, column 1: '01'; expected a JSON number"),
        ("[1.]", "line 1, column 2: '1.'; expected a JSON number"),
        ("[+1]", "line 1, column 2: '+1'; expected a JSON value"),
        ("\"a\nb\"", "line 1, column 3: a control character"),
        ("\"ab", "line 1, column 1: a quote that is not closed"),
        ("\"\\x\"", "line 1, column 2: '\\x\"'; expected an escape"),
        ("\"\\ud800\"", "expected an escape"),
        (
            "{} {}",
            "line 1, column 4: '{'; expected the end of the document",
        ),
        ("{\"a\":1,\"a\":2}", "line 1, column 8: 'a' a second time"),
    ] {
        let error = read(text).expect_err(text);
        assert!(error.contains(says), "{text}: {error}");
    }
}

#[test]
fn nesting_ends_before_the_stack_does() {
    let error = read(&"[".repeat(1_000_000)).unwrap_err();
    assert!(error.contains("more than 64 levels"), "{error}");
    for inner in ["", "1", "null", "\"\""] {
        let nested = |levels| format!("{}{inner}{}", "[".repeat(levels), "]".repeat(levels));
        assert!(read(&nested(64)).is_ok(), "{inner}");
        assert!(read(&nested(65)).is_err(), "{inner}");
    }
}

#[test]
fn an_overflowing_number_is_not_lost() {
    assert_eq!(read("1e999").unwrap().value, Value::Number(f64::INFINITY));
    assert_eq!(
        read("1e999").unwrap().value.describe(),
        text!("a number that overflows")
    );
}

/// The same document according to `serde_json`.
fn same(node: &Node, other: &serde_json::Value) -> bool {
    use serde_json::Value as Other;
    match (&node.value, other) {
        (Value::Null, Other::Null) => true,
        (Value::Bool(a), Other::Bool(b)) => a == b,
        (Value::Number(a), Other::Number(b)) => b
            .as_f64()
            .is_some_and(|b| a.to_bits() == b.to_bits() || *a == b),
        (Value::Text(a), Other::String(b)) => a == b,
        (Value::Numbers(a), Other::Array(b)) => {
            a.len() == b.len()
                && a.iter()
                    .zip(b)
                    .all(|(a, b)| b.as_f64().map_or(a.is_nan(), |b| *a == b))
        }
        (Value::List(a), Other::Array(b)) => {
            a.len() == b.len() && a.iter().zip(b).all(|(a, b)| same(a, b))
        }
        (Value::Object(a), Other::Object(b)) => {
            a.len() == b.len()
                && a.iter()
                    .all(|member| b.get(&member.key).is_some_and(|b| same(&member.node, b)))
        }
        _ => false,
    }
}

fn any_json() -> impl Strategy<Value = serde_json::Value> {
    let leaf = prop_oneof![
        Just(serde_json::Value::Null),
        any::<bool>().prop_map(Into::into),
        any::<i64>().prop_map(Into::into),
        any::<f64>().prop_map(Into::into),
        (-1e3..1e3f64).prop_map(Into::into),
        "\\PC*".prop_map(Into::into),
        "[\\x00-\\x7f]{0,6}".prop_map(Into::into),
    ];
    leaf.prop_recursive(4, 40, 6, |inner| {
        prop_oneof![
            prop::collection::vec(inner.clone(), 0..6).prop_map(Into::into),
            prop::collection::btree_map("[a-c\"\\\\é]{0,3}", inner, 0..6)
                .prop_map(|map| serde_json::Value::Object(map.into_iter().collect())),
        ]
    })
}

proptest! {
    #[test]
    fn documents_read_as_serde_json_reads_them(document in any_json(), pretty in any::<bool>()) {
        let text = if pretty {
            serde_json::to_string_pretty(&document).unwrap()
        } else {
            document.to_string()
        };
        let node = read(&text).map_err(TestCaseError::fail)?;
        prop_assert!(same(&node, &document), "{node:?} {document:?}");
    }

    #[test]
    fn no_text_is_accepted_that_serde_json_refuses(text in "[\\[\\]{},:\"a01.eE+\\- \\\\un]{0,12}") {
        let other = serde_json::from_str::<serde_json::Value>(&text);
        match (read(&text), other) {
            (Ok(node), Ok(document)) => prop_assert!(same(&node, &document)),
            (Err(_), Err(_)) => {}
            // Stricter: keys that recur. More patient: numbers that overflow.
            (Err(error), Ok(_)) => prop_assert!(error.contains("a second time"), "{text}: {error}"),
            (Ok(node), Err(_)) => prop_assert!(format!("{node:?}").contains("inf"), "{text}: {node:?}"),
        }
    }
}
