//! Work in the background: the window never waits.
//!
//! A task runs on a thread of its own and reports once, by a channel; the window is woken when it
//! does. A cancelled task runs to its end and its report is dropped. Identification is different:
//! while a boundary is dragged questions come faster than answers, so that only one runs at a
//! time, and when it is done the latest question is next.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::mpsc::{Receiver, Sender, channel};

use super::document::Question;
use super::outcome::Outcome;
use super::subject::Subject;
use super::view::Message;

/// What a task brings back.
#[derive(Debug)]
pub(crate) enum Report {
    /// A session was read or made.
    Opened(Result<Arc<Subject>, Message>),
    /// A path was chosen to open; `None`: cancelled, or there is no dialog on this system.
    ChosenToOpen(Option<PathBuf>),
    /// A path was chosen to save to.
    ChosenToSave(Option<PathBuf>),
    /// A file was written.
    Saved(Result<PathBuf, Message>),
    /// A question was answered.
    Answered(Box<Outcome>),
    /// The task itself failed: a bug.
    Broken,
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
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Running {
    id: u64,
    /// What it does, as the status bar says it.
    pub(crate) what: String,
    identifies: bool,
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
    /// The question that is being answered.
    asked: Option<Question>,
    /// The question after it.
    waiting: Option<Question>,
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
            asked: None,
            waiting: None,
        }
    }

    /// The task that the status bar names: the newest.
    pub(crate) fn newest(&self) -> Option<&Running> {
        self.running.last()
    }

    /// Starts a task.
    pub(crate) fn start(
        &mut self,
        what: impl Into<String>,
        work: impl FnOnce() -> Report + Send + 'static,
    ) {
        self.spawn(what.into(), false, work);
    }

    /// Asks for an answer. A question that is waiting is forgotten for it.
    pub(crate) fn ask(&mut self, question: Question) {
        if self.asked.as_ref() == Some(&question) {
            self.waiting = None;
        } else if self.asked.is_some() {
            self.waiting = Some(question);
        } else {
            self.answer(question);
        }
    }

    /// Whether this question is being answered, or waits.
    pub(crate) fn is_asked(&self, question: &Question) -> bool {
        match &self.waiting {
            Some(waiting) => waiting == question,
            None => self.asked.as_ref() == Some(question),
        }
    }

    fn answer(&mut self, question: Question) {
        self.asked = Some(question.clone());
        let what = format!("identifying, {} samples", question.subject.len());
        self.spawn(what, true, move || {
            Report::Answered(Box::new(Outcome::of(question)))
        });
    }

    fn spawn(
        &mut self,
        what: String,
        identifies: bool,
        work: impl FnOnce() -> Report + Send + 'static,
    ) {
        self.last_id += 1;
        let id = self.last_id;
        self.running.push(Running {
            id,
            what,
            identifies,
        });
        let (sender, wake) = (self.sender.clone(), Arc::clone(&self.wake));
        let task = move || {
            // A bug in one task must not leave the window waiting for it.
            let report = catch_unwind(AssertUnwindSafe(work)).unwrap_or(Report::Broken);
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

    /// Drops the newest task: its report will not be taken.
    pub(crate) fn cancel_newest(&mut self) {
        if let Some(cancelled) = self.running.pop()
            && cancelled.identifies
        {
            self.asked = None;
            self.waiting = None;
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
            if finished.identifies {
                self.asked = None;
                if let Some(next) = self.waiting.take() {
                    self.answer(next);
                }
            }
            reports.push(report);
        }
        reports
    }
}
