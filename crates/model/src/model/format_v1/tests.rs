use nalgebra::{DMatrix, Point3, Unit, UnitQuaternion, Vector3};
use proptest::prelude::*;

use super::*;
use crate::effects::about::{Listed, Setting};
use crate::effects::{CATALOGUE, Inputs, Term};
use crate::kinematics::{Axis, Joint, JointKind, LinkMass, Pose, Range, Robot};
use crate::model::{Calibration, Model, RegionalCorrection, ResidualStep, SetUp};
use crate::sessions::{SessionCorrection, Target};
use crate::write_model;

fn vector(size: f64) -> impl Strategy<Value = Vector3<f64>> {
    prop::array::uniform3(-size..size).prop_map(Vector3::from)
}

fn any_robot() -> impl Strategy<Value = Robot> {
    let joint = (vector(1.0), vector(900.0), any::<bool>(), 0.1..3.0f64);
    let joints = prop::collection::vec(joint, 1..5);
    (joints, vector(500.0), vector(2.0)).prop_map(|(joints, at, turn)| Robot {
        name: "any".to_owned(),
        joints: joints
            .into_iter()
            .enumerate()
            .map(|(k, (direction, point, slides, reach))| Joint {
                name: format!("j{k}"),
                kind: if slides && k > 0 {
                    JointKind::Prismatic
                } else {
                    JointKind::Revolute
                },
                axis: Axis {
                    // Deliberately not the closest unit vector.
                    direction: Unit::new_unchecked(
                        (direction + Vector3::new(0.0, 0.0, 3.0)).normalize() * (1.0 + 3e-15),
                    ),
                    point_mm: Point3::from(point),
                },
                limits: (k != 1).then_some(Range {
                    from: -reach,
                    to: reach * 1.1,
                }),
                link: (k != 2).then_some(LinkMass {
                    mass_kg: reach,
                    centre_mm: Point3::from(point * 0.3),
                }),
                follows: None,
                gear_ratio: None,
            })
            .collect(),
        base_from_tool: Pose::from_parts(at.into(), UnitQuaternion::from_scaled_axis(turn)),
        gravity_m_s2: Some(Vector3::new(0.2, 0.0, -9.8)),
        source: crate::kinematics::RobotSource::Axes,
    })
}

fn any_terms(joints: usize) -> impl Strategy<Value = Vec<Term>> {
    let one = (
        0..CATALOGUE.len(),
        0..joints,
        0.0..1.0f64,
        prop::array::uniform6(-1.0..1.0f64),
    );
    let term = one.prop_map(move |(k, joint, setting, values)| {
        let mut effect = CATALOGUE[k];
        let listed = |listed: &Listed| {
            let mut whole = (1..100).map(f64::from);
            whole.find(|v| (listed.takes)(*v, joint, joints))
        };
        if matches!(effect.about().setting, Setting::Listed(l) if listed(l).is_none()) {
            effect = CATALOGUE[0];
        }
        let about = effect.about();
        let setting = match about.setting {
            Setting::Order { from, to } => {
                f64::from(from) + (setting * f64::from(to - from)).floor()
            }
            Setting::None => 0.0,
            Setting::Listed(l) => listed(l).unwrap_or_default(),
            _ => setting,
        };
        let mut term = Term::absent(effect, if about.per_joint { joint } else { 0 }, setting);
        for (coefficient, value) in term.coefficients.iter_mut().zip(values) {
            *coefficient = value * 1e-2;
        }
        term
    });
    prop::collection::vec(term, 0..6)
}

fn any_calibration() -> impl Strategy<Value = Calibration> {
    let with_terms = any_robot().prop_flat_map(|robot| {
        let terms = any_terms(robot.joints.len());
        (Just(robot), terms)
    });
    (with_terms, vector(100.0), 0.0..1.0f64).prop_map(|((robot, terms), target, number)| {
        let joints = robot.joints.len();
        let model = Model::new(robot, terms).settled();
        let n = model.coefficient_count();
        Calibration {
            session: "a \"session\"\n".to_owned(),
            covariance: (number > 0.3)
                .then(|| DMatrix::from_fn(n, n, |i, j| number / (i + j + 1) as f64)),
            regions: (joints == 1)
                .then(|| RegionalCorrection {
                    name: "1".to_owned(),
                    from_rad: number,
                    to_rad: number * 2.0 + 0.1,
                    samples: 5,
                    theta_rad: 0.1 * number,
                    l1_mm: -number,
                })
                .into_iter()
                .collect(),
            targets: vec![Target {
                name: "T1".to_owned(),
                position_mm: Point3::from(target),
            }],
            measured_targets: (number > 0.6).then(|| vec![0]),
            measured: vec![
                Range {
                    from: -number,
                    to: number
                };
                joints
            ],
            measured_steps: (number > 0.4).then(|| vec![number; joints]),
            tolerance_mm: (number > 0.5).then_some(number),
            compensated_by: (number > 0.2).then(|| "0123".to_owned()),
            set_up: if number > 0.3 {
                SetUp::new([
                    SessionCorrection::PairRows(vec![(3, 1), (9, -2)]),
                    SessionCorrection::Remove(vec![4]),
                    SessionCorrection::WidenNoise([0.1 * number, 0.0, 0.02]),
                    SessionCorrection::FreeTargets,
                    SessionCorrection::TurnHome {
                        joint: 0,
                        by_rad: number,
                    },
                    SessionCorrection::Reorder([1, 0, 2]),
                    SessionCorrection::ScaleCoordinate {
                        axis: 2,
                        factor: 1000.0,
                    },
                ])
            } else {
                SetUp::default()
            },
            conditions: crate::model::Conditions::default(),
            set_aside: None,
            history: vec![ResidualStep {
                what: "nominal robot".to_owned(),
                gap_mm: number * 3.0,
                held_out_mm: None,
                runs_held_out_mm: None,
                values_held_out_mm: None,
            }],
            load_kg: Some([0.0, 2.5]),
            samples_hash: "00ff".to_owned(),
            program_version: "0.1.0".to_owned(),
            model,
        }
    })
}

/// Positions of some poses with every condition, as bits.
fn predictions(calibration: &Calibration) -> Vec<[u64; 3]> {
    let joints = calibration.model.robot.joints.len();
    let wave = |scale: f64| -> Vec<f64> { (0..40).map(|i| (f64::from(i) * scale).sin()).collect() };
    let columns = (0..joints).map(|j| wave(0.7 + j as f64));
    let mut inputs = Inputs::at_poses(columns.collect(), vec![[300.0, 20.0, 10.0]]);
    inputs
        .dir
        .fill(Some(wave(3.0).iter().map(|v| v.signum()).collect()));
    inputs.speed.fill(Some(wave(2.0).into()));
    inputs
        .travel
        .fill(Some(wave(1.3).iter().map(|v| v.abs()).collect()));
    inputs.load_kg = Some(wave(0.9).into());
    inputs.above_20_c = Some(wave(0.4));
    inputs.time_s = Some((0..40).map(f64::from).collect());
    let positions = calibration.model.predict(&inputs);
    (0..40)
        .map(|i| positions.get(i).map(f64::to_bits))
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(128))]

    #[test]
    fn a_model_that_is_read_back_predicts_the_same_to_the_last_bit(calibration in any_calibration()) {
        let text = write_model(&calibration);
        let read = read_model(&text).map_err(|e| TestCaseError::fail(e.to_string()))?;
        prop_assert_eq!(predictions(&read), predictions(&calibration));
        prop_assert_eq!(&read, &calibration);
        prop_assert_eq!(write_model(&read), text);
        prop_assert_eq!(model_hash(&read), model_hash(&calibration));
    }

    #[test]
    fn a_damaged_model_is_refused_or_read_but_never_a_panic(
        calibration in any_calibration(),
        at in any::<prop::sample::Index>(),
        junk in "[\\[\\]{}0-9eE.,:\"a-z-]{0,4}",
    ) {
        let mut text = write_model(&calibration);
        let cut = at.index(text.len());
        text.replace_range(cut..(cut + 3).min(text.len()), &junk);
        let _ = read_model(&text);
    }
}

fn small() -> String {
    r#"{
  "format": "truepose-model/1",
  "program_version": "by hand",
  "session": "s",
  "samples_hash": "",
  "robot": {
    "name": "column",
    "joints": [{ "name": "pan", "kind": "revolute", "axis": [0, 0, 2], "point_mm": [0, 0, 0] }],
    "tool": { "position_mm": [250, 0, 300], "quaternion_wxyz": [1, 0, 0, 0] }
  },
  "effects": [
    { "effect": "joint-zero-offset", "joint": 1, "parameters": { "offset_deg": -3 } }
  ],
  "covariance": null,
  "regions": [],
  "measured": [{ "from_inner": -1, "to_inner": 1 }],
  "history": []
}
"#
    .to_owned()
}

#[test]
fn a_model_that_was_written_by_hand_needs_no_exact_numbers() {
    let calibration = read_model(&small()).unwrap();
    let [term] = calibration.model.terms() else {
        panic!("one effect");
    };
    assert_eq!(term.coefficients, [(-3.0_f64).to_radians()]);
    assert_eq!(calibration.model.robot.joints[0].axis.direction.z, 1.0);
}

#[test]
fn a_readable_value_that_was_edited_alone_is_noticed() {
    let written = write_model(&read_model(&small()).unwrap());
    let edited = written.replace("\"offset_deg\": -3", "\"offset_deg\": -4");
    assert_ne!(edited, written);
    let refused = read_model(&edited).unwrap_err().to_string();
    assert!(
        refused.contains("effects[0].exact.coefficients"),
        "{refused}"
    );
    assert!(refused.contains("edit both"), "{refused}");
}

/// Found by the fuzzer: it was accepted, and what was written of it was not.
#[test]
fn a_parameter_beyond_all_sizes_is_refused() {
    let large = small().replace("\"offset_deg\": -3", "\"offset_deg\": -3e61");
    let refused = read_model(&large).unwrap_err().to_string();
    assert!(refused.contains("offset_deg"), "{refused}");
}

#[test]
fn each_kind_of_wrong_model_is_refused_with_its_place() {
    let cases = [
        (
            "\"truepose-model/1\"",
            "\"truepose-model/9\"",
            "line 2, column 13, format",
        ),
        (
            "-3 }",
            "\"x\" }",
            "line 12, column 80, effects[0].parameters.offset_deg",
        ),
        ("offset_deg", "width_deg", "no parameter 'width_deg'"),
        ("\"parameters\"", "\"parameturs\"", "no key 'parameters'"),
        (
            "joint-zero-offset",
            "gremlins",
            "no effect is called 'gremlins'",
        ),
        ("\"joint\": 1,", "\"joint\": 7,", "joint 7: the robot has 1"),
        ("[0, 0, 2]", "[0, 0, 0]", "zero length"),
        ("\"to_inner\": 1 ", "\"to_inner\": -2 ", "line 16"),
        ("null", "[[1, 2]]", "1 arrays of 1 numbers"),
        ("\"session\": \"s\",", "", "no key 'session'"),
        ("{\n", "[\n", ""),
    ];
    for (from, to, says) in cases {
        let text = small().replacen(from, to, 1);
        assert_ne!(text, small(), "{from}");
        let refused = read_model(&text).unwrap_err().to_string();
        assert!(refused.contains(says), "{from} → {to}: {refused}");
    }
}

#[test]
fn a_file_is_a_model_by_its_key_wherever_that_stands() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("file.json");
    for (text, expected) in [
        (r#"{"format":"truepose-model/2","name":1}"#, true),
        (
            r#"{"a":[1,{"format":"x"}],"format":"truepose-model/1"}"#,
            true,
        ),
        (
            r#"{"format":"truepose-session/1","of":"truepose-model/1"}"#,
            false,
        ),
        (r#"{"a":{"format":"truepose-model/1"},"format":"b"}"#, false),
        // A broken file, or one without such a key, is searched for its format.
        (r#"{"a":1,,"format":"truepose-model/1""#, true),
        (r#"{"format":3,"of":"truepose-model/1"}"#, true),
        ("[1, 2]", false),
        ("", false),
    ] {
        std::fs::write(&path, text).unwrap();
        assert_eq!(super::is_model(&path), expected, "{text}");
    }
    // A file that is none of the program's own is not read to its end, which may be far away.
    let far = format!("1,2,3\n{}truepose-model/1", "0\n".repeat(1 << 16));
    std::fs::write(&path, far).unwrap();
    assert!(!super::is_model(&path));
    assert!(!super::is_model(folder.path()));
    assert!(!super::is_model(&folder.path().join("none.json")));
}
