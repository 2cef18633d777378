//! Situations that people reported in public, each with a small file of our own, imported as its row of
//! `tests/data/public_reports/reports.md` says.

#![allow(clippy::unwrap_used, reason = "a test that cannot go on has failed")]

use std::path::Path;
use std::process::Output;

use truepose::sessions::{Session, load};

/// The commands with which the files were made, rad.
fn commanded(folder: &Path) -> Vec<[f64; 2]> {
    let text = std::fs::read_to_string(folder.join("commands.csv")).unwrap();
    let row = |line: &str| {
        let cells: Vec<f64> = line
            .split(',')
            .skip(1)
            .map(|c| c.parse().unwrap())
            .collect();
        [cells[0].to_radians(), cells[1].to_radians()]
    };
    text.lines().skip(1).map(row).collect()
}

/// What of a session differs from the exact head: pan about z, tilt about −y through (0, 0, 400), the tool 250 mm in
/// front, every 6 s. Rows in which nothing was measured say nothing.
fn differs(session: &Session, poses: &[[f64; 2]]) -> Option<String> {
    let samples = &session.samples;
    if samples.len() != poses.len() {
        return Some(format!("{} samples", samples.len()));
    }
    for (row, [pan, tilt]) in poses.iter().copied().enumerate() {
        let ((sp, cp), (st, ct)) = (pan.sin_cos(), tilt.sin_cos());
        let off = (samples.q[0][row] - pan)
            .abs()
            .max((samples.q[1][row] - tilt).abs());
        if off.is_nan() || off > 2e-6 {
            return Some(format!("joints of row {row} by {off}"));
        }
        let z = samples.z_mm.as_ref().map_or(f64::NAN, |z| z[row]);
        let measured = [samples.x_mm[row], samples.y_mm[row], z];
        let exact = [250.0 * cp * ct, 250.0 * sp * ct, 400.0 + 250.0 * st];
        let is_missing = measured.iter().all(|value| value.is_nan() || *value == 0.0);
        let far = measured.iter().zip(exact).map(|(a, b)| (a - b).abs());
        if !is_missing
            && far.fold(0.0, |most: f64, off| if off <= most { most } else { off }) > 2e-3
        {
            return Some(format!("the point of row {row}: {measured:?}"));
        }
        if let Some(parts) = &samples.orientation_wxyz {
            let ((sp, cp), (st, ct)) = ((0.5 * pan).sin_cos(), (-0.5 * tilt).sin_cos());
            let exact = [cp * ct, -sp * st, cp * st, sp * ct];
            let product: f64 = exact
                .iter()
                .zip(parts)
                .map(|(own, part)| own * part[row])
                .sum();
            let length: f64 = parts.iter().map(|part| part[row].powi(2)).sum();
            let cosine = product / length.sqrt();
            if !cosine.is_nan() && cosine.abs() < 1.0 - 1e-9 {
                return Some(format!("the orientation of row {row} by {}", cosine.acos()));
            }
        }
        if let Some(times) = &samples.time_s
            && (times[row] - times[0] - 6.0 * row as f64).abs() > 1e-6
        {
            return Some(format!("the time of row {row}: {}", times[row] - times[0]));
        }
    }
    None
}

fn run(folder: &Path, arguments: &str) -> Output {
    let mut command = crate::program::truepose();
    command
        .current_dir(folder)
        .args(arguments.split_whitespace())
        .output()
        .unwrap()
}

#[test]
fn what_people_met_in_public_is_read_right_or_refused_for_its_cause() {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/public_reports");
    let desk = tempfile::tempdir().unwrap();
    for file in std::fs::read_dir(&data).unwrap() {
        let file = file.unwrap();
        std::fs::copy(file.path(), desk.path().join(file.file_name())).unwrap();
    }
    let poses = commanded(&data);
    let table = std::fs::read_to_string(data.join("reports.md")).unwrap();
    let mut reports = std::collections::BTreeSet::new();
    let mut wrong = Vec::new();
    for line in table.lines().filter(|line| line.starts_with("| ")).skip(2) {
        let cells: Vec<&str> = line.trim_matches('|').split(" | ").map(str::trim).collect();
        let [sources, _, arguments, result] = cells[..] else {
            panic!("{line}");
        };
        reports.extend(sources.split(", ").filter(|source| *source != "—"));
        let arguments = arguments.trim_matches('`');
        let robot = if arguments.contains("--robot") {
            ""
        } else {
            "--robot robot.json"
        };
        let done = run(
            desk.path(),
            &format!("import {arguments} {robot} --out s.json"),
        );
        let said = String::from_utf8(done.stderr).unwrap();
        let (kind, words) = result.split_once(": ").unwrap_or((result, ""));
        let out = desk.path().join("s.json");
        let failure = match (kind, done.status.code()) {
            ("read", Some(0)) => differs(&load(&out).unwrap().session, &poses),
            ("refused", Some(2)) => out.exists().then(|| "a session was written".to_owned()),
            ("found", Some(0)) => None,
            (_, code) => Some(format!("exit status {code:?}")),
        };
        let said = if kind == "found" {
            let answer = run(desk.path(), "identify s.json --json").stdout;
            let answer: serde_json::Value = serde_json::from_slice(&answer).unwrap_or_default();
            answer["data_problems"].to_string()
        } else {
            said
        };
        let lacks = (!said.contains(words)).then(|| "other words".to_owned());
        if let Some(failure) = failure.or(lacks) {
            wrong.push(format!(
                "{arguments}\n  expected {result}\n  {failure}: {said}"
            ));
        }
        for file in ["s.json", "s.csv", "s.samples.csv"] {
            let _ = std::fs::remove_file(desk.path().join(file));
        }
    }
    assert!(reports.len() >= 40, "{} reports", reports.len());
    assert!(
        wrong.is_empty(),
        "{} rows\n{}",
        wrong.len(),
        wrong.join("\n")
    );
}
