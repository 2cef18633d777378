//! Jobs on several threads, their answers in the order of the jobs.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

/// How many answers may wait for the one before them, for each thread: this bounds the memory.
const AHEAD: usize = 4;

struct State<T> {
    /// The job that is begun next.
    next: usize,
    /// How many answers were handed on.
    taken: usize,
    /// Answers that wait for the ones before them.
    waiting: BTreeMap<usize, T>,
    stopped: bool,
}

struct Shared<T> {
    state: Mutex<State<T>>,
    changed: Condvar,
}

impl<T> Shared<T> {
    fn lock(&self) -> MutexGuard<'_, State<T>> {
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Waits until `ready` gives something.
    fn when<R>(&self, mut ready: impl FnMut(&mut State<T>) -> Option<R>) -> R {
        let mut state = self.lock();
        loop {
            if let Some(result) = ready(&mut state) {
                self.changed.notify_all();
                return result;
            }
            let woken = self.changed.wait(state);
            state = woken.unwrap_or_else(PoisonError::into_inner);
        }
    }
}

/// Does jobs 0 to `count` − 1 with `work` on `threads` threads, and hands each answer to `take` on this
/// thread, in the order of the jobs, as soon as it is there. Where `take` breaks off no further job is
/// begun. `work` must not panic.
pub(crate) fn in_order<T: Send, B>(
    count: usize,
    threads: usize,
    work: &(dyn Fn(usize) -> T + Sync),
    take: &mut dyn FnMut(T) -> ControlFlow<B>,
) -> ControlFlow<B> {
    let threads = threads.clamp(1, count.max(1));
    let shared = Shared {
        state: Mutex::new(State {
            next: 0,
            taken: 0,
            waiting: BTreeMap::new(),
            stopped: false,
        }),
        changed: Condvar::new(),
    };
    let job = |state: &mut State<T>| {
        if state.stopped || state.next == count {
            return Some(None);
        }
        let may_begin = state.next < state.taken + AHEAD * threads;
        may_begin.then(|| {
            state.next += 1;
            Some(state.next - 1)
        })
    };
    std::thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                while let Some(k) = shared.when(job) {
                    let answer = work(k);
                    shared.lock().waiting.insert(k, answer);
                    shared.changed.notify_all();
                }
            });
        }
        for k in 0..count {
            let answer = shared.when(|state| {
                let answer = state.waiting.remove(&k)?;
                state.taken = k + 1;
                Some(answer)
            });
            if let ControlFlow::Break(because) = take(answer) {
                shared.lock().stopped = true;
                shared.changed.notify_all();
                return ControlFlow::Break(because);
            }
        }
        ControlFlow::Continue(())
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};
    use std::time::Duration;

    #[test]
    fn answers_come_in_the_order_of_the_jobs_and_few_wait() {
        for threads in [1, 3, 50] {
            let (begun, mut taken) = (AtomicUsize::new(0), Vec::new());
            let work = |k: usize| {
                begun.fetch_add(1, Ordering::SeqCst);
                // The first is the slowest.
                let ms = if k == 0 { 30 } else { 0 };
                std::thread::sleep(Duration::from_millis(ms));
                k
            };
            let whole = in_order(40, threads, &work, &mut |k| {
                let begun = begun.load(Ordering::SeqCst);
                assert!(begun <= taken.len() + 1 + AHEAD * threads, "{begun}");
                taken.push(k);
                ControlFlow::<()>::Continue(())
            });
            assert!(whole.is_continue());
            assert_eq!(taken, (0..40).collect::<Vec<_>>(), "{threads} threads");
        }
    }

    #[test]
    fn nothing_is_begun_after_a_break_and_no_job_at_all_is_no_wait() {
        let begun = AtomicUsize::new(0);
        let work = |_| begun.fetch_add(1, Ordering::SeqCst);
        let stopped = in_order(1000, 2, &work, &mut |_| ControlFlow::Break("enough"));
        assert_eq!(stopped, ControlFlow::Break("enough"));
        assert!(begun.load(Ordering::SeqCst) <= 1 + 2 * AHEAD);
        let none = in_order(0, 4, &work, &mut |_| ControlFlow::Break(()));
        assert!(none.is_continue());
    }
}
