//! The file: an object with `id`, `drive_mode`, `homing_offset`, `range_min` and `range_max` for
//! each motor.

use serde::Serialize;
use serde::ser::{SerializeMap, Serializer};

use crate::diagnostic::{Place, Rejected};
use crate::document::{Fields, Member, Node, Path, Value};
use crate::sessions::files::open::as_text;

pub(super) const TICKS_PER_TURN: i64 = 4096;

#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Motor {
    pub(super) name: String,
    pub(super) id: i64,
    pub(super) drive_mode: i64,
    pub(super) homing_offset: i64,
    pub(super) range_min: i64,
    pub(super) range_max: i64,
}

const KEYS: [&str; 5] = [
    "id",
    "drive_mode",
    "homing_offset",
    "range_min",
    "range_max",
];

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
    let members = fields.object(root, &Path::Root, expected)?;
    if members.is_empty() {
        fields.mismatch(root, &Path::Root, expected);
        return None;
    }
    let motors: Vec<Option<Motor>> = members.iter().map(|member| motor(fields, member)).collect();
    motors.into_iter().collect()
}

fn motor(fields: &mut Fields<'_>, member: &Member) -> Option<Motor> {
    let path = &Path::Root.key(&member.key);
    let node = &member.node;
    let members = fields.object(node, path, text!("an object with id, homing_offset, …"))?;
    fields.unknown_keys(members, path, &KEYS);
    let numbers = KEYS.map(|key| {
        let expected = phrase!("a whole number");
        let node = fields.required(members, node.at, path, key, expected)?;
        let number = whole(node);
        if number.is_none() {
            fields.mismatch(node, &path.key(key), expected);
        }
        number
    });
    let [id, drive_mode, homing_offset, range_min, range_max] = numbers;
    let motor = Motor {
        name: member.key.clone(),
        id: id?,
        drive_mode: drive_mode?,
        homing_offset: homing_offset?,
        range_min: range_min?,
        range_max: range_max?,
    };
    if motor.range_min >= motor.range_max {
        let found = text!(
            "a range from {range_min} to {range_max}",
            range_min = motor.range_min,
            range_max = motor.range_max
        );
        let expected = phrase!("a range from the smaller to the larger value");
        fields.error(node.at, path, found, expected);
        return None;
    }
    Some(motor)
}

fn whole(node: &Node) -> Option<i64> {
    /// Far beyond any servo.
    const MOST: f64 = 1e9;
    match node.value {
        #[allow(clippy::cast_possible_truncation, reason = "a whole number below 10⁹")]
        Value::Number(value) if value.fract() == 0.0 && value.abs() < MOST => Some(value as i64),
        _ => None,
    }
}

struct CalibrationJson<'a>(&'a [Motor]);

#[derive(Serialize)]
struct MotorJson {
    id: i64,
    drive_mode: i64,
    homing_offset: i64,
    range_min: i64,
    range_max: i64,
}

impl Serialize for CalibrationJson<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(Some(self.0.len()))?;
        for motor in self.0 {
            let twin = MotorJson {
                id: motor.id,
                drive_mode: motor.drive_mode,
                homing_offset: motor.homing_offset,
                range_min: motor.range_min,
                range_max: motor.range_max,
            };
            map.serialize_entry(&motor.name, &twin)?;
        }
        map.end()
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
