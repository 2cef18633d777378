//! Thousands of commands at random, of every kind, with a frame drawn now and then: the workbench
//! stays consistent, undo and redo give the same document back, and what is on the disk is whole.
//!
//! A module of the window, of which it sees everything (`src/gui/workbench/mod.rs`), run by `tests/window/walk.rs`.

mod any;
mod looks;

use std::collections::{BTreeSet, VecDeque};
use std::path::Path;
use std::sync::Arc;

use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;

use any::Files;

use super::Workbench;
use crate::compensation::verify;
use crate::diagnostic::{Place, Severity};
use crate::gui::App;
use crate::gui::core::document::Document;
use crate::gui::core::regions::Division;
use crate::gui::core::simulate::Form;
use crate::gui::testing::workbench;
use crate::gui::view::{NextAction, What};
use crate::model::format_v1::load_model;
use crate::sessions;

/// So many commands are drawn for each that is done: the first of a kind that this walk has not done yet, so that what
/// is rare is done early on too.
const DRAWN: usize = 4;
/// Commands that are told when something is wrong.
const TAIL: usize = 25;

/// What is done, but what asks the system: a test cannot drive its dialogs.
const KINDS: &[&str] = &[
    "Adapt",
    "Add",
    "Blend",
    "ChartJoint",
    "Compensate",
    "Component",
    "ConfirmColumns",
    "CopyNumbers",
    "Correct",
    "Delete",
    "Dismiss",
    "Divide",
    "Do",
    "Draft",
    "Drop",
    "Effect",
    "EndDrag",
    "Exclude",
    "Export",
    "ExportTo",
    "Fit",
    "FitWorkspace",
    "UseRecent",
    "ForgetRobot",
    "Front",
    "GoTo",
    "Heat",
    "Hover",
    "Identify",
    "IdentifyBy",
    "Import",
    "Join",
    "KeepMine",
    "KeepRecovery",
    "KeepRegions",
    "KeepRobot",
    "Leave",
    "Left Discard",
    "Left Restore",
    "Look",
    "LookAtDisk",
    "Magnify",
    "Mark",
    "Method",
    "MoveBoundary",
    "OnlyAfter",
    "OpenExample",
    "OpenFile",
    "PlotSize",
    "Prefer",
    "Prepare",
    "Redo",
    "RegionsOfSession",
    "Reload",
    "Rename",
    "Results",
    "Save",
    "SaveAs",
    "SaveDespite",
    "SaveThen",
    "Say",
    "Search",
    "Select",
    "Setup",
    "Sheet",
    "ShowChart",
    "ShowEffect",
    "Side",
    "Simulate",
    "Split",
    "State",
    "Stop Dialog",
    "Stop Import",
    "Stop Newest",
    "Stop Search",
    "Switch",
    "Tolerance",
    "Turn",
    "Undo",
    "no_sheet",
];

/// Commands at random leave a consistent workbench; each seed is a walk of its own, of so many of them.
///
/// # Panics
/// They do not.
pub fn commands_at_random(seeds: u64, commands: usize) {
    let walks = std::thread::scope(|scope| {
        let walks: Vec<_> = (0..seeds)
            .map(|seed| scope.spawn(move || walk(seed, commands)))
            .collect();
        let ended = walks.into_iter().map(std::thread::ScopedJoinHandle::join);
        ended.collect::<Vec<_>>()
    });
    let mut done: BTreeSet<&str> = BTreeSet::new();
    for walk in walks {
        done.extend(walk.expect("a walk failed; see above which and where"));
    }
    let missed: Vec<&&str> = KINDS.iter().filter(|kind| !done.contains(**kind)).collect();
    assert!(missed.is_empty(), "what no walk has done: {missed:?}");
}

/// Tells where a walk was when something panics.
struct WalkReport {
    seed: u64,
    tail: VecDeque<String>,
}

impl Drop for WalkReport {
    fn drop(&mut self) {
        if std::thread::panicking() {
            eprintln!("seed {}, the last commands:", self.seed);
            self.tail.iter().for_each(|one| eprintln!("  {one}"));
        }
    }
}

/// The kinds of what it did.
fn walk(seed: u64, commands: usize) -> BTreeSet<&'static str> {
    let mut done = BTreeSet::new();
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let folder = tempfile::tempdir().expect("a folder");
    let mut files = prepared(folder.path());
    let mut app = App::on(workbench_at_home(folder.path()));
    let ctx = egui::Context::default();
    let mut report = WalkReport {
        seed,
        tail: VecDeque::new(),
    };
    for step in 0..commands {
        let mut deed = any::command(&mut random, app.bench(), &files);
        for _ in 1..DRAWN {
            if done.contains(deed.kind) {
                deed = any::command(&mut random, app.bench(), &files);
            }
        }
        done.insert(deed.kind);
        // A session in full is too much to be read.
        deed.says.truncate(deed.says.floor_char_boundary(160));
        report.tail.push_back(deed.says);
        if report.tail.len() > TAIL {
            report.tail.pop_front();
        }
        files
            .written
            .extend(deed.writes.filter(|path| !files.written.contains(path)));
        let bench = app.bench();
        bench.execute(deed.change);
        bench.receive();
        consistent(bench);
        if random.random_range(0..6) == 0 {
            back_and_forth(bench);
        }
        if random.random_range(0..60) == 0 {
            report
                .tail
                .push_back("save, read again, compare".to_owned());
            saved_is_read_again(bench, folder.path(), step);
        }
        if random.random_range(0..9) == 0 {
            report.tail.push_back("a frame".to_owned());
            frame(&ctx, &mut app, &mut random);
            consistent(app.bench());
        }
        if step % 100 == 0 {
            nothing_is_half_written(folder.path());
        }
    }
    all_the_way(app.bench());
    nothing_is_half_written(folder.path());
    done
}

/// Files to open: an instrument's, and one that is damaged.
fn prepared(folder: &Path) -> Files {
    let foreign = folder.join("messung 1.csv");
    let mut text = "winkel;x mm;y mm;z mm\n".to_owned();
    for k in -6..=6 {
        let angle = f64::from(k) * 12.0;
        let (sin, cos) = angle.to_radians().sin_cos();
        let row = format!("{angle};{};{};300\n", 245.0 * cos, 245.0 * sin);
        text.push_str(&row.replace('.', ","));
    }
    std::fs::write(&foreign, text).expect("it can be written");
    std::fs::write(
        folder.join("damaged.json"),
        "{\"format\": \"truepose-session/1\", ",
    )
    .expect("it can be written");
    let own = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/arms");
    std::fs::copy(own.join("six-60.json"), folder.join("six-60.json")).expect("it can be copied");
    // So few poses that no set-up error is looked for, which takes most of the time where robots are typed at random.
    let poses = std::fs::read_to_string(own.join("six-60.csv")).expect("it can be read");
    let few: Vec<&str> = poses.lines().take(1 + 9).collect();
    std::fs::write(folder.join("six-60.csv"), few.join("\n")).expect("it can be written");
    Files {
        written: Vec::new(),
        instrument_file: foreign,
        arm: folder.join("six-60.json"),
        folder: folder.to_path_buf(),
    }
}

/// A workbench with a home in which another window was killed.
fn workbench_at_home(folder: &Path) -> Workbench {
    let home = folder.join("home");
    let mut killed = workbench();
    killed.at_home(home.clone());
    killed.execute(|bench| {
        bench.go(NextAction::Simulate(Form {
            poses: 8,
            ..Form::default()
        }));
    });
    killed.receive();
    killed.execute(Workbench::keep_recovery);
    killed.receive();
    drop(killed);
    let mut bench = workbench();
    bench.at_home(home);
    bench.receive();
    assert!(bench.left_behind().is_some(), "what was killed is offered");
    bench.execute(|bench| {
        bench.go(NextAction::Simulate(Form {
            poses: 8,
            ..Form::default()
        }));
    });
    bench.receive();
    bench
}

/// What holds after every command.
fn consistent(bench: &Workbench) {
    let document = bench.document();
    let samples = bench.loaded_session().len();
    let view = &bench.view;
    let shown = [view.hovered, view.selected].into_iter().flatten();
    for sample in shown.chain(view.marked.iter().copied()) {
        assert!(sample < samples, "sample {sample} of {samples}");
    }
    divided(document);
    if let Some(answer) = bench.answer() {
        assert_eq!(answer.after.length_mm.len(), samples);
    }
    assert!((0.0..=1.0).contains(&view.blend));
    assert!(view.magnification.is_none_or(|m| m.is_finite() && m > 0.0));
    assert!(view.preferences == view.preferences.sound());

    let robot = &bench.loaded_session().session.robot;
    let problems = robot.problems(&Place::default());
    assert!(
        problems.iter().all(|d| d.severity != Severity::Error),
        "{problems:?}"
    );
    assert!(document.export.joint < robot.joints.len());
    assert!(
        document
            .tolerance_mm
            .is_none_or(|t| t.is_finite() && t > 0.0)
    );
    assert!(bench.settled() || bench.is_declined(), "nobody asked");
    if let Some(message) = &view.message {
        let inside = "Something went wrong inside the program";
        assert_ne!(message.title, inside, "{message:?}");
        let nan = |text: &String| text.contains("NaN") && !text.contains("'NaN'");
        assert!(!message.details.iter().any(nan), "{message:?}");
    }
}

/// Regions are finite, begin before they end, do not overlap, and each has a name of its own.
fn divided(document: &Document) {
    let mut sorted: Vec<_> = document.regions.iter().collect();
    for region in &sorted {
        assert!(region.from_rad.is_finite() && region.to_rad.is_finite());
        assert!(region.from_rad < region.to_rad, "{region:?}");
    }
    sorted.sort_by(|a, b| a.from_rad.total_cmp(&b.from_rad));
    for pair in sorted.windows(2) {
        assert!(pair[0].to_rad <= pair[1].from_rad + 1e-9, "{pair:?}");
    }
    let names: BTreeSet<&str> = sorted.iter().map(|r| r.name.as_str()).collect();
    assert_eq!(names.len(), sorted.len(), "two regions of one name");
    assert!(!names.contains(""), "a region without a name");
    if let Division::Adaptive(decision) = &document.division {
        assert_eq!(decision.regions, sorted.len());
    }
    assert!(document.regions.is_empty() || document.loaded_session.single_revolute());
}

/// Undo and redo give the identical document back.
fn back_and_forth(bench: &mut Workbench) {
    bench.execute(|bench| bench.drag(false));
    bench.receive();
    let Some(what) = bench.undoes() else {
        return;
    };
    let before = bench.document().clone();
    bench.execute(Workbench::undo);
    bench.receive();
    assert_ne!(
        *bench.document(),
        before,
        "undo of “{what}” changed nothing"
    );
    consistent(bench);
    bench.execute(Workbench::redo);
    bench.receive();
    assert_eq!(*bench.document(), before, "redo of “{what}”");
    assert_eq!(bench.undoes(), Some(what));
}

/// All the way back and forth: the same document, and the answer that belongs to it.
fn all_the_way(bench: &mut Workbench) {
    bench.execute(|bench| bench.drag(false));
    bench.receive();
    let last = bench.document().clone();
    let mut steps = 0;
    while bench.undoes().is_some() {
        bench.execute(Workbench::undo);
        bench.receive();
        consistent(bench);
        steps += 1;
    }
    for _ in 0..steps {
        bench.execute(Workbench::redo);
        bench.receive();
    }
    assert_eq!(*bench.document(), last);
}

/// What is saved is read as it was, and a saved model predicts the same to the last bit.
fn saved_is_read_again(bench: &mut Workbench, folder: &Path, step: usize) {
    let document = bench.document().clone();
    let session = &document.loaded_session.session;
    if !document.loaded_session.is_empty() {
        let path = folder.join(format!("read again {step}.json"));
        let replacing = sessions::Replacing {
            force: false,
            inputs: &[],
        };
        let wanted = document.session_to_save();
        sessions::save(&wanted, &path, replacing).expect("it can be saved");
        let read = sessions::load(&path).expect("what was saved can be read");
        let opened = Document::new(Arc::new(
            crate::gui::core::loaded_session::LoadedSession::new(
                read.session,
                Vec::new(),
                crate::gui::core::loaded_session::Origin::Simulated,
            ),
        ));
        if !document.regions.is_empty() {
            assert_eq!(opened.regions, document.regions, "regions");
        }
        assert_eq!(opened.tolerance_mm, document.tolerance_mm);
        let again = &opened.loaded_session.session;
        assert_eq!(again.robot, session.robot);
        assert_eq!(again.targets, session.targets);
        let bits = |column: &[f64]| column.iter().map(|v| v.to_bits()).collect::<Vec<_>>();
        assert_eq!(bits(&again.samples.x_mm), bits(&session.samples.x_mm));
        assert_eq!(bits(&again.samples.q[0]), bits(&session.samples.q[0]));
    }
    if bench.answer().is_none() {
        return;
    }
    // What waits for a model to be saved would open another session then.
    bench.execute(Workbench::cancel_pending_action);
    let path = folder.join(format!("model {step}.json"));
    bench.execute(|bench| bench.export_as(What::Model, path.clone(), false));
    bench.receive();
    if !path.exists() {
        // A model of few or wrong rows may be worse than the nominal robot, and is refused.
        let message = bench.view.message.as_ref().expect("it says why");
        let answer = bench.answer().expect("it is there still");
        let handed_out = crate::pipeline::hand_out(&answer.calibration, session);
        assert!(message.wrong && handed_out.is_err(), "{message:?}");
        return;
    }
    let read = load_model(&path).expect("a model that was saved can be read");
    let answer = bench.answer().expect("it is there still");
    if document.loaded_session.is_empty() {
        assert_eq!(
            read.model.terms().len(),
            answer.calibration.model.terms().len()
        );
        return;
    }
    let (here, again) = (verify(&answer.calibration, session), verify(&read, session));
    match (here, again) {
        (Ok(here), Ok(again)) => {
            let same = here.after.length_mm.iter().zip(&again.after.length_mm);
            for (sample, (a, b)) in same.enumerate() {
                assert_eq!(a.to_bits(), b.to_bits(), "sample {sample}: {a} and {b}");
            }
        }
        (here, again) => assert_eq!(here.is_ok(), again.is_ok()),
    }
}

/// Draws a frame of some size, in which the pointer rests somewhere.
fn frame(ctx: &egui::Context, app: &mut App, random: &mut ChaCha8Rng) {
    let size = [
        (1280.0, 800.0),
        (1024.0, 700.0),
        (1120.0, 640.0),
        (3840.0, 2160.0),
    ];
    let (width, height): (f32, f32) = size[random.random_range(0..size.len())];
    let at = egui::pos2(
        random.random_range(0.0..width),
        random.random_range(0.0..height),
    );
    let input = egui::RawInput {
        screen_rect: Some(egui::Rect::from_min_size(
            egui::Pos2::ZERO,
            egui::vec2(width, height),
        )),
        events: vec![egui::Event::PointerMoved(at)],
        ..egui::RawInput::default()
    };
    for _ in 0..2 {
        let mut output = ctx.run_ui(input.clone(), |ui| app.show(ui));
        output.textures_delta.clear();
    }
}

/// Every file is whole: nothing of an unfinished one is there, and each document can be read.
fn nothing_is_half_written(folder: &Path) {
    for entry in std::fs::read_dir(folder)
        .expect("it can be listed")
        .flatten()
    {
        let path = entry.path();
        let name = entry.file_name().to_string_lossy().into_owned();
        assert!(!name.starts_with(".truepose-"), "{name} was left behind");
        let is_document = path.extension().is_some_and(|e| e == "json") && path.is_file();
        if is_document && name != "damaged.json" {
            let bytes = std::fs::read(&path).expect("it can be read");
            let read = serde_json::from_slice::<serde_json::Value>(&bytes);
            assert!(read.is_ok(), "{name}: {read:?}");
        }
    }
}
