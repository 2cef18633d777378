//! What every command leaves where it cannot write: `SECURITY.md` is the table of what is tried
//! here, in the window (`tests/window/disk.rs`) and with a process that is killed (`sessions_on_disk`).

#![cfg(target_os = "linux")]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

/// Every command that writes: its arguments, and the name of its output, which follows them.
const WRITING: [(&[&str], &str); 9] = [
    (&["simulate", "lamp.scenario.json", "--out"], "made.json"),
    (
        &[
            "import",
            "sa.txt",
            "--as=tracker",
            "--unit=in",
            "--reference=reference.txt",
            "--commands=commands-by-name.csv",
            "--match=name",
            "--robot=robot.json",
            "--out",
        ],
        "imported.json",
    ),
    (&["identify", "s.json", "--out"], "identified.json"),
    (&["diagnose", "s.json", "--out"], "diagnosed.json"),
    (&["plan", "s.json", "--poses=4", "--out"], "poses.csv"),
    (
        &["compensate", "m.json", "targets.csv", "--out"],
        "targets.out.csv",
    ),
    (&["export", "m.json", "--to=csv", "--out"], "table.csv"),
    (&["report", "m.json", "--out"], "report.html"),
    (&["report", "m.json", "--out"], "report.pdf"),
];

fn truepose(folder: &Path) -> Command {
    let mut command = crate::program::truepose();
    command.current_dir(folder);
    command
}

/// A folder with what the commands read.
fn inputs() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let copy = |from: &str, to: &str| fs::copy(root.join(from), folder.path().join(to)).unwrap();
    copy(
        "sessions/lamp-commissioning.scenario.json",
        "lamp.scenario.json",
    );
    copy("sessions/paper-30.json", "s.json");
    copy("sessions/paper-30.csv", "paper-30.csv");
    for name in [
        "sa.txt",
        "reference.txt",
        "commands-by-name.csv",
        "robot.json",
    ] {
        copy(&format!("tests/data/imports/{name}"), name);
    }
    fs::write(folder.path().join("targets.csv"), "q1_deg\n10\n20\n").unwrap();
    let made = truepose(folder.path())
        .args(["identify", "s.json", "--out", "m.json"])
        .output()
        .unwrap();
    assert!(made.status.success());
    folder
}

/// Every command fails to write into a folder, says so with the file's name, and leaves what was there.
fn nothing_is_written_to(out: &Path, old: Option<&str>, fault: &str) {
    let inputs = inputs();
    for (arguments, name) in WRITING {
        let path = out.join(name);
        let mut command = truepose(inputs.path());
        let ran = command.args(arguments).arg(&path).arg("--force").output();
        let ran = ran.unwrap();
        let said = String::from_utf8_lossy(&ran.stderr).into_owned();
        assert_eq!(ran.status.code(), Some(1), "{fault}: {name}: {said}");
        let stem = path.with_extension("");
        let named = said.contains(stem.to_str().unwrap());
        assert!(named, "{fault}: {name}: {said}");
        assert!(!said.contains("panicked"), "{said}");
        match old {
            Some(old) => assert_eq!(fs::read_to_string(&path).unwrap(), old, "{fault}: {name}"),
            None => assert!(!path.exists(), "{fault}: {name}"),
        }
    }
    if let Ok(entries) = fs::read_dir(out) {
        let unfinished = entries.flatten().map(|entry| entry.file_name());
        let mut unfinished = unfinished.filter(|n| n.to_string_lossy().starts_with(".truepose-"));
        assert_eq!(unfinished.next(), None, "{fault}");
    }
}

/// A small file system, where this user may mount one; unmounted when it goes.
struct Small(tempfile::TempDir);

impl Small {
    fn new() -> Option<Self> {
        let folder = tempfile::tempdir().unwrap();
        let mut mount = Command::new("mount");
        mount
            .args(["-t", "tmpfs", "-o", "size=256k", "tmpfs"])
            .arg(folder.path());
        if mount.output().is_ok_and(|output| output.status.success()) {
            return Some(Self(folder));
        }
        eprintln!("skipped: this user may not mount a small file system");
        None
    }

    fn path(&self) -> &Path {
        self.0.path()
    }

    /// Old outputs that must stay.
    fn old(&self) {
        for (_, name) in WRITING {
            fs::write(self.path().join(name), "old").unwrap();
        }
    }
}

impl Drop for Small {
    fn drop(&mut self) {
        let _ = Command::new("umount").arg(self.path()).status();
    }
}

#[test]
fn a_full_disk() {
    let Some(small) = Small::new() else { return };
    small.old();
    let mut size = 1 << 16;
    let filling = |k: usize| -> PathBuf { small.path().join(format!("filling {k}")) };
    let mut k = 0;
    while size > 0 {
        k += 1;
        if fs::write(filling(k), vec![0; size]).is_err() {
            size /= 2;
        }
    }
    nothing_is_written_to(small.path(), Some("old"), "a full disk");
}

#[test]
fn a_disk_that_may_only_be_read() {
    let Some(small) = Small::new() else { return };
    small.old();
    let mut mount = Command::new("mount");
    mount.args(["-o", "remount,ro"]).arg(small.path());
    if mount.output().is_ok_and(|output| output.status.success()) {
        nothing_is_written_to(small.path(), Some("old"), "read only");
    } else {
        eprintln!("skipped: the file system cannot be made read-only");
    }
}

#[test]
fn a_folder_that_is_not_there_and_a_file_in_its_place() {
    let folder = tempfile::tempdir().unwrap();
    nothing_is_written_to(&folder.path().join("missing"), None, "no folder");
    fs::write(folder.path().join("file"), "old").unwrap();
    nothing_is_written_to(&folder.path().join("file"), None, "a file in its place");
    assert_eq!(
        fs::read_to_string(folder.path().join("file")).unwrap(),
        "old"
    );
}

#[test]
fn standard_output_that_takes_nothing_is_a_failure_and_one_that_is_closed_is_none() {
    let inputs = inputs();
    let commands: [&[&str]; 6] = [
        &["identify", "s.json"],
        &["identify", "s.json", "--json"],
        &["identify", "s.json", "--out", "-"],
        &["diagnose", "s.json", "--json"],
        &["simulate", "lamp.scenario.json", "--out", "-"],
        &["man"],
    ];
    for arguments in commands {
        let full = fs::OpenOptions::new()
            .write(true)
            .open("/dev/full")
            .unwrap();
        let mut command = truepose(inputs.path());
        let ran = command.args(arguments).stdout(full).stderr(Stdio::piped());
        let ran = ran.output().unwrap();
        let said = String::from_utf8_lossy(&ran.stderr).into_owned();
        assert_eq!(ran.status.code(), Some(1), "{arguments:?}: {said}");
        assert!(said.contains("cannot write to standard output"), "{said}");
        let mut command = crate::program::english(Command::new("sh"));
        command.args([
            "-c",
            "exec \"$@\" >&-",
            "sh",
            env!("CARGO_BIN_EXE_truepose"),
        ]);
        let closed = command
            .args(arguments)
            .current_dir(inputs.path())
            .output()
            .unwrap();
        let said = String::from_utf8_lossy(&closed.stderr).into_owned();
        assert!(
            closed.status.success() && !said.contains("panicked"),
            "{arguments:?}: {said}"
        );
    }
}
