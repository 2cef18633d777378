//! A table without a robot, opened in the window: looked at, asked about, imported, saved.
#![cfg(feature = "gui")]

#[path = "support/window.rs"]
#[allow(dead_code, reason = "every test file uses a part of it")]
mod support;

use std::fs;
use std::path::{Path, PathBuf};

use egui_kittest::kittest::Queryable;
use support::{gaps, open, press, says, window};

/// The bundled run as another program would have written it.
fn foreign(folder: &Path, heading: &str, separator: &str, comma: bool, factor: f64) -> PathBuf {
    let bundled = concat!(env!("CARGO_MANIFEST_DIR"), "/sessions/paper-run.csv");
    let text = fs::read_to_string(bundled).expect("a bundled session");
    let mut out = format!("{heading}\n");
    for line in text.lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        let mut row = vec![cells[0].to_owned()];
        for cell in &cells[1..3] {
            let mm: f64 = cell.parse().expect("a number");
            row.push(format!("{:.6}", mm * factor));
        }
        let row = row.join(separator);
        out.push_str(&if comma { row.replace('.', ",") } else { row });
        out.push('\n');
    }
    let path = folder.join("tracker.txt");
    fs::write(&path, out).expect("written");
    path
}

#[test]
fn a_table_with_semicolons_and_commas_becomes_a_session() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = foreign(folder.path(), "q1_deg;x_mm;y_mm", ";", true, 1.0);
    let mut window = window(None);
    open(&mut window, &path);
    assert!(says(&window, "Import tracker.txt"));
    assert!(says(&window, "361 rows · separated by semicolons"));
    assert!(
        says(&window, "Say whose robot was measured"),
        "nothing is guessed"
    );
    press(&mut window, "that of the example The paper's full run");
    press(&mut window, "Import");
    assert!(says(&window, "361 samples · gap"));
    assert!(says(&window, "not saved"));
    let (gap, _) = gaps(&window);
    assert!(gap > 5.0 && gap < 20.0, "{gap}: in mm");
}

#[test]
fn a_unit_that_nobody_says_is_asked_for() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = foreign(folder.path(), "q1_deg,x,y", ",", false, 0.001);
    let mut window = window(None);
    open(&mut window, &path);
    press(&mut window, "that of the example The paper's full run");
    assert!(says(&window, "Answer what is asked above first"));
    window.get_by_label("It is m").click();
    window.run_steps(4);
    assert!(!says(&window, "Answer what is asked above first"));
    press(&mut window, "Import");
    assert!(says(&window, "361 samples · gap"));
    let (gap, _) = gaps(&window);
    assert!(gap > 5.0 && gap < 20.0, "{gap}: metres were made mm");
}

#[test]
fn a_robot_that_cannot_be_read_is_said_on_the_sheet() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = foreign(folder.path(), "q1_deg,x_mm,y_mm", ",", false, 1.0);
    let mut window = window(None);
    open(&mut window, &path);
    press(&mut window, "the one in this file");
    assert!(says(&window, "Say which file the robot is in"));
    window.get_by_label("File of the robot").focus();
    window.run_steps(2);
    window
        .get_by_label("File of the robot")
        .type_text("no such robot.json");
    window.run_steps(4);
    press(&mut window, "Import");
    assert!(says(&window, "no such file"));
    assert!(
        says(&window, "Import tracker.txt"),
        "the sheet is there still"
    );
    press(&mut window, "Cancel");
    assert!(says(&window, "208 samples · gap"));
    let unnamed = window.unnamed_widgets();
    assert!(unnamed.is_empty(), "{unnamed:?}");
}
