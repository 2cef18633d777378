//! The whole job in the window, without a display: what a person would see, press, type and drag.

use crate::window::{
    STEPS, Window, bundled, export_to, gaps, press, status, there, window, window_of,
};
use egui::accesskit::Role;
use egui::{Key, Modifiers, Vec2};
use egui_kittest::kittest::{NodeT, Queryable};
use truepose::gui::Runner;

#[test]
fn it_opens_on_the_bundled_commissioning_session() {
    let window = window(None);
    assert!(status(&window).starts_with("208 samples"));
    assert_eq!(gaps(&window).1, None);
    window.get_by_label("lamp commissioning");
    window.get_by_label("workspace plot, 208 samples");
    window.get_by_label("deviation chart, tangential");
}

#[test]
fn the_whole_job_from_a_file_to_a_table_and_back() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window(None);

    // Open, by typing the path.
    let session = concat!(env!("CARGO_MANIFEST_DIR"), "/sessions/paper-30.json");
    window.get_by_label("Path of a session or model").focus();
    window
        .get_by_label("Path of a session or model")
        .type_text(session);
    window.run_steps(2);
    press(&mut window, "Open");
    assert!(
        status(&window).starts_with("30 samples"),
        "{}",
        status(&window)
    );
    let (nominal, none) = gaps(&window);
    assert!((nominal - 13.8).abs() < 0.5 && none.is_none());

    // Divide evenly, and drag a boundary on the plot: the identification follows.
    press(&mut window, "2 Regions");
    press(&mut window, "Uniform");
    let handle = window.get_by_label("boundary at 30°").rect().center();
    window.drag_at(handle);
    window.step();
    for k in 1_u8..=6 {
        window.hover_at(handle + Vec2::new(0.0, 4.0) * f32::from(k));
        window.step();
    }
    let (_, while_dragging) = gaps(&window);
    assert!(while_dragging.is_some(), "the answer follows the hand");
    window.drop_at(handle + Vec2::new(0.0, 24.0));
    window.run_steps(4);
    assert!(window.query_by_label("boundary at 30°").is_none());

    // One gesture, one step back and forth.
    window.get_by_label("Undo change regions").click();
    window.run_steps(4);
    window.get_by_label("boundary at 30°");
    window.key_press_modifiers(Modifiers::COMMAND.plus(Modifiers::SHIFT), Key::Z);
    window.run_steps(4);
    assert!(window.query_by_label("boundary at 30°").is_none());
    window.key_press_modifiers(Modifiers::COMMAND, Key::Z);
    window.run_steps(4);
    window.get_by_label("boundary at 30°");

    // The exact fit explains every sample.
    press(&mut window, "3 Identify");
    press(&mut window, "Full model");
    press_if_there(&mut window, "Identify");
    let (_, left) = gaps(&window);
    assert!(left.expect("identified") < 1e-9);
    window.get_by_label("Identified parameters");

    // Export: seen first, then written, with what it means beside it.
    press(&mut window, "5 Export");
    window.get_by_label("correction table as a curve");
    window.get_by_label_contains("corrections: add them to the command");
    let table = folder.path().join("table.csv");
    export_to(&mut window, &table);
    let written = std::fs::read_to_string(&table).expect("the table is there");
    let line = written.lines().nth(1).expect("a line of the table");
    let correction: f64 = line
        .split(',')
        .nth(1)
        .and_then(|cell| cell.parse().ok())
        .expect("a number");
    assert!((correction - 3.0).abs() < 1e-9, "{line}");
    assert!(folder.path().join("table.csv.meta.json").exists());
}

fn press_if_there(window: &mut Window, label: &str) {
    if window.query_by_label(label).is_some() {
        press(window, label);
    }
}

#[test]
fn a_boundary_moves_with_the_keys_and_stands_in_a_field() {
    let mut window = window(None);
    press(&mut window, "2 Regions");
    let handle = window.get_by_role_and_label(Role::Slider, "boundary at 50°");
    handle.focus();
    window.run_steps(2);
    window.key_press(Key::ArrowUp);
    window.run_steps(3);
    window.get_by_label("boundary at 50.5°");
    window.key_press_modifiers(Modifiers::SHIFT, Key::ArrowDown);
    window.run_steps(3);
    window.get_by_label("boundary at 45.5°");
    let field = window.get_by_label("region 4: to");
    field.focus();
    window.run_steps(2);
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.get_by_label("region 4: to").type_text("62");
    window.run_steps(2);
    window.key_press(Key::Enter);
    window.run_steps(3);
    window.get_by_label("boundary at 62°");
}

#[test]
fn a_wrong_file_is_explained_and_nothing_is_lost() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("wrong.json");
    std::fs::write(&path, "{\n  \"format\": \"truepose-session/9\"\n}").expect("written");
    let mut window = window(None);
    press(&mut window, "3 Identify");
    press(&mut window, "Identify");
    let before = status(&window);
    press(&mut window, "1 Session");
    window.get_by_label("Path of a session or model").focus();
    let typed = path.to_str().expect("a path in UTF-8");
    window
        .get_by_label("Path of a session or model")
        .type_text(typed);
    window.run_steps(2);
    press(&mut window, "Open");
    window.get_by_label_contains("could not be opened; nothing was changed");
    window.get_by_label_contains("line 2");
    assert_eq!(status(&window), before);
    press(&mut window, "Dismiss");
    assert!(
        window
            .query_by_label_contains("could not be opened")
            .is_none()
    );
}

#[test]
fn a_session_made_by_simulation_gives_back_what_went_in() {
    let mut window = window(None);
    press(&mut window, "Simulate session…");
    press(&mut window, "Simulate");
    assert!(
        status(&window).starts_with("360 samples"),
        "{}",
        status(&window)
    );
    press(&mut window, "3 Identify");
    press(&mut window, "Identify");
    let (before, after) = gaps(&window);
    assert!(
        after.expect("identified") < 0.5 * before,
        "{before} {after:?}"
    );
}

#[test]
fn every_control_has_a_name() {
    let mut window = window(None);
    for step in STEPS {
        press(&mut window, step);
        let unnamed = window.unnamed_widgets();
        assert!(unnamed.is_empty(), "{step}: {unnamed:?}");
    }
}

#[test]
fn a_path_that_is_given_at_the_start_is_opened() {
    let window = window(Some(bundled("paper-run.json")));
    assert!(status(&window).starts_with("361 samples"));
}

#[test]
fn on_threads_the_window_goes_on_and_the_answer_arrives() {
    let mut window = window_of([1280.0, 800.0], None, Runner::Threads);
    press(&mut window, "3 Identify");
    window.get_by_label("Identify").click();
    // No clock: as many frames as it takes, each yielding to the task.
    for _ in 0..200_000 {
        window.step();
        if gaps(&window).1.is_some() {
            return;
        }
        std::thread::yield_now();
    }
    panic!("no answer arrived");
}

#[test]
fn every_menu_and_every_sheet_opens_and_closes() {
    let mut window = window(None);
    for menu in ["File", "Edit", "View"] {
        press(&mut window, menu);
        window.key_press(Key::Escape);
        window.run_steps(4);
    }
    let says = "Everything in this window can be done in the terminal too";
    press(&mut window, "Help");
    press(&mut window, "About truepose");
    assert!(window.query_by_label_contains(says).is_some());
    window.key_press(Key::Escape);
    window.run_steps(4);
    assert!(window.query_by_label_contains(says).is_none());
}

#[test]
fn the_pointer_on_a_sample_names_it_and_the_table_shows_it() {
    let mut window = window(None);
    press(&mut window, "Samples");
    let plot = window.get_by_label("workspace plot, 208 samples").rect();
    // Somewhere on the way of the outer reflector there is a sample.
    let named = (0_u8..60).any(|k| {
        let x = plot.center().x + f32::from(k) * plot.width() / 120.0;
        window.hover_at(egui::pos2(x, plot.center().y));
        window.run_steps(3);
        window.query_by_label_contains("card of sample").is_some()
    });
    assert!(named, "no sample was named on the whole radius");
    // Its row is in sight, wherever it is in the table.
    let said = window
        .query_all_by_label_contains("card of sample ")
        .find_map(|node| node.accesskit_node().label());
    let said = said.expect("a card has a label");
    let number = said.trim_start_matches("card of sample ");
    let (number, _) = number
        .split_once(':')
        .expect("a card begins with its sample");
    let number: usize = number.parse().expect("a number");
    let first = "row 1, number";
    let row = format!("row {number}, number");
    assert!(there(&window, &row) && !there(&window, first), "{row}");
    // In the table itself nothing moves under the pointer.
    let table = window.get_by_label("column sample").rect();
    for k in 1_u8..6 {
        window.hover_at(table.center() + Vec2::new(60.0, 60.0 * f32::from(k)));
        window.run_steps(3);
        assert!(there(&window, &row) && !there(&window, first), "{row}");
    }
}

#[test]
fn with_one_menu_open_the_pointer_opens_the_others() {
    let mut window = window(None);
    let shown = |window: &Window| {
        let items = [
            "Quit",
            "Preferences…",
            "Workspace from above",
            "About truepose",
        ];
        items.map(|item| there(window, item))
    };
    press(&mut window, "File");
    assert_eq!(shown(&window), [true, false, false, false]);
    let menus = ["File", "Edit", "View", "Help"];
    let only = |menu: &str| menus.map(|other| other == menu);
    for menu in ["Edit", "View", "Help", "File", "View"] {
        window.get_by_label(menu).hover();
        window.run_steps(2);
        assert_eq!(shown(&window), only(menu), "the pointer on {menu}");
    }
    // And a click on what is open closes it.
    window.run_steps(12);
    window.get_by_label("View").click();
    window.run_steps(4);
    assert_eq!(shown(&window), [false; 4]);
}
