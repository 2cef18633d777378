//! The file: an object with `id`, `drive_mode`, `homing_offset`, `range_min` and `range_max` for
//! each motor.

use serde::Serialize;
use serde::ser::Serializer;

use crate::diagnostic::{Place, Rejected};
use crate::document::object::{Kind, Object};
use crate::document::{Fields, Member, Node, Path};
use crate::sessions::files::open::as_text;

pub(super) const TICKS_PER_TURN: i64 = 4096;

#[derive(Debug, Clone, Default, PartialEq, Eq, Serialize)]
pub(super) struct Motor {
    #[serde(skip)]
    pub(super) name: String,
    pub(super) id: i64,
    pub(super) drive_mode: i64,
    pub(super) homing_offset: i64,
    pub(super) range_min: i64,
    pub(super) range_max: i64,
}

/// How many motors a calibration has: whether this can be read as one.
///
/// # Errors
/// As an export with this reference: what is no calibration, with line, column and what was
/// expected.
pub fn lerobot_calibration(bytes: &[u8], name: &str) -> Result<usize, Rejected> {
    Ok(read_calibration(bytes, name)?.len())
}

/// The motors of a file, in its order.
pub(super) fn read_calibration(bytes: &[u8], name: &str) -> Result<Vec<Motor>, Rejected> {
    let place = Place::file(name);
    let text = as_text(bytes, &place)?;
    let (mut fields, root) = Fields::open(place, text)?;
    let motors = motors(&mut fields, &root);
    fields.finish(motors)
}

fn motors(fields: &mut Fields<'_>, root: &Node) -> Option<Vec<Motor>> {
    let expected =
        phrase!("a motor calibration of LeRobot: an object with one motor for each name");
    let mut at = fields.at(root, &Path::Root, expected);
    let members = at.members()?;
    if members.is_empty() {
        return at.wrong();
    }
    let motor = |member: &Member| {
        let expected = phrase!("an object with id, homing_offset, …");
        let path = &Path::Root.key(&member.key);
        let mut at = at.fields.at(&member.node, path, expected);
        let motor = at.object(Motor::default(), motor)?;
        let name = member.key.clone();
        Some(Motor { name, ..motor })
    };
    let motors: Vec<Option<Motor>> = members.iter().map(motor).collect();
    motors.into_iter().collect()
}

fn motor(o: &mut Object<'_, '_>, own: &mut Motor) {
    o.required("id", &mut own.id, &WHOLE);
    o.required("drive_mode", &mut own.drive_mode, &WHOLE);
    o.required("homing_offset", &mut own.homing_offset, &WHOLE);
    o.required("range_min", &mut own.range_min, &WHOLE);
    o.required("range_max", &mut own.range_max, &WHOLE);
    let (range_min, range_max) = (own.range_min, own.range_max);
    if o.has_read_well() && range_min >= range_max {
        let found = text!(
            "a range from {from} to {to}",
            from = range_min,
            to = range_max
        );
        let expected = phrase!("a range from the smaller to the larger value");
        o.error(found, expected);
    }
}

/// A whole number that any servo may have.
const WHOLE: Kind<i64> = Kind {
    expected: phrase!("a whole number"),
    #[allow(clippy::cast_possible_truncation, reason = "a whole number below 10⁹")]
    read: |at| {
        let whole = |value: f64| value.fract() == 0.0 && value.abs() < 1e9;
        at.number(whole).map(|value| value as i64)
    },
    write: |value| (*value as f64).into(),
};

struct CalibrationJson<'a>(&'a [Motor]);

impl Serialize for CalibrationJson<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|motor| (&motor.name, motor)))
    }
}

/// The file of these motors, as `LeRobot` writes it.
pub(super) fn write(motors: &[Motor]) -> String {
    let mut bytes = Vec::new();
    let layout = serde_json::ser::PrettyFormatter::with_indent(b"    ");
    let mut serializer = serde_json::Serializer::with_formatter(&mut bytes, layout);
    CalibrationJson(motors)
        .serialize(&mut serializer)
        .expect("writing to memory does not fail");
    bytes.push(b'\n');
    String::from_utf8(bytes).expect("JSON is UTF-8")
}

#[cfg(test)]
mod tests {
    use super::*;

    const FILE: &str = r#"{
    "shoulder_pan": {"id": 1, "drive_mode": 0, "homing_offset": -14, "range_min": 1015, "range_max": 3128},
    "gripper": {"id": 6, "drive_mode": 0, "homing_offset": 1407, "range_min": 2031, "range_max": 3476}
}"#;

    #[test]
    fn a_calibration_is_read_and_written_with_its_motors_in_order() {
        let motors = read_calibration(FILE.as_bytes(), "arm.json").unwrap();
        assert_eq!(
            [&*motors[0].name, &*motors[1].name],
            ["shoulder_pan", "gripper"]
        );
        assert_eq!(motors[0].homing_offset, -14);
        let written = write(&motors);
        assert_eq!(read_calibration(written.as_bytes(), "x").unwrap(), motors);
        assert!(
            written.contains("    \"gripper\": {\n        \"id\": 6,"),
            "{written}"
        );
        let with_mark = [b"\xef\xbb\xbf", FILE.replace('\n', "\r\n").as_bytes()].concat();
        assert_eq!(read_calibration(&with_mark, "x").unwrap(), motors);
    }

    #[test]
    fn what_is_no_calibration_is_refused_with_its_place() {
        for (from, to, part) in [
            ("\"id\": 1, ", "", "arm.json, line 2, column 21"),
            ("-14", "-14.5", "a whole number"),
            ("1015", "\"1015\"", "shoulder_pan.range_min"),
            ("1015", "4000", "from the smaller"),
            ("{\"id\": 6", "[{\"id\": 6", "line 4, column 1"),
        ] {
            let wrong = FILE.replacen(from, to, 1);
            let message = read_calibration(wrong.as_bytes(), "arm.json")
                .unwrap_err()
                .to_string();
            assert!(
                message.contains(part) && message.contains("expected"),
                "{message}"
            );
        }
        for wrong in ["", "{}", "[]", "null", "{\"a\": 1}"] {
            assert!(
                lerobot_calibration(wrong.as_bytes(), "x").is_err(),
                "{wrong}"
            );
        }
    }
}
