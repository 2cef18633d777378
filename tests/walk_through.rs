//! The walk through a calibration (`docs/walk-through.md`): its files are what its scenario makes,
//! and every command in it prints what stands there.

#[path = "../examples/walk_through_files/files.rs"]
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

/// The blocks of a document that show a terminal.
fn blocks(text: &str) -> Vec<Vec<String>> {
    let mut blocks = Vec::new();
    let mut lines = text.lines();
    while let Some(line) = lines.next() {
        if line.starts_with("```") {
            let block = lines.by_ref().take_while(|line| !line.starts_with("```"));
            let block: Vec<String> = block.map(str::to_owned).collect();
            if block
                .first()
                .is_some_and(|line| line.starts_with("$ truepose"))
            {
                blocks.push(block);
            }
        }
    }
    blocks
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
    let mut lines = said.lines().map(plain);
    for line in expected {
        let parts: Vec<String> = line.split('…').map(plain).collect();
        let parts: Vec<String> = parts.into_iter().filter(|part| !part.is_empty()).collect();
        let found = parts.is_empty() || lines.any(|said| has(&said, &parts));
        assert!(found, "$ {command}\nnothing says: {line}\n{said}");
    }
}

#[test]
fn every_command_prints_what_stands_in_the_document() {
    let folder = tempfile::tempdir().expect("a folder");
    for entry in fs::read_dir(raw()).expect("the files are there") {
        let path = entry.expect("an entry").path();
        let name = path.file_name().expect("a name");
        fs::copy(&path, folder.path().join(name)).expect("copied");
    }
    // Measured in a hurry: one reflector, no load.
    let hurry = |name: &str, from: &str, keep: fn(&str) -> bool| {
        let text = fs::read_to_string(raw().join(from)).expect("the file is there");
        let lines = text.lines().enumerate();
        let kept = lines.filter(|(k, line)| *k == 0 || keep(line));
        let kept: Vec<&str> = kept.map(|(_, line)| line).collect();
        fs::write(folder.path().join(name), kept.join("\n") + "\n").expect("written");
    };
    hurry("hurry-commands.csv", "commands.csv", |line| {
        line.contains(",T1,0,")
    });
    hurry("one-reflector.csv", "reflectors.csv", |line| {
        line.starts_with("T1")
    });

    let text = fs::read_to_string(root().join("docs/walk-through.md")).expect("the document");
    let blocks = blocks(&text);
    assert!(blocks.len() >= 9, "{} blocks", blocks.len());
    for block in blocks {
        let commands: Vec<usize> = (0..block.len())
            .filter(|&k| block[k].starts_with("$ "))
            .collect();
        for (k, &at) in commands.iter().enumerate() {
            let end = commands.get(k + 1).copied().unwrap_or(block.len());
            run(folder.path(), &block[at][2..], &block[at + 1..end]);
        }
    }
    for name in [
        "column.json",
        "column.model.json",
        "column.comp",
        "next.csv",
    ] {
        assert!(folder.path().join(name).exists(), "{name} was written");
    }
    let report = fs::read(folder.path().join("column.pdf")).expect("the report was written");
    assert!(report.starts_with(b"%PDF-"));
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
