//! The documents: every command in `README.md` and in the walk through a calibration
//! (`docs/walk-through.md`) prints what stands there, and the walk's files are what its scenario makes.

#[path = "../../examples/walk_through_files/files.rs"]
#[allow(unreachable_pub, reason = "an example uses the same module")]
mod files;

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn raw() -> PathBuf {
    root().join("sessions/walk-through")
}

#[test]
fn the_files_are_what_their_scenario_makes() {
    let made = files::from_scenario(&raw()).expect("the scenario can be read");
    let mut bytes = 0;
    for (name, text) in made.list {
        let kept = fs::read_to_string(raw().join(name)).expect("the file is there");
        let hint = "cargo run --no-default-features --example walk_through_files makes it again";
        assert!(kept == text, "{name} is another file: {hint}");
        bytes += text.len();
    }
    assert!(bytes < 60_000, "{bytes} bytes");
    let table = fs::read_to_string(root().join("docs/walk-through.md")).expect("the document");
    for entry in fs::read_dir(raw()).expect("the files are there") {
        let name = entry.expect("an entry").file_name();
        let name = name.to_string_lossy();
        assert!(table.contains(&format!("`{name}`")), "{name} is not told");
    }
}

/// Whether a line of the text has these parts, in their order. Runs of spaces are one.
fn has(line: &str, parts: &[String]) -> bool {
    let mut rest = line;
    parts.iter().all(|part| match rest.find(part.as_str()) {
        Some(at) => {
            rest = &rest[at + part.len()..];
            true
        }
        None => false,
    })
}

fn plain(line: &str) -> String {
    line.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// The words of a command line; quotes hold some together.
fn words(line: &str) -> Vec<String> {
    let mut words = Vec::new();
    for (k, part) in line.split('"').enumerate() {
        if k % 2 == 1 {
            words.push(part.to_owned());
        } else {
            words.extend(part.split_whitespace().map(str::to_owned));
        }
    }
    words
}

/// The blocks of a document that show a terminal: with what it prints, or with commands alone.
fn blocks(text: &str) -> Vec<Vec<String>> {
    let mut blocks = Vec::new();
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        if line.starts_with("```") {
            let block = lines.by_ref().take_while(|line| !line.starts_with("```"));
            let block: Vec<String> = block.map(str::to_owned).collect();
            if block.iter().any(|line| line.starts_with("$ truepose")) {
                blocks.push(block);
            } else if block.iter().any(|line| line.starts_with("truepose import")) {
                blocks.push(commands_alone(&block));
            }
        }
    }
    blocks
}

/// A block of commands without a prompt: remarks are left out, and a line that goes on is one.
fn commands_alone(block: &[String]) -> Vec<String> {
    let lines = block.iter().filter(|line| !line.starts_with('#'));
    let lines: Vec<&str> = lines.map(String::as_str).collect();
    let text = lines.join("\n").replace("\\\n", " ");
    text.lines().map(|line| format!("$ {line}")).collect()
}

/// Runs one command and compares what it prints with what the document says.
fn run(folder: &Path, command: &str, expected: &[String]) {
    let words = words(command);
    let ran = Command::new(env!("CARGO_BIN_EXE_truepose"))
        .args(&words[1..])
        .current_dir(folder)
        .output()
        .expect("the program runs");
    let said = [&ran.stderr[..], &ran.stdout[..]].concat();
    let said = String::from_utf8(said).expect("it prints UTF-8");
    let asks = expected.iter().any(|line| line.contains("expected --"));
    let status = if asks { 2 } else { 0 };
    assert_eq!(ran.status.code(), Some(status), "$ {command}\n{said}");
    let mut lines = said.lines().map(plain);
    for line in expected {
        let parts: Vec<String> = line.split('…').map(plain).collect();
        let parts: Vec<String> = parts.into_iter().filter(|part| !part.is_empty()).collect();
        let found = parts.is_empty() || lines.any(|said| has(&said, &parts));
        assert!(found, "$ {command}\nnothing says: {line}\n{said}");
    }
}

/// Runs every command of a document in a folder, in their order; how many there were.
fn play(document: &str, folder: &Path) -> usize {
    let text = fs::read_to_string(root().join(document)).expect("the document");
    let mut count = 0;
    for block in blocks(&text) {
        let commands: Vec<usize> = (0..block.len())
            .filter(|&k| block[k].starts_with("$ "))
            .collect();
        for (k, &at) in commands.iter().enumerate() {
            let end = commands.get(k + 1).copied().unwrap_or(block.len());
            run(folder, &block[at][2..], &block[at + 1..end]);
            count += 1;
        }
    }
    count
}

/// Copies the files of a folder, not what is in folders below it.
fn copy_files(from: &Path, to: &Path) {
    fs::create_dir_all(to).expect("a folder");
    for entry in fs::read_dir(from).expect("the files are there") {
        let path = entry.expect("an entry").path();
        if path.is_file() {
            fs::copy(&path, to.join(path.file_name().expect("a name"))).expect("copied");
        }
    }
}

fn check_written(folder: &Path, names: &[&str], report: &str) {
    for name in names {
        assert!(folder.join(name).exists(), "{name} was written");
    }
    let report = fs::read(folder.join(report)).expect("the report was written");
    assert!(report.starts_with(b"%PDF-"));
}

#[test]
fn every_command_of_the_walk_prints_what_stands_in_it() {
    let folder = tempfile::tempdir().expect("a folder");
    copy_files(&raw(), folder.path());
    let commands = play("docs/walk-through.md", folder.path());
    assert!(commands >= 11, "{commands} commands");
    let written = [
        "column.json",
        "column.model.json",
        "column.comp",
        "next.csv",
    ];
    check_written(folder.path(), &written, "column.pdf");
}

#[test]
fn every_command_of_the_readme_prints_what_stands_in_it() {
    let folder = tempfile::tempdir().expect("a folder");
    copy_files(&root().join("tests/data/imports"), folder.path());
    let sessions = folder.path().join("sessions");
    copy_files(&root().join("sessions"), &sessions);
    let arms = "tests/data/arms";
    copy_files(&root().join(arms), &folder.path().join(arms));
    let commands = play("README.md", folder.path());
    assert!(commands >= 12, "{commands} commands");
    let written = ["lamp.model.json", "lamp.csv", "a.json", "e.json"];
    check_written(folder.path(), &written, "lamp.pdf");
}

#[test]
fn every_picture_of_the_documents_is_there() {
    for document in ["README.md", "docs/walk-through.md"] {
        let path = root().join(document);
        let text = fs::read_to_string(&path).expect("the document");
        let folder = path.parent().expect("a folder");
        let pictures = text.split("](").skip(1);
        let pictures = pictures.filter_map(|rest| rest.split_once(')'));
        for (picture, _) in pictures.filter(|(name, _)| name.contains("pictures/")) {
            assert!(folder.join(picture).exists(), "{document}: {picture}");
        }
    }
}
