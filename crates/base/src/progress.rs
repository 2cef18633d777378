//! The progress of long work, and its cancellation.
//!
//! Long work is given a `watch`, as `simulation::simulate` is: it receives now and then which part is done, from 0 to
//! 1 and never less than before, and answers whether to go on. Once it answered no the work is [`Cancelled`], whatever
//! it answers later.
//!
//! Work is made of parts. A `ProgressSpan` goes from 0 to 1, has its place in the whole, and is cheap to hand on; a
//! reader of a file does not know what is done with it afterwards.

use std::cell::Cell;
use std::io;
use std::ops::ControlFlow;

use crate::diagnostic::Rejected;

/// The watcher asked to stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("cancelled")]
pub struct Cancelled;

impl Cancelled {
    /// Whether this is why reading or writing ended.
    pub(crate) fn is_behind(error: &io::Error) -> bool {
        matches!(error.get_ref(), Some(inner) if inner.is::<Self>())
    }
}

impl From<Cancelled> for io::Error {
    fn from(cancelled: Cancelled) -> Self {
        Self::other(cancelled)
    }
}

/// Why something was not read.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// Something is wrong with it.
    #[error(transparent)]
    Rejected(#[from] Rejected),
    /// The watcher asked to stop.
    #[error(transparent)]
    Cancelled(#[from] Cancelled),
}

impl ReadError {
    /// What is wrong, where it could not have been cancelled.
    #[doc(hidden)]
    pub fn rejected(self) -> Rejected {
        match self {
            Self::Rejected(rejected) => rejected,
            Self::Cancelled(_) => Rejected::of(Vec::new()),
        }
    }
}

/// Goes on to the end.
pub fn unwatched(_: f64) -> ControlFlow<()> {
    ControlFlow::Continue(())
}

/// Between the work and its watcher.
#[doc(hidden)]
pub struct Progress<'a> {
    watch: &'a dyn Fn(f64) -> ControlFlow<()>,
    /// The part that is done, as last reported.
    share: Cell<f64>,
    cancelled: Cell<bool>,
}

impl<'a> Progress<'a> {
    /// Nothing is done yet.
    pub fn new(watch: &'a dyn Fn(f64) -> ControlFlow<()>) -> Self {
        Self {
            watch,
            share: Cell::new(0.0),
            cancelled: Cell::new(false),
        }
    }

    /// All of the work.
    pub fn whole(&self) -> ProgressSpan<'_> {
        ProgressSpan {
            progress: self,
            from: 0.0,
            to: 1.0,
        }
    }
}

/// A part of the work.
#[derive(Clone, Copy)]
#[doc(hidden)]
pub struct ProgressSpan<'p> {
    progress: &'p Progress<'p>,
    /// Where in the whole it begins and ends.
    from: f64,
    to: f64,
}

impl ProgressSpan<'_> {
    /// The part of this part between two shares of it.
    #[must_use]
    pub fn part(self, from: f64, to: f64) -> Self {
        let at = |share: f64| self.from + share * (self.to - self.from);
        Self {
            from: at(from),
            to: at(to),
            ..self
        }
    }

    /// For work of unknown length: a third of the remaining part.
    #[must_use]
    pub fn next_pass(self) -> Self {
        let from = self.progress.share.get().clamp(self.from, self.to);
        let to = from + (self.to - from) / 3.0;
        Self { from, to, ..self }
    }

    /// So much of this part is done, 0 to 1.
    ///
    /// # Errors
    /// If it was cancelled.
    pub fn reached(self, share: f64) -> Result<(), Cancelled> {
        let Progress {
            watch,
            share: reported,
            cancelled,
        } = self.progress;
        if cancelled.get() {
            return Err(Cancelled);
        }
        let now = self.part(share.clamp(0.0, 1.0), 1.0).from.min(1.0);
        reported.set(reported.get().max(now));
        match watch(reported.get()) {
            ControlFlow::Continue(()) => Ok(()),
            ControlFlow::Break(()) => {
                cancelled.set(true);
                Err(Cancelled)
            }
        }
    }

    /// So many of so many are done.
    ///
    /// # Errors
    /// If it was cancelled.
    pub fn counted(self, done: usize, of: usize) -> Result<(), Cancelled> {
        self.reached(done as f64 / of.max(1) as f64)
    }

    /// Whether it was cancelled already.
    ///
    /// # Errors
    /// If it was.
    pub fn check(self) -> Result<(), Cancelled> {
        if self.progress.cancelled.get() {
            return Err(Cancelled);
        }
        Ok(())
    }

    /// For work that is given its own watch.
    pub fn watch(self) -> impl Fn(f64) -> ControlFlow<()> {
        move |share| match self.reached(share) {
            Ok(()) => ControlFlow::Continue(()),
            Err(Cancelled) => ControlFlow::Break(()),
        }
    }
}

#[cfg(test)]
mod testing;

#[cfg(test)]
mod tests {
    use super::testing::report_to;
    use super::*;

    #[test]
    fn parts_of_parts_are_told_as_shares_of_the_whole() {
        let (shares, done) = report_to(|watch| {
            let progress = Progress::new(watch);
            let second = progress.whole().part(0.5, 1.0);
            second.reached(0.5)?;
            second.part(0.5, 1.0).counted(1, 2)?;
            // What is less than was reported already is reported as that.
            second.reached(0.0)?;
            progress.whole().reached(7.0)
        });
        assert_eq!(done, Ok(()));
        assert_eq!(shares, [0.75, 0.875, 0.875, 1.0]);
    }

    #[test]
    fn passes_that_nobody_has_counted_never_come_to_the_end_by_themselves() {
        let (shares, ()) = report_to(|watch| {
            let progress = Progress::new(watch);
            for _ in 0..20 {
                let pass = progress.whole().next_pass();
                assert_eq!(pass.reached(1.0), Ok(()));
            }
        });
        assert!(shares.windows(2).all(|s| s[0] < s[1]) && shares[19] < 1.0);
    }

    #[test]
    fn whoever_said_no_is_not_asked_again() {
        let watch = testing::no_at(1);
        let progress = Progress::new(&watch);
        let whole = progress.whole();
        assert_eq!(whole.reached(0.1), Ok(()));
        assert_eq!(whole.check(), Ok(()));
        assert_eq!(whole.reached(0.2), Err(Cancelled));
        assert_eq!(whole.reached(0.3), Err(Cancelled));
        assert_eq!(whole.check(), Err(Cancelled));
        let error: io::Error = Cancelled.into();
        assert!(Cancelled::is_behind(&error));
        assert!(!Cancelled::is_behind(&io::Error::other("cancelled")));
    }
}
