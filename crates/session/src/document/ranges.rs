//! Numbers beyond any robot's range are refused where they are read, each with its place.
//!
//! The key of a number carries its unit (`position_mm`, `from_deg`), and the unit its range: a length
//! of 10¹⁶⁰ mm is finite, but its square is not, and no fit could end well with it. One walk over a
//! part of a document checks all of its keys, so that no field can be forgotten.

use super::{Fields, Node, Path, Value};
use crate::text::Text;
use crate::units::{LARGEST_LENGTH_MM, LARGEST_NUMBER, LARGEST_TIME_S};

/// A smaller noise is no noise of an instrument, and the weight that it gives is too large to square.
pub const SMALLEST_SIGMA: f64 = 1e-15;

/// Endings of keys with the largest size of their numbers, longer endings first.
const RANGES: &[(&str, f64)] = &[
    ("_m_s2", 1e6),
    ("_mm", LARGEST_LENGTH_MM),
    ("_deg", LARGEST_NUMBER),
    ("_rad", LARGEST_NUMBER),
    ("_mrad", 1e9),
    ("_urad", 1e12),
    ("_deg_s", LARGEST_LENGTH_MM),
    ("_mm_s", LARGEST_LENGTH_MM),
    ("_kg", LARGEST_NUMBER),
    ("_c", 1e6),
    ("_s", LARGEST_TIME_S),
    ("_ppm", 1e12),
];

/// Keys without a unit in their name: places of targets, and limits of joints.
const NAMED: &[(&str, f64)] = &[
    ("targets", LARGEST_LENGTH_MM),
    ("limits", LARGEST_NUMBER),
    ("mm", LARGEST_LENGTH_MM),
];

/// Complains of every number in `node` that is out of the range of its unit.
pub fn check(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>) {
    let limit = match path {
        Path::Key(_, key) => of_key(key),
        Path::Root | Path::Index(..) => None,
    };
    walk(fields, node, path, limit);
}

fn of_key(key: &str) -> Option<Limit> {
    let named = NAMED.iter().find(|(own, _)| *own == key);
    let range = named.or_else(|| RANGES.iter().find(|(end, _)| key.ends_with(end)))?;
    Some(Limit {
        largest: range.1,
        smallest: if key.starts_with("sigma") || key.ends_with("_sigma_mm") {
            SMALLEST_SIGMA
        } else {
            0.0
        },
    })
}

#[derive(Clone, Copy)]
struct Limit {
    largest: f64,
    /// The smallest size of a number other than 0.
    smallest: f64,
}

impl Limit {
    /// What is wrong with a number, where anything is. What is not finite is refused elsewhere.
    fn refusal(self, value: f64) -> Option<Text> {
        let size = value.abs();
        if size.is_finite() && size > self.largest {
            return Some(text!(
                "a number of at most {most}",
                most = plain(self.largest)
            ));
        }
        let tiny = size > 0.0 && size < self.smallest;
        tiny.then(|| {
            text!(
                "a number of at least {least}",
                least = self.smallest.to_string()
            )
        })
    }
}

/// A number that may have hundreds of digits.
pub(crate) fn short(value: f64) -> String {
    if value.abs() < 1e15 && value.abs() > 1e-6 {
        return value.to_string();
    }
    format!("{value:e}")
}

/// A limit with its digits grouped.
fn plain(limit: f64) -> String {
    let mut text = format!("{limit}");
    let mut at = text.len();
    while at > 3 {
        at -= 3;
        text.insert(at, ' ');
    }
    text
}

fn walk(fields: &mut Fields<'_>, node: &Node, path: &Path<'_>, limit: Option<Limit>) {
    match &node.value {
        Value::Number(value) => {
            if let Some(expected) = limit.and_then(|limit| limit.refusal(*value)) {
                fields.error(node.at, path, Text::verbatim(short(*value)), expected);
            }
        }
        Value::Numbers(values) => {
            let Some(limit) = limit else { return };
            let mut each = values.iter().enumerate();
            let wrong = each.find_map(|(k, v)| Some((k, v, limit.refusal(*v)?)));
            if let Some((index, value, expected)) = wrong {
                let found = Text::verbatim(short(*value));
                fields.element_error(node.at, path, index, found, expected);
            }
        }
        Value::List(list) => {
            for (index, inner) in list.iter().enumerate() {
                walk(fields, inner, &path.index(index), limit);
            }
        }
        Value::Object(members) => {
            for member in members {
                let own = of_key(&member.key).or(limit);
                walk(fields, &member.node, &path.key(&member.key), own);
            }
        }
        _ => {}
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::Place;

    fn describe(text: &str) -> Vec<String> {
        let (mut fields, root) = Fields::open(Place::default(), text).unwrap();
        check(&mut fields, &root, &Path::Root);
        fields.findings.iter().map(ToString::to_string).collect()
    }

    #[test]
    fn a_number_has_the_range_of_its_unit_wherever_it_is() {
        let sound = r#"{"a_mm": 1e7, "b": {"sigma_mm": [0.01, 0, 3]}, "axis": [1e300, 0, 0], "seed": 1e15,
            "joints": [{"limits": [-360, 360], "mass_kg": 4.0}], "targets": {"T1": [0, -9e6, 1]}}"#;
        assert_eq!(describe(sound), [""; 0]);
        for (text, place) in [
            (r#"{"a_mm": -1e160}"#, "a_mm"),
            (r#"{"b": {"position_mm": [1, 2e7, 3]}}"#, "b.position_mm[1]"),
            (r#"{"targets": {"T1": [0, 1e8, 0]}}"#, "targets.T1[1]"),
            (
                r#"{"joints": [{"limits": [-1e7, 3]}]}"#,
                "joints[0].limits[0]",
            ),
            (r#"{"from_deg": 1000001}"#, "from_deg"),
            (r#"{"sigma_mm": 1e-200}"#, "sigma_mm"),
        ] {
            let found = describe(text);
            assert_eq!(found.len(), 1, "{text}: {found:?}");
            assert!(found[0].contains(place), "{text}: {found:?}");
        }
        let found = describe(r#"{"a_mm": 1e160}"#);
        assert!(
            found[0].ends_with("a number of at most 10 000 000"),
            "{found:?}"
        );
    }
}
