//! Reading and saving tell how far they are, and what was cancelled changes nothing.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use crate::atomic::WriteError;
use crate::progress::ReadError;
use crate::sessions::load;
use crate::sessions::{Replacing, load_watched, save_watched};
use crate::watching::{assert_grows, no_at, report_to};

const HEAD: &str = r#"{"format":"truepose-session/1","name":"s","robot":{"name":"r","joints":[{"name":"pan",
"kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0]}],"tool":{"position_mm":[250,0,300],"quaternion_wxyz":[1,0,0,0]}},"samples":"#;

/// Rows enough for several looks at the watcher.
const ROWS: usize = 40_000;

fn cell(row: usize, column: usize) -> String {
    format!("{}.{:05}", column * 100, row % 99_991)
}

fn sibling_of(folder: &Path) -> PathBuf {
    let mut csv = "q1_deg,x_mm,y_mm\n".to_owned();
    for row in 0..ROWS {
        let cells = [0, 1, 2].map(|column| cell(row, column));
        writeln!(csv, "{}", cells.join(",")).unwrap();
    }
    fs::write(folder.join("beside.csv"), csv).unwrap();
    let path = folder.join("beside.json");
    fs::write(&path, format!("{HEAD}{{\"file\":\"beside.csv\"}}}}")).unwrap();
    path
}

fn inline(folder: &Path) -> PathBuf {
    let columns = ["q1_deg", "x_mm", "y_mm"].into_iter().enumerate();
    let columns = columns.map(|(column, name)| {
        let cells: Vec<String> = (0..ROWS).map(|row| cell(row, column)).collect();
        format!("\"{name}\":[{}]", cells.join(","))
    });
    let columns: Vec<String> = columns.collect();
    let path = folder.join("inline.json");
    let document = format!("{HEAD}{{\"columns\":{{{}}}}}}}", columns.join(","));
    fs::write(&path, document).unwrap();
    path
}

/// Every file of a folder, with what is in it.
fn on_disk(folder: &Path) -> Vec<(PathBuf, Vec<u8>)> {
    let files = fs::read_dir(folder).unwrap();
    let mut files: Vec<(PathBuf, Vec<u8>)> = files
        .map(|file| {
            let path = file.unwrap().path();
            let bytes = fs::read(&path).unwrap();
            (path, bytes)
        })
        .collect();
    files.sort();
    files
}

#[test]
fn what_is_read_tells_how_far_it_is_and_can_be_cancelled_wherever_it_does() {
    let folder = tempfile::tempdir().unwrap();
    for path in [sibling_of(folder.path()), inline(folder.path())] {
        let (shares, loaded) = report_to(|watch| load_watched(&path, watch));
        let loaded = loaded.unwrap();
        assert_grows(&shares);
        assert!(shares.len() > 5, "{path:?}: {shares:?}");
        let steps = shares.windows(2).map(|s| s[1] - s[0]);
        assert!(steps.fold(0.0, f64::max) < 0.5, "{path:?}: {shares:?}");
        assert_eq!(loaded, load(&path).unwrap(), "it is what it is unwatched");
        for number in 0..shares.len() {
            let cut = load_watched(&path, no_at(number));
            assert!(matches!(cut, Err(ReadError::Cancelled(_))), "{number}");
        }
    }
}

#[test]
fn a_document_that_is_wrong_is_refused_as_if_nobody_watched() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("wrong.json");
    for text in [
        "",
        "{",
        "[1, 2",
        HEAD,
        "{\"format\":\"truepose-session/1\"}",
    ] {
        fs::write(&path, text).unwrap();
        let (shares, watched) = report_to(|watch| load_watched(&path, watch));
        let Err(ReadError::Rejected(watched)) = watched else {
            panic!("{text}: {watched:?}");
        };
        assert_eq!(watched.to_string(), load(&path).unwrap_err().to_string());
        assert!(!watched.diagnostics.is_empty(), "{text}");
        assert!(shares.is_sorted());
    }
}

#[test]
fn a_session_that_is_saved_tells_how_far_it_is_and_a_cancelled_one_leaves_the_disk_as_it_was() {
    let source = tempfile::tempdir().unwrap();
    let session = load(sibling_of(source.path())).unwrap().session;
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("saved.json");
    let replacing = Replacing {
        force: true,
        inputs: &[],
    };
    let save = |watch: &dyn Fn(f64) -> std::ops::ControlFlow<()>| {
        save_watched(&session, &path, replacing, watch)
    };
    let cancelled_everywhere = |shares: &[f64]| {
        let before = on_disk(folder.path());
        for number in 0..shares.len() {
            let cut = save(&no_at(number));
            assert!(matches!(cut, Err(WriteError::Cancelled(_))), "{number}");
            assert!(on_disk(folder.path()) == before, "cancelled at {number}");
        }
    };
    let elsewhere = tempfile::tempdir().unwrap();
    let there = elsewhere.path().join("saved.json");
    let (shares, saved) = report_to(|watch| save_watched(&session, &there, replacing, watch));
    saved.unwrap();
    assert_grows(&shares);
    assert!(shares.len() > 5, "{shares:?}");
    // Where nothing stands, and where something does.
    cancelled_everywhere(&shares);
    assert_eq!(on_disk(folder.path()), []);
    fs::write(&path, "another document").unwrap();
    fs::write(path.with_extension("csv"), "other samples").unwrap();
    cancelled_everywhere(&shares);
    save(&|_| std::ops::ControlFlow::Continue(())).unwrap();
    let written = |folder: &Path| on_disk(folder).into_iter().map(|(_, bytes)| bytes);
    assert!(written(folder.path()).eq(written(elsewhere.path())));
}
