//! The window as a person drives it, without a display.

#![allow(unreachable_pub, reason = "included in several tests")]

use std::path::{Path, PathBuf};

use egui::{Key, Modifiers};
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use truepose::gui::{App, Runner};

pub type Window = Harness<'static, App>;

/// A window that keeps nothing from one day to the next.
pub fn window(path: Option<PathBuf>) -> Window {
    window_at(path, None)
}

/// A window that keeps its things in this folder.
pub fn window_at(path: Option<PathBuf>, home: Option<&Path>) -> Window {
    let home = home.map(Path::to_path_buf);
    let mut window = Harness::builder()
        .with_size([1280.0, 800.0])
        .build_eframe(|cc| App::new(&cc.egui_ctx, path, Runner::AtOnce).at_home(home));
    window.run_steps(4);
    window
}

/// Presses something; brings it into sight first where it is not.
pub fn press(window: &mut Window, label: &str) {
    into_sight(window, label);
    window.get_by_label(label).click();
    window.run_steps(4);
}

fn into_sight(window: &mut Window, label: &str) {
    window.get_by_label(label).scroll_to_me();
    window.run_steps(6);
}

pub fn says(window: &Window, part: &str) -> bool {
    window.query_all_by_label_contains(part).count() > 0
}

pub fn there(window: &Window, label: &str) -> bool {
    window.query_all_by_label(label).count() > 0
}

/// Frames are a quarter of a second apart.
pub fn seconds(window: &mut Window, seconds: usize) {
    window.run_steps(4 * seconds);
}

pub fn keys(window: &mut Window, modifiers: Modifiers, key: Key) {
    window.key_press_modifiers(modifiers, key);
    window.run_steps(4);
}

/// Types into a field, over what stands there.
pub fn type_into(window: &mut Window, label: &str, text: &str) {
    into_sight(window, label);
    window.get_by_label(label).click();
    window.run_steps(2);
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.run_steps(1);
    window.get_by_label(label).type_text(text);
    window.run_steps(2);
    window.key_press(Key::Enter);
    window.run_steps(4);
}

/// Opens a file by typing its path.
pub fn open(window: &mut Window, path: &Path) {
    press(window, "1 Session");
    window.get_by_label("Path of a session or model").focus();
    window.run_steps(2);
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    let typed = path.to_str().expect("a path in UTF-8");
    window
        .get_by_label("Path of a session or model")
        .type_text(typed);
    window.run_steps(2);
    press(window, "Open");
}

/// An item of a menu.
pub fn choose(window: &mut Window, menu: &str, item: &str) {
    press(window, menu);
    window.get_by_label(item).click();
    window.run_steps(4);
}

/// A copy of a bundled session that may be changed.
pub fn copy_of(session: &str, folder: &Path) -> PathBuf {
    let bundled = Path::new(env!("CARGO_MANIFEST_DIR")).join("sessions");
    for ending in ["json", "csv"] {
        let name = format!("{session}.{ending}");
        std::fs::copy(bundled.join(&name), folder.join(&name)).expect("a bundled session");
    }
    folder.join(format!("{session}.json"))
}

/// What the status bar says of the gap: before, and what is left now
/// where there is an answer.
pub fn gaps(window: &Window) -> (f64, Option<f64>) {
    use egui_kittest::kittest::NodeT;
    let mut lines = window.get_all_by_label_contains("· gap");
    let line = lines.next().expect("the status bar is there");
    let node = line.accesskit_node();
    let line = node.label().or(node.value()).expect("it says something");
    let (_, gaps) = line.split_once("gap ").expect("the gap is named");
    let (gaps, _) = gaps.split_once(" · ").unwrap_or((gaps, ""));
    let mut numbers = gaps
        .split([' ', '→'])
        .filter_map(|word| word.parse::<f64>().ok());
    (
        numbers.next().expect("the gap is a number"),
        numbers.next_back(),
    )
}
