//! Ctrl+C in the terminal: a command that has an answer so far gives it at the first; the second ends the program, as
//! the first does where no command waits for one. Unfinished files go in both cases.

use std::sync::atomic::{AtomicBool, Ordering};

use super::output;

/// Whether a command gives its answer so far at the next interrupt.
static WAITED_FOR: AtomicBool = AtomicBool::new(false);
/// Whether it was asked to.
static ASKED: AtomicBool = AtomicBool::new(false);

/// As long as it lives the first interrupt ends what is looked for, not the program.
pub(crate) struct Stopping(&'static AtomicBool);

impl Stopping {
    pub(crate) fn at_interrupt() -> Self {
        WAITED_FOR.store(true, Ordering::SeqCst);
        Self(&ASKED)
    }

    /// Whether an interrupt came.
    pub(crate) fn is_asked(&self) -> bool {
        self.0.load(Ordering::SeqCst)
    }
}

impl Drop for Stopping {
    fn drop(&mut self) {
        WAITED_FOR.store(false, Ordering::SeqCst);
    }
}

/// An interrupt came: whether a command answers it.
#[cfg(unix)]
pub(super) fn is_answered() -> bool {
    let answered = WAITED_FOR.swap(false, Ordering::SeqCst);
    if answered {
        ASKED.store(true, Ordering::SeqCst);
        output::messages(&[say!(
            "stopping: the answer so far follows; Ctrl+C again ends the program without it"
        )]);
    }
    answered
}
