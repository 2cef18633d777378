//! The step that identifies, as a person works in it: by region or exactly, with more effects or
//! fewer, and what the numbers say then.

use crate::window::{Window, gaps, keys, press, says, window};
use egui::{Key, Modifiers};
use std::fs;
use std::path::{Path, PathBuf};

/// The bundled session, identified exactly.
fn identified() -> Window {
    let mut window = window(None);
    press(&mut window, "3 Identify");
    press(&mut window, "Identify");
    window
}

fn after(window: &Window) -> f64 {
    gaps(window).1.expect("it is identified")
}

#[test]
fn the_methods_are_switched_and_each_leaves_its_own_gap() {
    let mut window = identified();
    let exact = after(&window);
    press(&mut window, "By region");
    let regional = after(&window);
    assert!(says(&window, "The source paper's method"));
    assert!(
        regional > 1.2 * exact,
        "{regional} by region, {exact} exactly"
    );
    press(&mut window, "Full model");
    assert!((after(&window) - exact).abs() < 1e-9);
}

#[test]
fn an_effect_more_makes_the_gap_smaller_and_one_step_back_takes_it_out() {
    let mut window = identified();
    let before = after(&window);
    press(&mut window, "Backlash");
    let with_backlash = after(&window);
    assert!(with_backlash < before, "{with_backlash} after {before}");
    keys(&mut window, Modifiers::COMMAND, Key::Z);
    assert!((after(&window) - before).abs() < 1e-9);
}

#[test]
fn what_the_session_cannot_show_is_said_with_the_reason() {
    let mut window = identified();
    press(&mut window, "1 not testable, and why");
    assert!(says(&window, "gravity is along the axis"));
}

/// The lamp's session with commands of a controller whose zero is half a turn off.
fn half_a_turn_off(folder: &Path) -> PathBuf {
    let bundled = Path::new(env!("CARGO_MANIFEST_DIR")).join("sessions");
    let samples =
        fs::read_to_string(bundled.join("lamp-commissioning.csv")).expect("it is bundled");
    let mut rows = samples.lines();
    let mut turned = format!("{}\n", rows.next().expect("headings"));
    for row in rows {
        let (command, rest) = row.split_once(',').expect("several columns");
        let command: f64 = command.parse().expect("a number");
        turned.push_str(&format!("{},{rest}\n", command + 180.0));
    }
    fs::write(folder.join("turned.csv"), turned).expect("a folder to write in");
    let session = fs::read(bundled.join("lamp-commissioning.json")).expect("it is bundled");
    let mut session: serde_json::Value = serde_json::from_slice(&session).expect("a document");
    session["samples"] = serde_json::json!({ "file": "turned.csv" });
    session["robot"]["joints"][0]["limits"] = serde_json::json!([0, 360]);
    let path = folder.join("turned.json");
    fs::write(&path, session.to_string()).expect("a folder to write in");
    path
}

#[test]
fn a_set_up_error_is_out_of_the_model_before_any_diagnosis() {
    let left = after(&identified());
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window(Some(half_a_turn_off(folder.path())));
    press(&mut window, "3 Identify");
    press(&mut window, "Identify");
    // What is fitted, what each sample keeps of it, and what the card says are one answer.
    let corrected = after(&window);
    assert!(
        (corrected - left).abs() < 0.01 * left,
        "{corrected} after {left}"
    );
    assert!(says(&window, "Data: "), "the mistake is said");
}
