//! Sentences of `SECURITY.md` that no other file holds: what the source opens at all, and what a file has at
//! most.

#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::fs::{self, File};
use std::path::Path;

use serde_json::{Value, json};

use crate::house::{self, code};
use crate::limits::{Ran, folder, identified, of_description, session, truepose};

/// Files of all crates, without tests, that say one of these words.
fn files_that_say(words: &[&str]) -> Vec<String> {
    let says = |text: &str| words.iter().any(|word| text.contains(word));
    let mut files: Vec<String> = code()
        .into_iter()
        .filter(|line| says(&line.text))
        .map(|line| line.path)
        .collect();
    files.sort();
    files.dedup();
    files
}

#[test]
fn other_programs_are_started_by_the_window_alone_to_open_what_was_saved() {
    let starts = files_that_say(&[
        "process::Command",
        "process::{Command",
        "Command::new(\"",
        "libc::",
        "extern \"C\"",
    ]);
    assert_eq!(starts, ["gui/files/system.rs"]);
}

#[test]
fn unsafe_code_stands_where_vectors_are_and_nowhere_else() {
    let unsafe_code = files_that_say(&["unsafe {", "unsafe fn", "unsafe impl"]);
    assert_eq!(unsafe_code, ["wide.rs"]);
}

#[test]
fn the_recorder_alone_opens_a_connection() {
    let words = [
        "std::net",
        "TcpStream",
        "TcpListener",
        "UdpSocket",
        "UnixStream",
    ];
    let opens = files_that_say(&words);
    assert_eq!(opens, ["recorder/source.rs"]);
}

fn refused(ran: &Ran, says: &str) {
    assert_eq!(ran.code, Some(2), "{says}: {}", ran.stderr);
    assert!(ran.stderr.contains(says), "{says}: {}", ran.stderr);
    assert!(ran.cpu_s < 5.0, "{says}: {} s", ran.cpu_s);
}

#[test]
fn a_description_has_at_most_64_mib_and_half_a_million_attributes() {
    let folder = folder();
    // Nothing of it is on the disk.
    let long = File::create(folder.path().join("long.xml")).unwrap();
    long.set_len((64 << 20) + 1).unwrap();
    let says = "a robot description of at most 64 MiB";
    for kind in ["urdf", "mjcf"] {
        let robot = json!({ "name": "r", kind: { "file": "long.xml", "base": "a", "tip": "b" } });
        let ran = identified(folder.path(), &|document| document["robot"] = robot.clone());
        refused(&ran, says);
    }
    let many = (0..900)
        .map(|k| format!("a{k}='' "))
        .collect::<Vec<_>>()
        .concat();
    let all = format!("<link {many}/>").repeat(560);
    let text = format!("<robot name='r'>{all}</robot>");
    refused(
        &of_description(folder.path(), "urdf", &text, "l1"),
        "500000 attributes",
    );
}

#[test]
fn what_an_mjcf_includes_counts_with_it() {
    let folder = folder();
    let includes = (0..70)
        .map(|k| format!("<include file='i{k}.xml'/>"))
        .collect::<Vec<_>>()
        .concat();
    for k in 0..70 {
        fs::write(folder.path().join(format!("i{k}.xml")), "<mujocoinclude/>").unwrap();
    }
    let text = format!("<mujoco>{includes}<worldbody/></mujoco>");
    refused(
        &of_description(folder.path(), "mjcf", &text, "l1"),
        "at most 64",
    );
    // Two of 40 MiB each are more than one file may have.
    for k in 0..2 {
        let blanks = " ".repeat(40 << 20);
        let text = format!("<mujocoinclude>{blanks}</mujocoinclude>");
        fs::write(folder.path().join(format!("i{k}.xml")), text).unwrap();
    }
    let text = "<mujoco><include file='i0.xml'/><include file='i1.xml'/><worldbody/></mujoco>";
    refused(
        &of_description(folder.path(), "mjcf", text, "l1"),
        "at most 64 MiB in all",
    );
}

#[test]
fn what_a_fit_has_parameters_for_is_counted() {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/observations");
    let folder = tempfile::tempdir().unwrap();
    for (name, field, most) in [
        ("six-distance", "anchors", 600),
        ("six-touch", "planes", 600),
        ("six-socket", "sockets", 600),
        ("six-bearing", "stations", 300),
        ("six-bearing", "targets", 600),
    ] {
        let csv = format!("{name}.csv");
        fs::copy(data.join(&csv), folder.path().join(&csv)).unwrap();
        let text = fs::read(data.join(format!("{name}.json"))).unwrap();
        let mut document: Value = serde_json::from_slice(&text).unwrap();
        let own = document[field].as_object_mut().unwrap();
        let one = own.values().next().unwrap().clone();
        for k in own.len()..=most {
            own.insert(format!("more {k}"), one.clone());
        }
        fs::write(folder.path().join("s.json"), document.to_string()).unwrap();
        let ran = truepose(folder.path(), &["identify", "s.json"]);
        refused(
            &ran,
            &format!(
                "{field}: {}; expected at most {most} in one session",
                most + 1
            ),
        );
    }
}

#[test]
fn a_table_has_at_most_ten_thousand_columns() {
    let folder = folder();
    let with = |more: usize| {
        let headings = (0..more)
            .map(|k| format!(",c{k}"))
            .collect::<Vec<_>>()
            .concat();
        let cells = ",1".repeat(more);
        let row = |k: i32| format!("{k},250,{k},300{cells}\n");
        let rows: String = (0..12).map(row).collect();
        let text = format!("q1_deg,x_mm,y_mm,z_mm{headings}\n{rows}");
        fs::write(folder.path().join("w.csv"), text).unwrap();
        identified(folder.path(), &|document| {
            document["samples"]["file"] = "w.csv".into();
        })
    };
    assert_eq!(with(9_996).code, Some(0));
    refused(&with(9_997), "10001 columns");
}

#[test]
fn numbers_of_instruments_and_scenarios_are_held_to_the_same_range() {
    let folder = folder();
    let robot = session()["robot"].to_string();
    fs::write(folder.path().join("robot.json"), robot).unwrap();
    for (name, kind, number) in [
        ("a.csv", "csv", "1e160"),
        ("b.csv", "csv", "1e8"),
        ("c.csv", "csv", "-1e300"),
    ] {
        let text =
            format!("q1_deg,x_mm,y_mm,z_mm\n0,250,0,300\n10,{number},43,300\n20,235,85,300\n");
        fs::write(folder.path().join(name), text).unwrap();
        let arguments = [
            "import",
            name,
            "--as",
            kind,
            "--robot",
            "robot.json",
            "--out",
            "o.json",
        ];
        let ran = truepose(folder.path(), &arguments);
        refused(&ran, "line 3");
    }
    let mut scenario = json!({
        "format": "truepose-scenario/1", "name": "s", "robot": session()["robot"],
        "poses": { "sweep": { "joint": 1, "from_deg": -80, "to_deg": 80, "step_deg": 10 } }, "seed": 1
    });
    scenario["robot"]["tool"]["position_mm"][0] = json!(1e160);
    fs::write(folder.path().join("s.scenario"), scenario.to_string()).unwrap();
    let ran = truepose(
        folder.path(),
        &["simulate", "s.scenario", "--out", "s.json"],
    );
    refused(&ran, "position_mm");
}

/// Names of tests between backquotes, as `file::test` or `src: module::tests::test`; one that ends in `…` is the
/// beginning of the name.
fn named_tests(page: &str) -> Vec<String> {
    let quoted = page.split('`').skip(1).step_by(2);
    let is_name = |c: char| c.is_ascii_alphanumeric() || "_:… ".contains(c);
    let examples = ["file::test", "src: module::test"];
    quoted
        .filter(|name| name.contains("::") && name.chars().all(is_name))
        .filter(|name| !examples.contains(name) && !name.starts_with(char::is_uppercase))
        .map(str::to_owned)
        .collect()
}

#[test]
fn every_test_that_the_pages_name_is_there() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut functions = Vec::new();
    let mut folders = house::sources();
    folders.push(root.join("tests"));
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|end| end == "rs") {
                let text = fs::read_to_string(&path).unwrap();
                let heads = text.lines().filter_map(|line| {
                    let name = line.trim_start().strip_prefix("fn ")?;
                    Some(name.split(['(', '<']).next()?.to_owned())
                });
                functions.extend(heads.map(|name| (path.clone(), name)));
            }
        }
    }
    let mut missing = Vec::new();
    for page in ["SECURITY.md"] {
        let names = named_tests(&fs::read_to_string(root.join(page)).unwrap());
        assert!(names.len() > 20, "{page}: {} names", names.len());
        for name in names {
            let path = name.trim_start_matches("src: ");
            let (module, test) = path.rsplit_once("::").unwrap();
            // `…::test` is of the module that stands before it.
            let own = module.trim_end_matches("::tests").trim_end_matches('…');
            let own = own.rsplit("::").next().unwrap_or_default();
            let begins = test.strip_suffix('…');
            let is_there = functions.iter().any(|(file, function)| {
                let here = file.iter().any(|part| {
                    let part = part.to_string_lossy();
                    own.is_empty() || part.trim_end_matches(".rs") == own
                });
                let same = begins.map_or(function == test, |begins| function.starts_with(begins));
                here && (same || test == "tests")
            });
            if !is_there {
                missing.push(format!("{page}: {name}"));
            }
        }
    }
    assert!(missing.is_empty(), "{}", missing.join("\n"));
}
