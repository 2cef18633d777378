//! What was wrong or rubbed in a trial by hand, a test for each sentence: how the steps, messages,
//! fields, lists and panels have to be.

use std::collections::BTreeMap;

use crate::window::{
    Window, bundled, export_to, keys, press, says, there, type_into, until, window, window_at,
    window_of,
};
use egui::{Key, Modifiers, Rect};
use egui_kittest::kittest::{NodeT, Queryable};
use truepose::effects::JointValues;
use truepose::export::Job;
use truepose::gui::Runner;
use truepose::pipeline::{Method, export, hand_out, identify, load};

const ARM: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/arms/six-60.json");

fn arm() -> Window {
    window(Some(ARM.into()))
}

#[test]
fn one_joint_has_five_steps_and_regions_are_marked_as_optional() {
    let mut window = window(None);
    for step in crate::window::STEPS {
        assert!(there(&window, step), "{step}");
    }
    press(&mut window, "2 Regions");
    press(&mut window, "Identify by region");
    assert!(says(&window, "RMS error in the plane of motion, by region"));
}

#[test]
fn another_robot_has_no_step_of_regions() {
    let mut window = arm();
    for step in ["1 Session", "2 Identify", "3 Diagnose", "4 Export"] {
        assert!(there(&window, step), "{step}");
    }
    assert!(!says(&window, "Regions"));
    press(&mut window, "Continue to identify");
    assert!(says(&window, "Effects to fit"));
    // The keys follow the numbers.
    keys(&mut window, Modifiers::COMMAND, Key::Num4);
    assert!(says(&window, "There is nothing to export yet"));
    press(&mut window, "View");
    assert!(there(&window, "Diagnose") && !there(&window, "Regions"));
}

#[test]
fn the_search_says_that_the_full_model_takes_the_place_of_the_regions() {
    let mut window = window(None);
    press(&mut window, "2 Regions");
    press(&mut window, "Identify by region");
    press(&mut window, "4 Diagnose");
    assert!(says(&window, "takes the place of what is identified now"));
    press(&mut window, "Run diagnosis");
    assert!(says(&window, "takes the place of what is identified now"));
    press(&mut window, "Undo identify");
    press(&mut window, "3 Identify");
    assert!(says(&window, "RMS error in the plane of motion, by region"));
}

/// Where everything with a name is.
fn places(window: &Window) -> BTreeMap<String, Rect> {
    let all = window.query_all_by(|node| node.label().is_some());
    all.filter_map(|node| Some((node.accesskit_node().label()?, node.rect())))
        .collect()
}

/// What has to be measured before the rest has its place is measured in passes that nobody sees.
#[test]
fn the_first_frame_after_a_change_has_the_new_layout() {
    let mut window = window(None);
    press(&mut window, "3 Identify");
    press(&mut window, "Identify");
    let presses = [
        "1 Session",
        "2 Regions",
        "5 Export",
        "4 Diagnose",
        "Run diagnosis",
        "3 Identify",
        "Samples",
        "Summary",
        "Hide results",
        "Show results",
    ];
    for label in presses {
        let node = window.query_by_label(label);
        node.unwrap_or_else(|| panic!("no {label}")).click();
        // The change is made at the end of the frame in which the pointer lets go; the next one shows it.
        window.step();
        window.step();
        let first = places(&window);
        window.run_steps(8);
        let settled = places(&window);
        for (name, rect) in &settled {
            let at = first.get(name);
            let moved = at.is_none_or(|at| {
                (at.min - rect.min).length() > 0.6 || (at.max - rect.max).length() > 0.6
            });
            assert!(!moved, "{label}: {name} was at {at:?}, is at {rect:?}");
        }
    }
}

#[test]
fn while_the_search_runs_the_results_say_so_and_stopped_it_keeps_what_it_found() {
    let mut window = window_of([1280.0, 800.0], None, Runner::Threads);
    until(&mut window, "4 Diagnose");
    press(&mut window, "4 Diagnose");
    window.get_by_label("Run diagnosis").click();
    until(&mut window, "Diagnosis is running");
    until(&mut window, "Found so far");
    window.get_by_label("Stop the search").click();
    until(&mut window, "Diagnosis stopped");
    // It is about this session and no other.
    press(&mut window, "1 Session");
    keys(&mut window, Modifiers::NONE, Key::F3);
    until(&mut window, "30 samples");
    press(&mut window, "4 Diagnose");
    assert!(!says(&window, "Diagnosis stopped"));
}

#[test]
fn export_names_found_effects_that_were_not_added_and_adds_them() {
    let mut window = window(None);
    press(&mut window, "4 Diagnose");
    press(&mut window, "Run diagnosis");
    press(&mut window, "5 Export");
    assert!(says(&window, "Found, but not in the model"));
    press(&mut window, "Add all 5 effects to the model");
    assert!(!says(&window, "Found, but not in the model"));
    press(&mut window, "4 Diagnose");
    assert!(there(&window, "use backlash"));
}

#[test]
fn success_opens_the_file_and_goes_away_an_error_stays_and_neither_moves_a_plot() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window(None);
    press(&mut window, "3 Identify");
    press(&mut window, "Identify");
    let plot = |window: &Window| window.get_by_label("workspace plot, 208 samples").rect();
    let before = plot(&window);
    let table = folder.path().join("column.csv");
    export_to(&mut window, &table);
    assert!(there(&window, "Saved column.csv"), "without its folder");
    assert!(there(&window, "Open: column.csv") && there(&window, "Show in folder: column.csv"));
    assert_eq!(plot(&window), before, "it takes no room from the plots");
    crate::window::seconds(&mut window, 13);
    assert!(!there(&window, "Saved column.csv"), "it goes away");
    // What went wrong stays until it is dismissed.
    export_to(&mut window, &table);
    assert!(says(&window, "was not written"));
    assert_eq!(plot(&window), before, "it takes no room from the plots");
    crate::window::seconds(&mut window, 30);
    assert!(says(&window, "was not written"));
}

/// The number in a field.
fn number(window: &Window, label: &str) -> Option<f64> {
    window.get_by_label(label).accesskit_node().numeric_value()
}

#[test]
fn text_that_is_no_number_is_refused_beside_its_field_and_the_value_kept() {
    let mut window = window(None);
    press(&mut window, "Simulate session…");
    for (text, because) in [
        ("abc", "'abc' is not a number; the value is kept"),
        ("8 furlongs", "'furlongs' is not a unit here"),
        ("8 deg", "'deg' is not a unit here"),
    ] {
        type_into(&mut window, "noise", text);
        assert!(says(&window, because), "{text}");
        assert_eq!(number(&window, "noise"), Some(0.03), "{text}");
    }
    // A unit that is known is converted, and the refusal goes.
    type_into(&mut window, "noise", "0.01 in");
    assert!(!says(&window, "is no unit here"));
    assert_eq!(number(&window, "noise"), Some(0.254));
    press(&mut window, "Simulate");
    assert!(says(&window, "0.254 mm"), "what is simulated has it");
}

#[test]
fn a_tolerance_of_none_is_left_without_a_word() {
    let mut window = window(Some(bundled("paper-30.json")));
    window.get_by_label("tolerance").click();
    window.run_steps(2);
    keys(&mut window, Modifiers::NONE, Key::Enter);
    assert!(!says(&window, "is no number"));
}

#[test]
fn lengths_and_angles_are_shown_in_arcsec_and_mrad_too() {
    let mut window = window(None);
    press(&mut window, "Edit");
    press(&mut window, "Preferences…");
    press(&mut window, "arcsec");
    assert!(says(&window, "540000 arcsec"), "150° as seconds of arc");
    press(&mut window, "mrad");
    assert!(says(&window, "2617.99 mrad"));
}

#[test]
fn the_file_menu_has_import_and_report() {
    let mut window = window(None);
    press(&mut window, "File");
    assert!(there(&window, "Import…") && there(&window, "Report…"));
}

#[test]
fn notes_name_files_without_their_folders_and_warnings_stand_first() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = crate::window::copy_of("paper-30", folder.path());
    let csv = path.with_extension("csv");
    let text = std::fs::read_to_string(&csv).expect("a table");
    // A column that nobody knows is a note, a target that the instrument lost a warning.
    let mut lines: Vec<String> = text.lines().map(|line| format!("{line},7")).collect();
    lines[0] = text.lines().next().expect("a heading").to_owned() + ",colour";
    std::fs::write(&csv, lines.join("\n")).expect("written");
    let mut window = window(Some(path));
    press(&mut window, "1 Session");
    assert!(says(&window, "paper-30.csv"));
    let folder = folder.path().to_string_lossy().into_owned();
    assert!(!says(&window, &folder), "no absolute path");
}

/// Excludes a sample with the keyboard, or takes it in again.
fn exclude(window: &mut Window, sample: usize) {
    press(window, &format!("row {sample}, number"));
    keys(window, Modifiers::NONE, Key::Delete);
}

#[test]
fn a_sample_is_excluded_by_hand_counted_listed_saved_and_taken_in_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = crate::window::copy_of("lamp-commissioning", folder.path());
    // Somebody has kicked the tripod: sample 3 is 80 mm off.
    let csv = path.with_extension("csv");
    let text = std::fs::read_to_string(&csv).expect("a table");
    let heading = text.lines().next().expect("a heading");
    let x = heading
        .split(',')
        .position(|name| name == "x_mm")
        .expect("x");
    let mut lines: Vec<String> = text.lines().map(str::to_owned).collect();
    let mut cells: Vec<String> = lines[3].split(',').map(str::to_owned).collect();
    let value: f64 = cells[x].parse().expect("a number");
    cells[x] = (value + 80.0).to_string();
    lines[3] = cells.join(",");
    std::fs::write(&csv, lines.join("\n") + "\n").expect("written");
    let mut window = window(Some(path.clone()));
    let before = crate::window::gaps(&window);
    press(&mut window, "Samples");
    exclude(&mut window, 3);
    exclude(&mut window, 5);
    let without = crate::window::gaps(&window);
    assert!(
        before.0 > 1.5 * without.0,
        "it counts no more: {before:?} {without:?}"
    );
    assert!(there(&window, "excluded"), "marked in the table");
    let listed = "2 samples excluded, in no figure: 3, 5";
    press(&mut window, "Summary");
    press(&mut window, "3 Identify");
    press(&mut window, "Identify");
    assert!(says(&window, listed), "listed in the results");
    press(&mut window, "1 Session");
    assert!(says(&window, "208, 2 excluded"), "counted");
    press(&mut window, "4 Diagnose");
    press(&mut window, "Run diagnosis");
    assert!(says(&window, listed), "listed in the diagnosis");
    keys(&mut window, Modifiers::COMMAND, Key::S);
    let report = folder.path().join("report.html");
    window.state_mut().type_path("report", &report);
    window.run_steps(4);
    press(&mut window, "Save");
    let text = std::fs::read_to_string(&report).expect("the report");
    assert!(text.contains(listed), "listed in the report");

    // Read again it is excluded still.
    drop(window);
    let mut window = crate::window::window(Some(path));
    assert!(says(&window, "208, 2 excluded"));
    assert_eq!(crate::window::gaps(&window), without);
    press(&mut window, "Samples");
    exclude(&mut window, 3);
    exclude(&mut window, 5);
    assert_eq!(crate::window::gaps(&window), before, "taken in again");
    press(&mut window, "Undo change samples");
    assert_ne!(crate::window::gaps(&window), before);
}

#[test]
fn a_row_and_a_point_have_a_menu_that_excludes() {
    let mut window = window(None);
    press(&mut window, "Samples");
    window.get_by_label("row 2, angle").click_secondary();
    window.run_steps(4);
    press(&mut window, "Exclude 1 sample");
    assert!(there(&window, "Undo change samples"));
    press(&mut window, "Edit");
    assert!(there(&window, "Include 1 sample again"));
}

#[test]
fn the_table_of_samples_is_sorted_by_a_column() {
    let mut window = window(None);
    press(&mut window, "Samples");
    let top = |window: &Window| {
        let cells = window.query_all_by_label_contains(", number");
        let first = cells.min_by(|a, b| a.rect().top().total_cmp(&b.rect().top()));
        first
            .and_then(|cell| cell.accesskit_node().label())
            .expect("a row")
    };
    assert_eq!(top(&window), "row 1, number");
    press(&mut window, "column before, mm");
    assert!(there(&window, "column before, mm, largest first"));
    let largest = top(&window);
    assert_ne!(largest, "row 1, number");
    // The keyboard does it too.
    window
        .get_by_label("column before, mm, largest first")
        .focus();
    window.run_steps(2);
    keys(&mut window, Modifiers::NONE, Key::Enter);
    assert!(there(&window, "column before, mm, smallest first"));
    assert_ne!(top(&window), largest);
}

/// The numbers stand at the right of their cells: a click on one of them is a click on the row.
#[test]
fn a_click_on_a_number_of_the_table_chooses_its_sample() {
    let mut window = window(None);
    press(&mut window, "Samples");
    let at = window.get_by_label("row 4, before").rect().right_center() - egui::vec2(8.0, 0.0);
    window.hover_at(at);
    window.run_steps(2);
    window.drag_at(at);
    window.step();
    window.drop_at(at);
    window.run_steps(4);
    keys(&mut window, Modifiers::NONE, Key::Delete);
    press(&mut window, "1 Session");
    assert!(says(&window, "208, 1 excluded"), "row 4 was chosen");
}

#[test]
fn panels_are_pulled_by_their_edges() {
    let mut window = window(None);
    let plot = |window: &Window| window.get_by_label("workspace plot, 208 samples").rect();
    let before = plot(&window);
    let middle = before.center().y;
    for (edge, by) in [(304.0, 60.0), (1280.0 - 344.0, -50.0)] {
        let at = egui::pos2(edge, middle);
        window.hover_at(at);
        window.step();
        window.drag_at(at);
        window.step();
        window.hover_at(at + egui::vec2(by, 0.0));
        window.step();
        window.drop_at(at + egui::vec2(by, 0.0));
        window.run_steps(4);
    }
    let pulled = plot(&window);
    assert!(
        (pulled.left() - before.left() - 60.0).abs() < 2.0,
        "{before} {pulled}"
    );
    assert!(
        (before.right() - pulled.right() - 50.0).abs() < 2.0,
        "{before} {pulled}"
    );
    // The chart by its upper edge, above its bar.
    let chart = |window: &Window| window.get_by_label("deviation chart, tangential").rect();
    let low = chart(&window);
    let bar = window.get_by_label("Choose chart").rect();
    let edge = egui::pos2(low.center().x, bar.top() - 12.0);
    window.hover_at(edge);
    window.step();
    window.drag_at(edge);
    window.step();
    window.hover_at(edge - egui::vec2(0.0, 40.0));
    window.step();
    window.drop_at(edge - egui::vec2(0.0, 40.0));
    window.run_steps(3);
    let high = chart(&window);
    assert!(high.height() > low.height() + 30.0, "{low} {high}");
}

#[test]
fn recovery_can_wait_and_be_discarded() {
    let folder = tempfile::tempdir().expect("a folder");
    let home = folder.path().join("home");
    for name in ["paper-30", "lamp-commissioning"] {
        let path = crate::window::copy_of(name, folder.path());
        let mut window = window_at(Some(path), Some(&home));
        keys(&mut window, Modifiers::NONE, Key::Escape);
        crate::window::type_tolerance(&mut window, "0.7");
        crate::window::seconds(&mut window, 4);
        // Killed.
        drop(window);
    }
    let mut window = window_at(None, Some(&home));
    press(&mut window, "Not now");
    assert!(!there(&window, "Restore"));
    drop(window);
    let mut window = window_at(None, Some(&home));
    assert!(there(&window, "Restore"), "it is offered again");
    assert!(
        there(&window, "lamp-commissioning.json"),
        "the newest first"
    );
    press(&mut window, "Discard");
    assert!(there(&window, "Restore"), "it is asked first");
    press(&mut window, "Discard for good");
    assert!(there(&window, "paper-30.json"), "then the one before it");
    press(&mut window, "Discard");
    press(&mut window, "Discard for good");
    assert!(!there(&window, "Restore"));
    drop(window);
    assert!(!there(&window_at(None, Some(&home)), "Restore"));
}

#[test]
fn a_joint_without_limits_gives_a_worked_line_with_sensible_digits() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = crate::window::copy_of("lamp-commissioning", folder.path());
    let text = std::fs::read_to_string(&path).expect("a session");
    let mut session: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let joint = &mut session["robot"]["joints"][0];
    joint.as_object_mut().expect("a joint").remove("limits");
    std::fs::write(&path, session.to_string()).expect("written");
    // Commands that are no round numbers.
    let csv = path.with_extension("csv");
    let table = std::fs::read_to_string(&csv).expect("a table");
    let mut lines: Vec<String> = table.lines().map(str::to_owned).collect();
    for line in &mut lines[1..] {
        let (q, rest) = line.split_once(',').expect("cells");
        let q: f64 = q.parse().expect("a number");
        *line = format!("{},{rest}", q + 1.0 / 3.0);
    }
    std::fs::write(&csv, lines.join("\n") + "\n").expect("written");
    let session = load(&path).expect("a session").session;
    let identified = identify(&session, &Method::default(), JointValues::Commanded);
    let (_, calibration) = identified.expect("identified");
    let verified = hand_out(&calibration, &session).expect("it does what was said");
    let export = export("csv", &Job::new(&verified, "table.csv")).expect("a table");
    let line = export
        .notes
        .iter()
        .find(|note| note.contains("robot reached"));
    let line = line.expect("the worked line");
    let line = line.to_string();
    let longest = line
        .split(|c: char| !c.is_ascii_digit())
        .map(str::len)
        .max();
    assert!(longest.is_some_and(|digits| digits <= 6), "{line}");
}

#[test]
fn the_primary_button_is_at_the_bottom_and_on_high_screens_near_its_controls() {
    for size in [[1024.0, 700.0], [1280.0, 800.0], [1600.0, 1000.0]] {
        let window = window_of(size, None, Runner::AtOnce);
        let button = window.get_by_label("Continue to regions").rect();
        let from_below = size[1] - button.bottom();
        assert!(from_below < 60.0, "{size:?}: {from_below}");
    }
}
