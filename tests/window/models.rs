//! A model in the window, without a display: by itself, and beside a session of its robot.

use std::path::{Path, PathBuf};

use crate::window::{STEPS, bundled, open, press, says, window};
use egui_kittest::kittest::Queryable;
use truepose::effects::JointValues;
use truepose::pipeline::{Method, hand_out, identify};
use truepose::sessions::load;

/// A model of this session, in a file.
fn model_of(session: &str, folder: &Path) -> PathBuf {
    let loaded = load(bundled(session)).expect("a bundled session");
    let identified = identify(&loaded.session, &Method::default(), JointValues::default());
    let (_, calibration) = identified.expect("it can be identified");
    let path = folder.join("kept.model.json");
    let verified = hand_out(&calibration, &loaded.session).expect("it does what was said");
    std::fs::write(&path, verified.document()).expect("the model is written");
    path
}

#[test]
fn a_model_opens_by_itself_and_gives_its_table() {
    let folder = tempfile::tempdir().expect("a folder");
    let model = model_of("paper-run.json", folder.path());
    let mut window = window(Some(model));
    assert!(says(
        &window,
        "Open a session that was measured on this robot"
    ));
    window.get_by_label("Model from a file");
    window.get_by_label("Identified parameters");
    window.get_by_label("workspace plot, 0 samples");
    press(&mut window, "5 Export");
    window.get_by_label("correction table as a curve");
    assert!(says(&window, "add them to the command"));
    assert!(says(&window, "ot correctable by joint commands"));

    let table = folder.path().join("table.csv");
    window.state_mut().type_path("table", &table);
    window.run_steps(4);
    press(&mut window, "Save");
    let written = std::fs::read_to_string(&table).expect("the table is there");
    let line = written.lines().nth(1).expect("a line");
    assert!(
        line.split(',')
            .nth(1)
            .is_some_and(|c| c.starts_with('3') || c.starts_with("2.99")),
        "{line}"
    );
    for step in STEPS {
        press(&mut window, step);
        let unnamed = window.unnamed_widgets();
        assert!(unnamed.is_empty(), "{step}: {unnamed:?}");
    }
}

#[test]
fn a_session_of_its_robot_shows_what_the_model_does() {
    let folder = tempfile::tempdir().expect("a folder");
    let model = model_of("paper-run.json", folder.path());
    let mut window = window(Some(model));
    open(&mut window, &bundled("paper-30.json"));
    assert!(says(&window, "30 samples · RMS error 13.9 →"));
    window.get_by_label("Held against this session");
    window.get_by_label("with corrected commands");

    // What is identified takes the model's place, and undo gives it back.
    press(&mut window, "3 Identify");
    press(&mut window, "Identify from this session");
    assert!(!says(&window, "Held against this session"));
    window.get_by_label("RMS error, full model");
    press(&mut window, "Undo identify");
    window.get_by_label("Held against this session");
}

#[test]
fn a_session_of_another_robot_does_not_keep_the_model() {
    let folder = tempfile::tempdir().expect("a folder");
    let model = model_of("paper-run.json", folder.path());
    let mut window = window(Some(model));
    open(&mut window, &bundled("lamp-commissioning.json"));
    assert!(!says(&window, "Model from a file"));
    window.get_by_label("RMS error, nominal robot");
}

#[test]
fn a_model_takes_the_place_of_the_identification_of_the_open_session() {
    let folder = tempfile::tempdir().expect("a folder");
    let model = model_of("lamp-commissioning.json", folder.path());
    let mut window = window(None);
    press(&mut window, "3 Identify");
    press(&mut window, "Identify");
    window.get_by_label("RMS error, full model");
    open(&mut window, &model);
    assert!(says(&window, "208 samples · RMS error"));
    window.get_by_label("RMS error, model from a file");
    press(&mut window, "Undo open model");
    window.get_by_label("RMS error, full model");
}

#[test]
fn a_broken_model_is_explained_as_a_model() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("broken.json");
    std::fs::write(&path, "{\n \"format\": \"truepose-model/1\",\n").expect("written");
    let window = window(Some(path));
    assert!(says(&window, "could not be opened; nothing was changed"));
    assert!(says(&window, "208 samples · RMS error"));
}
