//! How many cases a test looks at: a few for every change, all of them with `EVERY_CASE` in the environment, which
//! `scripts/check-slow` sets.

/// Whether every case is looked at.
pub(crate) fn every_case() -> bool {
    std::env::var_os("EVERY_CASE").is_some()
}

/// The first `few` of all cases, or all.
pub(crate) fn cases<T>(all: &[T], few: usize) -> &[T] {
    if every_case() { all } else { &all[..few] }
}
