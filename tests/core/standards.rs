//! Figures after ISO 230-2 and ISO 9283 against a published test, an independent script, and what a
//! simulated robot is known to do.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::process::Output;

use serde_json::{Value, json};

use truepose::diagnosis::Options;
use truepose::pipeline::diagnose;
use truepose::present::standards_v1;
use truepose::sessions::{Session, parse};
use truepose::standards::standards;

fn reference() -> Value {
    let text = include_str!("../reference/standards.json");
    serde_json::from_str(text).expect("written by standards.py")
}

fn session(document: &Value) -> Session {
    let loaded = parse(document.to_string().as_bytes());
    loaded.unwrap_or_else(|e| panic!("{e}")).session
}

fn figures(session: &Session) -> Value {
    let figures = standards(session, None).expect("samples that can be used");
    serde_json::to_value(standards_v1::document(&figures)).unwrap()
}

fn near(value: &Value, expected: &Value, within: f64, what: &str) {
    let (a, b) = (value.as_f64(), expected.as_f64());
    let (a, b) = (a.unwrap_or_else(|| panic!("{what}: {value}")), b.unwrap());
    assert!((a - b).abs() <= within, "{what}: {a}, expected {b}");
}

/// A robot of one joint along or about an axis.
fn robot(kind: &str, axis: &Value, point: &Value, home: &Value) -> Value {
    json!({
        "name": "axis",
        "joints": [{ "name": "a", "kind": kind, "axis": axis, "point_mm": point }],
        "tool": { "position_mm": home, "quaternion_wxyz": [1, 0, 0, 0] }
    })
}

fn document(robot: &Value, columns: &Value) -> Value {
    json!({
        "format": "truepose-session/1", "name": "test", "robot": robot,
        "samples": { "columns": columns }
    })
}

/// Measured positions of the x axis of a scanning table at a light source, five cycles both ways.
/// Source: A. Sandström, ecmc motion system test report of 2022-10-20, `target_x_report_8A.md` in the
/// public repository `anderssandstrom/ecmc_target_muts_logger`, with the results that it prints.
const PUBLISHED_UP: [[f64; 5]; 5] = [
    [-3.99861, -3.98366, -3.98366, -3.95012, -3.95335],
    [-2.00655, -1.98836, -1.98109, -1.9419, -1.93341],
    [-0.02782, -0.00802, -0.01005, 0.01986, 0.0344],
    [1.97474, 1.99616, 2.00181, 2.03495, 2.04909],
    [4.00316, 4.00397, 4.00963, 4.03024, 4.05165],
];
const PUBLISHED_DOWN: [[f64; 5]; 5] = [
    [-4.10205, -4.01598, -3.99861, -3.99254, -3.96143],
    [-2.11969, -2.02392, -2.00251, -1.99968, -1.9617],
    [-0.13005, -0.02904, -0.01489, -0.01126, 0.01622],
    [1.94767, 1.97191, 1.98848, 2.00949, 2.02323],
    [3.94983, 3.98054, 3.98538, 4.01731, 4.03024],
];

fn published() -> Session {
    let (mut q, mut dir, mut x) = (vec![], vec![], vec![]);
    for cycle in 0..5 {
        for i in 0..5 {
            q.push(-4.0 + 2.0 * i as f64);
            dir.push(1);
            x.push(PUBLISHED_UP[i][cycle]);
        }
        for i in (0..5).rev() {
            q.push(-4.0 + 2.0 * i as f64);
            dir.push(-1);
            x.push(PUBLISHED_DOWN[i][cycle]);
        }
    }
    let robot = robot(
        "prismatic",
        &json!([1, 0, 0]),
        &json!([0, 0, 0]),
        &json!([0, 100, 0]),
    );
    let y = vec![100.0; q.len()];
    let z = vec![0.0; q.len()];
    session(&document(
        &robot,
        &json!({ "q1_mm": q, "dir1": dir, "x_mm": x, "y_mm": y, "z_mm": z }),
    ))
}

#[test]
fn a_published_test_of_a_linear_axis_comes_out_as_published() {
    let answer = figures(&published());
    let series = &answer["iso_230_2"]["axes"][0]["series"][0];
    assert_eq!(answer["iso_230_2"]["axes"][0]["unit"], "mm");
    assert_eq!(series["runs"], json!([5, 5]));
    let before = &series["before"];
    // What the report prints, with five decimals.
    for (name, expected) in [
        ("B", 0.05124),
        ("B_mean", 0.03544),
        ("R_up", 0.12529),
        ("R_down", 0.23715),
        ("R", 0.23715),
        ("E_up", 0.02806),
        ("E_down", 0.02646),
        ("M", 0.02226),
        ("A_up", 0.14139),
        ("A_down", 0.24337),
    ] {
        near(&before[name], &json!(expected), 1.01e-5, name);
    }
    let rows = [
        (0.02612, -0.01412, 0.02115, 0.05296, 0.04025, 0.21182),
        (0.02974, -0.0215, 0.03132, 0.05929, 0.05124, 0.23715),
        (0.00167, -0.0338, 0.02502, 0.05625, 0.03548, 0.22499),
        (0.01135, -0.01185, 0.03018, 0.02995, 0.02319, 0.14346),
        (0.01973, -0.00734, 0.02094, 0.03184, 0.02707, 0.13263),
    ];
    for (i, (up, down, s_up, s_down, b, r)) in rows.into_iter().enumerate() {
        let position = &before["positions"][i];
        for (name, expected) in [
            ("mean_up", up),
            ("mean_down", down),
            ("s_up", s_up),
            ("s_down", s_down),
            ("B", b),
            ("R", r),
        ] {
            near(&position[name], &json!(expected), 1.01e-5, name);
        }
    }
}

#[test]
fn along_a_slide_what_was_measured_along_it_is_enough() {
    let mut alone = published();
    let nothing = vec![f64::NAN; alone.samples.len()];
    alone.samples.y_mm = nothing.clone();
    alone.samples.z_mm = Some(nothing);
    let axes = |session: &Session| figures(session)["iso_230_2"]["axes"].clone();
    assert_eq!(axes(&alone), axes(&published()));
    let whole = standards(&alone, None).unwrap();
    assert_eq!((whole.samples, whole.left_out), (alone.samples.len(), 0));
    assert!(
        standards(&alone, None)
            .unwrap()
            .notes
            .iter()
            .all(|note| !note.contains("no point was measured"))
    );
    // Across it nothing can be said.
    let mut across = published();
    across.samples.x_mm = across.samples.y_mm.iter().map(|_| f64::NAN).collect();
    assert!(axes(&across)[0]["series"].as_array().unwrap().is_empty());
}

/// The published report takes E as the larger of its two sides. ISO 230-2 takes it over both sides
/// together, so that a reversal counts.
#[test]
fn over_both_sides_the_standard_counts_the_reversal_and_the_published_report_does_not() {
    let answer = figures(&published());
    let before = &answer["iso_230_2"]["axes"][0]["series"][0]["before"];
    near(&before["E"], &json!(0.06354), 1.01e-5, "E");
    assert!((before["E"].as_f64().unwrap() - 0.02806).abs() > 0.03);
    for (name, expected) in reference()["published"].as_object().unwrap() {
        near(&before[name], expected, 1e-12, name);
    }
}

fn invented() -> (Session, Value) {
    let reference = reference()["invented"].clone();
    let samples = reference["samples"].as_array().unwrap();
    let column = |f: &dyn Fn(&Value) -> Value| samples.iter().map(f).collect::<Vec<_>>();
    let robot = robot(
        "revolute",
        &reference["axis"],
        &reference["point"],
        &reference["home"],
    );
    let columns = json!({
        "q1_deg": column(&|s| s["q"].clone()),
        "dir1": column(&|s| s["dir"].clone()),
        "x_mm": column(&|s| s["point"][0].clone()),
        "y_mm": column(&|s| s["point"][1].clone()),
        "z_mm": column(&|s| s["point"][2].clone()),
    });
    (session(&document(&robot, &columns)), reference)
}

#[test]
fn an_oblique_rotary_axis_agrees_with_an_independent_script_to_a_millionth_of_a_second() {
    let (session, reference) = invented();
    let answer = figures(&session);
    let axis = &answer["iso_230_2"]["axes"][0];
    assert_eq!(axis["unit"], "arcsec");
    let series = axis["series"].as_array().unwrap();
    assert_eq!(series.len(), 1);
    assert_eq!(
        series[0]["before"]["positions"].as_array().unwrap().len(),
        9
    );
    for (name, expected) in reference["iso_230_2"].as_object().unwrap() {
        near(&series[0]["before"][name], expected, 1e-6, name);
    }
    assert_eq!(series[0]["after"], Value::Null);
    assert_eq!(series[0]["missing"], json!([]));
}

#[test]
fn pose_accuracy_and_repeatability_agree_with_the_script() {
    let (session, reference) = invented();
    let answer = figures(&session);
    let poses = answer["iso_9283"]["poses"].as_array().unwrap();
    let expected = reference["poses"].as_array().unwrap();
    assert_eq!(poses.len(), expected.len());
    for expected in expected {
        let pose = poses
            .iter()
            .find(|p| {
                (p["q"][0].as_f64().unwrap() - expected["q"].as_f64().unwrap()).abs() < 1e-9
                    && p["dir"][0].as_f64() == expected["dir"].as_f64()
            })
            .expect("every pose");
        assert_eq!(pose["cycles"], 5);
        for name in ["AP_p_mm", "AP_x_mm", "AP_y_mm", "AP_z_mm", "RP_l_mm"] {
            near(&pose["before"][name], &expected[name], 1e-9, name);
        }
    }
    let variations = answer["iso_9283"]["variations"].as_array().unwrap();
    for (variation, expected) in variations
        .iter()
        .zip(reference["variations"].as_array().unwrap())
    {
        assert_eq!(variation["directions"], 2);
        near(
            &variation["vAP_p_before_mm"],
            &expected["vAP_p_mm"],
            1e-9,
            "vAP",
        );
    }
}

#[test]
fn corrected_commands_take_the_reversal_and_leave_the_noise() {
    let (session, _) = invented();
    let found = diagnose(&session, &Options::default(), &|_| true).unwrap();
    let calibration = found.calibration(&session);
    let figures = standards(&session, Some(&calibration)).unwrap();
    let series = &figures.axes[0].series[0];
    let after = series.after.as_ref().expect("with a model");
    // 2 × 0.02° of backlash and an eccentricity of 0.05° were put in; noise of 7.2″ was, too.
    assert!(series.before.reversal.unwrap() > 130.0);
    assert!(after.reversal.unwrap() < 20.0, "{after:?}");
    assert!(after.systematic_of_both.unwrap() < 0.1 * series.before.systematic_of_both.unwrap());
    // What a table cannot change is how the axis repeats from one side. Noise is carried over as it
    // was measured, not turned by the 1.5° of the correction, so sin 1.5° of the noise along the
    // radius comes in.
    let [before, left] = [&series.before, after].map(|p| p.repeatability[0].unwrap());
    assert!((before - left).abs() < 0.03 * before, "{before} {left}");
    let largest = figures.poses.largest(true);
    assert!(largest.accuracy.unwrap() < figures.poses.largest(false).accuracy.unwrap() / 2.0);
}

#[test]
fn what_a_session_lacks_is_null_and_named() {
    let robot = robot(
        "revolute",
        &json!([0, 0, 1]),
        &json!([0, 0, 0]),
        &json!([100, 0, 0]),
    );
    let once = json!({
        "q1_deg": [0, 30, 60, 60, 30, 0], "dir1": [1, 1, 1, -1, -1, -1],
        "x_mm": [100, 86.6, 50, 50.1, 86.7, 100.1], "y_mm": [0.1, 50, 86.6, 86.5, 50, 0.1],
        "z_mm": [0, 0, 0, 0, 0, 0]
    });
    let answer = figures(&session(&document(&robot, &once)));
    let series = &answer["iso_230_2"]["axes"][0]["series"][0];
    assert!(series["before"]["B"].is_f64());
    assert!(series["before"]["A"].is_null() && series["before"]["R"].is_null());
    assert!(
        series["missing"]
            .to_string()
            .contains("no standard deviation"),
        "{series}"
    );
    assert!(
        answer["iso_9283"]["missing"]
            .to_string()
            .contains("reached twice")
    );

    let one_way = json!({
        "q1_deg": [0, 30, 0, 30, 0, 30], "dir1": [1, 1, 1, 1, 1, 1],
        "x_mm": [100, 86.6, 100, 86.7, 100, 86.6], "y_mm": [0.1, 50, 0.2, 50, 0.1, 50]
    });
    let answer = figures(&session(&document(&robot, &one_way)));
    let before = &answer["iso_230_2"]["axes"][0]["series"][0]["before"];
    assert!(before["A_up"].is_f64() && before["A"].is_null() && before["B"].is_null());
    assert!(
        answer["iso_9283"]["missing"]
            .to_string()
            .contains("z was not measured")
    );

    let mut unknown = one_way;
    unknown.as_object_mut().unwrap().remove("dir1");
    let answer = figures(&session(&document(&robot, &unknown)));
    let axis = &answer["iso_230_2"]["axes"][0];
    assert_eq!(axis["series"], json!([]));
    assert!(
        axis["missing"]
            .to_string()
            .contains("column dir1 is missing"),
        "{axis}"
    );
}

#[test]
fn readings_without_another_pose_between_them_are_one_approach() {
    let robot = robot(
        "prismatic",
        &json!([1, 0, 0]),
        &json!([0, 0, 0]),
        &json!([0, 100, 0]),
    );
    let columns = json!({
        "q1_mm": [10, 10, 20, 10, 20], "dir1": [1, 1, 1, 1, 1],
        "x_mm": [10.1, 17, 20.1, 10.3, 20.1], "y_mm": [100, 100, 100, 100, 100]
    });
    let answer = figures(&session(&document(&robot, &columns)));
    let first = &answer["iso_230_2"]["axes"][0]["series"][0]["before"]["positions"][0];
    assert_eq!(first["runs"], json!([2, 0]));
    near(
        &first["mean_up"],
        &json!(0.2),
        1e-12,
        "the second reading does not count",
    );
}

#[test]
fn a_reflector_on_the_axis_says_nothing_of_an_angle() {
    let robot = robot(
        "revolute",
        &json!([0, 0, 1]),
        &json!([0, 0, 0]),
        &json!([0, 0, 50]),
    );
    let columns = json!({
        "q1_deg": [0, 30, 0, 30], "dir1": [1, 1, 1, 1],
        "x_mm": [0.1, 0.1, 0.1, 0.1], "y_mm": [0, 0, 0, 0], "z_mm": [50, 50, 50, 50]
    });
    let answer = figures(&session(&document(&robot, &columns)));
    assert!(
        answer["iso_230_2"]["axes"][0]["missing"]
            .to_string()
            .contains("off the axis")
    );
}

#[test]
fn measured_orientations_give_the_angular_figures() {
    let robot = robot(
        "revolute",
        &json!([0, 0, 1]),
        &json!([0, 0, 0]),
        &json!([100, 0, 0]),
    );
    // Turned by 0.1° and 0.3° too far about z: AP_c 0.2°, RP_c = 3 · √2 · 0.1°.
    let half = |deg: f64| (deg / 2.0).to_radians();
    let turned = [90.1, 0.0, 90.3, 0.0];
    let w: Vec<f64> = turned.iter().map(|d| half(*d).cos()).collect();
    let z: Vec<f64> = turned.iter().map(|d| half(*d).sin()).collect();
    let columns = json!({
        "q1_deg": [90, 0, 90, 0], "dir1": [1, -1, 1, -1],
        "x_mm": [-0.1, 100, -0.1, 100], "y_mm": [100, 0.1, 100, 0.1], "z_mm": [0, 0, 0, 0],
        "qw": w, "qx": [0, 0, 0, 0], "qy": [0, 0, 0, 0], "qz": z
    });
    let answer = figures(&session(&document(&robot, &columns)));
    let orientation = &answer["iso_9283"]["poses"][0]["orientation"];
    near(&orientation["AP_c_deg"], &json!(0.2), 1e-9, "AP_c");
    near(
        &orientation["RP_c_deg"],
        &json!(0.3 * 2.0_f64.sqrt()),
        1e-9,
        "RP_c",
    );
    near(&orientation["AP_a_deg"], &json!(0.0), 1e-9, "AP_a");
}

fn truepose(arguments: &[&str]) -> Output {
    crate::program::truepose()
        .args(arguments)
        .output()
        .expect("the program starts")
}

#[test]
fn the_command_prints_one_document_and_refuses_another_robots_model() {
    let folder = tempfile::tempdir().unwrap();
    let (session, reference) = (folder.path().join("axis.json"), reference());
    let samples = &reference["invented"]["samples"];
    let column = |f: &dyn Fn(&Value) -> Value| {
        samples
            .as_array()
            .unwrap()
            .iter()
            .map(f)
            .collect::<Vec<_>>()
    };
    let two = json!({
        "name": "two",
        "joints": [
            { "name": "a", "kind": "revolute", "axis": [0, 0, 1], "point_mm": [0, 0, 0] },
            { "name": "b", "kind": "prismatic", "axis": [1, 0, 0], "point_mm": [0, 0, 0] }
        ],
        "tool": { "position_mm": [250, 0, 100], "quaternion_wxyz": [1, 0, 0, 0] }
    });
    let columns = json!({
        "q1_deg": column(&|s| s["q"].clone()), "q2_mm": column(&|_| json!(5)),
        "dir1": column(&|s| s["dir"].clone()),
        "x_mm": column(&|s| s["point"][0].clone()), "y_mm": column(&|s| s["point"][1].clone()),
    });
    std::fs::write(&session, document(&two, &columns).to_string()).unwrap();
    let session = session.to_str().unwrap();
    let output = truepose(&["standards", session, "--json"]);
    assert_eq!(
        output.status.code(),
        Some(0),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let answer: Value = serde_json::from_slice(&output.stdout).expect("one JSON document");
    assert_eq!(answer["format"], "truepose-standards/1");
    assert_eq!(
        answer["iso_230_2"]["axes"][0]["series"][0]["conditions"]["other_joints"],
        json!([5.0])
    );
    assert!(
        answer["iso_230_2"]["axes"][1]["missing"]
            .to_string()
            .contains("dir2")
    );
    let text = truepose(&["standards", session]);
    let text = String::from_utf8(text.stdout).unwrap();
    assert!(text.contains("Joint 1 (a), ISO 230-2"), "{text}");
    assert!(text.contains("As measured, arcsec"), "{text}");
    assert!(text.contains("Poses, ISO 9283\n  18 poses"), "{text}");

    let lamp = concat!(env!("CARGO_MANIFEST_DIR"), "/sessions/paper-30.json");
    let model = folder.path().join("model.json");
    let model = model.to_str().unwrap();
    assert_eq!(
        truepose(&["identify", lamp, "--out", model]).status.code(),
        Some(0)
    );
    let refused = truepose(&["standards", session, "--model", model]);
    assert_eq!(refused.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&refused.stderr).contains("different robots"));
}

fn of_numpy(name: &str) -> (Value, Value) {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/standards");
    let expected = std::fs::read_to_string(folder.join("expected.json")).unwrap();
    let session = truepose::sessions::load(folder.join(format!("{name}.json"))).unwrap();
    let answer = figures(&session.session);
    (
        answer["iso_9283"].clone(),
        serde_json::from_str(&expected).unwrap(),
    )
}

/// The columns of the data have nine digits.
const ROUNDING: f64 = 2e-6;

#[test]
fn poses_of_an_arm_have_the_accuracy_and_repeatability_of_numpy() {
    let (answer, expected) = of_numpy("poses");
    let poses = answer["poses"].as_array().unwrap();
    assert_eq!((poses.len(), &poses[0]["cycles"]), (5, &json!(30)));
    for (pose, expected) in poses.iter().zip(expected["poses"].as_array().unwrap()) {
        let before = &pose["before"];
        near(&before["AP_p_mm"], &expected["AP_p_mm"], ROUNDING, "AP_p");
        near(&before["RP_l_mm"], &expected["RP_l_mm"], ROUNDING, "RP_l");
        for (k, (along, about)) in [("x", "a"), ("y", "b"), ("z", "c")].into_iter().enumerate() {
            near(
                &before[format!("AP_{along}_mm")],
                &expected["AP_mm"][k],
                ROUNDING,
                along,
            );
            let turn = &pose["orientation"];
            near(
                &turn[format!("AP_{about}_deg")],
                &expected["AP_deg"][k],
                ROUNDING,
                about,
            );
            near(
                &turn[format!("RP_{about}_deg")],
                &expected["RP_deg"][k],
                ROUNDING,
                about,
            );
        }
    }
    assert_eq!(
        answer["paths"],
        json!([]),
        "positions held at rest are no path"
    );
}

#[test]
fn paths_of_an_arm_have_the_accuracy_and_repeatability_of_numpy() {
    let (answer, expected) = of_numpy("paths");
    let paths = answer["paths"].as_array().unwrap();
    assert_eq!(paths.len(), 3, "there, back, and a circle");
    for (path, name) in paths.iter().zip(["line", "back", "circle"]) {
        let expected = &expected["paths"][name];
        assert_eq!(path["cycles"], expected["cycles"], "{name}");
        assert_eq!(path["points"], expected["points"], "{name}");
        for symbol in ["AT_p_mm", "RT_p_mm"] {
            near(&path["before"][symbol], &expected[symbol], ROUNDING, symbol);
        }
        for (k, about) in ["a", "b", "c"].into_iter().enumerate() {
            let turn = &path["orientation"];
            near(
                &turn[format!("AT_{about}_deg")],
                &expected["AT_deg"][k],
                ROUNDING,
                name,
            );
            near(
                &turn[format!("RT_{about}_deg")],
                &expected["RT_deg"][k],
                ROUNDING,
                name,
            );
        }
    }
    let largest = &answer["largest"]["before"];
    assert_eq!(largest["AT_p_mm"], paths[0]["before"]["AT_p_mm"]);
    let missing = answer["missing"].to_string();
    assert!(missing.contains("as few as 4 cycles"), "{missing}");
    assert_eq!(
        answer["poses"],
        json!([]),
        "samples of a path are no poses held"
    );
}

#[test]
fn a_session_without_points_is_answered_in_words() {
    let folder = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/observations");
    for name in [
        "six-distance",
        "six-bearing",
        "six-socket",
        "six-touch",
        "six-pointing",
    ] {
        let session = truepose::sessions::load(folder.join(format!("{name}.json"))).unwrap();
        let answer = figures(&session.session);
        assert_eq!(answer["iso_9283"]["poses"], json!([]), "{name}");
        assert!(
            answer["notes"]
                .to_string()
                .contains("no point was measured"),
            "{name}: {answer}"
        );
    }
}

/// `robot` of a session, as a plain product of rotations about its axes: where a point of the tool frame is.
fn at(robot: &Value, q_deg: &[f64], point: [f64; 3]) -> [f64; 3] {
    let three = |v: &Value| -> [f64; 3] { serde_json::from_value(v.clone()).unwrap() };
    let turned = |axis: [f64; 3], angle: f64, v: [f64; 3]| -> [f64; 3] {
        let norm = axis.iter().map(|a| a * a).sum::<f64>().sqrt();
        let a = axis.map(|c| c / norm);
        let (s, c) = angle.sin_cos();
        let along: f64 = (0..3).map(|k| a[k] * v[k]).sum();
        let cross = [
            a[1] * v[2] - a[2] * v[1],
            a[2] * v[0] - a[0] * v[2],
            a[0] * v[1] - a[1] * v[0],
        ];
        std::array::from_fn(|k| v[k] * c + cross[k] * s + a[k] * along * (1.0 - c))
    };
    let tool = &robot["tool"];
    let q: [f64; 4] = serde_json::from_value(tool["quaternion_wxyz"].clone()).unwrap();
    let length = (q[1] * q[1] + q[2] * q[2] + q[3] * q[3]).sqrt();
    let mut p = point;
    if length > 0.0 {
        p = turned([q[1], q[2], q[3]], 2.0 * length.atan2(q[0]), p);
    }
    let home = three(&tool["position_mm"]);
    p = std::array::from_fn(|k| p[k] + home[k]);
    for (joint, q) in robot["joints"].as_array().unwrap().iter().zip(q_deg).rev() {
        let (axis, on) = (three(&joint["axis"]), three(&joint["point_mm"]));
        let lever = std::array::from_fn(|k| p[k] - on[k]);
        let lever = turned(axis, q.to_radians(), lever);
        p = std::array::from_fn(|k| lever[k] + on[k]);
    }
    p
}

#[test]
fn the_test_cube_has_the_standards_poses_and_the_robot_reaches_them() {
    let folder = tempfile::tempdir().unwrap();
    for (name, side) in [("six", 400.0), ("seven", 250.0), ("parallel", 250.0)] {
        let arms = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/arms");
        let session = std::fs::read(arms.join(format!("{name}-60.json"))).unwrap();
        let session: Value = serde_json::from_slice(&session).unwrap();
        let robot = &session["robot"];
        let file = folder.path().join(format!("{name}.json"));
        std::fs::write(&file, robot.to_string()).unwrap();
        let poses = folder.path().join(format!("{name}.csv"));
        let (file, poses) = (file.to_str().unwrap(), poses.to_str().unwrap());
        let output = truepose(&["plan", file, "--iso9283", "--out", poses, "--json"]);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert!(output.status.success(), "{name}: {said}");
        let cube: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!(cube["side_mm"], json!(side), "{name}");
        let three = |v: &Value| -> [f64; 3] { serde_json::from_value(v.clone()).unwrap() };
        let apart =
            |a: [f64; 3], b: [f64; 3]| (0..3).map(|k| (a[k] - b[k]).powi(2)).sum::<f64>().sqrt();
        let corner = |k: &str| three(&cube["corners_mm"][k]);
        // Edges are parallel to the base's axes: C1 to C2, to C4, and to C5 below it.
        for (k, axis, sign) in [("C2", 0, 1.0), ("C4", 1, 1.0), ("C5", 2, -1.0)] {
            let mut expected = corner("C1");
            expected[axis] += sign * side;
            assert!(apart(corner(k), expected) < 1e-9, "{name} {k}");
        }
        let pose = |k: usize| &cube["poses"][k];
        let places: Vec<[f64; 3]> = (0..5).map(|k| three(&pose(k)["position_mm"])).collect();
        for (place, (from, to)) in
            places[1..]
                .iter()
                .zip([("C1", "C7"), ("C2", "C8"), ("C7", "C1"), ("C8", "C2")])
        {
            let (a, b) = (corner(from), corner(to));
            let tenth = std::array::from_fn(|k| a[k] + 0.1 * (b[k] - a[k]));
            assert!(apart(*place, tenth) < 1e-9, "{name} {from}");
        }
        assert!(
            apart(
                places[0],
                std::array::from_fn(|k| 0.5 * (corner("C1")[k] + corner("C7")[k]))
            ) < 1e-9
        );
        // Every commanded value is within its limits and brings the tool there, in one orientation.
        let mut all: Vec<&Value> = cube["poses"].as_array().unwrap().iter().collect();
        for path in cube["paths"].as_array().unwrap() {
            all.extend(path["points"].as_array().unwrap());
        }
        let direction = |q: &[f64], k: usize| {
            let (o, mut axis) = (at(robot, q, [0.0; 3]), [0.0; 3]);
            axis[k] = 1.0;
            let p = at(robot, q, axis);
            std::array::from_fn::<f64, 3, _>(|k| p[k] - o[k])
        };
        let first: Vec<f64> = serde_json::from_value(pose(0)["q_deg"].clone()).unwrap();
        for one in &all {
            let q: Vec<f64> = serde_json::from_value(one["q_deg"].clone()).unwrap();
            assert!(
                apart(at(robot, &q, [0.0; 3]), three(&one["position_mm"])) < 1e-6,
                "{name} {one}"
            );
            for k in 0..3 {
                assert!(
                    apart(direction(&q, k), direction(&first, k)) < 1e-9,
                    "{name} {one}"
                );
            }
            for (q, joint) in q.iter().zip(robot["joints"].as_array().unwrap()) {
                if let Some(limits) = joint["limits"].as_array() {
                    let [low, high] = [0, 1].map(|k: usize| limits[k].as_f64().unwrap());
                    assert!((low..=high).contains(q), "{name} {one}");
                }
            }
        }
        for (k, one) in cube["paths"][1]["points"]
            .as_array()
            .unwrap()
            .iter()
            .enumerate()
        {
            assert!(
                (apart(three(&one["position_mm"]), places[0]) - 0.4 * side).abs() < 1e-9,
                "{name} {k}"
            );
        }
        // The list to measure: 30 cycles from P5 to P1.
        let list = std::fs::read_to_string(poses).unwrap();
        let rows: Vec<&str> = list.lines().skip(1).collect();
        assert_eq!(rows.len(), 150);
        for (k, row) in rows.iter().enumerate() {
            let expected = format!("P{} cycle {}", 5 - k % 5, k / 5 + 1);
            assert!(row.ends_with(&expected), "{row}");
        }
    }
}

#[test]
fn a_robot_that_no_test_cube_fits_is_refused_in_words() {
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    for (file, word) in [
        ("sessions/lamp-commissioning.json", "ISO 230-2"),
        (
            "tests/data/arms/positioner-60.json",
            "fewer than three directions",
        ),
        (
            "tests/data/arms/scara-60.json",
            "the smallest has edges of 250 mm",
        ),
    ] {
        let output = truepose(&["plan", root.join(file).to_str().unwrap(), "--iso9283"]);
        let said = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains(word) && said.contains(file), "{said}");
    }
}
