//! What is read, imported or saved says how far it is, at the bottom of the window, and is cancelled
//! there. The work waits for the test wherever it is looked at, so that nothing depends on time.

use std::fmt::Debug;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender};

use egui::{Context, Event, Modifiers, PointerButton, Pos2, RawInput, Rect, Shape, Ui, pos2, vec2};

use super::under_way::{gate, idle, on_threads, until};
use crate::gui::import_draft::ImportDraft;
use crate::gui::jobs::{Kind, Running, Watch};
use crate::gui::testing::workbench;
use crate::gui::view::{NextAction, Sheet, What};
use crate::gui::views::status;
use crate::gui::workbench::Workbench;
use crate::gui::{dialogs, files};
use crate::progress::Progress;
use crate::watching::{assert_grows, no_at, report_to};

/// A part of the window with this workbench, without a display.
struct Shown {
    ctx: Context,
    show: fn(&mut Ui, &mut Workbench),
}

impl Shown {
    fn new(show: fn(&mut Ui, &mut Workbench)) -> Self {
        let ctx = Context::default();
        Self { ctx, show }
    }

    /// The texts of one frame and where they are.
    fn frame(&self, bench: &mut Workbench, events: Vec<Event>) -> Vec<(String, Pos2)> {
        let input = RawInput {
            screen_rect: Some(Rect::from_min_size(Pos2::ZERO, vec2(1280.0, 800.0))),
            events,
            ..RawInput::default()
        };
        let mut output = self.ctx.run_ui(input, |ui| (self.show)(ui, bench));
        output.textures_delta.clear();
        let texts = output.shapes.iter().filter_map(|shape| match &shape.shape {
            Shape::Text(text) => {
                let middle = text.visual_bounding_rect().center();
                Some((text.galley.text().to_owned(), middle))
            }
            _ => None,
        });
        texts.collect()
    }

    fn describe(&self, bench: &mut Workbench) -> Vec<String> {
        let texts = self.frame(bench, Vec::new());
        texts.into_iter().map(|(text, _)| text).collect()
    }

    /// Presses what this stands on, and does what that asks for.
    fn press(&self, bench: &mut Workbench, label: &str) {
        // What is new has its place from the second frame on.
        self.frame(bench, Vec::new());
        let texts = self.frame(bench, Vec::new());
        let there = texts.iter().find(|(text, _)| text == label);
        let at = there.unwrap_or_else(|| panic!("no {label} in {texts:?}")).1;
        let button = |pressed| Event::PointerButton {
            pos: at,
            button: PointerButton::Primary,
            pressed,
            modifiers: Modifiers::NONE,
        };
        self.frame(bench, vec![Event::PointerMoved(at)]);
        self.frame(bench, vec![button(true)]);
        self.frame(bench, vec![button(false)]);
        assert!(bench.make_changes(), "{label}");
        // Away again.
        self.frame(bench, vec![Event::PointerMoved(pos2(1.0, 799.0))]);
    }
}

/// Work that has done a part, says so, and goes on when it is let go. What it ends with is kept.
fn halfway<T: Debug + 'static>(
    work: impl FnOnce(&Watch) -> T + Send + 'static,
) -> (
    impl FnOnce(&Watch) -> T + Send + 'static,
    Receiver<()>,
    Sender<()>,
    Receiver<String>,
) {
    let (here, arrived) = gate();
    let (go, wait) = gate();
    let (ended, ends) = std::sync::mpsc::channel();
    let work = move |watch: &Watch| {
        watch.done(0.3);
        let _ = here.send(());
        let _ = wait.recv();
        let made = work(watch);
        let _ = ended.send(format!("{made:?}"));
        made
    };
    (work, arrived, go, ends)
}

fn bar() -> Shown {
    Shown::new(|ui, bench| status::show(ui, bench))
}

/// A session in a folder of its own.
fn saved(folder: &Path) -> PathBuf {
    let path = folder.join("session.json");
    let mut first = workbench();
    first.execute(|bench| bench.export_as(What::Session, path.clone(), false));
    first.receive();
    path
}

/// What a tracker wrote.
fn measured(folder: &Path) -> PathBuf {
    let path = folder.join("tracker.csv");
    let row = |k: i32| format!("{k}.5,{}.25,{}.125,300.5\n", 200 + k % 50, k % 90);
    let rows: String = (0..200).map(row).collect();
    fs::write(&path, format!("q1_deg,x_mm,y_mm,z_mm\n{rows}")).unwrap();
    path
}

#[test]
fn a_session_that_is_opened_says_how_far_it_is_and_is_cancelled() {
    let folder = tempfile::tempdir().unwrap();
    let path = saved(folder.path());
    let mut bench = on_threads();
    let before = bench.document().clone();
    let (work, arrived, go, ends) = halfway(move |watch| files::open(&path, watch));
    bench.open("reading session.json", work);
    arrived.recv().unwrap();
    let bar = bar();
    let says = bar.describe(&mut bench);
    assert!(says.iter().any(|s| s == "reading session.json"), "{says:?}");
    let share = bench.jobs.newest().and_then(Running::progress);
    assert_eq!(share, Some(0.3));
    bar.press(&mut bench, "Cancel");
    assert!(!bar.describe(&mut bench).iter().any(|s| s == "Cancel"));
    go.send(()).unwrap();
    assert!(ends.recv().unwrap().contains("it was cancelled"));
    bench.receive();
    assert!(idle(&bench));
    assert_eq!(*bench.document(), before);
    assert!(
        bench.view.message.is_none(),
        "no message repeats what the user did"
    );
}

#[test]
fn a_session_that_is_saved_says_how_far_it_is_and_cancelled_the_old_file_stays() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("session.json");
    let csv = path.with_extension("csv");
    fs::write(&path, "an old document").unwrap();
    fs::write(&csv, "old samples").unwrap();
    let mut bench = on_threads();
    bench.execute(|bench| bench.go(NextAction::Example(1)));
    until(&mut bench, idle);
    bench.execute(|bench| {
        bench.edit(|document| document.divide(3));
    });
    until(&mut bench, idle);
    assert!(bench.unsaved());
    let document = Arc::clone(bench.history.present());
    let to = path.clone();
    let (work, arrived, go, ends) =
        halfway(move |watch| files::save(document, &to, files::Replace::Named, Vec::new(), watch));
    bench.jobs.start(
        Kind::Writes,
        "writing session.json",
        work,
        Workbench::take_saved,
    );
    arrived.recv().unwrap();
    let bar = bar();
    assert!(
        bar.describe(&mut bench)
            .iter()
            .any(|s| s == "writing session.json")
    );
    bar.press(&mut bench, "Cancel");
    assert!(bar.describe(&mut bench).iter().any(|s| s == "cancelling"));
    go.send(()).unwrap();
    assert!(ends.recv().unwrap().contains("it was cancelled"));
    until(&mut bench, idle);
    assert!(bench.unsaved());
    let message = bench.view.message.as_ref().expect("it is said");
    assert!(message.title.ends_with("was not written"), "{message:?}");
    assert!(message.details.iter().any(|d| d == "it was cancelled"));
    assert_eq!(fs::read_to_string(&path).unwrap(), "an old document");
    assert_eq!(fs::read_to_string(&csv).unwrap(), "old samples");
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 2);
}

#[test]
fn a_measured_file_that_is_looked_at_says_how_far_it_is_and_is_left_and_looked_at_again() {
    let folder = tempfile::tempdir().unwrap();
    let path = measured(folder.path());
    let mut bench = on_threads();
    let before = bench.document().clone();
    bench.execute(|bench| bench.go(NextAction::Open(path)));
    until(&mut bench, |b| {
        matches!(b.view.sheet, Some(Sheet::Import(_)))
    });
    let Some(Sheet::Import(foreign)) = bench.view.sheet.clone() else {
        panic!("it was waited for");
    };
    // Something is said, and the look at it waits for the test.
    let mut said = foreign.answers.clone();
    said.name = "another name".to_owned();
    let mut looked_at = (*foreign).clone();
    looked_at.answers = said.clone();
    let (work, arrived, go, ends) =
        halfway(move |watch| looked_at.look(watch).map_err(|c| c.to_string()));
    let what = "looking at the file";
    bench.jobs.start(Kind::Looks, what, work, |_, _| ());
    bench.execute(|bench| bench.change_draft(|draft| draft.answers = said));
    arrived.recv().unwrap();
    let sheet = Shown::new(|ui, bench| dialogs::show(ui, bench));
    sheet.press(&mut bench, "Stop looking");
    assert!(bench.looking().is_none());
    go.send(()).unwrap();
    assert!(ends.recv().unwrap().contains("cancelled"));
    bench.receive();
    let says = sheet.describe(&mut bench);
    let expected = "It was cancelled";
    assert!(says.iter().any(|s| s == expected), "{says:?}");
    sheet.press(&mut bench, "Look again");
    until(&mut bench, |bench| match &bench.view.sheet {
        Some(Sheet::Import(foreign)) => foreign.is_up_to_date(),
        _ => false,
    });
    assert_eq!(*bench.document(), before);
    // Closing the sheet cancels the look.
    let (work, arrived, go, _) = halfway(|_| ());
    bench.jobs.start(Kind::Looks, what, work, |_, ()| ());
    arrived.recv().unwrap();
    bench.execute(|bench| bench.show_sheet(None));
    assert!(idle(&bench));
    let _ = go.send(());
}

#[test]
fn what_is_done_with_what_was_read_is_told_when_its_share_is_not_known() {
    let mut bench = on_threads();
    let (work, arrived, go, _) = halfway(|watch| {
        watch.doing("checking 1000 samples".to_owned());
    });
    let work = move |watch: &Watch| {
        watch.doing("checking 1000 samples".to_owned());
        work(watch);
    };
    bench
        .jobs
        .start(Kind::Opens, "reading session.json", work, |_, ()| ());
    arrived.recv().unwrap();
    let says = bar().describe(&mut bench);
    assert!(
        says.iter().any(|s| s == "checking 1000 samples"),
        "{says:?}"
    );
    let _ = go.send(());
    until(&mut bench, idle);
}

#[test]
fn looking_at_a_measured_file_can_be_cancelled_wherever_it_tells_how_far_it_is() {
    let folder = tempfile::tempdir().unwrap();
    let path = measured(folder.path());
    let of = |watch: &dyn Fn(f64) -> std::ops::ControlFlow<()>| {
        let progress = Progress::new(watch);
        ImportDraft::of(&path, progress.whole()).expect("it is none of the program's own")
    };
    let (shares, foreign) = report_to(of);
    foreign.expect("it is a table");
    assert_grows(&shares);
    for number in 0..shares.len() {
        let cut = of(&no_at(number));
        assert_eq!(cut.expect_err("cancelled").to_string(), "cancelled");
    }
}
