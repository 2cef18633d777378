//! What a caller of the library passes, broken in the ways that public fields allow: what can refuse does, in words,
//! what cannot answers with nothing, nothing panics, and everything ends.

#![allow(
    clippy::default_trait_access,
    clippy::disallowed_methods,
    reason = "it says what did not end in its time"
)]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::time::Instant;

use nalgebra::Point3;
use truepose::compensation::{Compensation, Remainder};
use truepose::design::PlanOptions;
use truepose::diagnosis::Options;
use truepose::effects::{CATALOGUE, Inputs, JointValues, Survey};
use truepose::export::{ReadBack, gap_left, gap_to, gap_without};
use truepose::kinematics::{JointKind, Pose, Robot};
use truepose::model::Calibration;
use truepose::observations::Layer;
use truepose::pipeline::{self, Method};
use truepose::report::as_measured;
use truepose::sessions::{RegionChoice, Samples, Session, write_csv, write_inline};

use crate::library_sessions::{BROKEN, COMMANDED, STRANGE, arm, calibrated, sound};

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
        let _ = Remainder::new(good, &inputs).describe();
        let _ = truepose::row_checks::check(session, values);
        let _ = truepose::set_up_errors::corrected_session(session, values);
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
    samples.clone().remove(&[0, 3, 9999]);
    let _ = good.set_up.applied(session, true);
    let _ = session
        .robot
        .problems(&truepose::diagnostic::Place::default());
}

#[test]
fn a_session_that_cannot_be_computed_with_is_refused_by_everything() {
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
                    pipeline::diagnose(&s, &Options::default(), &|_| true).is_err(),
                ),
                ("verify", pipeline::verify(&good, &s).is_err()),
                ("hand_out", pipeline::hand_out(&good, &s).is_err()),
                ("standards", pipeline::standards(&s, None).is_err()),
                (
                    "plan",
                    pipeline::plan_session(&s, &plan, &|_| true).is_err(),
                ),
                (
                    "report",
                    pipeline::report(&s, &Options::default(), &Default::default(), &|_| true)
                        .is_err(),
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
            let _ = truepose::fit::regions_of(&choice, &s);
            let _ = pipeline::identify(&s, &Method::Regional(choice), COMMANDED);
        }
        let _ = pipeline::standards(&s, Some(&good));
        let _ = pipeline::hand_out(&good, &s);
        if let Ok(found) = pipeline::diagnose(&s, &Options::default(), &|_| true) {
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

#[test]
fn what_a_stranger_fills_in_by_hand_is_completed_and_never_panics() {
    let q: Vec<[f64; 1]> = (-20..=20).map(|k| [0.07 * f64::from(k)]).collect();
    let seen = |[q]: &[f64; 1]| Point3::new(250.0 * q.cos(), 250.0 * q.sin(), 300.0);
    let points: Vec<Point3<f64>> = q.iter().map(seen).collect();
    let column = Robot {
        base_from_tool: Pose::translation(250.0, 0.0, 300.0),
        ..arm(1)
    };
    // No `dir`, no targets: what the types allow.
    let session = Session {
        samples: Samples {
            q: vec![q.iter().map(|[q]| *q).collect()],
            x_mm: points.iter().map(|p| p.x).collect(),
            y_mm: points.iter().map(|p| p.y).collect(),
            z_mm: Some(points.iter().map(|p| p.z).collect()),
            ..Samples::default()
        },
        targets: Vec::new(),
        ..Session::new(column, &q, &points).unwrap()
    };
    let identify =
        |session: &Session| pipeline::identify_checked(session, &Method::default(), COMMANDED);
    assert!(identify(&session).unwrap().identification.gap.after.rms_mm < 1e-9);
    assert!(pipeline::diagnose(&session, &Options::default(), &|_| true).is_ok());
    // Anything else is refused in words.
    let spoils: &[fn(&mut Session)] = &[
        |s| s.samples.q.clear(),
        |s| s.samples.q[0].truncate(3),
        |s| s.samples.y_mm.clear(),
        |s| s.samples.z_mm = Some(Vec::new()),
        |s| s.samples.target = Some(vec![7; s.samples.x_mm.len()]),
        |s| s.samples.dir = vec![None; 4],
        |s| s.samples.held_out = Some(Vec::new()),
        |s| s.samples.time_s = Some(vec![1.0]),
        |s| s.robot.joints.clear(),
        |s| s.robot.joints = vec![s.robot.joints[0].clone(); 101],
        |s| s.robot.base_from_tool.translation.vector.x = 1e160,
    ];
    for (k, spoil) in spoils.iter().enumerate() {
        let mut wrong = session.clone();
        spoil(&mut wrong);
        assert!(identify(&wrong).is_err(), "{k}");
        assert!(
            pipeline::diagnose(&wrong, &Options::default(), &|_| true).is_err(),
            "{k}"
        );
        assert!(wrong.checked().is_err(), "{k}");
    }
}
