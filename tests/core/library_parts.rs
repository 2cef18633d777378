//! The parts of the library below whole sessions, given what no robot has: poses of another length, models without
//! their coefficients, scenarios of nothing, tables of no joint. See `library`.

#![allow(
    clippy::semicolon_if_nothing_returned,
    clippy::cloned_ref_to_slice_refs,
    clippy::default_trait_access,
    reason = "tables of what is broken, a line each"
)]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::ops::ControlFlow;

use nalgebra::{DMatrix, Point3, Vector3};
use truepose::compensation::{Compensation, Conditions, JointTable, Remainder, Side};
use truepose::design::plan_robot;
use truepose::diagnosis::NextPose;
use truepose::effects::{CATALOGUE, Curve, Inputs, JointFrame, Knots, Term};
use truepose::export::{EXPORTERS, Job, gap_to, gap_without};
use truepose::kinematics::{Follows, Goal, Inverse, Pose, Range, Robot};
use truepose::model::{Calibration, Model, model_hash};
use truepose::pipeline;
use truepose::programs::{Axes, LANGUAGES, Stop, Text, stops};
use truepose::programs::{measuring_list, measuring_program};
use truepose::sessions::Session;
use truepose::simulation::{Noise, NoiseKind, Poses, Scenario, Sweep, Temperature, simulate};
use truepose::standards::TestCube;

use crate::library_sessions::{COMMANDED, arm, calibrated, sound};

const BAD: [f64; 5] = [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, 1e300, -1e160];

type OfRobot = fn(&mut Robot);

/// No measurement is of these.
const ROBOTS: &[(&str, OfRobot)] = &[
    ("no joints", |r| r.joints.clear()),
    ("101 joints", |r| r.joints = vec![r.joints[0].clone(); 101]),
    ("a tool of NaN", |r| {
        r.base_from_tool.translation.vector.x = f64::NAN
    }),
    ("an axis far away", |r| r.joints[0].axis.point_mm.x = 1e160),
    ("limits of NaN", |r| {
        r.joints[0].limits = Some(Range {
            from: f64::NAN,
            to: f64::NAN,
        })
    }),
    ("endless limits", |r| {
        let (from, to) = (f64::NEG_INFINITY, f64::INFINITY);
        r.joints[0].limits = Some(Range { from, to });
    }),
    ("gravity of NaN", |r| {
        r.gravity_m_s2 = Some(Vector3::repeat(f64::NAN))
    }),
    ("joints that follow each other", |r| {
        for (joint, of) in [(0, 1), (1, 0)] {
            r.joints[joint].follows = Some(Follows {
                of,
                ratio: 1.0,
                offset: 0.0,
            });
        }
    }),
    ("a joint that follows none", |r| {
        r.joints[0].follows = Some(Follows {
            of: 99,
            ratio: f64::NAN,
            offset: 0.0,
        });
    }),
];

#[test]
fn a_pose_of_another_robot_is_nowhere() {
    let robot = arm(3);
    for q in [
        vec![],
        vec![0.1; 2],
        vec![f64::NAN; 3],
        vec![1e300; 3],
        vec![0.1; 7],
    ] {
        let at = robot.point_in_base(&q, &Point3::origin());
        let whole = q.len() >= 3 && q.iter().all(|q| q.is_finite());
        assert_eq!(at.x.is_finite(), whole, "{q:?}");
        let _ = (
            robot.base_from_tool(&q),
            robot.space_jacobian(&q),
            robot.rehomed(&q),
        );
        assert_eq!(robot.motions_from_home(&q).len(), 4);
        assert_eq!(robot.gravity_torque_nm(&q, 1.0, 99), None);
        for free in [vec![], vec![0, 1, 2], vec![0, 99]] {
            let inverse = Inverse::new(&robot, &free);
            let goal = Goal::pose(&Pose::translation(f64::NAN, 0.0, 0.0));
            assert_eq!(inverse.from_start(&goal, &q), None);
            assert_eq!(inverse.spread(&q, usize::MAX).len(), 3);
            let _ = (inverse.distance(&q, &[]), inverse.is_reached(&goal, &q));
        }
        let stop = Stop {
            from: Some(q.clone()),
            q: q.clone(),
            comment: "a\n\u{0}".into(),
        };
        let pose = NextPose {
            q: q.clone(),
            dir: vec![],
            target: None,
            target_mm: Some([f64::NAN; 3]),
            speed: Some(vec![]),
            load_kg: Some(f64::NAN),
            temperature_c: None,
            why: truepose::text::Text::verbatim("a,b\n"),
        };
        let _ = measuring_list(&[pose.clone()], &robot);
        for language in LANGUAGES {
            assert!(
                stops(language.id, &robot, "", &[stop.clone()]).is_err(),
                "{q:?}"
            );
            assert!(
                measuring_program(&[pose.clone()], &robot, language.id).is_err(),
                "{q:?}"
            );
        }
    }
    let axes = Axes::new(&robot);
    let _ = (
        axes.kind(99),
        axes.slot(99),
        robot.leading(&[0, 99]),
        JointFrame::new(&robot, 99),
    );
}

#[test]
fn a_robot_that_cannot_be_is_neither_planned_for_nor_simulated() {
    for (name, change) in ROBOTS {
        let mut robot = arm(2);
        change(&mut robot);
        let errors = robot.problems(&truepose::diagnostic::Place::default());
        assert!(!errors.is_empty(), "{name}");
        assert!(plan_robot(&robot, &Default::default()).is_err(), "{name}");
        let q = vec![vec![0.1; robot.joints.len()]; 5];
        assert!(
            Session::new(robot.clone(), &q, &[Point3::origin(); 5]).is_err(),
            "{name}"
        );
        let scenario = Scenario::new("s", robot.clone(), Poses::Random(12));
        assert!(
            simulate(&scenario, 1, |_| ControlFlow::Continue(())).is_err(),
            "{name}"
        );
        let _ = (
            TestCube::of(&robot),
            robot.mobility(),
            robot.reach_mm(),
            robot.link_frames(),
        );
        let _ = (Axes::new(&robot).free(), truepose::export::usual(&robot).id);
        let good = calibrated(&sound(2));
        let _ = gap_to(&good, &sound(2), &robot);
        let terms = CATALOGUE.iter().map(|effect| Term::absent(effect, 0, 1.0));
        let model = Model::new(robot, terms.collect());
        let _ = model.predict(&Inputs::at_poses(vec![vec![0.1; 3]; 2], vec![]));
    }
}

type OfScenario = fn(&mut Scenario);

const SCENARIOS: &[(&str, OfScenario)] = &[
    ("no pose", |s| s.poses = Poses::Random(0)),
    ("endless poses", |s| s.poses = Poses::Random(usize::MAX)),
    ("an empty list", |s| s.poses = Poses::List(vec![])),
    ("a sweep of no joint", |s| {
        s.poses = sweep(usize::MAX, 0.1, 1)
    }),
    ("a sweep without a step", |s| s.poses = sweep(0, 0.0, 1)),
    ("a tiny step", |s| s.poses = sweep(0, 1e-320, 1)),
    ("endless repeats", |s| s.poses = sweep(0, 0.1, usize::MAX)),
    ("no targets", |s| s.targets.clear()),
    ("no measure", |s| s.measure.clear()),
    ("a target of NaN", |s| s.targets[0].position_mm.x = f64::NAN),
    ("noise of NaN", |s| {
        s.noise = Some(Noise {
            sigma_mm: f64::NAN,
            kind: NoiseKind::T4,
        });
    }),
    ("an infinite load", |s| {
        s.circumstances.loads_kg = vec![f64::INFINITY]
    }),
    ("a temperature of NaN", |s| {
        s.circumstances.temperature = Some(Temperature::Values(vec![f64::NAN]));
    }),
    ("no tolerance", |s| s.tolerance_mm = Some(0.0)),
    ("an effect of no joint", |s| {
        s.effects = vec![Term::absent(CATALOGUE[0], 99, 1.0)]
    }),
    ("an effect of NaN", |s| {
        let mut term = Term::absent(CATALOGUE[0], 0, 1.0);
        term.coefficients.fill(f64::NAN);
        s.effects = vec![term];
    }),
];

fn sweep(joint: usize, step: f64, repeats: usize) -> Poses {
    Poses::Sweep(Sweep {
        joint,
        from: -1.0,
        to: 1.0,
        step,
        both_ways: true,
        repeats,
        order: Default::default(),
    })
}

#[test]
fn a_scenario_of_nothing_is_refused() {
    for (name, change) in SCENARIOS {
        let mut scenario = Scenario::new("s", arm(2), Poses::Random(12));
        change(&mut scenario);
        let simulated = simulate(&scenario, 1, |_| ControlFlow::Continue(()));
        assert!(simulated.is_err(), "{name}");
    }
    for effect in CATALOGUE {
        let mut scenario = Scenario::new("s", arm(2), Poses::Random(12));
        let coefficients = Vec::new();
        scenario.effects = vec![Term {
            coefficients,
            ..Term::absent(effect, 0, 1.0)
        }];
        let _ = simulate(&scenario, 1, |_| ControlFlow::Continue(()));
    }
}

type OfCalibration = fn(&mut Calibration);

/// None of these is handed out.
const CALIBRATIONS: &[(&str, OfCalibration)] = &[
    ("no joints", |c| c.model.robot.joints.clear()),
    ("a term of no joint", |c| {
        c.model = c.model.with_term(Term::absent(CATALOGUE[0], 99, 0.0));
    }),
    ("a term without coefficients", |c| {
        let coefficients = Vec::new();
        c.model = c.model.with_term(Term {
            coefficients,
            ..Term::absent(CATALOGUE[0], 0, 0.0)
        });
    }),
    ("coefficients of NaN", |c| {
        let none = vec![f64::NAN; c.model.coefficient_count()];
        c.model = c.model.with_coefficients(&none);
    }),
    ("a small covariance", |c| {
        c.covariance = Some(DMatrix::zeros(1, 1))
    }),
    ("a covariance that is not square", |c| {
        c.covariance = Some(DMatrix::zeros(3, 7))
    }),
    ("a range too many", |c| {
        c.measured.push(Range { from: 0.0, to: 1.0 })
    }),
    ("a range of NaN", |c| c.measured[0].from = f64::NAN),
    ("a target of NaN", |c| c.targets[0].position_mm.x = f64::NAN),
    ("an endless load", |c| {
        c.load_kg = Some([f64::NEG_INFINITY, f64::INFINITY])
    }),
];

#[test]
fn a_calibration_that_cannot_be_is_not_handed_out() {
    let session = sound(1);
    let inputs = Inputs::new(&session, COMMANDED);
    for (name, change) in CALIBRATIONS {
        let mut c = calibrated(&session);
        change(&mut c);
        assert!(pipeline::hand_out(&c, &session).is_err(), "{name}");
        let _ = (
            pipeline::verify(&c, &session),
            pipeline::standards(&session, Some(&c)),
        );
        let _ = (
            gap_without(&c, &session),
            gap_to(&c, &session, &session.robot),
            model_hash(&c),
        );
        let _ = (
            c.model.predict(&inputs),
            Remainder::new(&c, &inputs).describe(),
        );
        let compensation = Compensation::new(&c);
        let corrections = compensation.joint_corrections(&inputs);
        let _ = compensation.reached(&inputs, &corrections);
        let _ = compensation.reached(&inputs, &[]);
        for term in c.model.terms() {
            let _ = (
                c.model.figures_of(term, &inputs),
                term.parameters(),
                term.settled(),
            );
        }
    }
}

#[test]
fn inputs_and_models_of_different_robots_do_not_meet() {
    let c = calibrated(&sound(1));
    for inputs in [
        Inputs::at_poses(vec![], vec![]),
        Inputs::at_poses(vec![vec![0.1; 5]; 3], vec![[0.0; 3]]),
        Inputs::at_poses(vec![vec![0.1; 5], vec![]], vec![]),
        Conditions::default().inputs(vec![vec![], vec![1.0]], Side::Unknown, vec![]),
    ] {
        let _ = (
            c.model.predict(&inputs),
            Compensation::new(&c).joint_corrections(&inputs),
        );
        assert!(inputs.select(&[999]).is_empty());
    }
    assert_eq!(c.model.with_coefficients(&[]), c.model);
    for effect in CATALOGUE {
        for joint in [0, 99, usize::MAX] {
            let mut term = Term::absent(effect, joint, f64::NAN);
            let _ = term.parameters();
            term.coefficients.clear();
            let _ = (
                term.parameters(),
                term.settled(),
                term.name_on(&c.model.robot),
            );
            let _ = Term::from_parameters(effect.about().id, joint, &[("x", f64::NAN)], 6);
        }
    }
    for from in BAD {
        for count in [0, 1, 2] {
            let knots = Knots {
                from,
                to: 1.0,
                period: None,
                count,
            };
            let _ = (
                knots.check(),
                knots.weights(0.5),
                knots.slopes(f64::NAN),
                knots.places(),
            );
            let mut ends = <[Vec<f64>; 6]>::default();
            ends[0] = vec![0.0; count];
            if let Ok(curve) = Curve::new(knots, ends.clone(), ends) {
                let _ = (
                    curve.at(f64::NAN, 1.0),
                    curve.sigma_at(0.5, 0.0),
                    curve.values(9),
                    curve.sigma(9),
                );
            }
        }
    }
}

#[test]
fn a_table_of_no_joint_or_no_step_is_refused() {
    let session = sound(1);
    let verified = pipeline::hand_out(&calibrated(&session), &session).unwrap();
    let conditions = Conditions::default();
    for joint in [1, usize::MAX] {
        assert!(JointTable::new(&verified, joint, 1.0, conditions).is_err());
    }
    for wrong in [f64::NAN, f64::INFINITY, -1e160, 0.0, -1.0, 1e-320] {
        assert!(
            JointTable::new(&verified, 0, wrong, conditions).is_err(),
            "{wrong}"
        );
        for format in EXPORTERS {
            for job in [
                Job {
                    step: Some(wrong),
                    ..Job::new(&verified, "t")
                },
                Job {
                    joint: usize::MAX,
                    ..Job::new(&verified, "../\u{0}")
                },
                Job {
                    conditions: Conditions {
                        speed: wrong,
                        load_kg: wrong,
                        temperature_c: wrong,
                    },
                    ..Job::new(&verified, "")
                },
            ] {
                let _ = pipeline::export(format.id, &job);
            }
        }
    }
    let text = Text::new(b"1\n2");
    assert_eq!(text.shown(2..usize::MAX), "2");
    assert_eq!(text.shown(9..12), "");
    let _ = text.place(usize::MAX);
}
