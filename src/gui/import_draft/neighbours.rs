//! What lies in the folder of a measured file and may belong to it.

use std::ffi::OsStr;
use std::path::{Path, PathBuf};

use super::{Companion, RobotFrom};

/// Endings of files with tables.
pub(crate) const TABLES: &[&str] = &["csv", "txt", "tsv", "dat", "asc"];
/// Endings of files with a robot.
pub(crate) const ROBOTS: &[&str] = &["json", "urdf", "xml"];

/// A folder with more files than this is no folder of one measurement.
const MOST: usize = 400;
/// So many are offered for one purpose.
const OFFERED: usize = 3;

/// Files beside a measured one, in the order of their names.
#[derive(Debug, Default)]
pub(crate) struct Neighbours(Vec<PathBuf>);

impl Neighbours {
    /// Of this file.
    pub(crate) fn of(path: &Path) -> Self {
        let folder = path.parent().filter(|f| !f.as_os_str().is_empty());
        let Ok(entries) = std::fs::read_dir(folder.unwrap_or(Path::new("."))) else {
            return Self::default();
        };
        let paths = entries.take(MOST).flatten().map(|entry| entry.path());
        let is_other = |other: &PathBuf| other.file_name() != path.file_name() && other.is_file();
        let mut all: Vec<PathBuf> = paths.filter(is_other).collect();
        all.sort();
        Self(all)
    }

    /// Those whose name is that of the measured file with a word behind it (`run-commands.csv` of
    /// `run.csv`), a robot's also with its ending alone (`run.json`): one for each purpose at most.
    pub(crate) fn named_alike(&self, measured: &Path) -> Vec<(Companion, PathBuf)> {
        let own = text(measured.file_stem());
        let taken = |which: Companion| {
            let (endings, words) = known_by(which);
            let alike = |path: &&PathBuf| {
                let name = text(path.file_stem());
                let Some(more) = name.strip_prefix(&own) else {
                    return false;
                };
                let word = more.strip_prefix(['-', '_', ' ', '.']);
                let named = word.is_some_and(|word| words.iter().any(|w| word.starts_with(w)));
                let bare = which == Companion::Robot && more.is_empty();
                endings.contains(&&*text(path.extension())) && (named || bare)
            };
            let reads = |path: &&PathBuf| {
                let robot = || RobotFrom::Open.of_file(path.display().to_string()).robot();
                which != Companion::Robot || robot().is_some_and(|robot| robot.is_ok())
            };
            let mut all = self.0.iter().filter(alike).filter(reads);
            let one = all.next()?;
            // Of two nothing says which.
            all.next().is_none().then(|| (which, one.clone()))
        };
        Companion::ALL.into_iter().filter_map(taken).collect()
    }

    /// Those that may serve a purpose: by their ending, a table also by a word in its name.
    pub(crate) fn suiting(&self, which: Companion) -> impl Iterator<Item = &PathBuf> {
        let (endings, words) = known_by(which);
        // A robot may have any name.
        let words = if which == Companion::Robot {
            &[""]
        } else {
            words
        };
        let suits = move |path: &&PathBuf| {
            let (ending, name) = (text(path.extension()), text(path.file_stem()));
            endings.contains(&&*ending)
                && Path::new(&name).extension().is_none_or(|e| e != "meta")
                && words.iter().any(|word| name.contains(word))
        };
        self.0.iter().filter(suits).take(OFFERED)
    }
}

/// Endings of a file that serves a purpose, and words in its name.
fn known_by(which: Companion) -> (&'static [&'static str], &'static [&'static str]) {
    match which {
        Companion::Robot => (ROBOTS, &["robot", "arm", "machine"]),
        Companion::Commands => (TABLES, &["command", "pose", "joint", "sent", "program"]),
        Companion::Reference => (TABLES, &["reference", "base", "known", "datum", "fixed"]),
        Companion::Targets => (TABLES, &["target", "reflector", "smr", "marker"]),
    }
}

/// A part of a name in small letters.
fn text(part: Option<&OsStr>) -> String {
    part.map_or_else(String::new, |p| p.to_string_lossy().to_lowercase())
}

#[cfg(test)]
#[test]
fn a_file_belongs_to_another_by_its_name() {
    let folder = tempfile::tempdir().expect("a folder");
    let robot = br#"{"format": "truepose-session/1", "name": "x", "robot": {"name": "lamp",
        "joints": [{"name": "pan", "kind": "revolute", "axis": [0, 0, 1], "point_mm": [0, 0, 0]}],
        "tool": {"position_mm": [250, 0, 300], "quaternion_wxyz": [1, 0, 0, 0]}},
        "samples": {"columns": {"q1_deg": [0, 1, 2], "x_mm": [250, 250, 250], "y_mm": [0, 4.4, 8.7]}}}"#;
    for (name, text) in [
        ("run.csv", b"".as_slice()),
        ("Run-commands.csv", b"".as_slice()),
        ("run_targets.csv", b"".as_slice()),
        ("run_targets.txt", b"".as_slice()),
        ("running-reference.csv", b"".as_slice()),
        ("run.json", b"{}".as_slice()),
        ("run-robot.json", robot.as_slice()),
    ] {
        std::fs::write(folder.path().join(name), text).expect("written");
    }
    let measured = folder.path().join("run.csv");
    let taken = Neighbours::of(&measured).named_alike(&measured);
    let names = ["run-robot.json", "Run-commands.csv"].map(|name| folder.path().join(name));
    let [robot, commands] = names;
    // Two tables of targets are one too many, and what is no robot is none.
    assert_eq!(
        taken,
        [(Companion::Robot, robot), (Companion::Commands, commands)]
    );
}

#[cfg(test)]
#[test]
fn files_are_offered_by_their_ending_and_tables_by_their_name() {
    let folder = tempfile::tempdir().expect("a folder");
    for name in [
        "run.csv",
        "commands.csv",
        "arm.urdf",
        "notes.txt",
        "run.csv.meta.json",
    ] {
        std::fs::write(folder.path().join(name), "").expect("written");
    }
    let all = Neighbours::of(&folder.path().join("run.csv"));
    let names = |which| {
        let names = all.suiting(which).filter_map(|p| p.file_name());
        names
            .map(|n| n.to_string_lossy().into_owned())
            .collect::<Vec<_>>()
    };
    assert_eq!(names(Companion::Commands), ["commands.csv"]);
    assert_eq!(names(Companion::Robot), ["arm.urdf"]);
    assert!(names(Companion::Targets).is_empty());
}
