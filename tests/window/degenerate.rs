//! Sessions that have next to nothing in them, or too much of one thing: every step, every chart,
//! the search, the exports and the reports say what is the matter and what to do, and nothing ends
//! in a panic or in a number that is none.

use crate::window;
use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use crate::touring::{sound, tour};
use crate::window::{STEPS, Window, press, says, type_into};
use truepose::sessions::{Replacing, save};
use truepose::simulation::{parse_scenario, simulate, unwatched};

/// A turning column of 250 mm with these samples, x and y in mm, and whatever stands beside them.
fn column(rows: &str, limits: bool, more: &str) -> (String, String) {
    let limits = if limits { r#","limits":[-90,90]"# } else { "" };
    let document = format!(
        r#"{{"format":"truepose-session/1","name":"few","robot":{{"name":"column","joints":[{{"name":"pan",
        "kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0]{limits}}}],
        "tool":{{"position_mm":[250,0,300],"quaternion_wxyz":[1,0,0,0]}}}}{more},
        "samples":{{"file":"few.csv"}}}}"#
    );
    (document, rows.to_owned())
}

fn written(folder: &Path, (document, samples): (String, String)) -> PathBuf {
    let path = folder.join("few.json");
    std::fs::write(folder.join("few.csv"), samples).expect("written");
    std::fs::write(&path, document).expect("written");
    path
}

/// Goes through the whole window with it.
fn toured(document: (String, String), name: &str) -> Window {
    let folder = tempfile::tempdir().expect("a folder");
    let path = written(folder.path(), document);
    let mut window = window::window(Some(path));
    tour(&mut window, folder.path(), name);
    window
}

const XYZ: &str = "q1_deg,x_mm,y_mm,z_mm\n";

#[test]
fn one_sample() {
    let mut window = toured(
        column(&format!("{XYZ}10,245,44,300\n"), true, ""),
        "one sample",
    );
    press(&mut window, "2 Regions");
    press(&mut window, "Uniform");
    type_into(&mut window, "Number of regions", "6");
    assert!(says(
        &window,
        "one sample to fit: a correction, but nothing to tell how sure it is"
    ));
    assert!(says(&window, "no sample, so no correction"));
}

#[test]
fn two_samples() {
    let rows = format!("{XYZ}10,245,44,300\n40,190,160,300\n");
    toured(column(&rows, true, ""), "two samples");
}

#[test]
fn all_samples_equal() {
    let mut rows = XYZ.to_owned();
    for _ in 0..20 {
        rows.push_str("10,245,44,300\n");
    }
    let mut window = toured(column(&rows, false, ""), "all equal");
    press(&mut window, "2 Regions");
    assert!(says(&window, "all samples are at one angle"));
}

#[test]
fn no_sample_is_refused_and_what_was_there_stays() {
    let folder = tempfile::tempdir().expect("a folder");
    for (name, samples) in [("header only", XYZ), ("empty file", "")] {
        let path = written(folder.path(), column(samples, true, ""));
        let mut window = window::window(Some(path));
        assert!(
            says(&window, "could not be opened; nothing was changed"),
            "{name}"
        );
        for step in STEPS {
            press(&mut window, step);
            sound(&window, name);
            assert!(
                says(&window, "208 samples"),
                "{name}: what was there is there"
            );
        }
    }
}

#[test]
fn every_sample_without_a_measurement() {
    let mut rows = XYZ.to_owned();
    for k in 0..12 {
        let _ = writeln!(rows, "{},,,", 5 * k);
    }
    let folder = tempfile::tempdir().expect("a folder");
    let path = written(folder.path(), column(&rows, true, ""));
    let mut window = window::window(Some(path));
    if says(&window, "could not be opened") {
        // Refused with a reason, and nothing was changed.
        assert!(says(&window, "208 samples"));
        return;
    }
    tour(&mut window, folder.path(), "nothing measured");
    assert!(says(&window, "no sample can be used"));
}

#[test]
fn every_sample_that_the_reflector_lost() {
    let mut rows = XYZ.to_owned();
    for k in 0..12 {
        let _ = writeln!(rows, "{},0,0,0", 5 * k);
    }
    let folder = tempfile::tempdir().expect("a folder");
    let path = written(folder.path(), column(&rows, true, ""));
    let mut window = window::window(Some(path));
    if !says(&window, "could not be opened") {
        tour(&mut window, folder.path(), "all lost");
    }
}

#[test]
fn cells_that_are_missing_here_and_there() {
    let mut rows =
        "q1_deg,q1_read_deg,x_mm,y_mm,z_mm,load_kg,temperature_c,time_s,dir1\n".to_owned();
    for k in 0..40_i32 {
        let q = f64::from(k * 4 - 80);
        let (sin, cos) = (q - 1.0).to_radians().sin_cos();
        let cell = |missing: bool, value: f64| {
            if missing {
                String::new()
            } else {
                value.to_string()
            }
        };
        let _ = writeln!(
            rows,
            "{q},{},{},{},{},{},{},{},{}",
            cell(k % 3 == 0, q),
            cell(k % 5 == 0, 247.0 * cos),
            cell(k % 7 == 0, 247.0 * sin),
            cell(k % 11 == 0, 300.0),
            cell(k % 2 == 0, 3.0),
            cell(k % 4 == 1, 20.0 + q / 50.0),
            cell(k % 6 == 0, 10.0 * f64::from(k)),
            cell(k % 8 == 0, 1.0),
        );
    }
    toured(column(&rows, true, ""), "missing cells");
}

#[test]
fn columns_that_never_change() {
    let mut rows =
        "q1_deg,x_mm,y_mm,z_mm,load_kg,temperature_c,time_s,speed1_deg_s,dir1\n".to_owned();
    for k in 0..30_i32 {
        let q = f64::from(k * 6 - 87);
        let (sin, cos) = (q - 1.0).to_radians().sin_cos();
        let _ = writeln!(rows, "{q},{},{},300,0,20,0,0,1", 247.0 * cos, 247.0 * sin);
    }
    toured(
        column(&rows, true, r#","tolerance_mm":0.2"#),
        "constant columns",
    );
}

#[test]
fn a_perfect_robot() {
    let mut rows = XYZ.to_owned();
    for k in 0..30_i32 {
        let q = f64::from(k * 6 - 87);
        let (sin, cos) = q.to_radians().sin_cos();
        let _ = writeln!(rows, "{q},{},{},300", 250.0 * cos, 250.0 * sin);
    }
    toured(
        column(&rows, true, r#","tolerance_mm":0.2"#),
        "no deviation at all",
    );
}

#[test]
fn a_plane_without_z() {
    let mut rows = "q1_deg,x_mm,y_mm\n".to_owned();
    for k in 0..30_i32 {
        let q = f64::from(k * 6 - 87);
        let (sin, cos) = (q - 1.0).to_radians().sin_cos();
        let _ = writeln!(rows, "{q},{},{}", 247.0 * cos, 247.0 * sin);
    }
    toured(column(&rows, true, ""), "planar");
}

/// A session of a robot in a scenario.
fn simulated(joints: &str, poses: &str) -> truepose::sessions::Session {
    let text = format!(
        r#"{{"format":"truepose-scenario/1","robot":{{"name":"r","joints":[{joints}],
        "tool":{{"position_mm":[250,0,300],"quaternion_wxyz":[1,0,0,0]}}}},
        "poses":{poses},"noise":{{"sigma_mm":0.02}}}}"#
    );
    let scenario = parse_scenario(text.as_bytes())
        .expect("a scenario")
        .scenario;
    simulate(&scenario, 1, unwatched)
        .expect("it can be simulated")
        .0
}

fn toured_session(session: &truepose::sessions::Session, name: &str) -> Window {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("arm.json");
    let replacing = Replacing {
        force: false,
        inputs: &[],
    };
    save(session, &path, replacing).expect("it can be saved");
    let mut window = window::window(Some(path));
    tour(&mut window, folder.path(), name);
    window
}

#[test]
fn a_joint_that_slides() {
    let joint =
        r#"{"name":"lift","kind":"prismatic","axis":[0,0,1],"point_mm":[0,0,0],"limits":[0,800]}"#;
    let sweep = r#"{"sweep":{"joint":1,"from_mm":0,"to_mm":800,"step_mm":25,"both_ways":true}}"#;
    let window = toured_session(&simulated(joint, sweep), "sliding joint");
    assert!(!says(&window, "Regions"));
}

#[test]
fn an_arm_with_six_joints() {
    let joints: Vec<String> = [
        ([0, 0, 1], [0, 0, 0]),
        ([0, 1, 0], [0, 0, 300]),
        ([0, 1, 0], [0, 0, 600]),
        ([1, 0, 0], [0, 0, 600]),
        ([0, 1, 0], [200, 0, 600]),
        ([1, 0, 0], [200, 0, 600]),
    ]
    .iter()
    .enumerate()
    .map(|(k, (axis, point))| {
        format!(
            r#"{{"name":"a{}","kind":"revolute","axis":{axis:?},"point_mm":{point:?},"limits":[-120,120]}}"#,
            k + 1
        )
    })
    .collect();
    let session = simulated(&joints.join(","), r#"{"random":{"count":60}}"#);
    let window = toured_session(&session, "six joints");
    assert!(!says(&window, "Regions"));
}
