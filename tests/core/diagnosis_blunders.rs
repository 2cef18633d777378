//! Mistakes of setting up and of measuring, made on a rig that shares no code with the model
//! (`support/rig.rs`): each has to be reported as what it is, and must not fake an effect.

use crate::cases::cases;
use crate::rig::{Design, Hidden, Random, Rig};
use truepose::diagnosis::{Diagnosis, Options, Verdict};
use truepose::effects::JointValues;
use truepose::pipeline::{diagnose, load};
use truepose::sessions::{Session, parse};

fn measured(design: &Design, ids: &[&str], lambda: f64, seed: u64) -> Rig {
    Rig::measured(design, ids, lambda, seed).0
}

fn session(rig: &Rig) -> Session {
    parse(rig.json("blunder").as_bytes())
        .expect("the rig writes a good session")
        .session
}

fn diagnosed(session: &Session) -> Diagnosis {
    diagnose(session, &Options::default(), &|_| true).expect("a diagnosis")
}

fn names(answer: &Diagnosis) -> Vec<&'static str> {
    answer.found.iter().map(|f| f.effect).collect()
}

fn reported(answer: &Diagnosis, what: &str) {
    let mut problems = answer.data_problems.iter();
    assert!(
        problems.any(|p| p.what.contains(what)),
        "{what}: {:?}",
        answer.data_problems
    );
}

fn with_backlash() -> Session {
    session(&measured(&Design::default(), &["backlash"], 400.0, 9))
}

/// Changes every measured point.
fn moved(session: &mut Session, to: impl Fn([f64; 3]) -> [f64; 3]) {
    let samples = &mut session.samples;
    let z = samples.z_mm.as_mut().expect("the rig measures z");
    for i in 0..z.len() {
        let p = to([samples.x_mm[i], samples.y_mm[i], z[i]]);
        (samples.x_mm[i], samples.y_mm[i], z[i]) = (p[0], p[1], p[2]);
    }
}

#[test]
fn a_joint_that_counts_the_other_way_round() {
    let mut reversed = with_backlash();
    reversed.samples.q[0].iter_mut().for_each(|q| *q = -*q);
    for column in [&mut reversed.samples.dir[0], &mut reversed.samples.speed[0]] {
        column.iter_mut().flatten().for_each(|v| *v = -*v);
    }
    let answer = diagnosed(&reversed);
    reported(&answer, "counts the other way");
    assert_eq!(names(&answer), ["backlash"]);
}

#[test]
fn coordinates_in_the_wrong_unit() {
    for (factor, unit) in [
        (1e-3, "metres"),
        (1.0 / 25.4, "inches"),
        (1e3, "micrometres"),
    ] {
        let mut wrong = with_backlash();
        moved(&mut wrong, |p| p.map(|v| v * factor));
        let answer = diagnosed(&wrong);
        reported(&answer, unit);
        assert_eq!(names(&answer), ["backlash"], "{unit}");
    }
}

#[test]
fn coordinates_of_an_arm_in_the_wrong_unit() {
    // Links that may shrink fit metres read as millimetres to a nanometre, and are no robot.
    for file in cases(&["tests/data/arms/six-60.json", "sessions/arm/arm.json"], 1) {
        let right = load(file).expect("a session of the repository").session;
        let found = identified_mm(&right);
        for (factor, unit) in [
            (1e-3, "metres"),
            (1.0 / 25.4, "inches"),
            (1e3, "micrometres"),
        ] {
            let mut wrong = right.clone();
            moved(&mut wrong, |p| p.map(|v| v * factor));
            let answer = diagnosed(&wrong);
            reported(&answer, unit);
            let ratio = answer.gap.identified_mm / found;
            assert!((ratio - 1.0).abs() < 0.01, "{file} in {unit}: {ratio}");
        }
    }
}

#[test]
fn one_coordinate_in_the_wrong_unit() {
    let axis = with_backlash();
    let arm = load("tests/data/arms/six-60.json")
        .expect("a session of the repository")
        .session;
    for (factor, unit) in [
        (1e-3, "metres"),
        (1.0 / 25.4, "inches"),
        (1e3, "micrometres"),
    ] {
        let mut wrong = axis.clone();
        moved(&mut wrong, |[x, y, z]| [x * factor, y, z]);
        let answer = diagnosed(&wrong);
        reported(&answer, &format!("the measured x is in {unit}"));
        assert_eq!(answer.data_problems.len(), 1, "{:?}", answer.data_problems);
        assert_eq!(names(&answer), ["backlash"], "{unit}");
        let mut wrong = arm.clone();
        moved(&mut wrong, |[x, y, z]| [x, y, z * factor]);
        let answer = diagnosed(&wrong);
        reported(&answer, &format!("the measured z is in {unit}"));
        let ratio = answer.gap.identified_mm / identified_mm(&arm);
        assert!((ratio - 1.0).abs() < 0.01, "{unit}: {ratio}");
    }
}

/// Three digits of a micrometre that was read as a millimetre are no resolution of 0.1 mm.
#[test]
fn digits_are_those_of_the_right_unit() {
    let rounded = |v: f64| (v * 1e4).round() / 10.0;
    let mut wrong = with_backlash();
    moved(&mut wrong, |p| p.map(rounded));
    let answer = diagnosed(&wrong);
    reported(&answer, "micrometres");
    assert_eq!(answer.data_problems.len(), 1, "{:?}", answer.data_problems);
    assert_eq!(names(&answer), ["backlash"]);
}

fn identified_mm(session: &Session) -> f64 {
    let found = diagnosed(session);
    assert!(
        found
            .data_problems
            .iter()
            .all(|p| !p.what.contains("coordinates"))
    );
    found.gap.identified_mm
}

#[test]
fn joint_values_in_the_wrong_unit() {
    let mut wrong = with_backlash();
    wrong.samples.q[0]
        .iter_mut()
        .for_each(|q| *q = q.to_radians());
    reported(&diagnosed(&wrong), "in radians but were read as degrees");

    let mut wrong = with_backlash();
    wrong.samples.q[0]
        .iter_mut()
        .for_each(|q| *q *= 400.0 / 360.0);
    let answer = diagnosed(&wrong);
    reported(&answer, "in gradians but were read as degrees");
    assert_eq!(names(&answer), ["backlash"]);
}

#[test]
fn joint_values_in_turns() {
    let mut wrong = with_backlash();
    wrong.samples.q[0].iter_mut().for_each(|q| *q /= 360.0);
    let answer = diagnosed(&wrong);
    reported(&answer, "in turns but were read as degrees");
    assert_eq!(names(&answer), ["backlash"]);
}

/// Of a motor before its gear, or the counts of an encoder: whole numbers and powers of two are told beside links and
/// homes that are off.
#[test]
fn joint_values_of_a_motor() {
    for (ratio, said) in [
        (81.0, "81"),
        (-160.0, "-160"),
        (65536.0 / 360.0, "182.0444"),
    ] {
        let mut wrong = with_backlash();
        wrong.samples.q[0].iter_mut().for_each(|q| *q *= ratio);
        for column in [&mut wrong.samples.dir[0], &mut wrong.samples.speed[0]] {
            let by = if ratio < 0.0 { -1.0 } else { 1.0 };
            column.iter_mut().flatten().for_each(|v| *v *= by);
        }
        let answer = diagnosed(&wrong);
        reported(&answer, &format!("are {said} times too large"));
        assert_eq!(names(&answer), ["backlash"], "{ratio}");
    }
    let right = load("tests/data/arms/six-60.json")
        .expect("a session of the repository")
        .session;
    let found = identified_mm(&right);
    for (joint, ratio, said) in [(1, 101.0, "101"), (4, 16384.0 / 360.0, "45.5111")] {
        let mut wrong = right.clone();
        wrong.samples.q[joint].iter_mut().for_each(|q| *q *= ratio);
        let answer = diagnosed(&wrong);
        reported(&answer, &format!("are {said} times too large"));
        let ratio = answer.gap.identified_mm / found;
        assert!((ratio - 1.0).abs() < 0.01, "joint {joint}: {ratio}");
    }
}

/// Values that are half of what they should be have no unit of that size: it is the scale of the axis.
#[test]
fn a_scale_that_is_far_off_hides_no_effect() {
    let mut wrong = with_backlash();
    wrong.samples.q[0].iter_mut().for_each(|q| *q *= 0.5);
    let answer = diagnosed(&wrong);
    reported(&answer, "joint 1 moves 2.000");
    assert_eq!(names(&answer), ["backlash"]);
}

#[test]
fn an_error_of_no_machine_is_no_name() {
    let mut wrong = with_backlash();
    wrong.samples.q[0]
        .iter_mut()
        .for_each(|q| *q *= 0.3 * q.abs());
    let answer = diagnosed(&wrong);
    assert_eq!(names(&answer), [] as [&str; 0]);
    assert_eq!(answer.verdict, Verdict::Unexplained);
}

#[test]
fn targets_as_places_in_the_base_frame() {
    let right = with_backlash();
    let mut wrong = right.clone();
    for target in &mut wrong.targets {
        target.position_mm = right.robot.base_from_tool * target.position_mm;
    }
    let answer = diagnosed(&wrong);
    reported(&answer, "places in the base frame");
    assert_eq!(answer.data_problems.len(), 1);
    assert_eq!(names(&answer), ["backlash"]);
    let left = diagnosed(&right).gap.end_mm;
    assert!(
        (answer.gap.end_mm - left).abs() < 1e-9 * left,
        "as if nothing had been"
    );
}

/// A slide of 2 m, out and back, seen with 0.02 mm; its guide is bent by `bent_mm` at its ends, and its values are in
/// a unit of so many mm.
fn slide(bent_mm: f64, unit_mm: f64) -> Session {
    let mut random = Random(5);
    let way = (0..60).map(|k| 20.0 + 32.0 * f64::from(k));
    let columns = way.clone().chain(way.rev()).map(|q| {
        let u = (q - 1000.0) / 1000.0;
        let point = [
            q + 0.4,
            50.0 + bent_mm * u * u,
            80.0 - 0.5 * bent_mm * u.powi(3),
        ];
        (q / unit_mm, point.map(|v| v + 0.02 * random.normal()))
    });
    let (q, points): (Vec<f64>, Vec<[f64; 3]>) = columns.unzip();
    let column = |k: usize| -> Vec<f64> { points.iter().map(|p| p[k]).collect() };
    let time: Vec<f64> = (0..q.len()).map(|k| 8.0 * k as f64).collect();
    let document = serde_json::json!({
        "format": "truepose-session/1", "name": "slide",
        "robot": { "name": "slide", "joints": [ { "name": "x", "kind": "prismatic", "axis": [1, 0, 0],
            "point_mm": [0, 0, 0], "limits": [0, 2000] } ],
            "tool": { "position_mm": [0, 50, 80], "quaternion_wxyz": [1, 0, 0, 0] } },
        "targets": { "A": [0, 0, 0] }, "instrument": { "name": "t", "sigma_mm": 0.02 },
        "samples": { "columns": { "q1_mm": q, "x_mm": column(0), "y_mm": column(1), "z_mm": column(2),
            "time_s": time } } });
    parse(document.to_string().as_bytes())
        .expect("a good session")
        .session
}

#[test]
fn the_values_of_a_slide_in_the_wrong_unit() {
    for (unit_mm, unit) in [(10.0, "centimetres"), (25.4, "inches"), (1000.0, "metres")] {
        let answer = diagnosed(&slide(0.0, unit_mm));
        reported(&answer, &format!("in {unit} but were read as millimetres"));
        assert_eq!(answer.verdict, Verdict::Noise, "{unit}");
    }
}

/// What comes back at the same place of a guide is no frame that wanders, though it changes as slowly.
#[test]
fn a_bent_guide_is_no_noise() {
    assert_eq!(diagnosed(&slide(0.0, 1.0)).verdict, Verdict::Noise);
    for bent_mm in [0.1, 0.3] {
        let answer = diagnosed(&slide(bent_mm, 1.0));
        assert_eq!(answer.verdict, Verdict::Unexplained, "{bent_mm}");
    }
}

#[test]
fn axes_that_were_swapped() {
    for (order, what) in [
        ([1, 0, 2], "x and y"),
        ([0, 2, 1], "y and z"),
        ([2, 1, 0], "x and z"),
    ] {
        let mut wrong = with_backlash();
        moved(&mut wrong, |p| order.map(|k: usize| p[k]));
        let answer = diagnosed(&wrong);
        reported(&answer, what);
        assert_eq!(names(&answer), ["backlash"], "{what}");
    }
}

#[test]
fn a_home_position_off_by_a_quarter_or_half_turn() {
    for (turn, what) in [
        (90.0, "off by 90"),
        (-90.0, "off by -90"),
        (180.0, "off by 180"),
    ] {
        let rig = measured(&Design::default(), &[], 0.0, 9);
        let mut off = session(&rig);
        let turn = f64::to_radians(turn);
        off.samples.q[0].iter_mut().for_each(|q| *q -= turn);
        let answer = diagnosed(&off);
        reported(&answer, what);
        assert_eq!(answer.verdict, Verdict::Noise, "{what}");
    }
}

#[test]
fn a_measuring_frame_that_was_never_aligned() {
    let mut wrong = with_backlash();
    let (s, c) = 0.5_f64.sin_cos();
    moved(&mut wrong, |p| {
        [
            p[0] + 800.0,
            c * p[1] - s * p[2] - 350.0,
            s * p[1] + c * p[2] + 120.0,
        ]
    });
    let answer = diagnosed(&wrong);
    reported(&answer, "never aligned");
    assert_eq!(names(&answer), ["backlash"]);
}

#[test]
fn a_reflector_that_was_lost() {
    let mut lost = with_backlash();
    let z = lost.samples.z_mm.as_mut().expect("the rig measures z");
    for i in [3, 40] {
        (lost.samples.x_mm[i], lost.samples.y_mm[i], z[i]) = (0.0, 0.0, 0.0);
    }
    let answer = diagnosed(&lost);
    reported(&answer, "lost the reflector in 2 samples: 4, 41");
    assert_eq!(names(&answer), ["backlash"]);
    assert!(answer.outliers.is_empty(), "{:?}", answer.outliers);
}

#[test]
fn the_other_reflector_or_a_point_that_does_not_move() {
    let design = Design {
        samples: 160,
        reflectors: 2,
        ..Design::default()
    };
    let rig = measured(&design, &["backlash"], 400.0, 9);
    let mut wrong = rig.clone();
    for i in [20, 61] {
        // The same pose, seen on the other reflector.
        wrong.measured[i] = rig.measured[i ^ 1];
    }
    let answer = diagnosed(&session(&wrong));
    reported(&answer, "saw reflector T1 instead in 1 sample: 62");
    reported(&answer, "saw reflector T2 instead in 1 sample: 21");
    assert_eq!(names(&answer), ["backlash"]);

    let mut stuck = rig.clone();
    for i in [30, 31, 32, 33] {
        stuck.measured[i] = rig.measured[30];
    }
    // At the first of them it was there: the robot has stood, or the instrument.
    let answer = diagnosed(&session(&stuck));
    reported(&answer, "the robot stood still in 3 samples: 32, 33, 34");
    assert_eq!(names(&answer), ["backlash"]);
}

fn from_read_values(session: &Session) -> Diagnosis {
    let options = Options {
        joint_values: JointValues::Read,
        ..Options::default()
    };
    diagnose(session, &options, &|_| true).expect("a diagnosis")
}

#[test]
fn a_read_back_that_lags_is_reported_and_fakes_nothing() {
    for (seed, one_speed) in [(1, false), (2, true)] {
        let design = Design {
            one_speed,
            ..Design::default()
        };
        let mut rig = measured(&design, &[], 0.0, seed);
        rig.read_back_lag_s = Some(0.008);
        for answer in [diagnosed(&session(&rig)), from_read_values(&session(&rig))] {
            reported(&answer, "lag the command by 8.00 ms");
            assert_eq!(answer.verdict, Verdict::Noise, "{:?}", names(&answer));
        }
    }
}

#[test]
fn an_effect_is_found_beside_a_read_back_that_lags() {
    let mut rig = measured(&Design::default(), &["backlash"], 400.0, 5);
    rig.read_back_lag_s = Some(0.008);
    for answer in [diagnosed(&session(&rig)), from_read_values(&session(&rig))] {
        reported(&answer, "lag the command");
        assert_eq!(names(&answer), ["backlash"]);
    }
}

#[test]
fn a_joint_that_truly_lags_is_no_mistake_of_reading() {
    let mut rig = measured(&Design::default(), &[], 0.0, 5);
    rig.hidden = vec![Hidden::Lag(0.008)];
    rig.measure(&mut Random(5));
    rig.read_back_lag_s = Some(0.008);
    let answer = diagnosed(&session(&rig));
    assert!(
        answer.data_problems.is_empty(),
        "{:?}",
        answer.data_problems
    );
    assert_eq!(names(&answer), ["tracking-lag"]);
    assert_eq!(from_read_values(&session(&rig)).verdict, Verdict::Noise);
}

/// A base that is off by millimetres on an axis whose zero is off by degrees has its name: no frame that nobody aligned.
#[test]
fn a_base_offset_beside_a_zero_offset_keeps_its_name() {
    let path = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("sessions/paper-30.json");
    for off_mm in [2.0, 20.0] {
        let mut session = load(&path).unwrap().session;
        session.samples.x_mm.iter_mut().for_each(|x| *x += off_mm);
        let answer = diagnose(&session, &Options::default(), &|_| true).unwrap();
        let names: Vec<&str> = answer.found.iter().map(|found| found.effect).collect();
        assert_eq!(names, ["base-offset"]);
        assert!(
            answer.data_problems.is_empty(),
            "{:?}",
            answer.data_problems
        );
    }
}
