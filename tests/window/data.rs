//! What is wrong with the data, where, and mended by a button.

use std::fs;
use std::path::{Path, PathBuf};

use crate::window::{copy_of, gaps, keys, press, says, there, window};
use egui::{Key, Modifiers};
use egui_kittest::kittest::Queryable;

/// A session of which every line of the samples goes through `change`; cells by number.
fn changed(folder: &Path, change: impl Fn(usize, &mut Vec<String>)) -> PathBuf {
    let session = copy_of("paper-run", folder);
    let samples = session.with_extension("csv");
    let text = fs::read_to_string(&samples).expect("the samples");
    let mut lines = Vec::new();
    for (k, line) in text.lines().enumerate() {
        let mut cells: Vec<String> = line.split(',').map(str::to_owned).collect();
        if k > 0 {
            change(k, &mut cells);
        }
        lines.push(cells.join(","));
    }
    fs::write(&samples, lines.join("\n") + "\n").expect("written");
    session
}

#[test]
fn a_finding_shows_its_samples_in_plot_and_table() {
    let folder = tempfile::tempdir().expect("a folder");
    let session = changed(folder.path(), |k, cells| {
        if [3, 7].contains(&k) {
            for cell in &mut cells[1..] {
                "0".clone_into(cell);
            }
        }
    });
    let mut window = window(Some(session));
    let finding = window.get_by_label_contains("lost the reflector (0, 0, 0) in 2 measurements");
    finding.click();
    window.run_steps(6);
    assert!(says(&window, "angle, °"), "the table is shown");
    let rows = window.query_all_by_label("3").count();
    assert!(rows > 0, "sample 3 is in sight");
}

#[test]
fn a_joint_that_counts_the_other_way_is_mended_by_a_button_and_undone() {
    let folder = tempfile::tempdir().expect("a folder");
    let session = changed(folder.path(), |_, cells| {
        let q = cells[0].clone();
        cells[0] = q.strip_prefix('-').map_or(format!("-{q}"), str::to_owned);
    });
    let mut window = window(Some(session));
    let (before, _) = gaps(&window);
    keys(&mut window, Modifiers::COMMAND, Key::Num4);
    keys(&mut window, Modifiers::COMMAND, Key::G);
    assert!(says(&window, "counts the other way round"));
    press(&mut window, "Reverse joint 1");
    let (mended, after) = gaps(&window);
    assert!(mended < 0.2 * before, "{before} → {mended}");
    assert!(after.expect("identified") < 0.1);
    assert!(says(&window, "not saved"));
    keys(&mut window, Modifiers::COMMAND, Key::Z);
    // The mistake is in the samples again, and out of what is identified.
    keys(&mut window, Modifiers::COMMAND, Key::Num3);
    window.run_steps(6);
    assert!(says(&window, "counts the other way round"));
    assert!(gaps(&window).1.expect("identified") < 0.1);
}

#[test]
fn lost_points_are_removed_by_a_button() {
    let folder = tempfile::tempdir().expect("a folder");
    let session = changed(folder.path(), |k, cells| {
        if k == 5 {
            for cell in &mut cells[1..] {
                "0".clone_into(cell);
            }
        }
    });
    let mut window = window(Some(session));
    assert!(says(&window, "361 samples · RMS error"));
    keys(&mut window, Modifiers::COMMAND, Key::Num4);
    keys(&mut window, Modifiers::COMMAND, Key::G);
    press(&mut window, "Remove this sample");
    assert!(says(&window, "360 samples · RMS error"));
    assert!(
        !there(&window, "Remove this sample"),
        "it has to be searched again"
    );
    keys(&mut window, Modifiers::COMMAND, Key::Z);
    assert!(says(&window, "361 samples · RMS error"));
}
