//! `truepose diagnose` of many sessions in one call: a line each, whatever is wrong with one of them.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::fs;
use std::io::{BufRead, BufReader, Read};
use std::path::{Path, PathBuf};
use std::process::{Output, Stdio};

use serde_json::{Value, json};

fn sessions() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("sessions")
}

fn truepose(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = crate::program::truepose();
    command.args(arguments).current_dir(folder);
    command.output().expect("the program starts")
}

fn diagnose(folder: &Path, arguments: &[&str]) -> Output {
    truepose(folder, &[&["diagnose"], arguments].concat())
}

/// Two sound sessions, a damaged one, an empty file and a document of another kind among them.
fn fleet() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    for file in ["paper-30.json", "paper-30.csv"] {
        fs::copy(sessions().join(file), at(file)).unwrap();
    }
    let lamp = fs::read(sessions().join("lamp-commissioning.scenario.json")).unwrap();
    let mut lamp: Value = serde_json::from_slice(&lamp).unwrap();
    lamp["poses"]["sweep"]["step_deg"] = 12.into();
    lamp["poses"]["sweep"]["repeats"] = 1.into();
    lamp["conditions"] = json!({ "seconds_per_pose": 6 });
    lamp["effects"] =
        json!([{ "effect": "backlash", "joint": 1, "parameters": { "width_deg": 0.05 } }]);
    fs::write(at("play.scenario.json"), lamp.to_string()).unwrap();
    let made = ["simulate", "play.scenario.json", "--out", "play.json"];
    assert!(truepose(folder.path(), &made).status.success());
    let sound = fs::read_to_string(at("paper-30.json")).unwrap();
    let damaged = sound.replacen("\"joints\"", "\"jonts\"", 1);
    fs::write(at("damaged.json"), damaged).unwrap();
    fs::write(at("empty.json"), "").unwrap();
    folder
}

const ARGUMENTS: [&str; 6] = [
    "play.json",
    "empty.json",
    "damaged.json",
    "paper-30.json",
    "missing.json",
    "--json-lines",
];

#[test]
fn the_table_names_effects_with_the_joints_that_were_hidden() {
    let said = diagnose(&sessions(), &["arm"]);
    assert!(said.status.success());
    let table = String::from_utf8(said.stdout).unwrap();
    assert!(
        table.contains("backlash 2, encoder-eccentricity 3"),
        "{table}"
    );
}

#[test]
fn a_line_for_each_session_in_the_order_given_and_a_bad_file_stops_nothing() {
    let folder = fleet();
    let ran = diagnose(folder.path(), &ARGUMENTS);
    assert_eq!(ran.status.code(), Some(1), "some could not be diagnosed");
    let text = String::from_utf8(ran.stdout.clone()).unwrap();
    let lines: Vec<Value> = text
        .lines()
        .map(|line| serde_json::from_str(line).unwrap())
        .collect();
    let files: Vec<&str> = lines.iter().map(|l| l["file"].as_str().unwrap()).collect();
    assert_eq!(files, ARGUMENTS[..5]);
    for (k, says) in [(1, "empty.json"), (2, "damaged.json"), (4, "missing.json")] {
        let error = lines[k]["error"].as_str().unwrap();
        assert!(error.contains(says), "{error}");
        assert_eq!(lines[k].as_object().unwrap().len(), 2);
    }
    assert!(lines[2]["error"].as_str().unwrap().contains("jonts"));
    let last = String::from_utf8(ran.stderr.clone()).unwrap();
    assert!(last.ends_with("truepose: 3 of 5 sessions could not be diagnosed\n"));
    // The same document as of one session alone, behind its file.
    for k in [0, 3] {
        let alone = diagnose(folder.path(), &[files[k], "--json"]);
        let mut alone: Value = serde_json::from_slice(&alone.stdout).unwrap();
        alone["file"] = files[k].into();
        assert_eq!(lines[k], alone);
        assert!(text.lines().nth(k).unwrap().starts_with("{\"file\":"));
    }
    // And the same bytes on any number of threads.
    for jobs in ["1", "4"] {
        let again = diagnose(folder.path(), &[&ARGUMENTS[..], &["--jobs", jobs]].concat());
        assert_eq!(again.stdout, ran.stdout, "{jobs} at a time");
    }
}

#[test]
fn a_folder_stands_for_its_sessions_and_a_table_compares_the_machines() {
    let folder = fleet();
    let ran = diagnose(folder.path(), &["."]);
    assert_eq!(ran.status.code(), Some(1));
    let text = String::from_utf8(ran.stdout).unwrap();
    let cells = |file: &str| -> Vec<String> {
        let line = text.lines().find(|line| line.starts_with(file)).unwrap();
        let cells = line.split("  ").map(str::trim);
        let cells = cells.filter(|cell| !cell.is_empty());
        cells.map(str::to_owned).collect()
    };
    let here = |file: &str| Path::new(".").join(file).display().to_string();
    assert_eq!(cells(&here("damaged.json"))[1..], ["not diagnosed"]);
    let play = cells(&here("play.json"));
    assert_eq!(play[1..4], ["rotating column", "explained", "backlash"]);
    let alone = diagnose(folder.path(), &["play.json", "--json"]);
    let alone: Value = serde_json::from_slice(&alone.stdout).unwrap();
    let of = |object: &str, key: &str| format!("{:.4}", alone[object][key].as_f64().unwrap());
    let errors = [
        of("gap", "start_mm"),
        of("gap", "end_mm"),
        of("floor", "mm"),
    ];
    assert_eq!(play[4..], errors);
    assert!(!text.contains(".scenario.json"), "no session:\n{text}");
    assert!(text.contains("2 sessions of 1 machine: "), "{text}");
    assert!(text.contains("\nfound: backlash 1\n"), "{text}");
}

#[test]
fn where_nothing_can_be_diagnosed_the_input_is_wrong() {
    let folder = fleet();
    let ran = diagnose(
        folder.path(),
        &["empty.json", "damaged.json", "--json-lines"],
    );
    assert_eq!(ran.status.code(), Some(2));
    assert_eq!(String::from_utf8(ran.stdout).unwrap().lines().count(), 2);
    let nothing = tempfile::tempdir().unwrap();
    let ran = diagnose(nothing.path(), &["."]);
    assert_eq!(ran.status.code(), Some(2));
    let message = String::from_utf8(ran.stderr).unwrap();
    assert!(message.contains("no session; expected"), "{message}");
    for option in ["--json", "--out=m.json"] {
        let ran = diagnose(folder.path(), &["paper-30.json", "empty.json", option]);
        assert_eq!(ran.status.code(), Some(2));
        let message = String::from_utf8(ran.stderr).unwrap();
        assert!(message.contains("is for one session"), "{message}");
    }
    assert!(!folder.path().join("m.json").exists());
}

#[test]
fn a_reader_that_has_had_enough_ends_the_work_without_a_word() {
    let folder = fleet();
    let mut files = vec!["diagnose", "--json-lines"];
    files.extend(["paper-30.json"; 300]);
    let mut running = crate::program::truepose()
        .args(&files)
        .current_dir(folder.path())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut first = String::new();
    let mut reader = BufReader::new(running.stdout.take().unwrap());
    reader.read_line(&mut first).unwrap();
    drop(reader);
    let mut said = String::new();
    let mut stderr = running.stderr.take().unwrap();
    stderr.read_to_string(&mut said).unwrap();
    assert_eq!(running.wait().unwrap().code(), Some(0), "{said}");
    // Each session says one thing: that its noise is not stated.
    let begun = said.lines().filter(|l| l.contains("sigma_mm")).count();
    assert_eq!(begun, said.lines().count(), "{said}");
    assert!(
        begun < 100,
        "{begun} sessions after nothing was read any more"
    );
    assert!(first.starts_with("{\"file\":\"paper-30.json\""));
}
