//! A guide is never straight: what it does to its carriage (ISO 230-1: straightness, roll, pitch, yaw) is predicted, and
//! is not named as something else.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::f64::consts::PI;

use crate::gantry::{Guide, NOISE_MM, gantry, turns};
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
