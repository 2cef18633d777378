//! Sessions as files: practice data, a million samples, and saving that survives a kill.

#![allow(
    clippy::unwrap_used,
    reason = "a test that cannot prepare its files has failed"
)]

use std::fs;
use std::path::Path;
use std::process::Command;

use truepose::sessions::{Replacing, Session, hash_of_samples, load, parse, save};

const FORCE: Replacing<'_> = Replacing {
    force: true,
    inputs: &[],
};

/// A session on one axis whose every measured x is `x_mm`.
fn session(x_mm: f64, samples: usize) -> Session {
    let column = |value: f64| vec![value.to_string(); samples].join(",");
    let document = format!(
        r#"{{"format":"truepose-session/1","name":"{x_mm}","robot":{{"name":"r","joints":[{{"name":"pan",
        "kind":"revolute","axis":[0,0,1],"point_mm":[0,0,0]}}],"tool":{{"position_mm":[250,0,300],
        "quaternion_wxyz":[1,0,0,0]}}}},"samples":{{"columns":{{"q1_deg":[{}],"x_mm":[{}],"y_mm":[{}]}}}}}}"#,
        column(12.5),
        column(x_mm),
        column(-0.125)
    );
    parse(document.as_bytes()).unwrap().session
}

#[test]
fn every_practice_session_loads() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/practice");
    let Ok(entries) = fs::read_dir(&folder) else {
        eprintln!("skipped: no practice sessions beside this repository");
        return;
    };
    let mut loaded = 0;
    for entry in entries {
        let path = entry.unwrap().path();
        let is_session = path
            .extension()
            .is_some_and(|extension| extension == "json");
        if !is_session || path.file_name().is_some_and(|name| name == "truth.json") {
            continue;
        }
        let session = load(&path)
            .unwrap_or_else(|rejected| panic!("{rejected}"))
            .session;
        assert!(session.samples.len() >= 50, "{}", path.display());
        assert_eq!(session.samples.line.len(), session.samples.len());
        loaded += 1;
    }
    assert!(loaded >= 30, "{loaded} sessions");
}

#[test]
fn one_sample_is_a_session() {
    assert_eq!(session(1.0, 1).samples.len(), 1);
}

#[test]
fn a_million_samples_are_saved_and_loaded_alike() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("large.json");
    let mut large = session(1.0, 1_000_000);
    for (i, x_mm) in large.samples.x_mm.iter_mut().enumerate() {
        *x_mm = (i as f64 * 0.618).sin() * 250.0;
    }
    save(&large, &path, Replacing::default()).unwrap();
    let loaded = load(&path).unwrap().session;
    assert_eq!(loaded.samples.len(), 1_000_000);
    assert_eq!(hash_of_samples(&loaded), hash_of_samples(&large));
    assert_eq!(loaded.samples.line.get(999_999), Some(1_000_001));
}

/// Not a test by itself: the process that the next test kills.
#[test]
fn child_that_saves_for_ever() {
    let Some(path) = std::env::var_os("TRUEPOSE_TEST_SAVES_TO") else {
        return;
    };
    let versions = [session(1.0, 20_000), session(2.0, 20_000)];
    for version in versions.iter().cycle() {
        save(version, Path::new(&path), FORCE).unwrap();
    }
}

#[test]
fn a_kill_in_the_middle_of_saving_leaves_whole_files() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("s.json");
    save(&session(1.0, 20_000), &path, FORCE).unwrap();
    let mut seen = Vec::new();
    for round in 0..12_u64 {
        let mut child = Command::new(std::env::current_exe().unwrap())
            .args([
                "--exact",
                "sessions_on_disk::child_that_saves_for_ever",
                "--nocapture",
            ])
            .env("TRUEPOSE_TEST_SAVES_TO", &path)
            .stdout(std::process::Stdio::null())
            .spawn()
            .unwrap();
        std::thread::sleep(std::time::Duration::from_millis(250 + 37 * round));
        child.kill().unwrap();
        child.wait().unwrap();
        let loaded = load(&path)
            .unwrap_or_else(|rejected| panic!("{rejected}"))
            .session;
        let x_mm = &loaded.samples.x_mm;
        assert_eq!(x_mm.len(), 20_000);
        assert!(
            x_mm.iter().all(|x| x == &x_mm[0]),
            "samples of two versions in one file"
        );
        assert!(["1", "2"].contains(&loaded.name.as_str()));
        seen.push(x_mm[0]);
    }
    assert!(
        seen.contains(&2.0),
        "the child never got to saving: {seen:?}"
    );
}

/// A file system of a few pages, where this user may mount one.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_leaves_the_old_session() {
    let folder = tempfile::tempdir().unwrap();
    let mounted = Command::new("mount")
        .args(["-t", "tmpfs", "-o", "size=256k", "tmpfs"])
        .arg(folder.path())
        .output();
    if !mounted.is_ok_and(|output| output.status.success()) {
        eprintln!("skipped: this user may not mount a small file system");
        return;
    }
    let path = folder.path().join("s.json");
    save(&session(1.0, 100), &path, FORCE).unwrap();
    let refused = save(&session(2.0, 100_000), &path, FORCE);
    let loaded = load(&path);
    let names = fs::read_dir(folder.path()).unwrap().count();
    Command::new("umount").arg(folder.path()).status().unwrap();
    let message = refused.unwrap_err().to_string();
    assert!(message.contains("No space left"), "{message}");
    assert_eq!(loaded.unwrap().session.samples.x_mm, vec![1.0; 100]);
    assert_eq!(names, 2, "nothing else was left behind");
}
