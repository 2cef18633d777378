//! Everything that can be pressed, typed into or moved has a name for a screen reader, can be
//! reached with the keyboard, and sheets close with Escape and are confirmed with Enter.
use crate::touring;
use crate::window;

use std::collections::BTreeSet;

use crate::window::{STEPS, Window, keys, press, says, there, type_into};
use egui::accesskit::{Action, Role};
use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT, Queryable};

/// Every node that something can be done with, and whether it has a name.
fn nameless(window: &Window) -> Vec<String> {
    let mut found = Vec::new();
    for node in window.root().children_recursive() {
        let node = node.accesskit_node();
        let role = node.role();
        let acts = node.data().supports_action(Action::Click)
            || node.data().supports_action(Action::Focus)
            || matches!(
                role,
                Role::Button
                    | Role::CheckBox
                    | Role::RadioButton
                    | Role::Slider
                    | Role::SpinButton
                    | Role::TextInput
                    | Role::MultilineTextInput
                    | Role::ComboBox
                    | Role::Link
                    | Role::Tab
            );
        // A scroll bar does what the keys do for the region that it belongs to.
        let frame = [Role::Window, Role::ScrollView, Role::ScrollBar, Role::Label];
        if !acts || frame.contains(&role) {
            continue;
        }
        let name = node.label().or_else(|| {
            let mut labels = node.labelled_by();
            labels
                .next()
                .and_then(|label| label.value().or(label.label()))
        });
        if name.is_none_or(|name| name.trim().is_empty()) {
            let bounds = node.bounding_box();
            found.push(format!("{role:?} at {bounds:?}, value {:?}", node.value()));
        }
    }
    found
}

fn named(window: &Window, where_at: &str) {
    let found = nameless(window);
    assert!(found.is_empty(), "{where_at}: without a name: {found:#?}");
}

#[test]
fn every_input_of_every_step_has_a_name() {
    let mut window = window::window(None);
    for round in ["as opened", "identified", "searched"] {
        for step in STEPS {
            press(&mut window, step);
            named(&window, &format!("{round}, {step}"));
        }
        match round {
            "as opened" => {
                press(&mut window, "3 Identify");
                press(&mut window, "Identify");
            }
            "identified" => {
                press(&mut window, "4 Diagnose");
                touring::press_if_there(&mut window, "Run diagnosis");
            }
            _ => {}
        }
    }
    press(&mut window, "1 Session");
    press(&mut window, "Samples");
    named(&window, "samples");
    press(&mut window, "2 Regions");
    press(&mut window, "Uniform");
    named(&window, "even regions");
    press(&mut window, "region 1: Edit");
    named(&window, "menu of a region");
}

#[test]
fn every_input_of_every_menu_and_sheet_has_a_name() {
    let mut window = window::window(None);
    for menu in ["File", "Edit", "View", "Help"] {
        press(&mut window, menu);
        named(&window, menu);
        keys(&mut window, Modifiers::NONE, Key::Escape);
    }
    let shifted = Modifiers::COMMAND.plus(Modifiers::SHIFT);
    for (heading, modifiers, key) in [
        (
            "Random poses within the joint limits",
            Modifiers::COMMAND,
            Key::N,
        ),
        ("Save session", shifted, Key::P),
        ("Preferences", Modifiers::COMMAND, Key::Comma),
        ("Glossary", Modifiers::NONE, Key::F1),
        (
            "Calibrates a robot at commissioning",
            Modifiers::SHIFT,
            Key::F1,
        ),
    ] {
        keys(&mut window, modifiers, key);
        assert!(says(&window, heading), "{heading} is open");
        named(&window, heading);
        keys(&mut window, Modifiers::NONE, Key::Escape);
        assert!(!says(&window, heading), "Escape closes {heading}");
    }
    window
        .state_mut()
        .type_path("table", std::path::Path::new("table.csv"));
    window.run_steps(4);
    named(&window, "export to path");
    keys(&mut window, Modifiers::NONE, Key::Escape);
    assert!(
        !says(&window, "Save table"),
        "Escape closes the path of an export"
    );
}

#[test]
fn the_import_sheet_is_named_and_closed_with_escape() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("messung.csv");
    std::fs::write(&path, "winkel;x;y\n0;250;0\n10;246;43\n20;235;85\n").expect("written");
    let mut window = window::window(Some(path));
    assert!(says(&window, "messung.csv"), "the sheet is there");
    named(&window, "import");
    keys(&mut window, Modifiers::NONE, Key::Escape);
    assert!(!says(&window, "messung.csv"));
    assert!(says(&window, "208 samples"), "nothing was changed");
}

#[test]
fn enter_confirms_a_path_that_is_typed() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("kept.json");
    let mut window = window::window(None);
    keys(
        &mut window,
        Modifiers::COMMAND.plus(Modifiers::SHIFT),
        Key::P,
    );
    type_into(
        &mut window,
        "Path to save to",
        path.to_str().expect("in UTF-8"),
    );
    assert!(!there(&window, "Path to save to"));
    assert!(path.exists(), "Enter has saved it");
}

/// Presses Tab until the focus comes back; what it stood on.
fn reached(window: &mut Window) -> BTreeSet<String> {
    let mut reached = BTreeSet::new();
    let mut last_new = 0;
    for press in 0..600 {
        window.key_press(Key::Tab);
        window.run_steps(1);
        for node in window.root().children_recursive() {
            let node = node.accesskit_node();
            if !node.is_focused() {
                continue;
            }
            let mut labels = node.labelled_by();
            let by = labels.find_map(|l| l.value().or(l.label()));
            if let Some(name) = node.label().or(by)
                && reached.insert(name)
            {
                last_new = press;
            }
        }
        if press > last_new + 40 {
            break;
        }
    }
    reached
}

#[test]
fn the_tabulator_reaches_everything() {
    let mut window = window::window(None);
    press(&mut window, "3 Identify");
    press(&mut window, "Identify");
    for step in STEPS {
        press(&mut window, step);
        let reached = reached(&mut window);
        let mut missed = Vec::new();
        for node in window.root().children_recursive() {
            let node = node.accesskit_node();
            let wanted = matches!(
                node.role(),
                Role::Button
                    | Role::CheckBox
                    | Role::RadioButton
                    | Role::Slider
                    | Role::SpinButton
                    | Role::TextInput
                    | Role::ComboBox
                    | Role::Link
                    | Role::Tab
            );
            let mut labels = node.labelled_by();
            let by = labels.find_map(|l| l.value().or(l.label()));
            let Some(name) = node.label().or(by) else {
                continue;
            };
            if wanted && !node.is_disabled() && !reached.contains(&name) {
                missed.push(format!("{:?} {name}", node.role()));
            }
        }
        assert!(missed.is_empty(), "{step}: Tab never comes to {missed:#?}");
    }
}

#[test]
fn the_whole_work_can_be_done_with_the_keyboard() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window::window(None);
    keys(&mut window, Modifiers::NONE, Key::F3);
    keys(&mut window, Modifiers::COMMAND, Key::Num2);
    window.get_by_label("region 1: Edit").focus();
    window.run_steps(2);
    keys(&mut window, Modifiers::NONE, Key::Enter);
    window.get_by_label("Split in half").focus();
    window.run_steps(2);
    keys(&mut window, Modifiers::NONE, Key::Enter);
    assert!(there(&window, "region 7: from"), "split by keys");
    keys(&mut window, Modifiers::COMMAND, Key::I);
    keys(&mut window, Modifiers::COMMAND, Key::Num5);
    window
        .state_mut()
        .type_path("table", &folder.path().join("t.csv"));
    window.run_steps(4);
    window.get_by_label("Path to save to").focus();
    window.run_steps(2);
    keys(&mut window, Modifiers::NONE, Key::Enter);
    assert!(folder.path().join("t.csv").exists());
}
