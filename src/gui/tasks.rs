//! Work in the background: the window never waits.
//!
//! A task runs on a thread of its own and reports once, by a channel; the window is woken when it
//! does. A cancelled task is told so by its [`Watch`]; whatever it still reports is dropped. Identification is different:
//! while a boundary is dragged questions come faster than answers, so that only one runs at a
//! time, and when it is done the latest question is next. The preview of an export works in the same way.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicU32, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};

use super::backdrop::{Backdrop, Scenery};
use super::document::Question;
use super::given::Given;
use super::outcome::Outcome;
use super::preview::{Preview, Wanted};
use super::search::Search;
use super::subject::Subject;
use super::view::Message;

/// What a task brings back.
#[derive(Debug)]
pub(crate) enum Report {
    /// A session was read or made.
    Opened(Result<Arc<Subject>, Message>),
    /// A model was read.
    OpenedModel(Result<Arc<Given>, Message>),
    /// A path was chosen to open; `None`: cancelled, or there is no dialog on this system.
    ChosenToOpen(Option<PathBuf>),
    /// A path was chosen to save to.
    ChosenToSave(Option<PathBuf>),
    /// A file was written.
    Saved(Result<PathBuf, Message>),
    /// A question was answered.
    Answered(Box<Outcome>),
    /// A session was searched.
    Searched(Box<Search>),
    /// What plots of many samples stand on was worked out.
    Drawn(Box<Backdrop>),
    /// An export was prepared.
    Prepared(Box<Preview>),
    /// An export was written.
    Exported(Result<PathBuf, Message>),
    /// A measuring list was written.
    Listed(Result<PathBuf, Message>),
    /// A path was chosen to export to.
    ChosenToExport(What, Option<PathBuf>),
    /// The task itself failed: a bug.
    Broken,
}

/// What is exported.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum What {
    /// The table for the controller.
    Table,
    /// The model itself.
    Model,
    /// Poses to measure next.
    Poses,
}

/// Between a task and the window: how far it is, and whether anybody still wants it.
#[derive(Debug, Default)]
pub(crate) struct Watch {
    permille: AtomicU32,
    stage: AtomicUsize,
    found: AtomicUsize,
    stopped: AtomicBool,
}

impl Watch {
    /// Which part is done, 0 to 1.
    #[allow(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to 0 … 1000"
    )]
    pub(crate) fn done(&self, part: f64) {
        let permille = (1000.0 * part.clamp(0.0, 1.0)) as u32;
        self.permille.store(permille, Ordering::Relaxed);
    }

    /// Which stage has begun, and how much was found so far.
    pub(crate) fn reached(&self, stage: usize, found: usize) {
        self.stage.store(stage, Ordering::Relaxed);
        self.found.fetch_max(found, Ordering::Relaxed);
    }

    /// Whether the task was cancelled.
    pub(crate) fn stopped(&self) -> bool {
        self.stopped.load(Ordering::Relaxed)
    }
}

/// How tasks run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Runner {
    /// On threads of their own.
    #[default]
    Threads,
    /// At once: for tests, which must not depend on time.
    AtOnce,
}

/// A task that is under way.
#[derive(Debug, Clone)]
pub(crate) struct Running {
    id: u64,
    /// What it does, as the status bar says it.
    pub(crate) what: String,
    kind: Kind,
    watch: Arc<Watch>,
}

impl Running {
    /// The stage that has begun, and how much was found so far.
    pub(crate) fn stage(&self) -> (usize, usize) {
        let Watch { stage, found, .. } = &*self.watch;
        (stage.load(Ordering::Relaxed), found.load(Ordering::Relaxed))
    }

    /// Which part is done, where the task says so.
    pub(crate) fn progress(&self) -> Option<f32> {
        let permille = self.watch.permille.load(Ordering::Relaxed);
        (permille > 0).then(|| permille as f32 / 1000.0)
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Once,
    Identifies,
    Prepares,
    Searches,
    Draws,
}

/// One question at a time, and the latest one after it.
#[derive(Debug)]
struct Latest<Q> {
    asked: Option<Q>,
    waiting: Option<Q>,
}

impl<Q> Default for Latest<Q> {
    fn default() -> Self {
        Self {
            asked: None,
            waiting: None,
        }
    }
}

impl<Q: PartialEq + Clone> Latest<Q> {
    /// The question, if it is to be worked on now.
    fn ask(&mut self, question: Q) -> Option<Q> {
        if self.asked.as_ref() == Some(&question) {
            self.waiting = None;
            None
        } else if self.asked.is_some() {
            self.waiting = Some(question);
            None
        } else {
            self.asked = Some(question.clone());
            Some(question)
        }
    }

    fn is_asked(&self, question: &Q) -> bool {
        self.waiting.as_ref().or(self.asked.as_ref()) == Some(question)
    }

    /// The question is answered; the one that is next.
    fn answered(&mut self) -> Option<Q> {
        self.asked = None;
        let next = self.waiting.take()?;
        self.ask(next)
    }
}

/// Wakes the window when something has arrived.
pub(crate) type Wake = Arc<dyn Fn() + Send + Sync>;

/// See the module.
pub(crate) struct Tasks {
    runner: Runner,
    wake: Wake,
    sender: Sender<(u64, Report)>,
    receiver: Receiver<(u64, Report)>,
    running: Vec<Running>,
    last_id: u64,
    questions: Latest<Question>,
    previews: Latest<Wanted>,
    sceneries: Latest<Scenery>,
}

impl Tasks {
    /// No task yet.
    pub(crate) fn new(runner: Runner, wake: Wake) -> Self {
        let (sender, receiver) = channel();
        Self {
            runner,
            wake,
            sender,
            receiver,
            running: Vec::new(),
            last_id: 0,
            questions: Latest::default(),
            previews: Latest::default(),
            sceneries: Latest::default(),
        }
    }

    /// The task that the status bar names: the newest. What is only drawn passes without a word.
    pub(crate) fn newest(&self) -> Option<&Running> {
        self.running.iter().rfind(|r| r.kind != Kind::Draws)
    }

    /// Starts a task.
    pub(crate) fn start(
        &mut self,
        what: impl Into<String>,
        work: impl FnOnce(&Watch) -> Report + Send + 'static,
    ) {
        self.spawn(what.into(), Kind::Once, work);
    }

    /// Asks for an answer. A question that is waiting is forgotten for it.
    pub(crate) fn ask(&mut self, question: Question) {
        if let Some(question) = self.questions.ask(question) {
            self.answer(question);
        }
    }

    /// Whether this question is the last that was asked and has no answer yet.
    pub(crate) fn is_asked(&self, question: &Question) -> bool {
        self.questions.is_asked(question)
    }

    fn answer(&mut self, question: Question) {
        let what = format!("identifying, {} samples", question.subject.len());
        self.spawn(what, Kind::Identifies, move |_| {
            Report::Answered(Box::new(Outcome::of(question)))
        });
    }

    /// Searches a session for what is missing, unless a search is under way.
    pub(crate) fn search(&mut self, subject: Arc<Subject>) {
        if self.searching().is_none() {
            self.spawn("searching".to_owned(), Kind::Searches, move |watch| {
                Report::Searched(Box::new(Search::of(subject, watch)))
            });
        }
    }

    /// The search that is under way.
    pub(crate) fn searching(&self) -> Option<&Running> {
        self.running.iter().find(|r| r.kind == Kind::Searches)
    }

    /// Asks for the preview of an export.
    pub(crate) fn prepare(&mut self, wanted: Wanted) {
        if let Some(wanted) = self.previews.ask(wanted) {
            self.preview(wanted);
        }
    }

    /// Whether this preview is on its way.
    pub(crate) fn is_wanted(&self, wanted: &Wanted) -> bool {
        self.previews.is_asked(wanted)
    }

    fn preview(&mut self, wanted: Wanted) {
        self.spawn(
            "preparing the table".to_owned(),
            Kind::Prepares,
            move |_| Report::Prepared(Box::new(Preview::of(wanted))),
        );
    }

    /// Asks for what plots of many samples stand on; `last` is what they stand on now.
    pub(crate) fn draw(&mut self, scenery: Scenery, last: Option<Arc<Backdrop>>) {
        if let Some(scenery) = self.sceneries.ask(scenery) {
            self.backdrop(scenery, last);
        }
    }

    /// Whether it is on its way.
    pub(crate) fn is_drawn(&self, scenery: &Scenery) -> bool {
        self.sceneries.is_asked(scenery)
    }

    fn backdrop(&mut self, scenery: Scenery, last: Option<Arc<Backdrop>>) {
        self.spawn("drawing".to_owned(), Kind::Draws, move |_| {
            Report::Drawn(Box::new(Backdrop::of(scenery, last.as_deref())))
        });
    }

    fn spawn(
        &mut self,
        what: String,
        kind: Kind,
        work: impl FnOnce(&Watch) -> Report + Send + 'static,
    ) {
        self.last_id += 1;
        let id = self.last_id;
        let watch = Arc::new(Watch::default());
        self.running.push(Running {
            id,
            what,
            kind,
            watch: Arc::clone(&watch),
        });
        let (sender, wake) = (self.sender.clone(), Arc::clone(&self.wake));
        let task = move || {
            // A bug in one task must not leave the window waiting for it.
            let report = catch_unwind(AssertUnwindSafe(|| work(&watch)));
            let report = report.unwrap_or(Report::Broken);
            // The window may be gone already; then nobody wants the report.
            let _ = sender.send((id, report));
            wake();
        };
        match self.runner {
            Runner::AtOnce => task(),
            Runner::Threads => {
                let thread = std::thread::Builder::new().name("truepose task".to_owned());
                if thread.spawn(task).is_err() {
                    let _ = self.sender.send((id, Report::Broken));
                }
            }
        }
    }

    /// Cancels the newest task: its report will not be taken.
    pub(crate) fn cancel_newest(&mut self) {
        self.cancel(|kind| kind != Kind::Draws);
    }

    /// Cancels the search, whatever else is under way.
    pub(crate) fn cancel_search(&mut self) {
        self.cancel(|kind| kind == Kind::Searches);
    }

    fn cancel(&mut self, meant: impl Fn(Kind) -> bool) {
        let Some(place) = self.running.iter().rposition(|r| meant(r.kind)) else {
            return;
        };
        let cancelled = self.running.remove(place);
        cancelled.watch.stopped.store(true, Ordering::Relaxed);
        match cancelled.kind {
            Kind::Once | Kind::Searches | Kind::Draws => {}
            Kind::Identifies => self.questions = Latest::default(),
            Kind::Prepares => self.previews = Latest::default(),
        }
    }

    /// Everything that has arrived.
    pub(crate) fn reports(&mut self) -> Vec<Report> {
        let mut reports = Vec::new();
        while let Ok((id, report)) = self.receiver.try_recv() {
            let Some(place) = self.running.iter().position(|r| r.id == id) else {
                continue;
            };
            let finished = self.running.remove(place);
            match finished.kind {
                Kind::Once | Kind::Searches => {}
                Kind::Identifies => {
                    if let Some(next) = self.questions.answered() {
                        self.answer(next);
                    }
                }
                Kind::Prepares => {
                    if let Some(next) = self.previews.answered() {
                        self.preview(next);
                    }
                }
                Kind::Draws => {
                    if let Some(next) = self.sceneries.answered() {
                        let last = match &report {
                            Report::Drawn(backdrop) => Some(Arc::new((**backdrop).clone())),
                            _ => None,
                        };
                        self.backdrop(next, last);
                    }
                }
            }
            reports.push(report);
        }
        reports
    }
}
