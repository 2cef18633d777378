//! The walk through a calibration (`docs/walk-through.md`) in the window, as a person does it: from
//! the tracker's raw file over the import sheet, the regions, the identification and the search to
//! the controller's table and the report.

use std::path::{Path, PathBuf};

use crate::window::{Window, gaps, keys, open, press, says, there, type_into, window};
use egui_kittest::kittest::Queryable;
use truepose::model::load_model;
use truepose::sessions::load;

fn raw(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("sessions/walk-through")
        .join(name)
}

fn type_path(window: &mut Window, label: &str, path: &Path) {
    type_into(window, label, path.to_str().expect("a path in UTF-8"));
}

/// The dialog of the system cannot be driven; the path is typed.
fn save(window: &mut Window) {
    window.run_steps(4);
    press(window, "Save");
    window.run_steps(4);
}

/// Saves the session under a name: Ctrl+Shift+P, and the path.
fn save_session(window: &mut Window, path: &Path) {
    let shifted = egui::Modifiers::COMMAND | egui::Modifiers::SHIFT;
    keys(window, shifted, egui::Key::P);
    window.get_by_label("Path to save to").focus();
    window.run_steps(2);
    window.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
    let typed = path.to_str().expect("a path in UTF-8");
    window.get_by_label("Path to save to").type_text(typed);
    window.run_steps(2);
    press(window, "Save");
}

/// Fills the sheet in and imports.
fn import(window: &mut Window) {
    open(window, &raw("tracker.txt"));
    assert!(says(window, "the unit of x, y, z is not stated"));
    type_into(window, "Name of the session", "inspection column");
    press(window, "It is mm");
    press(window, "The columns are right");
    press(window, "from this file");
    type_path(window, "File of the robot", &raw("robot.json"));
    type_path(window, "File of the commands", &raw("commands.csv"));
    press(window, "by name");
    type_path(window, "File of the known points", &raw("base-points.csv"));
    type_path(window, "File of the reflectors", &raw("reflectors.csv"));
    assert!(says(window, "10 points, RMS distance 0.00587 mm"));
    press(window, "Import");
    assert!(says(window, "168 samples · RMS error"));
}

/// Noise of 0.03 mm in each of three coordinates.
const FLOOR_MM: f64 = 0.052;

#[test]
fn from_the_trackers_file_to_the_signed_report() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window(None);

    // 1 Session: the file becomes one, and is saved.
    import(&mut window);
    let (nominal, none) = gaps(&window);
    assert!((nominal - 2.578).abs() < 0.01, "{nominal}");
    assert_eq!(none, None, "nothing is identified yet");
    let session = folder.path().join("column.json");
    save_session(&mut window, &session);
    let kept = load(&session).expect("what was saved can be read").session;
    assert_eq!(kept.name, "inspection column");
    assert_eq!(kept.samples.len(), 168);
    assert!(
        kept.note
            .contains("brought into the base frame by 10 reference points")
    );

    // 2 Regions: six of them show that constants do not fit.
    press(&mut window, "2 Regions");
    press(&mut window, "Identify by region");
    press(&mut window, "2 Regions");
    assert!(says(&window, "region 6: to"), "each has its boundaries");

    let (_, regional) = gaps(&window);
    let regional = regional.expect("the regions are identified at once");
    assert!((regional - 0.829).abs() < 0.002, "{regional}");

    // 3 Identify: the zero and the length.
    press(&mut window, "3 Identify");
    press(&mut window, "Full model");
    let (_, identified) = gaps(&window);
    let identified = identified.expect("identified");
    assert!((identified - 0.2376).abs() < 0.002, "{identified}");

    // 4 Diagnose: what is hidden is named, and nothing else.
    press(&mut window, "4 Diagnose");
    press(&mut window, "Run diagnosis");
    assert!(says(
        &window,
        "Explained: the remaining error is at the noise floor"
    ));
    let hidden = ["Encoder eccentricity", "Backlash", "Link droop"];
    for name in hidden {
        assert!(there(&window, name), "{name} is found");
    }
    for other in ["Base offset", "Axis tilt", "Bearing runout", "Tracking lag"] {
        let cards = window.query_all_by_label(other).count();
        assert_eq!(cards, 0, "{other} is not in this machine");
    }
    let mut before = identified;
    for name in hidden {
        let button = window.get_all_by_label("Add to model").next();
        button.expect("a card with a button").scroll_to_me();
        window.run_steps(6);
        let button = window.get_all_by_label("Add to model").next();
        button.expect("a card with a button").click();
        window.run_steps(6);
        let (_, now) = gaps(&window);
        let now = now.expect("identified");
        assert!(now < before, "{name}: {before} → {now}");
        before = now;
    }
    assert!(
        (before / FLOOR_MM - 1.0).abs() < 0.05,
        "{before}: the floor"
    );

    // 5 Export: a table, the model, the report.
    press(&mut window, "5 Export");
    press(&mut window, "LinuxCNC COMP_FILE");
    let table = folder.path().join("column.comp");
    window.state_mut().type_path("table", &table);
    save(&mut window);
    let text = std::fs::read_to_string(&table).expect("the table is there");
    let rows: Vec<Vec<f64>> = text
        .lines()
        .map(|line| {
            let cells = line.split_whitespace();
            cells.map(|cell| cell.parse().expect("a number")).collect()
        })
        .collect();
    assert!(rows.len() > 10 && rows.iter().all(|row| row.len() == 3));
    // A backlash of 0.04° lies between the two directions of every row.
    for row in &rows {
        let between = row[1] - row[2];
        assert!((between - 0.04).abs() < 0.003, "{row:?}");
    }
    assert!(folder.path().join("column.comp.meta.json").exists());

    let report = folder.path().join("column.pdf");
    window.state_mut().type_path("report", &report);
    save(&mut window);
    assert!(says(&window, "Saved "));
    let bytes = std::fs::read(&report).expect("the report is there");
    assert!(bytes.starts_with(b"%PDF-") && bytes.len() > 10_000);

    let model = folder.path().join("column.model.json");
    window.state_mut().type_path("model", &model);
    save(&mut window);
    let model = load_model(&model).expect("the model can be read");
    let names: Vec<&str> = model
        .model
        .terms()
        .iter()
        .map(|term| term.effect.about().id)
        .collect();
    for id in ["encoder-eccentricity", "backlash", "link-droop"] {
        assert!(names.contains(&id), "{id} among {names:?}");
    }
}
