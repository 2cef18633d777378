//! Where something unexplained is, in words: not by the names of columns, which are for files.

use super::numbers::trimmed;
use crate::model::shapes::Where;

impl Where {
    /// In words, as they stand behind "where".
    pub fn says(&self) -> String {
        match self {
            Self::Range { variable, from, to } => {
                let (name, unit) = in_words(variable);
                // Sides and reflectors are no range of numbers.
                let Some(unit) = unit else { return name };
                let [from, to] = [from, to].map(|value| format!("{}{unit}", trimmed(*value, 2)));
                format!("{name} from {from} to {to}")
            }
            Self::Cycles {
                variable,
                cycles_per_turn,
            } => {
                let (name, unit) = in_words(variable);
                // A joint that slides has no turns: its waves are counted by the metre.
                let per = if unit == Some("°") { "turn" } else { "metre" };
                format!(
                    "{} cycles per {per} of {name}",
                    trimmed(*cycles_per_turn, 2)
                )
            }
        }
    }
}

/// What a column holds, and the unit as it stands behind a number, where it holds numbers that say something.
fn in_words(column: &str) -> (String, Option<&'static str>) {
    let joint = |rest: &str, unit: &str| {
        let number = rest.strip_suffix(unit)?;
        let digits = !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit());
        digits.then(|| format!("joint {number}"))
    };
    if let Some(rest) = column.strip_prefix("speed") {
        for (ending, unit) in [("_deg_s", "°/s"), ("_mm_s", " mm/s")] {
            if let Some(joint) = joint(rest, ending) {
                return (format!("speed of {joint}"), Some(unit));
            }
        }
    }
    if let Some(rest) = column.strip_prefix('q') {
        for (ending, unit) in [("_deg", "°"), ("_mm", " mm")] {
            if let Some(joint) = joint(rest, ending) {
                return (joint, Some(unit));
            }
        }
    }
    if let Some(joint) = column.strip_prefix("dir").and_then(|rest| joint(rest, "")) {
        return (format!("side from which {joint} came"), None);
    }
    match column {
        "time_s" => ("time".to_owned(), Some(" s")),
        "load_kg" => ("load".to_owned(), Some(" kg")),
        "temperature_c" => ("temperature".to_owned(), Some(" °C")),
        "target" => ("one reflector against the others".to_owned(), None),
        other => (other.to_owned(), Some("")),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_place_is_said_without_names_of_columns() {
        let range = |variable: &str, from, to| {
            let variable = variable.to_owned();
            Where::Range { variable, from, to }.says()
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
            Where::Cycles {
                variable,
                cycles_per_turn,
            }
            .says()
        };
        assert_eq!(cycles("q1_deg"), "7.5 cycles per turn of joint 1");
        assert_eq!(cycles("q2_mm"), "7.5 cycles per metre of joint 2");
    }
}
