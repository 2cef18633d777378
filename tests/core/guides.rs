//! A guide is never straight: what it does to its carriage (ISO 230-1: straightness, roll, pitch, yaw) is predicted, and
//! is not named as something else.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::f64::consts::PI;

use crate::gantry::{Guide, NOISE_MM, TRAVEL_MM, gantry, moved, turns};
use crate::rig::Random;
use truepose::compensation::verify;
use truepose::diagnosis::{Diagnosis, Options, Verdict};
use truepose::effects::JointValues;
use truepose::pipeline::{Method, diagnose, hand_out, identify_checked};
use truepose::sessions::{Session, parse};

fn straight(_: f64) -> [[f64; 3]; 2] {
    [[0.0; 3]; 2]
}

fn sags(u: f64) -> [[f64; 3]; 2] {
    [[0.0, 0.0, -0.12 * (PI * u).sin()], [0.0; 3]]
}

fn measured(seed: u64, count: usize, scale: f64, guide: Guide) -> Session {
    let document = gantry(seed, count, scale, guide);
    parse(document.as_bytes()).unwrap().session
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
        let session = measured(1, 200, 0.0, guide);
        let found = diagnosed(&session);
        assert!(found.found.is_empty(), "{:?}", found.found);
        assert!(found.data_problems.is_empty(), "{:?}", found.data_problems);
        assert_eq!(found.verdict, Verdict::Unexplained);
        let over = format!("{:?}", found.unnamed.as_ref().unwrap().over);
        for what in follows {
            assert!(over.contains(what), "{over}");
        }
        // Other poses are predicted as if the guide were known.
        let unseen = measured(2, 300, 0.0, guide);
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
    let found = diagnosed(&measured(3, 200, 80e-6, straight));
    assert!(found.data_problems.is_empty(), "{:?}", found.data_problems);
    let names: Vec<_> = found.found.iter().map(|f| (f.effect, f.joint)).collect();
    assert_eq!(names, [("joint-scale", Some(1))]);
    assert_eq!(found.verdict, Verdict::Explained);
}

/// Reflectors on the carriage of a single slide, whose tool is its origin.
const REFLECTORS_MM: [[f64; 3]; 3] = [
    [180.0, -40.0, 400.0],
    [-200.0, 150.0, 120.0],
    [60.0, -260.0, -90.0],
];

/// A single slide that carries three reflectors, all measured at each of these places, in order.
fn slide(seed: u64, places: impl Iterator<Item = f64>, guide: Guide) -> String {
    let mut random = Random(seed);
    let (mut columns, mut target) = (vec![Vec::new(); 4], Vec::new());
    for x in places {
        for (k, arm) in REFLECTORS_MM.into_iter().enumerate() {
            let moved = moved(guide, x, arm);
            let slid = [x, 0.0, 0.0];
            let point = (0..3).map(|k| arm[k] + slid[k] + moved[k] + NOISE_MM * random.normal());
            for (column, value) in columns.iter_mut().zip([x].into_iter().chain(point)) {
                column.push(value);
            }
            target.push(format!("T{}", k + 1));
        }
    }
    let [q, x, y, z] = <[Vec<f64>; 4]>::try_from(columns).expect("four columns");
    let [a, b, c] = REFLECTORS_MM;
    let document = serde_json::json!({
        "format": "truepose-session/1", "name": "slide",
        "robot": { "name": "slide", "joints": [ { "name": "X", "kind": "prismatic", "axis": [1, 0, 0],
            "point_mm": [0, 0, 0], "limits": [0, TRAVEL_MM] } ],
            "tool": { "position_mm": [0, 0, 0], "quaternion_wxyz": [1, 0, 0, 0] } },
        "targets": { "T1": a, "T2": b, "T3": c },
        "instrument": { "name": "tracker", "sigma_mm": NOISE_MM },
        "samples": { "columns": { "q1_mm": q, "x_mm": x, "y_mm": y, "z_mm": z, "target": target } } });
    document.to_string()
}

/// In two sweeps of the only slide how it is turned looks like a frame that moved with time, and three reflectors see it
/// each in its own way, which no curve over the slide can follow.
#[test]
fn a_single_slide_with_three_reflectors_shows_how_it_is_turned() {
    let swept = (0..62).map(|k| 50.0 * f64::from(k % 31));
    let document = slide(4, swept, turns);
    let session = parse(document.as_bytes()).unwrap().session;
    let found = diagnosed(&session);
    assert!(found.found.is_empty(), "{:?}", found.found);
    let problems = found.data_problems.iter().map(|problem| &problem.what);
    let problems: Vec<String> = problems.map(ToString::to_string).collect();
    assert!(
        problems.iter().all(|what| what == "equal steps"),
        "{problems:?}"
    );
    let elsewhere = (0..100).map(|k| 1500.0 * (f64::from(k) * 0.618_034).fract());
    let document = slide(5, elsewhere, turns);
    let unseen = parse(document.as_bytes()).unwrap().session;
    let handed_out = hand_out(&found.calibration(&session), &session).unwrap();
    let left_mm = verify(&handed_out, &unseen).unwrap().model.rms_mm;
    // A curve over the slide alone leaves more than three times the noise.
    assert!(left_mm < 2.0 * 3.0_f64.sqrt() * NOISE_MM, "{left_mm}");
}

/// The turns were fitted in addition to the curve: their figures hold with both, and neither is taken away alone.
#[test]
fn a_curve_and_the_turns_that_were_fitted_with_it_stay_together() {
    let both = |u: f64| {
        let [[x, y, z], turned] = turns(u);
        [[x, y, z - 0.2 * (PI * u).sin()], turned]
    };
    let swept = (0..62).map(|k| 50.0 * f64::from(k % 31));
    let session = parse(slide(4, swept, both).as_bytes()).unwrap().session;
    let found = diagnosed(&session);
    assert!(found.correction().is_some());
    assert!(found.unnamed_terms().len() > 1, "{:?}", found.unnamed);
    assert_eq!(found.clone().uncorrected(), found);
}
