//! What leaves the program: no model is worse than that of `identify`, `verify` on a model's own session gives
//! what was said, set-up errors or not, and what is made from a model makes the robot better. The robots are
//! plain trigonometry and `hidden_robot`, which share no code with the program.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::path::{Path, PathBuf};

use crate::cases::{cases, every_case};
use crate::hidden_robot::{Hidden, apart};
use crate::rig::Random;
use truepose::compensation::{NotHandedOut, TableError, VerifiedCalibration, verify};
use truepose::diagnosis::{Diagnosis, Options};
use truepose::effects::JointValues;
use truepose::export::{ExportError, Job};
use truepose::model::{Calibration, Model, read_model};
use truepose::pipeline::{self, Method, hand_out, identify_checked};
use truepose::programs::{Request, find};
use truepose::sessions::{Session, load, parse};

const DEG: f64 = std::f64::consts::PI / 180.0;

/// Every session of the repository, in a fixed order.
pub(crate) fn sessions() -> Vec<PathBuf> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut folders = vec![root.join("sessions")];
    for name in ["arms", "arm_verdicts", "observations", "programs"] {
        folders.push(root.join("tests/data").join(name));
    }
    let mut all = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
                continue;
            }
            let text = std::fs::read_to_string(&path).unwrap_or_default();
            let head = &text[..text.len().min(200)];
            if path.extension().is_some_and(|e| e == "json") && head.contains("truepose-session/1")
            {
                all.push(path);
            }
        }
    }
    all.sort();
    assert!(all.len() > 30, "{all:?}");
    all
}

/// The figure of `verify` that is to be what was said, and within which share of it.
pub(crate) fn figure_of(calibration: &Calibration, session: &Session) -> (f64, f64) {
    let verified = verify(calibration, session).unwrap();
    match verified.trimmed {
        Some(trimmed) => (trimmed.model_mm, 0.05),
        None => (verified.model.rms_mm, 0.01),
    }
}

/// That `verify` on the raw session gives what was said, by the model as it is written.
fn assert_as_said(calibration: &Calibration, session: &Session, said_mm: f64, what: &str) {
    let read = read_model(&hand_out(calibration, session).unwrap().document()).unwrap();
    assert_eq!(read.set_up, calibration.set_up, "{what}");
    let (found, within) = figure_of(&read, session);
    assert!(
        (found - said_mm).abs() <= within * said_mm.max(1e-6),
        "{what}: {found} mm, and {said_mm} was said; {:?}",
        calibration.set_up
    );
}

fn assert_no_worse(found: &Diagnosis, what: &str) {
    assert!(
        found.gap.end_mm <= found.gap.identified_mm,
        "{what}: {:?}",
        found.gap
    );
    if let Some(gaps) = found.held_out.gaps {
        assert!(gaps.end_mm <= gaps.identified_mm, "{what}: {gaps:?}");
    }
    let last = found.history.last().unwrap();
    assert_eq!(last.gap_mm, found.gap.end_mm, "{what}");
    // The names lead from the one model to the other.
    if let (Some(first), Some(last)) = (found.found.first(), found.found.last()) {
        assert_eq!(first.gap_mm[0], found.gap.identified_mm, "{what}");
        if found.unnamed.is_none() {
            assert_eq!(last.gap_mm[1], found.gap.end_mm, "{what}");
        }
    }
    let values: Vec<f64> = found.identified.iter().map(|p| p.value).collect();
    let all = &found.identification.parameters;
    for value in values {
        assert!(all.iter().any(|p| p.value == value), "{what}");
    }
    for parameter in all {
        if let Some([low, high]) = parameter.ci95 {
            let held = low <= parameter.value && parameter.value <= high;
            assert!(held, "{what}: {parameter:?}");
        }
    }
}

fn diagnosed(session: &Session) -> Diagnosis {
    pipeline::diagnose(session, &Options::default(), &|_| true).unwrap()
}

#[test]
fn verify_of_a_model_on_its_own_session_gives_what_identify_said() {
    let each = if every_case() { 1 } else { 3 };
    for path in sessions().iter().step_by(each) {
        let session = load(path).unwrap().session;
        let method = Method::default();
        let Ok(found) = identify_checked(&session, &method, JointValues::Commanded) else {
            continue;
        };
        let said = found.identification.gap.after.rms_mm;
        assert_as_said(
            &found.calibration,
            &session,
            said,
            &path.display().to_string(),
        );
    }
}

#[test]
fn no_diagnosis_of_the_repository_is_worse_than_its_identification() {
    let each = if every_case() { 1 } else { 3 };
    for path in sessions().iter().step_by(each) {
        let session = load(path).unwrap().session;
        // Long ones are diagnosed elsewhere.
        if session.samples.len() > 150 {
            continue;
        }
        let found = diagnosed(&session);
        let what = path.display().to_string();
        assert_no_worse(&found, &what);
        let calibration = found.calibration(&session);
        assert_as_said(&calibration, &session, found.gap.end_mm, &what);
    }
}

/// One axis of 320 mm with two reflectors; `turned` is added to the true angle and `by` to the points.
fn one_axis(
    seed: u64,
    count: usize,
    turned: impl Fn(f64) -> f64,
    seen: impl Fn(usize, [f64; 3]) -> [f64; 3],
    raw: impl Fn(f64) -> f64,
) -> Session {
    let mut random = Random(seed);
    let mut rows = String::new();
    for i in 0..count {
        let q = random.between(-170.0, 170.0);
        let (name, local) = match random.below(2) {
            0 => ("A", [0.0, 0.0, 0.0]),
            _ => ("B", [90.0, 30.0, 50.0]),
        };
        let (s, c) = ((q + 0.3 + turned(q)) * DEG).sin_cos();
        let (x, y) = (321.2 + local[0], local[1]);
        let point = [c * x - s * y, s * x + c * y, 210.0 + local[2]];
        let noisy = point.map(|v| v + 0.02 * random.normal());
        let [x, y, z] = seen(i, noisy);
        rows += &format!("[{},{x},{y},{z},\"{name}\"],", raw(q));
    }
    let rows: Vec<Vec<serde_json::Value>> =
        serde_json::from_str(&format!("[{}]", rows.trim_end_matches(','))).unwrap();
    let column =
        |k: usize| -> Vec<serde_json::Value> { rows.iter().map(|r| r[k].clone()).collect() };
    let document = serde_json::json!({
        "format": "truepose-session/1", "name": "axis",
        "robot": { "name": "axis", "joints": [ { "name": "a", "kind": "revolute", "axis": [0, 0, 1],
            "point_mm": [0, 0, 0], "limits": [-400, 400] } ],
            "tool": { "position_mm": [320, 0, 210], "quaternion_wxyz": [1, 0, 0, 0] } },
        "targets": { "A": [0, 0, 0], "B": [90, 30, 50] },
        "instrument": { "name": "t", "sigma_mm": 0.02 },
        "samples": { "columns": { "q1_deg": column(0), "x_mm": column(1), "y_mm": column(2),
            "z_mm": column(3), "target": column(4) } } });
    parse(document.to_string().as_bytes()).unwrap().session
}

const NOTHING: fn(f64) -> f64 = |_| 0.0;

fn as_it_is(_: usize, point: [f64; 3]) -> [f64; 3] {
    point
}

#[test]
fn a_model_beside_what_no_name_explains_is_no_worse_than_that_of_identify() {
    let bump = |q: f64| 0.04 * (-0.5 * ((q - 40.0) / 9.0).powi(2)).exp();
    let wave = |q: f64| 0.006 * ((3.0 * q * DEG).sin() + (q * DEG).cos().powi(5));
    let rounded = |_: usize, p: [f64; 3]| p.map(|v| (v * 10.0).round() / 10.0);
    for &seed in cases(&[1, 2, 3, 4, 5, 6], 2) {
        let all = [
            ("bump", one_axis(seed, 130, bump, as_it_is, |q| q)),
            ("wave", one_axis(seed, 130, wave, as_it_is, |q| q)),
            ("rounded", one_axis(seed, 130, NOTHING, rounded, |q| q)),
        ];
        for (what, session) in all {
            let found = diagnosed(&session);
            let what = format!("{what} {seed}");
            assert_no_worse(&found, &what);
            let calibration = found.calibration(&session);
            assert_as_said(&calibration, &session, found.gap.end_mm, &what);
            let method = Method::default();
            let identified = identify_checked(&session, &method, JointValues::Commanded).unwrap();
            // Over the same samples, all of them: a bump is an outlier to one and not to the other.
            let error = |model: &Calibration| verify(model, &session).unwrap().model.rms_mm;
            let (own, by) = (error(&calibration), error(&identified.calibration));
            assert!(own <= by * (1.0 + 1e-9), "{what}: {own}, {by}");
        }
    }
}

#[test]
fn the_headline_of_a_check_is_over_all_its_samples() {
    let session = one_axis(1, 60, NOTHING, as_it_is, |q| q);
    let method = Method::default();
    let found = identify_checked(&session, &method, JointValues::Commanded).unwrap();
    let moved = |i: usize, [x, y, z]: [f64; 3]| if i < 66 { [x, y, z] } else { [x, y + 0.5, z] };
    let check = one_axis(2, 100, NOTHING, moved, |q| q);
    let verified = verify(&found.calibration, &check).unwrap();
    let true_mm = (0.34 * 0.25_f64 + 3.0 * 0.02_f64.powi(2)).sqrt();
    assert!(
        (verified.model.rms_mm / true_mm - 1.0).abs() < 0.05,
        "{:?}, true {true_mm}",
        verified.model
    );
    let trimmed = verified.trimmed.unwrap();
    assert!(
        trimmed.set_aside > 20 && trimmed.model_mm < 0.1,
        "{trimmed:?}"
    );
    let problems = verified.data_problems.iter();
    let what: Vec<String> = problems.map(|p| p.what.to_string()).collect();
    assert!(what[0].contains("in a row"), "{what:?}");
    // One that is far off is an outlier, and no finding.
    let one_off = |i: usize, [x, y, z]: [f64; 3]| [x, y, if i == 7 { z + 1.0 } else { z }];
    let check = one_axis(2, 100, NOTHING, one_off, |q| q);
    let verified = verify(&found.calibration, &check).unwrap();
    assert_eq!(verified.trimmed.unwrap().set_aside, 1);
    assert!(
        verified.data_problems.is_empty(),
        "{:?}",
        verified.data_problems
    );
}

/// What a table of csv adds to a command in degrees, both columns being the same.
fn table(calibration: &VerifiedCalibration) -> impl Fn(f64) -> f64 + use<> {
    let export = pipeline::export("csv", &Job::new(calibration, "table.csv")).unwrap();
    let read = export.reads_as.unwrap();
    move |q| read.correction_outer(q, 0.0)
}

/// RMS error of the angle of one axis, degrees, with a table's corrections times `sign`.
fn driven(
    turned: impl Fn(f64) -> f64,
    raw: impl Fn(f64) -> f64,
    from_raw: impl Fn(f64) -> f64,
    by: impl Fn(f64) -> f64,
    sign: f64,
) -> f64 {
    let mut square = 0.0;
    let count = 300;
    for k in 0..count {
        let wanted = -160.0 + 320.0 * f64::from(k) / f64::from(count);
        let told = raw(wanted) + sign * by(raw(wanted));
        let q = from_raw(told);
        square += (q + 0.3 + turned(q) - wanted).powi(2);
    }
    (square / f64::from(count)).sqrt()
}

#[test]
fn a_table_makes_the_robot_better_and_with_the_sign_turned_it_doubles_the_error() {
    let eccentric = |q: f64| 0.06 * ((q - 30.0) * DEG).sin();
    let same: fn(f64) -> f64 = |q| q;
    let reversed: fn(f64) -> f64 = |q| -q;
    let quarter: fn(f64) -> f64 = |q| q - 90.0;
    let back: fn(f64) -> f64 = |q| q + 90.0;
    let half: fn(f64) -> f64 = |q| q + 180.0;
    let half_back: fn(f64) -> f64 = |q| q - 180.0;
    for (what, raw, from_raw) in [
        ("plain", same, same),
        ("reversed", reversed, reversed),
        ("home", quarter, back),
        ("half a turn", half, half_back),
    ] {
        let session = one_axis(3, 130, eccentric, as_it_is, raw);
        // What `identify` says corrects the same mistakes.
        let method = Method::default();
        let identified = identify_checked(&session, &method, JointValues::Commanded).unwrap();
        let by = table(&hand_out(&identified.calibration, &session).unwrap());
        let error = |sign: f64| driven(eccentric, raw, from_raw, &by, sign);
        assert!(error(1.0) < 0.2 * error(0.0), "{what}: {}", error(1.0));
        let found = diagnosed(&session);
        assert_no_worse(&found, what);
        assert_eq!(
            found.set_up.is_empty(),
            what == "plain",
            "{:?}",
            found.data_problems
        );
        let calibration = found.calibration(&session);
        assert_as_said(&calibration, &session, found.gap.end_mm, what);
        let verified = hand_out(&calibration, &session).unwrap();
        let by = table(&verified);
        let error = |sign: f64| driven(eccentric, raw, from_raw, &by, sign);
        let (before, after, turned) = (error(0.0), error(1.0), error(-1.0));
        assert!(after < 0.05 * before, "{what}: {before} → {after}");
        assert!(
            (turned / before - 2.0).abs() < 0.1,
            "{what}: {before} → {turned}"
        );
    }
}

#[test]
fn one_coordinate_is_enough_for_every_command() {
    for (name, heading, axis) in [
        ("x", "q1_deg,x_mm,y_mm,z_mm", "[0,0,1]"),
        ("y", "q1_deg,x_mm,y_mm,z_mm", "[0,0,1]"),
        ("z", "q1_deg,z_mm", "[0,-1,0]"),
    ] {
        let mut text = format!("{heading}\n");
        let mut random = Random(5);
        for i in 0..60 {
            let q = -170.0 + 340.0 * f64::from(i) / 59.0;
            let (s, c) = ((q + 0.2) * DEG).sin_cos();
            let value = 321.0 * if name == "x" { c } else { s } + 0.02 * random.normal();
            text += &match name {
                "x" => format!("{q},{value},,\n"),
                "y" => format!("{q},,{value},\n"),
                _ => format!("{q},{value}\n"),
            };
        }
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("one.json");
        let document = format!(
            r#"{{"format":"truepose-session/1","name":"one","robot":{{"name":"r","joints":[{{"name":"a",
            "kind":"revolute","axis":{axis},"point_mm":[0,0,0]}}],"tool":{{"position_mm":[320,0,0],
            "quaternion_wxyz":[1,0,0,0]}}}},"instrument":{{"name":"t","sigma_mm":0.02}},
            "samples":{{"file":"one.csv"}}}}"#
        );
        std::fs::write(&path, document).unwrap();
        std::fs::write(folder.path().join("one.csv"), text).unwrap();
        let session = load(&path).unwrap().session;
        let method = Method::default();
        let found = identify_checked(&session, &method, JointValues::Commanded).unwrap();
        let said = found.identification.gap.after.rms_mm;
        assert!((0.01..0.03).contains(&said), "{name}: {said}");
        assert_as_said(&found.calibration, &session, said, name);
        let found = diagnosed(&session);
        assert_no_worse(&found, name);
        let calibration = found.calibration(&session);
        assert_as_said(&calibration, &session, found.gap.end_mm, name);
    }
}

/// A set-up error: what it makes of true joint values, rad, and what they are again.
struct Mistake {
    name: &'static str,
    to_raw: fn(&mut [f64]),
    from_raw: fn(&mut [f64]),
}

const MISTAKES: [Mistake; 5] = [
    Mistake {
        name: "none",
        to_raw: |_| {},
        from_raw: |_| {},
    },
    Mistake {
        name: "joint 3 reversed",
        to_raw: |q| q[2] = -q[2],
        from_raw: |q| q[2] = -q[2],
    },
    Mistake {
        name: "home of joint 3",
        to_raw: |q| q[2] -= 90.0 * DEG,
        from_raw: |q| q[2] += 90.0 * DEG,
    },
    Mistake {
        name: "joints 2 and 3 coupled",
        to_raw: |q| q[2] += q[1],
        from_raw: |q| q[2] -= q[1],
    },
    Mistake {
        name: "joints 1 and 2 exchanged",
        to_raw: |q| q.swap(0, 1),
        from_raw: |q| q.swap(0, 1),
    },
];

#[test]
fn raw_targets_are_read_and_written_as_the_controller_has_them() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/programs");
    let hidden: serde_json::Value =
        serde_json::from_slice(&std::fs::read(folder.join("hidden.json")).unwrap()).unwrap();
    let robot = Hidden::new(&hidden["arm"]);
    let sound = load(folder.join("arm.json")).unwrap().session;
    for Mistake {
        name,
        to_raw,
        from_raw,
    } in MISTAKES
    {
        let mut session = sound.clone();
        for joint in &mut session.robot.joints {
            joint.limits = None;
        }
        for i in 0..session.samples.len() {
            let mut q: Vec<f64> = session.samples.q.iter().map(|q| q[i]).collect();
            to_raw(&mut q);
            for (column, q) in session.samples.q.iter_mut().zip(q) {
                column[i] = q;
            }
        }
        let method = Method::default();
        let found = identify_checked(&session, &method, JointValues::Commanded).unwrap();
        let calibration = &found.calibration;
        let corrected = calibration.set_up.moves_joints();
        assert_eq!(
            corrected,
            name != "none",
            "{name}: {:?}",
            found.data_problems
        );
        let said = found.identification.gap.after.rms_mm;
        assert_as_said(calibration, &session, said, name);
        let mut random = Random(9);
        let mut text = "q1_deg,q2_deg,q3_deg,q4_deg,q5_deg,q6_deg\n".to_owned();
        let mut wanted = Vec::new();
        for _ in 0..12 {
            let q: Vec<f64> = [
                [-60.0, 60.0],
                [-30.0, 40.0],
                [-40.0, 30.0],
                [-60.0, 60.0],
                [30.0, 80.0],
                [-60.0, 60.0],
            ]
            .map(|[a, b]| random.between(a, b) * DEG)
            .to_vec();
            let mut raw = q.clone();
            to_raw(&mut raw);
            let cells: Vec<String> = raw.iter().map(|v| format!("{:.6}", v / DEG)).collect();
            text += &(cells.join(",") + "\n");
            wanted.push(q);
        }
        let request = Request {
            calibration: &hand_out(calibration, &session).unwrap(),
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
        let (mut before, mut after, mut doubled) = (0.0, 0.0, 0.0);
        for (line, q) in written.lines().skip(1).zip(&wanted) {
            let mut told: Vec<f64> = line
                .split(',')
                .map(|v| v.parse::<f64>().unwrap() * DEG)
                .collect();
            from_raw(&mut told);
            let turned: Vec<f64> = q.iter().zip(&told).map(|(q, u)| 2.0 * q - u).collect();
            let goal = robot.nominal(q);
            before += apart(&robot.real(q, 0.0), &goal).0.powi(2);
            after += apart(&robot.real(&told, 0.0), &goal).0.powi(2);
            doubled += apart(&robot.real(&turned, 0.0), &goal).0.powi(2);
        }
        let [before, after, doubled] = [before, after, doubled].map(f64::sqrt);
        assert!(after < 0.1 * before, "{name}: {before} → {after}");
        assert!(
            (doubled / before - 2.0).abs() < 0.2,
            "{name}: {before} → {doubled}"
        );
    }
}

#[test]
fn a_model_that_is_not_what_was_said_or_makes_its_session_worse_is_not_handed_out() {
    let session = one_axis(1, 60, NOTHING, as_it_is, |q| q);
    let method = Method::default();
    let found = identify_checked(&session, &method, JointValues::Commanded).unwrap();
    let good = found.calibration;
    hand_out(&good, &session).unwrap();
    // What every term does turned about: the sign that a table is wrong in.
    let mut turned = good.model.terms().to_vec();
    for term in &mut turned {
        for coefficient in &mut term.coefficients {
            *coefficient = -*coefficient;
        }
    }
    let turned = Calibration {
        model: Model::new(good.model.robot.clone(), turned),
        ..good.clone()
    };
    let refused = hand_out(&turned, &session).unwrap_err();
    assert!(
        matches!(refused, NotHandedOut::OtherThanSaid { .. }),
        "{refused}"
    );
    let silent = Calibration {
        history: Vec::new(),
        ..turned
    };
    let refused = hand_out(&silent, &session).unwrap_err();
    assert!(
        matches!(refused, NotHandedOut::WorseThanNominal { .. }),
        "{refused}"
    );
    let mut worse = good.clone();
    let last = worse.history.last().unwrap().clone();
    worse.history.push(truepose::model::ResidualStep {
        gap_mm: 1.5 * last.gap_mm,
        ..last
    });
    let refused = hand_out(&worse, &session).unwrap_err();
    assert!(
        matches!(refused, NotHandedOut::WorseThanIdentified { .. }),
        "{refused}"
    );
    // A table that makes the session worse it is held against is none, whatever model it is of.
    let other = one_axis(2, 60, |_| -0.6, as_it_is, |q| q);
    let verified = hand_out(&good, &session).unwrap();
    let job = Job::new(&verified, "table.csv");
    assert!(pipeline::export_for("csv", &job, &session).is_ok());
    let refused = pipeline::export_for("csv", &job, &other).unwrap_err();
    assert!(
        matches!(refused, ExportError::MakesWorse { .. }),
        "{refused}"
    );
}

/// A joint value that is missing and was written as zero is far off, wherever it was, and bends whatever is fitted to
/// it; so do points of the nominal robot among measured ones, which are near.
#[test]
fn rows_that_are_none_of_the_robot_do_not_bend_what_is_handed_out() {
    let is_wrong = |q: f64, share: f64| (q.abs() * 1e4).floor() % share < 0.5;
    for &seed in cases(&[1, 2, 3, 4, 5, 6], 2) {
        for (share, count) in [(4.0, 60), (6.0, 130), (12.0, 40)] {
            let lost = move |q: f64| if is_wrong(q, share) { 0.0 } else { q };
            let pasted = move |q: f64| if is_wrong(q, share) { -0.3 } else { 0.0 };
            let unseen = one_axis(seed + 100, 80, NOTHING, as_it_is, |q| q);
            let left_mm = |session: &Session| {
                let calibration = diagnosed(session).calibration(session);
                let checked = verify(&calibration, &unseen).unwrap();
                [checked.nominal.rms_mm, checked.model.rms_mm]
            };
            let what = format!("{seed}: one in {share} of {count}");
            let session = one_axis(seed, count, NOTHING, as_it_is, lost);
            let [_, left] = left_mm(&session);
            assert!(left < 0.05, "{what}, lost: {left}");
            let session = one_axis(seed, count, pasted, as_it_is, |q| q);
            let [nominal, left] = left_mm(&session);
            // Of a quarter of points of another robot no estimate is sure; it is no worse than none.
            let most = nominal * if share < 6.0 { 1.0 } else { 0.2 };
            assert!(left < most, "{what}, pasted: {nominal} → {left}");
        }
    }
}

/// The same of one joint of an arm, with a code in place of what is missing.
#[test]
fn rows_of_an_arm_that_lost_a_joint_value_do_not_bend_what_is_handed_out() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/arms");
    let codes = [(11, 0.0), (17, -999.0_f64), (17, 0.0), (11, -999.0)];
    for &name in cases(&["parallel-200", "six-60", "six-200"], 2) {
        for &(share, code_deg) in cases(&codes, 2) {
            let right = load(folder.join(format!("{name}.json"))).unwrap().session;
            let mut wrong = right.clone();
            for q in wrong.samples.q[1].iter_mut().skip(3).step_by(share) {
                *q = code_deg.to_radians();
            }
            let what = format!("{name}: one in {share} at {code_deg}°");
            let calibration = diagnosed(&wrong).calibration(&wrong);
            let left_mm = verify(&calibration, &right).unwrap().model.rms_mm;
            assert!(left_mm < 0.1, "{what}: {left_mm}");
        }
    }
}

/// Unknown units, in a part of the rows or in a coordinate, leave errors of the robot's size: the values that are fitted
/// to them are no robot's.
#[test]
fn nothing_is_made_of_a_model_that_leaves_a_gross_error() {
    type Seen = fn(usize, [f64; 3]) -> [f64; 3];
    let mistakes: [(&str, Seen); 2] = [
        ("from the middle on in a unit of 17 mm", |i, p| {
            if i < 65 { p } else { p.map(|v| v / 17.0) }
        }),
        ("x in a unit of 1.7 mm", |_, [x, y, z]| [x / 1.7, y, z]),
    ];
    for (what, seen) in mistakes {
        let session = one_axis(5, 130, NOTHING, seen, |q| q);
        let calibrations = [
            diagnosed(&session).calibration(&session),
            identify_checked(&session, &Method::default(), JointValues::Commanded)
                .unwrap()
                .calibration,
        ];
        for calibration in calibrations {
            // A model that is not handed out at all makes nothing either.
            let Ok(verified) = hand_out(&calibration, &session) else {
                continue;
            };
            for format in ["csv", "linuxcnc", "urdf"] {
                let export = pipeline::export(format, &Job::new(&verified, "table"));
                let refused = matches!(export, Err(ExportError::Table(TableError::Gross { .. })));
                assert!(refused, "{what}: {format}: {export:?}");
            }
        }
    }
}
