//! Independent parts of a computation on several threads.
//!
//! Every part gives what it would give alone, and the parts are put together in their order: the answer has the same
//! bits on one thread and on many. A part has to be long compared with the start of a thread (some tens of
//! microseconds).

use std::thread::{available_parallelism, scope};

/// So many threads are taken by default: what a search can do side by side keeps no more busy.
const USUAL: usize = 2;

/// On how many threads parts are done.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Threads(usize);

impl Threads {
    /// On this one alone.
    pub const ONE: Self = Self(1);

    /// As many as were asked for, else two where the machine has them.
    pub fn of(asked: Option<usize>) -> Self {
        let there = || available_parallelism().map_or(1, |cores| cores.get().min(USUAL));
        Self(asked.unwrap_or_else(there).max(1))
    }

    /// What each of so many parts gives, in their order.
    pub fn each<R: Send>(self, count: usize, part: impl Fn(usize) -> R + Sync) -> Vec<R> {
        let threads = self.0.min(count);
        if threads < 2 {
            return (0..count).map(part).collect();
        }
        let share =
            |first: usize| -> Vec<R> { (first..count).step_by(threads).map(&part).collect() };
        let shares = scope(|scope| {
            let others: Vec<_> = (1..threads)
                .map(|first| {
                    let share = &share;
                    scope.spawn(move || share(first))
                })
                .collect();
            let mut shares = vec![share(0)];
            for other in others {
                shares.push(
                    other
                        .join()
                        .unwrap_or_else(|panic| std::panic::resume_unwind(panic)),
                );
            }
            shares
        });
        let mut shares: Vec<_> = shares.into_iter().map(Vec::into_iter).collect();
        (0..count)
            .filter_map(|k| shares[k % threads].next())
            .collect()
    }

    /// The same of parts of which some may have no answer; then there is none of the whole.
    pub fn all<R: Send>(
        self,
        count: usize,
        part: impl Fn(usize) -> Option<R> + Sync,
    ) -> Option<Vec<R>> {
        self.each(count, part).into_iter().collect()
    }

    /// Cuts so many things into stretches, one for each thread, each a multiple of `together` but the last.
    pub fn stretches(self, count: usize, together: usize) -> Vec<std::ops::Range<usize>> {
        let together = together.max(1);
        let own = count.div_ceil(together).div_ceil(self.0).max(1) * together;
        let starts = (0..count).step_by(own);
        starts.map(|from| from..(from + own).min(count)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_stand_in_their_order_on_any_number_of_threads() {
        for threads in [1, 2, 3, 8] {
            let threads = Threads::of(Some(threads));
            for count in [0, 1, 2, 7, 20] {
                let expected: Vec<usize> = (0..count).map(|k| k * k).collect();
                assert_eq!(threads.each(count, |k| k * k), expected);
                assert_eq!(threads.all(count, |k| Some(k * k)), Some(expected));
            }
            assert_eq!(threads.all(5, |k| (k != 3).then_some(k)), None);
            let stretches = threads.stretches(21, 4);
            assert!(stretches.len() <= 8 && stretches.iter().all(|s| s.start % 4 == 0));
            let all: Vec<usize> = stretches.into_iter().flatten().collect();
            assert_eq!(all, (0..21).collect::<Vec<_>>());
        }
        assert_eq!(Threads::of(Some(0)), Threads::ONE);
    }
}
