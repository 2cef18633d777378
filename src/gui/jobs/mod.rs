//! Work in the background: the window never waits.
//!
//! A task runs on a thread of its own and reports once, by a channel; the window is woken when it
//! does. A cancelled task is told so by its [`Watch`], by which it says how far it is; whatever it
//! still reports is dropped. Only a file that is being written tells how that went all the same: it
//! may have been too late to cancel it. Identification is different: while a boundary is dragged questions come faster than answers, so that only one runs at a
//! time, and when it is done the latest question is next. The preview of an export works in the same way.

mod latest;
mod report;
mod running;

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};

pub(crate) use report::{Extended, Report};
pub(crate) use running::{Running, Watch};

use latest::Latest;
use running::Kind;

use super::keeping::watcher::{Order, Watched};
use super::units::number_of;
use crate::gui::cache::backdrop::{Backdrop, Scenery};
use crate::gui::cache::outcome::Outcome;
use crate::gui::cache::preview::{Preview, Wanted};
use crate::gui::core::document::Question;
use crate::gui::core::search::Search;
use crate::gui::core::subject::Subject;

/// How tasks run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Runner {
    /// On threads of their own.
    #[default]
    Threads,
    /// At once: for tests, which must not depend on time.
    AtOnce,
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

    /// Starts a task that brings another session. One that is under way already is dropped for it:
    /// what was asked for last counts, not what takes longest.
    pub(crate) fn open(
        &mut self,
        what: impl Into<String>,
        work: impl FnOnce(&Watch) -> Report + Send + 'static,
    ) {
        while self.running.iter().any(|r| r.kind == Kind::Opens) {
            self.cancel(|kind| kind == Kind::Opens);
        }
        self.spawn(what.into(), Kind::Opens, work);
    }

    /// Starts a task that writes a file.
    pub(crate) fn write(
        &mut self,
        what: impl Into<String>,
        work: impl FnOnce(&Watch) -> Report + Send + 'static,
    ) {
        self.spawn(what.into(), Kind::Writes, work);
    }

    /// What is being written, if anything is.
    pub(crate) fn writing(&self) -> Option<&Running> {
        self.running.iter().find(|r| r.kind == Kind::Writes)
    }

    /// Looks at a foreign file, unless that is under way.
    pub(crate) fn look(
        &mut self,
        what: impl Into<String>,
        work: impl FnOnce(&Watch) -> Report + Send + 'static,
    ) {
        if self.looking().is_none() {
            self.spawn(what.into(), Kind::Looks, work);
        }
    }

    /// The look at a foreign file that is under way.
    pub(crate) fn looking(&self) -> Option<&Running> {
        self.running.iter().find(|r| r.kind == Kind::Looks)
    }

    /// Cancels the look at a foreign file, whatever else is under way.
    pub(crate) fn cancel_look(&mut self) {
        self.cancel(|kind| kind == Kind::Looks);
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
        let what = format!(
            "identifying, {}",
            number_of(question.subject.len(), "sample")
        );
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

    /// Cancels the newest task: its report will not be taken, unless it is about a file that is
    /// being written. The question that is not answered then, if it was one.
    pub(crate) fn cancel_newest(&mut self) -> Option<Question> {
        self.cancel(Kind::has_a_name)
    }

    /// Cancels the search, whatever else is under way.
    pub(crate) fn cancel_search(&mut self) {
        self.cancel(|kind| kind == Kind::Searches);
    }

    fn cancel(&mut self, meant: impl Fn(Kind) -> bool) -> Option<Question> {
        let place = self.running.iter().rposition(|r| meant(r.kind))?;
        self.running[place].watch.stop();
        if self.running[place].kind == Kind::Writes {
            // The file may have its name already.
            return None;
        }
        let cancelled = self.running.remove(place);
        match cancelled.kind {
            Kind::Identifies => {
                let Latest { asked, waiting } = std::mem::take(&mut self.questions);
                return waiting.or(asked);
            }
            Kind::Prepares => self.previews = Latest::default(),
            Kind::Once
            | Kind::Opens
            | Kind::Writes
            | Kind::Searches
            | Kind::Quiet
            | Kind::Looks
            | Kind::Draws => {}
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
                Kind::Once
                | Kind::Opens
                | Kind::Writes
                | Kind::Searches
                | Kind::Quiet
                | Kind::Looks => {}
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
