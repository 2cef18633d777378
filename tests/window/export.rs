//! Every export format in the window, without a display: chosen, seen, saved; and what a format
//! cannot do is said there.

use crate::window::{Window, export_to, press, window_of};
use egui_kittest::kittest::Queryable;
use truepose::export::EXPORTERS;
use truepose::gui::Runner;

/// High enough to press everything without scrolling.
const TALL: [f32; 2] = [1280.0, 1000.0];

/// The bundled session, identified, at the Export step.
fn at_export(window: &mut Window) {
    press(window, "3 Identify");
    press(window, "Identify");
    press(window, "5 Export");
}

#[test]
fn one_of_each_format_is_chosen_seen_and_saved() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window_of(TALL, None, Runner::AtOnce);
    at_export(&mut window);
    let lamp = concat!(
        env!("CARGO_MANIFEST_DIR"),
        "/sessions/lamp-commissioning.json"
    );
    let robot = truepose::sessions::load(lamp)
        .expect("it is bundled")
        .session
        .robot;
    for format in EXPORTERS.iter().filter(|format| (format.suits)(&robot)) {
        press(&mut window, format.title.english());
        window.get_by_label_contains(&format!("as .{}…", format.extension));
        if format.rules.is_some() {
            window.get_by_label("correction table as a curve");
            window.get_by_label("Copy text");
            window.get_by_label("RMS error left by the table");
        } else {
            assert!(
                window
                    .query_by_label("correction table as a curve")
                    .is_none()
            );
            window.get_by_label("Copy text");
            window.get_by_label("RMS error with this robot");
        }
        let path = folder.path().join(format!("pan.{}", format.extension));
        export_to(&mut window, &path);
        let written = std::fs::read(&path).unwrap_or_default();
        assert!(!written.is_empty(), "{} was not saved", format.id);
        let beside = folder
            .path()
            .join(format!("pan.{}.meta.json", format.extension));
        let beside = std::fs::read_to_string(beside).expect("the sidecar is there");
        assert!(
            beside.contains(&format!("\"table_format\": \"{}\"", format.id)),
            "{beside}"
        );
    }
}

#[test]
fn a_format_for_one_direction_says_that_backlash_has_no_place_in_it() {
    let mut window = window_of(TALL, None, Runner::AtOnce);
    press(&mut window, "3 Identify");
    press(&mut window, "Backlash");
    press(&mut window, "Identify");
    press(&mut window, "5 Export");
    for title in ["SINUMERIK ENC_COMP archive", "TwinCAT NC structured text"] {
        press(&mut window, title);
        let says = window
            .get_all_by_label_contains("holds one for both")
            .count();
        assert_eq!(says, 1, "the refusal is shown, once");
        assert!(
            window
                .query_by_label("correction table as a curve")
                .is_none()
        );
    }
    // A format with two columns takes it.
    press(&mut window, "LinuxCNC COMP_FILE");
    window.get_by_label("correction table as a curve");
    assert_eq!(
        window
            .query_all_by_label_contains("holds one for both")
            .count(),
        0
    );
}

#[test]
fn what_to_enter_in_the_controller_names_the_file_that_was_saved() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window_of(TALL, None, Runner::AtOnce);
    at_export(&mut window);
    press(&mut window, "LinuxCNC COMP_FILE");
    press(&mut window, "What the numbers mean");
    window.run_steps(12);
    let enter = |window: &Window, name: &str| {
        let line = format!("COMP_FILE = {name},");
        window.query_all_by_label_contains(&line).count()
    };
    assert_eq!(enter(&window, "lamp-commissioning-joint-1.comp"), 1);
    export_to(&mut window, &folder.path().join("axis 1.comp"));
    window.run_steps(4);
    assert_eq!(enter(&window, "axis 1.comp"), 1);
    window.get_by_label("axis 1.comp");
}

#[test]
fn an_own_step_is_taken_or_refused_with_the_limit() {
    let mut window = window_of(TALL, None, Runner::AtOnce);
    at_export(&mut window);
    press(&mut window, "LinuxCNC COMP_FILE");
    press(&mut window, "Custom step");
    let says = window
        .get_all_by_label_contains("takes at most 256")
        .count();
    assert_eq!(says, 1, "a step of 1° over 300° is too fine");
    press(&mut window, "Custom step");
    window.get_by_label("correction table as a curve");
}

/// What an arm's controller takes is chosen as in the terminal: the levels of correction say what each would bring,
/// and the file is made with or without the zero offsets, from the URDF that the robot was read from.
#[test]
fn what_of_an_arms_model_goes_into_its_file_is_chosen() {
    let folder = tempfile::tempdir().expect("a folder");
    let arm = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/arms/six-60.json");
    let mut window = window_of(TALL, Some(arm.into()), Runner::AtOnce);
    press(&mut window, "2 Identify");
    press(&mut window, "Identify");
    window.get_by_label("Levels of correction");
    press(&mut window, "4 Export");
    press(&mut window, "URDF with corrected origins");
    let saved = |window: &mut Window, name: &str| {
        let path = folder.path().join(name);
        export_to(window, &path);
        std::fs::read_to_string(&path).expect("it is saved")
    };
    let origins = saved(&mut window, "origins.urdf");
    press(&mut window, "controller");
    assert_ne!(saved(&mut window, "controller.urdf"), origins);
    press(&mut window, "Undo choose table");
    assert_eq!(saved(&mut window, "again.urdf"), origins);
    press(&mut window, "Denavit–Hartenberg rows");
    let standard = saved(&mut window, "standard.csv");
    press(&mut window, "modified");
    assert_ne!(saved(&mut window, "modified.csv"), standard);
}
