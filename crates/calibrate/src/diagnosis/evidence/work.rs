//! The budget of a search: counted in products of numbers, never by a clock, so that the same session ends in the same
//! way on every machine.
//!
//! The search has shares of it one after the other. Where its share is spent nothing more is searched for: what was
//! found so far is tested and reported, and that the search ended there. The same where the watcher asks it to stop.

use std::cell::Cell;
use std::rc::Rc;

use crate::answers::diagnosis::Stopped;

/// Products of numbers for a whole diagnosis, and so many more for each sample that is searched.
const PRODUCTS: f64 = 6.0e9;
const FOR_A_SAMPLE: f64 = 1.2e7;

/// Shares of the whole.
pub(crate) const FIRST_SEARCH: f64 = 0.45;
pub(crate) const SECOND_SEARCH: f64 = 0.6;
pub(crate) const RIVALS: f64 = 0.7;
pub(crate) const OTHER_SETS: f64 = 0.85;

/// Work that was done so far, shared by everything that one diagnosis makes.
#[derive(Debug, Clone)]
pub(crate) struct Work(Rc<Counts>);

#[derive(Debug)]
struct Counts {
    done: Cell<f64>,
    most: f64,
    /// Up to which share of the whole the search may go on now.
    share: Cell<f64>,
    ended: Cell<bool>,
    asked_to_stop: Cell<bool>,
}

impl Work {
    /// None spent, for so many samples that are searched.
    pub(crate) fn new(samples: usize) -> Self {
        Self(Rc::new(Counts {
            done: Cell::new(0.0),
            most: PRODUCTS + FOR_A_SAMPLE * samples as f64,
            share: Cell::new(1.0),
            ended: Cell::new(false),
            asked_to_stop: Cell::new(false),
        }))
    }

    /// So many products more.
    pub(crate) fn did(&self, products: f64) {
        self.0.done.set(self.0.done.get() + products);
    }

    /// From here on the search may spend up to this share of the whole.
    pub(crate) fn up_to(&self, share: f64) {
        self.0.share.set(share);
    }

    /// The watcher stops the search and wants what was found so far.
    pub(crate) fn stop(&self) {
        self.0.asked_to_stop.set(true);
    }

    /// Whether it was asked to stop.
    pub(crate) fn was_stopped(&self) -> bool {
        self.0.asked_to_stop.get()
    }

    /// Whether the search has to end; the caller leaves something undone.
    pub(crate) fn is_over(&self) -> bool {
        let over = self.is_spent();
        if over {
            self.0.ended.set(true);
        }
        over
    }

    /// Whether its share is spent; the caller leaves nothing undone that could be found.
    pub(crate) fn is_spent(&self) -> bool {
        let Counts {
            done, most, share, ..
        } = &*self.0;
        self.was_stopped() || done.get() > share.get() * most
    }

    /// The search continues with what was left undone.
    pub(crate) fn begin_again(&self) {
        self.0.ended.set(false);
    }

    /// Why the search ended early; `None` where it did not.
    pub(crate) fn ended(&self) -> Option<Stopped> {
        if self.was_stopped() {
            Some(Stopped::Asked)
        } else {
            self.0.ended.get().then_some(Stopped::Budget)
        }
    }

    /// The share of the budget that is spent, 0 to 1.
    pub(crate) fn spent(&self) -> f64 {
        (self.0.done.get() / self.0.most).min(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_share_that_is_spent_ends_what_is_looked_for_and_says_so() {
        let work = Work::new(100);
        work.up_to(0.5);
        assert!(!work.is_over() && work.ended().is_none());
        let all = PRODUCTS + 100.0 * FOR_A_SAMPLE;
        work.did(0.6 * all);
        let shared = work.clone();
        // No one was kept from looking so far.
        assert!(work.ended().is_none());
        assert!(shared.is_over());
        assert_eq!(work.ended(), Some(Stopped::Budget));
        assert!(work.spent() > 0.5 && work.spent() < 0.7);
        work.up_to(1.0);
        assert!(!work.is_over());
        work.stop();
        assert!(work.is_over());
        assert_eq!(work.ended(), Some(Stopped::Asked));
    }
}
