//! A disk that is full, that may only be read, or on which something else stands already: whatever
//! is written, the old file stays whole and the message says what to do.

use crate::window;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::window::{Window, come_back, copy_of, keys, press, says, seconds, there, window_at};
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;

const SHIFTED: Modifiers = Modifiers::COMMAND.plus(Modifiers::SHIFT);

/// Something that can be written, and how its path is typed.
struct Output {
    name: &'static str,
    file: &'static str,
    typing: fn(&mut Window, &Path),
}

fn typed_save(window: &mut Window, path: &Path) {
    keys(window, SHIFTED, Key::P);
    let typed = path.to_str().expect("a path in UTF-8");
    window.get_by_label("Path to save to").focus();
    window.run_steps(2);
    window.key_press_modifiers(Modifiers::COMMAND, Key::A);
    window.run_steps(1);
    window.get_by_label("Path to save to").type_text(typed);
    window.run_steps(2);
}

const OUTPUTS: [Output; 7] = [
    Output {
        name: "session",
        file: "session.json",
        typing: typed_save,
    },
    Output {
        name: "table",
        file: "table.csv",
        typing: |w, path| w.state_mut().type_path("table", path),
    },
    Output {
        name: "poses",
        file: "poses.csv",
        typing: |w, path| w.state_mut().type_path("poses", path),
    },
    Output {
        name: "report",
        file: "report.html",
        typing: |w, path| w.state_mut().type_path("report", path),
    },
    Output {
        name: "report as PDF",
        file: "report.pdf",
        typing: |w, path| w.state_mut().type_path("report", path),
    },
    Output {
        name: "model report",
        file: "model.html",
        typing: |w, path| w.state_mut().type_path("report of the model", path),
    },
    Output {
        name: "picture of the chart",
        file: "deviation.svg",
        typing: |w, path| w.state_mut().type_path("deviation", path),
    },
];

/// A window in which everything can be written: identified and searched.
fn ready(home: Option<&Path>) -> Window {
    let mut window = window_at(None, home);
    press(&mut window, "3 Identify");
    press(&mut window, "Identify");
    press(&mut window, "4 Diagnose");
    keys(&mut window, Modifiers::COMMAND, Key::G);
    window
}

/// Writes to a path, and may replace what is there.
fn write(window: &mut Window, output: &Output, path: &Path, replace: bool) {
    if there(window, "Dismiss") {
        press(window, "Dismiss");
    }
    (output.typing)(window, path);
    window.run_steps(4);
    if replace {
        press(window, "replace the file if it exists");
    }
    press(window, "Save");
    window.run_steps(4);
}

/// What the message says, where one is shown.
fn refused(window: &Window) -> bool {
    says(window, "was not written")
}

fn no_unfinished_file(folder: &Path) {
    for entry in fs::read_dir(folder).expect("it can be listed").flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        assert!(!name.starts_with(".truepose-"), "{name} is left behind");
    }
}

#[test]
fn paths_with_spaces_and_letters_of_any_language_are_written_and_read() {
    let folder = tempfile::tempdir().expect("a folder");
    let deep = folder.path().join("Größe 2 µm — Ось Ω").join("ein Ordner");
    fs::create_dir_all(&deep).expect("made");
    let mut window = ready(None);
    for output in &OUTPUTS {
        let path = deep.join(format!("mein {}", output.file));
        write(&mut window, output, &path, false);
        assert!(path.exists(), "{}: {:?}", output.name, path);
    }
    let session = deep.join("mein session.json");
    window::open(&mut window, &session);
    if there(&window, "Go on without saving") {
        press(&mut window, "Go on without saving");
    }
    assert!(says(&window, "mein session.json"));
}

#[test]
fn a_file_that_is_there_is_replaced_only_where_that_was_said() {
    let folder = tempfile::tempdir().expect("a folder");
    let mut window = ready(None);
    for output in &OUTPUTS {
        let path = folder.path().join(output.file);
        fs::write(&path, "old").expect("written");
        write(&mut window, output, &path, false);
        assert!(refused(&window), "{}", output.name);
        assert!(says(&window, "exists already"), "{}", output.name);
        assert!(says(&window, "choose another name"), "{}", output.name);
        assert_eq!(fs::read_to_string(&path).expect("there"), "old");
        write(&mut window, output, &path, true);
        assert_ne!(fs::read(&path).expect("there"), b"old", "{}", output.name);
    }
}

#[test]
fn a_path_that_cannot_be_one_says_what_to_do_and_changes_nothing() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("a file");
    fs::write(&file, "old").expect("written");
    let mut window = ready(None);
    for output in &OUTPUTS {
        let ending = Path::new(output.file).extension().expect("an ending");
        let taken = folder
            .path()
            .join(format!("folder {}", output.name))
            .with_extension(ending);
        fs::create_dir(&taken).expect("made");
        let cases: [(&str, PathBuf, &[&str]); 3] = [
            ("a folder", taken.clone(), &["choose another name"]),
            (
                "no such folder",
                folder.path().join("missing").join(output.file),
                &["folder not found: choose another, or create it first"],
            ),
            (
                "below a file",
                file.join(output.file),
                &["choose another", "save to another folder"],
            ),
        ];
        for (what, path, parts) in cases {
            write(&mut window, output, &path, true);
            assert!(refused(&window), "{}: {what}", output.name);
            let told = parts.iter().any(|part| says(&window, part));
            assert!(told, "{}: {what}: it does not say what to do", output.name);
            assert!(says(&window, "What was there before is there still"));
        }
        assert!(taken.is_dir());
        assert_eq!(fs::read_to_string(&file).expect("there"), "old");
    }
    no_unfinished_file(folder.path());
}

/// A file system of this size, where this user may mount one; unmounted when it goes.
struct Small(tempfile::TempDir);

impl Small {
    fn new(options: &str) -> Option<Self> {
        let folder = tempfile::tempdir().expect("a folder");
        let mounted = Command::new("mount")
            .args(["-t", "tmpfs", "-o", options, "tmpfs"])
            .arg(folder.path())
            .output();
        if mounted.is_ok_and(|output| output.status.success()) {
            return Some(Self(folder));
        }
        eprintln!("skipped: this user may not mount a small file system");
        None
    }

    fn path(&self) -> &Path {
        self.0.path()
    }

    fn remount(&self, options: &str) -> bool {
        let remounted = Command::new("mount")
            .args(["-o", options])
            .arg(self.path())
            .status();
        remounted.is_ok_and(|status| status.success())
    }

    /// Nothing more fits on it.
    fn fill(&self) {
        let mut size = 1 << 16;
        let mut k = 0;
        while size > 0 {
            let path = self.path().join(format!("filling {k}"));
            k += 1;
            if fs::write(&path, vec![0_u8; size]).is_err() {
                size /= 2;
            }
        }
    }
}

impl Drop for Small {
    fn drop(&mut self) {
        let _ = Command::new("umount").arg(self.path()).status();
    }
}

#[test]
fn a_full_disk_keeps_the_old_file_and_says_what_to_do() {
    let Some(small) = Small::new("size=512k") else {
        return;
    };
    let mut window = ready(None);
    for output in &OUTPUTS {
        fs::write(small.path().join(output.file), "old").expect("it fits");
    }
    small.fill();
    for output in &OUTPUTS {
        let path = small.path().join(output.file);
        write(&mut window, output, &path, true);
        assert!(refused(&window), "{}", output.name);
        assert!(
            says(
                &window,
                "the disk is full: make room on it, or save to another disk"
            ),
            "{}",
            output.name
        );
        assert_eq!(
            fs::read_to_string(&path).expect("there"),
            "old",
            "{}",
            output.name
        );
    }
    no_unfinished_file(small.path());
}

#[test]
fn a_disk_that_may_only_be_read_keeps_everything_and_says_what_to_do() {
    let Some(small) = Small::new("size=2m") else {
        return;
    };
    let mut window = ready(None);
    for output in &OUTPUTS {
        fs::write(small.path().join(output.file), "old").expect("it fits");
    }
    if !small.remount("remount,ro") {
        eprintln!("skipped: the file system cannot be made read-only");
        return;
    }
    for output in &OUTPUTS {
        let path = small.path().join(output.file);
        write(&mut window, output, &path, true);
        assert!(refused(&window), "{}", output.name);
        let advice = "the disk can only be read: save to another disk";
        assert!(says(&window, advice), "{}", output.name);
        assert_eq!(
            fs::read_to_string(&path).expect("there"),
            "old",
            "{}",
            output.name
        );
    }
}

#[test]
#[cfg(unix)]
fn a_folder_without_permission_says_so() {
    use std::os::unix::fs::PermissionsExt;
    let folder = tempfile::tempdir().expect("a folder");
    let closed = folder.path().join("closed");
    fs::create_dir(&closed).expect("made");
    fs::set_permissions(&closed, fs::Permissions::from_mode(0o500)).expect("set");
    if fs::write(closed.join("try"), "").is_ok() {
        eprintln!("skipped: this user may write wherever he wants");
        return;
    }
    let mut window = ready(None);
    for output in &OUTPUTS {
        write(&mut window, output, &closed.join(output.file), true);
        assert!(refused(&window), "{}", output.name);
        assert!(says(
            &window,
            "no permission to write there: save to another folder"
        ));
    }
}

#[test]
fn what_is_kept_for_tomorrow_says_where_it_cannot_be_kept_and_the_work_goes_on() {
    // The data folder would have to be below a file: nothing can be kept there.
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("a file");
    fs::write(&file, "old").expect("written");
    let home = file.join("home");
    let mut window = window_at(None, Some(&home));
    assert!(says(
        &window,
        "What is not saved cannot be kept against a crash"
    ));
    press(&mut window, "Dismiss");
    prefer(&mut window, "µm");
    assert!(says(&window, "Not everything could be saved for recovery"));
    assert!(says(&window, "save it under a name of your own"));
    press(&mut window, "Dismiss");
    press(&mut window, "2 Regions");
    press(&mut window, "Uniform");
    seconds(&mut window, 5);
    let path = folder.path().join("kept.json");
    write(&mut window, &OUTPUTS[0], &path, false);
    assert!(path.exists());
    assert_eq!(fs::read_to_string(&file).expect("there"), "old");
}

/// Chooses another unit of lengths.
fn prefer(window: &mut Window, unit: &str) {
    keys(window, Modifiers::COMMAND, Key::Comma);
    press(window, unit);
    press(window, "Done");
}

#[test]
fn recovery_and_preferences_on_a_full_disk_keep_what_they_had() {
    let Some(small) = Small::new("size=512k") else {
        return;
    };
    let home = small.path().join("home");
    let mut window = window_at(None, Some(&home));
    prefer(&mut window, "inch");
    let settings = home.join("settings.json");
    let before = fs::read(&settings).expect("the preferences are kept");
    press(&mut window, "2 Regions");
    press(&mut window, "region 2: Edit");
    window.get_by_label_contains("Split in half").click();
    seconds(&mut window, 4);
    let kept = recovery_file(&home).expect("what is not saved is kept");
    let kept_before = fs::read(&kept).expect("it can be read");
    small.fill();
    prefer(&mut window, "µm");
    assert!(says(&window, "Not everything could be saved for recovery"));
    press(&mut window, "Dismiss");
    press(&mut window, "3 Identify");
    press(&mut window, "Full model");
    press(&mut window, "2 Regions");
    press(&mut window, "region 1: Edit");
    window.get_by_label_contains("Split in half").click();
    seconds(&mut window, 4);
    assert!(says(&window, "Not everything could be saved for recovery"));
    assert_eq!(fs::read(&settings).expect("there"), before, "preferences");
    assert_eq!(fs::read(&kept).expect("there"), kept_before, "recovery");
    assert!(says(&window, "208 samples"), "and the work goes on");
}

fn recovery_file(home: &Path) -> Option<PathBuf> {
    let entries = fs::read_dir(home.join("recovery")).ok()?;
    let mut paths = entries.flatten().map(|entry| entry.path());
    paths.find(|path| path.extension().is_some_and(|e| e == "recovery"))
}

#[test]
fn a_file_that_vanished_before_it_is_saved_is_written_again() {
    let folder = tempfile::tempdir().expect("a folder");
    let session = copy_of("paper-30", folder.path());
    let mut window = window_at(Some(session.clone()), None);
    press(&mut window, "2 Regions");
    press(&mut window, "Uniform");
    press(&mut window, "region 2: Edit");
    window.get_by_label_contains("Split in half").click();
    window.run_steps(4);
    fs::remove_file(&session).expect("removed");
    fs::remove_file(session.with_extension("csv")).expect("removed");
    come_back(&mut window);
    assert!(says(&window, ": file not found"), "it is said");
    keys(&mut window, Modifiers::COMMAND, Key::S);
    assert!(session.exists(), "the session is in its file again");
    assert!(session.with_extension("csv").exists());
}

#[test]
fn a_folder_that_vanished_says_so_and_the_session_stays_unsaved() {
    let folder = tempfile::tempdir().expect("a folder");
    let inner = folder.path().join("stick");
    fs::create_dir(&inner).expect("made");
    let session = copy_of("paper-30", &inner);
    let mut window = window_at(Some(session), None);
    press(&mut window, "2 Regions");
    press(&mut window, "Uniform");
    press(&mut window, "region 2: Edit");
    window.get_by_label_contains("Split in half").click();
    window.run_steps(4);
    fs::remove_dir_all(&inner).expect("removed");
    keys(&mut window, Modifiers::COMMAND, Key::S);
    assert!(says(&window, "was not written"));
    assert!(says(
        &window,
        "folder not found: choose another, or create it first"
    ));
    // Saved elsewhere, nothing is lost.
    let elsewhere = folder.path().join("elsewhere.json");
    write(&mut window, &OUTPUTS[0], &elsewhere, false);
    assert!(elsewhere.exists());
}
