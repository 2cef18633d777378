//! What predicts without a name, on a hidden six-joint arm of plain matrices that shares no code with the program: gravity of unknown
//! masses, harmonics of gears and a smooth pull, which no single name explains.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::path::Path;

use crate::hidden_robot::{Hidden, apart};
use crate::rig::Random;
use truepose::compensation::verify;
use truepose::diagnosis::{Diagnosis, Options};
use truepose::effects::{Inputs, JointValues};
use truepose::export::Job;
use truepose::model::{Calibration, read_model};
use truepose::pipeline::{self, Method};
use truepose::programs::{Request, find};
use truepose::sessions::{Session, Sigma, load};

const DEG: f64 = std::f64::consts::PI / 180.0;
const SIGMA_MM: f64 = 0.02;

fn folder() -> std::path::PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/programs")
}

fn hidden() -> Hidden {
    let text = std::fs::read(folder().join("hidden.json")).unwrap();
    let all: serde_json::Value = serde_json::from_slice(&text).unwrap();
    Hidden::new(&all["arm"])
}

/// What the joints do beside everything that the geometry holds, rad: a sag, gears, cables.
fn turned(q: &[f64]) -> Vec<f64> {
    let mut q = q.to_vec();
    let (a, b) = (q[1], q[1] + q[2]);
    let by = [
        2.5e-4 * (1.3 * q[0]).tanh() + 1e-4 * (3.0 * q[0] + 0.4).sin(),
        -6e-4 * a.sin() + 4e-4 * (b + 0.3).cos(),
        5e-4 * (b + 0.3).cos() + 2e-4 * (4.0 * q[2]).cos(),
        2e-4 * (2.0 * q[4] + 1.0).sin(),
        1.5e-4 * (5.0 * q[4]).sin() - 2e-4 * b.sin() * q[4].cos(),
        0.0,
    ];
    for (value, by) in q.iter_mut().zip(by) {
        *value += by;
    }
    q
}

/// A session of so many poses; `more` is what the joints do besides.
pub(crate) fn session(poses: usize, seed: u64, more: fn(&[f64]) -> Vec<f64>) -> Session {
    session_within(poses, seed, more, None, 1)
}

/// The same with joint 2 in a range of its own, rad, and so many rows of each pose.
fn session_within(
    poses: usize,
    seed: u64,
    more: fn(&[f64]) -> Vec<f64>,
    second: Option<[f64; 2]>,
    rows: usize,
) -> Session {
    let robot = hidden();
    let mut session = load(folder().join("arm.json")).unwrap().session;
    let mut random = Random(seed);
    let limits: Vec<_> = session.robot.joints.iter().map(|j| j.limits).collect();
    let targets = session.targets.len();
    let samples = &mut session.samples;
    samples.q = vec![Vec::new(); limits.len()];
    samples.q_read = vec![None; limits.len()];
    let mut points = [Vec::new(), Vec::new(), Vec::new()];
    let mut target = Vec::new();
    let mut pose = Vec::new();
    for k in 0..poses * rows {
        let mut next: Vec<f64> = limits
            .iter()
            .map(|l| {
                let l = l.unwrap();
                let (from, to) = (l.from.max(-160.0 * DEG), l.to.min(160.0 * DEG));
                random.between(0.9 * from, 0.9 * to)
            })
            .collect();
        if let Some([from, to]) = second {
            next[1] = random.between(from, to);
        }
        if k % rows == 0 {
            pose.clone_from(&next);
        }
        let own = k % targets;
        let place = session.targets[own].position_mm;
        let to = robot.real(&more(&pose), 0.0);
        for (axis, points) in points.iter_mut().enumerate() {
            let row = to[axis];
            let at = row[0] * place.x + row[1] * place.y + row[2] * place.z + row[3];
            points.push(at + SIGMA_MM * random.normal());
        }
        for (column, q) in samples.q.iter_mut().zip(&pose) {
            column.push(*q);
        }
        target.push(u32::try_from(own).unwrap());
    }
    let [x, y, z] = points;
    (samples.x_mm, samples.y_mm, samples.z_mm) = (x, y, Some(z));
    samples.target = Some(target);
    samples.load_kg = None;
    session.instrument.sigma_mm = Some(Sigma::Overall(SIGMA_MM));
    session
}

pub(crate) fn diagnosed(session: &Session, without_unnamed: bool) -> Diagnosis {
    let options = Options {
        // The search is not what is looked at here.
        max_effects: Some(2),
        without_unnamed,
        ..Options::default()
    };
    pipeline::diagnose(session, &options, &|_| true).unwrap()
}

fn calibration(found: &Diagnosis, session: &Session) -> Calibration {
    found.calibration(session)
}

#[test]
fn what_no_name_explains_predicts_poses_that_no_fit_has_seen() {
    let measured = session(260, 3, turned);
    let found = diagnosed(&measured, false);
    let unnamed = found.unnamed.clone().unwrap();
    let [before, after] = unnamed.held_out_mm;
    assert!(after < 0.8 * before, "{unnamed:?}");
    assert_eq!(found.held_out.gaps.unwrap().end_mm, after);
    assert!(found.gap.end_mm <= found.gap.identified_mm);
    // Other poses of the same robot, with other noise.
    let fresh = session(300, 4, turned);
    let alone = diagnosed(&measured, true);
    assert!(alone.unnamed.is_none());
    let check = |d: &Diagnosis| {
        verify(&calibration(d, &measured), &fresh)
            .unwrap()
            .model
            .rms_mm
    };
    let (with, without) = (check(&found), check(&alone));
    assert!(with < 0.8 * without, "{without} → {with} mm");
    // As promised on unseen cells.
    assert!((with / after - 1.0).abs() < 0.2, "{with} and {after} mm");
    // `--no-unnamed` is the answer without it, and names do not change.
    let names = |d: &Diagnosis| -> Vec<_> { d.found.iter().map(|f| (f.effect, f.joint)).collect() };
    assert_eq!(names(&found), names(&alone));
    assert!(alone.model.terms().iter().all(|t| t.rest().is_none()));
}

/// Over 7° a harmonic of joint 2 is hardly more than a constant, which belongs to the geometry: of a real arm both grew to
/// 1.8 mm against each other, all of which was left where the harmonic had faded.
#[test]
fn outside_a_narrow_range_the_geometry_is_right_by_itself() {
    let narrow = Some([28.0 * DEG, 35.0 * DEG]);
    let measured = session_within(260, 3, turned, narrow, 1);
    let elsewhere = session_within(200, 4, turned, Some([15.0 * DEG, 22.0 * DEG]), 1);
    let error = |without: bool| {
        let found = diagnosed(&measured, without);
        assert_eq!(found.unnamed.is_some(), !without);
        let made = calibration(&found, &measured);
        verify(&made, &elsewhere).unwrap().model.rms_mm
    };
    let (with, without) = (error(false), error(true));
    assert!(with < 1.3 * without, "{without} → {with} mm");
}

/// Joint 2 is told to go beyond its stop, 2° farther in each of eight rows, and stays there: the rows are set aside, and it is
/// no joint that does not repeat.
#[test]
fn a_joint_at_its_stop_is_no_lack_of_repeatability() {
    // Of sixty sessions these two were off by 1.8 mm where the joints might not repeat before the rows were set aside.
    for seed in [14, 16] {
        let mut measured = session_within(120, seed, <[f64]>::to_vec, None, 1);
        let samples = &mut measured.samples;
        for (row, told) in (41..49).zip(1_u8..) {
            let stays = |column: &mut Vec<f64>, by: f64| column[row] = column[40] + by;
            samples.q.iter_mut().for_each(|q| stays(q, 0.0));
            samples.q[1][row] += 2.0 * f64::from(told) * DEG;
            let noise = SIGMA_MM * if told % 2 == 0 { 1.0 } else { -1.0 };
            stays(&mut samples.x_mm, noise);
            stays(&mut samples.y_mm, -noise);
            samples.z_mm.iter_mut().for_each(|z| stays(z, noise));
            samples.target.as_mut().unwrap()[row] = 40 % 3;
        }
        let (answer, _) =
            pipeline::identify(&measured, &Method::default(), JointValues::Commanded).unwrap();
        assert_eq!(answer.outliers.len(), 8);
        let left_mm = answer.gap.after.rms_mm;
        assert!(left_mm < 1.2 * SIGMA_MM * 3_f64.sqrt(), "{left_mm}");
    }
}

/// Three reflectors a pose show what a sag does to all of them as something that the robot does not repeat. Beside that noise
/// the fit left the sag where it was; with one reflector a pose there is no such noise.
#[test]
fn a_sag_is_no_lack_of_repeatability() {
    let sagging: fn(&[f64]) -> Vec<f64> = |q| {
        let by = turned(q);
        q.iter().zip(by).map(|(q, by)| q + 6.0 * (by - q)).collect()
    };
    let fresh = session(300, 4, sagging);
    let [three, one] = [3, 1].map(|rows| {
        let measured = session_within(150, 3, sagging, None, rows);
        let (answer, calibration) =
            pipeline::identify(&measured, &Method::default(), JointValues::Commanded).unwrap();
        let notes: Vec<String> = answer.notes.iter().map(ToString::to_string).collect();
        let alike = notes
            .iter()
            .any(|note| note.contains("every row counts alike"));
        assert_eq!(alike, rows == 3, "{notes:?}");
        verify(&calibration, &fresh).unwrap().model.rms_mm
    });
    assert!(three < 1.05 * one, "{three} and {one} mm");
}

#[test]
fn with_nothing_hidden_there_is_nothing_without_a_name() {
    for seed in 0..4 {
        let session = session(120, 20 + seed, <[f64]>::to_vec);
        let found = diagnosed(&session, false);
        assert_eq!(found.unnamed, None, "{seed}");
    }
}

#[test]
fn a_model_that_is_read_back_predicts_the_same_to_the_last_bit_and_verify_says_what_was_said() {
    let measured = session(260, 3, turned);
    let found = diagnosed(&measured, false);
    let made = calibration(&found, &measured);
    assert!(made.model.terms().iter().any(|t| t.rest().is_some()));
    let read = read_model(&pipeline::hand_out(&made, &measured).unwrap().document()).unwrap();
    assert_eq!(read.model, made.model);
    let inputs = Inputs::new(&measured, JointValues::Commanded);
    assert_eq!(read.model.predict(&inputs), made.model.predict(&inputs));
    let said = verify(&read, &measured).unwrap().model.rms_mm;
    assert!(
        (said / found.gap.end_mm - 1.0).abs() < 0.01,
        "{said} {}",
        found.gap.end_mm
    );
}

#[test]
fn the_hidden_robot_is_nearer_to_the_drawing_with_it() {
    let robot = hidden();
    let measured = session(260, 3, turned);
    let mut random = Random(9);
    let mut text = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n".to_owned();
    let mut wanted = Vec::new();
    for _ in 0..20 {
        let ranges = [
            [-60.0, 60.0],
            [-30.0, 40.0],
            [-40.0, 30.0],
            [-60.0, 60.0],
            [30.0, 80.0],
            [-60.0, 60.0],
        ];
        let q: Vec<f64> = ranges.map(|[a, b]| random.between(a, b) * DEG).to_vec();
        let cells: Vec<String> = q.iter().map(|v| format!("{:.6}", v / DEG)).collect();
        text += &(cells.join(",") + "\n");
        wanted.push(q);
    }
    let driven = |found: &Diagnosis| {
        let request = Request {
            calibration: &pipeline::hand_out(&calibration(found, &measured), &measured).unwrap(),
            bytes: text.as_bytes(),
            language: find("csv").unwrap(),
            file: None,
            beside: Vec::new(),
            load_kg: 0.0,
            start: None,
            frame: None,
            tool: None,
            measured_frame: false,
            frames: truepose::programs::ProgramFrames::default(),
        };
        let answer = pipeline::compensate(&request).unwrap();
        let written = String::from_utf8(answer.bytes).unwrap();
        let mut square = 0.0;
        for (line, q) in written.lines().skip(1).zip(&wanted) {
            let told: Vec<f64> = line
                .split(',')
                .map(|v| v.parse::<f64>().unwrap() * DEG)
                .collect();
            square += apart(&robot.real(&turned(&told), 0.0), &robot.nominal(q))
                .0
                .powi(2);
        }
        (square / wanted.len() as f64).sqrt()
    };
    let with = driven(&diagnosed(&measured, false));
    let without = driven(&diagnosed(&measured, true));
    assert!(with < 0.7 * without, "{without} → {with} mm");
}

#[test]
fn a_chain_that_cannot_hold_it_is_that_of_the_geometry_without_it() {
    let measured = session(260, 3, turned);
    let urdf = |without: bool| {
        let made = calibration(&diagnosed(&measured, without), &measured);
        let made = pipeline::hand_out(&made, &measured).unwrap();
        pipeline::export("urdf", &Job::new(&made, "arm.urdf")).unwrap()
    };
    let (with, without) = (urdf(false), urdf(true));
    assert!(with.robot.is_some());
    assert_eq!(with.robot, without.robot);
}

#[test]
fn one_thread_and_two_give_the_same_bytes() {
    let measured = session(220, 9, turned);
    let on = |threads: usize| {
        let options = Options {
            max_effects: Some(4),
            threads: Some(threads),
            ..Options::default()
        };
        let found = pipeline::diagnose(&measured, &options, &|_| true).unwrap();
        let model = pipeline::hand_out(&calibration(&found, &measured), &measured);
        // Every digit of all numbers, and the model that goes out.
        (format!("{found:?}"), pipeline::write_model(&model.unwrap()))
    };
    let (alone, together) = (on(1), on(2));
    assert!(
        alone.0.contains("unnamed: Some("),
        "its parts are done side by side"
    );
    assert_eq!(alone, together);
    assert_eq!(on(3), alone);
}
