//! Files that are dropped on the window: one, several, a folder, what is no session.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use crate::window::{Window, bundled, copy_of, keys, press, says, status, there, window};
use egui::{Key, Modifiers};

#[derive(Debug)]
struct Dropped(PathBuf);

impl egui::DroppedFile for Dropped {
    fn path(&self) -> &Path {
        &self.0
    }

    fn bytes(&self) -> Result<Vec<u8>, String> {
        std::fs::read(&self.0).map_err(|error| error.to_string())
    }
}

fn drop_on(window: &mut Window, paths: &[&Path]) {
    for path in paths {
        let file = Arc::new(Dropped(path.to_path_buf()));
        window.input_mut().dropped_files.push(file);
    }
    window.step();
    window.run_steps(4);
}

/// The second example, which has other samples than the first.
const OTHER: &str = "paper-30";

#[test]
fn a_session_is_opened_alone_or_with_its_samples_and_of_any_name() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window(None);
    let before = status(&window);
    let other = folder.path().join("Größe – лампа.json");
    let copy = copy_of(OTHER, folder.path());
    let text = std::fs::read_to_string(&copy).expect("a copy");
    std::fs::write(&other, text).expect("written");
    drop_on(&mut window, &[&other]);
    assert!(says(&window, "Größe – лампа.json") || status(&window) != before);
    let opened = status(&window);
    assert_ne!(opened, before);
    keys(&mut window, Modifiers::NONE, Key::F2);
    assert_eq!(status(&window), before);
    drop_on(&mut window, &[&copy.with_extension("csv"), &copy]);
    assert_eq!(status(&window), opened, "its samples belong to it");
    assert!(!there(&window, "Dismiss"));
}

#[test]
fn of_several_files_none_is_opened_and_it_is_said() {
    let mut window = window(None);
    let before = status(&window);
    let walk = bundled("walk-through");
    let (points, commands) = (walk.join("tracker.txt"), walk.join("commands.csv"));
    drop_on(&mut window, &[&points, &commands]);
    assert!(says(&window, "Drop one file at a time"));
    assert_eq!(status(&window), before);
    assert!(!there(&window, "Import"));
    press(&mut window, "Dismiss");
    drop_on(&mut window, &[&points]);
    assert!(there(&window, "Import"), "alone it is looked at");
    // What was entered is not lost to a file that falls on the form.
    drop_on(&mut window, &[&commands]);
    assert!(says(&window, "Finish or cancel the form"));
    assert!(says(&window, "tracker.txt"));
}

/// In place of a program that is refused another one is dropped.
#[test]
fn a_program_is_dropped_in_place_of_another() {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/programs");
    let folder = tempfile::tempdir().expect("a folder");
    let refused = folder.path().join("targets.csv");
    std::fs::write(&refused, "name;q1_deg\nP0;a\n").expect("written");
    let mut window = window(Some(data.join("arm.json")));
    keys(&mut window, Modifiers::COMMAND, Key::I);
    window.state_mut().compensate(&refused);
    window.run_steps(4);
    assert!(there(&window, "Choose another file…"));
    drop_on(&mut window, &[&data.join("cell.mod")]);
    assert!(says(&window, "Compensate cell.mod"));
    assert!(there(&window, "Save corrected file…"));
}

#[test]
fn a_folder_is_no_file_and_says_so() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = window(None);
    drop_on(&mut window, &[folder.path()]);
    assert!(says(&window, "could not be opened; nothing was changed"));
}

#[test]
fn what_is_no_session_is_refused_with_what_to_do() {
    let folder = tempfile::tempdir().expect("a folder");
    let at = |name: &str| folder.path().join(name);
    std::fs::write(at("photo.jpg"), [0xff, 0xd8, 0xff, 0xe0, 0, 16]).expect("written");
    std::fs::write(at("empty.csv"), "").expect("written");
    let huge = std::fs::File::create(at("huge.csv")).expect("a file");
    huge.set_len(3 << 30).expect("a sparse file");
    let mut window = window(None);
    let before = status(&window);
    for name in ["photo.jpg", "empty.csv", "huge.csv", "gone.json"] {
        drop_on(&mut window, &[&at(name)]);
        assert!(says(&window, name), "{name} is named");
        assert!(
            says(&window, "nothing was changed") || says(&window, "cannot be read"),
            "{name}: it is said"
        );
        assert_eq!(status(&window), before, "{name}");
        keys(&mut window, Modifiers::NONE, Key::Escape);
        if there(&window, "Dismiss") {
            press(&mut window, "Dismiss");
        }
    }
}
