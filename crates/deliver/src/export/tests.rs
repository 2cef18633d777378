use std::process::Command;

use super::*;
use crate::compensation::VerifiedCalibration;
use crate::compensation::interpolation::UniformTable;
use crate::effects::{Inputs, JointValues};
use crate::fit::{identify_exact, identify_regional};
use crate::model::Model;
use crate::sessions::division::RegionChoice;
use crate::simulation::{Scenario, load_scenario, simulate, unwatched};

fn scenario(name: &str) -> Scenario {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/../../sessions/");
    load_scenario(format!("{folder}{name}.scenario.json"))
        .unwrap()
        .scenario
}

fn session(name: &str) -> Session {
    let scenario = scenario(name);
    simulate(&scenario, scenario.seed, unwatched).unwrap().0
}

fn calibration(session: &Session, effects: &[&str]) -> VerifiedCalibration {
    let effects: Vec<String> = effects.iter().map(|e| (*e).to_owned()).collect();
    let found = identify_exact(session, &effects, JointValues::default()).unwrap();
    let inputs = Inputs::new(session, JointValues::default());
    VerifiedCalibration::on(&found.calibration(session, &inputs), session).unwrap()
}

fn export(calibration: &VerifiedCalibration, id: &str, name: &str, step: f64) -> Export {
    let job = Job {
        step: Some(step),
        ..Job::new(calibration, name)
    };
    find(id).unwrap().exporter.export(&job).unwrap()
}

fn text(export: &Export, document: usize) -> String {
    String::from_utf8(export.documents[document].bytes.clone()).unwrap()
}

const LAMP: [&str; 5] = [
    "joint-zero-offset",
    "link-length",
    "encoder-eccentricity",
    "backlash",
    "base-offset",
];

#[test]
fn the_csv_of_the_papers_robot_holds_three_degrees_everywhere() {
    let session = session("paper-30");
    let calibration = calibration(&session, &["joint-zero-offset", "link-length"]);
    let export = export(&calibration, "csv", "pan.csv", 45.0);
    let table = text(&export, 0);
    let lines: Vec<&str> = table.lines().collect();
    assert_eq!(
        lines[0],
        "commanded_deg,correction_forward_deg,correction_reverse_deg"
    );
    assert_eq!(lines.len(), 6);
    for (line, commanded) in lines[1..].iter().zip([-90.0, -45.0, 0.0, 45.0, 90.0]) {
        let cells: Vec<f64> = line.split(',').map(|c| c.parse().unwrap()).collect();
        assert_eq!(cells[0], commanded);
        assert!(
            (cells[1] - 3.0).abs() < 1e-10 && (cells[2] - 3.0).abs() < 1e-10,
            "{line}"
        );
    }
    assert_eq!(export.documents[1].name, "pan.csv.meta.json");
    let meta: serde_json::Value = serde_json::from_slice(&export.documents[1].bytes).unwrap();
    assert_eq!(meta["format"], "truepose-table/1");
    assert_eq!(
        meta["samples_hash"],
        crate::sessions::hash_of_samples(&session)
    );
    let example = meta["example"]["says"].as_str().unwrap();
    assert!(example.contains("table says +3.000000"), "{example}");
    let says = meta["stays"]["says"][0].as_str().unwrap();
    assert!(says.contains("from 250.0000 mm to 245.0000 mm"), "{says}");
    assert!((meta["stays"]["rms_mm"].as_f64().unwrap() - 5.0).abs() < 1e-9);
}

#[test]
fn the_table_that_was_read_back_leaves_what_no_joint_can_remove() {
    let session = session("paper-run");
    let calibration = calibration(&session, &["joint-zero-offset", "link-length"]);
    for id in ["csv", "c-header"] {
        let export = export(&calibration, id, "t", 1.0);
        let left = gap_after_export(&calibration, &session, &export).unwrap();
        assert!((left.rms_mm - 5.0).abs() < 1e-8, "{id}: {left:?}");
    }
}

#[test]
fn a_finer_table_leaves_no_more_than_a_coarse_one_and_the_sides_differ_by_the_backlash() {
    let session = session("lamp-commissioning");
    let calibration = calibration(&session, &LAMP);
    let gap = |step| {
        let export = export(&calibration, "csv", "t.csv", step);
        gap_after_export(&calibration, &session, &export)
            .unwrap()
            .rms_mm
    };
    let (coarse, fine) = (gap(60.0), gap(1.0));
    assert!(fine < coarse, "{fine} {coarse}");
    let table = Job::new(&calibration, "t").table(1.0).unwrap();
    assert_eq!(table.commanded_outer.len(), 301);
    for (forward, reverse) in table.forward.iter().zip(&table.reverse) {
        let width = crate::units::deg_from_rad(forward - reverse);
        assert!((width - 0.05).abs() < 0.005, "{width}");
    }
}

#[test]
fn outside_the_measured_range_the_end_is_held_and_that_is_said() {
    let mut scenario = scenario("lamp-commissioning");
    if let crate::simulation::Poses::Sweep(sweep) = &mut scenario.poses {
        (sweep.from, sweep.to) = (-1.0, 1.0);
    }
    let session = simulate(&scenario, 3, unwatched).unwrap().0;
    let calibration = calibration(&session, &LAMP);
    let export = export(&calibration, "csv", "t.csv", 10.0);
    let said = crate::text::Text::listed(&export.notes, "\n").to_string();
    assert!(
        said.contains("outside, the correction at the end of that range is held"),
        "{said}"
    );
    let table = Job::new(&calibration, "t").table(10.0).unwrap();
    assert_eq!(table.forward[0], table.forward[1]);
    assert_ne!(table.forward[10], table.forward[15]);
}

#[test]
fn a_step_that_makes_no_sense_is_refused() {
    let session = session("paper-30");
    let calibration = calibration(&session, &["joint-zero-offset"]);
    let job = |step, joint| Job {
        joint,
        step: Some(step),
        ..Job::new(&calibration, "t")
    };
    for (job, says) in [
        (job(0.0, 0), "expected a positive number"),
        (job(f64::NAN, 0), "expected a positive number"),
        (job(1e-9, 0), "at most 1000000"),
        (job(1.0, 1), "joint 2: the robot has 1"),
    ] {
        let refused = find("csv")
            .unwrap()
            .exporter
            .export(&job)
            .unwrap_err()
            .to_string();
        assert!(refused.contains(says), "{refused}");
    }
    let odd = export(&calibration, "csv", "t.csv", 7.0);
    assert!(
        odd.notes
            .iter()
            .any(|n| n.contains("does not divide the travel")),
        "{:?}",
        odd.notes
    );
}

#[test]
fn a_regional_model_has_a_table_too() {
    let session = session("paper-30");
    let found =
        identify_regional(&session, &RegionChoice::FromSession, JointValues::default()).unwrap();
    let inputs = Inputs::new(&session, JointValues::default());
    let calibration = VerifiedCalibration::on(&found.calibration(&session, &inputs), &session);
    let calibration = calibration.unwrap();
    let export = export(&calibration, "csv", "t.csv", 6.0);
    let left = gap_after_export(&calibration, &session, &export).unwrap();
    // 5 mm of radius stay for any joint; beside it the ±2.9 mm that the paper's regions leave.
    assert!(
        left.rms_mm > 5.0 && left.rms_mm < 5.0_f64.hypot(2.9),
        "{left:?}"
    );
}

#[test]
fn an_empty_or_odd_joint_name_still_makes_a_c_identifier() {
    let session = session("paper-30");
    let mut calibration = calibration(&session, &["joint-zero-offset"]);
    for (name, expected) in [
        ("Achse 1/é */", "truepose_achse_1_____"),
        ("é", "truepose_joint_1"),
        ("", "truepose_joint_1"),
    ] {
        let mut robot = calibration.model.robot.clone();
        robot.joints[0].name = name.to_owned();
        let model = Model::new(robot, calibration.model.terms().to_vec());
        let renamed = Calibration {
            model,
            ..Calibration::clone(&calibration)
        };
        calibration = VerifiedCalibration::read(&truepose_model::write_model(&renamed)).unwrap();
        let header = text(&export(&calibration, "c-header", "t.h", 30.0), 0);
        assert!(
            header.contains(&format!("{expected}_forward_deg[7]")),
            "{header}"
        );
        let comment = header.split("#ifndef").next().unwrap();
        assert_eq!(comment.matches("*/").count(), 1, "{comment}");
    }
}

/// A C compiler, where there is one.
fn c_compiler() -> Option<&'static str> {
    ["gcc", "cc", "clang"].into_iter().find(|compiler| {
        let version = Command::new(compiler).arg("--version").output();
        version.is_ok_and(|output| output.status.success())
    })
}

#[test]
fn the_c_header_compiles_without_a_warning_and_gives_the_programs_own_values() {
    let Some(compiler) = c_compiler() else {
        eprintln!("skipped: no C compiler here");
        return;
    };
    let session = session("lamp-commissioning");
    let calibration = calibration(&session, &LAMP);
    let folder = tempfile::tempdir().unwrap();
    let header = export(&calibration, "c-header", "table.h", 2.5);
    std::fs::write(folder.path().join("table.h"), &header.documents[0].bytes).unwrap();
    let program = r#"#include <stdio.h>
#include "table.h"
int main(void)
{
    int i;
    for (i = -2000; i <= 2000; i++) {
        double q = (double)i * 0.0917;
        printf("%.17g %.17g %.17g\n", truepose_column_correction_deg(q, 1),
               truepose_column_correction_deg(q, -1), truepose_column_correction_deg(q, 0));
    }
    return 0;
}
"#;
    std::fs::write(folder.path().join("main.c"), program).unwrap();
    let built = Command::new(compiler)
        .args([
            "-std=c99",
            "-Wall",
            "-Wextra",
            "-Werror",
            "-pedantic",
            "main.c",
            "-o",
            "main",
        ])
        .current_dir(folder.path())
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&built.stderr);
    assert!(built.status.success() && said.is_empty(), "{said}");
    let ran = Command::new(folder.path().join("main")).output().unwrap();
    let printed = String::from_utf8(ran.stdout).unwrap();

    let table = Job::new(&calibration, "t").table(2.5).unwrap();
    let own = |values: &[f64]| {
        let outer: Vec<f64> = values.iter().map(|v| table.to_display(*v)).collect();
        UniformTable::new(table.commanded_outer[0], table.step_outer, &outer)
    };
    let (forward, reverse) = (own(&table.forward), own(&table.reverse));
    let mut lines = 0;
    for (line, i) in printed.lines().zip(-2000..) {
        let q = f64::from(i) * 0.0917;
        let c: Vec<f64> = line.split(' ').map(|v| v.parse().unwrap()).collect();
        assert_eq!(c[0], forward.at(q), "{q}");
        assert_eq!(c[1], reverse.at(q), "{q}");
        assert_eq!(c[2], 0.5 * (forward.at(q) + reverse.at(q)), "{q}");
        lines += 1;
    }
    assert_eq!(lines, 4001);
}

#[test]
fn every_file_with_a_format_is_registered() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/src/export");
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        // A folder holds more of the format whose name it has.
        let Ok(text) = std::fs::read_to_string(&path) else {
            continue;
        };
        let has_format = text.contains("\npub(super) const FORMAT: Format");
        let id = path
            .file_stem()
            .unwrap()
            .to_str()
            .unwrap()
            .replace('_', "-");
        assert_eq!(find(&id).is_some(), has_format, "{}", path.display());
    }
}
