//! Sessions of arms on which an answer has to be right: `tests/reference/arm_verdicts.py` made them
//! with numpy, and the longest is made here from rotations alone. None may get a false name.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::fmt::Write as _;
use std::path::PathBuf;

use crate::rig::Random;
use truepose::diagnosis::{Diagnosis, Options, Verdict};
use truepose::effects::JointValues;
use truepose::pipeline::{Identified, Method, diagnose, hand_out, identify_checked, verify};
use truepose::sessions::{Session, load, parse};

fn session(name: &str) -> Session {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data/arm_verdicts");
    load(folder.join(format!("{name}.json"))).unwrap().session
}

fn diagnosed(session: &Session) -> Diagnosis {
    diagnose(session, &Options::default(), &|_| true).unwrap()
}

fn identified(session: &Session) -> Identified {
    identify_checked(session, &Method::default(), JointValues::Commanded).unwrap()
}

/// Names with their joints.
fn names(answer: &Diagnosis) -> Vec<(&'static str, Option<usize>)> {
    answer.found.iter().map(|f| (f.effect, f.joint)).collect()
}

/// Both answers have to name this mistake of setting up, and nothing else.
fn is_noise_but_for(session: &Session, mistake: Option<&str>) -> Diagnosis {
    let answer = diagnosed(session);
    assert_eq!(names(&answer), []);
    assert_eq!(answer.verdict, Verdict::Noise, "{:?}", answer.unexplained);
    let identified = identified(session);
    for problems in [&answer.data_problems, &identified.data_problems] {
        let said: Vec<String> = problems.iter().map(|p| p.what.to_string()).collect();
        match mistake {
            None => assert_eq!(said, Vec::<String>::new()),
            Some(mistake) => assert!(said.len() == 1 && said[0].contains(mistake), "{said:?}"),
        }
    }
    assert!(identified.identification.gap.after.rms_mm < 0.055);
    answer
}

/// What is held because the samples cannot tell it from something else.
fn held(answer: &Diagnosis) -> Vec<String> {
    let all = answer.identification.not_identifiable.iter();
    let all = all.map(|n| n.combination.to_string());
    all.map(|n| n.split(" with ").next().unwrap().to_owned())
        .collect()
}

#[test]
fn a_frame_that_was_never_aligned() {
    let answer = is_noise_but_for(&session("never-aligned"), Some("never aligned"));
    assert!(held(&answer).contains(&"joint-zero-offset of joint 1: offset_deg".to_owned()));
}

#[test]
fn a_joint_that_counts_the_other_way_round_is_said_with_its_number() {
    is_noise_but_for(
        &session("joint-4-reversed"),
        Some("joint 4 counts the other way round"),
    );
}

#[test]
fn the_sign_of_the_wrists_middle_joint_is_said_with_its_twin() {
    let mut reversed = session("joint-4-reversed");
    for joint in [3, 4] {
        reversed.samples.q[joint].iter_mut().for_each(|q| *q = -*q);
    }
    let answer = is_noise_but_for(&reversed, Some("joint 5 counts the other way round"));
    let what = &answer.data_problems[0].what;
    let twin = "the home positions of joints 4 and 6 are off by 180°";
    assert!(what.contains(twin), "{what}");
}

/// What is said, and what was done wrong.
type Mistake<'m> = (&'m str, &'m dyn Fn(&mut Session));

#[test]
fn other_mistakes_are_said_with_their_joints() {
    let right = {
        let mut session = session("joint-4-reversed");
        session.samples.q[3].iter_mut().for_each(|q| *q = -*q);
        session
    };
    let turned = f64::to_radians(90.0);
    let cases: [Mistake; 5] = [
        ("home position of joint 3 is off by 90°", &|s| {
            s.samples.q[2].iter_mut().for_each(|q| *q -= turned);
        }),
        ("joints 4 and 6 are exchanged", &|s| s.samples.q.swap(3, 5)),
        ("joints 2 and 3 are coupled (parallelogram)", &|s| {
            for i in 0..s.samples.q[2].len() {
                s.samples.q[2][i] += s.samples.q[1][i];
            }
        }),
        ("joints 1 and 5 are coupled", &|s| {
            for i in 0..s.samples.q[4].len() {
                s.samples.q[4][i] += s.samples.q[0][i];
            }
        }),
        ("joint 5 are in radians", &|s| {
            s.samples.q[4].iter_mut().for_each(|q| *q = q.to_radians());
        }),
    ];
    for (what, mistake) in cases {
        let mut wrong = right.clone();
        mistake(&mut wrong);
        let said = identified(&wrong).data_problems;
        assert!(said.len() == 1 && said[0].what.contains(what), "{said:?}");
    }
    assert_eq!(identified(&right).data_problems, []);
}

/// As a maker counts: two signs, two homes and a parallelogram otherwise than in the description.
#[test]
fn conventions_that_differ_in_many_joints_are_said_joint_by_joint() {
    let mut session = session("joint-4-reversed");
    let quarter = f64::to_radians(90.0);
    let q = &mut session.samples.q;
    q[1].iter_mut().for_each(|q| *q += quarter);
    for k in 0..q[2].len() {
        q[2][k] += quarter + q[1][k];
    }
    q[5].iter_mut().for_each(|q| *q = -*q);
    let found = identified(&session);
    let said: Vec<String> = found
        .data_problems
        .iter()
        .map(|p| p.what.to_string())
        .collect();
    let expected = [
        "joints 2 and 3 are coupled (parallelogram) but were taken for uncoupled",
        "the home position of joint 2 is off by -90°",
        "the home position of joint 3 is off by -90°",
        "joint 4 counts the other way round",
        "joint 6 counts the other way round",
    ];
    assert_eq!(said, expected);
    let left = found.identification.gap.after.rms_mm;
    assert!(left < 0.055);
    let model = hand_out(&found.calibration, &session).unwrap();
    let verified = verify(&model, &session).unwrap();
    assert!((verified.model.rms_mm / left - 1.0).abs() < 0.01, "{left}");
    let mut at_random = session.clone();
    for (k, x) in at_random.samples.x_mm.iter_mut().enumerate() {
        *x = 800.0 * (k as f64 * 1.7).sin();
    }
    assert_eq!(
        identified(&at_random).data_problems,
        [],
        "nothing explains it"
    );
}

#[test]
fn a_tool_or_its_targets_that_are_elsewhere_are_said() {
    let right = {
        let mut session = session("joint-4-reversed");
        session.samples.q[3].iter_mut().for_each(|q| *q = -*q);
        session
    };
    let mut placed = right.clone();
    for target in &mut placed.targets {
        target.position_mm = right.robot.base_from_tool * target.position_mm;
    }
    is_noise_but_for(&placed, Some("places in the base frame, not in the tool"));
    let mut forgotten = right.clone();
    forgotten.robot.base_from_tool.translation.vector.x -= 300.0;
    is_noise_but_for(&forgotten, Some("from where the session states"));
}

/// Robots that are farther off than priors take them to be, in 24 and 36 poses (`poor-arm` of
/// `tests/reference/wild_rows.py`, sessions 89 and 72): a name would only take up what the priors hold back.
#[test]
fn priors_that_hold_a_robot_back_are_no_reason_for_a_name() {
    for name in ["poor-24", "poor-36"] {
        let answer = diagnosed(&session(name));
        assert_eq!(names(&answer), [], "{name}");
        assert_eq!(answer.data_problems, [], "{name}");
    }
}

#[test]
fn twenty_poses_and_what_they_leave_open() {
    let answer = is_noise_but_for(&session("twenty-poses"), None);
    assert_eq!(held(&answer).len(), 11);
}

#[test]
fn poses_on_one_side_name_nothing_and_say_where_the_model_is_unsure() {
    let one_side = session("one-side");
    is_noise_but_for(&one_side, None);
    let identified = identified(&one_side).identification;
    let expected = identified.expected.unwrap();
    assert!(expected.extrapolates(), "{expected:?}");
    assert!(expected.rms_mm > 3.0 * expected.measured_rms_mm);
    let everywhere = self::identified(&session("dh-row")).identification;
    assert!(!everywhere.expected.unwrap().extrapolates());
}

#[test]
fn a_row_that_is_10_mm_too_long_is_geometry() {
    let wrong = session("dh-row");
    is_noise_but_for(&wrong, None);
    let answer = identified(&wrong).identification;
    let lengths = answer
        .parameters
        .iter()
        .filter(|p| p.effect == "link-geometry" && p.joint == Some(3) && p.name.ends_with("_mm"));
    let length = lengths.map(|p| p.value.powi(2)).sum::<f64>().sqrt();
    assert!((length - 10.0).abs() < 1.5, "{length}");
}

#[test]
fn each_level_of_correction_leaves_less_on_unseen_places() {
    let levels = identified(&session("dh-row")).identification.levels;
    let what: Vec<&str> = levels.iter().map(|l| l.what.english()).collect();
    assert_eq!(
        what[1..],
        ["zero offsets", "with tool and frame", "with links"]
    );
    for pair in levels.windows(2) {
        let [before, after] = [&pair[0], &pair[1]].map(|l| l.cross_validated.unwrap());
        assert!(
            after.rms_mm < before.rms_mm && after.p95_mm < before.p95_mm,
            "{levels:?}"
        );
        assert!(pair[0].parameters < pair[1].parameters);
    }
    let last = levels.last().unwrap();
    let unseen = last.cross_validated.unwrap();
    // σ √3 and what 37 parameters from 180 coordinates add.
    assert!(
        last.rms_mm < unseen.rms_mm && unseen.rms_mm < 0.065,
        "{last:?}"
    );
    assert!(unseen.mean_mm < unseen.rms_mm && unseen.p95_mm <= unseen.max_mm);
}

#[test]
fn an_effect_is_named_with_its_joint_in_every_sentence() {
    let answer = diagnosed(&session("two-cycle"));
    assert_eq!(names(&answer), [("encoder-two-cycle", Some(3))]);
    assert_eq!(answer.verdict, Verdict::Explained);
    let amplitude = &answer.found[0].parameters[0];
    let [low, high] = amplitude.ci95.unwrap();
    assert!(low < 0.028_157 && 0.028_157 < high, "{amplitude:?}");
    let others = answer.equivalent.iter();
    let others = others.flat_map(|e| e.explanation.iter().chain(&e.instead));
    for name in others.chain(&answer.found[0].next) {
        let per_joint = truepose::effects::find(name.split(' ').next().unwrap())
            .unwrap()
            .about()
            .per_joint;
        assert_eq!(per_joint, name.contains(' '), "{name}");
    }
    let step = answer.history.last().unwrap();
    assert_eq!(step.what, "with encoder-two-cycle 3");
}

/// Axes of a six-joint arm: direction and a point on each; the target at home.
const AXES: [([f64; 3], [f64; 3]); 6] = [
    ([0.0, 0.0, 1.0], [0.0, 0.0, 0.0]),
    ([0.0, 1.0, 0.0], [0.0, 0.0, 330.0]),
    ([0.0, 1.0, 0.0], [0.0, 0.0, 640.0]),
    ([1.0, 0.0, 0.0], [0.0, 0.0, 710.0]),
    ([0.0, 1.0, 0.0], [340.0, 0.0, 710.0]),
    ([1.0, 0.0, 0.0], [340.0, 0.0, 710.0]),
];
const TARGET: [f64; 3] = [430.0, 45.0, 760.0];

/// Rodrigues' rotation of a point about an axis.
fn turned(p: [f64; 3], axis: [f64; 3], about: [f64; 3], angle: f64) -> [f64; 3] {
    let (s, c) = angle.sin_cos();
    let r: [f64; 3] = std::array::from_fn(|k| p[k] - about[k]);
    let along: f64 = (0..3).map(|k| axis[k] * r[k]).sum();
    let cross = |k: usize| {
        let (i, j) = ((k + 1) % 3, (k + 2) % 3);
        axis[i] * r[j] - axis[j] * r[i]
    };
    std::array::from_fn(|k| about[k] + c * r[k] + s * cross(k) + (1.0 - c) * along * axis[k])
}

#[test]
fn a_hundred_thousand_poses_are_searched_as_well() {
    const POSES: usize = 100_000;
    let mut random = Random(7);
    let offsets: [f64; 6] = std::array::from_fn(|_| 0.003 * random.normal());
    let mut columns = vec![String::new(); 9];
    for _ in 0..POSES {
        let q: [f64; 6] = std::array::from_fn(|_| random.between(-100.0, 100.0));
        let mut p = TARGET;
        for (joint, (axis, point)) in AXES.iter().enumerate().rev() {
            p = turned(p, *axis, *point, q[joint].to_radians() + offsets[joint]);
        }
        let p = p.map(|v| v + 0.03 * random.normal());
        for (column, value) in columns.iter_mut().zip(q.iter().chain(&p)) {
            write!(
                column,
                "{}{value:.6}",
                if column.is_empty() { "" } else { "," }
            )
            .unwrap();
        }
    }
    let joints = AXES.map(|(axis, point)| {
        format!(r#"{{"name": "j", "kind": "revolute", "axis": {axis:?}, "point_mm": {point:?}}}"#)
    });
    let heads = [
        "q1_deg", "q2_deg", "q3_deg", "q4_deg", "q5_deg", "q6_deg", "x_mm", "y_mm", "z_mm",
    ];
    let samples = heads.iter().zip(&columns);
    let samples: Vec<String> = samples.map(|(h, c)| format!(r#""{h}": [{c}]"#)).collect();
    let text = format!(
        r#"{{"format": "truepose-session/1", "name": "long", "robot": {{"name": "six", "joints": [{}],
            "tool": {{"position_mm": {TARGET:?}, "quaternion_wxyz": [1, 0, 0, 0]}}}},
            "instrument": {{"name": "tracker", "sigma_mm": 0.03}},
            "samples": {{"columns": {{{}}}}}}}"#,
        joints.join(", "),
        samples.join(", ")
    );
    let long = parse(text.as_bytes()).unwrap().session;
    assert_eq!(long.samples.len(), POSES);
    let answer = diagnosed(&long);
    assert_eq!(names(&answer), []);
    assert_eq!(answer.verdict, Verdict::Noise, "{:?}", answer.unexplained);
    for (joint, offset) in offsets.iter().enumerate().take(5).skip(1) {
        let own = answer
            .identified
            .iter()
            .find(|p| p.effect == "joint-zero-offset" && p.joint == Some(joint + 1));
        let error = own.unwrap().value - offset.to_degrees();
        assert!(error.abs() < 1e-3, "joint {}: {error}", joint + 1);
    }
}

/// Stars that a telescope points at, as points on a sphere on which 1″ is 1 mm: its tube bends by 40″ cos e, and
/// the air bends the light by −5″ cot e more than was allowed for, which no name of the catalogue is.
fn telescope(seed: u64) -> Session {
    const SPHERE_MM: f64 = 206_264.806;
    const STARS: usize = 80;
    let mut random = Random(seed);
    let mut rows = Vec::new();
    for _ in 0..STARS {
        let azimuth = random.between(-180.0, 180.0).to_radians();
        let elevation = random.between(0.3, 0.994).asin();
        let bent = elevation + (40.0 * elevation.cos() - 5.0 / elevation.tan()) / SPHERE_MM;
        let point = [
            bent.cos() * azimuth.cos(),
            bent.cos() * azimuth.sin(),
            bent.sin(),
        ]
        .map(|along| SPHERE_MM * along + 0.5 * random.normal());
        let [x, y, z] = point;
        rows.push([azimuth.to_degrees(), elevation.to_degrees(), x, y, z]);
    }
    let column = |k: usize| -> Vec<f64> { rows.iter().map(|row| row[k]).collect() };
    let held_out = |k: usize| if k % 10 < 3 { "held-out" } else { "fit" };
    let document = serde_json::json!({
        "format": "truepose-session/1", "name": "telescope",
        "robot": { "name": "telescope", "gravity_m_s2": [0, 0, -9.81],
            "tool": { "position_mm": [SPHERE_MM, 0, 0], "quaternion_wxyz": [1, 0, 0, 0] },
            "joints": [
                { "name": "azimuth", "kind": "revolute", "axis": [0, 0, 1], "point_mm": [0, 0, 0] },
                { "name": "elevation", "kind": "revolute", "axis": [0, -1, 0], "point_mm": [0, 0, 0] } ] },
        "instrument": { "name": "stars", "sigma_mm": 0.5 },
        "samples": { "columns": {
            "q1_deg": column(0), "q2_deg": column(1),
            "x_mm": column(2), "y_mm": column(3), "z_mm": column(4),
            "setup": vec!["sky"; STARS],
            "use": (0..STARS).map(held_out).collect::<Vec<_>>() } } });
    parse(document.to_string().as_bytes()).unwrap().session
}

#[test]
fn what_several_names_come_near_to_is_not_left_without_any() {
    for seed in [1, 15, 17] {
        let answer = diagnosed(&telescope(seed));
        let held_out = answer.held_out.gaps.as_ref().unwrap();
        let over_the_noise = held_out.end_mm / 0.866;
        let names = names(&answer);
        assert!(
            !names.is_empty() && over_the_noise < 1.5,
            "{seed}: {names:?} {over_the_noise}"
        );
    }
}
