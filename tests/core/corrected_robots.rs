//! Corrected robots out: models whose robots `tests/reference/robots_out.py` worked out with numpy,
//! exported to every description, read back here by readers that share no code with the program, and
//! by `mujoco`, `yourdfpy` and `pinocchio` there (`tests/data/robots/verdict.json`).

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::path::{Path, PathBuf};

use nalgebra::{Isometry3, Point3, Quaternion, Translation3, Unit, UnitQuaternion, Vector3};
use serde_json::Value;
use truepose::compensation::Compensation;
use truepose::compensation::VerifiedCalibration;
use truepose::effects::{Inputs, JointValues};
use truepose::export::{Export, ExportError, Job, Motors, Options, Reference, Zeros, find};
use truepose::fit::{DEFAULT_EFFECTS, identify_exact};
use truepose::kinematics::{DhConvention, JointKind};
use truepose::pipeline::load_model;

type Pose = Isometry3<f64>;

/// What 1e-9 m is in mm.
const NEAR_MM: f64 = 1e-6;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/robots")
}

fn model(name: &str) -> VerifiedCalibration {
    load_model(folder().join(format!("{name}.model.json"))).unwrap()
}

fn made(
    calibration: &VerifiedCalibration,
    to: &str,
    options: Options,
) -> Result<Export, ExportError> {
    let job = Job {
        options,
        ..Job::new(calibration, "out")
    };
    find(to).unwrap().exporter.export(&job)
}

fn text(export: &Export, ending: &str) -> String {
    let document = export
        .documents
        .iter()
        .find(|d| d.name == format!("out{ending}"));
    String::from_utf8(document.unwrap().bytes.clone()).unwrap()
}

fn json(text: &str) -> Value {
    serde_json::from_str(text).unwrap()
}

/// Poses and where numpy has the tool then.
fn truth(name: &str) -> Vec<(Vec<f64>, Vector3<f64>, Vector3<f64>)> {
    let all = json(&std::fs::read_to_string(folder().join("out.json")).unwrap());
    let rows =
        |key: &str| -> Vec<Vec<f64>> { serde_json::from_value(all[name][key].clone()).unwrap() };
    let (q, p, z) = (rows("q"), rows("position_mm"), rows("z"));
    let vector = |v: &Vec<f64>| Vector3::from_column_slice(v);
    q.into_iter()
        .zip(p.iter().zip(&z))
        .map(|(q, (p, z))| (q, vector(p), vector(z)))
        .collect()
}

fn turn(axis: Vector3<f64>, by: f64) -> Pose {
    let rotation = UnitQuaternion::from_axis_angle(&Unit::new_normalize(axis), by);
    Pose::from_parts(Translation3::identity(), rotation)
}

fn frame(value: &Value) -> Pose {
    let p: [f64; 3] = serde_json::from_value(value["position_mm"].clone()).unwrap();
    let q: [f64; 4] = serde_json::from_value(value["quaternion_wxyz"].clone()).unwrap();
    let rotation = UnitQuaternion::new_normalize(Quaternion::new(q[0], q[1], q[2], q[3]));
    Pose::from_parts(Vector3::from(p).into(), rotation)
}

/// The attribute of a line of XML.
fn attribute<'a>(line: &'a str, name: &str) -> Option<&'a str> {
    let (_, rest) = line.split_once(&format!(" {name}=\""))?;
    rest.split_once('"').map(|(value, _)| value)
}

fn numbers(text: &str) -> Vec<f64> {
    text.split_whitespace()
        .map(|x| x.parse().unwrap())
        .collect()
}

fn vector(text: &str) -> Vector3<f64> {
    Vector3::from_column_slice(&numbers(text))
}

/// A chain as a list of what happens from base to tool; lengths in mm.
enum Link {
    Fixed(Pose),
    Turns(Vector3<f64>),
    Slides(Vector3<f64>),
}

fn tool_of(chain: &[Link], q: &[f64]) -> Pose {
    let mut values = q.iter();
    chain.iter().fold(Pose::identity(), |before, link| {
        before
            * match link {
                Link::Fixed(pose) => *pose,
                Link::Turns(axis) => turn(*axis, *values.next().unwrap()),
                Link::Slides(axis) => Pose::from(axis * *values.next().unwrap()),
            }
    })
}

fn by_urdf(text: &str) -> Vec<Link> {
    let mut chain = Vec::new();
    let mut kind = String::new();
    for line in text.lines() {
        if line.contains("<joint") {
            attribute(line, "type").unwrap().clone_into(&mut kind);
        } else if line.contains("<origin") {
            let place = vector(attribute(line, "xyz").unwrap()) * 1e3;
            let rpy = vector(attribute(line, "rpy").unwrap());
            let [x, y, z] = [Vector3::x(), Vector3::y(), Vector3::z()];
            let rotation = turn(z, rpy.z) * turn(y, rpy.y) * turn(x, rpy.x);
            chain.push(Link::Fixed(Pose::from(place) * rotation));
        } else if line.contains("<axis") {
            let axis = vector(attribute(line, "xyz").unwrap());
            chain.push(match kind.as_str() {
                "prismatic" => Link::Slides(axis),
                _ => Link::Turns(axis),
            });
        }
    }
    chain
}

fn by_mjcf(text: &str) -> Vec<Link> {
    let mut chain = Vec::new();
    for line in text.lines() {
        if let (Some(pos), Some(quat)) = (attribute(line, "pos"), attribute(line, "quat")) {
            let q = numbers(quat);
            let rotation = UnitQuaternion::new_normalize(Quaternion::new(q[0], q[1], q[2], q[3]));
            let place = vector(pos) * 1e3;
            chain.push(Link::Fixed(Pose::from_parts(place.into(), rotation)));
        } else if line.contains("<joint") {
            let axis = vector(attribute(line, "axis").unwrap());
            chain.push(match attribute(line, "type").unwrap() {
                "slide" => Link::Slides(axis),
                _ => Link::Turns(axis),
            });
        }
    }
    chain
}

/// Rows behind `base`; the tool is where the file says it is at home.
fn by_rows(text: &str) -> Vec<Link> {
    let robot = json(text);
    let mut chain = vec![Link::Fixed(frame(&robot["base"]))];
    for row in robot["dh"].as_array().unwrap() {
        let number = |key: &str| row[key].as_f64().unwrap();
        let (theta, alpha) = (
            number("theta_deg").to_radians(),
            number("alpha_deg").to_radians(),
        );
        let place = turn(Vector3::z(), theta) * Pose::translation(0.0, 0.0, number("d_mm"));
        let link = Pose::translation(number("a_mm"), 0.0, 0.0) * turn(Vector3::x(), alpha);
        let moves = match row["kind"].as_str().unwrap() {
            "prismatic" => Link::Slides(Vector3::z()),
            _ => Link::Turns(Vector3::z()),
        };
        match row["convention"].as_str().unwrap() {
            "standard" => chain.extend([moves, Link::Fixed(place * link)]),
            _ => chain.extend([Link::Fixed(link), moves, Link::Fixed(place)]),
        }
    }
    let home = vec![0.0; robot["dh"].as_array().unwrap().len()];
    let behind = tool_of(&chain, &home).inverse() * frame(&robot["tool"]);
    chain.push(Link::Fixed(behind));
    chain
}

fn by_yaml(text: &str, sidecar: &Value) -> Vec<Link> {
    let mut chain = Vec::new();
    let mut numbers = Vec::new();
    for line in text.lines() {
        let value = line.split_once(": ").map(|(_, value)| value);
        if let Some(Ok(value)) = value.map(str::parse::<f64>) {
            numbers.push(value);
        }
        if let [x, y, z, roll, pitch, yaw] = numbers[..] {
            let [ex, ey, ez] = [Vector3::x(), Vector3::y(), Vector3::z()];
            let rotation = turn(ez, yaw) * turn(ey, pitch) * turn(ex, roll);
            let place = Pose::translation(x * 1e3, y * 1e3, z * 1e3);
            chain.extend([Link::Fixed(place * rotation), Link::Turns(Vector3::z())]);
            numbers.clear();
        }
    }
    assert_eq!(chain.len(), 12, "{text}");
    chain.push(Link::Fixed(frame(&sidecar["frames"]["tool"])));
    chain
}

fn chain_of(export: &Export, to: &str) -> Vec<Link> {
    let file = text(export, "");
    match to {
        "urdf" => by_urdf(&file),
        "mjcf" => by_mjcf(&file),
        "dh" => by_rows(&file),
        _ => by_yaml(&file, &json(&text(export, ".meta.json"))),
    }
}

/// The largest distance of a chain to the truth, mm, and of its z axis; values of the joints plus
/// what the controller takes.
fn farthest(name: &str, chain: &[Link], taken: &[f64]) -> [f64; 2] {
    let mut far = [0.0_f64; 2];
    for (q, position, z) in truth(name) {
        let q: Vec<f64> = q
            .iter()
            .enumerate()
            .map(|(k, q)| q + taken.get(k).unwrap_or(&0.0))
            .collect();
        let tool = tool_of(chain, &q);
        far[0] = far[0].max((tool.translation.vector - position).norm());
        far[1] = far[1].max((tool.rotation * Vector3::z() - z).norm());
    }
    far
}

const EXACT: [(&str, &str); 12] = [
    ("ur", "urdf"),
    ("ur", "mjcf"),
    ("ur", "ur-kinematics"),
    ("wrist", "urdf"),
    ("wrist", "mjcf"),
    ("wrist", "ur-kinematics"),
    ("skew", "urdf"),
    ("skew", "mjcf"),
    ("skew", "dh"),
    ("so101", "urdf"),
    ("so101", "mjcf"),
    ("ur", "urdf"),
];

#[test]
fn every_description_puts_the_tool_where_numpy_has_it() {
    for (name, to) in EXACT {
        let calibration = model(name);
        let export = made(&calibration, to, Options::default()).unwrap();
        let [mm, z] = farthest(name, &chain_of(&export, to), &[]);
        assert!(mm < NEAR_MM && z < 1e-9, "{name} {to}: {mm} mm, {z}");
        let sidecar = json(&text(&export, ".meta.json"));
        assert_eq!(sidecar["level"], "links");
        assert_eq!(sidecar["zeros"]["taken_by"], "origins");
        assert!(
            sidecar["leaves"]["rms_mm"].as_f64().unwrap() < NEAR_MM,
            "{name} {to}"
        );
        assert!(sidecar["left_out"].as_array().unwrap().is_empty());
    }
}

#[test]
fn the_verdict_of_other_peoples_programs_is_on_record() {
    let verdict = std::fs::read_to_string(folder().join("verdict.json")).unwrap();
    let verdict = json(&verdict);
    let verdict = verdict.as_object().unwrap();
    let by = |reader: &str| {
        verdict
            .iter()
            .filter(|(key, _)| key.ends_with(reader))
            .count()
    };
    assert!(by("mujoco") == 4 && by("yourdfpy") == 4 && by("pinocchio") == 4);
    for (key, value) in verdict {
        // Rows of parallel axes cannot say everything; what they leave is judged below.
        let parallel = key.contains(" dh ") && !key.starts_with("skew");
        let mm = value["largest_mm"].as_f64().unwrap();
        assert!(mm < if parallel { 10.0 } else { NEAR_MM }, "{key}: {mm}");
    }
}

#[test]
fn a_zero_offset_is_in_the_file_or_left_to_the_controller_and_never_in_both() {
    for (name, to) in [
        ("ur", "urdf"),
        ("skew", "mjcf"),
        ("skew", "dh"),
        ("ur", "ur-kinematics"),
    ] {
        let calibration = model(name);
        let options = Options {
            zeros: Some(Zeros::Controller),
            ..Options::default()
        };
        let export = made(&calibration, to, options).unwrap();
        let sidecar = json(&text(&export, ".meta.json"));
        assert_eq!(sidecar["zeros"]["taken_by"], "controller");
        let joints = sidecar["zeros"]["joints"].as_array().unwrap();
        let kinds = &calibration.model.robot.joints;
        let taken: Vec<f64> = joints
            .iter()
            .zip(kinds)
            .map(|(zero, joint)| {
                joint
                    .kind
                    .to_base_units(zero["in_the_controller"].as_f64().unwrap())
            })
            .collect();
        assert!(joints.iter().all(|zero| zero["in_the_file"] == 0.0));
        let chain = chain_of(&export, to);
        let [mm, _] = farthest(name, &chain, &taken);
        assert!(mm < NEAR_MM, "{name} {to}: {mm}");
        let [without, _] = farthest(name, &chain, &[]);
        assert!(without > 0.5, "{name} {to}: {without}");
        // And the truth of the model: how far each joint stands beyond its command.
        let read: Value =
            json(&std::fs::read_to_string(folder().join(format!("{name}.model.json"))).unwrap());
        let first = &read["effects"][0]["parameters"]["offset_deg"];
        let said = joints[0]["in_the_controller"].as_f64().unwrap();
        assert!((first.as_f64().unwrap() - said).abs() < 1e-9);
    }
}

#[test]
fn rows_come_out_as_they_came_in_and_say_what_parallel_axes_leave() {
    for (name, convention) in [
        ("ur", "standard"),
        ("wrist", "modified"),
        ("so101", "standard"),
    ] {
        let calibration = model(name);
        let export = made(&calibration, "dh", Options::default()).unwrap();
        let robot = json(&text(&export, ""));
        assert_eq!(robot["dh"][0]["convention"], convention);
        let sidecar = json(&text(&export, ".meta.json"));
        let [mm, _] = farthest(name, &by_rows(&text(&export, "")), &[]);
        let said = sidecar["leaves"]["max_mm"].as_f64().unwrap();
        let nominal = sidecar["leaves"]["nominal_rms_mm"].as_f64().unwrap();
        assert!(mm > 1e-3 && mm < 2.0 * said + 0.1, "{name}: {mm} {said}");
        assert!(said < 0.4 * nominal, "{name}: {said} of {nominal}");
        let cannot = sidecar["cannot_say"].to_string();
        assert!(cannot.contains("parallel axes"), "{cannot}");
        // Near the rows of the drawing, not somewhere else that happens to fit.
        let nominal_rows: Value =
            json(&std::fs::read_to_string(folder().join(format!("{name}.model.json"))).unwrap());
        for (row, drawn) in robot["dh"]
            .as_array()
            .unwrap()
            .iter()
            .zip(nominal_rows["robot"]["source"]["dh"].as_array().unwrap())
        {
            for (key, most) in [
                ("a_mm", 3.0),
                ("d_mm", 3.0),
                ("alpha_deg", 1.0),
                ("theta_deg", 3.0),
            ] {
                let off = row[key].as_f64().unwrap() - drawn[key].as_f64().unwrap();
                assert!(off.abs() < most, "{name} {key}: {row} {drawn}");
            }
        }
    }
    let other = Options {
        convention: Some(DhConvention::Modified),
        ..Options::default()
    };
    let export = made(&model("skew"), "dh", other).unwrap();
    assert_eq!(json(&text(&export, ""))["dh"][0]["convention"], "modified");
    let [mm, _] = farthest("skew", &by_rows(&text(&export, "")), &[]);
    assert!(mm < NEAR_MM, "{mm}");
}

#[test]
fn the_program_reads_its_own_descriptions_back() {
    use truepose::kinematics::{robot_from_mjcf, robot_from_urdf};
    for name in ["ur", "wrist", "skew", "so101"] {
        let calibration = model(name);
        for to in ["urdf", "mjcf", "dh"] {
            let export = made(&calibration, to, Options::default()).unwrap();
            let file = text(&export, "");
            let robot = match to {
                "urdf" => robot_from_urdf(&file, Path::new("x"), "base_link", "tool0").unwrap(),
                "mjcf" => robot_from_mjcf(&file, Path::new("x"), "base_link", "tool0").unwrap(),
                _ => {
                    truepose::sessions::parse_robot(file.as_bytes())
                        .unwrap()
                        .robot
                }
            };
            let chain = chain_of(&export, to);
            for (q, ..) in truth(name) {
                let off = robot.base_from_tool(&q).translation.vector
                    - tool_of(&chain, &q).translation.vector;
                assert!(off.norm() < NEAR_MM, "{name} {to}");
            }
            let kept = robot.joints.iter().zip(&calibration.model.robot.joints);
            for (joint, nominal) in kept {
                assert_eq!(joint.kind, nominal.kind);
                let (a, b) = (joint.limits.unwrap(), nominal.limits.unwrap());
                assert!((a.from - b.from).abs() < 1e-9 && (a.to - b.to).abs() < 1e-9);
            }
        }
    }
}

#[test]
fn frames_and_zeros_say_base_tool_and_offsets_in_every_makers_terms() {
    for name in ["ur", "wrist", "skew"] {
        let calibration = model(name);
        let export = made(&calibration, "frames", Options::default()).unwrap();
        let file = text(&export, "");
        let row = |start: &str| -> Vec<f64> {
            let line = file.lines().find(|line| line.starts_with(start)).unwrap();
            line.split(',')
                .filter_map(|cell| cell.parse().ok())
                .collect()
        };
        let read = |what: &str| -> Pose {
            let q = row(&format!("{what},ABB"));
            let rotation = UnitQuaternion::new_normalize(Quaternion::new(q[3], q[4], q[5], q[6]));
            let pose = Pose::from_parts(Vector3::new(q[0], q[1], q[2]).into(), rotation);
            let [x, y, z] = [Vector3::x(), Vector3::y(), Vector3::z()];
            let of = |maker: &str| -> Vec<f64> {
                row(&format!("{what},{maker}"))[3..6]
                    .iter()
                    .map(|deg| deg.to_radians())
                    .collect()
            };
            let (a, w, s) = (of("KUKA"), of("FANUC"), of("Stäubli"));
            let v = Vector3::from_column_slice(&row(&format!("{what},UR"))[3..6]);
            for other in [
                turn(z, a[0]) * turn(y, a[1]) * turn(x, a[2]),
                turn(z, w[2]) * turn(y, w[1]) * turn(x, w[0]),
                turn(x, s[0]) * turn(y, s[1]) * turn(z, s[2]),
                Pose::from_parts(
                    Translation3::identity(),
                    UnitQuaternion::from_scaled_axis(v),
                ),
            ] {
                assert!(other.rotation.angle_to(&rotation) < 1e-9);
            }
            pose
        };
        let (base, tool) = (read("base"), read("tool behind the present tool"));
        let nominal = &calibration.model.robot;
        let zero = |(k, joint): (usize, &truepose::kinematics::Joint)| {
            joint
                .kind
                .to_base_units(row(&format!("zero of joint {}", k + 1))[0])
        };
        let zeros: Vec<f64> = nominal.joints.iter().enumerate().map(zero).collect();
        let (mut square, mut before) = (0.0, 0.0);
        for (q, position, _) in truth(name) {
            let real: Vec<f64> = q.iter().zip(&zeros).map(|(q, zero)| q + zero).collect();
            let there = base * nominal.base_from_tool(&real) * tool;
            square += (there.translation.vector - position).norm_squared();
            before += (nominal.base_from_tool(&q).translation.vector - position).norm_squared();
        }
        let sidecar = json(&text(&export, ".meta.json"));
        assert_eq!(sidecar["level"], "zeros-and-frames");
        let said = sidecar["leaves"]["rms_mm"].as_f64().unwrap();
        let rms = (square / 100.0_f64).sqrt();
        assert!((rms / said - 1.0).abs() < 0.2, "{name}: {rms} {said}");
        assert!(square < 0.1 * before, "{name}: {square} {before}");
    }
}

const MOTORS: &str = r#"{
    "shoulder_pan": {"id": 1, "drive_mode": 0, "homing_offset": -14, "range_min": 1015, "range_max": 3128},
    "shoulder_lift": {"id": 2, "drive_mode": 0, "homing_offset": 989, "range_min": 826, "range_max": 3219},
    "elbow_flex": {"id": 3, "drive_mode": 0, "homing_offset": -879, "range_min": 870, "range_max": 3074},
    "wrist_flex": {"id": 4, "drive_mode": 0, "homing_offset": 151, "range_min": 850, "range_max": 3204},
    "wrist_roll": {"id": 5, "drive_mode": 0, "homing_offset": -2043, "range_min": 0, "range_max": 4095},
    "gripper": {"id": 6, "drive_mode": 0, "homing_offset": 1407, "range_min": 2031, "range_max": 3476}
}"#;

/// What the servo shows for what its encoder says, and what `LeRobot` makes of that, degrees.
fn shown(motors: Motors, actual: f64, motor: &Value) -> f64 {
    let number = |key: &str| motor[key].as_f64().unwrap();
    let present = match motors {
        Motors::Feetech => actual - number("homing_offset"),
        Motors::Dynamixel => actual + number("homing_offset"),
    };
    let middle = f64::midpoint(number("range_min"), number("range_max"));
    (present - middle) * 360.0 / 4096.0
}

#[test]
fn the_motors_and_the_urdf_of_a_hobby_arm_agree_and_share_each_offset_between_them() {
    let calibration = model("so101");
    for motors in [Motors::Feetech, Motors::Dynamixel] {
        let file = MOTORS.replace("-2043", "-1950");
        let options = Options {
            motors,
            reference: Some(Reference {
                name: "so101.json",
                bytes: file.as_bytes(),
            }),
            ..Options::default()
        };
        let export = made(&calibration, "lerobot", options).unwrap();
        let (before, after) = (json(&file), json(&text(&export, "")));
        assert_eq!(before["gripper"], after["gripper"]);
        let chain = by_urdf(&text(&export, ".urdf"));
        let names = [
            "shoulder_pan",
            "shoulder_lift",
            "elbow_flex",
            "wrist_flex",
            "wrist_roll",
        ];
        for (q, position, _) in truth("so101") {
            // The encoders stand where the old calibration shows q; the new one shows something else,
            // and the URDF at that is where the tool is.
            let now: Vec<f64> = names
                .iter()
                .zip(&q)
                .map(|(name, q)| {
                    let at_zero = shown(motors, 0.0, &before[*name]);
                    let actual = (q.to_degrees() - at_zero) * 4096.0 / 360.0;
                    shown(motors, actual, &after[*name]).to_radians()
                })
                .collect();
            let off = tool_of(&chain, &now).translation.vector - position;
            assert!(off.norm() < NEAR_MM, "{motors:?}: {off}");
        }
        for name in names {
            for key in ["id", "drive_mode", "range_min", "range_max"] {
                assert_eq!(before[name][key], after[name][key]);
            }
        }
        let sidecar = json(&text(&export, ".meta.json"));
        for zero in sidecar["zeros"]["joints"].as_array().unwrap() {
            let left = zero["in_the_file"].as_f64().unwrap();
            assert!(left.abs() <= 180.0 / 4096.0 + 1e-9, "{zero}");
        }
    }
}

#[test]
fn what_a_servo_cannot_take_is_refused_with_what_to_do() {
    let calibration = model("so101");
    let offset = calibration
        .model
        .terms()
        .iter()
        .find(|t| t.joint == 4)
        .unwrap();
    let (full, motors) = if offset.coefficients[0] > 0.0 {
        (MOTORS.replace("-2043", "-2047"), Motors::Feetech)
    } else {
        (MOTORS.replace("-2043", "2047"), Motors::Feetech)
    };
    let with = |file: &str, motors: Motors| {
        let reference = Reference {
            name: "so101.json",
            bytes: file.as_bytes(),
        };
        let options = Options {
            motors,
            reference: Some(reference),
            ..Options::default()
        };
        made(&calibration, "lerobot", options)
            .unwrap_err()
            .to_string()
    };
    let refused = with(&full, motors);
    assert!(
        refused.contains("wrist_roll") && refused.contains("remount its horn"),
        "{refused}"
    );
    let unnamed = with(&MOTORS.replace("elbow_flex", "elbow"), Motors::Feetech);
    assert!(
        unnamed.contains("no motor is called 'elbow_flex'"),
        "{unnamed}"
    );
    let broken = with("{\"a\": }", Motors::Feetech);
    assert!(broken.contains("so101.json, line 1, column 7"), "{broken}");
    let alone = made(&calibration, "lerobot", Options::default()).unwrap();
    assert!(alone.notes.iter().any(|note| note.contains("--reference")));
    let sliding = made(&model("skew"), "lerobot", Options::default()).unwrap_err();
    assert!(sliding.to_string().contains("slides"), "{sliding}");
    let five = made(&model("so101"), "ur-kinematics", Options::default()).unwrap_err();
    assert!(five.to_string().contains("six turning joints"), "{five}");
}

#[test]
fn identified_arms_become_descriptions_that_lead_where_their_models_lead() {
    for kind in ["six", "parallel", "seven", "scara"] {
        let path = folder().join(format!("../arms/{kind}-60.json"));
        let session = truepose::sessions::load(path).unwrap().session;
        let effects = DEFAULT_EFFECTS.map(str::to_owned).to_vec();
        let found = identify_exact(&session, &effects, JointValues::Commanded).unwrap();
        let inputs = Inputs::new(&session, JointValues::Commanded);
        let calibration = found.calibration(&session, &inputs);
        let calibration = truepose::pipeline::hand_out(&calibration, &session).unwrap();
        let of_the_robot = Compensation::new(&calibration).robot;
        let home = of_the_robot.robot.base_from_tool * Point3::origin();
        for to in ["urdf", "mjcf", "dh"] {
            let export = made(&calibration, to, Options::default()).unwrap();
            let chain = chain_of(&export, to);
            let mut far = 0.0_f64;
            for k in 0..100 {
                let value = |(j, joint): (usize, &truepose::kinematics::Joint)| {
                    let limits = joint.limits.unwrap();
                    let share = (0.5
                        + f64::from(k) * [0.618, 0.755, 0.819, 0.857, 0.881, 0.899, 0.912][j])
                        .fract();
                    limits.from + (limits.to - limits.from) * share
                };
                let q: Vec<f64> = session.robot.joints.iter().enumerate().map(value).collect();
                let columns = q.iter().map(|q| vec![*q]).collect();
                let at = of_the_robot
                    .predict(&Inputs::at_poses(columns, vec![home.coords.into()]))
                    .get(0);
                let off = tool_of(&chain, &q).translation.vector - Vector3::from(at);
                far = far.max(off.norm());
            }
            let sidecar = json(&text(&export, ".meta.json"));
            if sidecar["cannot_say"].to_string().contains("parallel") {
                let said = sidecar["leaves"]["max_mm"].as_f64().unwrap();
                assert!(
                    to == "dh" && far < 2.0 * said + 0.05,
                    "{kind} {to}: {far} {said}"
                );
            } else {
                assert!(far < NEAR_MM, "{kind} {to}: {far}");
            }
            assert_eq!(export.robot.unwrap().joints[0].kind, JointKind::Revolute);
        }
    }
}

/// Lengths of a wire fit a robot whose tool may be anywhere across it.
#[test]
fn a_model_that_is_less_sure_than_the_nominal_robot_is_not_described() {
    let path = folder().join("../arms/six-60.json");
    let session = truepose::sessions::load(path).unwrap().session;
    let effects = DEFAULT_EFFECTS.map(str::to_owned).to_vec();
    let found = identify_exact(&session, &effects, JointValues::Commanded).unwrap();
    let inputs = Inputs::new(&session, JointValues::Commanded);
    let mut calibration = found.calibration(&session, &inputs);
    *calibration.covariance.as_mut().unwrap() *= 1e6;
    let unsure = VerifiedCalibration::on(&calibration, &session).unwrap();
    for to in ["urdf", "mjcf", "dh"] {
        let refused = made(&unsure, to, Options::default()).unwrap_err();
        assert!(refused.to_string().contains("too little"), "{refused}");
    }
}
