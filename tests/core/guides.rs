//! A guide is never straight: what it does to its carriage (ISO 230-1: straightness, roll, pitch, yaw) is predicted, and
//! is not named as something else. A gantry of closed form: three slides, and a tool 180 mm off the axes.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::f64::consts::PI;

use crate::rig::Random;
use truepose::compensation::verify;
use truepose::diagnosis::{Diagnosis, Options, Verdict};
use truepose::effects::JointValues;
use truepose::pipeline::{Method, diagnose, hand_out, identify_checked};
use truepose::sessions::{Session, parse};

const TRAVEL_MM: f64 = 1500.0;
/// Along each axis.
const NOISE_MM: f64 = 0.012;

/// What the first guide does at a part of its travel: moves of its carriage, mm, and turns about x, y and z, rad.
type Guide = fn(f64) -> [[f64; 3]; 2];

fn straight(_: f64) -> [[f64; 3]; 2] {
    [[0.0; 3]; 2]
}

fn sags(u: f64) -> [[f64; 3]; 2] {
    [[0.0, 0.0, -0.12 * (PI * u).sin()], [0.0; 3]]
}

fn turns(u: f64) -> [[f64; 3]; 2] {
    let [roll, pitch, yaw] = [(2.0 * PI * u).sin(), (3.0 * PI * u).cos(), (PI * u).sin()];
    let bow = 0.08 * (PI * u).sin();
    [[0.0, bow, 0.0], [1.5e-4 * roll, 5e-5 * pitch, 2e-4 * yaw]]
}

fn gantry(seed: u64, count: usize, scale: f64, guide: Guide) -> Session {
    let mut random = Random(seed);
    let mut columns = vec![Vec::new(); 6];
    for _ in 0..count {
        let [x, y, z] = [
            random.between(0.0, TRAVEL_MM),
            random.between(0.0, 800.0),
            random.between(-300.0, 0.0),
        ];
        let [shift, turn] = guide(x / TRAVEL_MM);
        // The tool as the carriage sees it; turns are small, and their squares below a thousandth of the noise.
        let arm = [180.0, y - 40.0, z + 400.0];
        let turned = [
            turn[1] * arm[2] - turn[2] * arm[1],
            turn[2] * arm[0] - turn[0] * arm[2],
            turn[0] * arm[1] - turn[1] * arm[0],
        ];
        let carriage = [x * (1.0 + scale), 0.0, 0.0];
        let point = (0..3)
            .map(|k| carriage[k] + arm[k] + shift[k] + turned[k] + NOISE_MM * random.normal());
        let row = [x, y, z].into_iter().chain(point);
        for (column, value) in columns.iter_mut().zip(row) {
            column.push(value);
        }
    }
    let slide = |name: &str, axis: [f64; 3], limits: [f64; 2]| serde_json::json!({ "name": name, "kind": "prismatic", "axis": axis, "point_mm": [0, 0, 0], "limits": limits });
    let names = ["q1_mm", "q2_mm", "q3_mm", "x_mm", "y_mm", "z_mm"];
    let columns: serde_json::Map<String, serde_json::Value> = names
        .iter()
        .zip(columns)
        .map(|(name, column)| ((*name).to_owned(), column.into()))
        .collect();
    let document = serde_json::json!({
        "format": "truepose-session/1", "name": "gantry",
        "robot": { "name": "gantry", "joints": [
            slide("X", [1.0, 0.0, 0.0], [0.0, TRAVEL_MM]), slide("Y", [0.0, 1.0, 0.0], [0.0, 800.0]),
            slide("Z", [0.0, 0.0, 1.0], [-300.0, 0.0]) ],
            "tool": { "position_mm": [180, -40, 400], "quaternion_wxyz": [1, 0, 0, 0] } },
        "instrument": { "name": "tracker", "sigma_mm": NOISE_MM },
        "samples": { "columns": columns } });
    parse(document.to_string().as_bytes()).unwrap().session
}

fn diagnosed(session: &Session) -> Diagnosis {
    diagnose(session, &Options::default(), &|_| true).unwrap()
}

#[test]
fn a_guide_that_is_not_straight_is_predicted_and_named_as_nothing_else() {
    let noise_mm = 3.0_f64.sqrt() * NOISE_MM;
    let all: [(Guide, &[&str]); 2] = [
        (sags, &["straightness"]),
        (turns, &["straightness", "roll", "pitch or yaw"]),
    ];
    for (guide, follows) in all {
        let session = gantry(1, 200, 0.0, guide);
        let found = diagnosed(&session);
        assert!(found.found.is_empty(), "{:?}", found.found);
        assert!(found.data_problems.is_empty(), "{:?}", found.data_problems);
        assert_eq!(found.verdict, Verdict::Unexplained);
        let over = format!("{:?}", found.unnamed.as_ref().unwrap().over);
        for what in follows {
            assert!(over.contains(what), "{over}");
        }
        // Other poses are predicted as if the guide were known.
        let unseen = gantry(2, 300, 0.0, guide);
        let handed_out = hand_out(&found.calibration(&session), &session).unwrap();
        let left_mm = verify(&handed_out, &unseen).unwrap().model.rms_mm;
        assert!(left_mm < 1.1 * noise_mm, "{left_mm}");
        let alone = identify_checked(&session, &Method::default(), JointValues::Commanded).unwrap();
        let alone_mm = verify(&alone.calibration, &unseen).unwrap().model.rms_mm;
        assert!(alone_mm > 1.8 * noise_mm, "{alone_mm}");
    }
}

/// Over a slide's travel a scale moves the point as lines of sight do that are bent.
#[test]
fn the_scale_of_a_slide_among_others_is_no_bent_line_of_sight() {
    let found = diagnosed(&gantry(3, 200, 80e-6, straight));
    assert!(found.data_problems.is_empty(), "{:?}", found.data_problems);
    let names: Vec<_> = found.found.iter().map(|f| (f.effect, f.joint)).collect();
    assert_eq!(names, [("joint-scale", Some(1))]);
    assert_eq!(found.verdict, Verdict::Explained);
}
