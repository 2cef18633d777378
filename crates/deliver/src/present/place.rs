//! Where something unexplained is, in words: not by the names of columns, which are for files.

use super::numbers::trimmed;
use crate::model::shapes::Where;
use crate::sessions::Group;
use crate::text::Text;

/// In words, as they stand behind "where".
pub(crate) fn described(place: &Where) -> Text {
    match place {
        Where::Range { variable, from, to } => {
            if let Some((group, name)) = of_a_group(variable) {
                return text!(
                    "{thing}, samples {from} to {to}",
                    thing = group.called(name),
                    from = trimmed(*from, 0),
                    to = trimmed(*to, 0)
                );
            }
            let (what, unit) = in_words(variable);
            // Sides and reflectors are no range of numbers.
            let Some(unit) = unit else { return what };
            let [from, to] = [from, to].map(|value| format!("{}{unit}", trimmed(*value, 2)));
            text!("{quantity} from {from} to {to}", quantity = what, from, to)
        }
        Where::Cycles {
            variable,
            cycles_per_turn,
        } => {
            let (what, unit) = in_words(variable);
            let cycles = trimmed(*cycles_per_turn, 2);
            // A joint that slides has no turns: its waves are counted by the metre.
            if unit == Some("°") {
                text!(
                    "{cycles} cycles per turn of {quantity}",
                    cycles,
                    quantity = what
                )
            } else {
                text!(
                    "{cycles} cycles per metre of {quantity}",
                    cycles,
                    quantity = what
                )
            }
        }
    }
}

/// The group of samples that stands in the place of a column's name, `target T1`: its ends are numbers of samples.
fn of_a_group(variable: &str) -> Option<(Group, &str)> {
    let (group, name) = variable.split_once(' ')?;
    Some((Group::of_name(group)?, name))
}

/// What a column holds, and the unit as it stands behind a number, where it holds numbers that say something.
fn in_words(column: &str) -> (Text, Option<&'static str>) {
    let joint = |rest: &str, unit: &str| -> Option<String> {
        let number = rest.strip_suffix(unit)?;
        let digits = !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit());
        digits.then(|| number.to_owned())
    };
    if let Some(rest) = column.strip_prefix("speed") {
        for (ending, unit) in [("_deg_s", "°/s"), ("_mm_s", " mm/s")] {
            if let Some(joint) = joint(rest, ending) {
                return (text!("speed of joint {joint}", joint), Some(unit));
            }
        }
    }
    if let Some(rest) = column.strip_prefix('q') {
        for (ending, unit) in [("_deg", "°"), ("_mm", " mm")] {
            if let Some(joint) = joint(rest, ending) {
                return (text!("joint {joint}", joint), Some(unit));
            }
        }
    }
    if let Some(joint) = column.strip_prefix("dir").and_then(|rest| joint(rest, "")) {
        return (text!("side from which joint {joint} came", joint), None);
    }
    match column {
        "time_s" => (text!("time"), Some(" s")),
        "load_kg" => (text!("load"), Some(" kg")),
        "temperature_c" => (text!("temperature"), Some(" °C")),
        "target" => (text!("one reflector against the others"), None),
        other => (Text::verbatim(other), Some("")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_is_said_without_names_of_columns() {
        let range = |variable: &str, from, to| {
            let variable = variable.to_owned();
            described(&Where::Range { variable, from, to }).to_string()
        };
        let cases = [
            (range("q1_deg", -31.592, 4.0), "joint 1 from −31.59° to 4°"),
            (
                range("q12_mm", 0.0, 250.5),
                "joint 12 from 0 mm to 250.5 mm",
            ),
            (range("time_s", 0.0, 90.0), "time from 0 s to 90 s"),
            (
                range("speed2_deg_s", -20.0, 20.0),
                "speed of joint 2 from −20°/s to 20°/s",
            ),
            (range("dir1", -1.0, 1.0), "side from which joint 1 came"),
            (
                range("target T 1", 3.0, 80.0),
                "target T 1, samples 3 to 80",
            ),
            (
                range("temperature_c", 20.0, 26.004),
                "temperature from 20 °C to 26 °C",
            ),
        ];
        for (said, expected) in cases {
            assert_eq!(said, expected);
        }
        let cycles = |variable: &str| {
            let variable = variable.to_owned();
            let cycles_per_turn = 7.5;
            described(&Where::Cycles {
                variable,
                cycles_per_turn,
            })
            .to_string()
        };
        assert_eq!(cycles("q1_deg"), "7.5 cycles per turn of joint 1");
        assert_eq!(cycles("q2_mm"), "7.5 cycles per metre of joint 2");
    }
}
