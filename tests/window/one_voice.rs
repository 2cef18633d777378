//! One answer in four places: what terminal, window, report and clipboard say of a session are the same names and the
//! same figures, each as exactly as its place has room for.

use std::path::{Path, PathBuf};
use std::process::Command;

use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT, Queryable};
use truepose::gui::Runner;

use crate::window::{Window, copied, into_sight, keys, press, window_of};

fn session() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("sessions/lamp-commissioning.json")
}

/// What the program prints.
fn printed(arguments: &[&str]) -> String {
    let mut command = Command::new(env!("CARGO_BIN_EXE_truepose"));
    let done = command.env("LC_ALL", "C").args(arguments).output();
    let done = done.expect("the program runs");
    assert!(done.status.success(), "{arguments:?}");
    String::from_utf8(done.stdout).expect("text")
}

/// Labels of the window in the order in which they stand there.
fn labels(window: &Window) -> Vec<String> {
    let nodes = window.root().children_recursive();
    let text = |node: egui_kittest::Node<'_>| {
        let node = node.accesskit_node();
        let label = node.value().or_else(|| node.label());
        // What stands below a label are its lines.
        label.filter(|_| node.role() == Role::Label)
    };
    nodes.filter_map(text).collect()
}

/// What stands behind a name, from this line or label on.
fn behind(name: &str, all: &[String]) -> String {
    let at = all.iter().position(|label| label == name);
    let at = at.unwrap_or_else(|| panic!("{name}: {all:#?}"));
    all[at + 1].clone()
}

/// The numbers in a text.
fn numbers(text: &str) -> Vec<f64> {
    let words = text.split(|c: char| !(c.is_ascii_digit() || c == '.'));
    words.filter_map(|word| word.parse().ok()).collect()
}

/// Whether each is the other to the digits that the coarser one has, a tenth of a percent at least.
fn same(one: &[f64], other: &[f64]) -> bool {
    let near = |(a, b): (&f64, &f64)| (a - b).abs() <= 0.005 * a.abs().max(b.abs());
    one.len() == other.len() && one.iter().zip(other).all(near)
}

#[test]
fn terminal_window_report_and_clipboard_say_the_same() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = session();
    let file = path.to_str().expect("a path");
    let terminal = printed(&["diagnose", file]);
    let page = folder.path().join("report.html");
    printed(&["report", file, "--out", page.to_str().expect("a path")]);
    let report = std::fs::read_to_string(page).expect("a report");

    let mut window = window_of([1280.0, 800.0], Some(path.clone()), Runner::AtOnce);
    press(&mut window, "4 Diagnose");
    press(&mut window, "Run diagnosis");
    let shown = labels(&window);

    // A line of the terminal: a name and its value, with blanks between them.
    let lines: Vec<(&str, &str)> = terminal
        .lines()
        .filter_map(|line| line.trim().split_once("  "))
        .map(|(name, value)| (name, value.trim()))
        .collect();
    let said = |name: &str| {
        let line = lines.iter().find(|(own, _)| *own == name);
        line.unwrap_or_else(|| panic!("{name}: {terminal}")).1
    };
    for name in [
        "RMS error, nominal robot",
        "RMS error, identified",
        "RMS error, with what was found",
        "Noise floor",
    ] {
        let (printed, window) = (numbers(said(name)), numbers(&behind(name, &shown)));
        assert!(
            !printed.is_empty() && same(&printed, &window),
            "{name}: {printed:?} {window:?}"
        );
        for number in printed {
            assert!(report.contains(&format!("{number:.4}")), "{name}: {number}");
        }
    }

    // Every effect: its title, its size, its evidence and what to check.
    let table = {
        into_sight(&mut window, "Copy table of found effects");
        copied(&mut window, "Copy table of found effects")
    };
    let titles: Vec<&str> = terminal
        .lines()
        .filter_map(|line| {
            line.strip_suffix(')')?
                .split_once(" (")
                .map(|(title, _)| title)
        })
        .filter(|title| report.contains(&format!("<h3>{title}</h3>")))
        .collect();
    assert!(titles.len() >= 5, "{terminal}");
    for title in titles {
        let own: Vec<&(&str, &str)> = {
            let from = terminal.find(&format!("{title} (")).expect("its heading");
            let at = terminal[..from].lines().count();
            let before = terminal.lines().take(at);
            let skipped = before
                .filter(|line| line.trim().split_once("  ").is_some())
                .count();
            lines[skipped..].iter().take(3).collect()
        };
        let [(_, size), (_, evidence), (_, check)] = own[..] else {
            panic!("{title}: {terminal}");
        };
        let at = shown.iter().position(|label| label == title);
        let card = &shown[at.unwrap_or_else(|| panic!("{title}: {shown:#?}"))..];
        for one in size.split("; ") {
            let mut pairs = card.windows(2);
            let there = pairs.any(|pair| format!("{} {}", pair[0], pair[1]) == one);
            assert!(there, "{title}: {one} {card:#?}");
        }
        assert!(evidence.starts_with(&behind("Evidence", card)), "{title}");
        assert!(evidence.contains(&behind("Odds", card)), "{title}");
        assert_eq!(behind("Check on the machine", card), *check, "{title}");
        let escaped = behind("Evidence", card).replace('<', "&lt;");
        assert!(report.contains(&escaped), "{title}: {escaped}");
        assert!(report.contains(&behind("Odds", card)), "{title}");

        let rows = table.iter().filter(|row| row[0] == title);
        let values = rows.map(|row| row[3].parse::<f64>().expect("a number").abs());
        let values: Vec<f64> = values.collect();
        let sizes = size.split("; ");
        let sizes = sizes.map(|one| numbers(one.split('±').next().unwrap_or(one))[0]);
        let sizes: Vec<f64> = sizes.collect();
        assert_eq!(sizes.len(), values.len(), "{title}: {size}, {values:?}");
        for (size, value) in sizes.iter().zip(&values) {
            let near = (size - value).abs() <= 0.02 * value.max(1e-4);
            assert!(near, "{title}: {size} {value}");
        }
    }
}

#[test]
fn a_reader_of_inches_reads_inches_in_every_sentence_of_the_diagnosis() {
    let mut window = window_of([1280.0, 800.0], Some(session()), Runner::AtOnce);
    press(&mut window, "4 Diagnose");
    press(&mut window, "Run diagnosis");
    let in_mm = |label: &String| {
        let mut words = label.split([' ', ',', ';', ')']);
        words.any(|word| word == "mm") && !label.starts_with("mm")
    };
    let sentences = labels(&window).into_iter().filter(in_mm);
    let sentences = sentences.filter(|label| label.split(' ').count() > 5);
    assert!(
        sentences.count() >= 5,
        "as a reader of millimetres has them"
    );
    keys(&mut window, Modifiers::COMMAND, Key::Comma);
    press(&mut window, "inch");
    press(&mut window, "Done");
    let found: Vec<String> = labels(&window).into_iter().filter(in_mm).collect();
    assert!(found.is_empty(), "{found:#?}");
    assert!(labels(&window).iter().any(|label| label.ends_with(" in")));
}

/// Sentences of an export: the numbers that a controller takes keep their unit, and stand in its own lines.
#[test]
fn a_reader_of_inches_reads_inches_in_every_sentence_of_an_export() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let mut found = Vec::new();
    for file in [
        "sessions/lamp-commissioning.json",
        "tests/data/arms/six-60.json",
        "tests/data/arms/scara-60.json",
    ] {
        let mut window = window_of([1280.0, 800.0], Some(root.join(file)), Runner::AtOnce);
        keys(&mut window, Modifiers::COMMAND, Key::Comma);
        press(&mut window, "inch");
        press(&mut window, "Done");
        keys(&mut window, Modifiers::COMMAND, Key::I);
        let last = if file.contains("lamp") {
            Key::Num5
        } else {
            Key::Num4
        };
        keys(&mut window, Modifiers::COMMAND, last);
        let formats = window.query_all_by_role(Role::RadioButton);
        let formats = formats.filter(|node| node.rect().left() < 280.0);
        let formats: Vec<String> = formats
            .filter_map(|node| node.accesskit_node().label())
            .collect();
        assert!(formats.len() > 5, "{formats:?}");
        for format in formats {
            press(&mut window, &format);
            let sentences = labels(&window)
                .into_iter()
                .filter(|label| label.split(' ').count() > 5);
            // What is written into the file is in its own units.
            let of_file = |label: &String| label.starts_with(" * ") || label.starts_with("// ");
            let in_mm = sentences.filter(|label| !of_file(label)).filter(|label| {
                let mut words = label.split([' ', ',', ';', ')']);
                words.any(|word| word == "mm")
            });
            found.extend(in_mm.map(|label| format!("{file}, {format}: {label}")));
        }
    }
    assert!(found.is_empty(), "{found:#?}");
}
