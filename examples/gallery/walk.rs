//! Drives the window as a person does, as far as each picture needs it.

use std::path::{Path, PathBuf};

use egui::Theme;
use egui_kittest::Harness;
use egui_kittest::kittest::Queryable;
use truepose::gui::{App, Language, Runner};

pub type Window = Harness<'static, App>;

/// A window in one of the themes, with something to draw with.
pub fn window(theme: Theme, path: Option<PathBuf>) -> Window {
    window_in(Language::English, theme, path)
}

/// The same in a language.
pub fn window_in(language: Language, theme: Theme, path: Option<PathBuf>) -> Window {
    let mut window = Harness::builder()
        .with_size([1280.0, 800.0])
        .with_theme(theme)
        // The first frame is drawn before a font of the machine is found.
        .allow_missing_glyphs()
        .wgpu()
        .build_eframe(|cc| {
            let app = App::new(&cc.egui_ctx, path, Runner::AtOnce);
            app.drawn_by(cc.wgpu_render_state.as_ref())
                .speaking(language)
        });
    window.run_steps(4);
    window
}

pub fn press(window: &mut Window, label: &str) {
    window.get_by_label(label).scroll_to_me();
    window.run_steps(6);
    window.get_by_label(label).click();
    window.run_steps(4);
}

/// A key with Ctrl, whatever the language.
pub fn key(window: &mut Window, key: egui::Key) {
    window.key_press_modifiers(egui::Modifiers::COMMAND, key);
    window.run_steps(8);
}

pub fn there(window: &Window, label: &str) -> bool {
    window.query_all_by_label(label).count() > 0
}

fn type_into(window: &mut Window, label: &str, text: &str) {
    window.get_by_label(label).scroll_to_me();
    window.run_steps(6);
    window.get_by_label(label).click();
    window.run_steps(2);
    window.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
    window.run_steps(1);
    window.get_by_label(label).type_text(text);
    window.run_steps(2);
    window.key_press(egui::Key::Enter);
    window.run_steps(4);
}

fn open(window: &mut Window, path: &Path) {
    press(window, "1 Session");
    window.get_by_label("Path of a session or model").focus();
    window.run_steps(2);
    window.key_press_modifiers(egui::Modifiers::COMMAND, egui::Key::A);
    let typed = path.to_string_lossy().into_owned();
    window
        .get_by_label("Path of a session or model")
        .type_text(&typed);
    window.run_steps(2);
    press(window, "Open");
}

/// The raw file on the import sheet, as it asks; `folder` is where the files lie under short names.
pub fn asked(window: &mut Window) {
    open(window, Path::new("tracker.txt"));
}

/// The sheet filled in, at the residuals of the alignment.
pub fn filled_in(window: &mut Window) {
    type_into(window, "Name of the session", "inspection column");
    press(window, "It is mm");
    press(window, "The columns are right");
    press(window, "from this file");
    type_into(window, "File of the robot", "robot.json");
    type_into(window, "File of the commands", "commands.csv");
    press(window, "by name");
    type_into(window, "File of the known points", "base-points.csv");
    type_into(window, "File of the reflectors", "reflectors.csv");
    window
        .get_by_label_contains("What the import brings")
        .scroll_to_me();
    window.run_steps(8);
}

/// The arm's raw file on the import sheet, filled in.
pub fn arm_asked(window: &mut Window) {
    open(window, Path::new("tracker.csv"));
    type_into(window, "Name of the session", "cell arm");
    for answer in ["The columns are right", "from this file"] {
        if there(window, answer) {
            press(window, answer);
        }
    }
    type_into(window, "File of the robot", "robot.json");
    type_into(window, "File of the commands", "commands.csv");
    press(window, "by name");
}

pub fn imported(window: &mut Window) {
    asked(window);
    filled_in(window);
    press(window, "Import");
}

pub fn identified(window: &mut Window) {
    // Without the step Regions it is the second.
    let step = ["3 Identify", "2 Identify"].into_iter();
    let mut step = step.filter(|step| there(window, step));
    press(window, step.next().unwrap_or("3 Identify"));
    if there(window, "Full model") {
        press(window, "Full model");
    }
    if there(window, "Identify") {
        press(window, "Identify");
    }
}

pub fn searched(window: &mut Window) {
    let step = ["4 Diagnose", "3 Diagnose"].into_iter();
    let mut step = step.filter(|step| there(window, step));
    press(window, step.next().unwrap_or("4 Diagnose"));
    press(window, "Run diagnosis");
}

/// Everything that was found, in the model.
pub fn added(window: &mut Window) {
    let all = window.get_by_label_contains("Add all ");
    all.scroll_to_me();
    window.run_steps(6);
    window.get_by_label_contains("Add all ").click();
    window.run_steps(8);
}
