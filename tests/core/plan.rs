//! What to measure: the command as a person or another program uses it, and what measuring the
//! proposed poses brings, on an independent rig (`support/rig.rs`) that shares no code with the
//! model.

use std::path::{Path, PathBuf};
use std::process::Output;

use crate::cases::cases;
use crate::rig::{Design, Hidden, Random, Rig, Shot};
use serde_json::Value;
use truepose::design::{PlanOptions, plan_robot, plan_session};
use truepose::diagnosis::NextPose;
use truepose::diagnosis::{Diagnosis, Options};
use truepose::kinematics::{JointKind, Robot};
use truepose::pipeline::diagnose;
use truepose::programs::measuring_list;
use truepose::sessions::{Session, parse, parse_robot, parse_with_csv};

const AXIS: &str = r#"{ "name": "axis", "joints": [ { "name": "pan", "kind": "revolute",
    "axis": [0,0,1], "point_mm": [0,0,0], "limits": [-170, 150] } ],
    "tool": { "position_mm": [250,0,300], "quaternion_wxyz": [1,0,0,0] },
    "gravity_m_s2": [0,0,-9.81] }"#;

const SLIDE: &str = r#"{ "name": "slide", "joints": [ { "name": "x", "kind": "prismatic",
    "axis": [1,0,0], "point_mm": [0,0,0], "limits": [0, 800] } ],
    "tool": { "position_mm": [0,0,300], "quaternion_wxyz": [1,0,0,0] } }"#;

const ARM: &str = r#"{ "name": "arm", "joints": [
    { "name": "a", "kind": "revolute", "axis": [0,0,1], "point_mm": [0,0,0], "limits": [-170, 170] },
    { "name": "b", "kind": "revolute", "axis": [0,1,0], "point_mm": [0,0,400], "limits": [-90, 60] },
    { "name": "z", "kind": "prismatic", "axis": [0,0,1], "point_mm": [0,0,0], "limits": [-50, 200] } ],
    "tool": { "position_mm": [450,0,600], "quaternion_wxyz": [1,0,0,0] },
    "gravity_m_s2": [0,0,-9.81] }"#;

fn robot(text: &str) -> Robot {
    parse_robot(text.as_bytes()).expect("a good robot").robot
}

fn truepose(arguments: &[&str]) -> Output {
    crate::program::truepose()
        .args(arguments)
        .output()
        .expect("the program starts")
}

fn json(arguments: &[&str]) -> Value {
    let output = truepose(arguments);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {errors}");
    serde_json::from_slice(&output.stdout).expect("exactly one JSON document")
}

fn refusal(arguments: &[&str]) -> String {
    let output = truepose(arguments);
    let message = String::from_utf8(output.stderr).expect("UTF-8");
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
    assert!(output.stdout.is_empty(), "{arguments:?}");
    message
}

fn written(folder: &Path, name: &str, text: &str) -> String {
    let path = folder.join(name);
    std::fs::write(&path, text).expect("the folder can be written to");
    path.to_str().expect("a path in UTF-8").to_owned()
}

fn folder() -> tempfile::TempDir {
    tempfile::tempdir().expect("a folder for a moment")
}

fn session(rig: &Rig) -> Session {
    parse(rig.json("planned").as_bytes())
        .expect("the rig writes a good session")
        .session
}

fn diagnosed(rig: &Rig) -> Diagnosis {
    diagnose(&session(rig), &Options::default(), &|_| true).expect("a diagnosis")
}

fn names(answer: &Diagnosis) -> Vec<&'static str> {
    let mut names: Vec<_> = answer.found.iter().map(|f| f.effect).collect();
    names.sort_unstable();
    names
}

/// Poses as the rig measures them, one after the other; travel as the file's order has it.
fn shots(poses: &[NextPose], before: Option<&Shot>) -> Vec<Shot> {
    let mut last = before.copied();
    let mut all = Vec::new();
    for pose in poses {
        let (q, dir) = (pose.q[0], pose.dir[0]);
        let travel = last.map_or(f64::INFINITY, |l| {
            let moved = (q - l.q).abs();
            if l.dir == dir {
                l.travel + moved
            } else {
                moved
            }
        });
        let shot = Shot {
            q,
            dir,
            speed: pose.speed.as_ref().map_or(0.0, |s| s[0]),
            load: pose.load_kg.unwrap_or(0.0),
            warmth: pose.temperature_c.map_or(0.0, |t| t - 20.0),
            time: last.map_or(0.0, |l| l.time + 10.0),
            travel,
            target: usize::from(pose.target.as_deref() == Some("T2")),
        };
        last = Some(shot);
        all.push(shot);
    }
    all
}

/// The session with the proposed poses measured after the others.
fn extended(rig: &Rig, poses: &[NextPose], random: &mut Random) -> Rig {
    let mut rig = rig.clone();
    let new = poses.iter().find_map(|p| p.target_mm);
    if rig.targets.len() == 1 {
        rig.targets.extend(new);
    }
    let more = shots(poses, rig.shots.last());
    rig.measure_more(more, random);
    rig
}

#[test]
fn one_radius_is_resolved_by_the_proposed_poses_with_the_truth_alone() {
    let truth = ["base-offset", "encoder-eccentricity"];
    let design = Design {
        conditions: false,
        ..Design::default()
    };
    for seed in cases(&[3, 4, 5], 1).iter().copied() {
        let (rig, mut random) = Rig::measured(&design, &truth, 400.0, seed);
        let first = diagnosed(&rig);
        assert!(!first.equivalent.is_empty(), "one radius is ambiguous");
        let plan =
            plan_session(&session(&rig), &PlanOptions::default(), &|_| true).expect("a plan");
        assert!(!plan.open.is_empty());
        assert!(
            plan.poses.iter().any(|p| p.target_mm.is_some()),
            "another radius is needed"
        );
        let again = diagnosed(&extended(&rig, &plan.poses, &mut random));
        assert_eq!(names(&again), truth, "{:?}", rig.hidden);
        assert!(again.equivalent.is_empty(), "{:?}", again.equivalent);
    }
}

#[test]
fn one_speed_is_resolved_by_the_proposed_poses_with_the_truth_alone() {
    for (seed, id) in [(31, "tracking-lag"), (32, "backlash")] {
        let design = Design {
            one_speed: true,
            ..Design::default()
        };
        let (rig, mut random) = Rig::measured(&design, &[id], 400.0, seed);
        let poses = diagnosed(&rig).next_poses;
        assert!(!poses.is_empty() && poses.len() <= 24);
        let again = diagnosed(&extended(&rig, &poses, &mut random));
        assert_eq!(names(&again), [id]);
        assert!(again.equivalent.is_empty(), "{:?}", again.equivalent);
    }
}

#[test]
fn what_was_never_tried_is_unlocked_and_then_found() {
    let design = Design {
        one_way: true,
        ..Design::default()
    };
    let (rig, mut random) = Rig::measured(&design, &["backlash"], 400.0, 12);
    // The rig's backlash cannot be seen from one side; a size that can be seen later.
    let mut rig = rig;
    rig.hidden = vec![Hidden::Backlash(1e-3)];
    rig.measure(&mut random);
    let first = diagnosed(&rig);
    assert!(first.found.is_empty(), "{:?}", names(&first));
    assert!(!first.next_poses.is_empty() && first.next_poses.len() <= 12);
    assert!(
        first.next_poses.iter().all(|p| p.target_mm.is_none()),
        "nothing is mounted for it"
    );
    let why = &first.next_poses[0].why;
    assert!(
        why.contains("backlash") && why.contains("both sides"),
        "{why}"
    );
    let plan = plan_session(&session(&rig), &PlanOptions::default(), &|_| true).expect("a plan");
    let unlocked: Vec<&str> = plan.enables.iter().map(|l| l.effect).collect();
    assert!(unlocked.contains(&"backlash"), "{:?}", plan.cannot);
    assert!(
        first.next_poses.len() >= 4,
        "a single odd sample would pass for an outlier"
    );
    let cannot: Vec<&str> = plan.cannot.iter().map(|l| l.effect).collect();
    assert!(
        cannot.contains(&"joint-compliance"),
        "gravity is along the axis: {cannot:?}"
    );
    let again = diagnosed(&extended(&rig, &plan.poses, &mut random));
    let testable = |id: &str| again.not_testable.iter().all(|n| n.effect != id);
    assert!(
        unlocked.iter().all(|id| testable(id)),
        "{:?}",
        again.not_testable
    );
    assert_eq!(names(&again), ["backlash"]);
}

#[test]
fn no_pose_carries_more_than_the_load_that_is_allowed() {
    let design = Design {
        one_way: true,
        ..Design::default()
    };
    let (rig, _) = Rig::measured(&design, &["backlash"], 400.0, 12);
    let mut session = session(&rig);
    // Nothing is said of loads: one has to be tried.
    session.samples.load_kg = None;
    let options = PlanOptions {
        load_kg: Some(1.0),
        ..PlanOptions::default()
    };
    let plan = plan_session(&session, &options, &|_| true).expect("a plan");
    let loads: Vec<f64> = plan.poses.iter().filter_map(|p| p.load_kg).collect();
    assert!(loads.contains(&1.0), "{loads:?}");
    assert!(loads.iter().all(|kg| *kg <= 1.0), "{loads:?}");
}

#[test]
fn a_first_measurement_of_an_axis_names_what_is_hidden_in_it() {
    let plan = plan_robot(&robot(AXIS), &PlanOptions::default()).expect("a plan");
    assert_eq!(plan.poses.len(), 60);
    let locked: Vec<&str> = plan.cannot.iter().map(|l| l.effect).collect();
    assert_eq!(locked, ["joint-compliance"], "gravity is along the axis");
    for (seed, id) in [
        (1, "backlash"),
        (2, "tracking-lag"),
        (3, "link-droop"),
        (4, "thermal-growth"),
        (5, "encoder-eccentricity"),
        (6, "axis-tilt"),
    ] {
        let mut random = Random(seed);
        let mut rig = Rig::new(&Design::default(), &mut random);
        rig.targets = plan
            .targets
            .iter()
            .map(|t| t.position_mm.coords.into())
            .collect();
        rig.shots = shots(&plan.poses, None);
        let hidden = Hidden::random(id, &mut random, &rig.design);
        rig.hidden = vec![rig.sized(&hidden, 200.0)];
        rig.measure(&mut random);
        let answer = diagnosed(&rig);
        assert_eq!(names(&answer), [id], "{:?}", rig.hidden);
        assert!(answer.equivalent.is_empty(), "{:?}", answer.equivalent);
        let repeats = truepose::diagnosis::FloorFrom::Repeats;
        assert_eq!(
            answer.floor.from, repeats,
            "the plan returns to earlier poses"
        );
    }
}

#[test]
fn a_first_measurement_varies_everything_a_technician_can_vary() {
    let plan = plan_robot(&robot(AXIS), &PlanOptions::default()).expect("a plan");
    let count = |f: &dyn Fn(&NextPose) -> bool| plan.poses.iter().filter(|p| f(p)).count();
    for side in [-1.0, 1.0] {
        assert!(count(&|p| p.dir == [side]) >= 15);
    }
    assert!(count(&|p| p.load_kg == Some(0.0)) >= 20 && count(&|p| p.load_kg == Some(3.0)) >= 20);
    for target in ["T1", "T2"] {
        assert!(count(&|p| p.target.as_deref() == Some(target)) >= 20);
    }
    let at_speed = |deg_s: f64| {
        count(&|p| {
            let speed = p.speed.as_ref().expect("speeds")[0].to_degrees().abs();
            (speed - deg_s).abs() < 1e-6
        })
    };
    assert!(at_speed(0.0) >= 20 && at_speed(10.0) >= 5 && at_speed(20.0) >= 5);
    assert!(count(&|p| p.why.contains("return to pose")) >= 8);
    let q: Vec<f64> = plan.poses.iter().map(|p| p.q[0].to_degrees()).collect();
    let low = q.iter().copied().fold(f64::INFINITY, f64::min);
    let high = q.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    assert!(
        (low + 170.0).abs() < 1e-9 && (high - 150.0).abs() < 1e-9,
        "{low} … {high}"
    );
}

#[test]
fn limits_are_kept_and_the_plan_is_the_same_every_time() {
    for text in [AXIS, SLIDE, ARM] {
        let robot = robot(text);
        let options = PlanOptions {
            poses: Some(31),
            ..PlanOptions::default()
        };
        let plan = plan_robot(&robot, &options).expect("a plan");
        assert_eq!(plan.poses.len(), 31);
        for pose in &plan.poses {
            assert_eq!(pose.q.len(), robot.joints.len());
            for (q, joint) in pose.q.iter().zip(&robot.joints) {
                let limits = joint.limits.expect("limits");
                assert!(
                    *q >= limits.from && *q <= limits.to,
                    "{q} in {}",
                    robot.name
                );
            }
        }
        assert_eq!(plan, plan_robot(&robot, &options).expect("a plan"));
        let turns = robot.joints.iter().any(|j| j.kind == JointKind::Revolute);
        let mounts = plan.poses.iter().any(|p| p.target_mm.is_some());
        assert_eq!(
            turns, mounts,
            "{}: a second reflector where something turns",
            robot.name
        );
        let mut limits = plan.expected.limits.iter();
        let backlash = limits.find(|s| s.effect == "backlash");
        let unit = if turns { "width_deg" } else { "width_mm" };
        assert_eq!(backlash.expect("testable").sizes[0].0, unit);
    }
}

#[test]
fn a_reflector_is_proposed_only_within_reach() {
    let plan = plan_robot(&robot(AXIS), &PlanOptions::default()).expect("a plan");
    for target in &plan.targets {
        assert!(target.position_mm.coords.norm() <= 300.0, "{target:?}");
    }
}

#[test]
fn two_effects_are_told_apart_or_it_is_said_that_nothing_does() {
    let robot_of_slide = robot(SLIDE);
    let two = |a: &str, b: &str| PlanOptions {
        separate: Some([a.to_owned(), b.to_owned()]),
        ..PlanOptions::default()
    };
    let plan =
        plan_robot(&robot_of_slide, &two("joint-zero-offset", "base-offset")).expect("a plan");
    let separation = plan.separation.expect("asked for");
    assert!(
        separation.impossible.is_some(),
        "a slide's zero offset is an offset of the base"
    );
    assert!(plan.poses.is_empty());
    let axis = robot(AXIS);
    let plan = plan_robot(&axis, &two("backlash", "lost-motion")).expect("a plan");
    let separation = plan.separation.expect("asked for");
    assert!(separation.impossible.is_none());
    for k in 0..2 {
        assert!(
            separation.left_after[k] > 2.0 * separation.left_before[k],
            "{:?} → {:?}",
            separation.left_before,
            separation.left_after
        );
    }
    let plan = plan_robot(&axis, &two("joint-compliance", "backlash")).expect("a plan");
    let because = plan
        .separation
        .and_then(|s| s.impossible)
        .expect("not to be seen");
    assert!(because.contains("gravity"), "{because}");
    let design = Design {
        one_speed: true,
        ..Design::default()
    };
    let (rig, _) = Rig::measured(&design, &[], 0.0, 5);
    let plan =
        plan_session(&session(&rig), &two("backlash", "tracking-lag"), &|_| true).expect("a plan");
    let separation = plan.separation.expect("asked for");
    assert!(
        separation.left_before[0] < 0.01,
        "{:?}",
        separation.left_before
    );
    assert!(
        separation.decided && separation.left_after[0] > 0.05,
        "{:?}",
        separation.left_after
    );
    assert!(plan_robot(&axis, &two("backlash", "backlash")).is_err());
    let joint = plan_robot(&axis, &two("backlash:2", "tracking-lag")).expect_err("no such joint");
    let says = joint.describe();
    assert!(says.contains("--separate backlash:2: expected"), "{says}");
}

#[test]
fn more_poses_than_needed_lower_the_detection_limits() {
    let (rig, _) = Rig::measured(&Design::default(), &[], 0.0, 8);
    let with = |poses| {
        let options = PlanOptions {
            poses: Some(poses),
            ..PlanOptions::default()
        };
        plan_session(&session(&rig), &options, &|_| true).expect("a plan")
    };
    let (few, many) = (with(6), with(60));
    assert_eq!((few.poses.len(), many.poses.len()), (6, 60));
    let limit = |plan: &truepose::design::Plan, id: &str| {
        let one = plan.expected.limits.iter().find(|s| s.effect == id);
        one.expect("testable").sizes[0].1
    };
    for id in ["backlash", "tracking-lag", "joint-scale", "base-offset"] {
        assert!(limit(&many, id) < limit(&few, id), "{id}");
    }
}

#[test]
fn the_command_prints_one_document_with_the_documented_keys() {
    let folder = folder();
    let path = written(folder.path(), "Achse µ.json", AXIS);
    let plan = json(&["plan", &path, "--poses", "20", "--json"]);
    assert_eq!(plan["format"], "truepose-plan/1");
    assert_eq!(plan["for"], "robot");
    let poses = plan["poses"].as_array().expect("poses");
    assert_eq!(poses.len(), 20);
    for pose in poses {
        for key in [
            "q_deg",
            "dir",
            "target",
            "speed_deg_s",
            "load_kg",
            "temperature_c",
            "why",
        ] {
            assert!(!pose[key].is_null(), "{key}: {pose}");
        }
    }
    for key in [
        "separates",
        "unlocks",
        "cannot",
        "will_be_seen_above",
        "alike",
    ] {
        assert!(plan[key].is_array(), "{key}");
    }
    assert!(plan["separation"].is_null());
    let cannot = &plan["cannot"][0];
    assert_eq!(cannot["effect"], "joint-compliance");
    assert!(
        cannot["because"]
            .as_str()
            .expect("words")
            .contains("gravity")
    );
    assert_eq!(cannot["do"], Value::Array(Vec::new()));
    let with_dh = r#"{ "name": "dh", "dh": [ { "a_mm": 250, "alpha_deg": 0, "d_mm": 100,
        "theta_deg": 0, "convention": "standard" } ] }"#;
    let path = written(folder.path(), "dh.json", with_dh);
    let plan = json(&[
        "plan",
        &path,
        "--separate",
        "backlash,tracking-lag",
        "--json",
    ]);
    assert_eq!(plan["separation"]["possible"], true);
    assert_eq!(plan["separation"]["between"][1]["effect"], "tracking-lag");
}

#[test]
fn the_list_of_poses_is_the_commanded_part_of_a_session() {
    let folder = folder();
    for (name, text) in [("axis", AXIS), ("slide", SLIDE), ("arm", ARM)] {
        let path = written(folder.path(), &format!("{name}.json"), text);
        let out: PathBuf = folder.path().join(format!("{name} poses.csv"));
        let out = out.to_str().expect("UTF-8");
        let done = truepose(&["plan", &path, "--poses", "24", "--out", out]);
        assert_eq!(
            done.status.code(),
            Some(0),
            "{}",
            String::from_utf8_lossy(&done.stderr)
        );
        let csv = std::fs::read_to_string(out).expect("written");
        // What the instrument brings: three columns more.
        let with_measured: Vec<String> = csv
            .lines()
            .enumerate()
            .map(|(k, line)| match k {
                0 => format!("x_mm,y_mm,z_mm,{line}"),
                _ => format!("1.5,2,{k},{line}"),
            })
            .collect();
        let targets = if csv.contains("target_x_mm") {
            r#""targets": {"T1": [0,0,0], "T2": [270,0,120]},"#
        } else {
            ""
        };
        let document = format!(
            r#"{{"format":"truepose-session/1","name":"n","robot":{text},{targets}"samples":{{"file":"s.csv"}}}}"#
        );
        let session = parse_with_csv(document.as_bytes(), with_measured.join("\n").as_bytes())
            .expect("columns of a session")
            .session;
        let samples = &session.samples;
        assert_eq!(samples.len(), 24, "{name}");
        assert!(samples.dir.iter().all(Option::is_some), "{name}");
        assert!(samples.speed.iter().all(Option::is_some), "{name}");
        assert!(
            samples.load_kg.is_some() && samples.temperature_c.is_some(),
            "{name}"
        );
        let plan = plan_robot(
            &robot(text),
            &PlanOptions {
                poses: Some(24),
                ..PlanOptions::default()
            },
        )
        .expect("a plan");
        assert_eq!(csv, measuring_list(&plan.poses, &plan.robot));
        for (k, pose) in plan.poses.iter().enumerate() {
            for (q, column) in pose.q.iter().zip(&samples.q) {
                assert!((q - column[k]).abs() < 1e-9, "{name}");
            }
        }
        // An existing file is not replaced, an input never.
        refusal(&["plan", &path, "--poses", "24", "--out", out]);
        refusal(&["plan", &path, "--out", &path, "--force"]);
        assert_eq!(std::fs::read_to_string(&path).expect("still there"), text);
    }
}

#[test]
fn wrong_input_is_refused_with_its_place_and_nothing_is_written() {
    let folder = folder();
    let bad = AXIS.replace("[0,0,1]", "[0,0,0]");
    let path = written(folder.path(), "bad.json", &bad);
    let out = folder.path().join("poses.csv");
    let message = refusal(&["plan", &path, "--out", out.to_str().expect("UTF-8")]);
    assert!(
        message.contains("bad.json") && message.contains("line 2"),
        "{message}"
    );
    assert!(message.contains("axis"), "{message}");
    assert!(!out.exists());
    let broken = written(folder.path(), "broken.json", "{ \"joints\": [ }");
    assert!(refusal(&["plan", &broken]).contains("line 1"));
    assert!(refusal(&["plan", folder.path().to_str().expect("UTF-8")]).contains("expected"));
    let good = written(folder.path(), "good.json", AXIS);
    let unknown = refusal(&["plan", &good, "--separate", "backlash,gremlins"]);
    assert!(unknown.contains("gremlins"), "{unknown}");
    let one = refusal(&["plan", &good, "--separate", "backlash"]);
    assert!(one.contains("expected two"), "{one}");
    let joint = refusal(&["plan", &good, "--separate", "backlash:7,tracking-lag"]);
    assert!(joint.contains("from 1 to 1"), "{joint}");
    for wrong in [
        ["--poses", "0"],
        ["--poses", "100000"],
        ["--poses", "-3"],
        ["--sigma", "nan"],
        ["--sigma", "0"],
        ["--load", "-1"],
    ] {
        refusal(&["plan", &good, wrong[0], wrong[1]]);
    }
}

#[test]
fn tiny_sessions_and_single_poses_are_planned_for_as_well() {
    for samples in [1, 2, 5] {
        let design = Design {
            samples,
            ..Design::default()
        };
        let (rig, _) = Rig::measured(&design, &[], 0.0, 17);
        for poses in [None, Some(1), Some(7)] {
            let options = PlanOptions {
                poses,
                ..PlanOptions::default()
            };
            let plan = plan_session(&session(&rig), &options, &|_| true).expect("a plan");
            if let Some(poses) = poses {
                assert_eq!(plan.poses.len(), poses);
            }
        }
    }
    for poses in [1, 2, 3, 9] {
        let options = PlanOptions {
            poses: Some(poses),
            ..PlanOptions::default()
        };
        for text in [AXIS, SLIDE, ARM] {
            let plan = plan_robot(&robot(text), &options).expect("a plan");
            assert_eq!(plan.poses.len(), poses);
        }
    }
}
