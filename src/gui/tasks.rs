//! Work in the background: the window never waits.
//!
//! A task runs on a thread of its own and reports once, by a channel; the window is woken when it
//! does. A cancelled task is told so by its [`Watch`]; whatever it still reports is dropped. Identification is different:
//! while a boundary is dragged questions come faster than answers, so that only one runs at a
//! time, and when it is done the latest question is next. The preview of an export works in the same way.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, AtomicU32, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex};

use super::backdrop::{Backdrop, Scenery};
use super::document::Question;
use super::figures::Figures;
use super::files::Saved;
use super::foreign::{Beside, Foreign, Look};
use super::given::Given;
use super::keeping::recovery::LeftBehind;
use super::keeping::watcher::{Order, Seen, Watched};
use super::outcome::Outcome;
use super::pictures::Plot;
use super::preview::{Preview, Wanted};
use super::reporting::About;
use super::search::Search;
use super::subject::Subject;
use super::view::Message;

/// What a task brings back.
#[derive(Debug)]
pub(crate) enum Report {
    /// A session was read or made.
    Opened(Result<Arc<Subject>, Message>),
    /// A file that an instrument wrote was looked at.
    Foreign(Box<Foreign>),
    /// It was looked at again, with what was said since.
    Looked(Box<(Foreign, Look)>),
    /// A file beside it was chosen; `None`: cancelled, or there is no dialog on this system.
    ChosenBeside(Beside, Option<PathBuf>),
    /// A model was read.
    OpenedModel(Result<Arc<Given>, Message>),
    /// A path was chosen to open; `None`: cancelled, or there is no dialog on this system.
    ChosenToOpen(Option<PathBuf>),
    /// A path was chosen to save to.
    ChosenToSave(Option<PathBuf>),
    /// A session was written, or not.
    Saved(Box<Saved>),
    /// Preferences, recent files or what is not saved were kept, or not.
    Kept(Result<(), String>),
    /// What windows that are gone have left behind.
    LeftBehind(Vec<LeftBehind>),
    /// Something was seen on the disk.
    Seen(Seen),
    /// A session has grown.
    Extended(Box<Extended>),
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
    /// A report or a picture was written, or not.
    Written(Message),
    /// The standards' figures were worked out.
    Figured(Box<Figures>),
    /// A path was chosen to export to.
    ChosenToExport(What, Option<PathBuf>),
    /// The task itself failed: a bug.
    Broken,
}

/// A session that has grown, with the answer to what was asked of it.
#[derive(Debug)]
pub(crate) struct Extended {
    /// Before.
    pub(crate) from: Arc<Subject>,
    /// After.
    pub(crate) to: Arc<Subject>,
    /// The answer, where something was asked.
    pub(crate) outcome: Option<Outcome>,
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
    /// The calibration report.
    Report(About),
    /// A plot.
    Picture(Plot),
}

/// Between a task and the window: how far it is, and whether anybody still wants it.
#[derive(Debug, Default)]
pub(crate) struct Watch {
    permille: AtomicU32,
    stage: AtomicUsize,
    found: Mutex<Vec<&'static str>>,
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

    /// Which stage has begun.
    pub(crate) fn reached(&self, stage: usize) {
        self.stage.store(stage, Ordering::Relaxed);
    }

    /// What a search has found so far, if it is more than before: it starts again from nothing
    /// now and then, to see whether it ends elsewhere.
    pub(crate) fn found(&self, names: &[&'static str]) {
        if let Ok(mut found) = self.found.lock()
            && names.len() >= found.len()
        {
            *found = names.to_vec();
        }
    }

    /// Whether something is done already.
    #[cfg(test)]
    pub(crate) fn begun(&self) -> bool {
        self.permille.load(Ordering::Relaxed) > 0
    }

    /// Nobody wants the task any more.
    pub(crate) fn stop(&self) {
        self.stopped.store(true, Ordering::Relaxed);
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
    /// The stage that has begun.
    pub(crate) fn stage(&self) -> usize {
        self.watch.stage.load(Ordering::Relaxed)
    }

    /// Names of the effects that a search has found so far.
    pub(crate) fn found(&self) -> Vec<&'static str> {
        self.watch
            .found
            .lock()
            .map_or_else(|_| Vec::new(), |f| f.clone())
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
    /// Looks at a foreign file.
    Looks,
    /// What is only drawn: it passes without a word.
    Draws,
    /// Nobody has to know.
    Quiet,
}

impl Kind {
    /// Whether the status bar names it, and can cancel it.
    fn has_a_name(self) -> bool {
        !matches!(self, Self::Draws | Self::Quiet)
    }
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

/// Begins to look at the disk.
fn watch(runner: Runner, sender: &Sender<(u64, Report)>, wake: &Wake) -> Watching {
    if runner == Runner::AtOnce {
        return Watching::Here(Watched::default());
    }
    let (orders, taken) = channel();
    let (sender, wake) = (sender.clone(), Arc::clone(wake));
    let look = move || {
        Watched::default().keep_looking(&taken, |seen| {
            let _ = sender.send((WATCHER, Report::Seen(seen)));
            wake();
        });
    };
    let thread = std::thread::Builder::new().name("truepose watcher".to_owned());
    // Without it the window goes on, and notices a change when it saves.
    let _ = thread.spawn(look);
    Watching::Thread(orders)
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
    watching: Watching,
}

/// Who looks at the disk.
enum Watching {
    /// Whoever asks.
    Here(Watched),
    /// A thread of its own; it ends with this.
    Thread(Sender<Order>),
}

/// What the watcher says has no task.
const WATCHER: u64 = 0;

impl Tasks {
    /// No task yet.
    pub(crate) fn new(runner: Runner, wake: Wake) -> Self {
        let (sender, receiver) = channel();
        let watching = watch(runner, &sender, &wake);
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
            watching,
        }
    }

    /// Looks at something else on the disk from now on.
    pub(crate) fn order(&mut self, order: Order) {
        match &mut self.watching {
            Watching::Here(watched) => {
                if let Some(seen) = watched.order(order) {
                    let _ = self.sender.send((WATCHER, Report::Seen(seen)));
                }
            }
            // A thread that could not be started looks at nothing.
            Watching::Thread(orders) => drop(orders.send(order)),
        }
    }

    /// Looks at the disk now, where no thread does.
    pub(crate) fn look_at_disk(&mut self) {
        if let Watching::Here(watched) = &mut self.watching {
            for seen in watched.look() {
                let _ = self.sender.send((WATCHER, Report::Seen(seen)));
            }
        }
    }

    /// Whether somebody has to call [`Tasks::look_at_disk`] from time to time.
    pub(crate) fn wants_looking(&self) -> bool {
        matches!(self.watching, Watching::Here(_))
    }

    /// Starts a task that nobody has to know of, and that nobody can cancel.
    pub(crate) fn quietly(&mut self, work: impl FnOnce() -> Report + Send + 'static) {
        self.spawn(String::new(), Kind::Quiet, move |_| work());
    }

    /// The task that the status bar names: the newest.
    pub(crate) fn newest(&self) -> Option<&Running> {
        self.running.iter().rfind(|r| r.kind.has_a_name())
    }

    /// Starts a task.
    pub(crate) fn start(
        &mut self,
        what: impl Into<String>,
        work: impl FnOnce(&Watch) -> Report + Send + 'static,
    ) {
        self.spawn(what.into(), Kind::Once, work);
    }

    /// Looks at a foreign file, unless that is under way.
    pub(crate) fn look(
        &mut self,
        what: impl Into<String>,
        work: impl FnOnce(&Watch) -> Report + Send + 'static,
    ) {
        if !self.looks() {
            self.spawn(what.into(), Kind::Looks, work);
        }
    }

    /// Whether a foreign file is being looked at.
    pub(crate) fn looks(&self) -> bool {
        self.running.iter().any(|r| r.kind == Kind::Looks)
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
        self.spawn(what, Kind::Identifies, move |watch| {
            Report::Answered(Box::new(Outcome::of(question, watch)))
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

    /// Cancels the newest task: its report will not be taken. The question that is not answered
    /// then, if it was one.
    pub(crate) fn cancel_newest(&mut self) -> Option<Question> {
        self.cancel(Kind::has_a_name)
    }

    /// Cancels the search, whatever else is under way.
    pub(crate) fn cancel_search(&mut self) {
        self.cancel(|kind| kind == Kind::Searches);
    }

    fn cancel(&mut self, meant: impl Fn(Kind) -> bool) -> Option<Question> {
        let place = self.running.iter().rposition(|r| meant(r.kind))?;
        let cancelled = self.running.remove(place);
        cancelled.watch.stop();
        match cancelled.kind {
            Kind::Once | Kind::Searches | Kind::Quiet | Kind::Draws | Kind::Looks => {}
            Kind::Identifies => {
                let Latest { asked, waiting } = std::mem::take(&mut self.questions);
                return waiting.or(asked);
            }
            Kind::Prepares => self.previews = Latest::default(),
        }
        None
    }

    /// Everything that has arrived.
    pub(crate) fn reports(&mut self) -> Vec<Report> {
        let mut reports = Vec::new();
        while let Ok((id, report)) = self.receiver.try_recv() {
            if id == WATCHER {
                reports.push(report);
                continue;
            }
            let Some(place) = self.running.iter().position(|r| r.id == id) else {
                continue;
            };
            let finished = self.running.remove(place);
            match finished.kind {
                Kind::Once | Kind::Searches | Kind::Quiet | Kind::Looks => {}
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
