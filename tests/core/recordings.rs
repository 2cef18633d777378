//! Recordings, camera boards and distance logs, imported by the library. The files come from
//! `tests/reference/recordings.py`: kinematics in numpy, recordings by the packages that robots'
//! users have, and the truth beside them in `recordings.json`.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::path::{Path, PathBuf};

use nalgebra::{Isometry3, Matrix3, Point3, Rotation3, Translation3, UnitQuaternion, Vector3};
use serde_json::Value;
use truepose::importers::{
    About, Companion, Imported, LengthUnit, Matching, Reading, Settings, find, import, inspect,
};
use truepose::kinematics::Robot;
use truepose::sessions::{Session, load_robot, parse, write_inline};

fn data(name: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/imports");
    folder.join(name)
}

fn bytes(name: &str) -> Vec<u8> {
    std::fs::read(data(name)).expect("the file is in the repository")
}

fn robot() -> Robot {
    load_robot(data("arm.json")).expect("a sound robot").robot
}

fn truth() -> Value {
    serde_json::from_slice(&bytes("recordings.json")).unwrap()
}

/// A frame of the truth in the base frame.
fn frame(truth: &Value) -> Isometry3<f64> {
    let number = |value: &Value| value.as_f64().unwrap();
    let matrix = Matrix3::from_fn(|row, column| number(&truth["rotation"][row][column]));
    let position = Vector3::from_fn(|axis, _| number(&truth["position_mm"][axis]));
    let turn = UnitQuaternion::from_rotation_matrix(&Rotation3::from_matrix_unchecked(matrix));
    Isometry3::from_parts(Translation3::from(position), turn)
}

fn reading(kind: &str, options: &[(&'static str, &str)]) -> Reading {
    Reading {
        kind: find(kind),
        file: Some(PathBuf::from("recording")),
        options: options
            .iter()
            .map(|(name, value)| (*name, (*value).to_owned()))
            .collect(),
        ..Reading::default()
    }
}

fn imported(bytes: &[u8], settings: &Settings<'_>) -> Imported {
    import(bytes, settings).unwrap_or_else(|rejected| panic!("{rejected}"))
}

fn refusal(bytes: &[u8], settings: &Settings<'_>) -> String {
    match import(bytes, settings) {
        Ok(_) => panic!("it was accepted"),
        Err(rejected) => rejected.to_string(),
    }
}

fn note(imported: &Imported) -> String {
    let findings = imported.findings.iter().map(ToString::to_string);
    findings.collect::<Vec<String>>().join("\n") + &imported.session.note
}

/// Distances between the measured points and where a frame sees the nominal robot's tool, mm.
fn distances(session: &Session, robot: &Robot, frame: &Isometry3<f64>) -> Vec<f64> {
    let samples = &session.samples;
    let z_mm = samples.z_mm.as_ref().unwrap();
    let distance = |i: usize| {
        let q: Vec<f64> = samples.q.iter().map(|q| q[i]).collect();
        let there = frame.inverse() * robot.point_in_base(&q, &Point3::origin());
        (Point3::new(samples.x_mm[i], samples.y_mm[i], z_mm[i]) - there).norm()
    };
    (0..samples.len()).map(distance).collect()
}

fn largest(values: &[f64]) -> f64 {
    values.iter().copied().fold(0.0, f64::max)
}

/// The offset of the clocks lies in its interval (or near it: one of twenty does not), and the
/// interval is narrow enough to be of use.
fn assert_clock(imported: &Imported, true_s: f64, narrow_s: f64) {
    let clock = imported.matched.as_ref().unwrap().clock.unwrap();
    let [from, to] = clock.ci95_s().expect("found, not given");
    let half = 0.5 * (to - from);
    assert!((clock.offset_s - true_s).abs() < 2.0 * half, "{clock:?}");
    assert!(half < narrow_s, "{clock:?}");
}

#[test]
fn a_recording_of_ros_2_becomes_a_sample_for_each_stop() {
    let (robot, truth) = (robot(), truth());
    let settings = Settings::new(reading("mcap", &[]), &robot);
    let done = imported(&bytes("arm-ros2.mcap"), &settings);
    let samples = &done.session.samples;
    let stops = truth["stops_rad"].as_array().unwrap();
    assert_eq!(samples.len(), stops.len());
    for (i, stop) in stops.iter().enumerate() {
        for joint in 0..3 {
            let off = samples.q[joint][i] - stop[joint].as_f64().unwrap();
            assert!(off.abs() < 1e-5, "encoders of 5 µrad, averaged: {off}");
        }
    }
    let instrument = frame(&truth["instrument_in_base"]);
    let off = distances(&done.session, &robot, &instrument);
    assert!(largest(&off) < 0.05, "0.02 mm of noise, averaged: {off:?}");
    assert_clock(
        &done,
        truth["offset_s"]["arm-ros2"].as_f64().unwrap(),
        0.002,
    );
    // The orientation came along: that of the tool frame in the instrument's.
    let [w, x, y, z] = samples.orientation_wxyz.as_ref().unwrap();
    for i in 0..samples.len() {
        let q: Vec<f64> = samples.q.iter().map(|q| q[i]).collect();
        let tip = [Vector3::zeros(), Vector3::x(), Vector3::y()]
            .map(|v| instrument.inverse() * robot.point_in_base(&q, &Point3::from(v)));
        let turn =
            UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(w[i], x[i], y[i], z[i]));
        assert!(
            (turn * Vector3::x() - (tip[1] - tip[0])).norm() < 1e-5,
            "{i}"
        );
        assert!(
            (turn * Vector3::y() - (tip[2] - tip[0])).norm() < 1e-5,
            "{i}"
        );
    }
    // The side that each joint came from, in spite of encoders that wander.
    let dir = samples.dir[1].as_ref().unwrap();
    for i in 1..stops.len() {
        let step = stops[i][1].as_f64().unwrap() - stops[i - 1][1].as_f64().unwrap();
        assert_eq!(dir[i], step.signum(), "stop {i}");
    }
    let said = note(&done);
    for part in [
        "/joint_states (sensor_msgs/JointState, 896)",
        "/rosout (std_msgs/msg/String, 1)",
        "in the frame 'tracker'",
        "commands are the recorded joint values, matched by time",
    ] {
        assert!(said.contains(part), "{part}: {said}");
    }
    let mut document = Vec::new();
    write_inline(&done.session, &mut document).unwrap();
    assert_eq!(parse(&document).unwrap().session.samples.len(), stops.len());
}

#[test]
fn a_robot_that_never_stops_is_matched_point_by_point() {
    let (robot, truth) = (robot(), truth());
    let settings = Settings::new(reading("mcap", &[]), &robot);
    let done = imported(&bytes("arm-json.mcap"), &settings);
    assert!(
        done.session.samples.len() > 130,
        "but for what lies outside"
    );
    assert_clock(
        &done,
        truth["offset_s"]["arm-json"].as_f64().unwrap(),
        0.002,
    );
    let off = distances(&done.session, &robot, &frame(&truth["instrument_in_base"]));
    // Straight lines between joint values 40 ms apart, at half a metre a second.
    assert!(largest(&off) < 0.3, "{}", largest(&off));
    assert!(done.session.samples.speed[0].is_some());
    assert!(done.session.samples.orientation_wxyz.is_none());
}

#[test]
fn one_of_several_transforms_is_asked_for_and_big_endian_is_read() {
    let (robot, truth) = (robot(), truth());
    let recording = bytes("arm-tf.mcap");
    let settings = Settings::new(reading("mcap", &[]), &robot);
    let question = refusal(&recording, &settings);
    assert!(
        question.contains("--frame-child table or tool"),
        "{question}"
    );
    let found = inspect(&recording, &Reading::default());
    assert_eq!(found.kind, find("mcap"), "by its first bytes");
    assert_eq!(found.questions[0].about, About::Own("frame-child"));
    let settings = Settings::new(reading("mcap", &[("frame-child", "tool")]), &robot);
    let done = imported(&recording, &settings);
    assert_eq!(done.session.samples.len(), 9);
    assert_clock(&done, truth["offset_s"]["arm-tf"].as_f64().unwrap(), 0.003);
    let off = distances(&done.session, &robot, &frame(&truth["instrument_in_base"]));
    assert!(largest(&off) < 0.08, "{off:?}");
    let settings = Settings::new(reading("mcap", &[("frame-child", "lamp")]), &robot);
    let wrong = refusal(&recording, &settings);
    assert!(wrong.contains("one of 'table', 'tool'"), "{wrong}");
}

#[test]
fn a_robot_that_stands_still_is_refused() {
    let robot = robot();
    let settings = Settings::new(reading("mcap", &[]), &robot);
    let wrong = refusal(&bytes("arm-standing.mcap"), &settings);
    assert!(
        wrong.contains("never moved") && wrong.contains("--clock-offset"),
        "{wrong}"
    );
}

#[test]
fn topics_and_joints_are_chosen_by_name_and_wrong_names_are_answered() {
    let robot = robot();
    let recording = bytes("arm-ros2.mcap");
    let with = |options: &[(&'static str, &str)]| {
        import(&recording, &Settings::new(reading("mcap", options), &robot))
    };
    let same = with(&[
        ("topic-measured", "tracker/pose"),
        ("joint-names", "shoulder, upper,elbow"),
    ]);
    assert_eq!(same.unwrap().session.samples.len(), 14);
    for (name, value, says) in [
        ("topic-measured", "/lost", "--topic-measured: '/lost'"),
        ("topic-measured", "/lost", "one of '/tracker/pose'"),
        ("topic-joints", "/rosout", "one of '/joint_states'"),
        ("joint-names", "a,b,c", "--joint-names: 'a,b,c'"),
        (
            "joint-names",
            "upper,upper,elbow",
            "as many names as the robot has joints",
        ),
        (
            "joint-names",
            "upper",
            "as many names as the robot has joints",
        ),
        ("frame-child", "tool", "--frame-child: 'tool'"),
    ] {
        let wrong = with(&[(name, value)]).unwrap_err().to_string();
        assert!(wrong.contains(says), "{wrong}");
    }
    // Another robot's joints: their order in a message says nothing.
    let text = String::from_utf8(bytes("arm.json"))
        .unwrap()
        .replace("upper", "a2");
    let other = truepose::sessions::parse_robot(text.as_bytes())
        .unwrap()
        .robot;
    let asked = refusal(&recording, &Settings::new(reading("mcap", &[]), &other));
    assert!(
        asked.contains("--joint-names") && asked.contains("elbow, gripper, shoulder, upper"),
        "{asked}"
    );
}

/// The place where some bytes stand.
fn find_bytes(bytes: &[u8], wanted: &[u8]) -> usize {
    let mut windows = bytes.windows(wanted.len());
    windows
        .position(|window| window == wanted)
        .expect("they are there")
}

#[test]
fn broken_recordings_are_refused_with_the_byte_and_what_was_expected() {
    let robot = robot();
    let whole = bytes("arm-tf.mcap");
    let settings = || Settings::new(reading("mcap", &[("frame-child", "tool")]), &robot);
    let changed = |at: usize, to: &[u8]| {
        let mut bytes = whole.clone();
        bytes[at..at + to.len()].copy_from_slice(to);
        bytes
    };
    let zstd = bytes("arm-ros2.mcap");
    let packed = |at: usize, to: u8| {
        let mut bytes = zstd.clone();
        bytes[at] = to;
        bytes
    };
    let name = find_bytes(&zstd, b"zstd");
    let joints = find_bytes(&whole, b"sensor_msgs/msg/JointState");
    let tf = find_bytes(&whole, b"tf2_msgs/msg/TFMessage");
    let cdr = find_bytes(&whole, b"cdr");
    // Where a message of /joint_states starts with its four bytes: behind its times.
    let shoulder = find_bytes(&whole, b"shoulder\0");
    let cases: Vec<(Vec<u8>, &str)> = vec![
        (Vec::new(), "byte 0: not an MCAP file"),
        (
            b"q1_deg,x_mm,y_mm\n0,1,2\n".to_vec(),
            "byte 0: not an MCAP file",
        ),
        (whole[..8].to_vec(), "byte 8: the recording is cut off"),
        (whole[..150].to_vec(), "the recording is cut off"),
        (
            changed(joints, b"sensor_msgs/msg/JointStave"),
            "no column 'q1'",
        ),
        (
            changed(tf, b"tf2_msgs/msg/TXMessage"),
            "--frame-child: 'tool'",
        ),
        (changed(cdr, b"cdx"), "'cdx'; expected a "),
        (
            changed(shoulder - 4, &[255; 4]),
            "'/joint_states' 1: fields that are not those of its type",
        ),
        (
            changed(shoulder - 28, &[0, 9]),
            "'/joint_states' 1: fields that are not",
        ),
        (
            packed(name, b'x'),
            "a chunk that cannot be unpacked ('xstd')",
        ),
        (packed(name + 100, zstd[name + 100] ^ 255), "chunk"),
        (
            packed(name - 8, zstd[name - 8] ^ 1),
            "a chunk that cannot be unpacked (its length or its checksum",
        ),
        (packed(name - 16 + 5, 1), "> 256 MiB"),
    ];
    for (number, (bytes, says)) in cases.iter().enumerate() {
        let wrong = refusal(bytes, &settings());
        assert!(wrong.contains(says), "case {number}, {says}: {wrong}");
    }
}

#[test]
fn a_recording_that_is_cut_off_is_read_up_to_there() {
    let robot = robot();
    let whole = bytes("arm-ros2.mcap");
    let settings = Settings::new(reading("mcap", &[]), &robot);
    let done = imported(&whole[..whole.len() / 2], &settings);
    let samples = done.session.samples.len();
    assert!((4..12).contains(&samples), "{samples}");
    assert!(
        note(&done).contains("everything before it is read"),
        "{}",
        note(&done)
    );
}

#[test]
fn commands_of_a_table_come_before_those_of_the_recording() {
    let robot = robot();
    let mut settings = Settings::new(reading("mcap", &[]), &robot);
    let log = "time_s,q1_deg,q2_deg,q3_deg\n0,0,0,0\n1,10,5,2\n";
    settings.commands = Some(Companion {
        bytes: log.as_bytes(),
        file: None,
    });
    settings.matching = Some(Matching::Order);
    let wrong = refusal(&bytes("arm-ros2.mcap"), &settings);
    assert!(wrong.contains("336 measurements and 2 commands"), "{wrong}");
}

/// The pose of each sample in the base frame, seen from a frame there.
fn assert_poses(session: &Session, robot: &Robot, frame: &Isometry3<f64>) {
    assert!(largest(&distances(session, robot, frame)) < 1e-4);
    let samples = &session.samples;
    let [w, x, y, z] = samples.orientation_wxyz.as_ref().unwrap();
    for i in 0..samples.len() {
        let q: Vec<f64> = samples.q.iter().map(|q| q[i]).collect();
        let turn =
            UnitQuaternion::from_quaternion(nalgebra::Quaternion::new(w[i], x[i], y[i], z[i]));
        let tool = |v: Vector3<f64>| frame.inverse() * robot.point_in_base(&q, &Point3::from(v));
        for axis in [Vector3::x(), Vector3::y(), Vector3::z()] {
            let there = tool(axis) - tool(Vector3::zeros());
            assert!((turn * axis - there).norm() < 1e-7, "{i}");
        }
    }
}

#[test]
fn a_board_seen_by_a_camera_gives_poses_whichever_of_the_two_moves() {
    let (robot, truth) = (robot(), truth());
    let commands = bytes("board-commands.csv");
    for (file, camera, seen_from, unit) in [
        ("board-rvec.csv", "fixed", "camera_in_base", None),
        (
            "board-quaternion.csv",
            "on-tool",
            "table_in_base",
            Some(LengthUnit::Millimetres),
        ),
    ] {
        let mut settings = Settings::new(reading("board", &[]), &robot);
        settings.commands = Some(Companion {
            bytes: &commands,
            file: None,
        });
        settings.matching = Some(Matching::Name);
        let asked = refusal(&bytes(file), &settings);
        assert!(asked.contains("--camera fixed or on-tool"), "{asked}");
        assert_eq!(
            asked.contains("--unit mm or m or in"),
            unit.is_some(),
            "{asked}"
        );
        settings.reading.options.insert("camera", camera.to_owned());
        settings.reading.unit = unit;
        let done = imported(&bytes(file), &settings);
        assert_eq!(done.session.samples.len(), 12);
        assert_poses(&done.session, &robot, &frame(&truth["board"][seen_from]));
        assert!(note(&done).contains("p_camera = R p_board + t"));
    }
    let found = inspect(&bytes("board-rvec.csv"), &Reading::default());
    assert_eq!(found.kind, find("board"));
    assert_eq!(found.columns[1].meaning, "rvec_x");
}

#[test]
fn board_files_that_lack_something_are_refused() {
    let robot = robot();
    let wrong = |text: &str| {
        let settings = Settings::new(reading("board", &[("camera", "fixed")]), &robot);
        refusal(text.as_bytes(), &settings)
    };
    for (text, says) in [
        (
            "image,rvec_x,rvec_y,rvec_z\na,0,0,0\n",
            "no column is tvec_x",
        ),
        ("1,0,0,0,1,2,3\n", "7 columns and no header"),
        (
            "rvec_x,rvec_y,rvec_z,tvec_x_m,tvec_y_m,tvec_z_m\n0,0,0,1,2,x\n",
            "line 2, column 6",
        ),
        (
            "rvec_x,rvec_y,rvec_z,tvec_x,tvec_y,tvec_z\n0,0,0,1,2,3\n",
            "--unit mm or m or in",
        ),
        (
            "rvec_x,rvec_y,rvec_z,tvec_x_m,tvec_y_m,tvec_z_m\n",
            "no table",
        ),
    ] {
        let wrong = wrong(text);
        assert!(wrong.contains(says), "{says}: {wrong}");
    }
}

/// The session as text: what stands in the CSV and which anchors the JSON declares.
fn written(session: &Session) -> (Value, Vec<Vec<String>>) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("s.json");
    let replacing = truepose::sessions::Replacing {
        force: true,
        inputs: &[],
    };
    truepose::sessions::save(session, &path, replacing).unwrap();
    let document = serde_json::from_slice(&std::fs::read(&path).unwrap()).unwrap();
    let csv = std::fs::read_to_string(folder.path().join("s.csv")).unwrap();
    let rows = csv
        .lines()
        .map(|line| line.split(',').map(str::to_owned).collect());
    (document, rows.collect())
}

#[test]
fn distances_are_read_with_their_anchor_from_any_notation() {
    let (robot, truth) = (robot(), truth());
    let commands = bytes("ballbar-commands.csv");
    for (file, anchor, offset) in [
        ("ballbar.csv", "table", Some("0")),
        ("drawwire-de.txt", "table", None),
    ] {
        let mut settings = Settings::new(reading("ballbar", &[]), &robot);
        settings.commands = Some(Companion {
            bytes: &commands,
            file: None,
        });
        if let Some(offset) = offset {
            settings
                .reading
                .options
                .insert("anchor-offset", offset.to_owned());
        }
        let done = imported(&bytes(file), &settings);
        let (document, rows) = written(&done.session);
        let declared = &document["anchors"][anchor];
        assert!(declared["position_mm"].is_null(), "{document}");
        assert_eq!(
            declared["offset_mm"].as_f64(),
            offset.map(|o| o.parse().unwrap())
        );
        let column = |name: &str| {
            let heading = rows[0].iter().position(|heading| heading == name);
            heading.unwrap_or_else(|| panic!("{name} in {:?}", rows[0]))
        };
        let (distance, name, time) = (column("distance_mm"), column("anchor"), column("time_s"));
        for (k, row) in rows[1..].iter().enumerate() {
            let wanted = truth["ballbar"]["distances_mm"][k].as_f64().unwrap();
            assert!((row[distance].parse::<f64>().unwrap() - wanted).abs() < 1e-4);
            assert_eq!(row[name], anchor);
            assert!((row[time].parse::<f64>().unwrap() - 12.5 - 2.0 * k as f64).abs() < 1e-9);
        }
        assert_eq!(rows.len(), 16);
    }
    // Where the anchor is may be known: then it is no unknown.
    let mut settings = Settings::new(reading("ballbar", &[]), &robot);
    settings.commands = Some(Companion {
        bytes: &commands,
        file: None,
    });
    settings.reference = Some(Companion {
        bytes: b"name,x_mm,y_mm,z_mm\ntable,300,-450,40\nother,1,2,3\n",
        file: None,
    });
    let done = imported(&bytes("ballbar.csv"), &settings);
    let (document, _) = written(&done.session);
    assert_eq!(document["anchors"]["table"]["position_mm"][1], -450.0);
}

#[test]
fn distances_that_lack_something_are_refused_or_asked_about() {
    let robot = robot();
    let with = |text: &str, options: &[(&'static str, &str)]| {
        let mut settings = Settings::new(reading("ballbar", options), &robot);
        settings.reading.joint = 0;
        import(text.as_bytes(), &settings)
    };
    let q = "q1_deg,q2_deg,q3_deg";
    for (text, options, says) in [
        (
            format!("{q},x\n0,0,0,5\n"),
            &[][..],
            "no column is distance for certain",
        ),
        (
            format!("{q},distance\n0,0,0,5\n"),
            &[],
            "the unit of the distances is not stated",
        ),
        (
            format!("{q},Deviation [um]\n0,0,0,5\n"),
            &[],
            "--nominal-length",
        ),
        (
            format!("{q},Deviation [um]\n0,0,0,5\n"),
            &[("nominal-length", "x")],
            "a length in mm",
        ),
        (
            format!("{q},distance_mm\n0,0,0,5\n"),
            &[("anchor-offset", "inf")],
            "a length in mm",
        ),
        (
            format!("{q},distance_mm\n0,0,0,1e400\n"),
            &[],
            "line 2, column 4",
        ),
        ("distance_mm\n5\n".to_owned(), &[], "no column 'q1'"),
    ] {
        let wrong = with(&text, options).unwrap_err().to_string();
        assert!(wrong.contains(says), "{says}: {wrong}");
    }
    let text = format!("{q},Deviation [um],anchor\n0,0,0,5,B\n1,0,0,,C\n");
    let options = [("nominal-length", "300"), ("anchor-offset", "-0.5")];
    let session = with(&text, &options).unwrap().session;
    let (document, rows) = written(&session);
    let at = rows[0]
        .iter()
        .position(|heading| heading == "distance_mm")
        .unwrap();
    assert_eq!(rows[1][at], "300.005");
    assert_eq!(rows[2][at], "", "a reading that is missing stays missing");
    assert_eq!(document["anchors"]["C"]["offset_mm"], -0.5);
    let found = inspect(&bytes("ballbar.csv"), &Reading::default());
    assert_eq!(found.kind, find("ballbar"));
}
