//! The record of a machine: what its report states, and how it changed from session to session.

use std::path::Path;

use crate::window::{
    Window, choose, copy_of, keys, open, press, says, there, type_tolerance, window_at,
};
use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT, Queryable};

/// What stands in a field of a sheet.
fn field(window: &Window, label: &str) -> String {
    let node = window.get_by_role_and_label(Role::TextInput, label);
    node.accesskit_node().value().unwrap_or_default()
}

/// Types into a field whose name stands before it.
fn type_into(window: &mut Window, label: &str, text: &str) {
    window.get_by_role_and_label(Role::TextInput, label).focus();
    window.run_steps(2);
    keys(window, Modifiers::COMMAND, Key::A);
    window
        .get_by_role_and_label(Role::TextInput, label)
        .type_text(text);
    window.run_steps(2);
    keys(window, Modifiers::NONE, Key::Enter);
}

fn details(window: &mut Window) {
    choose(window, "File", "Report details…");
    window.run_steps(4);
}

#[test]
fn what_the_report_states_is_remembered_for_the_next_session_of_the_machine() {
    let folder = tempfile::tempdir().expect("a folder");
    let home = folder.path().join("home");
    let first = copy_of("lamp-commissioning", folder.path());
    let second = folder.path().join("after.json");
    let text = std::fs::read_to_string(&first).expect("the session");
    let text = text.replace("\"lamp commissioning\"", "\"after the repair\"");
    std::fs::write(&second, text).expect("written");
    let mut window = window_at(Some(first), Some(&home));
    type_tolerance(&mut window, "1");
    press(&mut window, "3 Identify");
    press(&mut window, "Identify");
    assert!(!says(&window, "expanded uncertainty"), "no rule is chosen");
    details(&mut window);
    for (label, text) in [
        ("Customer", "Lamps & Co"),
        ("Serial number of the machine", "L-17"),
        ("Report number", "R-1"),
        ("Operator", "A. Meier"),
    ] {
        type_into(&mut window, label, text);
        assert!(there(&window, "Done"), "Enter ends the field only");
    }
    press(&mut window, "ISO 14253-1");
    window.run_steps(4);
    assert!(
        says(&window, "Fail"),
        "a turn of the joint cannot mend its radius"
    );
    assert!(says(&window, "expanded uncertainty U"));
    press(&mut window, "simple acceptance");
    assert!(says(&window, "simple acceptance (JCGM 106, 8.2)"));
    press(&mut window, "Done");
    assert!(
        says(&window, "expanded uncertainty U"),
        "in the results too"
    );

    let html = folder.path().join("report.html");
    window.state_mut().type_report_path(&html);
    window.run_steps(4);
    press(&mut window, "Save");
    window.run_steps(4);
    let page = std::fs::read_to_string(&html).expect("the report is there");
    for part in ["Lamps &amp; Co", "L-17", "R-1", "decision rule: simple"] {
        assert!(page.contains(part), "{part}");
    }

    // Another session of the machine: its serial number comes back, the report's number does not.
    open(&mut window, &second);
    details(&mut window);
    let now = |window: &Window| {
        let labels = ["Serial number of the machine", "Report number", "Operator"];
        labels.map(|label| field(window, label))
    };
    assert_eq!(now(&window), ["L-17", "", "A. Meier"]);
    drop(window);

    // And in another window, tomorrow.
    let mut window = window_at(Some(second), Some(&home));
    details(&mut window);
    assert_eq!(now(&window), ["L-17", "", "A. Meier"]);
    assert!(!says(&window, "Last time it was"), "the session states one");
}

#[test]
fn a_logo_that_is_none_is_refused_and_no_report_is_written() {
    let folder = tempfile::tempdir().expect("a folder");
    let session = copy_of("paper-30", folder.path());
    let mut window = window_at(Some(session), None);
    details(&mut window);
    type_into(&mut window, "Logo", "/nowhere/logo.png");
    press(&mut window, "Done");
    let html = folder.path().join("report.html");
    window.state_mut().type_report_path(&html);
    window.run_steps(4);
    press(&mut window, "Save");
    window.run_steps(4);
    assert!(says(&window, "/nowhere/logo.png") && says(&window, "expected a PNG file"));
    assert!(!html.exists());
}

/// Sessions of one machine, by the offset of its joint in degrees.
fn sessions(folder: &Path, offsets_deg: &[f64]) {
    for (k, offset_deg) in offsets_deg.iter().enumerate() {
        let q: Vec<f64> = (0..40).map(|i| -117.0 + 6.0 * f64::from(i)).collect();
        let scatter = |i: usize, by: f64| 0.02 * (((i + 50 * k) as f64) * by).sin();
        let point = |of: fn(f64) -> f64, by: f64| -> Vec<f64> {
            let each = q.iter().enumerate();
            each.map(|(i, q)| 250.3 * of((q + offset_deg).to_radians()) + scatter(i, by))
                .collect()
        };
        let (x, y) = (point(f64::cos, 12.9898), point(f64::sin, 78.233));
        let z: Vec<f64> = (0..q.len()).map(|i| 300.0 + scatter(i, 37.719)).collect();
        let session = serde_json::json!({
            "format": "truepose-session/1", "name": format!("day {k}"),
            "robot": { "name": "lamp",
                "joints": [{ "name": "pan", "kind": "revolute", "axis": [0, 0, 1], "point_mm": [0, 0, 0] }],
                "tool": { "position_mm": [250, 0, 300], "quaternion_wxyz": [1, 0, 0, 0] } },
            "samples": { "columns": { "q1_deg": q, "x_mm": x, "y_mm": y, "z_mm": z } }
        });
        std::fs::write(folder.join(format!("day {k}.json")), session.to_string()).expect("written");
    }
}

#[test]
fn the_sessions_of_a_machine_are_compared_and_a_repair_stands_out() {
    let folder = tempfile::tempdir().expect("a folder");
    sessions(folder.path(), &[0.2, 0.2, 0.26, 0.26]);
    std::fs::write(
        folder.path().join("broken.json"),
        "{\"format\":\"truepose-session/1\",",
    )
    .expect("written");
    let mut window = window_at(Some(folder.path().join("day 3.json")), None);
    choose(&mut window, "File", "History of the machine…");
    window.run_steps(8);
    assert!(says(&window, "History of lamp"));
    assert!(says(&window, "broken.json is excluded"));
    assert_eq!(window.query_all_by_label("day 2").count(), 2, "two tables");
    assert_eq!(
        window.query_all_by_label_contains("± 0.0").count(),
        8,
        "two parameters of four sessions"
    );
    let changed = |window: &Window| window.query_all_by_label_contains("●").count();
    assert_eq!(
        changed(&window),
        2,
        "the offset of day 2, and what it means"
    );
    let offset = "Joint zero offset: offset";
    assert!(there(&window, &format!("{offset} over the sessions")));
    press(&mut window, "Link length: delta");
    assert!(there(&window, "Link length: delta over the sessions"));

    press(&mut window, "Before and after");
    window.run_steps(4);
    assert!(
        says(&window, "0 of 2 parameters changed"),
        "day 2 and day 3"
    );
    window
        .get_by_role_and_label(Role::ComboBox, "Before")
        .click();
    window.run_steps(4);
    press(&mut window, "day 0 (session)");
    window.run_steps(4);
    assert!(says(&window, "1 of 2 parameters changed"));
    assert!(says(&window, "● changed"));
    press(&mut window, "Done");
    assert!(!says(&window, "History of lamp"));
}

#[test]
fn a_folder_without_sessions_says_so() {
    let mut window = window_at(None, None);
    let folder = tempfile::tempdir().expect("a folder");
    window.state_mut().compare_sessions(folder.path());
    window.run_steps(4);
    assert!(says(&window, "There are no sessions to compare"));
    assert!(says(&window, "expected a folder with truepose-session/1"));
}
