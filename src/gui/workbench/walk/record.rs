//! Commands about the record of a machine, sensible or not.

use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use super::any::{Files, one_of};
use crate::compensation::decision::Rule;
use crate::gui::file_state::machines::Stated;
use crate::gui::file_state::recording::RecordingRequest;
use crate::gui::view::Sheet;
use crate::gui::workbench::{Command, Task, ViewChange, Workbench};
use crate::report::Details;

pub(super) fn command(random: &mut ChaCha8Rng, workbench: &Workbench, files: &Files) -> Command {
    match random.random_range(0..8) {
        5 => Command::Stop(Task::Recording),
        6 => Command::View(ViewChange::Sheet(Some(Sheet::RECORDING))),
        7 => Command::Record(Box::new(recording(random, files))),
        0 => Command::CompareSessions(files.any(random)),
        1 => Command::View(ViewChange::Sheet(Some(Sheet::DETAILS))),
        2 => Command::View(ViewChange::Sheet(Some(Sheet::HISTORY))),
        _ => Command::State(Box::new(stated(random, workbench, files))),
    }
}

/// From nowhere: no walk depends on the network.
fn recording(random: &mut ChaCha8Rng, files: &Files) -> RecordingRequest {
    let addresses = [
        "",
        "tcp://",
        "udp://127.0.0.1:0",
        "tcp://127.0.0.1:99999",
        "file:///x:1",
    ];
    RecordingRequest {
        address: one_of(random, &addresses)
            .copied()
            .unwrap_or_default()
            .to_owned(),
        columns: "q1_deg, x_mm".to_owned(),
        path: files.to_write(random, "csv"),
    }
}

fn stated(random: &mut ChaCha8Rng, workbench: &Workbench, files: &Files) -> Stated {
    let mut stated = workbench.stated();
    let texts = ["", "L-17", "<b>ß·∆\u{202e}", "22 Nov 2026"];
    if let (Some(line), Some(text)) = (one_of(random, Details::LINES), one_of(random, &texts)) {
        *(line.of)(&mut stated.details) = (*text).to_owned();
    }
    stated.details.rule = one_of(random, &Rule::ALL).copied();
    stated.details.tolerance_mm = one_of(random, &[None, Some(0.2)]).copied().flatten();
    if random.random_range(0..4) == 0 {
        stated.logo = files.any(random).display().to_string();
    }
    stated
}
