//! One answer in four places: what terminal, window, report and clipboard say of a session are the same names and the
//! same figures, each as exactly as its place has room for.

use std::path::{Path, PathBuf};
use std::process::Command;

use egui::accesskit::Role;
use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT, Queryable};
use truepose::gui::Runner;

use crate::window::{Window, copied, into_sight, keys, press, steps, window_of};

/// A bundled session.
fn session(file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("sessions")
        .join(file)
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

/// What an effect rests on is shown on demand.
fn unfold(window: &mut Window) {
    for more in window.get_all_by_label("More") {
        more.click_accesskit();
    }
    window.run_steps(12);
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

/// What the four places say of one session.
#[derive(Clone)]
struct Answers {
    terminal: String,
    /// Labels of the window, in order.
    window: Vec<String>,
    report: String,
    /// Rows of the clipboard.
    clipboard: Vec<Vec<String>>,
}

impl Answers {
    fn of(file: &str) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let path = session(file);
        let name = path.to_str().expect("a path");
        let terminal = printed(&["diagnose", name]);
        let page = folder.path().join("report.html");
        printed(&["report", name, "--out", page.to_str().expect("a path")]);
        let report = std::fs::read_to_string(page).expect("a report");
        let mut window = window_of([1280.0, 800.0], Some(path), Runner::AtOnce);
        // An arm has no step of regions.
        let diagnose = steps(&window)
            .into_iter()
            .find(|step| step.ends_with("Diagnose"));
        press(&mut window, &diagnose.expect("a step of the diagnosis"));
        press(&mut window, "Run diagnosis");
        unfold(&mut window);
        let shown = labels(&window);
        into_sight(&mut window, "Copy table of found effects");
        Self {
            terminal,
            window: shown,
            report,
            clipboard: copied(&mut window, "Copy table of found effects"),
        }
    }

    /// A line of the terminal: a name and its value, with blanks between them.
    fn lines(&self) -> impl Iterator<Item = (&str, &str)> {
        let lines = self.terminal.lines();
        let lines = lines.filter_map(|line| line.trim().split_once("  "));
        lines.map(|(name, value)| (name, value.trim()))
    }

    /// Titles of the effects that the terminal names.
    fn titles(&self) -> Vec<&str> {
        let lines = self.terminal.lines().filter(|line| !line.starts_with(' '));
        let titles = lines.filter_map(|line| line.strip_suffix(')')?.rsplit_once(" ("));
        let titles = titles.filter(|(_, id)| truepose::effects::find(id).is_some());
        titles.map(|(title, _)| title).collect()
    }

    /// Where two places say something else.
    fn differences(&self) -> Vec<String> {
        let mut found = Vec::new();
        let mut check = |holds: bool, what: &str| {
            if !holds {
                found.push(what.to_owned());
            }
        };
        for name in [
            "RMS error, nominal robot",
            "RMS error, identified",
            "RMS error, with what was found",
            "Noise floor",
        ] {
            let printed = self.lines().find(|(own, _)| *own == name);
            let printed = printed.map_or_else(Vec::new, |(_, value)| numbers(value));
            check(!printed.is_empty(), name);
            let shown = numbers(&behind(name, &self.window));
            check(same(&printed, &shown), name);
            for number in printed {
                check(self.report.contains(&format!("{number:.4}")), name);
            }
        }
        // Every effect: its title, its size, its evidence and what to check.
        for title in self.titles() {
            let mut own = self.terminal.lines();
            own.find(|line| line.starts_with(&format!("{title} (")));
            let own = own.take_while(|line| line.starts_with(' '));
            let own: Vec<(&str, &str)> = own
                .filter_map(|line| line.trim().split_once("  "))
                .map(|(name, value)| (name, value.trim()))
                .collect();
            let row = |name: &str| own.iter().find(|row| row.0 == name).map(|row| row.1);
            let [Some(size), Some(evidence), Some(to_check)] =
                ["Size", "Evidence", "Check on the machine"].map(row)
            else {
                panic!("{title}: {}", self.terminal);
            };
            check(self.report.contains(&format!("<h3>{title}</h3>")), title);
            let at = self.window.iter().position(|label| label == title);
            let Some(at) = at else {
                check(false, title);
                continue;
            };
            let card = &self.window[at..];
            for one in size.split("; ") {
                let mut pairs = card.windows(2);
                let there = pairs.any(|pair| format!("{} {}", pair[0], pair[1]) == one);
                check(there, one);
            }
            let (proof, odds) = (behind("Evidence", card), behind("Odds", card));
            check(evidence.starts_with(&proof), evidence);
            check(evidence.contains(&odds), &odds);
            check(behind("Check on the machine", card) == to_check, to_check);
            check(self.report.contains(&proof.replace('<', "&lt;")), &proof);
            check(self.report.contains(&odds), &odds);
            if let Some(note) = row("Note") {
                check(behind("Note", card) == note, note);
                check(self.report.contains(note), note);
            }

            // The clipboard has the joint in a column of its own.
            let called = |row: &&Vec<String>| {
                row[0] == title || format!("{}, joint {}", row[0], row[1]) == title
            };
            let rows: Vec<&Vec<String>> = self.clipboard.iter().filter(called).collect();
            let sizes: Vec<f64> = size
                .split("; ")
                .map(|one| numbers(one.split('±').next().unwrap_or(one))[0])
                .collect();
            check(sizes.len() == rows.len(), size);
            for (size, row) in sizes.iter().zip(&rows) {
                let value = row[3].parse::<f64>().expect("a number").abs();
                check((size - value).abs() <= 0.02 * value.max(1e-4), title);
            }
            // Its errors on unseen samples are the last numbers of the evidence, where there are any.
            if let Some((_, errors)) = evidence.rsplit_once("cross-validated RMS error ") {
                let copied = rows.first().map_or(&[][..], |row| &row[12..]);
                let copied: Vec<f64> = copied.iter().filter_map(|n| n.parse().ok()).collect();
                check(same(&numbers(errors), &copied), errors);
            }
        }
        found
    }
}

/// The number behind a name, with another first digit.
fn other_digit(text: &str) -> String {
    let at = text.find(|c: char| ('1'..='8').contains(&c));
    let at = at.unwrap_or_else(|| panic!("no number: {text}"));
    let digit = text.as_bytes()[at] + 1;
    format!("{}{}{}", &text[..at], char::from(digit), &text[at + 1..])
}

#[test]
fn terminal_window_report_and_clipboard_say_the_same_of_an_axis_and_of_an_arm() {
    for (file, effects) in [("lamp-commissioning.json", 5), ("arm/arm.json", 2)] {
        let answers = Answers::of(file);
        let titles = answers.titles();
        assert!(titles.len() >= effects, "{file}: {}", answers.terminal);
        let found = answers.differences();
        assert!(found.is_empty(), "{file}: {found:#?}\n{}", answers.terminal);

        // One figure elsewhere, in any of the four, is noticed.
        let name = "RMS error, with what was found";
        let (_, error) = answers.lines().find(|(own, _)| *own == name).expect(name);
        let mut terminal = answers.clone();
        terminal.terminal = answers.terminal.replace(error, &other_digit(error));
        let mut window = answers.clone();
        let at = window.window.iter().position(|label| label == name);
        let value = &mut window.window[at.expect(name) + 1];
        *value = other_digit(value);
        let mut report = answers.clone();
        let number = format!("{:.4}", numbers(error)[0]);
        report.report = answers.report.replace(&number, "0.9999");
        let mut clipboard = answers.clone();
        let value = &mut clipboard.clipboard[1][3];
        *value = other_digit(value);
        for (place, wrong) in [
            ("terminal", terminal),
            ("window", window),
            ("report", report),
            ("clipboard", clipboard),
        ] {
            assert!(!wrong.differences().is_empty(), "{file}: {place}");
        }
    }
}

#[test]
fn a_reader_of_inches_reads_inches_in_every_sentence_of_the_diagnosis() {
    let mut window = window_of(
        [1280.0, 800.0],
        Some(session("lamp-commissioning.json")),
        Runner::AtOnce,
    );
    press(&mut window, "4 Diagnose");
    press(&mut window, "Run diagnosis");
    unfold(&mut window);
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
