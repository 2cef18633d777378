//! What a hostile file can and cannot do: every sentence of `SECURITY.md` that is not held by
//! `bad_files` (paths, links, devices), `robots` (includes), `recordings` (packed chunks), `report`
//! (markup) or `fuzz_smoke` (panics) is held here. The program runs with 2 GiB of memory.

#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::{Value, json};

/// Runs the program in a folder with an address space of 2 GiB.
fn truepose(folder: &Path, arguments: &[&str]) -> Output {
    let mut command = crate::program::english(Command::new("sh"));
    command.args(["-c", "ulimit -v 2097152; exec \"$@\"", "sh"]);
    command.arg(env!("CARGO_BIN_EXE_truepose")).args(arguments);
    command.current_dir(folder).output().unwrap()
}

/// What the program says of a file that it refuses.
fn refusal(folder: &Path, file: &str) -> String {
    let ran = truepose(folder, &["identify", file]);
    let message = String::from_utf8(ran.stderr).unwrap();
    assert_eq!(ran.status.code(), Some(2), "{message}");
    assert!(ran.stdout.is_empty());
    message
}

fn session() -> Value {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("sessions/paper-30.json");
    serde_json::from_slice(&fs::read(path).unwrap()).unwrap()
}

/// A folder with a sound session's samples, in which documents are written.
fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let samples = Path::new(env!("CARGO_MANIFEST_DIR")).join("sessions/paper-30.csv");
    fs::copy(samples, folder.path().join("paper-30.csv")).unwrap();
    folder
}

#[test]
fn nesting_does_not_use_up_the_stack() {
    let folder = folder();
    let inner = format!("{}1{}", "[".repeat(500_000), "]".repeat(500_000));
    let mut sound = session().to_string();
    sound.insert_str(1, &format!("\"x\":{inner},"));
    for text in ["[".repeat(2_000_000), "{\"a\":".repeat(1_000_000), sound] {
        fs::write(folder.path().join("deep.json"), text).unwrap();
        let says = refusal(folder.path(), "deep.json");
        assert!(says.contains("more than 64 levels of nesting"), "{says}");
    }
    let urdf = |deep: usize| {
        format!("<robot name=\"r\">{}", "<a>".repeat(deep)) + &"</a>".repeat(deep) + "</robot>"
    };
    let mjcf = |deep: usize| {
        format!("<mujoco><worldbody>{}", "<body>".repeat(deep))
            + &"</body>".repeat(deep)
            + "</worldbody></mujoco>"
    };
    for (deep, says) in [(20_000, "for the base"), (200_000, "nodes limit")] {
        for (kind, text) in [("urdf", urdf(deep)), ("mjcf", mjcf(deep))] {
            fs::write(folder.path().join("deep.xml"), text).unwrap();
            let said = refusal_of_robot(folder.path(), kind, "deep.xml");
            assert!(said.contains(says), "{said}");
        }
    }
}

fn refusal_of_robot(folder: &Path, kind: &str, file: &str) -> String {
    let mut document = session();
    document["robot"] = json!({ "name": "r", kind: { "file": file, "base": "a", "tip": "b" } });
    fs::write(folder.join("robot.json"), document.to_string()).unwrap();
    refusal(folder, "robot.json")
}

#[test]
fn entities_of_xml_neither_grow_nor_bring_other_files() {
    let folder = folder();
    let secret = folder.path().join("secret");
    fs::write(&secret, "TOP-SECRET").unwrap();
    let mut entities = "<!ENTITY a0 \"aaaaaaaaaa\">".to_owned();
    for k in 1..14 {
        let ten = format!("&a{};", k - 1).repeat(10);
        entities += &format!("<!ENTITY a{k} \"{ten}\">");
    }
    let outside = format!("<!ENTITY a13 SYSTEM \"file://{}\">", secret.display());
    for declared in [entities, outside] {
        let text = format!(
            "<!DOCTYPE r [{declared}]><robot name=\"&a13;\"><link name=\"&a13;\"/></robot>"
        );
        fs::write(folder.path().join("r.urdf"), text).unwrap();
        let says = refusal_of_robot(folder.path(), "urdf", "r.urdf");
        assert!(
            says.contains("r.urdf, line 1") && says.contains("well-formed XML"),
            "{says}"
        );
        assert!(!says.contains("TOP-SECRET"));
    }
    // A description may stand anywhere, but what is no description is not shown.
    let says = refusal_of_robot(folder.path(), "urdf", secret.to_str().unwrap());
    assert!(!says.contains("TOP-SECRET"), "{says}");
    assert!(refusal_of_robot(folder.path(), "urdf", "/dev/zero").contains("not a regular file"));
}

#[test]
fn as_many_warnings_as_regions_not_as_pairs_of_them() {
    let folder = folder();
    let mut document = session();
    let region = json!({ "name": "r", "from_deg": -90, "to_deg": 90 });
    document["regions"] = vec![region; 20_000].into();
    fs::write(folder.path().join("regions.json"), document.to_string()).unwrap();
    let ran = truepose(folder.path(), &["identify", "regions.json"]);
    assert_eq!(ran.status.code(), Some(0));
    let said = String::from_utf8(ran.stderr).unwrap();
    assert!(
        said.contains("regions 'r'") && said.contains("overlap"),
        "{}",
        &said[..300]
    );
    assert!(said.lines().count() < 50_000, "{}", said.lines().count());
}

#[test]
fn sizes_that_no_machine_has_are_refused_before_anything_is_made_of_them() {
    let folder = folder();
    let mut document = session();
    let joint = document["robot"]["joints"][0].clone();
    document["robot"]["joints"] = vec![joint; 5000].into();
    fs::write(folder.path().join("joints.json"), document.to_string()).unwrap();
    let says = refusal(folder.path(), "joints.json");
    assert!(
        says.contains("5000 joints; expected at most 100 joints"),
        "{says}"
    );

    let scenario =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("sessions/lamp-commissioning.scenario.json");
    let mut scenario: Value = serde_json::from_slice(&fs::read(scenario).unwrap()).unwrap();
    scenario["poses"]["sweep"]["step_deg"] = 1e-9.into();
    fs::write(folder.path().join("many.json"), scenario.to_string()).unwrap();
    let ran = truepose(
        folder.path(),
        &["simulate", "many.json", "--out", "out.json"],
    );
    let says = String::from_utf8(ran.stderr).unwrap();
    assert!(
        says.contains("expected between 1 and 20 000 000 samples"),
        "{says}"
    );
    assert_eq!(ran.status.code(), Some(2));
}

#[test]
fn a_name_in_a_file_does_not_command_the_terminal() {
    let folder = folder();
    let mut document = session();
    let name = "\u{1b}]0;owned\u{7}\u{1b}[2J\u{9b}31m";
    document["name"] = name.into();
    document["robot"]["name"] = name.into();
    document[name] = 1.into();
    fs::write(folder.path().join("name.json"), document.to_string()).unwrap();
    fs::write(folder.path().join("bad.json"), format!("{{\"{name}\": 1}}")).unwrap();
    for arguments in [
        &["identify", "name.json"][..],
        &["diagnose", "name.json"],
        &["history", "."],
        &["standards", "name.json"],
    ] {
        let ran = truepose(folder.path(), arguments);
        let said = String::from_utf8([ran.stdout, ran.stderr].concat()).unwrap();
        assert!(said.contains("owned"), "{arguments:?}: {said}");
        let commands = said.chars().filter(|c| c.is_control() && *c != '\n');
        assert_eq!(commands.count(), 0, "{arguments:?}: {said:?}");
    }
    // For programs the name is as it is in the file.
    let ran = truepose(folder.path(), &["identify", "name.json", "--json"]);
    let answer: Value = serde_json::from_slice(&ran.stdout).unwrap();
    assert_eq!(answer["session"], name);
}

#[test]
fn no_name_in_a_file_decides_where_something_is_written() {
    let outer = tempfile::tempdir().unwrap();
    let inner = outer.path().join("inner");
    fs::create_dir(&inner).unwrap();
    let samples = Path::new(env!("CARGO_MANIFEST_DIR")).join("sessions/paper-30.csv");
    fs::copy(samples, inner.join("paper-30.csv")).unwrap();
    let mut document = session();
    document["name"] = "../up".into();
    document["robot"]["name"] = "/tmp/../up".into();
    document["robot"]["joints"][0]["name"] = "../up".into();
    fs::write(inner.join("s.json"), document.to_string()).unwrap();
    for arguments in [
        &["identify", "s.json", "--out", "m.json"][..],
        &["export", "m.json", "--to", "linuxcnc", "--out", "t.comp"],
        &["export", "m.json", "--to", "urdf", "--out", "r.urdf"],
        &["report", "m.json", "--out", "r.html"],
    ] {
        let ran = truepose(&inner, arguments);
        let said = String::from_utf8_lossy(&ran.stderr).into_owned();
        assert_eq!(ran.status.code(), Some(0), "{arguments:?}: {said}");
    }
    let names = |folder: &Path| {
        let entries = fs::read_dir(folder).unwrap();
        let mut names: Vec<String> = entries
            .map(|entry| entry.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    };
    assert_eq!(names(outer.path()), ["inner"]);
    let expected = [
        "m.json",
        "paper-30.csv",
        "r.html",
        "r.urdf",
        "r.urdf.meta.json",
        "s.json",
        "t.comp",
        "t.comp.meta.json",
    ];
    assert_eq!(names(&inner), expected);
}
