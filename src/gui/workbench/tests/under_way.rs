//! What happens while something is under way in the background: it is cancelled, something else is
//! asked for, the window is closed. The work waits for the test, so that nothing depends on time.

use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex};
use std::time::Duration;

use crate::gui::core::document::Method;
use crate::gui::core::simulate::Form;
use crate::gui::files;
use crate::gui::jobs::{Jobs, Kind, Runner, Watch};
use crate::gui::testing::workbench;
use crate::gui::view::{Message, NextAction, Step, What};
use crate::gui::workbench::{Change, Workbench};

pub(super) fn on_threads() -> Workbench {
    let mut bench = workbench();
    bench.jobs = Jobs::new(Runner::Threads, Arc::new(|| {}));
    bench
}

/// Lets go of a task that waits for it.
pub(super) fn gate() -> (Sender<()>, Receiver<()>) {
    channel()
}

/// Takes reports until this holds.
pub(super) fn until(bench: &mut Workbench, holds: impl Fn(&Workbench) -> bool) {
    // A minute and more, however slow the machine is.
    for _ in 0..30_000 {
        bench.receive();
        if holds(bench) {
            return;
        }
        std::thread::sleep(Duration::from_millis(2));
    }
    panic!("it never came to that");
}

fn written() -> Message {
    Message::saved(std::path::Path::new("report.pdf"), Vec::new())
}

/// Writes something: it is done once the test lets go.
fn write(
    bench: &mut Workbench,
    what: &str,
    made: impl FnOnce() -> Message + Send + 'static,
) -> Sender<()> {
    let (go, wait) = gate();
    let work = move |_: &Watch| {
        let _ = wait.recv();
        made()
    };
    bench
        .jobs
        .start(Kind::Writes, what, work, Workbench::take_written);
    go
}

pub(super) fn idle(bench: &Workbench) -> bool {
    bench.jobs.newest().is_none()
}

#[test]
fn whatever_is_cancelled_leaves_everything_as_it_was() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("session.json");
    let mut first = workbench();
    first.execute(|bench| bench.export_as(What::Session, path.clone(), false));
    first.receive();
    let changes: [(&str, Change); 5] = [
        (
            "open",
            Box::new(move |bench| bench.go(NextAction::Open(path))),
        ),
        (
            "example",
            Box::new(|bench| bench.go(NextAction::Example(1))),
        ),
        (
            "simulate",
            Box::new(|bench| bench.go(NextAction::Simulate(Form::default()))),
        ),
        ("adapt", Box::new(Workbench::adapt)),
        ("search", Box::new(Workbench::search)),
    ];
    for (says, change) in changes {
        let mut bench = on_threads();
        bench.execute(|bench| bench.identify(None));
        until(&mut bench, idle);
        let before = bench.document().clone();
        bench.execute(change);
        assert!(!idle(&bench), "{says}: the status bar names it");
        bench.execute(Workbench::cancel_newest);
        // Long enough for any of them to have come back.
        for _ in 0..40 {
            bench.receive();
            std::thread::sleep(Duration::from_millis(5));
        }
        assert!(idle(&bench), "{says}");
        assert_eq!(*bench.document(), before, "{says}");
        assert!(bench.searched().is_none(), "{says}");
        assert!(bench.answer().is_some(), "{says}");
    }
}

#[test]
fn a_file_that_is_being_written_tells_how_it_went_although_it_was_cancelled() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("session.json");
    let mut bench = on_threads();
    let (go, wait) = gate();
    let document = Arc::clone(bench.history.present());
    let to = path.clone();
    let work = move |_: &Watch| {
        let _ = wait.recv();
        // It was too late: the question was withdrawn.
        let asked = Watch::default();
        files::save(document, &to, files::Replace::Nothing, Vec::new(), &asked)
    };
    bench
        .jobs
        .start(Kind::Writes, "saving", work, Workbench::take_saved);
    bench.execute(Workbench::cancel_newest);
    assert!(!idle(&bench), "it is still being written");
    go.send(()).expect("it waits");
    until(&mut bench, idle);
    assert!(path.exists());
    assert!(!bench.unsaved(), "the window knows that the file is there");
}

#[test]
fn what_was_to_be_done_after_a_file_is_not_done_once_it_was_cancelled() {
    let mut bench = on_threads();
    bench.execute(|bench| bench.go(NextAction::Example(1)));
    until(&mut bench, idle);
    let go = write(&mut bench, "writing", written);
    bench.execute(|bench| bench.ask_then(NextAction::Leave));
    bench.execute(Workbench::cancel_newest);
    go.send(()).expect("it waits");
    until(&mut bench, idle);
    assert!(!bench.view.leaving);
}

#[test]
fn the_window_closes_after_what_is_being_written() {
    let mut bench = on_threads();
    bench.execute(|bench| bench.go(NextAction::Example(1)));
    until(&mut bench, idle);
    let go = write(&mut bench, "writing the report", written);
    bench.execute(|bench| bench.ask_then(NextAction::Leave));
    assert!(!bench.view.leaving, "not before it is written");
    let message = bench.view.message.as_ref().expect("it is said");
    assert_eq!(
        message.title,
        "The window closes when this is done: writing the report"
    );
    go.send(()).expect("it waits");
    until(&mut bench, |bench| bench.view.leaving);
}

#[test]
fn a_file_that_was_not_written_keeps_the_window_open() {
    let mut bench = on_threads();
    bench.execute(|bench| bench.go(NextAction::Example(1)));
    until(&mut bench, idle);
    let go = write(&mut bench, "writing the report", || {
        files::not_written(
            std::path::Path::new("report.pdf"),
            "the disk is full".to_owned(),
        )
    });
    bench.execute(|bench| bench.ask_then(NextAction::Leave));
    go.send(()).expect("it waits");
    until(&mut bench, idle);
    assert!(!bench.view.leaving);
    assert!(bench.view.message.as_ref().is_some_and(|m| m.wrong));
}

#[test]
fn of_two_sessions_the_one_asked_for_last_is_opened_whichever_takes_longer() {
    let mut bench = on_threads();
    let (go, wait) = gate();
    bench.open("reading something long", move |_| {
        let _ = wait.recv();
        files::open_example(2)
    });
    bench.execute(|bench| bench.go(NextAction::Example(1)));
    until(&mut bench, |bench| bench.loaded_session().len() == 30);
    // The first one has no window left to report to.
    let _ = go.send(());
    for _ in 0..40 {
        bench.receive();
        std::thread::sleep(Duration::from_millis(5));
    }
    assert_eq!(bench.loaded_session().len(), 30);
}

#[test]
fn commands_while_something_runs_are_done_and_the_result_of_another_session_is_not_taken() {
    let mut bench = on_threads();
    let loaded_session = Arc::clone(bench.loaded_session());
    let (go, wait) = gate();
    let (adapted, came) = channel();
    let work = move |_: &Watch| {
        let _ = wait.recv();
        let _ = adapted.send(());
        crate::gui::workbench::drafts::adapted(loaded_session)
    };
    let what = "looking where regions are needed";
    bench
        .jobs
        .start(Kind::Once, what, work, Workbench::take_adapted);
    // Everything goes on meanwhile.
    bench.execute(|bench| bench.view.step = Step::Export);
    bench.execute(|bench| bench.identify(Some(Method::Regional)));
    bench.execute(Workbench::undo);
    bench.execute(Workbench::redo);
    bench.execute(|bench| bench.go(NextAction::Example(1)));
    until(&mut bench, |bench| bench.loaded_session().len() == 30);
    let before = bench.document().clone();
    go.send(()).expect("it waits");
    came.recv().expect("it was worked out");
    until(&mut bench, idle);
    assert_eq!(*bench.document(), before, "it was about another session");
}

#[test]
fn an_export_while_the_answer_is_worked_out_anew_says_so_or_writes_what_is_shown() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("table.csv");
    let mut bench = on_threads();
    bench.execute(|bench| bench.export_as(What::Table, path.clone(), false));
    let message = bench.view.message.as_ref().expect("it is said");
    assert_eq!(message.title, "There is nothing to export yet");
    bench.execute(|bench| bench.identify(None));
    until(&mut bench, |bench| bench.answer().is_some());
    bench.execute(|bench| bench.export_as(What::Table, path.clone(), false));
    // Another answer is asked for while the table is written.
    bench.execute(|bench| {
        bench.edit(|document| document.choose_effect("backlash", false));
    });
    until(&mut bench, idle);
    assert!(path.exists());
}

/// While a dialog is open the window takes no commands; a session that was being read may come all the same.
#[test]
fn what_a_dialog_was_opened_for_is_written_whatever_is_open_by_then() {
    type Ask = fn(&mut Workbench);
    let folder = tempfile::tempdir().expect("a folder");
    let mut bench = on_threads();
    bench.execute(|bench| bench.identify(None));
    until(&mut bench, |bench| bench.answer().is_some());
    let asks: [(Ask, &str); 2] = [
        (
            |bench| bench.choose_where_to_export(What::Session),
            "first.json",
        ),
        (
            |bench| bench.choose_where_to_export(What::Table),
            "first.csv",
        ),
    ];
    for (ask, name) in asks {
        let path = folder.path().join(name);
        let (go, wait) = gate();
        let (wait, chosen) = (Mutex::new(wait), path.clone());
        bench.chooser = Some(Arc::new(move || {
            let _ = wait.lock().ok()?.recv();
            Some(chosen.clone())
        }));
        let before = bench.loaded_session().session.name.clone();
        bench.execute(ask);
        assert!(bench.asking().is_some());
        bench.take_opened(files::open_example(1));
        go.send(()).expect("it waits");
        until(&mut bench, |bench| path.exists() && idle(bench));
        let text = std::fs::read_to_string(&path).expect("it is written");
        let sidecar = std::fs::read_to_string(path.with_extension("csv.meta.json"));
        let says = text + &sidecar.unwrap_or_default();
        assert!(says.contains(&before), "{name}: {before}");
        bench.execute(Workbench::undo);
        until(&mut bench, |bench| bench.answer().is_some());
    }
}
