//! The window as a person drives it, without a display.

#![allow(unreachable_pub, reason = "included in several tests")]

use std::path::{Path, PathBuf};
use std::sync::Arc;

use egui::accesskit::Role;
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
    made([1280.0, 800.0], path, home, Runner::AtOnce)
}

/// A window of this size, which works on threads or at once.
pub fn window_of(size: [f32; 2], path: Option<PathBuf>, runner: Runner) -> Window {
    made(size, path, None, runner)
}

/// A window on threads whose dialogs of the system this answers.
pub fn window_choosing(chooser: Arc<dyn Fn() -> Option<PathBuf> + Send + Sync>) -> Window {
    let mut window = Harness::builder()
        .with_size([1280.0, 800.0])
        .build_eframe(|cc| App::new(&cc.egui_ctx, None, Runner::Threads).choosing(chooser));
    window.run_steps(4);
    window
}

fn made(size: [f32; 2], path: Option<PathBuf>, home: Option<&Path>, runner: Runner) -> Window {
    let home = home.map(Path::to_path_buf);
    let mut window = Harness::builder()
        .with_size(size)
        .build_eframe(|cc| App::new(&cc.egui_ctx, path, runner).at_home(home));
    window.run_steps(4);
    window
}

/// The steps as they are labelled.
pub const STEPS: [&str; 5] = [
    "1 Session",
    "2 Regions",
    "3 Identify",
    "4 Diagnose",
    "5 Export",
];

/// The steps that are there: robots other than a single revolute joint have no regions.
pub fn steps(window: &Window) -> Vec<String> {
    let names = ["Session", "Regions", "Identify", "Diagnose", "Export"];
    let numbered = (1..=5).flat_map(|n| names.map(|name| format!("{n} {name}")));
    numbered.filter(|step| there(window, step)).collect()
}

/// Goes to the step of this name, whatever its number is.
pub fn go_to(window: &mut Window, name: &str) {
    let mut all = steps(window).into_iter();
    let step = all.find(|step| step.ends_with(name));
    press(window, &step.expect("there is such a step"));
}

/// Presses something; brings it into sight first where it is not.
pub fn press(window: &mut Window, label: &str) {
    into_sight(window, label);
    window.get_by_label(label).click();
    window.run_steps(4);
}

pub fn into_sight(window: &mut Window, label: &str) {
    window.get_by_label(label).scroll_to_me();
    window.run_steps(6);
}

/// What a button copies: rows of cells.
pub fn copied(window: &mut Window, label: &str) -> Vec<Vec<String>> {
    window.get_by_label(label).click();
    for _ in 0..8 {
        window.step();
        let commands = &window.output().platform_output.commands;
        for command in commands {
            if let egui::OutputCommand::CopyText(text) = command {
                let cells = |line: &str| line.split('\t').map(str::to_owned).collect();
                return text.lines().map(cells).collect();
            }
        }
    }
    panic!("nothing was copied");
}

pub fn says(window: &Window, part: &str) -> bool {
    window.query_all_by_label_contains(part).count() > 0
}

/// Frames until something is in sight.
pub fn until(window: &mut Window, part: &str) {
    for _ in 0..20_000 {
        window.step();
        if says(window, part) {
            return;
        }
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    panic!("{part} never came");
}

pub fn there(window: &Window, label: &str) -> bool {
    window.query_all_by_label(label).count() > 0
}

/// One comes back to the window from another program.
pub fn come_back(window: &mut Window) {
    window.event(egui::Event::WindowFocused(true));
    window.run_steps(4);
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

/// Turns the wheel at a place by so many notches, up is positive.
pub fn wheel(window: &mut Window, at: egui::Pos2, notches: f32) {
    window.hover_at(at);
    window.run_steps(1);
    window.event(egui::Event::MouseWheel {
        unit: egui::MouseWheelUnit::Line,
        delta: egui::vec2(0.0, notches),
        phase: egui::TouchPhase::Move,
        source: egui::MouseWheelSource::Unknown,
        modifiers: Modifiers::NONE,
    });
    window.run_steps(12);
}

/// The middle of what answers to the pointer as this place does.
pub fn middle_of(
    window: &mut Window,
    at: egui::Pos2,
    answer: impl Fn(&Window) -> Option<String>,
) -> egui::Pos2 {
    let mut here = |at: egui::Pos2| {
        window.hover_at(at);
        window.run_steps(2);
        answer(window)
    };
    let wanted = here(at);
    let mut middle = at;
    for way in [egui::vec2(1.0, 0.0), egui::vec2(0.0, 1.0)] {
        let steps = (-30_i8..=30).map(|k| middle + f32::from(k) * way);
        let same: Vec<egui::Pos2> = steps.filter(|at| here(*at) == wanted).collect();
        let sum = same
            .iter()
            .fold(egui::Vec2::ZERO, |sum, at| sum + at.to_vec2());
        middle = (sum / same.len().max(1) as f32).to_pos2();
    }
    here(middle);
    middle
}

/// Types a tolerance, mm: it changes what the session's file says, and asks nothing of the samples.
pub fn type_tolerance(window: &mut Window, mm: &str) {
    window
        .get_by_role_and_label(Role::SpinButton, "tolerance")
        .click();
    window.run_steps(2);
    keys(window, Modifiers::COMMAND, Key::A);
    window
        .get_by_role_and_label(Role::SpinButton, "tolerance")
        .type_text(mm);
    keys(window, Modifiers::NONE, Key::Enter);
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
    for ending in ["json", "csv"] {
        let name = format!("{session}.{ending}");
        std::fs::copy(bundled(&name), folder.join(&name)).expect("a bundled session");
    }
    folder.join(format!("{session}.json"))
}

/// The line at the bottom of the window.
pub fn status(window: &Window) -> String {
    use egui_kittest::kittest::NodeT;
    let mut lines = window.get_all_by_label_contains("· RMS error");
    let line = lines.next().expect("the status bar is there");
    let node = line.accesskit_node();
    node.label().or(node.value()).expect("it says something")
}

/// What the status bar says of the gap: before, and what is left now where there is an answer.
pub fn gaps(window: &Window) -> (f64, Option<f64>) {
    let line = status(window);
    let (_, gaps) = line.split_once("RMS error ").expect("the gap is named");
    let (gaps, _) = gaps.split_once(" · ").unwrap_or((gaps, ""));
    let mut numbers = gaps
        .split([' ', '→'])
        .filter_map(|word| word.parse::<f64>().ok());
    (
        numbers.next().expect("the gap is a number"),
        numbers.next_back(),
    )
}

/// The dialog of the system cannot be driven; the path is typed.
pub fn export_to(window: &mut Window, path: &Path) {
    window.state_mut().type_path("table", path);
    window.run_steps(4);
    press(window, "Save");
    window.run_steps(4);
}

/// A bundled session, where it stands.
pub fn bundled(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("sessions")
        .join(name)
}
