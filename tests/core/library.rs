//! What a caller of the library passes, broken in the ways that public fields allow: what can refuse does, in words,
//! what cannot answers with nothing, nothing panics, and everything ends.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::time::Instant;

use nalgebra::{Point3, Unit, Vector3};
use truepose::compensation::{Compensation, Remainder};
use truepose::design::PlanOptions;
use truepose::diagnosis::Options;
use truepose::effects::{CATALOGUE, Inputs, JointValues, Survey};
use truepose::export::{ReadBack, gap_left, gap_to, gap_without};
use truepose::kinematics::{
    Axis, Follows, Joint, JointKind, LinkMass, Pose, Range, Robot, RobotSource,
};
use truepose::model::Calibration;
use truepose::observations::Layer;
use truepose::pipeline::{self, Method};
use truepose::report::as_measured;
use truepose::sessions::{
    Pointing, Region, RegionChoice, Samples, Session, Setups, Sigma, SocketDistance, Tracker,
    UnknownColumn, write_csv, write_inline,
};

pub(crate) const COMMANDED: JointValues = JointValues::Commanded;

pub(crate) fn arm(joints: usize) -> Robot {
    let joint = |k: usize| {
        let along = [Vector3::z(), Vector3::y()][k % 2];
        let axis = Axis::through(along, Point3::new(60.0 * k as f64, 0.0, 100.0 * k as f64));
        let mut joint = Joint::new(format!("j{k}"), JointKind::Revolute, axis.unwrap());
        joint.limits = Some(Range {
            from: -2.0,
            to: 2.0,
        });
        joint
    };
    Robot {
        name: "arm".to_owned(),
        joints: (0..joints).map(joint).collect(),
        base_from_tool: Pose::translation(250.0 + 60.0 * joints as f64, 0.0, 300.0),
        gravity_m_s2: Some(Vector3::new(0.0, 0.0, -9.81)),
        source: RobotSource::Axes,
    }
}

/// Measured with every column that a session may have.
pub(crate) fn sound(joints: usize) -> Session {
    let (robot, rows) = (arm(joints), 24);
    let value =
        |row: usize, joint: usize| 2.0 * ((row as f64 * (2.0 + joint as f64).sqrt()).fract() - 0.5);
    let q: Vec<Vec<f64>> = (0..rows)
        .map(|row| (0..joints).map(|joint| value(row, joint)).collect())
        .collect();
    let seen = |(row, q): (usize, &Vec<f64>)| {
        let off: Vec<f64> = q.iter().map(|q| q + 0.002).collect();
        let at = robot.point_in_base(&off, &Point3::origin());
        let scatter = |of: f64| 0.02 * (row as f64 * of).sin();
        at + Vector3::new(scatter(12.9), scatter(7.7), scatter(5.1))
    };
    let points: Vec<Point3<f64>> = q.iter().enumerate().map(seen).collect();
    let side = |row: usize| vec![if row % 2 == 0 { 1.0 } else { -1.0 }; joints];
    let times: Vec<f64> = (0..rows).map(|row| 5.0 * row as f64).collect();
    Session::builder(robot.clone(), &q)
        .points_mm(&points)
        .directions(&(0..rows).map(side).collect::<Vec<_>>())
        .time_s(&times)
        .sigma_mm(0.02)
        .target("T1", Point3::origin())
        .load_kg(&vec![0.0; rows])
        .temperature_c(&vec![21.0; rows])
        .build()
        .unwrap()
}

pub(crate) fn calibrated(session: &Session) -> Calibration {
    pipeline::identify(session, &Method::default(), COMMANDED)
        .unwrap()
        .1
}

type Change = (&'static str, fn(&mut Session));

/// None of these can be computed with.
const BROKEN: &[Change] = &[
    ("no joints", |s| s.robot.joints.clear()),
    ("more joints than columns", |s| {
        s.robot.joints.push(s.robot.joints[0].clone());
    }),
    ("more joints than a robot has", |s| {
        s.robot.joints = vec![s.robot.joints[0].clone(); 101];
    }),
    ("no samples of a joint", |s| {
        s.samples = Samples {
            x_mm: vec![0.0],
            y_mm: vec![0.0],
            ..Samples::default()
        }
    }),
    ("no q", |s| s.samples.q.clear()),
    ("short q", |s| s.samples.q[0].truncate(3)),
    ("long q", |s| s.samples.q[0].push(1.0)),
    ("more q", |s| s.samples.q.push(s.samples.q[0].clone())),
    ("short x", |s| s.samples.x_mm.truncate(2)),
    ("no x", |s| s.samples.x_mm.clear()),
    ("short y", |s| s.samples.y_mm.truncate(2)),
    ("short z", |s| s.samples.z_mm = Some(vec![1.0])),
    ("short dir", |s| s.samples.dir[0] = Some(vec![1.0])),
    ("more dir", |s| s.samples.dir.push(None)),
    ("a direction of 7", |s| {
        s.samples.dir[0] = Some(vec![7.0; s.samples.len()])
    }),
    ("short speed", |s| s.samples.speed[0] = Some(vec![1.0])),
    ("short q_read", |s| s.samples.q_read[0] = Some(vec![1.0])),
    ("more torque", |s| s.samples.torque_nm = vec![None; 40]),
    ("short torque", |s| {
        s.samples.torque_nm = vec![Some(vec![1.0])]
    }),
    ("short warmth", |s| {
        s.samples.joint_temperature_c = vec![Some(vec![1.0])]
    }),
    ("short load", |s| s.samples.load_kg = Some(vec![1.0])),
    ("short temperature", |s| {
        s.samples.temperature_c = Some(vec![])
    }),
    ("short time", |s| s.samples.time_s = Some(vec![0.0])),
    ("short held out", |s| s.samples.held_out = Some(vec![true])),
    ("short excluded", |s| s.samples.excluded = Some(vec![false])),
    ("short target", |s| s.samples.target = Some(vec![0])),
    ("a target that is none", |s| {
        s.samples.target = Some(vec![7; s.samples.len()])
    }),
    ("short orientation", |s| {
        s.samples.orientation_wxyz = Some([vec![1.0], vec![], vec![], vec![]]);
    }),
    ("no orientation", |s| {
        let none = vec![0.0; s.samples.len()];
        s.samples.orientation_wxyz = Some([none.clone(), none.clone(), none.clone(), none]);
    }),
    ("setups without names", |s| {
        s.samples.setups = Some(Setups {
            names: vec![],
            index: vec![0; s.samples.len()],
        });
    }),
    ("short setups", |s| {
        s.samples.setups = Some(Setups {
            names: vec!["a".into()],
            index: vec![],
        });
    }),
    ("short distance", |s| {
        s.samples.observed.distance_mm = Some(vec![100.0])
    }),
    ("an anchor that is none", |s| {
        s.samples.observed.distance_mm = Some(vec![100.0; s.samples.len()]);
        s.samples.observed.anchor = Some(vec![Some(9); s.samples.len()]);
    }),
    ("a plane that is none", |s| {
        s.samples.observed.plane = Some(vec![Some(0); s.samples.len()])
    }),
    ("a station that is none", |s| {
        s.samples.observed.station = Some(vec![Some(0); s.samples.len()])
    }),
    ("a socket that is none", |s| {
        s.samples.observed.socket = Some(vec![Some(0); s.samples.len()])
    }),
    ("short unknown", |s| {
        s.samples.unknown = vec![UnknownColumn {
            name: "u".into(),
            cells: vec![],
        }];
    }),
    ("sockets that are none", |s| {
        s.instrument.references.socket_distances = vec![SocketDistance {
            between: [3, 4],
            distance_mm: 1.0,
        }];
    }),
    ("a pointing that points nowhere", |s| {
        let axis = Unit::new_unchecked(Vector3::zeros());
        s.instrument.references.pointing = Some(Pointing {
            axis,
            stations: Some(vec![9]),
        });
    }),
    ("a tolerance of NaN", |s| s.tolerance_mm = Some(f64::NAN)),
    ("a negative tolerance", |s| s.tolerance_mm = Some(-1.0)),
    ("a noise of NaN", |s| {
        s.instrument.sigma_mm = Some(Sigma::Overall(f64::NAN))
    }),
    ("no noise", |s| {
        s.instrument.sigma_mm = Some(Sigma::Overall(0.0))
    }),
    ("a negative noise", |s| {
        s.instrument.sigma_mm = Some(Sigma::PerAxis([0.0, 1.0, -1.0]))
    }),
    ("no noise of targets", |s| {
        s.instrument.targets_sigma_mm = Some(0.0)
    }),
    ("no noise of orientations", |s| {
        s.instrument.sigma_orientation = Some(0.0)
    }),
    ("a tracker of NaN", |s| {
        let position_mm = Point3::new(f64::NAN, 0.0, 0.0);
        s.instrument.tracker = Some(Tracker {
            sigma_range_mm: 0.0,
            sigma_angle: f64::NAN,
            position_mm,
        });
    }),
    ("a target of NaN", |s| s.targets[0].position_mm.x = f64::NAN),
    ("a target far away", |s| s.targets[0].position_mm.x = 1e300),
    ("gravity of NaN", |s| {
        s.robot.gravity_m_s2 = Some(Vector3::repeat(f64::NAN))
    }),
    ("an axis of NaN", |s| {
        s.robot.joints[0].axis.point_mm.x = f64::NAN
    }),
    ("an axis far away", |s| {
        s.robot.joints[0].axis.point_mm.x = 1e160
    }),
    ("an axis without a direction", |s| {
        s.robot.joints[0].axis.direction = Unit::new_unchecked(Vector3::zeros());
    }),
    ("a tool of NaN", |s| {
        s.robot.base_from_tool = Pose::translation(f64::NAN, 0.0, 0.0)
    }),
    ("limits of NaN", |s| {
        s.robot.joints[0].limits = Some(Range {
            from: f64::NAN,
            to: 1.0,
        })
    }),
    ("limits the wrong way round", |s| {
        s.robot.joints[0].limits = Some(Range {
            from: 1.0,
            to: -1.0,
        })
    }),
    ("a link of NaN", |s| {
        s.robot.joints[0].link = Some(LinkMass {
            mass_kg: f64::NAN,
            centre_mm: Point3::origin(),
        });
    }),
    ("a joint that follows itself", |s| {
        s.robot.joints[0].follows = Some(Follows {
            of: 0,
            ratio: 1.0,
            offset: 0.0,
        });
    }),
    ("a joint that follows none", |s| {
        s.robot.joints[0].follows = Some(Follows {
            of: 33,
            ratio: 1.0,
            offset: 0.0,
        });
    }),
    ("a region of NaN", |s| {
        s.regions = vec![Region {
            name: "a".into(),
            from_rad: f64::NAN,
            to_rad: 1.0,
        }];
    }),
    ("an infinite q", |s| s.samples.q[0][1] = f64::INFINITY),
    ("an infinite x", |s| s.samples.x_mm[1] = f64::NEG_INFINITY),
    ("a z far away", |s| {
        s.samples.z_mm.as_mut().unwrap()[1] = 1e300
    }),
    ("an infinite time", |s| {
        s.samples.time_s.as_mut().unwrap()[1] = f64::INFINITY
    }),
    ("an infinite load", |s| {
        s.samples.load_kg.as_mut().unwrap()[1] = f64::INFINITY
    }),
    ("an infinite temperature", |s| {
        s.samples.temperature_c.as_mut().unwrap()[1] = f64::INFINITY
    }),
    ("an infinite speed", |s| {
        s.samples.speed[0] = Some(vec![f64::INFINITY; s.samples.len()])
    }),
];

/// These can be: what is missing is missing.
const STRANGE: &[Change] = &[
    ("nothing", |_| ()),
    ("no samples", |s| {
        s.samples.remove(&(0..s.samples.len()).collect::<Vec<_>>())
    }),
    ("no targets", |s| s.targets.clear()),
    ("no dir", |s| s.samples.dir.clear()),
    ("no speed", |s| s.samples.speed.clear()),
    ("no q_read", |s| s.samples.q_read.clear()),
    ("no z", |s| s.samples.z_mm = None),
    ("no x that is known", |s| s.samples.x_mm.fill(f64::NAN)),
    ("no q that is known", |s| s.samples.q[0].fill(f64::NAN)),
    ("no time that is known", |s| {
        s.samples.time_s.as_mut().unwrap().fill(f64::NAN)
    }),
    ("one point", |s| s.samples.x_mm.fill(7.0)),
    ("all held out", |s| {
        s.samples.held_out = Some(vec![true; s.samples.len()])
    }),
    ("all excluded", |s| {
        s.samples.excluded = Some(vec![true; s.samples.len()])
    }),
    ("a setup for each sample", |s| {
        let (names, index) = (0..s.samples.len() as u32)
            .map(|k| (k.to_string(), k))
            .unzip();
        s.samples.setups = Some(Setups { names, index });
    }),
    ("distances without an anchor", |s| {
        s.samples.observed.distance_mm = Some(vec![100.0; s.samples.len()]);
    }),
    ("names that are none", |s| {
        s.name = "\u{0}\u{7}".repeat(5000);
        s.robot.name = String::new();
        s.robot.joints[0].name = "<script>".to_owned();
    }),
];

/// What answers without being able to refuse.
fn answers(session: &Session, good: &Calibration) {
    for values in [COMMANDED, JointValues::Read] {
        let inputs = Inputs::new(session, values);
        let survey = Survey::new(session, &inputs);
        for effect in CATALOGUE {
            let _ = effect.obstacle(&survey, 9);
        }
        let _ = good.model.predict(&inputs);
        let _ = Compensation::new(good).joint_corrections(&inputs);
        let _ = Remainder::new(good, &inputs).says();
        let _ = truepose::row_checks::check(session, values);
        let _ = truepose::set_up_errors::mend(session, values);
        let _ = Layer::new(session, values).is_empty();
    }
    let _ = as_measured(session, Some(0.1));
    let _ = (
        gap_without(good, session),
        gap_to(good, session, &session.robot),
    );
    let table = ReadBack::new(
        9,
        JointKind::Revolute,
        &[0.0, 1.0],
        vec![0.0; 2],
        vec![0.0; 2],
    );
    let _ = gap_left(good, session, &table.unwrap());
    let _ = truepose::sessions::hash_of_samples(session);
    let _ = (
        write_csv(session, &mut Vec::new()),
        write_inline(session, Vec::new()),
    );
    let samples = &session.samples;
    let _ = (
        samples.lost_reflector(),
        samples.incomplete(),
        samples.partly_measured(),
    );
    let _ = (
        samples.is_excluded(99),
        session.kinds_in_words(),
        samples.axes(),
    );
    let mut twice = samples.clone();
    twice.append(samples.clone());
    twice.remove(&[0, 3, 9999]);
    let _ = good.set_up.applied(session, true);
    let _ = session
        .robot
        .problems(&truepose::diagnostic::Place::default());
}

#[test]
fn a_session_that_cannot_be_computed_with_is_refused_by_everything() {
    let go_on = |_| true;
    for joints in [1, 2] {
        let good = calibrated(&sound(joints));
        for (name, change) in BROKEN {
            let mut s = sound(joints);
            change(&mut s);
            answers(&s, &good);
            let plan = PlanOptions::default();
            for (what, refused) in [
                (
                    "identify",
                    pipeline::identify(&s, &Method::default(), COMMANDED).is_err(),
                ),
                (
                    "identify_checked",
                    pipeline::identify_checked(&s, &Method::default(), COMMANDED).is_err(),
                ),
                (
                    "regional",
                    pipeline::identify(&s, &Method::Regional(RegionChoice::Adaptive), COMMANDED)
                        .is_err(),
                ),
                (
                    "fit",
                    truepose::fit::identify_exact(&s, &[], COMMANDED).is_err(),
                ),
                (
                    "diagnose",
                    pipeline::diagnose(&s, &Options::default(), &go_on).is_err(),
                ),
                ("verify", pipeline::verify(&good, &s).is_err()),
                ("hand_out", pipeline::hand_out(&good, &s).is_err()),
                ("standards", pipeline::standards(&s, None).is_err()),
                ("plan", pipeline::plan_session(&s, &plan, &go_on).is_err()),
                (
                    "report",
                    pipeline::report(&s, &Options::default(), &Default::default(), &go_on).is_err(),
                ),
                ("checked", s.clone().checked().is_err()),
            ] {
                assert!(refused, "{name}, {joints} joints: {what}");
            }
        }
    }
}

#[test]
fn a_session_in_which_nearly_everything_is_missing_ends() {
    let good = calibrated(&sound(1));
    let go_on = |_| true;
    for (name, change) in STRANGE {
        let start = Instant::now();
        let mut s = sound(1);
        change(&mut s);
        answers(&s, &good);
        for ids in [
            &["backlash", "thermal-growth"][..],
            &["no such effect"],
            &[],
        ] {
            let _ = pipeline::identify(&s, &Method::exact(ids), COMMANDED);
        }
        for choice in [
            RegionChoice::FromSession,
            RegionChoice::Uniform(0),
            RegionChoice::Uniform(usize::MAX),
            RegionChoice::Boundaries(vec![f64::NAN, 1.0]),
            RegionChoice::Given(Vec::new()),
            RegionChoice::Adaptive,
        ] {
            let _ = choice.resolve(&s);
            let _ = pipeline::identify(&s, &Method::Regional(choice), COMMANDED);
        }
        let _ = pipeline::standards(&s, Some(&good));
        let _ = pipeline::hand_out(&good, &s);
        if let Ok(found) = pipeline::diagnose(&s, &Options::default(), &go_on) {
            let calibration = found.calibration(&s);
            let _ = pipeline::hand_out(&calibration, &s);
            let _ = pipeline::regional_start(&s, &found, COMMANDED);
            let _ = pipeline::regional_start(&sound(2), &found, COMMANDED);
        }
        // On a busy machine; alone none takes a second.
        let seconds = start.elapsed().as_secs_f64();
        assert!(seconds < 60.0, "{name}: {seconds} s");
    }
}

#[test]
fn options_that_make_no_sense_are_refused_or_do_nothing() {
    let session = sound(1);
    for held_out in [f64::NAN, -3.0, 1e-300, 1.0] {
        let options = Options {
            held_out: Some(held_out),
            max_effects: Some(0),
            ..Options::default()
        };
        let _ = pipeline::diagnose(&session, &options, &|_| true);
    }
    for wrong in [f64::NAN, f64::INFINITY, 0.0, -1.0] {
        let base = PlanOptions::default();
        for options in [
            PlanOptions {
                sigma_mm: Some(wrong),
                ..base.clone()
            },
            PlanOptions {
                load_kg: Some(wrong),
                ..base.clone()
            },
            PlanOptions {
                cone_rad: Some(wrong),
                ..base.clone()
            },
            PlanOptions {
                accuracy_mm: Some(wrong),
                ..base.clone()
            },
            PlanOptions {
                poses: Some(usize::MAX),
                ..base.clone()
            },
            PlanOptions {
                separate: Some(["backlash:99".into(), String::new()]),
                ..base.clone()
            },
        ] {
            assert!(
                pipeline::plan_session(&session, &options, &|_| true).is_err(),
                "{options:?}"
            );
            assert!(
                pipeline::plan_robot(&session.robot, &options).is_err(),
                "{options:?}"
            );
        }
    }
}
