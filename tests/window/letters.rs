//! Letters that the bundled fonts lack, in the window: a face that has them is found in the background
//! and every family falls back on it; what no face has is said once, with what to do.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Duration;

use crate::tiny_font::Tiny;
use crate::window::{Window, bundled, copy_of, open, press, says, there, type_into};
use egui::FontFamily;
use egui_kittest::Harness;
use truepose::fonts::{Library, Purpose};
use truepose::gui::{App, Runner};

const TITLE: &str = "深圳 3 号线";
const PATH: &str = "Path of a session or model";

/// A window in which a missing letter is a box, not the end of the test.
fn window(path: Option<PathBuf>, runner: Runner, library: Arc<Library>) -> Window {
    let mut window = Harness::builder()
        .with_size([1280.0, 800.0])
        .allow_missing_glyphs()
        .build_eframe(|cc| App::new(&cc.egui_ctx, path, runner).reading(library));
    window.run_steps(4);
    window
}

fn made_of(fonts: &[Tiny]) -> Arc<Library> {
    Arc::new(Library::of(fonts.iter().map(Tiny::file)))
}

/// A bundled session under another title.
fn titled(title: &str, folder: &Path) -> PathBuf {
    let path = copy_of("paper-30", folder);
    let text = std::fs::read_to_string(&path).expect("it was copied");
    let text = text.replacen("paper, 30 samples", title, 1);
    std::fs::write(&path, text).expect("the folder can be written to");
    path
}

/// Whether every family of the window has all of these; asks for none of them.
fn shown(window: &Window, letters: &str) -> bool {
    let families = [
        FontFamily::Proportional,
        FontFamily::Monospace,
        FontFamily::Name("strong".into()),
    ];
    window.ctx.fonts_mut(|fonts| {
        families.into_iter().all(|family| {
            let has = fonts.characters(&family);
            let mut letters = letters.chars().filter(|c| *c != ' ');
            letters.all(|c| has.contains_key(&c))
        })
    })
}

#[test]
fn a_title_in_chinese_is_drawn_with_a_font_that_is_found() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = titled(TITLE, folder.path());
    let library = made_of(&[Tiny::new("SimHei", "深圳号线")]);
    let window = window(Some(path), Runner::AtOnce, library);
    assert!(says(&window, TITLE));
    assert!(shown(&window, TITLE));
    assert!(!says(&window, "no font here"), "nothing is missing");
}

#[test]
fn what_is_typed_counts_and_nothing_else_is_looked_for() {
    let mut window = window(None, Runner::AtOnce, made_of(&[Tiny::new("A", "机器")]));
    assert!(!shown(&window, "机") && !shown(&window, "器"));
    assert!(!says(&window, "no font here"));
    type_into(&mut window, PATH, "/机器/人.json");
    assert!(shown(&window, "机器"), "it was typed");
    assert!(says(&window, "no font here has 人 (U+4EBA)"));
}

#[test]
fn what_no_font_has_is_said_once() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = titled(TITLE, folder.path());
    let thai = made_of(&[Tiny::new("A", "ก")]);
    let mut window = window(Some(path.clone()), Runner::AtOnce, thai);
    assert!(says(&window, "install one, such as Noto Sans CJK"));
    press(&mut window, "Understood");
    assert!(!says(&window, "no font here") && !there(&window, "Understood"));
    // Another font comes, and egui asks for everything again.
    type_into(&mut window, PATH, "/ก.json");
    assert!(shown(&window, "ก"));
    assert!(!says(&window, "no font here"), "it was said");
    open(&mut window, &bundled("paper-30.json"));
    open(&mut window, &path);
    assert!(says(&window, TITLE), "it is open");
    assert!(!says(&window, "no font here"), "it was said");
}

#[test]
fn the_window_goes_on_while_the_fonts_of_this_machine_are_read() {
    let library = Library::system();
    let letters = "深圳号线";
    let folder = tempfile::tempdir().expect("a folder");
    let path = titled(TITLE, folder.path());
    let mut window = window(Some(path), Runner::Threads, Arc::clone(&library));
    // The session itself is read on a thread as well.
    let done = |window: &Window| shown(window, letters) || says(window, "no font here");
    for _ in 0..10_000 {
        if done(&window) {
            break;
        }
        std::thread::sleep(Duration::from_millis(5));
        window.run_steps(1);
    }
    let found = library.covering(&letters.chars().collect(), Purpose::Screen);
    if found.unshown.is_empty() {
        assert!(shown(&window, letters), "{found:?}");
        assert!(!says(&window, "no font here"));
    } else {
        eprintln!("half of this was skipped: no font with Chinese characters is installed here");
        assert!(says(&window, "no font here"));
    }
}
