//! Files that were read wrong without a word, or refused for a wrong reason, one for each way; `make.py` beside them
//! says what they hold. What is read right leaves no error of the robot that made them.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::path::Path;

use truepose::kinematics::Robot;
use truepose::sessions::{Session, load};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/doors");

/// Runs an import in the folder of the files; its exit status, what it said and the session.
fn import(arguments: &str) -> (Option<i32>, String, Option<Session>) {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("out.json");
    let mut command = crate::program::truepose();
    command.current_dir(FOLDER).arg("import");
    command.args(arguments.split_whitespace());
    if !arguments.contains("--robot") {
        command.args(["--robot", "robot.json"]);
    }
    let done = command.arg("--out").arg(&out).output().unwrap();
    let said = String::from_utf8(done.stderr).unwrap();
    let session = Path::new(&out)
        .exists()
        .then(|| load(&out).unwrap().session);
    (done.status.code(), said, session)
}

/// Where the robot carries its tool, and the parts w, x, y, z of its orientation.
fn pose(robot: &Robot, q: &[f64]) -> ([f64; 3], [f64; 4]) {
    let pose = robot.base_from_tool(q);
    let [x, y, z] = pose.translation.vector.into();
    let q = pose.rotation;
    ([x, y, z], [q.w, q.i, q.j, q.k])
}

/// The largest deviation from the robot: mm, and of the parts of the orientations.
fn off(session: &Session) -> (f64, f64) {
    let samples = &session.samples;
    let (mut off_mm, mut off_parts) = (0.0_f64, 0.0_f64);
    for row in 0..samples.len() {
        let q: Vec<f64> = samples.q.iter().map(|column| column[row]).collect();
        let ([x, y, z], parts) = pose(&session.robot, &q);
        let z_mm = samples.z_mm.as_ref().unwrap()[row];
        off_mm = (off_mm).max(
            (samples.x_mm[row] - x)
                .hypot(samples.y_mm[row] - y)
                .hypot(z_mm - z),
        );
        if let Some(measured) = &samples.orientation_wxyz {
            let dot: f64 = (0..4).map(|part| measured[part][row] * parts[part]).sum();
            off_parts = off_parts.max(1.0 - dot.abs());
        }
    }
    (off_mm, off_parts)
}

/// Orientations that fit in another convention only are named with its option and left out, and are no noise.
#[test]
fn orientations_in_another_convention_are_named_with_their_option() {
    for (arguments, says) in [
        (
            "quaternion-misheaded.csv --as csv --commands commands.csv",
            "--columns …,qw,qx,qy,qz",
        ),
        (
            "rotation-vector.csv --as csv --euler rpy --commands commands.csv",
            "--euler rotvec",
        ),
        (
            "moving-axes.csv --as csv --euler xyz-moving --commands commands.csv",
            "--euler zyx-moving",
        ),
    ] {
        let (status, said, session) = import(arguments);
        assert_eq!(status, Some(0), "{arguments}: {said}");
        let session = session.unwrap();
        let identified = truepose::pipeline::identify_checked(
            &session,
            &truepose::pipeline::Method::exact(&["joint-zero-offset"]),
            truepose::effects::JointValues::Commanded,
        );
        let problems = identified.unwrap().data_problems;
        assert!(
            problems
                .iter()
                .any(|problem| problem.what.to_string().contains(says)),
            "{arguments}: {problems:?}"
        );
        let found = truepose::pipeline::diagnose(
            &session,
            &truepose::diagnosis::Options::default(),
            &|_| true,
        )
        .unwrap();
        assert_eq!(
            found.verdict,
            truepose::diagnosis::Verdict::Unexplained,
            "{arguments}"
        );
    }
}

/// What is read right: the samples are those of the robot, and over 66 s where the file has times.
#[test]
fn what_others_write_is_read_as_they_meant_it() {
    for (arguments, has_time, orientations) in [
        ("time-epoch-ms.csv --as csv --time-unit ms", true, false),
        ("time-epoch-ns.csv --as csv --time-unit ns", true, false),
        ("time-days.csv --as csv --time-unit d", true, false),
        ("time-hours.csv --as csv", true, false),
        ("time-zone.csv --as csv", true, false),
        ("time-pm.csv --as csv", true, false),
        ("time-comma.csv --as csv", true, false),
        ("time-two-parts.csv --as csv --time-unit min", true, false),
        (
            "tum-real-first.txt --as tum --commands commands.csv --match order",
            true,
            true,
        ),
        (
            "tum-euroc.txt --as tum --commands commands.csv --match order",
            true,
            true,
        ),
        (
            "tum-euroc.txt --as csv --commands commands.csv --match order",
            true,
            true,
        ),
        (
            "comment-order.txt --as tracker --unit mm --commands commands.csv",
            false,
            false,
        ),
        (
            "comment-units.csv --as tracker --commands commands.csv",
            false,
            false,
        ),
        (
            "comment-unit-row.csv --as csv --commands commands.csv",
            false,
            false,
        ),
        (
            "ros1.csv --as csv --confirm --unit m --time-unit ns --commands commands.csv --match order",
            true,
            true,
        ),
        ("joints-from-zero.csv --as csv", false, false),
        ("joints-q0.csv --as csv", false, false),
        (
            "quaternion-q0.csv --as csv --unit mm --commands commands.csv",
            false,
            true,
        ),
        (
            "quaternion-q1.csv --as tracker --unit mm --columns name,x,y,z,qw,qx,qy,qz --commands commands.csv",
            false,
            true,
        ),
        ("gon.csv --as csv", false, false),
        ("grouped.csv --as csv", false, false),
        ("grouped-apostrophe.csv --as csv", false, false),
        (
            "motive-semicolons.csv --as optitrack --commands commands.csv --match order",
            true,
            true,
        ),
    ] {
        let (status, said, session) = import(arguments);
        assert_eq!(status, Some(0), "{arguments}: {said}");
        let session = session.unwrap();
        assert_eq!(session.samples.len(), 12, "{arguments}");
        let (off_mm, off_parts) = off(&session);
        assert!(
            off_mm < 5e-3 && off_parts < 1e-6,
            "{arguments}: {off_mm} mm, {off_parts}: {said}"
        );
        assert_eq!(
            session.samples.orientation_wxyz.is_some(),
            orientations,
            "{arguments}"
        );
        if has_time {
            let time_s = session.samples.time_s.as_ref().unwrap();
            let span = time_s[11] - time_s[0];
            assert!((span - 66.0).abs() < 1e-3, "{arguments}: {span} s");
        }
    }
}

/// What cannot be known is asked for, and what contradicts itself refused, with the true cause and what to do.
#[test]
fn what_others_write_is_refused_for_its_true_cause() {
    for (arguments, says) in [
        (
            "time-epoch-ms.csv --as csv",
            &["as ms since 1970 they are of 2024", "--time-unit ms"][..],
        ),
        ("time-epoch-ns.csv --as csv", &["--time-unit ns"]),
        (
            "time-epoch-ms.csv --as csv --time-unit s",
            &["times that begin at"],
        ),
        (
            "time-days.csv --as csv",
            &["as d since 1900", "--time-unit d"],
        ),
        (
            "time-unknown.csv --as csv",
            &["'Uhrzeit (Labor)' is a time", "--columns"],
        ),
        ("time-two-parts.csv --as csv", &["--time-unit min or h"]),
        (
            "time-no-day.csv --as csv",
            &[
                "'2024-02-31 14:00:00'",
                "--columns with - leaves the column out",
            ],
        ),
        ("time-short.csv --as csv", &["the times span 0.07 s"]),
        ("time-long.csv --as csv", &["times that begin at"]),
        (
            "tum-other.txt --as tum",
            &["the heading 'time vx vy vz x y z yaw'"],
        ),
        (
            "spherical.txt --as tracker --unit mm",
            &["no column is x, y, z for certain among 'name', 'R', 'Theta', 'Phi'"],
        ),
        (
            "comment-units.csv --as csv --unit mm --columns auto,-,-,-",
            &["no column is x, y, z"],
        ),
        (
            "ros1.csv --as csv",
            &["'field.pose.position.x' as x", "--time-unit ns"],
        ),
        (
            "quaternion-q1.csv --as csv --unit mm",
            &[
                "which of its parts comes first is not stated",
                "name,x,y,z,qx,qy,qz,qw",
            ],
        ),
        ("invisible.csv --as csv", &["<U+200B>5'"]),
        (
            "commas-twice.csv --as csv",
            &["5 headings above rows of 10 cells", "semicolons or tabs"],
        ),
        (
            "workbook.xlsx --as csv",
            &["XLSX, ODS, ZIP, not a table", "saved as CSV"],
        ),
        (
            "matrices.txt --as csv",
            &["a matrix of a rotation and a position in every row"],
        ),
        (
            "three-points.csv --as csv",
            &["3 groups of x, y, z: a, b, c", "column target"],
        ),
        (
            "gon.csv --as csv --columns -",
            &["--columns leaves every column out"],
        ),
        (
            "gon.csv --as csv --robot robot-latin.json",
            &["declared as ISO-8859-1", "UTF-8: save it so"],
        ),
        (
            "gon.csv --as csv --robot robot-xacro.json",
            &["what xacro makes of the file"],
        ),
    ] {
        let (status, said, session) = import(arguments);
        assert_eq!(status, Some(2), "{arguments}: {said}");
        assert!(session.is_none(), "{arguments}");
        for part in says {
            assert!(said.contains(part), "{arguments}: {said}");
        }
    }
}
