//! Following a file that something else goes on writing, as a person at the machine would: the gap
//! and the intervals follow every line.

use std::fs;
use std::io::Write;
use std::path::PathBuf;

use crate::window::{Window, copy_of, gaps, keys, open, press, says, seconds, window};
use egui::{Key, Modifiers};
use egui_kittest::kittest::{NodeT, Queryable};

/// A session of which only the first samples are written so far.
struct Measuring {
    _folder: tempfile::TempDir,
    session: PathBuf,
    samples: PathBuf,
    lines: Vec<String>,
    written: usize,
}

impl Measuring {
    fn begin(first: usize) -> Self {
        let folder = tempfile::tempdir().expect("a folder");
        let session = copy_of("lamp-commissioning", folder.path());
        let samples = session.with_extension("csv");
        let text = fs::read_to_string(&samples).expect("the samples");
        let lines: Vec<String> = text.lines().map(|l| format!("{l}\n")).collect();
        fs::write(&samples, lines[..=first].concat()).expect("written");
        Self {
            _folder: folder,
            session,
            samples,
            lines,
            written: first + 1,
        }
    }

    fn append(&self, text: &str) {
        let file = fs::OpenOptions::new().append(true).open(&self.samples);
        let mut file = file.expect("it can be opened");
        file.write_all(text.as_bytes()).expect("written");
    }

    fn measure(&mut self, more: usize) {
        let until = (self.written + more).min(self.lines.len());
        self.append(&self.lines[self.written..until].concat());
        self.written = until;
    }
}

fn follow(window: &mut Window) {
    keys(window, Modifiers::COMMAND, Key::I);
    keys(window, Modifiers::COMMAND, Key::L);
}

/// Half widths of the intervals that are shown.
fn half_widths(window: &Window) -> Vec<f64> {
    let nodes = window.query_all_by_label_contains("± ");
    let labels = nodes.filter_map(|n| n.accesskit_node().label().or(n.accesskit_node().value()));
    let number = |label: String| label.split(' ').nth(1)?.parse().ok();
    labels.filter_map(number).collect()
}

#[test]
fn new_lines_become_samples_and_the_intervals_shrink() {
    let mut measuring = Measuring::begin(60);
    let mut window = window(Some(measuring.session.clone()));
    follow(&mut window);
    assert!(says(&window, "60 samples · RMS error"));
    assert!(says(&window, "following the file · 0 new"));
    let at_first = half_widths(&window);
    assert!(!at_first.is_empty());
    for expected in [70, 80, 90, 100, 150, 207] {
        measuring.measure(expected + 1 - measuring.written);
        seconds(&mut window, 2);
        assert!(
            says(&window, &format!("{expected} samples · RMS error")),
            "{expected}"
        );
        assert!(gaps(&window).1.is_some(), "the answer follows");
    }
    assert!(says(&window, "following the file · 147 new"));
    let at_last = half_widths(&window);
    assert!(
        at_last.len() == at_first.len() && at_last.iter().zip(&at_first).all(|(a, b)| a < b),
        "{at_first:?} → {at_last:?}"
    );
    assert!(!says(&window, "not saved"), "what is in the file is saved");

    // The same as if the whole file had been opened now.
    let followed = gaps(&window);
    let session = measuring.session.clone();
    let mut whole = crate::window::window(Some(session));
    keys(&mut whole, Modifiers::COMMAND, Key::I);
    let (before, after) = gaps(&whole);
    assert_eq!(before, followed.0);
    let (a, b) = (after.expect("identified"), followed.1.expect("identified"));
    assert!((a - b).abs() <= 0.01 * a, "{a} and {b}");
}

#[test]
fn half_a_line_waits_until_it_is_whole() {
    let measuring = Measuring::begin(60);
    let mut window = window(Some(measuring.session.clone()));
    follow(&mut window);
    let line = &measuring.lines[61];
    measuring.append(&line[..line.len() / 2]);
    seconds(&mut window, 3);
    assert!(says(&window, "60 samples · RMS error") && !says(&window, "cannot be followed"));
    measuring.append(&line[line.len() / 2..]);
    seconds(&mut window, 2);
    assert!(says(&window, "61 samples · RMS error"));
}

#[test]
fn a_file_that_was_rewritten_is_read_anew() {
    let measuring = Measuring::begin(60);
    let mut window = window(Some(measuring.session.clone()));
    follow(&mut window);
    fs::write(&measuring.samples, measuring.lines[..=40].concat()).expect("written");
    seconds(&mut window, 2);
    assert!(says(&window, "40 samples · RMS error"));
    assert!(says(&window, "was rewritten and is read anew"));
    measuring.append(&measuring.lines[41]);
    seconds(&mut window, 2);
    assert!(
        says(&window, "41 samples · RMS error"),
        "and is followed on"
    );
}

#[test]
fn a_line_that_cannot_be_read_ends_it_with_its_place_and_nothing_is_lost() {
    let mut measuring = Measuring::begin(60);
    let mut window = window(Some(measuring.session.clone()));
    follow(&mut window);
    measuring.append("not,a,number\n");
    seconds(&mut window, 2);
    assert!(says(&window, "cannot be followed any further"));
    assert!(says(&window, "line 62"));
    assert!(says(&window, "60 samples · RMS error"));
    // Mended and followed again.
    fs::write(&measuring.samples, measuring.lines[..=60].concat()).expect("written");
    keys(&mut window, Modifiers::COMMAND, Key::L);
    measuring.written = 61;
    measuring.measure(5);
    seconds(&mut window, 2);
    assert!(says(&window, "65 samples · RMS error"));
}

#[test]
fn undo_goes_back_over_changes_and_not_over_samples() {
    let mut measuring = Measuring::begin(60);
    let mut window = window(Some(measuring.session.clone()));
    follow(&mut window);
    measuring.measure(10);
    seconds(&mut window, 2);
    keys(&mut window, Modifiers::COMMAND, Key::Z);
    assert!(
        says(&window, "70 samples · RMS error"),
        "only the identification is undone"
    );
    assert_eq!(gaps(&window).1, None);
    keys(
        &mut window,
        Modifiers::COMMAND.plus(Modifiers::SHIFT),
        Key::Z,
    );
    assert!(gaps(&window).1.is_some());
}

#[test]
fn another_session_ends_it_and_a_robot_that_is_edited_does_not() {
    let mut measuring = Measuring::begin(60);
    let mut window = window(Some(measuring.session.clone()));
    follow(&mut window);
    press(&mut window, "Instrument");
    crate::window::type_into(&mut window, "Noise", "0.02");
    measuring.measure(10);
    seconds(&mut window, 3);
    assert!(says(&window, "70 samples · RMS error") && says(&window, "following"));
    keys(&mut window, Modifiers::NONE, Key::F3);
    press(&mut window, "Open without saving");
    assert!(!says(&window, "following"));
    let folder = tempfile::tempdir().expect("a folder");
    open(&mut window, &copy_of("paper-run", folder.path()));
    measuring.measure(10);
    seconds(&mut window, 2);
    assert!(says(&window, "361 samples · RMS error"));
}
