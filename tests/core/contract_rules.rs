//! What the contract says of every answer, of the answers to small sessions of all kinds that the repository has and
//! of simulated ones: figures of one answer are over one set of samples, and nothing is said of what is not there.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on fails")]

use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::house::files_ending;
use crate::program::truepose;
use crate::rig::Random;

/// Two figures of one fit differ by rounding alone.
const ROUNDING: f64 = 1e-9;

fn json(arguments: &[&str]) -> Value {
    let done = truepose().args(arguments).output().unwrap();
    let said = String::from_utf8_lossy(&done.stderr);
    assert!(done.status.success(), "{arguments:?}: {said}");
    serde_json::from_slice(&done.stdout).unwrap()
}

fn number(of: &Value, key: &str) -> Option<f64> {
    of[key].as_f64()
}

/// Whether all joints of a session's robot turn.
fn turns_everywhere(session: &Value) -> bool {
    let joints = session["robot"]["joints"].as_array();
    joints.is_some_and(|all| all.iter().all(|joint| joint["kind"] == "revolute"))
}

/// The rules of one answer, and that the model does what was said of it.
fn holds(session: &Path, folder: &Path) {
    let path = session.to_str().unwrap();
    let model = folder.join("model.json");
    let model = model.to_str().unwrap();
    let said = json(&["diagnose", path, "--json", "--out", model, "--force"]);
    for figures in ["gap", "held_out"] {
        let own = |key: &str| number(&said[figures], key);
        let (identified, end) = (own("identified_mm"), own("end_mm"));
        if let (Some(identified), Some(end)) = (identified, end) {
            let most = identified * (1.0 + ROUNDING) + ROUNDING;
            assert!(end <= most, "{path}: {figures} {}", said[figures]);
        }
    }
    let found = said["found"].as_array().unwrap();
    let open = said["unexplained"]["present"].as_bool().unwrap();
    let verdict = match (found.is_empty(), open) {
        (true, false) => "noise",
        (false, false) => "explained",
        (false, true) => "partly-explained",
        (true, true) => "unexplained",
    };
    assert_eq!(said["verdict"], verdict, "{path}");
    for name in found {
        assert!(number(name, "p_family").unwrap() <= 0.002, "{path}: {name}");
        let odds = number(name, "odds_over_next");
        assert!(odds.is_none_or(|odds| odds >= 1.0), "{path}: {name}");
    }
    let document: Value = serde_json::from_slice(&std::fs::read(session).unwrap()).unwrap();
    if let Some(variable) = said["unexplained"]["where"]["variable"].as_str() {
        let samples = &document["samples"];
        let heading = match samples["file"].as_str() {
            Some(file) => std::fs::read_to_string(session.with_file_name(file)).unwrap(),
            None => samples["columns"].to_string(),
        };
        assert!(heading.contains(variable), "{path}: no column {variable}");
    }
    let joints = document["robot"]["joints"].as_array().map(Vec::len);
    let lists = ["identified", "found", "not_found", "not_testable"];
    let mut places = Vec::new();
    for (list, entry) in lists.iter().flat_map(|list| {
        let all = said[*list].as_array().unwrap().iter();
        all.map(move |entry| (*list, entry))
    }) {
        let joint = entry["joint"].as_u64();
        if let (Some(joint), Some(joints)) = (joint, joints) {
            assert!((1..=joints as u64).contains(&joint), "{path}: {entry}");
        }
        places.push((entry["effect"].as_str().unwrap().to_owned(), joint, list));
    }
    // What was looked for on one joint and not found there is said of all: a coupling takes two.
    let not_found = places.iter().filter(|place| place.2 == "not_found");
    for (effect, joint, _) in not_found {
        let first = 1 + u64::from(effect == "wrist-coupling");
        let all = match joint {
            Some(_) if turns_everywhere(&document) => first..=joints.unwrap_or(0) as u64,
            _ => continue,
        };
        for one in all {
            let said = places.iter().any(|p| p.0 == *effect && p.1 == Some(one));
            assert!(said, "{path}: {effect} of joint {one} is in no list");
        }
    }
    for (effect, joint, list) in &places {
        let elsewhere = |own: &&(String, Option<u64>, &str)| {
            own.0 == *effect && own.1 == *joint && own.2 != *list
        };
        let other = places.iter().find(elsewhere);
        assert_eq!(other, None, "{path}: {effect} {joint:?} is in {list} too");
    }
    let verified = json(&["verify", model, path, "--json"]);
    let trimmed = number(&verified["trimmed"], "model_mm");
    let left = trimmed.or(number(&verified["gap"], "model_mm")).unwrap();
    let end = number(&said["gap"], "end_mm").unwrap();
    let share = if trimmed.is_some() { 0.05 } else { 0.01 };
    assert!(
        (left - end).abs() <= share * end + 1e-6,
        "{path}: {left}, {end} said"
    );
}

/// Every session below a folder; none of a folder that is not there.
fn sessions_below(folder: &Path) -> Vec<PathBuf> {
    let is_session = |path: &PathBuf| {
        let text = std::fs::read_to_string(path).unwrap_or_default();
        text.contains("\"truepose-session/1\"")
    };
    let all = folder.is_dir().then(|| files_ending(folder, "json"));
    all.into_iter().flatten().filter(is_session).collect()
}

/// Of some; with `EVERY_SESSION` set of every one that there is, and of those in ../shared/practice, where it is there.
#[test]
fn of_sessions_of_the_repository() {
    let folder = tempfile::tempdir().unwrap();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let some = [
        "sessions/paper-30.json",
        "sessions/arm/arm.json",
        "tests/data/arm_verdicts/twenty-poses.json",
        "tests/data/arm_verdicts/two-cycle.json",
        "tests/data/programs/positioner.json",
        // Points and orientations of which some stand apart.
        "tests/data/standards/paths.json",
    ];
    let mut all: Vec<PathBuf> = some.map(|path| root.join(path)).into();
    if std::env::var_os("EVERY_SESSION").is_some() {
        let folders = ["sessions", "tests/data", "../shared/practice"];
        all = folders
            .iter()
            .flat_map(|f| sessions_below(&root.join(f)))
            .collect();
        // What cannot be diagnosed says so, and has no answer.
        all.retain(|path| {
            truepose()
                .arg("diagnose")
                .arg(path)
                .output()
                .unwrap()
                .status
                .success()
        });
        assert!(all.len() > some.len());
    }
    for session in all {
        holds(&session, folder.path());
    }
}

/// A turning axis with whatever the seed puts into it: effects, a clock or none, directions or none, repeats.
#[test]
fn of_simulated_sessions() {
    let folder = tempfile::tempdir().unwrap();
    for seed in 1..=8 {
        let mut random = Random(seed);
        let possible = [
            r#"{"effect":"backlash","joint":1,"parameters":{"width_deg":0.05}}"#,
            r#"{"effect":"encoder-eccentricity","joint":1,"parameters":{"amplitude_deg":0.04,"phase_deg":70}}"#,
            r#"{"effect":"thermal-growth","parameters":{"ppm_per_degc":60}}"#,
            r#"{"effect":"frame-drift","parameters":{"x_mm_per_h":0.4,"y_mm_per_h":-0.3,"z_mm_per_h":0.2}}"#,
        ];
        let chosen: Vec<&str> = possible
            .into_iter()
            .filter(|_| random.unit() < 0.4)
            .collect();
        let both_ways = random.unit() < 0.5;
        let conditions = if random.unit() < 0.5 {
            r#"{"temperature_c":{"from":20,"to":26,"time_constant_s":600},"seconds_per_pose":6}"#
        } else {
            "{}"
        };
        let scenario = format!(
            r#"{{"format":"truepose-scenario/1","name":"seed {seed}","robot":{{"name":"table","joints":[
            {{"name":"table","kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0],"limits":[-180,180]}}],
            "tool":{{"position_mm":[250,0,300],"quaternion_wxyz":[1,0,0,0]}}}},"targets":{{"T1":[0,0,0]}},
            "instrument":{{"name":"tracker","sigma_mm":0.02}},"poses":{{"sweep":{{"joint":1,"from_deg":-170,"to_deg":170,
            "step_deg":10,"both_ways":{both_ways},"repeats":1,"order":"sweep"}}}},"conditions":{conditions},
            "effects":[{}],"noise":{{"sigma_mm":0.02,"kind":"gauss"}},"seed":{seed}}}"#,
            chosen.join(",")
        );
        let given = folder.path().join("scenario.json");
        std::fs::write(&given, scenario).unwrap();
        let session = folder.path().join("session.json");
        let arguments = ["simulate", given.to_str().unwrap(), "--force", "--out"];
        let done = truepose().args(arguments).arg(&session).output().unwrap();
        let said = String::from_utf8_lossy(&done.stderr);
        assert!(done.status.success(), "{seed}: {said}");
        holds(&session, folder.path());
    }
}
