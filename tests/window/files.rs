//! Files as a person meets them: recent ones, ones that are not saved, ones that change under the
//! window, and what is left when the program ends without warning.

use std::fs;

use crate::window::{
    Window, choose, come_back, copy_of, keys, open, press, says, seconds, status, there,
    type_tolerance, window_at,
};
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;

const SHIFTED: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

/// Saves under a name that is typed: the system's dialog cannot be driven.
fn save_to(window: &mut Window, path: &std::path::Path) {
    keys(window, SHIFTED, Key::P);
    window.get_by_label("Path to save to").focus();
    window.run_steps(2);
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    let typed = path.to_str().expect("a path in UTF-8");
    window.get_by_label("Path to save to").type_text(typed);
    window.run_steps(2);
    press(window, "Save");
}

/// A change that is worth saving.
fn divide(window: &mut Window) {
    press(window, "2 Regions");
    press(window, "Uniform");
}

#[test]
fn what_was_open_yesterday_is_in_the_menu_today() {
    let folder = tempfile::tempdir().expect("a folder");
    let home = folder.path().join("home");
    let session = copy_of("paper-30", folder.path());
    let other = copy_of("lamp-commissioning", folder.path());
    let mut window = window_at(None, Some(&home));
    open(&mut window, &session);
    open(&mut window, &other);
    drop(window);
    fs::remove_file(&other).expect("it can be removed");

    let mut window = window_at(None, Some(&home));
    seconds(&mut window, 2);
    assert!(!there(&window, "lamp-commissioning.json"), "it is gone");
    press(&mut window, "paper-30.json");
    assert!(says(&window, "30 samples · RMS error"));
    keys(&mut window, Modifiers::NONE, Key::F2);
    assert!(says(&window, "208 samples · RMS error"));
    press(&mut window, "paper-30.json");
    assert!(says(&window, "30 samples · RMS error"));
}

#[test]
fn a_change_is_not_lost_by_opening_something_else() {
    let folder = tempfile::tempdir().expect("a folder");
    let session = copy_of("paper-30", folder.path());
    let mut window = window_at(Some(session.clone()), None);
    divide(&mut window);
    keys(&mut window, Modifiers::NONE, Key::F2);
    assert!(says(&window, "Go on without saving?"));
    assert!(says(&window, "are not in its file, paper-30.json"));
    press(&mut window, "Cancel");
    assert!(
        says(&window, "30 samples · RMS error"),
        "nothing was opened"
    );

    // Save: the session to its own file, the model to one that is asked for, and on to what was asked for.
    keys(&mut window, Modifiers::NONE, Key::F2);
    press(&mut window, "Save session and model…");
    let saved = fs::read_to_string(&session).expect("the session");
    assert!(saved.contains("\"from_deg\": 0"), "{saved}");
    assert!(there(&window, "Path to save to"), "of the model");
    press(&mut window, "Save");
    let models = fs::read_dir(folder.path()).expect("a folder").flatten();
    let models = models.filter(|entry| entry.path().display().to_string().ends_with(".model.json"));
    assert_eq!(models.count(), 1, "it is written as well");
    assert!(says(&window, "208 samples · RMS error"));
    assert!(!says(&window, "without saving"));
}

#[test]
fn a_simulated_session_is_asked_about_and_one_that_was_saved_is_not() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window_at(None, None);
    keys(&mut window, Modifiers::COMMAND, Key::N);
    press(&mut window, "Simulate");
    assert!(says(&window, "360 samples · RMS error"));
    assert!(says(&window, "not saved"));
    keys(&mut window, Modifiers::NONE, Key::F3);
    assert!(says(&window, "has not been saved"));
    press(&mut window, "Cancel");
    let path = folder.path().join("made.json");
    save_to(&mut window, &path);
    assert!(path.exists() && !says(&window, "not saved"));
    keys(&mut window, Modifiers::NONE, Key::F3);
    assert!(says(&window, "30 samples · RMS error"));
    // And the way back: the session that was left is in its file still.
    keys(&mut window, Modifiers::COMMAND, Key::Z);
    assert!(says(&window, "360 samples · RMS error") && !says(&window, "not saved"));
}

#[test]
fn closing_asks_and_leaves_when_told_to() {
    let folder = tempfile::tempdir().expect("a folder");
    let session = copy_of("paper-30", folder.path());
    let home = folder.path().join("home");
    let mut window = window_at(Some(session), Some(&home));
    divide(&mut window);
    seconds(&mut window, 4);
    let kept = || fs::read_dir(home.join("recovery")).map_or(0, Iterator::count);
    assert_eq!(kept(), 2, "the file and its lock");
    keys(&mut window, Modifiers::COMMAND, Key::Q);
    assert!(says(&window, "Go on without saving?"));
    press(&mut window, "Go on without saving");
    assert_eq!(kept(), 0, "who leaves on purpose leaves nothing behind");
}

#[test]
fn a_file_that_another_program_changed_is_noticed_and_not_replaced_in_silence() {
    let folder = tempfile::tempdir().expect("a folder");
    let session = copy_of("paper-30", folder.path());
    let samples = folder.path().join("paper-30.csv");
    let mut window = window_at(Some(session.clone()), None);
    come_back(&mut window);
    assert!(!says(&window, "another program"));
    let text = fs::read_to_string(&samples).expect("the samples");
    let shorter: Vec<&str> = text.lines().take(21).collect();
    let theirs = format!("{}\n", shorter.join("\n"));
    fs::write(&samples, &theirs).expect("written");
    come_back(&mut window);
    assert!(says(&window, "paper-30.csv was changed by another program"));
    assert!(
        says(&window, "30 samples · RMS error"),
        "what was read is here still"
    );

    press(&mut window, "Keep this version");
    come_back(&mut window);
    assert!(!says(&window, "another program"), "said once");
    divide(&mut window);
    keys(&mut window, Modifiers::COMMAND, Key::S);
    assert!(says(&window, "Replace what another program wrote?"));
    press(&mut window, "Cancel");
    assert_eq!(fs::read_to_string(&samples).expect("theirs"), theirs);
    keys(&mut window, Modifiers::COMMAND, Key::S);
    press(&mut window, "Replace it");
    assert!(says(&window, "Saved"));
    let written = fs::read_to_string(&samples).expect("ours");
    assert_eq!(written.lines().count(), 31);

    // The other way: read theirs, and undo brings ours back.
    come_back(&mut window);
    fs::write(&samples, &theirs).expect("written");
    come_back(&mut window);
    press(&mut window, "Reload");
    assert!(says(&window, "20 samples · RMS error"));
    keys(&mut window, Modifiers::COMMAND, Key::Z);
    assert!(says(&window, "30 samples · RMS error"));
}

#[test]
fn a_file_that_vanished_is_said_and_can_be_saved_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let session = copy_of("paper-30", folder.path());
    let mut window = window_at(Some(session.clone()), None);
    fs::remove_file(&session).expect("removed");
    come_back(&mut window);
    assert!(says(&window, "paper-30.json: file not found"));
    keys(&mut window, Modifiers::COMMAND, Key::S);
    assert!(session.exists() && says(&window, "Saved"));
    assert!(!says(&window, "file not found"));
}

#[test]
fn samples_that_vanished_are_said_even_after_they_were_changed_and_can_be_saved_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let session = copy_of("paper-30", folder.path());
    let samples = folder.path().join("paper-30.csv");
    let text = fs::read_to_string(&samples).expect("the samples");
    let mut window = window_at(Some(session), None);
    fs::write(&samples, format!("{text}garbage\n")).expect("written");
    come_back(&mut window);
    assert!(says(&window, "paper-30.csv was changed by another program"));
    fs::remove_file(&samples).expect("removed");
    come_back(&mut window);
    assert!(says(&window, "paper-30.csv: file not found"));
    // Reading again what is not there says so, not where a document names it.
    press(&mut window, "Keep this version");
    keys(&mut window, Modifiers::COMMAND, Key::R);
    assert!(says(&window, "paper-30.csv: file not found"));
    assert!(says(&window, "saving writes it again") && !says(&window, "samples.file"));
    press(&mut window, "Save it again");
    assert!(samples.exists() && says(&window, "Saved"));
    assert!(!says(&window, "file not found"));

    // What is put back as it was is no change.
    let ours = fs::read(&samples).expect("ours");
    fs::remove_file(&samples).expect("removed");
    come_back(&mut window);
    assert!(says(&window, "paper-30.csv: file not found"));
    fs::write(&samples, ours).expect("put back");
    come_back(&mut window);
    assert!(!says(&window, "file not found"));
}

#[cfg(unix)]
#[test]
fn a_folder_that_cannot_be_written_leaves_the_old_file_and_says_what_to_do() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().expect("a folder");
    let session = copy_of("paper-30", folder.path());
    let before = fs::read(&session).expect("the session");
    let mut window = window_at(Some(session.clone()), None);
    divide(&mut window);
    let mode = |mode| fs::set_permissions(folder.path(), fs::Permissions::from_mode(mode));
    mode(0o555).expect("the folder's mode");
    let root = fs::write(folder.path().join("probe"), "").is_ok();
    keys(&mut window, Modifiers::COMMAND, Key::S);
    mode(0o755).expect("the folder's mode");
    if root {
        eprintln!("skipped: this user may write everywhere");
        return;
    }
    assert!(says(&window, "was not written"));
    assert!(says(&window, "save to another folder"));
    assert_eq!(fs::read(&session).expect("the session"), before);
}

#[test]
fn a_folder_that_is_not_there_is_said_with_what_to_do() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window_at(None, None);
    save_to(
        &mut window,
        &folder.path().join("no such folder").join("a.json"),
    );
    assert!(says(&window, "was not written"));
    assert!(says(&window, "create it first"));
}

#[test]
fn what_was_not_saved_when_the_program_was_killed_is_offered_and_comes_back() {
    let folder = tempfile::tempdir().expect("a folder");
    let home = folder.path().join("home");
    let session = copy_of("paper-30", folder.path());
    let mut window = window_at(Some(session.clone()), Some(&home));
    press(&mut window, "2 Regions");
    press(&mut window, "Uniform");
    let handle = window.get_by_label("boundary at 30°").rect().center();
    window.drag_at(handle);
    window.step();
    for k in 1_u8..=4 {
        window.hover_at(handle + egui::vec2(0.0, 6.0) * f32::from(k));
        window.step();
    }
    window.drop_at(handle + egui::vec2(0.0, 24.0));
    seconds(&mut window, 4);
    assert!(!there(&window, "boundary at 30°"));
    // Killed: nothing is tidied up.
    drop(window);

    // Two windows start; the first one offers it, the second does not.
    let mut window = window_at(None, Some(&home));
    let mut second = window_at(None, Some(&home));
    assert!(says(&window, "Recover unsaved work"));
    assert!(says(&window, "0 minutes ago") && says(&window, "paper-30.json"));
    assert!(!says(&second, "Recover unsaved work"));
    second.run_steps(2);
    press(&mut window, "Restore");
    assert!(says(&window, "30 samples · RMS error") && says(&window, "not saved"));
    press(&mut window, "2 Regions");
    assert!(
        !there(&window, "boundary at 30°"),
        "the boundary is where it was left"
    );

    // Killed again before it was saved: it is there again, once.
    seconds(&mut window, 4);
    drop(window);
    let mut window = window_at(None, Some(&home));
    assert_eq!(window.query_all_by_label("Restore").count(), 1);
    press(&mut window, "Discard");
    assert!(
        says(&window, "Recover unsaved work"),
        "it cannot be brought back: it asks"
    );
    press(&mut window, "Discard for good");
    assert!(!says(&window, "Recover unsaved work"));
    drop(window);
    drop(second);
    let window = window_at(None, Some(&home));
    assert!(!says(&window, "Recover unsaved work"));
}

#[test]
fn what_was_found_comes_back_after_a_kill_although_the_session_is_saved() {
    let folder = tempfile::tempdir().expect("a folder");
    let home = folder.path().join("home");
    let session = copy_of("lamp-commissioning", folder.path());
    let mut window = window_at(Some(session.clone()), Some(&home));
    press(&mut window, "4 Diagnose");
    press(&mut window, "Run diagnosis");
    let name = window.get_all_by_label_contains("to the model").next();
    name.expect("all are added at once").click();
    window.run_steps(2);
    let added = status(&window);
    assert!(added.contains('→'), "{added}");
    seconds(&mut window, 4);
    // Killed; the session's own file was never touched.
    drop(window);
    let mut window = window_at(Some(session), Some(&home));
    assert!(says(&window, "Recover unsaved work"));
    press(&mut window, "Restore");
    let after = |line: &str| {
        let gaps = line.split(" mm").next().unwrap_or_default();
        let last = gaps.rsplit(' ').next().unwrap_or_default();
        last.parse::<f64>().expect("a number")
    };
    let restored = status(&window);
    assert!(
        (after(&restored) - after(&added)).abs() < 1e-3,
        "{added}, {restored}"
    );
    press(&mut window, "4 Diagnose");
    assert!(says(&window, "use backlash"), "it can be switched off");
}

#[test]
fn a_damaged_recovery_file_is_said_and_kept() {
    let folder = tempfile::tempdir().expect("a folder");
    let home = folder.path().join("home");
    let session = copy_of("paper-30", folder.path());
    let mut window = window_at(Some(session), Some(&home));
    divide(&mut window);
    seconds(&mut window, 4);
    drop(window);
    let files = fs::read_dir(home.join("recovery")).expect("the folder");
    let path = files
        .filter_map(Result::ok)
        .map(|entry| entry.path())
        .find(|path| path.extension().is_some_and(|e| e == "recovery"))
        .expect("it was kept");
    let whole = fs::read(&path).expect("it can be read");
    fs::write(&path, &whole[..whole.len() / 2]).expect("written");

    let window = window_at(None, Some(&home));
    assert!(says(&window, "is damaged and cannot be restored"));
    assert!(says(&window, "It is kept as"));
    let aside = path.with_extension("damaged");
    assert_eq!(fs::read(aside).expect("it is there").len(), whole.len() / 2);
    assert!(
        says(&window, "208 samples · RMS error"),
        "the window works all the same"
    );
}

#[test]
fn what_is_saved_leaves_no_recovery_file() {
    let folder = tempfile::tempdir().expect("a folder");
    let home = folder.path().join("home");
    let session = copy_of("paper-30", folder.path());
    let mut window = window_at(Some(session), Some(&home));
    type_tolerance(&mut window, "3");
    seconds(&mut window, 4);
    keys(&mut window, Modifiers::COMMAND, Key::S);
    seconds(&mut window, 4);
    drop(window);
    let window = window_at(None, Some(&home));
    assert!(!says(&window, "Recover unsaved work"));
}

#[test]
fn the_menu_saves_and_reads_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let session = copy_of("paper-30", folder.path());
    let mut window = window_at(Some(session.clone()), None);
    divide(&mut window);
    press(&mut window, "File");
    press(&mut window, "Save session");
    assert!(says(&window, "Saved") && !says(&window, "not saved"));
    let folder_of_window = fs::read_to_string(&session).expect("the session");
    let other = folder_of_window.replace("\"name\": \"", "\"name\": \"another ");
    fs::write(&session, other).expect("written");
    choose(&mut window, "File", "Read the file again");
    assert!(says(&window, "another "), "what stands in the file now");
}

/// What was typed into a form is not lost by a click that misses it.
#[test]
fn a_click_beside_a_form_leaves_it_open_and_escape_closes_it() {
    let mut window = window_at(None, None);
    let shift = Modifiers::COMMAND.plus(Modifiers::SHIFT);
    keys(&mut window, shift, Key::P);
    // The field has the focus from the start.
    window.event(egui::Event::Text("elsewhere-".to_owned()));
    window.run_steps(2);
    let beside = egui::pos2(20.0, 780.0);
    window.hover_at(beside);
    window.run_steps(1);
    window.drag_at(beside);
    window.drop_at(beside);
    window.run_steps(4);
    assert!(says(&window, "elsewhere-"));
    keys(&mut window, Modifiers::NONE, Key::Escape);
    keys(&mut window, Modifiers::NONE, Key::Escape);
    assert!(!there(&window, "Path to save to"));
}

#[test]
fn what_was_identified_is_not_in_the_file_and_that_is_said() {
    let folder = tempfile::tempdir().expect("a folder");
    let session = copy_of("paper-30", folder.path());
    let mut window = window_at(Some(session), None);
    let not_in_it = "What was identified is not in it";
    type_tolerance(&mut window, "3");
    keys(&mut window, Modifiers::COMMAND, Key::S);
    assert!(says(&window, "Saved") && !says(&window, not_in_it));
    keys(&mut window, Modifiers::COMMAND, Key::I);
    type_tolerance(&mut window, "2");
    keys(&mut window, Modifiers::COMMAND, Key::S);
    assert!(says(&window, "Saved") && says(&window, not_in_it));
}

#[test]
fn a_tolerance_in_inches_is_typed_in_inches_and_saved_in_millimetres() {
    let folder = tempfile::tempdir().expect("a folder");
    let session = copy_of("paper-30", folder.path());
    let mut window = window_at(Some(session.clone()), None);
    keys(&mut window, Modifiers::COMMAND, Key::Comma);
    press(&mut window, "inch");
    press(&mut window, "Done");
    type_tolerance(&mut window, "0.25");
    keys(&mut window, Modifiers::COMMAND, Key::S);
    let saved = fs::read_to_string(&session).expect("the session");
    assert!(saved.contains("\"tolerance_mm\": 6.35"), "{saved}");
}
