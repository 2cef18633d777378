//! Many sessions on a few threads, answers in order, and rates of them.

use std::sync::atomic::{AtomicUsize, Ordering};

/// `of(0) … of(n − 1)`, in order whatever the number of threads.
pub fn in_parallel<T: Send>(n: usize, of: impl Fn(usize) -> T + Sync) -> Vec<T> {
    let threads = std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let next = AtomicUsize::new(0);
    let work = || {
        let mut own = Vec::new();
        loop {
            let k = next.fetch_add(1, Ordering::Relaxed);
            if k >= n {
                return own;
            }
            own.push((k, of(k)));
        }
    };
    let mut all: Vec<(usize, T)> = std::thread::scope(|scope| {
        let workers: Vec<_> = (0..threads.min(n)).map(|_| scope.spawn(work)).collect();
        let joined = workers.into_iter().map(|w| w.join().expect("no panic"));
        joined.flatten().collect()
    });
    all.sort_by_key(|one| one.0);
    all.into_iter().map(|one| one.1).collect()
}

/// A row of the table: how many of how many, and the bar.
pub fn row(name: &str, good: usize, of: usize, bar: &str) {
    let share = good as f64 / of.max(1) as f64;
    println!("| {name} | {good}/{of} = {:.1} % | {bar} |", 100.0 * share);
}

/// What is counted in some answers: its name, which of them count, and the bar.
pub type Column<T> = (&'static str, fn(&T) -> bool, &'static str);

/// A row for each of the columns.
pub fn rows_of<T>(name: &str, answers: &[T], columns: &[Column<T>]) {
    for (what, does, bar) in columns {
        row(
            &format!("{name}: {what}"),
            count(answers, does),
            answers.len(),
            bar,
        );
    }
}

/// How many of some answers do.
pub fn count<T>(answers: &[T], does: impl Fn(&T) -> bool) -> usize {
    answers.iter().filter(|a| does(a)).count()
}

/// Says more about one session on the error stream, where the environment has `DETAILS`.
pub fn details(says: impl FnOnce() -> String) {
    if std::env::var_os("DETAILS").is_some() {
        eprintln!("{}", says());
    }
}
