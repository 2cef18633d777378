//! Robots with several joints: sessions that `tests/reference/arms.py` simulated with numpy, which
//! shares no code with the program, and how far from the truth its own least squares of everything
//! ends on poses that no fit has seen.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::path::PathBuf;

use truepose::effects::{Inputs, JointValues, MEASURING_FRAME, Survey, Term};
use truepose::fit::{DEFAULT_EFFECTS, Identification, identify_exact, identify_watched};
use truepose::model::Model;
use truepose::model::read_model;
use truepose::pipeline::hand_out;
use truepose::sessions::{Session, load};

const KINDS: [&str; 5] = ["six", "parallel", "seven", "scara", "positioner"];

fn folder() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/data/arms")
}

fn session(name: &str) -> Session {
    load(folder().join(format!("{name}.json"))).unwrap().session
}

fn effects() -> Vec<String> {
    DEFAULT_EFFECTS.map(str::to_owned).to_vec()
}

fn identified(session: &Session) -> Identification {
    identify_exact(session, &effects(), JointValues::Commanded).unwrap()
}

/// What numpy's least squares of everything leaves on unseen poses, and in the fit, mm.
fn expected(name: &str) -> [f64; 2] {
    let text = std::fs::read_to_string(folder().join("expected.json")).unwrap();
    let all: serde_json::Value = serde_json::from_str(&text).unwrap();
    ["from_truth_mm", "left_mm"].map(|key| all[name][key].as_f64().unwrap())
}

#[test]
fn geometry_alone_comes_as_near_to_the_truth_as_a_least_squares_of_everything() {
    for kind in KINDS {
        for poses in [60, 200] {
            let name = format!("{kind}-{poses}");
            let session = session(&name);
            let [from_truth_mm, left_mm] = expected(&name);
            let with = identified(&session);
            let without = identify_watched(
                &session,
                &effects(),
                &[],
                false,
                JointValues::Commanded,
                &|| true,
            )
            .unwrap();
            for answer in [&with, &without] {
                assert!(answer.quality.converged, "{name}: {:?}", answer.quality);
                assert_eq!(answer.notes, [], "{name}");
                let unseen = answer.held_out.unwrap().after.rms_mm;
                assert!(
                    unseen <= 1.05 * from_truth_mm,
                    "{name}: {unseen} {from_truth_mm}"
                );
                assert!(answer.gap.after.rms_mm < 1.03 * left_mm, "{name}");
            }
        }
    }
}

#[test]
fn what_is_shared_with_the_frame_belongs_to_the_frame_and_two_sessions_agree() {
    for kind in KINDS {
        let sessions = [
            session(&format!("{kind}-60")),
            session(&format!("{kind}-200")),
        ];
        let answers = sessions.each_ref().map(identified);
        let said = |a: &Identification| -> Vec<String> {
            let first = |n: &str| n.split(" with ").next().unwrap().to_owned();
            let all = a.not_identifiable.iter();
            all.map(|n| first(&n.combination.to_string())).collect()
        };
        // The arms are not the same, what cannot be told is.
        assert_eq!(said(&answers[0]), said(&answers[1]), "{kind}");
        let [answer, _] = &answers;
        assert!(said(answer).contains(&"joint-zero-offset of joint 1: offset_deg".to_owned()));
        for name in ["x_mm", "y_mm", "about_x_mrad", "about_y_mrad"] {
            let held = format!("link-geometry of joint 1: {name}");
            assert!(said(answer).contains(&held), "{kind}: {held}");
        }
        for parameter in &answer.parameters {
            if parameter.ci95.is_none() {
                assert_eq!(parameter.value, 0.0, "{kind}: {parameter:?}");
            }
            if parameter.effect == "link-geometry" {
                assert!(parameter.value.abs() < 6.0, "{kind}: {parameter:?}");
            }
        }
    }
}

#[test]
fn a_model_that_is_read_back_predicts_the_same_to_the_last_bit() {
    for kind in KINDS {
        let session = session(&format!("{kind}-60"));
        let inputs = Inputs::new(&session, JointValues::Commanded);
        let calibration = identified(&session).calibration(&session, &inputs);
        let read = read_model(&hand_out(&calibration, &session).unwrap().document()).unwrap();
        assert_eq!(
            read.model.predict(&inputs),
            calibration.model.predict(&inputs),
            "{kind}"
        );
        let labels = |model: &truepose::model::Model| -> Vec<Option<String>> {
            let all = model.terms().iter();
            all.map(|t| t.label.as_deref().map(str::to_owned)).collect()
        };
        assert_eq!(labels(&read.model), labels(&calibration.model), "{kind}");
        assert!(labels(&read.model).contains(&Some("station".to_owned())));
        assert!(labels(&read.model).contains(&Some("T2".to_owned())));
    }
}

#[test]
fn a_frame_that_nobody_aligned_is_noticed_without_a_setup_column() {
    for kind in KINDS {
        let mut without = session(&format!("{kind}-200"));
        without.samples.setups = None;
        let answer = identified(&without);
        assert!(answer.quality.converged, "{kind}: {:?}", answer.quality);
        assert!(
            answer.notes.iter().any(|n| n.contains("never aligned")),
            "{kind}"
        );
        let [from_truth_mm, _] = expected(&format!("{kind}-200"));
        let unseen = answer.held_out.unwrap().after.rms_mm;
        assert!(
            unseen <= 1.05 * from_truth_mm,
            "{kind}: {unseen} {from_truth_mm}"
        );
    }
}

#[test]
fn few_poses_do_not_explode() {
    for kind in KINDS {
        for poses in [1, 2, 5, 12, 20, 30] {
            let mut few = session(&format!("{kind}-200"));
            let held = few.samples.held_out.as_mut().unwrap();
            let keep = |i: usize| i < poses || i >= 200;
            for i in (0..held.len()).filter(|i| !keep(*i)) {
                // Unusable, neither fitted nor held out.
                few.samples.x_mm[i] = f64::NAN;
                few.samples.y_mm[i] = f64::NAN;
                few.samples.z_mm.as_mut().unwrap()[i] = f64::NAN;
            }
            let answer = identified(&few);
            let unseen = answer.held_out.unwrap();
            assert!(
                unseen.after.rms_mm <= unseen.before.rms_mm,
                "{kind}, {poses}: {unseen:?}"
            );
            if poses >= 30 {
                assert!(unseen.after.rms_mm < 0.25, "{kind}, {poses}: {unseen:?}");
            }
            for p in &answer.parameters {
                assert!(p.value.is_finite(), "{kind}, {poses}: {p:?}");
                if p.effect == "joint-zero-offset" {
                    assert!(p.value.abs() < 20.0, "{kind}, {poses}: {p:?}");
                }
            }
        }
    }
}

/// R reaches from the joint's axis to where the target is in the pose, not to where it is at home: an
/// upright arm has its tool on the first axis there.
#[test]
fn levers_are_those_of_the_measured_poses() {
    let session = session("seven-60");
    let robot = &session.robot;
    let home = robot.base_from_tool.translation.vector;
    let quarter = std::f64::consts::FRAC_PI_2;
    let mut q = vec![vec![0.0]; 7];
    q[1][0] = quarter;
    let mut inputs = Inputs::at_poses(q, vec![home.into()]);
    inputs.above_20_c = Some(vec![10.0]);
    let moved = |id: &str, joint: usize, values: &[(&str, f64)]| -> f64 {
        let term = Term::from_parameters(id, joint, values, 7).unwrap();
        let nominal = Model::nominal(robot.clone());
        let there = nominal.with_term(term).predict(&inputs).get(0);
        let from = nominal.predict(&inputs).get(0);
        (0..3)
            .map(|k| (there[k] - from[k]).powi(2))
            .sum::<f64>()
            .sqrt()
    };
    // The shoulder is 340 mm up and the tool 1270: the arm lies flat, 930 mm from axis 1.
    let reach_mm = 1270.0 - 340.0;
    let grown = moved("thermal-growth", 1, &[("ppm_per_degc", 20.0)]);
    assert!((grown - 20e-6 * 10.0 * reach_mm).abs() < 1e-9, "{grown}");
    let wave = [("order", 2.0), ("amplitude_mrad", 0.1), ("phase_deg", 0.0)];
    let wobbled = moved("axis-wobble", 1, &wave);
    assert!((wobbled - 1e-4 * reach_mm).abs() < 1e-9, "{wobbled}");
    let runout = [("order", 2.0), ("amplitude_mm", 0.02), ("phase_deg", 0.0)];
    let ran_out = moved("bearing-runout", 1, &runout);
    assert!((ran_out - 0.02).abs() < 1e-12, "{ran_out}");
    // Gravity is along axis 3 at home and across it in most poses.
    let mut heavy = session.clone();
    heavy.robot.gravity_m_s2 = Some(nalgebra::Vector3::new(0.0, 0.0, -9.81));
    let inputs = Inputs::new(&heavy, JointValues::Commanded);
    let levers = Survey::new(&heavy, &inputs).joints.into_iter();
    let levers: Vec<bool> = levers.map(|joint| joint.gravity_lever).collect();
    assert_eq!(levers, [false, true, true, true, true, true, true]);
}

#[test]
fn a_frame_turned_by_any_angle_is_fitted_and_wound_back() {
    let frame = |degrees: f64| {
        let turn = f64::to_radians(degrees);
        [0.6 * turn, 0.0, -0.8 * turn, 120.0, -3000.0, 40.0]
    };
    let session = session("six-60");
    let inputs = Inputs::new(&session, JointValues::Commanded);
    for degrees in [0.0, 120.0, 179.9, 180.0, 215.0] {
        let mut term = Term::absent(&MEASURING_FRAME, 0, 0.0);
        term.coefficients = frame(degrees).to_vec();
        let model = Model::new(session.robot.clone(), vec![term]);
        let there = model.predict(&inputs);
        let mut turned = session.clone();
        turned.samples.x_mm.clone_from(&there.x_mm);
        turned.samples.y_mm.clone_from(&there.y_mm);
        turned.samples.z_mm = Some(there.z_mm.clone());
        let answer = identified(&turned);
        assert!(
            answer.gap.after.rms_mm < 1e-6,
            "{degrees}: {:?}",
            answer.gap
        );
        for p in &answer.parameters {
            if p.effect != "measuring-frame" {
                assert!(p.value.abs() < 1e-5, "{degrees}: {p:?}");
            }
        }
    }
}
