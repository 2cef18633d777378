//! The record of a machine: what its report states, and how it changed from session to session.

use std::path::Path;

use crate::window::{Window, choose, copy_of, keys, open, press, says, there, window_at};
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

/// Saves the report there, as a person does who types the path.
fn save_report(window: &mut Window, path: &Path) {
    window.state_mut().type_path("report", path);
    window.run_steps(4);
    press(window, "Save");
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
    let mut window = window_at(Some(first.clone()), Some(&home));
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
    press(&mut window, "simple acceptance");
    press(&mut window, "Done");

    let html = folder.path().join("report.html");
    save_report(&mut window, &html);
    let page = std::fs::read_to_string(&html).expect("the report is there");
    for part in ["Lamps &amp; Co", "L-17", "R-1", "decision rule: simple"] {
        assert!(page.contains(part), "{part}");
    }

    // Another session of the machine: its serial number comes back, the report's number does not.
    open(&mut window, &second);
    let now = |window: &mut Window| {
        details(window);
        let labels = ["Serial number of the machine", "Report number", "Operator"];
        let now = labels.map(|label| field(window, label));
        press(window, "Done");
        now
    };
    assert_eq!(now(&mut window), ["L-17", "", "A. Meier"]);
    drop(window);

    // And in another window, tomorrow; the same session has its report's number.
    let mut window = window_at(Some(second), Some(&home));
    assert_eq!(now(&mut window), ["L-17", "", "A. Meier"]);
    open(&mut window, &first);
    assert_eq!(now(&mut window), ["L-17", "R-1", "A. Meier"]);
}

#[test]
fn pass_or_fail_stands_in_the_results_once_a_rule_is_chosen() {
    let folder = tempfile::tempdir().expect("a folder");
    let session = copy_of("lamp-commissioning", folder.path());
    let mut window = window_at(Some(session), None);
    press(&mut window, "3 Identify");
    press(&mut window, "Identify");
    let decided = "expanded uncertainty U";
    assert!(!says(&window, decided), "no rule is chosen");
    details(&mut window);
    press(&mut window, "ISO 14253-1");
    window.run_steps(4);
    assert!(there(&window, "Fail"), "a joint cannot mend its radius");
    press(&mut window, "simple acceptance");
    assert!(says(&window, "simple acceptance (JCGM 106, 8.2)"));
    press(&mut window, "Done");
    assert!(there(&window, "Fail") && says(&window, decided));
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
    save_report(&mut window, &html);
    assert!(says(&window, "/nowhere/logo.png") && says(&window, "expected a PNG file"));
    assert!(!html.exists());
}

/// Opens the sheets of the record in the marked language, and looks at each as it can stand.
pub(crate) fn open_records(window: &mut Window, see: &mut dyn FnMut(&Window, &str)) {
    keys(window, Modifiers::COMMAND.plus(Modifiers::ALT), Key::R);
    for rule in ["⟦Not decided⟧", "⟦simple acceptance⟧", "ISO 14253-1"] {
        press(window, rule);
        window.run_steps(4);
        see(window, &format!("report details, {rule}"));
    }
    press(window, "⟦Done⟧");
}
