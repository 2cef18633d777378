//! Finding the gap in the window, without a display: search, read, add, switch off and on, undo,
//! and save the measuring list.
use crate::gantry::{NOISE_MM, gantry, turns};
use crate::rig;

use std::path::{Path, PathBuf};

use crate::window::{Window, copied, press, says, status, window_of};
use egui_kittest::kittest::Queryable;
use truepose::gui::Runner;
use truepose::sessions::Replacing;
use truepose::simulation::parse_scenario;
use truepose::simulation::{simulate, unwatched};

/// A session with a hidden effect: what the simulator makes of this scenario.
fn session_with(effects: &str, speeds: &str, folder: &Path) -> PathBuf {
    session_of(effects, speeds, 1, folder)
}

/// The same with every pose so many times.
fn session_of(effects: &str, speeds: &str, repeats: usize, folder: &Path) -> PathBuf {
    let scenario = format!(
        r#"{{ "format": "truepose-scenario/1", "name": "hidden",
  "robot": {{ "name": "column",
    "joints": [ {{ "name": "column", "kind": "revolute", "axis": [0,0,1], "point_mm": [0,0,0], "limits": [-150, 150] }} ],
    "tool": {{ "position_mm": [250,0,300], "quaternion_wxyz": [1,0,0,0] }} }},
  "targets": {{ "T1": [0,0,0] }},
  "instrument": {{ "name": "tracker", "sigma_mm": 0.03 }},
  "poses": {{ "sweep": {{ "joint": 1, "from_deg": -150, "to_deg": 150, "step_deg": 6, "both_ways": true, "repeats": {repeats}, "order": "random" }} }},
  "conditions": {{ "speed_deg_s": [{speeds}], "seconds_per_pose": 6 }},
  "effects": [ {effects} ],
  "noise": {{ "sigma_mm": 0.03, "kind": "gauss" }}, "seed": 5 }}"#
    );
    let scenario = parse_scenario(scenario.as_bytes()).expect("a scenario");
    let scenario = scenario.scenario;
    let made = simulate(&scenario, scenario.seed, unwatched).expect("it can be simulated");
    let path = folder.join("hidden.json");
    let replacing = Replacing {
        force: false,
        inputs: &[],
    };
    truepose::sessions::save(&made.0, &path, replacing).expect("saved");
    path
}

/// The gap that the status bar names last, mm; what stands behind it is the noise floor.
fn gap_mm(window: &Window) -> f64 {
    let line = status(window);
    let gaps = line.split("· floor").next().unwrap_or_default();
    let numbers = gaps.split([' ', '→']);
    let mut numbers = numbers.filter_map(|word| word.parse::<f64>().ok());
    let last = numbers.next_back();
    last.expect("a number")
}

const BACKLASH: &str =
    r#"{ "effect": "backlash", "joint": 1, "parameters": { "width_deg": 0.1 } }"#;
/// Root mean square of three coordinates with 0.03 mm each.
const FLOOR_MM: f64 = 0.052;

#[test]
fn a_hidden_effect_is_found_added_switched_off_and_undone() {
    let folder = tempfile::tempdir().expect("a folder");
    let session = session_with(BACKLASH, "0", folder.path());
    let mut window = window_of([1280.0, 800.0], Some(session), Runner::AtOnce);
    press(&mut window, "4 Diagnose");
    press(&mut window, "Run diagnosis");
    assert!(says(
        &window,
        "Explained: the remaining error is at the noise floor"
    ));
    window.get_by_label("Backlash");
    press(&mut window, "More");
    window.run_steps(12);
    assert!(says(&window, "chance that noise alone looks like this"));
    assert!(says(&window, "likelier than the next candidate"));
    tables_can_be_copied(&mut window);
    let identified = gap_mm(&window);
    assert!(identified > 2.0 * FLOOR_MM, "{identified}");
    assert!(
        says(&window, "gap by step: nominal robot") && says(&window, "with backlash"),
        "the chart outlines what would be left with it"
    );

    assert!(
        !says(&window, "Continue to export"),
        "the effect that was found comes first"
    );
    press(&mut window, "Add the effect to the model");
    let explained = gap_mm(&window);
    assert!((explained / FLOOR_MM - 1.0).abs() < 0.15, "{explained}");
    assert!(says(&window, "with backlash"), "the waterfall has its bar");

    // Worth something: switched off the gap is back, on again it is gone.
    press(&mut window, "use backlash");
    assert!((gap_mm(&window) - identified).abs() < 1e-3);
    assert!(!says(&window, "with backlash"));
    press(&mut window, "use backlash");
    assert!((gap_mm(&window) - explained).abs() < 1e-3);

    // One step back for each.
    for (undo, expected) in [
        ("Undo choose effects", identified),
        ("Undo choose effects", explained),
        ("Undo choose effects", identified),
    ] {
        press(&mut window, undo);
        assert!((gap_mm(&window) - expected).abs() < 1e-3, "{undo}");
    }
    press(&mut window, "Redo choose effects");

    // The table follows: it knows both sides now.
    press(&mut window, "5 Export");
    window.get_by_label("correction table as a curve");
    assert!(says(&window, "dashed: approach −"));
}

/// What predicts without a name belongs to the model of several joints as well: the main button adds it.
#[test]
fn what_the_guide_of_a_gantry_does_is_added_switched_off_and_undone() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("gantry.json");
    std::fs::write(&path, gantry(1, 200, 0.0, turns)).expect("it can be written");
    let mut window = window_of([1280.0, 800.0], Some(path), Runner::AtOnce);
    press(&mut window, "3 Diagnose");
    press(&mut window, "Run diagnosis");
    assert!(says(&window, "straightness"));
    let floor_mm = 3.0_f64.sqrt() * NOISE_MM;
    let identified = gap_mm(&window);
    assert!(identified > 1.8 * floor_mm, "{identified}");
    assert!(!says(&window, "Continue to export"));
    press(&mut window, "Add the predictive part to the model");
    let predicted = gap_mm(&window);
    assert!(predicted < 1.05 * floor_mm, "{predicted}");
    assert!(says(&window, "Continue to export"));
    press(&mut window, "in the model");
    assert!((gap_mm(&window) - identified).abs() < 1e-3);
    press(&mut window, "Undo choose effects");
    assert!((gap_mm(&window) - predicted).abs() < 1e-3);
}

#[test]
fn noise_outliers_and_sizes_that_no_machine_has_are_shown() {
    let facts = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/facts/facts.json");
    let mut window = window_of([1280.0, 800.0], Some(facts), Runner::AtOnce);
    press(&mut window, "4 Diagnose");
    press(&mut window, "Run diagnosis");
    assert!(says(&window, "the measuring frame wanders by"));
    assert!(says(&window, "as stated for the instrument"));
    assert!(says(&window, "Excluded outliers: 3 of 160"));
    assert!(says(
        &window,
        "amplitude: implausibly large: more than ten times what is usual"
    ));
    assert!(!says(&window, "did not converge"));
    assert!(
        !says(&window, "not determined"),
        "an order of 3 has no interval"
    );
}

/// Every table of the search goes into a spreadsheet as it is.
fn tables_can_be_copied(window: &mut Window) {
    crate::window::into_sight(window, "Copy table of found effects");
    let found = copied(window, "Copy table of found effects");
    assert_eq!((found.len(), &*found[0][0]), (2, "effect"));
    assert_eq!((&*found[1][0], &*found[1][2]), ("Backlash", "width"));
    let width: f64 = found[1][3].parse().expect("a number");
    assert!((width - 0.1).abs() < 0.02, "{width}");
    window.run_steps(2);
    window.get_by_label("Copied: found effects");
}

#[test]
fn poses_that_decide_are_saved_as_a_measuring_list() {
    let folder = tempfile::tempdir().expect("a folder");
    let session = session_with(BACKLASH, "10", folder.path());
    let mut window = window_of([1280.0, 800.0], Some(session), Runner::AtOnce);
    press(&mut window, "4 Diagnose");
    press(&mut window, "Run diagnosis");
    // At one speed a lag looks like a backlash.
    window.get_by_label("Effects that the samples cannot tell apart");
    assert!(
        says(&window, "Tracking lag instead of backlash")
            || says(&window, "Backlash instead of tracking lag")
    );
    window.get_by_label("Poses that would decide");
    window.get_by_label("Save measuring list…");
    assert!(
        !says(&window, "next_poses"),
        "no names of files' keys on the screen"
    );
    let list = folder.path().join("next.csv");
    window.state_mut().type_path("poses", &list);
    window.run_steps(4);
    press(&mut window, "Save");
    let written = std::fs::read_to_string(&list).expect("the list is there");
    let mut lines = written.lines();
    let heading = lines.next().expect("a heading");
    assert!(heading.starts_with("q1_deg,"), "{heading}");
    let angles = lines.map(|line| line.split(',').next().map(str::parse::<f64>));
    let angles: Vec<f64> = angles
        .map(|a| a.expect("a cell").expect("an angle"))
        .collect();
    assert!(!angles.is_empty() && angles.iter().all(|a| a.abs() <= 150.0));
}

#[test]
fn noise_alone_is_said_to_be_noise() {
    let folder = tempfile::tempdir().expect("a folder");
    let session = session_with("", "0", folder.path());
    let mut window = window_of([1280.0, 800.0], Some(session), Runner::AtOnce);
    press(&mut window, "4 Diagnose");
    press(&mut window, "Run diagnosis");
    assert!(says(&window, "Nothing is missing"));
    assert!(says(&window, "Not found; detection limits (95 %)"));
    assert!(!says(&window, "Add to model"));
}

#[test]
fn a_search_can_be_stopped_and_says_that_it_was() {
    let folder = tempfile::tempdir().expect("a folder");
    // The search of few samples may be done before the first frame shows it.
    let session = session_of(BACKLASH, "0", 400, folder.path());
    let mut window = window_of([1280.0, 800.0], Some(session), Runner::Threads);
    // No clock: as many frames as it takes.
    let until = |window: &mut Window, label: &str| {
        for _ in 0..50_000 {
            window.step();
            if window.query_by_label(label).is_some() {
                return;
            }
            std::thread::yield_now();
        }
        panic!("{label} never came");
    };
    until(&mut window, "hidden");
    press(&mut window, "4 Diagnose");
    window.get_by_label("Run diagnosis").click();
    until(&mut window, "Stop the search");
    // It is meant once it has been in sight for half a second.
    window.run_steps(2);
    window.get_by_label("Stop the search").click();
    // With what is proven until then, or before anything was.
    for _ in 0..50_000 {
        window.step();
        if says(&window, "Diagnosis stopped") {
            break;
        }
        std::thread::yield_now();
    }
    assert!(says(&window, "Diagnosis stopped"));
    assert!(!says(
        &window,
        "Explained: the remaining error is at the noise floor"
    ));
}

#[test]
fn what_no_name_explains_is_corrected_without_a_name_and_taken_back() {
    let folder = tempfile::tempdir().expect("a folder");
    let design = rig::Design {
        samples: 240,
        ..rig::Design::default()
    };
    let mut random = rig::Random(11);
    let mut hidden = rig::Rig::new(&design, &mut random);
    let bump = rig::Hidden::Bump(1.5e-3, 0.6, 0.25);
    hidden.hidden = vec![bump, rig::Hidden::Backlash(1.2e-3)];
    hidden.measure(&mut random);
    let session = folder.path().join("bump.json");
    std::fs::write(&session, hidden.json("bump")).expect("written");
    let mut window = window_of([1280.0, 800.0], Some(session), Runner::AtOnce);
    press(&mut window, "4 Diagnose");
    press(&mut window, "Run diagnosis");
    assert!(says(
        &window,
        "Partly explained: an error is left that no effect of the catalogue explains"
    ));
    let identified = gap_mm(&window);
    assert!(says(&window, "Repeats, and has no name"));
    // It stands below the fold of the list.
    window.get_by_label("Add smooth correction").scroll_to_me();
    window.run_steps(4);
    press(&mut window, "Add smooth correction");

    // The name that was found comes along, and what is left is noise.
    let corrected = gap_mm(&window);
    assert!((corrected / FLOOR_MM - 1.0).abs() < 0.1, "{corrected}");
    assert!(says(&window, "with backlash"), "the waterfall has its bar");
    assert!(says(&window, "with unexplained"), "and the correction too");
    assert!(!says(&window, "Add smooth correction"));

    press(&mut window, "smooth correction in the model");
    let named = gap_mm(&window);
    assert!(named > 1.3 * corrected && named < identified, "{named}");
    assert!(!says(&window, "with unexplained"));
    press(&mut window, "Undo choose effects");
    assert!((gap_mm(&window) - corrected).abs() < 1e-3);
    press(&mut window, "Undo choose effects");
    assert!((gap_mm(&window) - identified).abs() < 1e-3);
    press(&mut window, "Redo choose effects");

    // The table carries it, and says which part of it has no name.
    press(&mut window, "5 Export");
    window.get_by_label("correction table as a curve");
    press(&mut window, "What the numbers mean");
    window.run_steps(12);
    assert!(says(&window, "unexplained smooth correction"));
}
