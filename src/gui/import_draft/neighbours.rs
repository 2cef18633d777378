//! What lies in the folder of a measured file and may belong to it.

use std::path::{Path, PathBuf};

use super::Beside;

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

    /// Those that may serve a purpose: by their ending, a table also by a word in its name.
    pub(crate) fn suiting(&self, which: Beside) -> impl Iterator<Item = &PathBuf> {
        let (endings, words): (_, &[&str]) = match which {
            Beside::Robot => (ROBOTS, &[""]),
            Beside::Commands => (TABLES, &["command", "pose", "joint", "sent", "program"]),
            Beside::Reference => (TABLES, &["reference", "base", "known", "datum", "fixed"]),
            Beside::Targets => (TABLES, &["target", "reflector", "smr", "marker"]),
        };
        let text = |part: Option<&std::ffi::OsStr>| {
            part.map_or_else(String::new, |p| p.to_string_lossy().to_lowercase())
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
    assert_eq!(names(Beside::Commands), ["commands.csv"]);
    assert_eq!(names(Beside::Robot), ["arm.urdf"]);
    assert!(names(Beside::Targets).is_empty());
}
