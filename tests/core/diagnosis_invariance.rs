//! What a diagnosis must not depend on: the order of the columns, the number of threads, the seed
//! of the simulated noise, and which way the whole set-up faces. Sessions come from a rig that
//! shares no code with the model (`support/rig.rs`).

use crate::cases::cases;
use crate::rig::{Design, Rig};
use truepose::diagnosis::{Diagnosis, Options, Verdict};
use truepose::pipeline::diagnose;
use truepose::sessions::{Session, load, parse};

const IDS: [&str; 8] = [
    "axis-tilt",
    "backlash",
    "base-offset",
    "bearing-runout",
    "encoder-eccentricity",
    "frame-shift",
    "joint-compliance",
    "thermal-growth",
];

fn measured(id: &str, lambda: f64, seed: u64) -> Rig {
    let design = Design {
        gravity_across: id == "joint-compliance",
        ..Design::default()
    };
    Rig::measured(&design, &[id], lambda, seed).0
}

fn session(rig: &Rig) -> Session {
    parse(rig.json("invariance").as_bytes())
        .expect("the rig writes a good session")
        .session
}

fn diagnosed(session: &Session) -> Diagnosis {
    diagnose(session, &Options::default(), &|_| true).expect("a diagnosis")
}

fn names(answer: &Diagnosis) -> Vec<(&'static str, Option<usize>)> {
    answer.found.iter().map(|f| (f.effect, f.joint)).collect()
}

#[test]
fn the_order_of_the_columns_changes_nothing() {
    let rig = measured("thermal-growth", 200.0, 3);
    let document = rig.json("invariance");
    let mut document: serde_json::Value = serde_json::from_str(&document).expect("JSON");
    let columns = document["samples"]["columns"].clone();
    let columns = columns.as_object().expect("columns").clone();
    let folder = tempfile::tempdir().expect("a folder");
    let mut answers = Vec::new();
    for turn in [0, 4] {
        let mut order: Vec<&String> = columns.keys().collect();
        order.rotate_left(turn);
        let mut csv = order
            .iter()
            .map(|n| n.as_str())
            .collect::<Vec<_>>()
            .join(",");
        for i in 0..rig.shots.len() {
            let cells: Vec<String> = order.iter().map(|n| columns[*n][i].to_string()).collect();
            csv += "\n";
            csv += &cells.join(",");
        }
        std::fs::write(folder.path().join("rows.csv"), csv).expect("written");
        document["samples"] = serde_json::json!({ "file": "rows.csv" });
        let path = folder.path().join("session.json");
        std::fs::write(&path, document.to_string()).expect("written");
        answers.push(diagnosed(&load(&path).expect("a good session").session));
    }
    assert_eq!(answers[0], answers[1]);
    assert_eq!(names(&answers[0]), [("thermal-growth", Some(1))]);
}

#[test]
fn answers_are_the_same_on_any_thread_and_beside_others() {
    let sessions: Vec<Session> = [("backlash", 4), ("axis-tilt", 5), ("base-offset", 6)]
        .map(|(id, seed)| session(&measured(id, 100.0, seed)))
        .into();
    let alone: Vec<Diagnosis> = sessions.iter().map(diagnosed).collect();
    let together: Vec<Diagnosis> = std::thread::scope(|scope| {
        let runs: Vec<_> = sessions
            .iter()
            .map(|session| scope.spawn(|| diagnosed(session)))
            .collect();
        runs.into_iter()
            .map(|r| r.join().expect("no panic"))
            .collect()
    });
    assert_eq!(alone, together);
}

#[test]
fn the_seed_changes_no_name_and_no_value() {
    for (k, id) in IDS.into_iter().enumerate() {
        let session = session(&measured(id, [40.0, 100.0][k % 2], 50 + k as u64));
        let first = diagnosed(&session);
        for &seed in cases(&[99, 1, 2], 1) {
            let options = Options {
                seed,
                ..Options::default()
            };
            let answer = diagnose(&session, &options, &|_| true).expect("a diagnosis");
            assert_eq!(names(&first), names(&answer), "{id}, seed {seed}");
            assert_eq!(first.verdict, answer.verdict, "{id}, seed {seed}");
            assert_eq!(first.model, answer.model, "{id}, seed {seed}");
        }
    }
}

/// Robot, gravity and measurement turned together about z.
fn turned(session: &Session, by: f64) -> Session {
    use nalgebra::{Isometry3, Translation3, UnitQuaternion, Vector3};
    let turn = UnitQuaternion::from_axis_angle(&Vector3::z_axis(), by);
    let mut turned = session.clone();
    let robot = &mut turned.robot;
    let turning = Isometry3::from_parts(Translation3::identity(), turn);
    robot.base_from_tool = turning * robot.base_from_tool;
    for joint in &mut robot.joints {
        joint.axis.point_mm = turn * joint.axis.point_mm;
    }
    robot.gravity_m_s2 = robot.gravity_m_s2.map(|g| turn * g);
    let samples = &mut turned.samples;
    for i in 0..samples.x_mm.len() {
        let p = turn * Vector3::new(samples.x_mm[i], samples.y_mm[i], 0.0);
        (samples.x_mm[i], samples.y_mm[i]) = (p.x, p.y);
    }
    turned
}

/// What the parameters of an effect become when everything is turned about z.
fn turned_parameters(id: &str, values: &[f64], by: f64) -> Vec<f64> {
    let mut turned = values.to_vec();
    // An offset and a tilt are vectors; a step has its time before them.
    let first = match id {
        "base-offset" | "axis-tilt" => Some(0),
        "frame-shift" => Some(1),
        _ => None,
    };
    if let Some(k) = first {
        turned[k] = by.cos() * values[k] - by.sin() * values[k + 1];
        turned[k + 1] = by.sin() * values[k] + by.cos() * values[k + 1];
    }
    if id == "bearing-runout" {
        // The phase counts from the base frame's x.
        turned[2] = (values[2] + by.to_degrees()).rem_euclid(360.0);
    }
    turned
}

#[test]
fn a_turn_of_the_whole_set_up_turns_the_parameters_and_nothing_else() {
    let by = 37.0_f64.to_radians();
    for (k, id) in IDS.into_iter().enumerate() {
        let as_it_is = session(&measured(id, 200.0, 70 + k as u64));
        let (before, after) = (diagnosed(&as_it_is), diagnosed(&turned(&as_it_is, by)));
        assert_eq!(names(&before), names(&after), "{id}");
        assert_eq!(before.verdict, after.verdict, "{id}");
        assert_ne!(before.verdict, Verdict::Noise, "{id}");
        assert!((before.gap.end_mm - after.gap.end_mm).abs() < 1e-7, "{id}");
        for (a, b) in before.identified.iter().zip(&after.identified) {
            assert!((a.value - b.value).abs() < 1e-6, "{id}: {a:?} {b:?}");
        }
        for (a, b) in before.found.iter().zip(&after.found) {
            let values = |f: &truepose::diagnosis::FoundEffect| -> Vec<f64> {
                f.parameters.iter().map(|p| p.value).collect()
            };
            let expected = turned_parameters(a.effect, &values(a), by);
            for (e, v) in expected.iter().zip(values(b)) {
                assert!(
                    (e - v).abs() < 1e-5 * (1.0 + e.abs()),
                    "{id}: {expected:?} {v}"
                );
            }
        }
    }
}
