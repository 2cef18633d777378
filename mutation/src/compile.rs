//! Compiles the program with all changes in it. What the compiler refuses in a line (a difference of texts, a
//! number whose type is no longer clear) is left out, and it is asked again.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use serde_json::Value;

use crate::Outcome;
use crate::places::{Change, FIRST, switched};

/// How often the compiler is asked.
const MOST_ROUNDS: usize = 30;

/// The test binaries; changes that do not compile are taken out.
pub fn all(copy: &Path, changes: &mut Vec<Change>) -> Outcome<Vec<PathBuf>> {
    let mut originals = BTreeMap::new();
    for change in changes.iter() {
        let path = copy.join(&change.file);
        let text =
            std::fs::read_to_string(&path).map_err(|e| format!("{}: {e}", path.display()))?;
        originals.insert(change.file.clone(), text);
    }
    let last = changes.iter().map(|c| c.id).max().unwrap_or(FIRST);
    let switch = include_str!("switch.rs.txt").replace("COUNT", &(last + 1).to_string());
    put(&copy.join("crates/base/src/switch.rs"), &switch)?;
    for source in ["base", "session", "model", "calibrate", "deliver"] {
        let module = match source {
            "base" => "#[doc(hidden)]\npub mod switch;\n",
            _ => "use truepose_base::switch;\n",
        };
        add(&copy.join("crates").join(source).join("src/lib.rs"), module)?;
    }
    add(&copy.join("src/lib.rs"), "use truepose_base::switch;\n")?;
    for round in 1..=MOST_ROUNDS {
        for (file, text) in &originals {
            let own: Vec<&Change> = changes.iter().filter(|c| c.file == *file).collect();
            put(&copy.join(file), &switched(text, &own))?;
        }
        let mut refused = cargo(copy, &["check", "--lib"])?.refused;
        let mut binaries = Vec::new();
        // The compiler looks at borrows only where all types are right, and builds only what it has checked.
        if refused.is_empty() {
            let built = cargo(copy, &["test", "--no-run", "--lib", "--test", "core"])?;
            (refused, binaries) = (built.refused, built.binaries);
        }
        if refused.is_empty() {
            return if binaries.is_empty() {
                Err("the copy does not compile, and not for a change".to_owned())
            } else {
                Ok(binaries)
            };
        }
        let before = changes.len();
        changes.retain(|c| {
            !refused
                .iter()
                .any(|(file, line)| *file == c.file && c.lines.contains(line))
        });
        println!("round {round}: {} do not compile", before - changes.len());
        if changes.len() == before {
            return Err(format!("the copy does not compile: {refused:?}"));
        }
    }
    Err("the compiler found something new to refuse each time".to_owned())
}

fn add(path: &Path, more: &str) -> Outcome<()> {
    let own = std::fs::read_to_string(path).map_err(|e| format!("{}: {e}", path.display()))?;
    put(path, &format!("{own}\n{more}"))
}

fn put(path: &Path, text: &str) -> Outcome<()> {
    std::fs::write(path, text).map_err(|e| format!("{}: {e}", path.display()))
}

#[derive(Default)]
struct Built {
    refused: Vec<(PathBuf, usize)>,
    binaries: Vec<PathBuf>,
}

fn cargo(copy: &Path, arguments: &[&str]) -> Outcome<Built> {
    let output = Command::new("cargo")
        .args(arguments)
        .args([
            "--no-default-features",
            "--features",
            "cli",
            "--message-format",
            "json",
            "--locked",
        ])
        .env("RUSTFLAGS", "--cap-lints allow")
        .env("CARGO_TARGET_DIR", copy.join("../build"))
        .current_dir(copy)
        .stderr(Stdio::null())
        .output()
        .map_err(|e| format!("cargo: {e}"))?;
    let mut built = Built::default();
    for line in String::from_utf8_lossy(&output.stdout).lines() {
        let Ok(message) = serde_json::from_str::<Value>(line) else {
            continue;
        };
        if message["message"]["level"] == "error" {
            let spans = message["message"]["spans"].as_array();
            for span in spans
                .into_iter()
                .flatten()
                .filter(|s| s["is_primary"] == true)
            {
                let line = span["line_start"]
                    .as_u64()
                    .and_then(|l| usize::try_from(l).ok());
                if let (Some(file), Some(line)) = (span["file_name"].as_str(), line) {
                    built.refused.push((PathBuf::from(file), line));
                }
            }
        }
        if message["reason"] == "compiler-artifact" && message["profile"]["test"] == true {
            let path = message["executable"].as_str();
            built.binaries.extend(path.map(PathBuf::from));
        }
    }
    if !output.status.success() && built.refused.is_empty() {
        return Err("cargo fails without a place: does the tree compile?".to_owned());
    }
    Ok(built)
}
