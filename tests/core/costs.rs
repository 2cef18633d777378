//! What long inputs cost, further rows of the table of `SECURITY.md` (see `limits`): programs in every
//! language, arms of many samples, sockets that are seen again and again; and what fuzzing of whole commands
//! found.

#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::fs;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use crate::limits::{Ran, folder, grows_linearly, session, truepose};

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/data")
        .join(name)
}

fn text_of(name: &str) -> String {
    String::from_utf8_lossy(&fs::read(data(name)).unwrap()).into_owned()
}

/// A program whose moves are those of one of the test data so many times, each time with names of their own.
fn repeated(name: &str, count: usize) -> String {
    let text = text_of(&format!("programs/{name}"));
    let lines = || text.lines().map(str::trim);
    let times = |each: &dyn Fn(usize) -> String| (0..count).map(each).collect::<String>();
    match name {
        "cell.mod" => {
            let targets: Vec<(&str, &str, &str)> = lines()
                .filter_map(|line| line.strip_prefix("CONST "))
                .filter_map(|line| {
                    let (kind, rest) = line.split_once(' ')?;
                    let (name, value) = rest.split_once(":=")?;
                    Some((kind, name, value))
                })
                .collect();
            let declared = |k: usize| {
                let one = |(kind, name, value): &(&str, &str, &str)| {
                    format!("  CONST {kind} {name}_{k}:={value}\n")
                };
                targets.iter().map(one).collect::<String>()
            };
            let moved = |k: usize| {
                let one = |(kind, name, _): &(&str, &str, &str)| match *kind {
                    "robtarget" => format!("    MoveJ {name}_{k}, v500, fine, tGun;\n"),
                    _ => format!("    MoveAbsJ {name}_{k}\\NoEOffs, v500, fine, tGun;\n"),
                };
                targets.iter().map(one).collect::<String>()
            };
            let (declared, moved) = (times(&declared), times(&moved));
            format!("MODULE Cell\n{declared}  PROC main()\n{moved}  ENDPROC\nENDMODULE\n")
        }
        "cell.src" => {
            let moved = |k: usize| {
                let one = |line: &str| match (line.split_once("={"), line.strip_prefix("PTP XP")) {
                    (Some((name, rest)), None) => format!("{name}_{k}={{{rest}\n"),
                    (None, Some(number)) => format!("PTP XP{number}_{k}\n"),
                    _ => format!("{line}\n"),
                };
                let own =
                    lines().filter(|line| line.starts_with("XP") || line.starts_with("PTP XP"));
                let inline = lines().filter(|line| line.starts_with("PTP {E6"));
                own.chain(inline).map(one).collect::<String>()
            };
            format!("DEF cell( )\n{}END\n", times(&moved))
        }
        "cell.ls" => {
            let (head, rest) = text.split_once("/MN\n").unwrap();
            let positions = rest.split_once("/POS\n").unwrap().1;
            let positions: Vec<&str> = positions.split_inclusive("};\n").collect();
            // What stands behind its number in `P[3]{` or `P[2:"home"]{`.
            let own: Vec<&str> = positions
                .iter()
                .filter_map(|text| text.split_once(']').map(|(_, rest)| rest))
                .collect();
            let number = |k: usize, n: usize| own.len() * k + n + 1;
            let moved = |k: usize| {
                let one = |n| format!("   {0}:J P[{0}] 100% FINE    ;\n", number(k, n));
                (0..own.len()).map(one).collect::<String>()
            };
            let placed = |k: usize| {
                let one = |(n, rest): (usize, &&str)| format!("P[{}]{rest}", number(k, n));
                own.iter().enumerate().map(one).collect::<String>()
            };
            let (moved, placed) = (times(&moved), times(&placed));
            format!("{head}/MN\n{moved}/POS\n{placed}/END\n")
        }
        _ => {
            let moved = |_| {
                let starts = ["movel(p[", "movej([", "movej(get"];
                let own = lines().filter(|line| starts.iter().any(|start| line.starts_with(start)));
                own.flat_map(|line| ["  ", line, "\n"]).collect::<String>()
            };
            // A pose is told from the others that reach it by where the arm was before.
            let first = lines().find(|line| line.starts_with("movej([")).unwrap();
            format!("def cell():\n  {first}\n{}end\n", times(&moved))
        }
    }
}

#[test]
fn programs_of_every_language_cost_in_proportion() {
    let folder = tempfile::tempdir().unwrap();
    for name in ["arm.json", "arm.csv"] {
        fs::copy(data("programs").join(name), folder.path().join(name)).unwrap();
    }
    let made = truepose(folder.path(), &["identify", "arm.json", "--out", "m.json"]);
    assert_eq!(made.code, Some(0), "{}", made.stderr);
    for (name, kind) in [
        ("cell.mod", "rapid"),
        ("cell.src", "krl"),
        ("cell.script", "urscript"),
        ("cell.ls", "fanuc-ls"),
    ] {
        let run = |count: usize| {
            let text = repeated(name, count);
            let moves = ["Move", "PTP", "move", ":J P["].map(|word| text.matches(word).count());
            assert!(moves.iter().sum::<usize>() >= 12 * count, "{moves:?}");
            fs::write(folder.path().join(name), text).unwrap();
            let out = format!("out.{name}");
            truepose(
                folder.path(),
                &[
                    "compensate",
                    "m.json",
                    name,
                    "--as",
                    kind,
                    "--as-modelled",
                    "--out",
                    &out,
                    "--force",
                ],
            )
        };
        grows_linearly(name, 0, &run, 150);
    }
}

#[test]
fn samples_of_an_arm_cost_in_proportion() {
    let folder = tempfile::tempdir().unwrap();
    let arm: Value = serde_json::from_str(&text_of("arms/six-60.json")).unwrap();
    let limits: Vec<[f64; 2]> = arm["robot"]["joints"]
        .as_array()
        .unwrap()
        .iter()
        .map(|joint| serde_json::from_value(joint["limits"].clone()).unwrap())
        .collect();
    let simulated = |count: usize| {
        // Fractions of irrational steps fill the ranges evenly.
        let pose = |k: usize| {
            let q = limits.iter().enumerate().map(|(joint, [low, high])| {
                let at = (k as f64 * (2.0 + joint as f64).sqrt()).fract();
                (1000.0 * (low + (0.05 + 0.9 * at) * (high - low))).round() / 1000.0
            });
            json!({ "q_deg": q.collect::<Vec<f64>>(), "dir": [1, -1, 1, -1, 1, -1] })
        };
        let scenario = json!({
            "format": "truepose-scenario/1", "name": "arm", "robot": arm["robot"],
            "poses": { "list": (0..count).map(pose).collect::<Vec<_>>() },
            "effects": [{ "effect": "joint-zero-offset", "joint": 2, "parameters": { "offset_deg": 0.1 } }],
            "noise": { "sigma_mm": 0.03, "kind": "gauss" }, "seed": 1
        });
        fs::write(folder.path().join("a.scenario"), scenario.to_string()).unwrap();
        let out = format!("a{count}.json");
        let made = truepose(folder.path(), &["simulate", "a.scenario", "--out", &out]);
        assert_eq!(made.code, Some(0), "{}", made.stderr);
    };
    let samples = 40_000;
    simulated(samples);
    simulated(2 * samples);
    for command in ["identify", "diagnose"] {
        let run = |count: usize| {
            truepose(
                folder.path(),
                &[command, &format!("a{count}.json"), "--json"],
            )
        };
        grows_linearly(command, 0, &run, samples);
    }
}

/// Plans for touched sockets, of which one was seen so many times more.
fn plan_of_one_socket(folder: &Path, more: usize) -> Ran {
    let text = text_of("observations/six-socket-length.csv");
    let rows: Vec<&str> = text.lines().collect();
    let again = vec![rows[120]; more];
    let all = [&rows[..120], &again[..], &rows[120..]].concat();
    fs::write(folder.join("k.csv"), all.join("\n") + "\n").unwrap();
    let mut document: Value =
        serde_json::from_str(&text_of("observations/six-socket-length.json")).unwrap();
    document["samples"] = json!({ "file": "k.csv" });
    fs::write(folder.join("k.json"), document.to_string()).unwrap();
    truepose(folder, &["plan", "k.json", "--poses", "5"])
}

#[test]
fn a_socket_that_is_seen_again_and_again_costs_in_proportion() {
    let folder = tempfile::tempdir().unwrap();
    let ran = plan_of_one_socket(folder.path(), 300);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    assert!(ran.cpu_s < 20.0, "{} s", ran.cpu_s);
    grows_linearly(
        "rows of one socket",
        0,
        &|more| plan_of_one_socket(folder.path(), more),
        3000,
    );
}

#[test]
fn a_description_with_a_target_kilometres_away_is_read_back() {
    let folder = folder();
    fs::write(folder.path().join("p.json"), session().to_string()).unwrap();
    let made = truepose(folder.path(), &["identify", "p.json", "--out", "m.json"]);
    assert_eq!(made.code, Some(0), "{}", made.stderr);
    let model = fs::read(folder.path().join("m.json")).unwrap();
    let mut model: Value = serde_json::from_slice(&model).unwrap();
    for target in model["targets"].as_object_mut().unwrap().values_mut() {
        target[1] = json!(9.99e6);
    }
    fs::write(folder.path().join("far.json"), model.to_string()).unwrap();
    for (kind, out) in [("mjcf", "o.xml"), ("urdf", "o.urdf")] {
        let ran = truepose(
            folder.path(),
            &["export", "far.json", "--to", kind, "--out", out],
        );
        assert_eq!(ran.code, Some(0), "{kind}: {}", ran.stderr);
    }
}

#[test]
fn a_tool_on_its_axis_has_a_report() {
    let folder = folder();
    let mut document = session();
    document["robot"]["tool"]["position_mm"][0] = json!(5e-324);
    fs::write(folder.path().join("s.json"), document.to_string()).unwrap();
    for out in ["r.pdf", "r.html"] {
        let ran = truepose(folder.path(), &["report", "s.json", "--out", out]);
        assert_eq!(ran.code, Some(0), "{out}: {}", ran.stderr);
    }
}
