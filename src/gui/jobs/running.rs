//! A job that is under way: how far it is, and whether anybody still wants it.

use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicU32, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};

/// Between a job and the window: how far it is, and whether anybody still wants it.
#[derive(Debug, Default)]
pub(crate) struct Watch {
    permille: AtomicU32,
    stage: AtomicUsize,
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

    /// Which stage has begun.
    pub(crate) fn reached(&self, stage: usize) {
        self.stage.store(stage, Ordering::Relaxed);
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

    /// The stage that has begun.
    pub(crate) fn stage(&self) -> usize {
        self.watch.stage.load(Ordering::Relaxed)
    }

    /// Whether it searches for what is missing.
    pub(crate) fn searches(&self) -> bool {
        self.kind == Kind::Searches
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
    /// What is only drawn: it passes without a word.
    Draws,
    /// Not shown.
    Quiet,
}

impl Kind {
    /// Whether the status bar names it, and can cancel it.
    pub(crate) fn has_a_name(self) -> bool {
        !matches!(self, Self::Draws | Self::Quiet)
    }
}
