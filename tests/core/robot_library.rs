//! The library of robots: sound as data, and its forward positions and reach against second sources.
//!
//! `tests/data/robots/library.json` holds positions of the flange computed from the tables of a second source
//! (Denavit–Hartenberg rows, ortho-parallel parameters, MJCF or URDF of other authors), in this library's
//! signs and zeros, and published reaches.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::collections::BTreeSet;
use std::path::Path;
use std::process::Output;

use nalgebra::{Point3, Vector3};
use serde::Deserialize;
use serde_json::Value;
use truepose::kinematics::{JointKind, Robot};
use truepose::present::robots_v1::figure;
use truepose::robots::{LibraryRobot, RobotKind, library, named, source, sources};
use truepose::sessions::{load_robot, parse_robot, robot_document};

#[derive(Deserialize)]
struct Reference {
    robots: Vec<Checked>,
}

#[derive(Deserialize)]
struct Checked {
    id: String,
    forward: Option<Forward>,
    reach: Option<Reach>,
}

#[derive(Deserialize)]
struct Forward {
    source: [String; 2],
    tolerance_mm: f64,
    zero_mm: [f64; 3],
    /// Degrees, mm of a joint that slides.
    pose: Vec<f64>,
    position_mm: [f64; 3],
}

#[derive(Deserialize)]
struct Reach {
    source: [String; 2],
    of: String,
    reach_mm: f64,
    tolerance_mm: f64,
}

fn reference() -> Reference {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/robots/library.json");
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}

fn of_id(id: &str) -> &'static LibraryRobot {
    library().iter().find(|robot| robot.id == id).unwrap()
}

#[test]
fn at_least_forty_robots_have_names_kinds_ranges_and_sources() {
    let all = library();
    assert!(all.len() >= 40, "{}", all.len());
    let (mut ids, mut titles) = (BTreeSet::new(), BTreeSet::new());
    for robot in all {
        assert!(ids.insert(&robot.id), "{}", robot.id);
        assert!(titles.insert(robot.title()), "{}", robot.title());
        assert_eq!(named(&robot.id).unwrap().id, robot.id);
        let joints = &robot.robot.joints;
        let expected = match robot.kind {
            RobotKind::SixJoints | RobotKind::OffsetWrist => 6,
            RobotKind::SevenJoints => 7,
            RobotKind::Scara => 4,
            RobotKind::Positioner => 2,
            RobotKind::RotaryAxis => 1,
        };
        assert_eq!(joints.len(), expected, "{}", robot.id);
        let slides = joints.iter().filter(|j| j.kind == JointKind::Prismatic);
        assert_eq!(slides.count(), usize::from(robot.kind == RobotKind::Scara));
        for joint in joints {
            let limits = joint.limits.expect("a range");
            let [from, to] = [limits.from, limits.to].map(|end| joint.kind.to_display(end));
            let widest = if joint.kind == JointKind::Prismatic {
                500.0
            } else {
                920.0
            };
            assert!(
                from < to && to - from <= widest,
                "{} {}: {from} … {to}",
                robot.id,
                joint.name
            );
        }
        let gravity = robot.robot.gravity_m_s2.expect("a way it is mounted");
        assert!(
            (gravity + Vector3::<f64>::z() * 9.81).norm() < 1e-12,
            "{}",
            robot.id
        );
        let references = [
            &robot.sources.figures,
            &robot.sources.gears,
            &robot.sources.checked_positions,
            &robot.sources.checked_reach,
        ];
        for reference in references
            .into_iter()
            .flatten()
            .chain([&robot.sources.geometry])
        {
            assert!(
                source(&reference.source).is_some() && !reference.place.is_empty(),
                "{}",
                robot.id
            );
        }
        let has_figures = robot.reach_mm.is_some() || robot.repeatability_mm.is_some();
        assert_eq!(robot.sources.figures.is_some(), has_figures, "{}", robot.id);
        assert_eq!(
            robot.sources.gears.is_some(),
            !robot.gear_ratios.is_empty(),
            "{}",
            robot.id
        );
        if let Some(rp) = robot.repeatability_mm {
            assert!((0.001..=1.0).contains(&rp), "{}: {rp}", robot.id);
        }
    }
    for kind in RobotKind::ALL {
        assert!(
            all.iter().any(|robot| robot.kind == kind),
            "{}",
            kind.name()
        );
    }
}

/// Whether the last three axes meet in a point is what tells the two kinds of six joints apart.
#[test]
fn wrists_are_what_the_kind_says() {
    for robot in library()
        .iter()
        .filter(|robot| robot.robot.joint_count() == 6)
    {
        let axes: Vec<_> = robot.robot.joints[3..]
            .iter()
            .map(|joint| joint.axis)
            .collect();
        let meet = |a: usize, b: usize| {
            let normal = axes[a].direction.cross(&axes[b].direction);
            let between = axes[b].point_mm - axes[a].point_mm;
            normal.norm() > 1e-6 && between.dot(&normal).abs() / normal.norm() < 0.01
        };
        let centre = |a: usize, b: usize| {
            let normal = axes[a].direction.cross(&axes[b].direction);
            let between = axes[b].point_mm - axes[a].point_mm;
            let along = between.cross(&axes[b].direction).dot(&normal) / normal.norm_squared();
            axes[a].point_mm + along * axes[a].direction.into_inner()
        };
        let spherical = meet(0, 1) && meet(1, 2) && (centre(0, 1) - centre(1, 2)).norm() < 0.1;
        let said = robot.kind == RobotKind::SixJoints;
        assert_eq!(spherical, said, "{}", robot.id);
    }
}

#[test]
fn forward_positions_are_those_of_a_second_source() {
    let mut checked = 0;
    for case in reference().robots {
        let Some(forward) = case.forward else {
            continue;
        };
        let robot = of_id(&case.id);
        let own = robot
            .sources
            .checked_positions
            .as_ref()
            .expect("the file says what it was checked against");
        assert_eq!(
            [&own.source, &own.place],
            forward.source.each_ref(),
            "{}",
            case.id
        );
        let joints = &robot.robot.joints;
        let zero = vec![0.0; joints.len()];
        let pose: Vec<f64> = joints
            .iter()
            .zip(&forward.pose)
            .map(|(j, q)| j.kind.to_base_units(*q))
            .collect();
        for (q, expected) in [(zero, forward.zero_mm), (pose, forward.position_mm)] {
            let found = robot.robot.point_in_base(&q, &Point3::origin());
            let off = (found - Point3::from(expected)).norm();
            assert!(
                off <= forward.tolerance_mm,
                "{}: {found} for {expected:?}",
                case.id
            );
        }
        checked += 1;
    }
    assert!(checked >= 50, "{checked}");
}

/// The greatest distance from axis 1 that a point of the arm reaches, whatever the ranges: of the flange, or of
/// the wrist centre (the point of the last axis but one nearest to the last), in the plane of the arm or at all.
fn greatest_reach(robot: &Robot, of: &str) -> f64 {
    let n = robot.joints.len();
    let flange = of == "flange";
    let tool = Point3::from(robot.base_from_tool.translation.vector);
    let point = if flange {
        tool
    } else {
        let (a, b) = (robot.joints[n - 2].axis, robot.joints[n - 1].axis);
        let normal = a.direction.cross(&b.direction);
        let between = b.point_mm - a.point_mm;
        let along = between.cross(&b.direction).dot(&normal) / normal.norm_squared();
        a.point_mm + along * a.direction.into_inner()
    };
    // In the tool frame, at home; joints behind the point stay at zero and do not move it.
    let in_tool = robot.base_from_tool.inverse() * point;
    let free = if n == 4 {
        1..2
    } else {
        1..n - if flange { 1 } else { 2 }
    };
    let (first, second) = (robot.joints[0].axis, robot.joints[1].axis);
    let distance = |q: &[f64]| {
        let from_axis = robot.point_in_base(q, &in_tool) - first.point_mm;
        let mut across = from_axis - first.direction.dot(&from_axis) * first.direction.into_inner();
        if of.ends_with("in the plane of the arm") {
            across -= second.direction.dot(&across) * second.direction.into_inner();
        }
        across.norm()
    };
    let mut best = 0.0_f64;
    for start in 0..12_u32 {
        let mut q = vec![0.0; n];
        for (k, joint) in free.clone().enumerate() {
            // Spread over the circle, another way for each joint.
            q[joint] = f64::from(start) * (0.9 + 0.7 * k as f64);
        }
        let (mut step, mut here) = (0.5, distance(&q));
        while step > 1e-7 {
            let mut better = false;
            for joint in free.clone() {
                for by in [step, -step] {
                    q[joint] += by;
                    let there = distance(&q);
                    if there > here {
                        (here, better) = (there, true);
                    } else {
                        q[joint] -= by;
                    }
                }
            }
            if !better {
                step *= 0.5;
            }
        }
        best = best.max(here);
    }
    best
}

#[test]
fn reaches_are_the_published_ones() {
    let mut checked = 0;
    for case in reference().robots {
        let Some(reach) = case.reach else { continue };
        let robot = of_id(&case.id);
        let own = robot
            .sources
            .checked_reach
            .as_ref()
            .expect("the file says what it was checked against");
        assert_eq!(
            [&own.source, &own.place],
            reach.source.each_ref(),
            "{}",
            case.id
        );
        let found = greatest_reach(&robot.robot, &reach.of);
        let off = (found - reach.reach_mm).abs();
        assert!(
            off <= reach.tolerance_mm,
            "{}: {found:.2} for {}",
            case.id,
            reach.reach_mm
        );
        checked += 1;
    }
    assert!(checked >= 60, "{checked}");
}

#[test]
fn what_was_not_checked_is_said() {
    let checked = reference().robots;
    for robot in library() {
        let case = checked.iter().find(|case| case.id == robot.id);
        let says = robot.not_checked.iter().any(|what| what == "link lengths");
        let is_own = robot.sources.geometry.source == "own";
        assert_eq!(says, case.is_none() && !is_own, "{}", robot.id);
    }
}

#[test]
fn a_robot_is_written_as_a_file_that_reads_back_the_same() {
    for robot in library() {
        let read = parse_robot(robot_document(&robot.robot).as_bytes()).unwrap();
        assert_eq!(read.robot, robot.robot, "{}", robot.id);
        assert_eq!(read.findings, [], "{}", robot.id);
    }
}

fn truepose(arguments: &[&str]) -> Output {
    crate::program::truepose()
        .args(arguments)
        .env_remove("DISPLAY")
        .env_remove("WAYLAND_DISPLAY")
        .output()
        .expect("the program starts")
}

fn answered(arguments: &[&str]) -> String {
    let output = truepose(arguments);
    let errors = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{arguments:?}: {errors}");
    String::from_utf8(output.stdout).unwrap()
}

fn refused(arguments: &[&str]) -> String {
    let output = truepose(arguments);
    let errors = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(2), "{arguments:?}: {errors}");
    errors
}

#[test]
fn the_terminal_lists_finds_and_writes_robots() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("robot.json");
    let file = file.to_str().unwrap();
    let all: Value = serde_json::from_str(&answered(&["robots", "--json"])).unwrap();
    assert_eq!(all["format"], "truepose-robot-list/1");
    assert_eq!(all["robots"].as_array().unwrap().len(), library().len());
    assert!(
        all["sources"]["ur-dh"]["at"]
            .as_str()
            .unwrap()
            .starts_with("https://")
    );
    let shown = answered(&["robots", "kuka", "sixx"]);
    assert!(
        shown.contains("kr6-r700") && shown.contains("kr10-r1100"),
        "{shown}"
    );
    assert!(!shown.contains("ur5e"), "{shown}");
    let one = answered(&["robots", "UR", "5e"]);
    assert!(
        one.contains("geometry and ranges: Universal Robots"),
        "{one}"
    );
    answered(&["robots", "ur5e", "--out", file]);
    assert_eq!(load_robot(file).unwrap().robot, of_id("ur5e").robot);
    assert!(refused(&["robots", "ur5e", "--out", file]).contains("exists"));
    let unknown = refused(&["robots", "ur5x"]);
    assert!(
        unknown.contains("nearest") && unknown.contains("ur5e"),
        "{unknown}"
    );
}

#[test]
fn an_unknown_robot_is_answered_with_the_nearest_names_and_a_missing_file_with_its_name() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("s.json");
    let out = out.to_str().unwrap();
    let unknown = refused(&["simulate", "--robot", "lrmate20id", "--out", out]);
    assert!(
        unknown.contains("no file") && unknown.contains("lrmate200id"),
        "{unknown}"
    );
    let missing = refused(&["simulate", "--robot", "arm.json", "--out", out]);
    assert!(
        missing.contains("arm.json") && !missing.contains("library"),
        "{missing}"
    );
    let unknown = refused(&["plan", "ur5x"]);
    assert!(unknown.contains("ur5e"), "{unknown}");
    let both = refused(&["simulate", "a.json", "--robot", "ur5e", "--out", out]);
    assert!(both.contains("--robot"), "{both}");
    let wrong = refused(&[
        "simulate",
        "--robot",
        "ur5e",
        "--effect",
        "backlash:9:width_deg=0.04",
        "--out",
        out,
    ]);
    assert!(wrong.contains("effects[0]"), "{wrong}");
    assert!(
        std::fs::read_dir(folder.path()).unwrap().next().is_none(),
        "nothing was written"
    );
}

/// One robot of every kind with something hidden in it: simulated, diagnosed, found.
#[test]
fn what_is_hidden_in_a_robot_of_every_kind_is_found() {
    let cases = [
        (
            "kr6-r700",
            "encoder-eccentricity",
            3,
            "amplitude_deg=0.03,phase_deg=40",
        ),
        ("ur5e", "backlash", 2, "width_deg=0.04"),
        (
            "iiwa14-r820",
            "joint-compliance",
            2,
            "compliance_urad_per_nm=4",
        ),
        ("rh6frh5520", "thermal-zero-drift", 2, "deg_per_degc=0.01"),
        ("d500", "tracking-lag", 1, "delay_s=0.003"),
        (
            "column",
            "gear-transmission-error",
            1,
            "order=30,amplitude_deg=0.02,phase_deg=10",
        ),
    ];
    let kinds: BTreeSet<&str> = cases.iter().map(|case| of_id(case.0).kind.name()).collect();
    assert_eq!(kinds.len(), RobotKind::ALL.len(), "one of every kind");
    let folder = tempfile::tempdir().unwrap();
    for (robot, effect, joint, parameters) in crate::cases::cases(&cases, 3).iter().copied() {
        let session = folder.path().join(format!("{robot}.json"));
        let session = session.to_str().unwrap();
        let hidden = format!("{effect}:{joint}:{parameters}");
        answered(&[
            "simulate", "--robot", robot, "--poses", "120", "--effect", &hidden, "--noise", "0.03",
            "--seed", "7", "--out", session,
        ]);
        let written = std::fs::read_to_string(session).unwrap();
        assert!(
            !written.contains(effect),
            "the session does not say what is hidden in it"
        );
        let answer: Value =
            serde_json::from_str(&answered(&["diagnose", session, "--json"])).unwrap();
        let found = answer["found"].as_array().unwrap();
        let names: Vec<_> = found
            .iter()
            .map(|one| (one["effect"].as_str().unwrap(), one["joint"].as_u64()))
            .collect();
        assert_eq!(names, [(effect, Some(joint))], "{robot}: {answer:#}");
        assert_eq!(answer["verdict"], "explained", "{robot}");
    }
}

/// Options have no lines: what is wrong is said by its name.
#[test]
fn a_wrong_option_is_said_without_lines_of_a_file_that_is_not_there() {
    for (option, value, says) in [
        ("--poses", "0", "poses.random.count: 0"),
        ("--noise", "-1", "--noise -1: expected a length"),
        ("--effect", "backlash:9:width_deg=1", "the robot has 6"),
        (
            "--effect",
            "backlash:2:width_mm=1",
            "expected width_deg: joint 2 turns",
        ),
        ("--effect", "backlash:width_deg=1", "its joint, from 1 to 6"),
    ] {
        let said = refused(&[
            "simulate",
            "--robot",
            "ur5e",
            option,
            value,
            "--out",
            "none.json",
        ]);
        assert!(said.contains(says), "{option} {value}: {said}");
        assert!(!said.contains("line "), "{option} {value}: {said}");
    }
}

#[test]
fn the_scenario_beside_a_session_makes_the_same_session_again() {
    let folder = tempfile::tempdir().unwrap();
    let path = |name: &str| folder.path().join(name).to_str().unwrap().to_owned();
    let made = answered(&[
        "simulate",
        "--robot",
        "gp8",
        "--poses",
        "20",
        "--effect",
        "backlash:2:width_deg=0.05",
        "--loads",
        "none",
        "--temperature",
        "20,30",
        "--outliers",
        "0.05:1",
        "--seed",
        "3",
        "--out",
        &path("one.json"),
        "--json",
    ]);
    let made: Value = serde_json::from_str(&made).unwrap();
    assert_eq!(made["samples"], 60);
    let scenario = made["scenario"].as_str().unwrap();
    assert_eq!(scenario, path("one.scenario.json"));
    answered(&["simulate", scenario, "--out", &path("two.json")]);
    let [one, two] = ["one.csv", "two.csv"].map(|name| std::fs::read(path(name)).unwrap());
    assert_eq!(one, two);
    let head = String::from_utf8(one).unwrap();
    assert!(head.contains("temperature_c") && !head.contains("load_kg"));
}

/// `truepose robots` shows every robot with its figures, and of each its sources and checks.
#[test]
fn the_terminal_shows_every_robot_with_its_figures_sources_and_checks() {
    let words = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ");
    let list = answered(&["robots"]);
    let list: Vec<String> = list.lines().map(words).collect();
    assert_eq!(list.last().unwrap(), &format!("{} robots", library().len()));
    // A heading, and how many there are.
    assert_eq!(list.len(), library().len() + 2);
    for robot in library() {
        let figures = [robot.reach_mm, robot.payload_kg, robot.repeatability_mm].map(figure);
        let row = words(&format!(
            "{} {} {} {} {} {}",
            robot.id,
            robot.maker,
            robot.model,
            robot.kind.name(),
            robot.robot.joint_count(),
            figures.join(" "),
        ));
        assert!(list.contains(&row), "no row: {row}");

        let shown = answered(&["robots", &robot.id]);
        let references = [
            ("geometry and ranges", Some(&robot.sources.geometry)),
            ("reach, load, repeatability", robot.sources.figures.as_ref()),
            ("gear ratios", robot.sources.gears.as_ref()),
            (
                "positions checked against",
                robot.sources.checked_positions.as_ref(),
            ),
            (
                "reach checked against",
                robot.sources.checked_reach.as_ref(),
            ),
        ];
        for (what, reference) in references {
            let Some(reference) = reference else { continue };
            let source = source(&reference.source).unwrap();
            let line = format!("{what}: {}: {}\n", source.what, reference.place);
            assert!(shown.contains(&line), "{shown}\nlacks: {line}");
            let commit = source.commit.as_deref().unwrap_or("");
            let line = shown
                .lines()
                .find(|line| line.starts_with(&format!("source {}: ", reference.source)))
                .unwrap_or_else(|| panic!("{shown}\nlacks the source {}", reference.source));
            for part in [&source.at, commit, &source.licence] {
                assert!(line.contains(part), "{line}\nlacks: {part}");
            }
        }
        assert_eq!(
            shown.contains("not checked: "),
            !robot.not_checked.is_empty()
        );
        for what in &robot.not_checked {
            assert!(shown.contains(what), "{shown}\nlacks: {what}");
        }
    }
    let listed: Value = serde_json::from_str(&answered(&["robots", "--json"])).unwrap();
    for (key, source) in sources() {
        assert_eq!(listed["sources"][key]["licence"], source.licence, "{key}");
    }
}
