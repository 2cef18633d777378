//! Going through the whole window as a person would who tries everything once.

#![allow(unreachable_pub, reason = "included in several tests")]

use std::path::Path;

use egui::accesskit::Role;
use egui::epaint::{ClippedShape, Shape};
use egui_kittest::kittest::{NodeT, Queryable};

use super::window::{Window, go_to, press, says, steps, there};

/// Everything that stands in the window: what is painted, and what a screen reader is told.
pub fn texts(window: &Window) -> Vec<String> {
    fn of_shape(shape: &Shape, texts: &mut Vec<String>) {
        match shape {
            Shape::Text(text) => texts.push(text.galley.text().to_owned()),
            Shape::Vec(shapes) => shapes.iter().for_each(|s| of_shape(s, texts)),
            _ => {}
        }
    }
    let mut texts = Vec::new();
    for ClippedShape { shape, .. } in &window.output().shapes {
        of_shape(shape, &mut texts);
    }
    for node in window.root().children_recursive() {
        let node = node.accesskit_node();
        texts.extend(node.label());
        texts.extend(node.value());
    }
    texts
}

/// No number is shown that is none, and nothing went wrong inside the program.
pub fn sound(window: &Window, where_at: &str) {
    for text in texts(window) {
        let words = text.split(|c: char| !(c.is_alphanumeric() || c == '-' || c == '−'));
        for word in words {
            let no_number = ["NaN", "nan", "inf", "-inf", "−inf"].contains(&word);
            assert!(!no_number, "{where_at}: shows {text:?}");
        }
        assert!(
            !text.contains("went wrong inside the program"),
            "{where_at}: {text:?}"
        );
    }
}

/// Presses every tab, choice and check box that is there, once each.
pub fn try_everything(window: &mut Window, where_at: &str) {
    let mut tried: Vec<String> = Vec::new();
    let all = steps(window);
    // Something that was pressed may bring more with it.
    for _ in 0..60 {
        let next = window.root().children_recursive().find_map(|node| {
            let node = node.accesskit_node();
            let choice = matches!(node.role(), Role::RadioButton | Role::CheckBox);
            let label = node.label()?;
            let fresh = !tried.contains(&label) && !all.contains(&label);
            (choice && fresh && !node.is_disabled()).then_some(label)
        });
        let Some(label) = next else {
            return;
        };
        let mut nodes = window.query_all_by_label(&label);
        let node = nodes.next().expect("it was there");
        node.click();
        drop(nodes);
        window.run_steps(3);
        sound(window, &format!("{where_at}, {label}"));
        tried.push(label);
    }
    panic!("{where_at}: there is no end to what can be chosen: {tried:?}");
}

/// Presses it if it is there and can be pressed.
pub fn press_if_there(window: &mut Window, label: &str) {
    if there(window, label) {
        press(window, label);
    }
}

/// Walks all steps, tries everything there is in each, identifies, searches and writes everything
/// that can be written into a folder.
pub fn tour(window: &mut Window, folder: &Path, name: &str) {
    for step in &steps(window) {
        press(window, step);
        sound(window, &format!("{name}, {step}"));
        try_everything(window, &format!("{name}, {step}"));
    }
    go_to(window, "Identify");
    press_if_there(window, "Identify");
    press_if_there(window, "Exact");
    for step in &steps(window) {
        press(window, step);
        sound(window, &format!("{name}, identified, {step}"));
        try_everything(window, &format!("{name}, identified, {step}"));
    }
    go_to(window, "Diagnose");
    press_if_there(window, "Run diagnosis");
    window.run_steps(4);
    sound(window, &format!("{name}, searched"));
    try_everything(window, &format!("{name}, searched"));
    writes(window, folder, name);
}

/// Writes everything that can be written; what cannot be says why.
fn writes(window: &mut Window, folder: &Path, name: &str) {
    type Typing = fn(&mut truepose::gui::App, &Path);
    let table: Typing = |app, path| app.type_path("table", path);
    let list: Typing = |app, path| app.type_path("poses", path);
    let report: Typing = |app, path| app.type_path("report", path);
    let model: Typing = |app, path| app.type_path("report of the model", path);
    let deviation: Typing = |app, path| app.type_path("deviation", path);
    let gap: Typing = |app, path| app.type_path("gap by step", path);
    for (file, typing) in [
        ("table.csv", table),
        ("list.csv", list),
        ("report.html", report),
        ("report.pdf", report),
        ("model.html", model),
        ("deviation.svg", deviation),
        ("gap.svg", gap),
    ] {
        let path = folder.join(file);
        typing(window.state_mut(), &path);
        window.run_steps(4);
        press(window, "Save");
        window.run_steps(4);
        sound(window, &format!("{name}, {file}"));
        if path.exists() {
            let bytes = std::fs::read(&path).expect("it can be read");
            assert!(!bytes.is_empty(), "{name}: {file} is empty");
            let text = String::from_utf8_lossy(&bytes);
            assert!(!text.contains("NaN"), "{name}: {file} has NaN in it");
        } else {
            let refused = says(window, "was not written")
                || says(window, "There is nothing")
                || says(window, "There is no");
            assert!(refused, "{name}: nothing says why there is no {file}");
        }
        press_if_there(window, "Dismiss");
    }
}
