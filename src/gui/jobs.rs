//! Work in the background: the window never waits.
//!
//! A job runs on a thread of its own. What it makes goes, with what is to become of it, through a
//! channel to the poller, and the window is woken. Its [`Watch`] takes the progress
//! of a job and tells it that it is cancelled; whatever it still makes is dropped. Only of a file that is being
//! written it is told how that went all the same: it may have been too late to cancel it. What is
//! asked faster than it is answered goes through a [`Slot`]: one at a time, and the latest after it.
//!
//! Nothing here knows what jobs are about: `B` is whatever their outcomes change.

use std::ops::ControlFlow;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::sync::atomic::{AtomicBool, AtomicU32, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex};

use crate::text;

/// How jobs run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Runner {
    /// On threads of their own.
    #[default]
    Threads,
    /// At once: for tests, which must not depend on time.
    AtOnce,
}

/// Wakes the window when something has arrived.
pub(crate) type Wake = Arc<dyn Fn() + Send + Sync>;

/// What becomes of what a job made.
pub(crate) type Outcome<B> = Box<dyn FnOnce(&mut B) + Send>;

/// The outcome of a job with this number; `None`: it broke off, which is a bug.
type Arrived<B> = (u64, Option<Outcome<B>>);

pub(crate) struct Jobs<B> {
    runner: Runner,
    wake: Wake,
    sender: Sender<Arrived<B>>,
    receiver: Receiver<Arrived<B>>,
    running: Vec<Running>,
    last_id: u64,
}

impl<B: 'static> Jobs<B> {
    pub(crate) fn new(runner: Runner, wake: Wake) -> Self {
        let (sender, receiver) = channel();
        Self {
            runner,
            wake,
            sender,
            receiver,
            running: Vec::new(),
            last_id: 0,
        }
    }

    /// Starts a job: `work` is done in the background, `then` with its result by the poller.
    /// One that brings another session takes the place of one that is under way already: what was
    /// asked for last counts, not what takes longest.
    pub(crate) fn start<T: Send + 'static>(
        &mut self,
        kind: Kind,
        what: impl Into<String>,
        work: impl FnOnce(&Watch) -> T + Send + 'static,
        then: impl FnOnce(&mut B, T) + Send + 'static,
    ) {
        while kind == Kind::Opens && self.running(kind).is_some() {
            self.cancel(|other| other == kind);
        }
        self.last_id += 1;
        let id = self.last_id;
        let watch = Arc::new(Watch::default());
        self.running.push(Running {
            id,
            what: what.into(),
            kind,
            watch: Arc::clone(&watch),
        });
        let (sender, wake) = (self.sender.clone(), Arc::clone(&self.wake));
        let (spoken, units) = (text::current(), text::current_units());
        let job = move || {
            text::choose(spoken);
            let _units = text::InUnits::begin(units);
            text::name_by_titles(true);
            // A bug in one job must not leave the window waiting for it.
            let made = catch_unwind(AssertUnwindSafe(|| work(&watch))).ok();
            let outcome = made.map(|made| Box::new(|to: &mut B| then(to, made)) as Outcome<B>);
            // The window may be gone already; then the result is dropped.
            let _ = sender.send((id, outcome));
            wake();
        };
        match self.runner {
            Runner::AtOnce => job(),
            Runner::Threads => {
                let thread = std::thread::Builder::new().name("truepose task".to_owned());
                if thread.spawn(job).is_err() {
                    let _ = self.sender.send((id, None));
                }
            }
        }
    }

    /// Starts a job that is not shown and cannot be cancelled.
    pub(crate) fn quietly<T: Send + 'static>(
        &mut self,
        work: impl FnOnce() -> T + Send + 'static,
        then: impl FnOnce(&mut B, T) + Send + 'static,
    ) {
        self.start(Kind::Quiet, "", move |_| work(), then);
    }

    /// The job that the status bar names: the newest.
    pub(crate) fn newest(&self) -> Option<&Running> {
        self.running.iter().rfind(|r| r.kind.has_a_name())
    }

    /// The job of this kind that is under way.
    pub(crate) fn running(&self, kind: Kind) -> Option<&Running> {
        self.running.iter().find(|r| r.kind == kind)
    }

    /// Cancels the newest job of these kinds: what it makes will not be taken, unless it is a file
    /// that is being written. The kind of the job that is dropped.
    pub(crate) fn cancel(&mut self, meant: impl Fn(Kind) -> bool) -> Option<Kind> {
        let place = self.running.iter().rposition(|r| meant(r.kind))?;
        self.running[place].watch.stop();
        // The file may have its name already.
        let dropped = self.running[place].kind != Kind::Writes;
        dropped.then(|| self.running.remove(place).kind)
    }

    /// Everything that has arrived: what kind of job it comes from, and what becomes of it; `None`
    /// where the job broke off.
    pub(crate) fn poll(&mut self) -> Vec<(Kind, Option<Outcome<B>>)> {
        let mut arrived = Vec::new();
        while let Ok((id, outcome)) = self.receiver.try_recv() {
            // Otherwise it was cancelled.
            if let Some(place) = self.running.iter().position(|r| r.id == id) {
                arrived.push((self.running.remove(place).kind, outcome));
            }
        }
        arrived
    }
}

/// Between a job and the window: how far it is, and whether anybody still wants it.
#[derive(Debug, Default)]
pub(crate) struct Watch {
    permille: AtomicU32,
    found: Mutex<Vec<String>>,
    doing: Mutex<Option<String>>,
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

    /// What the library tells: which part is done. Goes on until it is cancelled.
    pub(crate) fn progress_callback(&self) -> impl Fn(f64) -> ControlFlow<()> {
        |part| {
            self.done(part);
            if self.stopped() {
                ControlFlow::Break(())
            } else {
                ControlFlow::Continue(())
            }
        }
    }

    /// What it does now, where that says more than what it does as a whole.
    pub(crate) fn doing(&self, what: String) {
        if let Ok(mut doing) = self.doing.lock() {
            *doing = Some(what);
        }
    }

    /// What a search has found so far, if it is more than before: it starts again from nothing
    /// now and then, to see whether it ends elsewhere.
    pub(crate) fn found(&self, names: &[String]) {
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

    /// The task was cancelled.
    pub(crate) fn stop(&self) {
        self.stopped.store(true, Ordering::Relaxed);
    }

    /// Whether the task was cancelled.
    pub(crate) fn stopped(&self) -> bool {
        self.stopped.load(Ordering::Relaxed)
    }
}

/// A job that is under way.
#[derive(Debug, Clone)]
pub(crate) struct Running {
    pub(super) id: u64,
    /// What it does as a whole.
    pub(crate) what: String,
    pub(super) kind: Kind,
    pub(super) watch: Arc<Watch>,
}

impl Running {
    /// What it does now, as the status bar says it.
    pub(crate) fn describe(&self) -> String {
        if self.watch.stopped() {
            return say!("cancelling").to_owned();
        }
        let doing = self.watch.doing.lock().ok();
        let doing = doing.and_then(|doing| doing.clone());
        doing.unwrap_or_else(|| self.what.clone())
    }

    /// Names of the effects that a search has found so far.
    pub(crate) fn found(&self) -> Vec<String> {
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

/// What a job is for, where that decides how it is treated.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Nothing special about it.
    Once,
    /// It brings another session: the newest counts.
    Opens,
    /// A dialog of the system is open.
    Asks,
    /// It writes a file: how that went is told, cancelled or not.
    Writes,
    /// It identifies the robot.
    Identifies,
    /// It prepares an export.
    Prepares,
    /// It searches for what is missing.
    Searches,
    /// Looks at a foreign file.
    Looks,
    /// Not shown.
    Quiet,
}

impl Kind {
    /// Whether the status bar names it, and can cancel it.
    pub(crate) fn has_a_name(self) -> bool {
        self != Self::Quiet
    }
}

/// What follows from something that changes faster than it can be worked out: one at a time, and the latest after it.
/// One that was cancelled is not begun again by itself.
#[derive(Debug)]
pub(crate) struct Slot<K, V> {
    made: Option<(K, V)>,
    busy: bool,
    /// Of what it was wanted last.
    wanted: Option<K>,
    declined: Option<K>,
}

impl<K, V> Default for Slot<K, V> {
    fn default() -> Self {
        Self {
            made: None,
            busy: false,
            wanted: None,
            declined: None,
        }
    }
}

impl<K: PartialEq + Clone, V> Slot<K, V> {
    /// What was worked out last, with what it was worked out of, be it what was there before.
    pub(crate) fn made(&self) -> Option<&(K, V)> {
        self.made.as_ref()
    }

    /// It is wanted of this: whether it is to be begun now.
    pub(crate) fn want(&mut self, of: &K) -> bool {
        let there = self.made.as_ref().is_some_and(|(made, _)| made == of);
        if there || self.declined.as_ref() == Some(of) {
            return false;
        }
        self.declined = None;
        self.wanted = Some(of.clone());
        !std::mem::replace(&mut self.busy, true)
    }

    /// It is there; what there was before.
    pub(crate) fn take(&mut self, of: K, made: V) -> Option<(K, V)> {
        self.busy = false;
        self.made.replace((of, made))
    }

    /// What was wanted last is cancelled.
    pub(crate) fn decline(&mut self) {
        self.busy = false;
        self.declined = self.wanted.take().or(self.declined.take());
    }

    /// Of what it was cancelled.
    pub(crate) fn declined(&self) -> Option<&K> {
        self.declined.as_ref()
    }

    /// What was cancelled may be begun again.
    pub(crate) fn resume(&mut self) {
        self.declined = None;
    }
}
