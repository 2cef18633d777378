//! Someone who watches.

#![allow(
    dead_code,
    reason = "the tests of other crates see this file too, and each uses some of it"
)]

use std::cell::Cell;
use std::ops::ControlFlow;

/// Every share that the work reports, if it is let go to the end.
pub(crate) fn report_to<T>(
    work: impl FnOnce(&dyn Fn(f64) -> ControlFlow<()>) -> T,
) -> (Vec<f64>, T) {
    let shares = Cell::new(Vec::new());
    let done = work(&|share| {
        let mut all = shares.take();
        all.push(share);
        shares.set(all);
        ControlFlow::Continue(())
    });
    (shares.take(), done)
}

/// Answers no to the share with this number, and yes to whatever comes then: it must not be asked again.
pub(crate) fn no_at(number: usize) -> impl Fn(f64) -> ControlFlow<()> {
    let asked = Cell::new(0);
    move |_| {
        asked.set(asked.get() + 1);
        if asked.get() - 1 == number {
            return ControlFlow::Break(());
        }
        assert!(asked.get() <= number, "told something after it said no");
        ControlFlow::Continue(())
    }
}

/// That shares grow from 0 to 1.
pub(crate) fn assert_grows(shares: &[f64]) {
    assert!(shares.is_sorted(), "{shares:?}");
    assert!(shares.iter().all(|s| (0.0..=1.0).contains(s)), "{shares:?}");
    assert_eq!(shares.last(), Some(&1.0), "{shares:?}");
}
